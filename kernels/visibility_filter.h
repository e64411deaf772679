/* The 4x4 discontinuity filter of interleaved soft shadows (Benthin and Wald 2009, 4.5), on the host: it makes pictures and is
 * charged to no machine.
 *
 * A pixel's visibility becomes the mean over its 4x4 window, x-1..x+2 and y-1..y+2, of the pixels that have a hit, a normal within
 * some 18 degrees of its own (n.n' >= 0.95) and a depth that differs by at most 2 % of the smaller. Every window holds each of the 16 sets of samples
 * once, so on a plane the mean is that of 256 samples. The limits are ours: the paper gives none.
 */
#ifndef KERNELS_VISIBILITY_FILTER_H
#define KERNELS_VISIBILITY_FILTER_H

#include "kernels/job.h"

/**
 * Filter the visibility of a job's picture.
 *
 * @param job  of a kernel with shadows, all tiles traced
 * @param out  width * height, row by row from the top left; 1 where there is no hit
 */
void visibility_filter(const kernel_job *job, float *out);

#endif
