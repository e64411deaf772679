/* Run a kernel once without accounting, for the benchmark under valgrind (valgrind.py).
 *
 *   bench_native_once KERNEL SCENE SIZE
 *
 * Prints a row of CSV: the kernel's wall time on one thread, the setting up of scene and tree apart, and the number of
 * its rays.
 */
#include <stdio.h>
#include <stdlib.h>

#include "kernels/kernel.h"
#include "lrbni/ctx.h"
#include "scene/scene.h"
#include "tests/bench/measure.h"

static base_status trace(const kernel_info *kernel, const kernel_job *job, double *seconds, uint64_t *rays, base_error *err)
{
    lrb_ctx *c = NULL;
    kernel_counts n = {0};
    base_status status = lrb_ctx_create(NULL, NULL, &c, err);
    if (status != BASE_OK)
        return status;
    double start = measure_seconds();
    for (uint32_t tile = 0; tile < kernel_job_tiles(job); tile++) {
        lrb_ctx_begin(c);
        kernel->tile[LRB_NATIVE](c, job, tile, &n);
        lrb_ctx_end(c);
    }
    *seconds = measure_seconds() - start;
    *rays = n.n[KERNEL_rays];
    lrb_ctx_destroy(&c);
    return BASE_OK;
}

int main(int argc, char **argv)
{
    const kernel_info *kernel = argc == 4 ? kernel_find(argv[1]) : NULL;
    scene *s = NULL;
    bvh *tree = NULL;
    kernel_job *job = NULL;
    const scene_camera *camera;
    base_error err = {0};
    double build_seconds, seconds = 0.0;
    uint64_t rays = 0;
    if (!kernel) {
        fprintf(stderr, "bench_native_once: error: usage: bench_native_once KERNEL SCENE SIZE\n");
        return 2;
    }
    const unsigned size = (unsigned)strtoul(argv[3], NULL, 10);
    bvh_options options = bvh_options_default();
    options.max_leaf = kernel->defaults.max_leaf;
    options.bins = kernel->defaults.bins;
    base_status status = scene_open(argv[2], &s, &err);
    if (status == BASE_OK)
        status = scene_find_camera(s, NULL, &camera, &err);
    if (status == BASE_OK)
        status = measure_bvh_build(s, &options, 1, &build_seconds, &tree, &err);
    if (status == BASE_OK)
        status = kernel_job_create(tree, camera, &s->light, size, size, &kernel->defaults, &job, &err);
    if (status == BASE_OK)
        status = trace(kernel, job, &seconds, &rays, &err);
    if (status == BASE_OK)
        printf("native/%s/%s,%u,%.6f,%llu\n", kernel->name, s->name, size, seconds, (unsigned long long)rays);
    else
        fprintf(stderr, "bench_native_once: error: %s: %s\n", err.what, err.why);
    kernel_job_destroy(&job);
    bvh_destroy(&tree);
    scene_destroy(&s);
    return status == BASE_OK ? 0 : 1;
}
