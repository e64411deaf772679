/* Compiled with SAXPY_NAME as the function's name, once per level. */
#include "tests/library/saxpy.h"

#define LRB_SOURCE 1
#include "lrbni/lrbni.h"

void SAXPY_NAME(lrb_ctx *c, lrb_segment x, lrb_segment y, float a, int n)
{
    lrb_ptr scratch = lrb_segment_at(c->scratch, 0), xs = lrb_segment_at(x, 0), ys = lrb_segment_at(y, 0);
    memcpy(scratch.host, &a, sizeof a);
    lrb_v16f va = lrb_load_1to16_ps(c, lrb_at(scratch, 0));
    lrb_r64 offset = lrb_imm(0), end = lrb_imm(4 * (uint64_t)n), step = lrb_imm(64);
    lrb_flags f = lrb_cmp(c, offset, end);
    do {
        lrb_v16f vy = lrb_load_ps(c, lrb_at_index(ys, offset, 1, 0)), vx = lrb_load_ps(c, lrb_at_index(xs, offset, 1, 0));
        lrb_v16f sum = lrb_madd213_ps(c, vx, va, vy);
        lrb_store_ps(c, lrb_at_index(ys, offset, 1, 0), sum);
        offset = lrb_add(c, offset, step);
        f = lrb_cmp(c, offset, end);
    } while (lrb_jb(c, f));
}
