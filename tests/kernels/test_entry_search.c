/* Conditions (1) and (2) of the entry-point search against exact arithmetic: no cell that holds a point of a ray is culled, for tiles
 * of any size and place, in trees of random triangles (oracle O4; hard cases C1, C2, C4 to C6). Corner rays alone fail the same test.
 *
 * Rays are the bits that the kernels trace. A point o + t*d with a coarse t and a coarse origin is exact in double: a sum that is
 * not is passed over. Which side of a plane it lies on is then decided without error, and where it lies in the plane both sides count.
 *
 * Groups of shadow rays go from the light to hits, the origins of the shadows that they stand for: the same for random ends and for the hits
 * of a picture, up to those ends. Bounds of half of the rays fail.
 *
 * usage: test_entry_search POINTS GROUPS
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/job_shadow.h"
#include "kernels/mlrta/entry_search.h"
#include "kernels/mlrta/hit_bounds.h"
#include "lrbni/base/random.h"
#include "tests/kernels/accel/soup.h"
#include "tests/kernels/trace.h"

enum { WIDTH = 300, HEIGHT = 280, RAYS = 16 };

static size_t points_wanted, groups_wanted;

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
static int exact_point(const job_constants *constants, const float d[3], double t, double p[3])
{
    for (int axis = 0; axis < 3; axis++) {
        double o = (double)constants->origin_box[axis], step = t * (double)d[axis]; /* 24 and 8 bits: exact */
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
        if (!exact_point(t->job->constants_host, d, coarse(r, 0, 4), p) || !inside(t->tree, p))
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

/* A job with a point light at a coarse place, in the soup or near it. */
static setting shadow_setting_create(uint64_t seed)
{
    setting t = setting_create(seed);
    base_random r = {seed << 16};
    scene_light light = t.s.light;
    for (int axis = 0; axis < 3; axis++) {
        light.point[axis] = seed % 3 == 0 ? (double)t.s.triangles[seed % 40].v[seed / 3 % 3][axis] : coarse(&r, -2, 2);
        light.u[axis] = axis == 0;
        light.v[axis] = axis == 1;
    }
    kernel_job_destroy(&t.job);
    t.job = trace_job(&(trace_request){.kernel = "mlrta-shadow", .kdtree = t.tree, .camera = &t.camera, .light = &light, .width = 32, .height = 32});
    return t;
}

/* The rays of a block in scratch: directions by axis and lane, and which are there. */
static float *block_rays(const setting *t, unsigned block)
{
    return (float *)(void *)((unsigned char *)t->c->scratch.host + HARD_RAYS + block * HARD_BLOCK);
}

static uint32_t *block_alive(const setting *t, unsigned block)
{
    return (uint32_t *)(void *)((unsigned char *)t->c->scratch.host + HARD_ALIVE + 4 * block);
}

/* Rays from the light to points about one in the root's cell, close together or far apart; some lanes have none. */
static void random_group(const setting *t, base_random *r)
{
    const double spread = ldexp(1, -(int)base_random_range(r, 0, 14));
    double centre[3];
    for (int axis = 0; axis < 3; axis++)
        centre[axis] = base_random_range(r, (double)t->tree->min[axis], (double)t->tree->max[axis]);
    for (unsigned block = 0; block < 16; block++) {
        float *rays = block_rays(t, block);
        *block_alive(t, block) = (uint32_t)(base_random_bits(r) & base_random_bits(r) & 0xffff);
        for (int i = 0; i < 48; i++) {
            const int axis = i / 16;
            double end = centre[axis] + base_random_range(r, -spread, spread);
            end = fmin(fmax(end, (double)t->tree->min[axis]), (double)t->tree->max[axis]);
            rays[i] = (float)end - t->job->light_constants_host->origin_box[axis];
        }
    }
}

/* Points of the rays of a group, from the light to their ends; `halved`: the bounds are made without half of the blocks. */
static size_t check_group(setting *t, base_random *r, int halved, size_t *lost)
{
    kernel_counts n = {{0}};
    kd16 k = kd16_from_light(t->c, t->job, &n);
    hard_shadow h = hard_shadow_of(t->c, t->job, &k, lrb_imm(0));
    tile_bounds b = {.negative = lrb_mask(0)};
    uint32_t kept_back[16];
    size_t points = 0;
    for (unsigned block = 0; block < 16; block++) {
        kept_back[block] = *block_alive(t, block);
        if (halved && block % 2)
            *block_alive(t, block) = 0;
    }
    const int bounded = hit_bounds_setup(t->c, h, &k, &b);
    for (unsigned block = 0; block < 16; block++)
        *block_alive(t, block) = kept_back[block];
    for (int i = 0; bounded && i < RAYS; i++) {
        const unsigned block = (unsigned)base_random_range(r, 0, 16), lane = (unsigned)base_random_range(r, 0, 16);
        const float *rays = block_rays(t, block), d[3] = {rays[lane], rays[16 + lane], rays[32 + lane]};
        double p[3];
        if (!(*block_alive(t, block) >> lane & 1) || !exact_point(t->job->light_constants_host, d, i % 4 ? coarse(r, 0, 1) : 1, p) || !inside(t->tree, p))
            continue;
        *lost += !kept(t, &k, &b, KERNEL_CULL_INVERSE, p, base_random_bits(r));
        points++;
    }
    return points;
}

