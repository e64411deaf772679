/* Conditions (1) and (2) of the entry-point search against exact arithmetic: no cell that holds a point of a ray is culled, for tiles
 * of any size and place, in trees of random triangles (oracle O4; hard cases C1, C2, C4 to C6). Corner rays alone fail the same test.
 *
 * Rays are the bits that the kernels trace. A point o + t*d with a coarse t and a coarse origin is exact in double: a sum that is
 * not is passed over. Which side of a plane it lies on is then decided without error, and where it lies in the plane both sides count.
 *
 * usage: test_entry_search POINTS
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/mlrta/entry_search.h"
#include "lrbni/base/random.h"
#include "tests/kernels/accel/soup.h"
#include "tests/kernels/trace.h"

enum { WIDTH = 300, HEIGHT = 280, RAYS = 16 };

static size_t points_wanted;

/* A job on a random tree, seen from a random place. */
typedef struct setting {
    scene s;
    kdtree *tree;
    kernel_job *job;
    lrb_ctx *c;
    scene_camera camera;
} setting;

static double coarse(base_random *r, double low, double high) { return floor(base_random_range(r, low, high) * 64) / 64; }

static setting setting_create(uint64_t seed)
{
    setting t = {.s = soup_random(seed, 40, 0.6)};
    base_random r = {seed};
    static const double up[3] = {0, 1, 0};
    double eye[3], target[3];
    for (int axis = 0; axis < 3; axis++) {
        eye[axis] = coarse(&r, -2, 2);
        target[axis] = base_random_range(&r, -1, 1);
    }
    t.camera = scene_camera_look_at("anywhere", eye, target, up, base_random_range(&r, 0.2, 2.2));
    if (seed % 4 == 0) /* on a plane of the tree, or its edge or corner */
        for (int axis = 0; axis < 3; axis++)
            t.camera.position[axis] = (double)t.s.triangles[seed % 40].v[seed / 4 % 3][axis];
    t.tree = trace_kdtree(&t.s, &t.camera);
    t.job = trace_job(&(trace_request){.kernel = "mlrta-primary", .kdtree = t.tree, .camera = &t.camera, .width = WIDTH, .height = HEIGHT});
    assert_int_equal(lrb_ctx_create(NULL, NULL, &t.c, NULL), BASE_OK);
    return t;
}

static void setting_destroy(setting *t)
{
    lrb_ctx_destroy(&t->c);
    kernel_job_destroy(&t->job);
    kdtree_destroy(&t->tree);
    soup_free(&t->s);
}

/* o + t*d, exactly, or false. */
static int exact_point(const kernel_job *job, const float d[3], double t, double p[3])
{
    for (int axis = 0; axis < 3; axis++) {
        double o = (double)job->constants_host->origin_box[axis], step = t * (double)d[axis]; /* 24 and 8 bits: exact */
        p[axis] = o + step;
        double back = p[axis] - o, error = (o - (p[axis] - back)) + (step - back);
        if (error != 0.0)
            return 0;
    }
    return 1;
}

static int inside(const kdtree *tree, const double p[3])
{
    for (int axis = 0; axis < 3; axis++)
        if (p[axis] < (double)tree->min[axis] || p[axis] > (double)tree->max[axis])
            return 0;
    return 1;
}

/* The cells on the way from the root to the leaf that holds the point must be kept; returns whether they are. A point in a plane
   needs both sides: `above` chooses which of them is followed, and the nodes with such a choice are told. */
