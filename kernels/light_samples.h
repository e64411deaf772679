/* Points on a light, in sets of 16: interleaved sampling (Keller and Heidrich 2001; Benthin and Wald 2009, 4.5).
 *
 * All points together are a (0,m,2)-net in base 2, by Hammersley or by Larcher and Pillichshammer (after Kollig and Keller
 * 2002); each set has one point in every cell of a 4x4 grid, so that a set alone samples the light evenly too. How the net
 * is cut into sets is not in the paper: 'permuted' deals the points of a cell out by a fixed random permutation,
 * 'rank' in their order along x, 'bits' by the middle bits of the point's number. With 'rank' and 'bits' Hammersley's
 * sets are lattices.
 */
#ifndef KERNELS_LIGHT_SAMPLES_H
#define KERNELS_LIGHT_SAMPLES_H

#include "kernels/params.h"

/* Points of one set by cell of the grid, row by row, each in [0,1). Multiples of 2^-12, exact. */
typedef struct light_samples {
    float a[16], b[16];
} light_samples;

/**
 * Fill `count` sets with the points of one net.
 *
 * @param count  16, 64 or 256 (asserted)
 * @param sets   out, count
 */
void light_samples_fill(kernel_net net, kernel_assignment assignment, unsigned count, light_samples *sets);

#endif
