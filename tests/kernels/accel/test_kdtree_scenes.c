/* The kd-tree of real scenes: structure, every sampled point of a triangle in a leaf that lists it, and a file of it.
 *
 *   test_kdtree_scenes [all]
 *
 * The scenes are files of the folder that LANETRACE_SCENES names: three small ones, or all.
 */
#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <math.h>

#include "kernels/accel/box.h"
#include "kernels/accel/kdtree_file.h"
#include "lrbni/base/parallel.h"
#include "lrbni/base/random.h"
#include "tests/base/files.h"
#include "tests/kernels/accel/kdtree_check.h"

enum { POINTS = 100000 };

static int all_scenes;

/* Whether a leaf that lists the triangle holds the point in its closed cell; cells are widened by rounding. */
static int is_covered(const kdtree *tree, const double point[3], uint32_t id, double slack)
{
    const kdtree_node *stack[KDTREE_MAX_DEPTH + 2];
    size_t used = 0;
    stack[used++] = tree->nodes;
    while (used > 0) {
        const kdtree_node *node = stack[--used];
        if (!kdtree_is_leaf(node)) {
            double beyond = point[node->link & KDTREE_KIND] - (double)node->split;
            if (beyond <= slack)
                stack[used++] = kdtree_children(tree, node);
            if (beyond >= -slack)
                stack[used++] = kdtree_children(tree, node) + 1;
            continue;
        }
        for (size_t i = 0; i < kdtree_leaf_count(node); i++)
            if (kdtree_leaf_id(tree, node, i) == id)
                return 1;
    }
    return 0;
}

static void check_points(const scene *s, const kdtree *tree)
{
    base_random random = {17};
    double slack = 0.0;
    for (int axis = 0; axis < 3; axis++)
        slack = fmax(slack, 0x1p-50 * (fabs((double)tree->min[axis]) + fabs((double)tree->max[axis])));
    for (int i = 0; i < POINTS; i++) {
        uint32_t id = (uint32_t)(base_random_bits(&random) % s->triangle_count);
        const scene_triangle *t = &s->triangles[id];
        double a = base_random_unit(&random), b = base_random_unit(&random), point[3];
        if (accel_triangle_is_degenerate(t))
            continue;
        if (a + b > 1.0) {
            a = 1.0 - a;
            b = 1.0 - b;
        }
        for (int axis = 0; axis < 3; axis++)
            point[axis] = (1.0 - a - b) * (double)t->v[0][axis] + a * (double)t->v[1][axis] + b * (double)t->v[2][axis];
        assert_true(is_covered(tree, point, id, slack));
    }
}

static void check_file(const scene *s, const kdtree_options *options, const kdtree *tree)
{
    char *folder = files_make_directory(), *path = files_path(folder, "tree");
    kdtree *again = NULL;
    base_error err = {0};
    if (kdtree_write(tree, s, options, path, &err) != BASE_OK || kdtree_read(path, s, options, &again, &err) != BASE_OK)
        fail_msg("%s: %s", err.what, err.why);
    assert_true(kdtree_check_hash(again) == kdtree_check_hash(tree));
    kdtree_destroy(&again);
    free(path);
    files_remove_directory(folder);
}

static void check_scene(const char *path)
{
    scene *s = NULL;
    kdtree *tree = NULL;
    base_error err = {0};
    kdtree_options options = kdtree_options_default();
    options.jobs = base_parallel_jobs();
    base_status status = scene_open(path, &s, &err);
    if (status == BASE_ERR_UNSUPPORTED) {
        print_message("# skipped: %s: %s\n", path, err.why);
        return;
    }
    if (status != BASE_OK || kdtree_build(s, &options, &tree, &err) != BASE_OK)
        fail_msg("%s: %s", err.what, err.why);
    kdtree_check(s, tree, &options);
    check_points(s, tree);
    check_file(s, &options, tree);
    kdtree_destroy(&tree);
    scene_destroy(&s);
}

static void kdtree__real_scenes__tree_is_sound_and_complete(void **state)
{
    static const char *const few[] = {"room_804.glb", "teapot.glb", "trex_25k.glb"};
    const char *folder = getenv("LANETRACE_SCENES");
    DIR *directory = folder ? opendir(folder) : NULL;
    (void)state;
    if (!directory) {
        print_message("# skipped: the folder of scenes is not there\n");
        return;
    }
    for (struct dirent *entry; (entry = readdir(directory)) != NULL;) {
        const char *end = strrchr(entry->d_name, '.');
        int wanted = all_scenes && end && strcmp(end, ".glb") == 0;
        for (size_t i = 0; i < sizeof few / sizeof *few; i++)
            wanted |= strcmp(entry->d_name, few[i]) == 0;
        if (!wanted)
            continue;
        char *path = files_path(folder, entry->d_name);
        check_scene(path);
        free(path);
    }
    closedir(directory);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kdtree__real_scenes__tree_is_sound_and_complete),
    };
    all_scenes = argc > 1 && strcmp(argv[1], "all") == 0;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
