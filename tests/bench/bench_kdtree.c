/* Build of the kd-tree beside that of the BVH: time, size, expected cost, and what each rule changes.
 *
 *   bench_kdtree [--rules] [--repeat N] [SCENE...]
 *
 * A SCENE is what scene_open takes; without any: all built-in scenes. Rows of CSV on stdout, the best of N builds
 * (default 1) with all of the host's threads; `bytes` are those that a kernel's traversal reads: nodes, lists and
 * records; `inner_ray`, `leaves_ray` and `tests_ray` are visits and triangle tests of a primary ray of the first camera, 128x128
 * of them traced one by one. With --rules also trees with one rule off or changed. Lines of '#' name the compiler and the CPU.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/accel/kdtree.h"
#include "lrbni/base/parallel.h"
#include "scene/builtin.h"
#include "scene/scene.h"
#include "tests/bench/measure.h"
#include "tests/kernels/accel/kd_ray.h"

enum { SIZE = 128 }; /* pixels on an edge of the image */

static int failed(const base_error *err)
{
    fprintf(stderr, "bench_kdtree: error: %s: %s\n", err->what, err->why);
    return 1;
}

static int bench_bvh(const scene *s, int repeat)
{
    double best = 0.0;
    bvh *tree = NULL;
    base_error err = {0};
    bvh_options options = bvh_options_default();
    options.jobs = base_parallel_jobs();
    if (measure_bvh_build(s, &options, repeat, &best, &tree, &err) != BASE_OK)
        return failed(&err);
    size_t bytes = tree->node_count * sizeof *tree->nodes + tree->record_count * sizeof *tree->records;
    printf("bvh,%s,%zu,%u,%.3f,%zu,%zu,0,0,0,0,%zu,%u,%.3f,%zu,,,\n", s->name, s->triangle_count, options.jobs, best, tree->inner_count,
           tree->leaf_count, tree->record_count, tree->depth, tree->sah_cost, bytes);
    fflush(stdout);
    bvh_destroy(&tree);
    return 0;
}

/* Visits of all primary rays of an image. */
static kd_ray_counts trace(const scene *s, const kdtree *tree)
{
    kd_ray_counts n = {0};
    scene_primary_rays rays = scene_camera_rays(&s->cameras[0], SIZE, SIZE);
    for (int pixel = 0; pixel < SIZE * SIZE; pixel++) {
        single_ray r;
        for (int a = 0; a < 3; a++) {
            r.o[a] = (double)rays.origin[a];
            r.d[a] = (double)rays.d00[a] + pixel % SIZE * (double)rays.dx[a] + pixel / SIZE * (double)rays.dy[a];
        }
        kd_ray_closest(tree, &r, &n);
    }
    return n;
}

static int bench_kdtree(const scene *s, const char *row, const kdtree_options *options, int repeat)
{
    double best = 0.0;
    kdtree *tree = NULL;
    base_error err = {0};
    for (int i = 0; i < repeat; i++) {
        kdtree_destroy(&tree);
        double start = measure_seconds();
        if (kdtree_build(s, options, &tree, &err) != BASE_OK)
            return failed(&err);
        double seconds = measure_seconds() - start;
        best = i == 0 || seconds < best ? seconds : best;
    }
    size_t bytes = tree->node_count * sizeof *tree->nodes + tree->list_count * sizeof *tree->lists + tree->record_count * sizeof *tree->records;
    kd_ray_counts n = trace(s, tree);
    const double rays = SIZE * SIZE;
    printf("%s,%s,%zu,%u,%.3f,%zu,%zu,%zu,%zu,%zu,%zu,%zu,%u,%.3f,%zu,%.2f,%.2f,%.2f\n", row, s->name, s->triangle_count, options->jobs, best,
           tree->inner_count, tree->leaf_count, tree->empty_count, tree->flat_count, tree->covered_count, tree->enclosed_count,
           tree->list_count, tree->depth, tree->sah_cost, bytes, (double)n.inner / rays, (double)n.leaves / rays, (double)n.tests / rays);
    fflush(stdout);
    kdtree_destroy(&tree);
    return 0;
}

/* The default tree, then each rule off or changed. */
static int bench_rules(const scene *s, int repeat)
{
    static const struct {
        const char *row;
        size_t field;
        unsigned value;
    } rules[] = {
        {"kdtree/empty_percent=100", offsetof(kdtree_options, empty_percent), 100},
        {"kdtree/empty_percent=30", offsetof(kdtree_options, empty_percent), 30},
        {"kdtree/covered_planes=0", offsetof(kdtree_options, covered_planes), 0},
        {"kdtree/min_area=0", offsetof(kdtree_options, min_area), 0},
        {"kdtree/min_area=100", offsetof(kdtree_options, min_area), 100},
        {"kdtree/min_area=10000", offsetof(kdtree_options, min_area), 10000},
        {"kdtree/perfect_splits=0", offsetof(kdtree_options, perfect_splits), 0},
        {"kdtree/empty_occluders=0", offsetof(kdtree_options, empty_occluders), 0},
    };
    int bad = 0;
    for (size_t i = 0; i < sizeof rules / sizeof *rules; i++) {
        kdtree_options options = kdtree_options_default();
        options.jobs = base_parallel_jobs();
        memcpy((char *)&options + rules[i].field, &rules[i].value, sizeof rules[i].value);
        bad |= bench_kdtree(s, rules[i].row, &options, repeat);
    }
    return bad;
}

static int bench_scene(const char *spec, int repeat, int rules)
{
    scene *s = NULL;
    base_error err = {0};
    kdtree_options options = kdtree_options_default();
    options.jobs = base_parallel_jobs();
    if (scene_open(spec, &s, &err) != BASE_OK)
        return failed(&err);
    int bad = bench_bvh(s, repeat) || bench_kdtree(s, "kdtree", &options, repeat) || (rules && bench_rules(s, repeat));
    scene_destroy(&s);
    return bad;
}

int main(int argc, char **argv)
{
    int repeat = 1, rules = 0, first = 1, bad = 0;
    if (first < argc && strcmp(argv[first], "--rules") == 0) {
        rules = 1;
        first++;
    }
    if (first + 1 < argc && strcmp(argv[first], "--repeat") == 0) {
        repeat = atoi(argv[first + 1]);
        first += 2;
    }
    if (repeat < 1) {
        fprintf(stderr, "bench_kdtree: error: --repeat: not a number of at least 1\n");
        return 2;
    }
    measure_print_head();
    printf("row,scene,triangles,jobs,seconds,inner,leaves,empty,flat,covered,enclosed,references,depth,sah_cost,bytes,inner_ray,leaves_ray,tests_ray\n");
    for (int i = first; i < argc; i++)
        bad |= bench_scene(argv[i], repeat, rules);
    size_t count;
    const scene_builtin *scenes = scene_builtin_list(&count);
    for (size_t i = 0; first >= argc && i < count; i++) {
        char spec[256];
        snprintf(spec, sizeof spec, "builtin:%s", scenes[i].name);
        bad |= bench_scene(spec, repeat, rules);
    }
    return bad;
}
