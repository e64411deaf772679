#include "kernels/accel/kdtree_split.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    FEW_KEYS = 40,         /* up to here insertion sort is faster */
    DIGITS = 4,            /* of a key, 8 bits each */
    DIGIT_VALUES = 256
};

/* ---- sorted bounds ---- */

/* Integers in the order of the floats. */
static uint32_t key_of(float f)
{
    uint32_t u;
    memcpy(&u, &f, sizeof u);
    return u ^ (u >> 31 ? UINT32_MAX : UINT32_C(0x80000000));
}

static float float_of(uint32_t key)
{
    float f;
    key ^= key >> 31 ? UINT32_C(0x80000000) : UINT32_MAX;
    memcpy(&f, &key, sizeof f);
    return f;
}

static void insertion_sort(uint32_t *keys, size_t count)
{
    for (size_t i = 1; i < count; i++) {
        uint32_t key = keys[i];
        size_t j = i;
        for (; j > 0 && keys[j - 1] > key; j--)
            keys[j] = keys[j - 1];
        keys[j] = key;
    }
}

/* Sort by digits, from the least one; a digit that all keys share is skipped. */
static void radix_sort(uint32_t *keys, uint32_t *spare, size_t count)
{
    uint32_t histogram[DIGITS][DIGIT_VALUES] = {{0}};
    uint32_t *from = keys, *to = spare;
    for (size_t i = 0; i < count; i++)
        for (int digit = 0; digit < DIGITS; digit++)
            histogram[digit][keys[i] >> (8 * digit) & 0xff]++;
    for (int digit = 0; digit < DIGITS; digit++) {
        uint32_t *place = histogram[digit], sum = 0;
        if (place[keys[0] >> (8 * digit) & 0xff] == count)
            continue;
        for (int value = 0; value < DIGIT_VALUES; value++) {
            uint32_t n = place[value];
            place[value] = sum;
            sum += n;
        }
        for (size_t i = 0; i < count; i++)
            to[place[from[i] >> (8 * digit) & 0xff]++] = from[i];
        uint32_t *swapped = from;
        from = to;
        to = swapped;
    }
    if (from != keys)
        memcpy(keys, from, count * sizeof *keys);
}

static void sort_keys(uint32_t *keys, uint32_t *spare, size_t count)
{
    if (count <= FEW_KEYS)
        insertion_sort(keys, count);
    else
        radix_sort(keys, spare, count);
}

void kdtree_bounds_free(kdtree_bounds *bounds)
{
    free(bounds->low);
    memset(bounds, 0, sizeof *bounds);
}

base_status kdtree_bounds_reserve(kdtree_bounds *bounds, size_t count, base_error *err)
{
    if (count <= bounds->room)
        return BASE_OK;
    kdtree_bounds_free(bounds);
    count += count / 2;
    bounds->low = malloc(5 * count * sizeof *bounds->low);
    if (!bounds->low)
        return base_fail(err, BASE_ERR_NOMEM, "kd-tree", "out of memory");
    bounds->high = bounds->low + count;
    bounds->flat = bounds->high + count;
    bounds->spare[0] = bounds->flat + count;
    bounds->spare[1] = bounds->spare[0] + count;
    bounds->room = count;
    return BASE_OK;
}

void kdtree_bounds_sort(kdtree_bounds *bounds, int side, const kdtree_ref *refs, size_t count, int axis)
{
    if (side == 1) {
        for (size_t i = 0; i < count; i++)
            bounds->high[i] = key_of(refs[i].box.max[axis]);
        sort_keys(bounds->high, bounds->spare[1], count);
        return;
    }
    size_t flat = 0;
    for (size_t i = 0; i < count; i++) {
        float low = refs[i].box.min[axis];
        bounds->low[i] = key_of(low);
        bounds->flat[flat] = bounds->low[i];
        flat += low == refs[i].box.max[axis];
    }
    bounds->flat_count = flat;
    sort_keys(bounds->low, bounds->spare[0], count);
    sort_keys(bounds->flat, bounds->spare[0], flat);
}

/* ---- rule 1 ---- */

kdtree_cell kdtree_refs_around(const kdtree_ref *refs, size_t count)
{
    const float inf = INFINITY;
    kdtree_cell around = {{inf, inf, inf}, {-inf, -inf, -inf}};
    for (size_t i = 0; i < count; i++)
        for (int axis = 0; axis < 3; axis++) {
            float low = refs[i].box.min[axis], high = refs[i].box.max[axis];
            around.min[axis] = low < around.min[axis] ? low : around.min[axis];
            around.max[axis] = high > around.max[axis] ? high : around.max[axis];
        }
    return around;
}

kdtree_split kdtree_split_empty(const kdtree_rules *rules, const kdtree_cell *cell, const kdtree_cell *around)
{
    kdtree_split best = {.axis = -1};
    double share = rules->empty_share;
    for (int axis = 0; axis < 3; axis++) {
        double length = kdtree_cell_length(cell, axis);
        double below = (double)around->min[axis] - (double)cell->min[axis];
        double gap[2] = {below, (double)cell->max[axis] - (double)around->max[axis]};
        for (int side = 0; side < 2; side++)
            if (length > 0.0 && share < 1.0 && gap[side] > share * length) {
                share = gap[side] / length;
                best = (kdtree_split){.axis = axis, .plane = (side ? around->max : around->min)[axis], .flat_above = side == 0};
            }
    }
    return best;
}

/* ---- costs ---- */

