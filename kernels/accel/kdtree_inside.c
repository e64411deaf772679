#include "kernels/accel/kdtree_inside.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

typedef enum crossing { MISSED, ENTERING, LEAVING, UNSURE } crossing; /* through the front, through the back */

/* A number and a bound of its rounding error. */
typedef struct bounded {
    double value, error;
} bounded;

static int sign_of(bounded x)
{
    return x.value > x.error ? 1 : x.value < -x.error ? -1 : 0;
}

/* a x b: of differences that carry one rounding each, two products, one subtraction; 8 half-ulps cover them. */
static bounded cross(const double a[2], const double b[2])
{
    double p = a[0] * b[1], q = a[1] * b[0];
    return (bounded){p - q, 0x1p-50 * (fabs(p) + fabs(q))};
}

/*
 * How the half line from `point` crosses a triangle: seen along the axis the point lies within, and the plane is ahead.
 * The three cross products are the weights of the vertices, all of one sign within: that of the normal along the axis.
 */
static crossing triangle_crossing(const float *v[3], const double point[3], int axis, int up)
{
    int u = (axis + 1) % 3, w = (axis + 2) % 3, sum = 0;
    double p[3][2], ahead = 0.0, error = 0.0;
    bool above = true, below = true;
    for (int i = 0; i < 3; i++) {
        p[i][0] = (double)v[i][u] - point[u];
        p[i][1] = (double)v[i][w] - point[w];
    }
    for (int i = 0; i < 3; i++) {
        bounded weight = cross(p[(i + 1) % 3], p[(i + 2) % 3]);
        double along = (double)v[i][axis] - point[axis];
        int sign = sign_of(weight);
        above &= sign >= 0;
        below &= sign <= 0;
        sum += sign;
        ahead += weight.value * along;
        error += (fabs(weight.value) * 0x1p-50 + weight.error) * fabs(along);
    }
    if (!above && !below)
        return MISSED;
    int side = sign_of((bounded){ahead, error}) * (up ? 1 : -1);
    if (sum == 3 || sum == -3)
        return side == 0 ? UNSURE : side * sum < 0 ? MISSED : (sum > 0) == up ? LEAVING : ENTERING;
    return UNSURE;
}

void kdtree_inside_free(kdtree_inside *inside)
{
    free(inside->crossed);
    memset(inside, 0, sizeof *inside);
}

/* What a crossing is kept as: its component in the upper half, then its record's offset and how it crosses, in bits 0 and 1. */
enum { HOW = 3 };
_Static_assert(sizeof(bvh_triangle) % (HOW + 1) == 0, "offsets leave bits 0 and 1 free");

static base_status append(kdtree_inside *out, uint32_t component, uint32_t offset, crossing how, base_error *err)
{
    if (out->crossed_count == out->room) {
        size_t room = 2 * out->room + 64;
        uint64_t *grown = realloc(out->crossed, 2 * room * sizeof *grown);
        if (!grown)
            return base_fail(err, BASE_ERR_NOMEM, "kd-tree", "out of memory");
        out->crossed = grown;
        out->room = room;
    }
    out->crossed[out->crossed_count++] = (uint64_t)component << 32 | offset | (uint64_t)how;
    return BASE_OK;
}

static base_status cross_leaf(const kdtree *tree, const kdtree_node *leaf, const double point[3], int axis, int up,
                              kdtree_inside *out, base_error *err)
{
    const uint32_t *list = kdtree_leaf_list(tree, leaf);
    base_status status = BASE_OK;
    for (size_t i = 0; status == BASE_OK && i < kdtree_leaf_count(leaf); i++) {
        const bvh_triangle *t = &tree->records[list[i] / sizeof *t];
        uint32_t component = tree->components[t - tree->records];
        if (component == KDTREE_OPEN)
            continue;
        const float *v[3] = {t->v0, t->v1, t->v2};
        crossing c = triangle_crossing(v, point, axis, up);
        if (c != MISSED)
            status = append(out, component, list[i], c, err);
    }
    return status;
}

/* All leaves that the half line meets; both sides of planes that it runs in. */
static base_status walk(const kdtree *tree, const double point[3], int axis, int up, kdtree_inside *out, base_error *err)
{
    const kdtree_node *stack[KDTREE_MAX_DEPTH + 2];
    size_t used = 0;
    base_status status = BASE_OK;
    stack[used++] = tree->nodes;
    while (status == BASE_OK && used > 0) {
        const kdtree_node *node = stack[--used];
        if (kdtree_is_leaf(node)) {
            status = cross_leaf(tree, node, point, axis, up, out, err);
            continue;
        }
        const kdtree_node *children = kdtree_children(tree, node);
        int across = (int)(node->link & KDTREE_KIND);
        double split = (double)node->split;
        bool along = across == axis;
        if (point[across] <= split || (along && !up))
            stack[used++] = children;
        if (point[across] >= split || (along && up))
            stack[used++] = children + 1;
    }
    return status;
}

static int compare(const void *a, const void *b)
{
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return x < y ? -1 : x > y;
}

/* Sort the crossings into components; a triangle counts once, however many leaves list it. */
static void count_components(kdtree_inside *out)
{
    uint32_t *found = (uint32_t *)(out->crossed + out->room);
    size_t end;
    out->inside = found;
    out->unsure = found + out->crossed_count;
    out->inside_count = out->unsure_count = 0;
    qsort(out->crossed, out->crossed_count, sizeof *out->crossed, compare);
    for (size_t i = 0; i < out->crossed_count; i = end) {
        uint32_t component = (uint32_t)(out->crossed[i] >> 32);
        bool unsure = false, odd = false;
        int64_t winding = 0;
        for (end = i; end < out->crossed_count && out->crossed[end] >> 32 == component; end++) {
            if (end > i && out->crossed[end] == out->crossed[end - 1])
                continue;
            const uint64_t how = out->crossed[end] & HOW;
            unsure |= how == UNSURE;
            odd = !odd;
            winding += how == LEAVING ? 1 : -1;
        }
        if (!(component & KDTREE_ORIENTED))
            winding = 0;
        if (unsure)
            out->unsure[out->unsure_count++] = component >> 1;
        else if (odd || winding != 0)
            out->inside[out->inside_count++] = component >> 1 << 1 | (winding > 0 ? KDTREE_OUTWARD : 0);
    }
}

base_status kdtree_inside_find(const kdtree *tree, const double point[3], int axis, int up, kdtree_inside *out, base_error *err)
{
    out->crossed_count = 0;
    base_status status = walk(tree, point, axis, up, out, err);
    if (status == BASE_OK && out->crossed_count > 0)
        count_components(out);
    else
        out->inside_count = out->unsure_count = 0;
    return status;
}
