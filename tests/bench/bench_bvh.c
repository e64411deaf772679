/* Build time of the BVH.
 *
 *   bench_bvh [--repeat N] [SCENE...]
 *
 * A SCENE is what scene_open takes. Without any: the built-in scenes, and the .glb files of the folder that
 * LANETRACE_SCENES names. Rows of CSV on stdout, the best of N builds (default 5) for 1 job and for all of the
 * host's; lines of '#' name the compiler and the CPU.
 */
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lrbni/base/parallel.h"
#include "scene/builtin.h"
#include "scene/scene.h"
#include "tests/bench/measure.h"

/* One row; nonzero if the tree could not be built. */
static int bench_build(const scene *s, unsigned jobs, int repeat)
{
    double best = 0.0;
    bvh *tree = NULL;
    base_error err = {0};
    bvh_options options = bvh_options_default();
    options.jobs = jobs;
    if (measure_bvh_build(s, &options, repeat, &best, &tree, &err) != BASE_OK) {
        fprintf(stderr, "bench_bvh: error: %s: %s\n", err.what, err.why);
        return 1;
    }
    printf("bvh/jobs%u/%s,%zu,%u,%.6f,%.4f,%zu,%u,%.4f\n", jobs, s->name, s->triangle_count, jobs, best,
           best * 1e6 / (double)s->triangle_count, tree->inner_count, tree->depth, tree->sah_cost);
    bvh_destroy(&tree);
    fflush(stdout);
    return 0;
}

static int bench_scene(const char *spec, int repeat)
{
    scene *s = NULL;
    base_error err = {0};
    unsigned all = base_parallel_jobs();
    if (scene_open(spec, &s, &err) != BASE_OK) {
        fprintf(stderr, "bench_bvh: error: %s: %s\n", err.what, err.why);
        return 1;
    }
    int failed = bench_build(s, 1, repeat) || (all > 1 && bench_build(s, all, repeat));
    scene_destroy(&s);
    return failed;
}

static int bench_builtin(int repeat)
{
    size_t count;
    int failed = 0;
    const scene_builtin *scenes = scene_builtin_list(&count);
    for (size_t i = 0; i < count; i++) {
        char spec[256];
        snprintf(spec, sizeof spec, "builtin:%s", scenes[i].name);
        failed |= bench_scene(spec, repeat);
    }
    return failed;
}

static int is_glb(const struct dirent *entry)
{
    size_t length = strlen(entry->d_name);
    return length > 4 && strcmp(entry->d_name + length - 4, ".glb") == 0;
}

static int bench_folder(const char *folder, int repeat)
{
    struct dirent **entries;
    int count = scandir(folder, &entries, is_glb, alphasort), failed = 0;
    if (count < 0) {
        printf("# no folder %s\n", folder);
        return 0;
    }
    for (int i = 0; i < count; i++) {
        char path[4096];
        snprintf(path, sizeof path, "%s/%s", folder, entries[i]->d_name);
        failed |= bench_scene(path, repeat);
        free(entries[i]);
    }
    free(entries);
    return failed;
}

int main(int argc, char **argv)
{
    const char *folder = getenv("LANETRACE_SCENES");
    int repeat = 5, first = 1, failed = 0;
    if (argc > 2 && strcmp(argv[1], "--repeat") == 0) {
        repeat = atoi(argv[2]);
        first = 3;
    }
    if (repeat < 1) {
        fprintf(stderr, "bench_bvh: error: --repeat: %s is not a number of at least 1\n", argv[2]);
        return 2;
    }
    measure_print_head();
    printf("# max_leaf 4, 16 bins; best of %d\n", repeat);
    printf("row,triangles,jobs,seconds,seconds_per_million,inner_nodes,depth,sah_cost\n");
    for (int i = first; i < argc; i++)
        failed |= bench_scene(argv[i], repeat);
    if (first >= argc) {
        failed |= bench_builtin(repeat);
        if (folder)
            failed |= bench_folder(folder, repeat);
    }
    return failed ? 1 : 0;
}