static int kept(setting *t, const kd16 *k, const tile_bounds *b, kernel_culling culling, const double p[3], uint64_t above)
{
    entry_place at = {.node = lrb_imm(0)};
    at.cell = tile_turned(t->c, b, lrb_load_ps(t->c, KD16_CELLS(k->cells, cell)));
    for (;;) {
        const kdtree_node *node = t->tree->nodes + at.node.value / sizeof *node;
        if (kdtree_is_leaf(node))
            return culling != KERNEL_CULL_INVERSE || entry_meets(t->c, k, at.cell);
        const unsigned axis = node->link & KDTREE_KIND;
        entry_plane plane = entry_plane_of(t->c, k, at.node, lrb_imm(node->link), lrb_imm(axis));
        lrb_r64 children = culling == KERNEL_CULL_INVERSE ? entry_children(t->c, &plane, at.cell)
                                                          : entry_children_by_cell(t->c, k, culling, &plane, at.cell);
        int upper = p[axis] > (double)node->split || (p[axis] == (double)node->split && (above & 1));
        int nearer = (plane.nearer.value == plane.pair.value) != upper;
        above >>= 1;
        if (!entry_reaches(t->c, children, nearer ? 0x0f : 0xf0))
            return 0;
        at = nearer ? entry_near(t->c, &plane, at.cell) : entry_far(t->c, &plane, at.cell);
    }
}

/* Points of rays of one tile; *lost counts those whose cells are culled. */
static size_t check_tile(setting *t, base_random *r, kernel_culling culling, size_t *lost)
{
    kernel_counts n = {{0}};
    kd16 k = kd16_of(t->c, t->job, &n);
    tile_bounds b;
    const unsigned edge = (unsigned)pow(2, base_random_range(r, 0, 8.99)), x0 = (unsigned)base_random_range(r, 0, WIDTH),
                   y0 = (unsigned)base_random_range(r, 0, HEIGHT);
    const unsigned x1 = x0 + edge > WIDTH ? WIDTH - 1 : x0 + edge - 1, y1 = y0 + edge > HEIGHT ? HEIGHT - 1 : y0 + edge - 1;
    const tile_pixels pixels = {lrb_imm(x0), lrb_imm(y0), lrb_imm(x1), lrb_imm(y1)};
    size_t points = 0;
    if (!tile_bounds_setup(t->c, &k, &pixels, &b))
        return 0;
    if (culling == KERNEL_CULL_DIRECT)
        entry_planes_setup(t->c, &k);
    if (culling == KERNEL_CULL_CORNER_RAYS)
        entry_rays_setup(t->c, &k);
    for (int ray = 0; ray < RAYS; ray++) {
        float d[3];
        double p[3];
        unsigned x = ray & 1 ? x0 : ray & 2 ? x1 : x0 + (unsigned)base_random_range(r, 0, x1 - x0 + 1);
        unsigned y = ray & 4 ? y0 : ray & 8 ? y1 : y0 + (unsigned)base_random_range(r, 0, y1 - y0 + 1);
        kernel_job_direction(t->job, x, y, d);
        if (!exact_point(t->job, d, coarse(r, 0, 4), p) || !inside(t->tree, p))
            continue;
        *lost += !kept(t, &k, &b, culling, p, base_random_bits(r));
        points++;
    }
    return points;
}

static size_t lost_points(kernel_culling culling, size_t wanted)
{
    size_t points = 0, lost = 0;
    for (uint64_t seed = 1; points < wanted; seed++) {
        setting t = setting_create(seed);
        base_random r = {seed << 32};
        for (int tile = 0; tile < 400; tile++)
            points += check_tile(&t, &r, culling, &lost);
        setting_destroy(&t);
    }
    return lost;
}

static void entry_search__inverse_culling__no_point_lost(void **state)
{
    (void)state;
    assert_int_equal(lost_points(KERNEL_CULL_INVERSE, points_wanted), 0);
}

static void entry_search__direct_culling__no_point_lost(void **state)
{
    (void)state;
    assert_int_equal(lost_points(KERNEL_CULL_DIRECT, points_wanted), 0);
}

static void entry_search__corner_rays__points_lost(void **state)
{
    (void)state;
    assert_true(lost_points(KERNEL_CULL_CORNER_RAYS, points_wanted / 10) > 0);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(entry_search__inverse_culling__no_point_lost),
        cmocka_unit_test(entry_search__direct_culling__no_point_lost),
        cmocka_unit_test(entry_search__corner_rays__points_lost),
    };
    points_wanted = argc > 1 ? strtoul(argv[1], NULL, 10) : 100000;
    return cmocka_run_group_tests_name("kernels/entry_search", tests, NULL, NULL);
}
