#include "kernels/accel/kdtree_cover.h"

#include <stdint.h>
#include <stdlib.h>

enum {
    FEW = 12,           /* triangles that are cut out of a part without halving it further */
    MOST_HALVINGS = 20,
    MOST_PIECES = 128,  /* of a part */
    MOST_CORNERS = 16   /* of a piece */
};

/* A convex polygon, counter-clockwise. */
typedef struct piece {
    double p[MOST_CORNERS][2];
    int count;
} piece;

/* The search, and how much may stay uncovered before it ends. */
typedef struct cover {
    const kdtree_flat_triangle *triangles;
    uint32_t *lists; /* of the parts from the whole down to the current one, one after the other */
    double left;     /* area that may still be found uncovered */
} cover;

/* Twice the signed area of a, b, c: above 0 if c lies to the left of a b. */
static double side(const double a[2], const double b[2], const double c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static double piece_area(const piece *p)
{
    double sum = 0.0;
    for (int i = 2; i < p->count; i++)
        sum += side(p->p[0], p->p[i - 1], p->p[i]);
    return 0.5 * sum;
}

/* Divide a piece at the line a b: what is on the left and what is on the right; false if that makes too many corners. */
static bool piece_divide(const piece *in, const double a[2], const double b[2], piece *left, piece *right)
{
    left->count = right->count = 0;
    if (in->count + 2 > MOST_CORNERS)
        return false;
    for (int i = 0; i < in->count; i++) {
        const double *p = in->p[i], *q = in->p[i + 1 < in->count ? i + 1 : 0];
        double dp = side(a, b, p), dq = side(a, b, q);
        for (int k = 0; k < 2; k++) {
            if (dp >= 0.0)
                left->p[left->count][k] = p[k];
            if (dp <= 0.0)
                right->p[right->count][k] = p[k];
        }
        left->count += dp >= 0.0;
        right->count += dp <= 0.0;
        if ((dp < 0.0 && dq > 0.0) || (dp > 0.0 && dq < 0.0)) {
            double t = dp / (dp - dq);
            for (int k = 0; k < 2; k++)
                left->p[left->count][k] = right->p[right->count][k] = p[k] + t * (q[k] - p[k]);
            left->count++;
            right->count++;
        }
    }
    return true;
}

/* The triangle's corner, counter-clockwise. */
static const double *corner(const kdtree_flat_triangle *t, int i)
{
    bool turned = side(t->v[0], t->v[1], t->v[2]) < 0.0;
    i %= 3;
    return t->v[turned ? (3 - i) % 3 : i];
}

/* Cut a triangle out of a piece: what is left are up to three pieces, put behind *count others; false if there is no room. */
static bool piece_subtract(piece in, const kdtree_flat_triangle *t, piece *out, int *count)
{
    for (int edge = 0; edge < 3; edge++) {
        piece left, right;
        if (!piece_divide(&in, corner(t, edge), corner(t, edge + 1), &left, &right))
            return false;
        if (right.count > 2 && piece_area(&right) > 0.0) {
            if (*count == MOST_PIECES)
                return false;
            out[(*count)++] = right;
        }
        in = left;
        if (in.count < 3)
            break;
    }
    return true;
}

/* Area of a part that its triangles leave uncovered; all of it if that takes too many pieces. */
static double uncovered(const cover *c, const kdtree_rectangle *r, const uint32_t *list, size_t count)
{
    piece buffers[2][MOST_PIECES];
    int from = 0, pieces = 1;
    double area = 0.0;
    buffers[0][0] = (piece){{{r->min[0], r->min[1]}, {r->max[0], r->min[1]}, {r->max[0], r->max[1]}, {r->min[0], r->max[1]}}, 4};
    for (size_t i = 0; i < count && pieces > 0; i++) {
        int left = 0;
        for (int p = 0; p < pieces; p++)
            if (!piece_subtract(buffers[from][p], &c->triangles[list[i]], buffers[from ^ 1], &left))
                return (r->max[0] - r->min[0]) * (r->max[1] - r->min[1]);
        from ^= 1;
        pieces = left;
    }
    for (int p = 0; p < pieces; p++)
        area += piece_area(&buffers[from][p]);
    return area;
}

typedef enum meeting { APART, CROSSING, COVERING } meeting;

/* How a triangle lies to a rectangle; CROSSING where that takes a closer look. */
static meeting meets(const kdtree_flat_triangle *t, const kdtree_rectangle *r)
{
    const double corners[4][2] = {{r->min[0], r->min[1]}, {r->max[0], r->min[1]}, {r->max[0], r->max[1]}, {r->min[0], r->max[1]}};
    bool covering = true;
    for (int k = 0; k < 2; k++) {
        bool below = true, above = true;
        for (int i = 0; i < 3; i++) {
            below &= t->v[i][k] <= r->min[k];
            above &= t->v[i][k] >= r->max[k];
        }
        if (below || above)
            return APART;
    }
    for (int edge = 0; edge < 3; edge++) {
        bool outside = true;
        for (int i = 0; i < 4; i++) {
            double s = side(corner(t, edge), corner(t, edge + 1), corners[i]);
            outside &= s <= 0.0;
            covering &= s >= 0.0;
        }
        if (outside)
            return APART;
    }
    return covering ? COVERING : CROSSING;
}

/* Take the uncovered area of a part from what is left; false as soon as nothing is. */
static bool search(cover *c, const kdtree_rectangle *r, const uint32_t *list, size_t count, int halvings)
{
    uint32_t *here = c->lists;
    size_t found = 0;
    for (size_t i = 0; i < count; i++) {
        meeting m = meets(&c->triangles[list[i]], r);
        if (m == COVERING)
            return true;
        if (m == CROSSING)
            here[found++] = list[i];
    }
    if (found <= FEW || halvings == MOST_HALVINGS) {
        c->left -= uncovered(c, r, here, found);
        return c->left >= 0.0;
    }
    int axis = r->max[0] - r->min[0] >= r->max[1] - r->min[1] ? 0 : 1;
    kdtree_rectangle low = *r, high = *r;
    low.max[axis] = high.min[axis] = r->min[axis] + 0.5 * (r->max[axis] - r->min[axis]);
    c->lists = here + found;
    bool within = search(c, &low, here, found, halvings + 1) && search(c, &high, here, found, halvings + 1);
    c->lists = here;
    return within;
}

base_status kdtree_cover(const kdtree_rectangle *rectangle, const kdtree_flat_triangle *triangles, size_t count, bool *covered,
                         base_error *err)
{
    double area = (rectangle->max[0] - rectangle->min[0]) * (rectangle->max[1] - rectangle->min[1]);
    uint32_t *lists = malloc((count + 1) * (MOST_HALVINGS + 2) * sizeof *lists);
    if (!lists)
        return base_fail(err, BASE_ERR_NOMEM, "kd-tree", "out of memory");
    for (size_t i = 0; i < count; i++)
        lists[i] = (uint32_t)i;
    cover c = {.triangles = triangles, .lists = lists + count, .left = 1e-6 * area};
    *covered = search(&c, rectangle, lists, count, 0);
    free(lists);
    return BASE_OK;
}
