#include "kernels/accel/bvh_split.h"

#include <string.h>

/* Keeps the bit pattern of an id a normal float, whatever the id: arithmetic on the unused lane then costs the same
   as on the others (a subnormal would be slow on some hosts) and cannot be NaN. Ids are below 2^25. */
#define ID_FLAG UINT32_C(0x40000000)

bvh_ref bvh_ref_create(const scene_triangle *t, uint32_t id)
{
    bvh_ref ref = accel_box_of_triangle(t);
    uint32_t bits = id | ID_FLAG;
    memcpy(&ref.v[3], &bits, sizeof bits);
    return ref;
}

uint32_t bvh_ref_id(const bvh_ref *ref)
{
    uint32_t bits;
    memcpy(&bits, &ref->v[3], sizeof bits);
    return bits ^ ID_FLAG;
}

accel_box bvh_refs_box(const bvh_ref *refs, size_t count)
{
    accel_box box = accel_box_empty();
    for (size_t i = 0; i < count; i++)
        accel_box_add(&box, &refs[i]);
    return box;
}

void bvh_extent_add(bvh_extent *extent, const bvh_extent *other)
{
    for (int i = 0; i < 4; i++) {
        extent->low[i] = other->low[i] < extent->low[i] ? other->low[i] : extent->low[i];
        extent->high[i] = other->high[i] > extent->high[i] ? other->high[i] : extent->high[i];
    }
}

bvh_extent bvh_refs_extent(const bvh_ref *refs, size_t count)
{
    const float inf = INFINITY;
    bvh_extent extent = {{inf, inf, inf, inf}, {-inf, -inf, -inf, -inf}};
    for (size_t r = 0; r < count; r++) {
        const float *v = refs[r].v;
        ACCEL_LANES
        for (int i = 0; i < 4; i++) {
            float c = v[i] - v[i + 4];
            extent.low[i] = c < extent.low[i] ? c : extent.low[i];
            extent.high[i] = c > extent.high[i] ? c : extent.high[i];
        }
    }
    return extent;
}

bvh_frame bvh_frame_create(bvh_extent extent, unsigned bins)
{
    bvh_frame frame = {.top = (float)(bins - 1)};
    for (int axis = 0; axis < 3; axis++) {
        float scale = (float)bins / (extent.high[axis] - extent.low[axis]);
        frame.origin[axis] = extent.low[axis];
        frame.scale[axis] = isfinite(scale) ? scale : 0.0f;
    }
    return frame;
}

void bvh_bins_fill(bvh_bins *out, const bvh_frame *frame, const bvh_ref *refs, size_t count)
{
    const bvh_frame f = *frame;
    unsigned bins = (unsigned)f.top + 1;
    for (int axis = 0; axis < 3; axis++) {
        for (unsigned k = 0; k < bins; k++)
            out->box[axis][k] = accel_box_empty();
        memset(out->count[axis], 0, bins * sizeof out->count[axis][0]);
    }
    for (size_t r = 0; r < count; r++) {
        const float *v = refs[r].v;
        int32_t bin[4];
        /* A centroid that overflowed gives NaN: the comparison is false and the last bin takes it. */
        ACCEL_LANES
        for (int i = 0; i < 4; i++) {
            float t = ((v[i] - v[i + 4]) - f.origin[i]) * f.scale[i];
            t = t < f.top ? t : f.top;
            bin[i] = (int32_t)t;
        }
        for (int axis = 0; axis < 3; axis++) {
            accel_box_add(&out->box[axis][bin[axis]], &refs[r]);
            out->count[axis][bin[axis]]++;
        }
    }
}

void bvh_bins_add(bvh_bins *into, const bvh_bins *from, unsigned bins)
{
    for (int axis = 0; axis < 3; axis++)
        for (unsigned k = 0; k < bins; k++) {
            accel_box_add(&into->box[axis][k], &from->box[axis][k]);
            into->count[axis][k] += from->count[axis][k];
        }
}

/* The best boundary of one axis, if it is better than *cost. Boundaries beside an empty bin divide the list as their
   left neighbours do, so only occupied bins are visited: small lists occupy few. */
static void sweep_axis(const bvh_bins *b, unsigned bins, int axis, size_t most, bvh_split *split, double *cost)
{
    unsigned used[BVH_MAX_BINS + 1], used_count = 0;
    double right_cost[BVH_MAX_BINS];
    uint32_t right_count = 0, left_count = 0;
    accel_box box = accel_box_empty();

    for (unsigned k = 0; k < bins; k++) {
        used[used_count] = k;
        used_count += b->count[axis][k] != 0;
    }
    for (unsigned u = used_count; u-- > 1;) {
        accel_box_add(&box, &b->box[axis][used[u]]);
        right_count += b->count[axis][used[u]];
        right_cost[u] = accel_box_half_area(&box) * (double)right_count;
    }
    box = accel_box_empty();
    for (unsigned u = 0; u + 1 < used_count; u++) {
        accel_box_add(&box, &b->box[axis][used[u]]);
        left_count += b->count[axis][used[u]];
        double c = accel_box_half_area(&box) * (double)left_count + right_cost[u + 1];
        right_count -= u > 0 ? b->count[axis][used[u]] : 0;
        if (c < *cost && left_count <= most && right_count <= most) {
            *cost = c;
            split->axis = axis;
            split->bin = used[u];
            split->left_count = left_count;
        }
    }
}

bvh_split bvh_bins_split(const bvh_bins *b, unsigned bins, size_t most)
{
    bvh_split split = {.axis = -1, .left = accel_box_empty(), .right = accel_box_empty()};
    double cost = (double)INFINITY;
    for (int axis = 0; axis < 3; axis++)
        sweep_axis(b, bins, axis, most, &split, &cost);
    if (split.axis < 0)
        return split;
    const accel_box *box = b->box[split.axis];
    for (unsigned k = 0; k <= split.bin; k++)
        accel_box_add(&split.left, &box[k]);
    for (unsigned k = split.bin + 1; k < bins; k++)
        accel_box_add(&split.right, &box[k]);
    return split;
}

size_t bvh_bins_left_count(const bvh_bins *b, const bvh_split *split)
{
    size_t count = 0;
    for (unsigned k = 0; k <= split->bin; k++)
        count += b->count[split->axis][k];
    return count;
}

void bvh_refs_divide(const bvh_ref *restrict refs, size_t count, const bvh_frame *frame, const bvh_split *split,
                     bvh_ref *restrict to, size_t left, size_t right)
{
    int axis = split->axis;
    float origin = frame->origin[axis], scale = frame->scale[axis];
    float edge = (float)(split->bin + 1); /* t below the edge rounds down to a bin on the left */
    for (size_t i = 0; i < count; i++) {
        float t = ((refs[i].v[axis] - refs[i].v[axis + 4]) - origin) * scale;
        size_t is_left = t < edge;
        to[right ^ ((left ^ right) & -is_left)] = refs[i]; /* no branch: nobody could predict it */
        left += is_left;
        right += 1 - is_left;
    }
}
