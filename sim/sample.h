/* Sampling: the total of something dear over all units of a run, from a few units and something cheap that is known of all.
 *
 * Units are whatever the caller cuts a run into. Each has a size x, known beforehand and cheap (its cycles in `count`), and a
 * value y that costs much to find (its cycles in `core`). Where y is about proportional to x, the ratio of a few y to
 * their x makes of the sum of all x a good estimate of the sum of all y: x is the control variate.
 *
 * - Stratified: units are ordered by x and cut into strata of about equal sums of x; a round draws one unit from each, at
 *   random and without putting it back, so large units, which matter most, are drawn more often.
 * - Estimated by the combined ratio (W. G. Cochran, "Sampling Techniques", 3rd edition, 1977, 6.11): the sum of all x times
 *   b = sum of N_h mean(y) over sum of N_h mean(x), over the strata h of N_h units.
 * - Its variance: the sum over strata of N_h^2 (1 - n_h/N_h) / n_h times the variance of y - b x within the stratum
 *   (6.47 there); the interval is Student's, with Satterthwaite's degrees of freedom: few where one stratum has most of the variance.
 *
 * The order of draws is a function of the seed and the sizes alone.
 */
#ifndef SIM_SAMPLE_H
#define SIM_SAMPLE_H

#include <stddef.h>
#include <stdint.h>

#include "lrbni/base/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct sim_sample sim_sample;

/* What is known of the total. */
typedef struct sim_estimate {
    double total;
    double half_width_95; /* the total is within +- of it in 95 of 100 samples; 0 once every unit is drawn; infinity before two rounds */
    size_t drawn, units;
} sim_estimate;

/**
 * Begin a sample: nothing drawn.
 *
 * @param size   x of each unit, all at least 0; not kept
 * @param units  how many, at least 1
 * @param seed   of the order of draws
 *
 * Errors: BASE_ERR_NOMEM.
 */
base_status sim_sample_create(const double *size, size_t units, uint64_t seed, sim_sample **out, base_error *err);

/** Free a sample, which may be NULL, and set the pointer to NULL. */
void sim_sample_destroy(sim_sample **sample);

/**
 * Draw one round: a unit from each stratum that still has one.
 *
 * @param units  receives the units, room for SIM_SAMPLE_STRATA
 * @return       how many; 0: all have been drawn
 */
#define SIM_SAMPLE_STRATA 4
size_t sim_sample_draw(sim_sample *sample, size_t units[SIM_SAMPLE_STRATA]);

/**
 * Tell what was found of a unit that was drawn; once each.
 *
 * @param size   x, as it came out: the same as the size known beforehand where units do not overlap; where they do, a
 *               little more or less of the neighbours, and `value` is that of as much
 * @param value  y
 */
void sim_sample_add(sim_sample *sample, size_t unit, double size, double value);

/** Estimate the total from the units that were added; all that were drawn must have been. */
sim_estimate sim_sample_estimate(const sim_sample *sample);

/** Half the width of Student's 95% interval, in standard errors, for so many degrees of freedom; infinity for 0. */
double sim_student_95(size_t freedom);

#ifdef __cplusplus
}
#endif
#endif
