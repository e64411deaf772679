/* The discontinuity filter and the shading before it: where it must not mix (B16), what it makes of a penumbra, and every bit of it
 * against the same in plain C; shading against Lambert's law in double. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/kernels/filter_oracle.h"
#include "tests/kernels/accel/soup.h"
#include "tests/kernels/trace.h"

enum { FLAT, TILTED_10, TILTED_30 }; /* triangles, by the angle of their normals to the first's */

/* A picture whose pixels the tests write themselves. */
typedef struct canvas {
    scene s;
    bvh *tree;
    kernel_job *job;
    float *out;
} canvas;

static canvas canvas_create(unsigned width, unsigned height)
{
    static const double eye[3] = {0, 0, 3}, target[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    const scene_camera camera = scene_camera_look_at("front", eye, target, up, 0.5);
    canvas c = {.s = soup_create("tilts", 3), .out = calloc((size_t)width * height, sizeof(float))};
    kernel_params params = kernel_find("mft-soft")->defaults;
    const double angles[3] = {0, 10, 30};
    for (int i = 0; i < 3; i++) {
        const float rise = (float)tan(angles[i] * 3.14159265358979 / 180);
        const scene_triangle t = {{{0, 0, 0}, {1, 0, rise}, {0, 1, 0}}};
        c.s.triangles[i] = t;
    }
    c.s.light = (scene_light){.has_area = 1, .u = {1, 0, 0}, .v = {0, 1, 0}};
    c.tree = trace_tree(&c.s, 2);
    assert_int_equal(kernel_job_create(c.tree, &camera, &c.s.light, width, height, &params, &c.job, NULL), BASE_OK);
    assert_non_null(c.out);
    return c;
}

static void canvas_put(canvas *c, unsigned x, unsigned y, uint32_t id, float depth, float visibility)
{
    job_pixel p = kernel_job_pixel(c->job, x, y);
    c->job->frame_host[p.tile].id[p.block][p.pixel] = id;
    c->job->frame_host[p.tile].t[p.block][p.pixel] = depth;
    c->job->shadows_host[p.tile].visibility[p.block][p.pixel] = visibility;
}

/* The rows as the first pass leaves them, from what the tests have put into the frame. */
static void canvas_fill_rows(canvas *c)
{
    for (unsigned i = 0; i < c->job->width * c->job->height; i++) {
        const unsigned x = i % c->job->width, y = i / c->job->width;
        const job_pixel p = kernel_job_pixel(c->job, x, y);
        const uint32_t id = c->job->frame_host[p.tile].id[p.block][p.pixel];
        job_row *row = (job_row *)(uintptr_t)kernel_job_row(c->job, x, y);
        float d[3], side = 0;
        row->depth[x % 16] = id == JOB_NO_HIT ? INFINITY : c->job->frame_host[p.tile].t[p.block][p.pixel];
        row->visibility[x % 16] = c->job->shadows_host[p.tile].visibility[p.block][p.pixel];
        kernel_job_direction(c->job, x, y, d);
        for (int axis = 0; id != JOB_NO_HIT && axis < 3; axis++)
            side += c->job->normals_host[id][axis] * d[axis];
        for (int axis = 0; id != JOB_NO_HIT && axis < 3; axis++)
            row->normal[axis][x % 16] = (side > 0 ? -1.0f : 1.0f) * c->job->normals_host[id][axis];
    }
}

/* The tiles of a job from the first-th on, natively. */
static void run_tiles(const kernel_job *job, const char *kernel, uint32_t first)
{
    lrb_ctx *ctx = NULL;
    kernel_counts counts = {{0}};
    assert_int_equal(lrb_ctx_create(NULL, NULL, &ctx, NULL), BASE_OK);
    for (uint32_t tile = first; tile < kernel_job_tiles(job); tile++)
        kernel_find(kernel)->tile[LRB_NATIVE](ctx, job, tile, &counts);
    lrb_ctx_destroy(&ctx);
}

/* The kernel's second pass must leave what the oracle does, in every bit. */
static void assert_as_oracle(const kernel_job *job, float *expected)
{
    filter_oracle(job, expected);
    for (unsigned i = 0; i < job->width * job->height; i++) {
        const unsigned x = i % job->width, y = i / job->width;
        const job_row *row = kernel_job_row(job, x, y);
        const float filtered = row->filtered[x % 16], lit = row->shading[x % 16] * filtered;
        if (memcmp(&filtered, &expected[i], sizeof filtered) != 0 || memcmp(&lit, &row->lit[x % 16], sizeof lit) != 0)
            fail_msg("pixel %u,%u: filtered %a, oracle %a; lit %a", x, y, (double)filtered, (double)expected[i], (double)row->lit[x % 16]);
    }
}

static void canvas_filter(canvas *c)
{
    canvas_fill_rows(c);
    run_tiles(c->job, "mft-soft", kernel_job_first_pass(c->job));
    assert_as_oracle(c->job, c->out);
}

static void canvas_destroy(canvas *c)
{
    kernel_job_destroy(&c->job);
    bvh_destroy(&c->tree);
    soup_free(&c->s);
    free(c->out);
}

/* A left and a right half; the right one is seen by the light and the left one is not. */
static canvas halves(uint32_t right_id, float right_depth)
{
    canvas c = canvas_create(40, 20);
    for (unsigned y = 0; y < 20; y++)
        for (unsigned x = 0; x < 40; x++)
            canvas_put(&c, x, y, x < 20 ? FLAT : right_id, x < 20 ? 1 : right_depth, x < 20 ? 0 : 1);
    canvas_filter(&c);
    return c;
}

static void assert_unmixed(canvas c)
{
    for (unsigned i = 0; i < 800; i++)
        assert_true(c.out[i] == (i % 40 < 20 ? 0.0f : 1.0f));
    canvas_destroy(&c);
}

static void assert_mixed(canvas c)
{
    for (unsigned i = 0; i < 800; i++) {
        unsigned x = i % 40, first = x > 0 ? x - 1 : 0, last = x + 2 < 40 ? x + 2 : 39;
        unsigned lit = last >= 20 ? last - (first > 20 ? first : 20) + 1 : 0;
        assert_true(fabsf(c.out[i] - (float)lit / (float)(last - first + 1)) < 1e-6f);
    }
    canvas_destroy(&c);
}

static void b16__silhouette__no_leak(void **state)
{
    (void)state;
    assert_unmixed(halves(FLAT, 1.03f));
    assert_unmixed(halves(FLAT, 0.97f));
    assert_unmixed(halves(JOB_NO_HIT, INFINITY));
    assert_unmixed(halves(FLAT, INFINITY));
    assert_unmixed(halves(FLAT, 0));
}

static void b16__crease__no_leak(void **state)
{
    (void)state;
    assert_unmixed(halves(TILTED_30, 1));
}

static void filter__within_the_limits__mixed(void **state)
{
    (void)state;
    assert_mixed(halves(FLAT, 1.01f));
    assert_mixed(halves(TILTED_10, 1));
}

static void b16__small_images__existing_pixels_only(void **state)
{
    (void)state;
    for (unsigned width = 1; width <= 6; width++)
        for (unsigned height = 1; height <= 6; height++) {
            canvas c = canvas_create(width, height);
            for (unsigned i = 0; i < width * height; i++)
                canvas_put(&c, i % width, i / width, FLAT, 1, (float)(i % 3) / 2);
            canvas_filter(&c);
            for (unsigned i = 0; i < width * height; i++) {
                double sum = 0, count = 0;
                for (int dy = -1; dy <= 2; dy++)
                    for (int dx = -1; dx <= 2; dx++) {
                        int x = (int)(i % width) + dx, y = (int)(i / width) + dy;
                        if (x < 0 || y < 0 || x >= (int)width || y >= (int)height)
                            continue;
                        sum += (double)((y * (int)width + x) % 3) / 2;
                        count++;
                    }
                assert_true(fabs((double)c.out[i] - sum / count) < 1e-6);
            }
            canvas_destroy(&c);
        }
}

/* No hit is seen as lit, and lights nobody else. */
static void filter__no_hits__one(void **state)
{
    (void)state;
    canvas c = canvas_create(9, 9);
    for (unsigned i = 0; i < 81; i++)
        canvas_put(&c, i % 9, i / 9, i % 2 ? FLAT : JOB_NO_HIT, i % 2 ? 1 : INFINITY, i % 2 ? 0 : 1);
    canvas_filter(&c);
    for (unsigned i = 0; i < 81; i++)
        assert_true(c.out[i] == (i % 2 ? 0.0f : 1.0f));
    canvas_destroy(&c);
}

static uint32_t next_random(uint32_t *state) { return *state = *state * 1664525u + 1013904223u; }

/* Surfaces, depths and visibilities as they come: all windows, all means. */
static void filter__anything__as_the_oracle(void **state)
{
    uint32_t seed = 1;
    (void)state;
    for (unsigned round = 0; round < 60; round++) {
        const float share = 1.0f / (float)(4u << 2 * (round % 6));
        canvas c = canvas_create(33 + round % 17, 18);
        for (unsigned i = 0; i < c.job->width * 18; i++) {
            const uint32_t id = next_random(&seed) >> 8 & 15, depth = next_random(&seed) >> 8 & 7;
            const float seen = share * (float)(next_random(&seed) >> 8 & ((4u << 2 * (round % 6)) - 1));
            canvas_put(&c, i % c.job->width, i / c.job->width, id < 14 ? id % (1 + round % 3) : JOB_NO_HIT,
                       id < 14 ? 1 + 0.004f * (float)depth : INFINITY, id < 14 ? seen : 1);
        }
        canvas_filter(&c);
        canvas_destroy(&c);
    }
}

/* Cosine between the surface of pixel (x, y) and the direction to the light's point, of the front that is seen; 0 without a hit. */
static double lambert(const kernel_job *job, unsigned x, unsigned y)
{
    const job_pixel p = kernel_job_pixel(job, x, y);
    const uint32_t id = job->frame_host[p.tile].id[p.block][p.pixel];
    const job_constants *k = job->constants_host;
    double cosine = 0, side = 0, square = 0, to[3];
    float d[3];
    if (id == JOB_NO_HIT)
        return 0;
    kernel_job_direction(job, x, y, d);
    for (int axis = 0; axis < 3; axis++)
        side += (double)job->normals_host[id][axis] * (double)d[axis];
    for (int axis = 0; axis < 3; axis++) {
        const double n = (side > 0 ? -1 : 1) * (double)job->normals_host[id][axis];
        const double hit = (double)k->origin_box[axis] + (double)job->frame_host[p.tile].t[p.block][p.pixel] * (double)d[axis];
        to[axis] = (double)k->light.point[axis] - (hit + n * (double)k->light.lift);
        cosine += n * to[axis];
        square += to[axis] * to[axis];
    }
    return fmax(0, cosine / sqrt(square));
}

static void check_scene(const scene *s, const char *kernel, unsigned width, unsigned height, unsigned filter)
{
    kernel_params params = kernel_find(kernel)->defaults;
    bvh *tree = trace_tree(s, params.max_leaf);
    float *expected = calloc((size_t)width * height, sizeof *expected);
    params.filter = filter;
    trace_request request = {.kernel = kernel, .tree = tree, .camera = &s->cameras[0], .width = width, .height = height,
                             .params = &params, .light = &s->light};
    kernel_job *job = trace_job(&request);
    assert_non_null(expected);
    assert_int_equal(kernel_job_tiles(job), (1 + filter) * kernel_job_first_pass(job));
    run_tiles(job, kernel, 0);
    if (filter)
        assert_as_oracle(job, expected);
    for (unsigned i = 0; i < width * height; i++) {
        const unsigned x = i % width, y = i / width;
        const job_row *row = kernel_job_row(job, x, y);
        if (fabs((double)row->shading[x % 16] - lambert(job, x, y)) > 2e-6)
            fail_msg("%s, pixel %u,%u: shading %g, not %g", s->name, x, y, (double)row->shading[x % 16], lambert(job, x, y));
        if (!filter)
            assert_true(row->lit[x % 16] == row->shading[x % 16] * row->visibility[x % 16] && row->filtered[x % 16] == 1);
    }
    free(expected);
    kernel_job_destroy(&job);
    bvh_destroy(&tree);
}

static void filter__scenes__as_the_oracle(void **state)
{
    (void)state;
    for (const char *const *name = (const char *const[]){"builtin:rooms-804", "builtin:hall-60k", NULL}; *name; name++) {
        scene *s = NULL;
        assert_int_equal(scene_open(*name, &s, NULL), BASE_OK);
        check_scene(s, "mft-soft", 75, 45, 1);
        check_scene(s, "packet16-soft", 33, 50, 1);
        check_scene(s, "mft-soft", 40, 33, 0);
        scene_destroy(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(b16__silhouette__no_leak),
        cmocka_unit_test(b16__crease__no_leak),
        cmocka_unit_test(filter__within_the_limits__mixed),
        cmocka_unit_test(b16__small_images__existing_pixels_only),
        cmocka_unit_test(filter__no_hits__one),
        cmocka_unit_test(filter__anything__as_the_oracle),
        cmocka_unit_test(filter__scenes__as_the_oracle),
    };
    return cmocka_run_group_tests_name("visibility_filter", tests, NULL, NULL);
}
