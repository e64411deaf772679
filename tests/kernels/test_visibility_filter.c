/* The discontinuity filter: where it must not mix (B16), and what it makes of a penumbra. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>

#include "kernels/visibility_filter.h"
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
    visibility_filter(c.job, c.out);
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
            visibility_filter(c.job, c.out);
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
    visibility_filter(c.job, c.out);
    for (unsigned i = 0; i < 81; i++)
        assert_true(c.out[i] == (i % 2 ? 0.0f : 1.0f));
    canvas_destroy(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(b16__silhouette__no_leak),
        cmocka_unit_test(b16__crease__no_leak),
        cmocka_unit_test(filter__within_the_limits__mixed),
        cmocka_unit_test(b16__small_images__existing_pixels_only),
        cmocka_unit_test(filter__no_hits__one),
    };
    return cmocka_run_group_tests_name("visibility_filter", tests, NULL, NULL);
}