static size_t lost_of_groups(size_t wanted, int halved, size_t *points)
{
    size_t lost = 0;
    for (size_t group = 0; group < wanted;) {
        setting t = shadow_setting_create(group + 1);
        base_random r = {~group};
        for (int i = 0; i < 1000; i++) {
            random_group(&t, &r);
            const size_t checked = check_group(&t, &r, halved, &lost);
            *points += checked;
            group += checked > 0;
        }
        setting_destroy(&t);
    }
    return lost;
}

static void hit_bounds__random_groups__no_point_lost(void **state)
{
    size_t points = 0;
    (void)state;
    assert_int_equal(lost_of_groups(groups_wanted, 0, &points), 0);
    assert_true(points > 2 * groups_wanted);
}

static void hit_bounds__of_half_the_rays__points_lost(void **state)
{
    size_t points = 0;
    (void)state;
    assert_true(lost_of_groups(groups_wanted, 1, &points) > 0);
}

/* The rays of a tile of a picture, as the kernel makes them, into scratch: job_hard_shadow_ray_of knows their bits. */
static void picture_group(setting *t, uint32_t tile)
{
    kernel_counts n = {{0}};
    kd16 k = kd16_from_light(t->c, t->job, &n);
    hard_shadow h = hard_shadow_of(t->c, t->job, &k, lrb_imm(tile));
    lrb_v16f first_rays[3];
    rays16_corners(t->c, h.camera, lrb_segment_at(t->job->tiles, tile * (uint32_t)sizeof(job_tile)), first_rays);
    for (int axis = 0; axis < 3; axis++)
        lrb_store_ps(t->c, lrb_at(k.scratch, SCRATCH_CORNERS + 64 * axis), first_rays[axis]);
    do
        hard_shadow_begin(t->c, &h, &k);
    while (hard_shadow_next(t->c, &h, &k));
    for (unsigned i = 0; i < 256; i++) {
        const unsigned x = tile % t->job->tiles_x * 16 + i % 16, y = tile / t->job->tiles_x * 16 + i / 16;
        const job_pixel p = kernel_job_pixel(t->job, x, y);
        job_shadow_ray ray;
        const int alive = *block_alive(t, p.block) >> p.pixel & 1;
        assert_int_equal(job_hard_shadow_ray_of(t->job, x, y, &ray), alive);
        for (int axis = 0; alive && axis < 3; axis++)
            assert_memory_equal(&block_rays(t, p.block)[16 * axis + (int)p.pixel], &ray.dir[axis], sizeof(float));
    }
}

static void hit_bounds__hits_of_pictures__no_point_lost(void **state)
{
    size_t points = 0, lost = 0;
    (void)state;
    for (uint64_t seed = 1; seed <= 40; seed++) {
        setting t = shadow_setting_create(seed);
        base_random r = {seed};
        kernel_counts n = {{0}};
        for (uint32_t unit = 0; unit < kernel_job_tiles(t.job); unit++)
            kernel_find("mlrta-shadow")->tile[LRB_NATIVE](t.c, t.job, unit, &n);
        for (uint32_t tile = 0; tile < 4; tile++) {
            picture_group(&t, tile);
            for (int i = 0; i < 20; i++)
                points += check_group(&t, &r, 0, &lost);
        }
        setting_destroy(&t);
    }
    assert_int_equal(lost, 0);
    assert_true(points > 1000);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(entry_search__inverse_culling__no_point_lost),
        cmocka_unit_test(entry_search__direct_culling__no_point_lost),
        cmocka_unit_test(entry_search__corner_rays__points_lost),
        cmocka_unit_test(hit_bounds__random_groups__no_point_lost),
        cmocka_unit_test(hit_bounds__of_half_the_rays__points_lost),
        cmocka_unit_test(hit_bounds__hits_of_pictures__no_point_lost),
    };
    points_wanted = argc > 1 ? strtoul(argv[1], NULL, 10) : 100000;
    groups_wanted = argc > 2 ? strtoul(argv[2], NULL, 10) : 20000;
    return cmocka_run_group_tests_name("kernels/entry_search", tests, NULL, NULL);
}
