#include "kernels/accel/bvh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/accel/box.h"
#include "kernels/accel/bvh_builder.h"
#include "kernels/accel/bvh_split.h"

enum { MOST_LEAF = 64 };

bvh_options bvh_options_default(void)
{
    return (bvh_options){.max_leaf = 4, .bins = 16, .traversal_cost = 1.0f, .intersect_cost = 1.0f, .jobs = 1};
}

static base_status options_check(const bvh_options *o, base_error *err)
{
    if (o->max_leaf < 1 || o->max_leaf > MOST_LEAF)
        return base_fail(err, BASE_ERR_USAGE, "max_leaf", "%u is not in 1..%d", o->max_leaf, (int)MOST_LEAF);
    if (o->bins < 2 || o->bins > BVH_MAX_BINS)
        return base_fail(err, BASE_ERR_USAGE, "bins", "%u is not in 2..%d", o->bins, (int)BVH_MAX_BINS);
    if (!isfinite(o->traversal_cost) || o->traversal_cost < 0.0f)
        return base_fail(err, BASE_ERR_USAGE, "traversal_cost", "%g is not a finite number of at least 0",
                         (double)o->traversal_cost);
    if (!isfinite(o->intersect_cost) || o->intersect_cost <= 0.0f)
        return base_fail(err, BASE_ERR_USAGE, "intersect_cost", "%g is not a finite number above 0",
                         (double)o->intersect_cost);
    if (o->jobs < 1)
        return base_fail(err, BASE_ERR_USAGE, "jobs", "0 is not at least 1");
    return BASE_OK;
}

/* Half the surface area; in double it neither overflows nor vanishes. */
static double node_half_area(const bvh_node *node)
{
    double x = (double)node->max[0] - (double)node->min[0];
    double y = (double)node->max[1] - (double)node->min[1];
    double z = (double)node->max[2] - (double)node->min[2];
    return x * y + y * z + z * x;
}

/* Sum over the nodes of cost times the chance that a ray which meets the root's box meets theirs, in the order of
   the nodes, so that rounding is the same everywhere. */
static double expected_cost(const bvh *tree, const bvh_options *options)
{
    double inner = 0.0, leaves = 0.0;
    if (tree->record_count == 0)
        return 0.0;
    for (size_t i = 0; i < tree->node_count; i++) { /* the root's neighbour is zero: no area */
        const bvh_node *node = &tree->nodes[i];
        if (node->count == 0)
            inner += node_half_area(node);
        else
            leaves += node_half_area(node) * (double)node->count;
    }
    double weighted = inner * (double)options->traversal_cost + leaves * (double)options->intersect_cost;
    return weighted / (node_half_area(&tree->nodes[0]) * (double)options->intersect_cost);
}

base_status bvh_build(const scene *s, const bvh_options *options, bvh **out, base_error *err)
{
    *out = NULL;
    base_status status = options_check(options, err);
    if (status != BASE_OK)
        return status;
    bvh *tree = calloc(1, sizeof *tree);
    if (!tree)
        return base_fail(err, BASE_ERR_NOMEM, "bvh", "out of memory");
    status = bvh_builder_run(s, options, tree, err);
    if (status != BASE_OK) {
        bvh_destroy(&tree);
        return status;
    }
    tree->leaf_count = tree->inner_count + 1;
    tree->sah_cost = expected_cost(tree, options);
    *out = tree;
    return BASE_OK;
}

/* The normal of a record, scaled so that neither tiny nor huge triangles leave the range of float. */
static void write_normal(const scene_triangle *t, float normal[3])
{
    double n[3];
    accel_triangle_normal(t, n);
    double largest = fmax(fabs(n[0]), fmax(fabs(n[1]), fabs(n[2])));
    for (int axis = 0; axis < 3; axis++)
        normal[axis] = (float)(n[axis] / largest);
}

bvh_triangle bvh_triangle_create(const scene_triangle *t, uint32_t id)
{
    bvh_triangle record = {.id = id};
    memcpy(record.v0, t->v[0], sizeof record.v0);
    memcpy(record.v1, t->v[1], sizeof record.v1);
    memcpy(record.v2, t->v[2], sizeof record.v2);
    write_normal(t, record.normal);
    return record;
}

void bvh_destroy(bvh **tree)
{
    if (!*tree)
        return;
    free((*tree)->nodes);
    free((*tree)->records);
    free(*tree);
    *tree = NULL;
}
