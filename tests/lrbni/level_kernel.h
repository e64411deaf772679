/* One small kernel, compiled at every level of accounting. */
#ifndef TESTS_LRBNI_LEVEL_KERNEL_H
#define TESTS_LRBNI_LEVEL_KERNEL_H

#include "lrbni/ctx.h"

enum { LEVEL_VECTORS = 256, LEVEL_BYTES = 64 * LEVEL_VECTORS };

/* Reads all vectors of `data`, writes some back and leaves its results in the context's scratch. Uses every op of
   ops.def. */
typedef void level_kernel_fn(lrb_ctx *c, lrb_segment data);
level_kernel_fn level_kernel_0, level_kernel_1, level_kernel_2;
level_kernel_fn level_kernel_annotated; /* LRB_RECORD with LRB_ANNOTATED */

#endif
