/* The external function of a kernel at the level that is being compiled. */
#ifndef KERNELS_TILE_FUNCTION_H
#define KERNELS_TILE_FUNCTION_H

#include "kernels/kernel.h"

/*
 * KERNEL_TILE_FUNCTION(mft_primary, mft_trace): defines mft_primary_count as mft_trace, which is inlined.
 *
 * The work is done with copies of the context and the counts whose addresses nobody else has: the host's compiler
 * can then keep counters in registers and add up whole blocks of ops at once, where it would otherwise have to
 * count op by op, in memory, because any store of the kernel might change a counter.
 */
#define KERNEL_TILE_FUNCTION(name, trace)                                                               \
    void KERNEL_TILE_FN(name)(lrb_ctx * c, const kernel_job *job, uint32_t tile, kernel_counts *n);     \
    void KERNEL_TILE_FN(name)(lrb_ctx * c, const kernel_job *job, uint32_t tile, kernel_counts *n)      \
    {                                                                                                   \
        lrb_ctx local = *c;                                                                             \
        kernel_counts counts = *n;                                                                      \
        trace(&local, job, tile, &counts);                                                              \
        *c = local;                                                                                     \
        *n = counts;                                                                                    \
    }

#endif
