#include "tests/kernels/twin_unit.h"

#include <math.h>
#include <string.h>

float twin_reciprocal(float x)
{
    float estimate = 1.0f / x;
    uint32_t bits;
    memcpy(&bits, &estimate, sizeof bits);
    bits &= 0xfffff000u;
    memcpy(&estimate, &bits, sizeof bits);
    for (int step = 0; step < 2; step++)
        estimate *= fmaf(-estimate, x, 2.0f);
    return estimate;
}

static int sign_of(const twin_lane *l, int axis)
{
    return l->lo[axis] > 0.0f ? 1 : l->hi[axis] < 0.0f ? -1 : 0;
}

int twin_signs_mixed(const twin_unit *u)
{
    for (int axis = 0; axis < 3; axis++) {
        int seen = 0;
        for (unsigned i = 0; i < 16; i++)
            if (u->active >> i & 1)
                seen |= sign_of(&u->lane[i], axis) > 0 ? 1 : 2;
        if (seen == 3)
            return 1;
    }
    return 0;
}

int twin_signs_lacking(const twin_unit *u)
{
    int lacking = 0;
    for (unsigned i = 0; i < 16; i++)
        for (int axis = 0; axis < 3; axis++)
            lacking |= (u->active >> i & 1) && sign_of(&u->lane[i], axis) == 0;
    return lacking;
}

void twin_unit_reciprocals(twin_unit *u)
{
    for (unsigned i = 0; i < 16; i++)
        for (int axis = 0; axis < 3; axis++) {
            twin_lane *l = &u->lane[i];
            int negative = sign_of(l, axis) < 0;
            l->limit = INFINITY;
            l->far_rcp[axis] = twin_reciprocal(negative ? l->hi[axis] : l->lo[axis]);
            l->near_rcp[axis] = twin_reciprocal(u->some_zero ? fmaxf(l->hi[axis], 1e-18f) : negative ? l->lo[axis] : l->hi[axis]);
            l->back_rcp[axis] = twin_reciprocal(fminf(l->lo[axis], -1e-18f));
        }
}

void twin_count_path(kernel_counts *n, int some_zero, int mixed)
{
    n->n[some_zero ? KERNEL_units_zero : mixed ? KERNEL_units_blend : KERNEL_units_common]++;
}

int twin_lane_meets(const twin_lane *l, int some_zero, const bvh_node *box, const float origin[3], float *entry)
{
    float e = 0.0f, x = l->limit;
    for (int axis = 0; axis < 3; axis++) {
        float lo = box->min[axis] - origin[axis], hi = box->max[axis] - origin[axis];
        int sign = sign_of(l, axis);
        if (some_zero) {
            e = fmaxf(e, fmaxf(l->near_rcp[axis] * lo, l->back_rcp[axis] * hi));
            if (sign != 0)
                x = fminf(x, fmaxf(l->far_rcp[axis] * lo, l->far_rcp[axis] * hi));
        } else {
            e = fmaxf(e, l->near_rcp[axis] * (sign > 0 ? lo : hi));
            x = fminf(x, l->far_rcp[axis] * (sign > 0 ? hi : lo));
        }
    }
    *entry = e;
    return e <= x;
}
