/* The counters of soft shadows, S-Packet and S-Frusta of the MFT paper's Table 1, as plain scalar twins count them (algorithms A.3). */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lrbni/base/random.h"
#include "scene/builtin.h"
#include "tests/kernels/accel/soup.h"
#include "tests/kernels/trace.h"
#include "tests/kernels/twin_soft.h"

enum { KERNELS = 2 };
static const char *const kernel_names[KERNELS] = {"packet16-soft", "mft-soft"};

/* Returns the shadow rays: none if the light shines away from all that is seen. */
static uint64_t check(const scene *s, const scene_camera *camera, unsigned w, unsigned h, unsigned cull, unsigned samples, const char *what)
{
    uint64_t rays = 0;
    for (int k = 0; k < KERNELS; k++) {
        kernel_params params = kernel_find(kernel_names[k])->defaults;
        params.samples = samples;
        bvh *tree = trace_tree(s, params.max_leaf);
        const trace_request request = {.kernel = kernel_names[k], .tree = tree, .camera = camera, .width = w, .height = h, .cull = cull,
                                       .params = &params, .light = &s->light, .level = LRB_NATIVE, .jobs = 1};
        trace_picture kernel = trace_run(&request), twin = twin_soft_trace(&request);
        memcpy(twin.filtered, kernel.filtered, twin.pixels * sizeof *twin.filtered); /* have a test of their own, kernels/visibility_filter */
        memcpy(twin.lit, kernel.lit, twin.pixels * sizeof *twin.lit);
        trace_assert_equal(&kernel, &twin, what);
        for (int i = 0; i < KERNEL_COUNTER_COUNT; i++)
            if (kernel.counts.n[i] != twin.counts.n[i])
                fail_msg("%s, %s: %s is %llu, the twin's is %llu", what, kernel_names[k], kernel_counter_table[i].name,
                         (unsigned long long)kernel.counts.n[i], (unsigned long long)twin.counts.n[i]);
        rays = kernel.counts.n[KERNEL_rays_shadow];
        trace_free(&kernel);
        trace_free(&twin);
        bvh_destroy(&tree);
    }
    return rays;
}

/* A light near the eye, of a random size, that shines to the side of the target. */
static void place_light(scene_light *light, base_random *r, const double eye[3], const double target[3], double size)
{
    double side = 0;
    for (int k = 0; k < 3; k++) {
        light->corner[k] = eye[k] + base_random_range(r, -size, size) / 2;
        light->u[k] = base_random_range(r, -size, size) / 4;
        light->v[k] = base_random_range(r, -size, size) / 4;
    }
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        side += (light->u[i] * light->v[j] - light->u[j] * light->v[i]) * (target[k] - light->corner[k]);
    }
    for (int k = 0; k < 3 && side < 0; k++)
        light->u[k] = -light->u[k];
}

/* A soup looked at from outside. */
static void check_soup(scene s, double size, uint64_t seed, int pictures)
{
    static const unsigned samples[3] = {16, 4, 64};
    base_random r = {seed};
    uint64_t rays = 0;
    for (int i = 0; i < pictures; i++) {
        double eye[3], target[3], up[3];
        char what[128];
        for (int k = 0; k < 3; k++) {
            eye[k] = base_random_range(&r, -2 * size, 2 * size);
            target[k] = base_random_range(&r, -size / 2, size / 2);
            up[k] = base_random_range(&r, -1, 1);
        }
        place_light(&s.light, &r, eye, target, size);
        scene_camera camera = scene_camera_look_at("random", eye, target, up, base_random_range(&r, 0.3, 1.5));
        snprintf(what, sizeof what, "soup '%.40s', picture %d", s.name, i);
        rays += check(&s, &camera, 45, 38, (unsigned)i & 1, samples[i % 3], what);
    }
    assert_true(rays > 1000);
    soup_free(&s);
}

static void soft_counts__soups__as_the_twins(void **state)
{
    (void)state;
    check_soup(soup_random(51, 600, 0.25), 1, 1, 12);
    check_soup(soup_clustered(52, 800), 10, 2, 6);
    check_soup(soup_coplanar(54, 300), 1, 4, 6);
}

static void soft_counts__smallest_builtin_scene__as_the_twins(void **state)
{
    scene *s = NULL;
    (void)state;
    assert_int_equal(scene_open("builtin:rooms-804", &s, NULL), BASE_OK);
    for (unsigned cull = 0; cull < 2; cull++)
        assert_true(check(s, &s->cameras[0], 70, 52, cull, 16, "rooms-804") > 1000);
    scene_destroy(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(soft_counts__soups__as_the_twins),
        cmocka_unit_test(soft_counts__smallest_builtin_scene__as_the_twins),
    };
    return cmocka_run_group_tests_name("soft_counts", tests, NULL, NULL);
}
