/* What a kd-tree is for: closest hits found through it are those of brute force, with few tests. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "kernels/accel/kdtree.h"
#include "lrbni/base/random.h"
#include "tests/kernels/accel/kd_ray.h"
#include "tests/kernels/accel/soup.h"

/* Shoot rays across a scene; at least one in `one_in` must hit something. The scene is freed. */
static void compare_hits(scene s, double centre, double reach, size_t one_in)
{
    enum { RAYS = 400 };
    base_random random = {99};
    kdtree_options variants[5];
    single_ray rays[RAYS];
    single_hit expected[RAYS];
    size_t hits = 0;
    for (int i = 0; i < 5; i++)
        variants[i] = kdtree_options_default();
    variants[1].min_area = 0;
    variants[2].covered_planes = 0;
    variants[3].empty_percent = 100;
    variants[4].perfect_splits = 0;
    for (int i = 0; i < RAYS; i++) {
        for (int a = 0; a < 3; a++) {
            rays[i].o[a] = base_random_range(&random, centre - reach, centre + reach);
            rays[i].d[a] = base_random_range(&random, centre - reach, centre + reach) - rays[i].o[a];
        }
        expected[i] = single_ray_brute_force(&s, &rays[i]);
        hits += expected[i].id != SINGLE_NO_HIT;
    }
    assert_true(hits * one_in >= RAYS);
    for (int v = 0; v < 5; v++) {
        kd_ray_counts n = {0};
        kdtree *tree = NULL;
        assert_int_equal(kdtree_build(&s, &variants[v], &tree, NULL), BASE_OK);
        for (int i = 0; i < RAYS; i++) {
            single_hit found = kd_ray_closest(tree, &rays[i], &n);
            assert_int_equal(found.id, expected[i].id);
            assert_true(found.t == expected[i].t);
        }
        assert_true(n.tests < (size_t)RAYS * s.triangle_count / 4);
        kdtree_destroy(&tree);
    }
    soup_free(&s);
}

static void kdtree_use__random_triangles__hits_of_brute_force(void **state)
{
    (void)state;
    compare_hits(soup_random(1, 3000, 0.1), 0.0, 1.5, 4);
    compare_hits(soup_random(2, 500, 0.5), 0.0, 1.5, 4);
}

static void kdtree_use__clusters__hits_of_brute_force(void **state)
{
    (void)state;
    compare_hits(soup_clustered(3, 3000), 0.0, 12.0, 10);
}

static void kdtree_use__coplanar_overlaps__hits_of_brute_force(void **state)
{
    (void)state;
    compare_hits(soup_coplanar(4, 2000), 0.0, 1.5, 20);
}

static void kdtree_use__degenerate_among_others__hits_of_brute_force(void **state)
{
    (void)state;
    compare_hits(soup_degenerate(5, 2000, 3), 0.0, 1.5, 4);
}

static void kdtree_use__far_from_the_origin__hits_of_brute_force(void **state)
{
    (void)state;
    compare_hits(soup_placed(6, 2000, 16.0f, 4096.0f), 4096.0, 20.0, 4);
}

/* A box of twelve triangles around many of soup_random: its walls fill planes and become flat cells. */
static scene room(void)
{
    scene inside = soup_random(7, 500, 0.1), s = soup_create("room", 512);
    memcpy(s.triangles, inside.triangles, 500 * sizeof *s.triangles);
    for (int wall = 0; wall < 6; wall++)
        for (int half = 0; half < 2; half++) {
            scene_triangle *t = &s.triangles[500 + 2 * wall + half];
            for (int corner = 0; corner < 3; corner++) {
                int u = half == 0 ? corner > 0 : corner == 1, v = half == 0 ? corner > 1 : corner > 0;
                t->v[corner][wall / 2] = wall % 2 ? 2.0f : -2.0f;
                t->v[corner][(wall / 2 + 1) % 3] = u ? 2.0f : -2.0f;
                t->v[corner][(wall / 2 + 2) % 3] = v ? 2.0f : -2.0f;
            }
        }
    soup_free(&inside);
    return s;
}

static void kdtree_use__walls_of_a_room__flat_cells_and_hits_of_brute_force(void **state)
{
    scene s = room();
    kdtree_options options = kdtree_options_default();
    kdtree *tree = NULL;
    (void)state;
    assert_int_equal(kdtree_build(&s, &options, &tree, NULL), BASE_OK);
    assert_int_equal(tree->covered_count, 6);
    kdtree_destroy(&tree);
    compare_hits(s, 0.0, 1.9, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kdtree_use__random_triangles__hits_of_brute_force),
        cmocka_unit_test(kdtree_use__clusters__hits_of_brute_force),
        cmocka_unit_test(kdtree_use__coplanar_overlaps__hits_of_brute_force),
        cmocka_unit_test(kdtree_use__degenerate_among_others__hits_of_brute_force),
        cmocka_unit_test(kdtree_use__far_from_the_origin__hits_of_brute_force),
        cmocka_unit_test(kdtree_use__walls_of_a_room__flat_cells_and_hits_of_brute_force),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
