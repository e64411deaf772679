/* y = a * x + y with ops, at two levels of accounting. */
#ifndef TESTS_LIBRARY_SAXPY_H
#define TESTS_LIBRARY_SAXPY_H

#include "lrbni/ctx.h"

/** x and y: n floats in segments, n a multiple of 16. */
void saxpy_counted(lrb_ctx *c, lrb_segment x, lrb_segment y, float a, int n);
void saxpy_recorded(lrb_ctx *c, lrb_segment x, lrb_segment y, float a, int n);

#endif
