#include "kernels/accel/kdtree.h"

#include <math.h>
#include <stdlib.h>

#include "kernels/accel/kdtree_builder.h"
#include "kernels/accel/kdtree_occluders.h"
#include "kernels/accel/kdtree_tally.h"

#define MOST_MIN_AREA 1000000000u

kdtree_options kdtree_options_default(void)
{
    return (kdtree_options){
        .traversal_cost = 1.0f,
        .empty_percent = 10,
        .covered_planes = 1,
        .min_area = 1000,
        .perfect_splits = 1,
        .empty_occluders = 1,
        .max_depth = KDTREE_MAX_DEPTH,
        .jobs = 1,
    };
}

static base_status switch_check(const char *name, unsigned value, base_error *err)
{
    return value > 1 ? base_fail(err, BASE_ERR_USAGE, name, "%u is neither 0 nor 1", value) : BASE_OK;
}

static base_status options_check(const kdtree_options *o, base_error *err)
{
    base_status status = BASE_OK;
    if (!isfinite(o->traversal_cost) || o->traversal_cost < 0.0f)
        return base_fail(err, BASE_ERR_USAGE, "traversal_cost", "%g is not a finite number of at least 0", (double)o->traversal_cost);
    if (o->empty_percent < 1 || o->empty_percent > 100)
        return base_fail(err, BASE_ERR_USAGE, "empty_percent", "%u is not in 1..100", o->empty_percent);
    if (o->min_area > MOST_MIN_AREA)
        return base_fail(err, BASE_ERR_USAGE, "min_area", "%u is not in 0..%u", o->min_area, MOST_MIN_AREA);
    if (o->max_depth > KDTREE_MAX_DEPTH)
        return base_fail(err, BASE_ERR_USAGE, "max_depth", "%u is not in 0..%d", o->max_depth, (int)KDTREE_MAX_DEPTH);
    if (o->jobs < 1)
        return base_fail(err, BASE_ERR_USAGE, "jobs", "0 is not at least 1");
    status = switch_check("covered_planes", o->covered_planes, err);
    if (status == BASE_OK)
        status = switch_check("perfect_splits", o->perfect_splits, err);
    if (status == BASE_OK)
        status = switch_check("empty_occluders", o->empty_occluders, err);
    return status;
}

base_status kdtree_build(const scene *s, const kdtree_options *options, kdtree **out, base_error *err)
{
    *out = NULL;
    base_status status = options_check(options, err);
    if (status != BASE_OK)
        return status;
    kdtree *tree = calloc(1, sizeof *tree);
    if (!tree)
        return base_fail(err, BASE_ERR_NOMEM, "kd-tree", "out of memory");
    status = kdtree_builder_run(s, options, tree, err);
    if (status == BASE_OK)
        status = kdtree_occluders_find(s, options->empty_occluders, options->jobs, tree, err);
    if (status == BASE_OK)
        status = kdtree_tally(tree, options, s->name, err);
    if (status != BASE_OK) {
        kdtree_destroy(&tree);
        return status;
    }
    *out = tree;
    return BASE_OK;
}

void kdtree_destroy(kdtree **tree)
{
    if (!*tree)
        return;
    free((*tree)->nodes);
    free((*tree)->lists);
    free((*tree)->records);
    free((*tree)->sizes);
    free((*tree)->components);
    free((*tree)->sets);
    free((*tree)->members);
    free(*tree);
    *tree = NULL;
}
