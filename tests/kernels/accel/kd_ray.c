#include "tests/kernels/accel/kd_ray.h"

#include <assert.h>
#include <math.h>

/* A child that waits, and the stretch of the ray in it. */
typedef struct waiting {
    const kdtree_node *node;
    double in, out;
} waiting;

/* The stretch of the ray in the root's cell, widened. */
static waiting start(const kdtree *tree, const single_ray *r, double slack)
{
    waiting root = {tree->nodes, 0.0, HUGE_VAL};
    for (int a = 0; a < 3; a++) {
        double x = ((double)tree->min[a] - r->o[a]) / r->d[a], y = ((double)tree->max[a] - r->o[a]) / r->d[a];
        double widen = slack / fabs(r->d[a]);
        root.in = fmax(root.in, fmin(x, y) - widen);
        root.out = fmin(root.out, fmax(x, y) + widen);
    }
    return root;
}

single_hit kd_ray_closest(const kdtree *tree, const single_ray *r, kd_ray_counts *n)
{
    waiting stack[KDTREE_MAX_DEPTH + 1];
    size_t used = 0;
    single_hit h = {HUGE_VAL, SINGLE_NO_HIT};
    double slack = 0.0;
    for (int a = 0; a < 3; a++)
        slack = fmax(slack, 1e-9 * (fabs((double)tree->min[a]) + fabs((double)tree->max[a]) + fabs(r->o[a])));
    waiting now = start(tree, r, slack);
    if (now.in > now.out)
        return h;
    for (;;) {
        while (!kdtree_is_leaf(now.node)) {
            uint32_t axis = now.node->link & KDTREE_KIND;
            const kdtree_node *below = kdtree_children(tree, now.node);
            int down = r->d[axis] < 0.0;
            double widen = slack / fabs(r->d[axis]), at = ((double)now.node->split - r->o[axis]) / r->d[axis];
            const kdtree_node *near = below + down, *far = below + !down;
            n->inner++;
            if (now.out < at - widen)
                now.node = near;
            else if (now.in > at + widen)
                now.node = far;
            else {
                assert(used <= KDTREE_MAX_DEPTH);
                stack[used++] = (waiting){far, fmax(now.in, at - widen), now.out};
                now = (waiting){near, now.in, fmin(now.out, at + widen)};
            }
        }
        n->leaves++;
        for (size_t i = 0; i < kdtree_leaf_count(now.node); i++, n->tests++)
            single_ray_record(r, &tree->records[kdtree_leaf_list(tree, now.node)[i] / sizeof(bvh_triangle)], &h);
        do {
            if (used == 0)
                return h;
            now = stack[--used];
        } while (now.in > h.t * (1 + 1e-9));
    }
}
