/* The 4x4 discontinuity filter once more, pixel by pixel in plain C: what kernels/visibility_filter.c must agree with in every bit. */
#ifndef TESTS_KERNELS_FILTER_ORACLE_H
#define TESTS_KERNELS_FILTER_ORACLE_H

#include "kernels/job.h"

/**
 * Filter the visibility of a job's picture: from the frame and the shadows, not from the rows that the kernel keeps.
 *
 * @param job  of a kernel with soft shadows, all tiles traced
 * @param out  width * height, row by row from the top left; 1 where there is no hit
 */
void filter_oracle(const kernel_job *job, float *out);

#endif
