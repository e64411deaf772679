/* Sampling: the total of something dear over all units of a run, from a few units and some cheap things that are known of all.
 *
 * Units are whatever the caller cuts a run into. Each has variates x1, x2, ..., cheap to know, the first of them its size, and a value y that costs
 * much to find: cycles in `core`. Where y is about b1 x1 + b2 x2 + ..., a few y give the b, and these make of the sums of all x a good
 * estimate of the sum of all y: the x are the control variates.
 *
 * - Stratified: units are ordered by size and cut into strata of about equal sums of it; a round draws one unit from each, at
 *   random and without putting it back, so large units, which matter most, are drawn more often.
 * - Estimated by regression (C.-E. Saerndal, B. Swensson, J. Wretman, "Model Assisted Survey Sampling", 1992, chapter 6): the b by
 *   least squares, a unit of stratum h weighing N_h / n_h / x1; so weighted residuals sum to zero, and the total is the sum of b times the sums
 *   of all x. With the size alone it is the combined ratio estimator (W. G. Cochran, "Sampling
 *   Techniques", 3rd edition, 1977, 6.11). A variate that follows from those before it, or for which too few units are known, is left out.
 * - Its variance: the sum over strata of N_h^2 / n_h times the variance of the residuals within the stratum (6.47 there, without
 *   the correction for a finite population: a unit that is simulated by itself takes a little more or less than it does in the run, so that
 *   all of them together would not give the total either), residuals taken as they are, not from the stratum's mean, and
 *   made larger by their units' leverage. The interval is Student's, with Satterthwaite's degrees of freedom, few where one
 *   stratum has most of the variance, of which the b take as large a part as they are of the units.
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

#define SIM_SAMPLE_STRATA 4
#define SIM_SAMPLE_VARIATES 5 /* at most */

/* What is known of a unit; the first is its size. */
typedef struct sim_variates {
    double x[SIM_SAMPLE_VARIATES];
} sim_variates;

typedef struct sim_sample sim_sample;

/* What is known of the total. */
typedef struct sim_estimate {
    double total;
    double half_width_95; /* the total is within +- of it in 95 of 100 samples; infinity before two rounds */
    size_t added, units;
    double worth[SIM_SAMPLE_VARIATES]; /* b: what one of each variate adds to a value; 0: it was left out */
} sim_estimate;

/**
 * Begin a sample: nothing drawn.
 *
 * @param of        variates of each unit, all at least 0; not kept
 * @param units     how many, at least 1
 * @param variates  how many of a unit's are used, at least 1
 * @param seed      of the order of draws
 *
 * Errors: BASE_ERR_NOMEM.
 */
base_status sim_sample_create(const sim_variates *of, size_t units, unsigned variates, uint64_t seed, sim_sample **out, base_error *err);

/** Free a sample, which may be NULL, and set the pointer to NULL. */
void sim_sample_destroy(sim_sample **sample);

/**
 * Draw one round: a unit from each stratum that still has one.
 *
 * @param units  receives the units, room for SIM_SAMPLE_STRATA
 * @return       how many; 0: all have been drawn
 */
size_t sim_sample_draw(sim_sample *sample, size_t units[SIM_SAMPLE_STRATA]);

/** Units of the largest stratum. */
size_t sim_sample_largest(const sim_sample *sample);

/** Tell the value y of a unit that was drawn: once each, those of a stratum in the order of the draws. */
void sim_sample_add(sim_sample *sample, size_t unit, double value);

/** Estimate the total from the units that were added, at least one of each stratum that has one. */
sim_estimate sim_sample_estimate(const sim_sample *sample);

/** Half the width of Student's 95% interval, in standard errors, for so many degrees of freedom; infinity for 0. */
double sim_student_95(size_t freedom);

#ifdef __cplusplus
}
#endif
#endif