/* The surfaces of the two parts of a cell, by where it is cut along an axis. */
typedef struct surfaces {
    double start, length; /* of the cell, along the axis */
    double section;       /* area across the axis */
    double girth;         /* half the circumference of that */
} surfaces;

static surfaces surfaces_of(const kdtree_cell *cell, int axis)
{
    double a = kdtree_cell_length(cell, (axis + 1) % 3), b = kdtree_cell_length(cell, (axis + 2) % 3);
    return (surfaces){(double)cell->min[axis], kdtree_cell_length(cell, axis), a * b, a + b};
}

/* Cost of a cut with so many triangles below, above and in the plane; these go where the surface is smaller, and on a face
   to the flat side, even if rounding makes the surfaces equal. */
static kdtree_split split_at(const surfaces *s, int axis, float plane, size_t below, size_t above, size_t flat, double *smaller)
{
    double x = (double)plane - s->start;
    double low = s->section + x * s->girth, high = s->section + (s->length - x) * s->girth;
    bool flat_above = high < low || (x == s->length && x > 0.0);
    double cost = low * (double)(below + (flat_above ? 0 : flat)) + high * (double)(above + (flat_above ? flat : 0));
    *smaller = flat_above ? high : low;
    return (kdtree_split){axis, plane, flat_above, cost};
}

/* How many of the sorted keys are less than this one. */
static size_t keys_below(const uint32_t *keys, size_t count, uint64_t key)
{
    size_t first = 0;
    while (count > 0) {
        size_t half = count / 2;
        if (keys[first + half] < key) {
            first += half + 1;
            count -= half + 1;
        } else
            count = half;
    }
    return first;
}

kdtree_split kdtree_split_at_plane(const kdtree_cell *cell, const kdtree_bounds *bounds, size_t count, int axis, float plane)
{
    surfaces s = surfaces_of(cell, axis);
    uint64_t key = key_of(plane);
    double smaller;
    size_t below = keys_below(bounds->low, count, key), above = count - keys_below(bounds->high, count, key + 1);
    size_t flat = keys_below(bounds->flat, bounds->flat_count, key + 1) - keys_below(bounds->flat, bounds->flat_count, key);
    return split_at(&s, axis, plane, below, above, flat, &smaller);
}

/* ---- rule 3 ---- */

kdtree_split kdtree_split_cheapest(const kdtree_rules *rules, const kdtree_cell *cell, const kdtree_bounds *b, size_t count,
                                   int axis)
{
    kdtree_split best = {.axis = -1, .cost = HUGE_VAL};
    surfaces s = surfaces_of(cell, axis);
    uint32_t first = key_of(cell->min[axis]), last = key_of(cell->max[axis]);
    size_t low = 0, high = 0, flat = 0; /* bounds below the plane; of high and flat, then, also those in it */
    while (high < count) {
        uint32_t key = low < count && b->low[low] < b->high[high] ? b->low[low] : b->high[high];
        size_t flat_before = flat;
        while (high < count && b->high[high] == key)
            high++;
        while (flat < b->flat_count && b->flat[flat] == key)
            flat++;
        if (key > first && key < last) {
            double smaller;
            kdtree_split split = split_at(&s, axis, float_of(key), low, count - high, flat - flat_before, &smaller);
            if (split.cost < best.cost && smaller >= rules->min_half_area)
                best = split;
        }
        while (low < count && b->low[low] == key)
            low++;
    }
    return best;
}

kdtree_split kdtree_split_best(const kdtree_rules *rules, const kdtree_cell *cell, const kdtree_split axes[3], size_t count)
{
    kdtree_split best = axes[0];
    double area = kdtree_cell_half_area(cell);
    for (int axis = 1; axis < 3; axis++)
        if (axes[axis].cost < best.cost)
            best = axes[axis];
    if (best.cost + rules->traversal_cost * area >= area * (double)count)
        best.axis = -1;
    return best;
}

/* ---- the references of both sides ---- */

static bool cut_ref(const kdtree_rules *rules, const kdtree_cell *half, const kdtree_ref *ref, int axis, kdtree_ref *out)
{
    *out = *ref;
    if (out->box.min[axis] < half->min[axis])
        out->box.min[axis] = half->min[axis];
    if (out->box.max[axis] > half->max[axis])
        out->box.max[axis] = half->max[axis];
    return !rules->perfect_splits || kdtree_cell_clip(half, &rules->triangles[ref->id], rules->margin, out);
}

void kdtree_refs_divide(const kdtree_rules *rules, const kdtree_cell *cell, const kdtree_split *split, const kdtree_ref *refs,
                        size_t count, kdtree_ref *below, kdtree_ref *above, size_t counts[2])
{
    int axis = split->axis;
    float plane = split->plane;
    size_t low = 0, high = 0;
    kdtree_cell lower = kdtree_cell_half(cell, axis, plane, 0), upper = kdtree_cell_half(cell, axis, plane, 1);
    for (size_t i = 0; i < count; i++) {
        bool is_below = refs[i].box.min[axis] < plane, is_above = refs[i].box.max[axis] > plane;
        if (is_below && is_above) {
            low += cut_ref(rules, &lower, &refs[i], axis, &below[low]);
            high += cut_ref(rules, &upper, &refs[i], axis, &above[high]);
        } else if (is_below || (!is_above && !split->flat_above))
            below[low++] = refs[i];
        else
            above[high++] = refs[i];
    }
    counts[0] = low;
    counts[1] = high;
}
