/* The simple shader against Lambert's law in double, in all kernels that have it, and that it changes no hit. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "kernels/accel/box.h"
#include "tests/kernels/accel/soup.h"
#include "tests/kernels/trace.h"

/* Of |n.d|/|d|: normals are unit length to 2^-24 a component, the cosine has three roundings of that size, the root is within 2^-21. */
static const double tolerance = 0x1p-20;

enum { WIDTH = 75, HEIGHT = 53 }; /* tiles and blocks are cut off */

static const char *const kernels[] = {"packet16-primary", "packet256-primary", "mft-primary", "kd16-primary", "mlrta-primary"};
enum { KERNELS = sizeof kernels / sizeof *kernels };

/* The cosine between a pixel's ray and the triangle that it hits; 0 without a hit. */
static double cosine_of(const scene *s, const kernel_job *job, unsigned x, unsigned y, uint32_t id)
{
    float direction[3];
    double n[3], dot = 0, d2 = 0, n2 = 0;
    if (id == JOB_NO_HIT)
        return 0;
    kernel_job_direction(job, x, y, direction);
    accel_triangle_normal(&s->triangles[id], n);
    for (int axis = 0; axis < 3; axis++) {
        dot += n[axis] * (double)direction[axis];
        d2 += (double)direction[axis] * (double)direction[axis];
        n2 += n[axis] * n[axis];
    }
    return fabs(dot) / sqrt(d2 * n2);
}

/* Returns the number of pixels with a hit. */
static size_t check_picture(const scene *s, const trace_request *request, const trace_picture *p)
{
    kernel_job *job = trace_job(request);
    size_t hits = 0;
    for (size_t i = 0; i < p->pixels; i++) {
        const unsigned x = (unsigned)(i % WIDTH), y = (unsigned)(i / WIDTH);
        const double expected = cosine_of(s, job, x, y, p->id[i]);
        hits += p->id[i] != JOB_NO_HIT;
        if (!(fabs((double)p->lit[i] - expected) <= (p->id[i] == JOB_NO_HIT ? 0 : tolerance)))
            fail_msg("%s, %s, pixel %u,%u: %.9g, in double %.9g", s->name, request->kernel, x, y, (double)p->lit[i], expected);
    }
    kernel_job_destroy(&job);
    return hits;
}

/* A kernel on a scene, at all levels: shades as in double, hits and other counts as without a shader. */
static trace_picture check_kernel(const scene *s, const char *name, const scene_camera *camera, size_t *hits)
{
    const kernel_info *kernel = kernel_find(name);
    trace_trees trees = trace_trees_of(kernel, s, camera);
    kernel_params params = kernel->defaults;
    trace_request request = {.kernel = name, .tree = trees.tree, .kdtree = trees.kdtree, .camera = camera, .width = WIDTH, .height = HEIGHT,
                             .params = &params, .jobs = 2};
    trace_picture plain = trace_run(&request);
    params.shader = KERNEL_SHADER_SIMPLE;
    trace_picture shaded = trace_run(&request);
    memcpy(plain.lit, shaded.lit, plain.pixels * sizeof *plain.lit); /* these alone may differ */
    trace_assert_equal(&plain, &shaded, name);
    assert_memory_equal(&plain.counts, &shaded.counts, sizeof plain.counts);
    *hits = check_picture(s, &request, &shaded);
    for (request.level = LRB_COUNT; request.level <= LRB_RECORD; request.level++) {
        trace_picture other = trace_run(&request);
        trace_assert_equal(&shaded, &other, name);
        trace_free(&other);
    }
    trace_free(&plain);
    trace_trees_destroy(&trees);
    return shaded;
}

/* All kernels leave the same bits. */
static void check_scene(const scene *s, const scene_camera *camera, size_t least_hits, size_t most_hits)
{
    size_t hits;
    trace_picture first = check_kernel(s, kernels[0], camera, &hits);
    assert_in_range(hits, least_hits, most_hits);
    for (int k = 1; k < KERNELS; k++) {
        trace_picture other = check_kernel(s, kernels[k], camera, &hits);
        trace_assert_equal(&first, &other, kernels[k]);
        trace_free(&other);
    }
    trace_free(&first);
}

static void shade__rooms__lambert(void **state)
{
    scene *s = NULL;
    (void)state;
    assert_int_equal(scene_open("builtin:rooms-804", &s, NULL), BASE_OK);
    check_scene(s, &s->cameras[0], WIDTH * HEIGHT / 2, WIDTH * HEIGHT);
    scene_destroy(&s);
}

/* Triangles here and there, of all sizes, some needles: hits and misses in one block, rays of all signs. */
static void shade__random_triangles__lambert(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 3; seed++) {
        static const double eye[3] = {0.1, 0.2, 0.3}, target[3] = {1, 0.3, -0.2}, up[3] = {0, 1, 0};
        const scene_camera camera = scene_camera_look_at("inside", eye, target, up, 1.2);
        scene s = soup_random(seed, 200, 0.5);
        check_scene(&s, &camera, 100, WIDTH * HEIGHT - 100);
        soup_free(&s);
    }
}

static void shade__nothing_in_sight__zero(void **state)
{
    static const double eye[3] = {0, 0, 30}, target[3] = {0, 0, 60}, up[3] = {0, 1, 0};
    const scene_camera camera = scene_camera_look_at("away", eye, target, up, 0.6);
    scene s = soup_random(1, 20, 0.5);
    (void)state;
    check_scene(&s, &camera, 0, 0);
    soup_free(&s);
}

/* Only kernels of primary rays alone take a shader. */
static void shade__other_kernels__refused(void **state)
{
    size_t count, takers = 0;
    const kernel_info *list = kernel_list(&count);
    (void)state;
    for (size_t k = 0; k < count; k++) {
        kernel_params p = list[k].defaults;
        const bool taken = kernel_params_set(&p, list[k].params, "shader=simple", NULL) == BASE_OK;
        takers += taken;
        assert_int_equal(taken, p.shader == KERNEL_SHADER_SIMPLE);
        assert_false(taken && (p.samples || p.hard_shadows || p.msaa));
    }
    assert_int_equal(takers, KERNELS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shade__rooms__lambert),
        cmocka_unit_test(shade__random_triangles__lambert),
        cmocka_unit_test(shade__nothing_in_sight__zero),
        cmocka_unit_test(shade__other_kernels__refused),
    };
    return cmocka_run_group_tests_name("shade", tests, NULL, NULL);
}
