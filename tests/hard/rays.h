/* Rays for the hard cases: zeros of either sign, exact axes, grids whose components touch or hold 0. */
#ifndef TESTS_HARD_RAYS_H
#define TESTS_HARD_RAYS_H

#include "lrbni/base/random.h"

/** A direction 2.9 long, whose components in `zeros` are zeros of random sign; at least one is not. */
void rays_with_zeros(base_random *r, unsigned zeros, float d[3]);

/** Sixteen rays in random directions, some exactly along axes, some equal. */
void rays_wild(base_random *r, float d[16][3]);

/** A grid of 16 x 16 directions about `width` wide; the components in `touch` are exactly 0 along a side of a block. */
void rays_grid(base_random *r, double width, int touch, float first[3], float right[3], float down[3]);

#endif
