/* Parameters, jobs and the registry of kernels: what is taken, what is refused, and how the refusals read. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/kernels/accel/soup.h"
#include "tests/kernels/trace.h"

static void params_set__known_keys__fields_set(void **state)
{
    kernel_params p = {0};
    (void)state;
    assert_int_equal(kernel_params_set(&p, UINT64_MAX, "cull_backface=1", NULL), BASE_OK);
    assert_int_equal(kernel_params_set(&p, UINT64_MAX, "max_leaf=64", NULL), BASE_OK);
    assert_int_equal(kernel_params_set(&p, UINT64_MAX, "bins=2", NULL), BASE_OK);
    assert_int_equal(p.cull_backface, 1);
    assert_int_equal(p.max_leaf, 64);
    assert_int_equal(p.bins, 2);
    assert_int_equal(kernel_params_set(&p, UINT64_MAX, "cull_backface=0", NULL), BASE_OK);
    assert_int_equal(p.cull_backface, 0);
}

static void params_set__every_listed_key__its_limits_hold(void **state)
{
    size_t count;
    const kernel_param_info *list = kernel_param_list(&count);
    (void)state;
    assert_true(count > 0);
    for (size_t i = 0; i < count; i++) {
        kernel_params p = {0}, before;
        char text[64];
        unsigned ends[2] = {list[i].min, list[i].max};
        if (list[i].values)
            continue;
        for (int k = 0; k < 2; k++) {
            snprintf(text, sizeof text, "%s=%u", list[i].name, ends[k]);
            assert_int_equal(kernel_params_set(&p, UINT64_MAX, text, NULL), BASE_OK);
            assert_int_equal(*(unsigned *)((char *)&p + list[i].offset), ends[k]);
        }
        before = p;
        snprintf(text, sizeof text, "%s=%u", list[i].name, list[i].max + 1);
        assert_int_equal(kernel_params_set(&p, UINT64_MAX, text, NULL), BASE_ERR_USAGE);
        if (list[i].min > 0) {
            snprintf(text, sizeof text, "%s=%u", list[i].name, list[i].min - 1);
            assert_int_equal(kernel_params_set(&p, UINT64_MAX, text, NULL), BASE_ERR_USAGE);
        }
        assert_memory_equal(&p, &before, sizeof p);
        assert_true(strlen(list[i].sentence) > 0);
    }
}

static void params_set__named_values__every_name_taken(void **state)
{
    size_t count;
    const kernel_param_info *list = kernel_param_list(&count);
    (void)state;
    for (size_t i = 0; i < count; i++)
        for (unsigned value = list[i].min; list[i].values && value <= list[i].max; value++) {
            kernel_params p = {0};
            char text[64];
            snprintf(text, sizeof text, "%s=%s", list[i].name, list[i].values[value]);
            assert_int_equal(kernel_params_set(&p, UINT64_MAX, text, NULL), BASE_OK);
            assert_int_equal(kernel_param_get(&p, &list[i]), value);
        }
}

static void params_set__no_such_value__names_listed(void **state)
{
    kernel_params p = {.shrink = KERNEL_SHRINK_RAYS};
    base_error err = {0};
    (void)state;
    static const char *bad[] = {"shrink=", "shrink=1", "shrink=NONE", "shrink=frust", "shrink=frustaa"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        assert_int_equal(kernel_params_set(&p, UINT64_MAX, bad[i], &err), BASE_ERR_USAGE);
        assert_non_null(strstr(err.why, "none, corner-rays, frusta, ray-aabb"));
        assert_int_equal(p.shrink, KERNEL_SHRINK_RAYS);
    }
}

/* What a kernel does not take is refused as if it were not there. */
static void params_set__not_taken__usage_error(void **state)
{
    const kernel_info *primary = kernel_find("mft-primary");
    kernel_params p = {0};
    base_error err = {0};
    (void)state;
    assert_int_equal(kernel_params_set(&p, primary->params, "shrink=none", &err), BASE_ERR_USAGE);
    assert_null(strstr(err.why, "shrink,"));
    assert_non_null(strstr(err.why, "(there are cull_backface, max_leaf, bins, shader)"));
}

static void check_samples__powers_of_four__taken(void **state)
{
    (void)state;
    for (unsigned long n = 0; n < 20000; n++) {
        int power = n == 4 || n == 16 || n == 64 || n == 256 || n == 1024 || n == 4096;
        assert_int_equal(kernel_params_check_samples(n, NULL), power ? BASE_OK : BASE_ERR_USAGE);
    }
}

static void params_set__malformed__usage_error_and_unchanged(void **state)
{
    static const char *bad[] = {"", "=", "=1", "cull_backface", "cull_backface=", "cull_backface=2", "cull_backface=-1",
                                "cull_backface=+1", "cull_backface= 1", "cull_backface=1 ", "cull_backface=1x", "cull_backface=0x1",
                                "max_leaf=0", "max_leaf=65", "max_leaf=4294967297", "max_leaf=99999999999999999999", "max_leaf=2.0",
                                "max_lea=2", "max_leaff=2", "MAX_LEAF=2", "bins=1", "bins=65", "no_such=1", "bins==4"};
    kernel_params p = {.cull_backface = 1, .max_leaf = 5, .bins = 7}, before = p;
    (void)state;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        base_error err = {0};
        if (kernel_params_set(&p, UINT64_MAX, bad[i], &err) != BASE_ERR_USAGE)
            fail_msg("'%s' was not refused", bad[i]);
        assert_memory_equal(&p, &before, sizeof p);
        assert_int_equal(err.status, BASE_ERR_USAGE);
        assert_string_equal(err.what, "--param");
        assert_true(strlen(err.why) > 0 && !strchr(err.why, '\n'));
    }
}

static void params_set__errors__name_the_parameter(void **state)
{
    kernel_params p = {0};
    base_error err = {0};
    (void)state;
    kernel_params_set(&p, UINT64_MAX, "max_leaf=65", &err);
    assert_non_null(strstr(err.why, "max_leaf"));
    assert_non_null(strstr(err.why, "1..64"));
    kernel_params_set(&p, UINT64_MAX, "speed=65", &err);
    assert_non_null(strstr(err.why, "speed"));
    assert_null(strstr(err.why, "speed=65"));
}

/* A message that lists the parameters has to list all of them. */
static void params_set__unknown_key__all_keys_listed(void **state)
{
    kernel_params p = {0};
    base_error err = {0};
    size_t count;
    const kernel_param_info *list = kernel_param_list(&count);
    (void)state;
    kernel_params_set(&p, UINT64_MAX, "speed=65", &err);
    for (size_t i = 0; i < count; i++)
        if (!strstr(err.why, list[i].name))
            fail_msg("'%s' is not in '%s'", list[i].name, err.why);
}

static scene_camera some_camera(void)
{
    static const double eye[3] = {0, 0, 3}, target[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    return scene_camera_look_at("some", eye, target, up, 0.8);
}

static void job_create__size_out_of_range__usage_error(void **state)
{
    static const unsigned sizes[][2] = {{0, 1}, {1, 0}, {0, 0}, {100000, 100000}, {JOB_MAX_SIZE + 1, 1}, {1, JOB_MAX_SIZE + 1},
                                        {4294967295u, 4294967295u}};
    scene s = soup_random(1, 10, 0.3);
    scene_camera camera = some_camera();
    bvh *tree = trace_tree(&s, 2);
    kernel_params params = kernel_find("mft-primary")->defaults;
    (void)state;
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        kernel_job *job = NULL;
        base_error err = {0};
        assert_int_equal(kernel_job_create(tree, &camera, NULL, sizes[i][0], sizes[i][1], &params, &job, &err), BASE_ERR_USAGE);
        assert_null(job);
        assert_string_equal(err.what, "--size");
    }
    bvh_destroy(&tree);
    soup_free(&s);
}

static void job_create__largest_edge__laid_out(void **state)
{
    scene s = soup_random(1, 10, 0.3);
    scene_camera camera = some_camera();
    bvh *tree = trace_tree(&s, 2);
    kernel_params params = kernel_find("mft-primary")->defaults;
    kernel_job *job = NULL;
    base_error err = {0};
    (void)state;
    assert_int_equal(kernel_job_create(tree, &camera, NULL, JOB_MAX_SIZE, 1, &params, &job, &err), BASE_OK);
    assert_int_equal(kernel_job_tiles(job), JOB_MAX_SIZE / JOB_TILE_PIXELS);
    kernel_job_destroy(&job);
    assert_null(job);
    kernel_job_destroy(&job); /* NULL is fine */
    bvh_destroy(&tree);
    soup_free(&s);
}

/* What an image's pixels are, and where their results lie: every pixel once, tiles and blocks row by row. */
static void job__odd_size__every_pixel_has_one_place(void **state)
{
    enum { W = 37, H = 21 };
    scene s = soup_random(1, 10, 0.3);
    scene_camera camera = some_camera();
    bvh *tree = trace_tree(&s, 2);
    kernel_params params = kernel_find("mft-primary")->defaults;
    kernel_job *job = NULL;
    (void)state;
    assert_int_equal(kernel_job_create(tree, &camera, NULL, W, H, &params, &job, NULL), BASE_OK);
    unsigned char seen[6 * 256] = {0};
    assert_int_equal(kernel_job_tiles(job), 6);
    for (unsigned y = 0; y < H; y++)
        for (unsigned x = 0; x < W; x++) {
            job_pixel p = kernel_job_pixel(job, x, y);
            const job_tile *t = &job->tiles_host[p.tile];
            assert_true(t->pixels[p.block] >> p.pixel & 1);
            assert_true(t->blocks >> p.block & 1);
            assert_int_equal(seen[p.tile * 256 + p.block * 16 + p.pixel]++, 0);
        }
    unsigned in_image = 0;
    for (uint32_t tile = 0; tile < 6; tile++)
        for (int block = 0; block < 16; block++)
            in_image += (unsigned)__builtin_popcount(job->tiles_host[tile].pixels[block]);
    assert_int_equal(in_image, W * H);
    kernel_job_destroy(&job);
    bvh_destroy(&tree);
    soup_free(&s);
}

/* The contract's formula for the direction of a pixel, in double, against the bits that are traced. */
static void job__directions__those_of_the_contract(void **state)
{
    enum { W = 83, H = 61 };
    scene s = soup_random(1, 10, 0.3);
    scene_camera camera = some_camera();
    bvh *tree = trace_tree(&s, 2);
    oracle_ray *rays = calloc(W * H, sizeof *rays);
    (void)state;
    assert_non_null(rays);
    trace_rays(tree, &camera, W, H, rays);
    for (unsigned i = 0; i < W * H; i++) {
        double half = tan(camera.yfov / 2);
        double sy = half * (1 - 2 * (i / W + 0.5) / H), sx = half * ((double)W / H) * (2 * (i % W + 0.5) / W - 1);
        for (int k = 0; k < 3; k++) {
            double d = camera.forward[k] + sx * camera.right[k] + sy * camera.up[k];
            assert_true(fabs(d - (double)rays[i].dir[k]) < 2e-6);
        }
    }
    free(rays);
    bvh_destroy(&tree);
    soup_free(&s);
}

static void registry__names__found_and_unique(void **state)
{
    size_t count;
    const kernel_info *list = kernel_list(&count);
    (void)state;
    assert_true(count >= 2);
    for (size_t i = 0; i < count; i++) {
        assert_ptr_equal(kernel_find(list[i].name), &list[i]);
        for (size_t j = 0; j < i; j++)
            assert_string_not_equal(list[i].name, list[j].name);
        for (int level = 0; level < LRB_LEVELS; level++)
            assert_non_null(list[i].tile[level]);
        assert_true(strlen(list[i].summary) > 0 && strlen(list[i].paper) > 0);
        assert_true(list[i].counters >> KERNEL_rays & 1);
        assert_int_equal(list[i].counters >> KERNEL_COUNTER_COUNT, 0);
    }
}

static void registry__other_names__null(void **state)
{
    static const char *bad[] = {"", "mft", "mft-primary ", "MFT-primary", "mft-primaryy", "packet16"};
    (void)state;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_null(kernel_find(bad[i]));
}

/* The defaults have to be values that --param takes. */
static void registry__defaults__within_the_limits(void **state)
{
    size_t count, rows;
    const kernel_info *list = kernel_list(&count);
    const kernel_param_info *table = kernel_param_list(&rows);
    (void)state;
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < rows; k++) {
            unsigned value = *(const unsigned *)((const char *)&list[i].defaults + table[k].offset);
            if (list[i].params >> k & 1)
                assert_in_range(value, table[k].min, table[k].max);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(params_set__known_keys__fields_set),
        cmocka_unit_test(params_set__every_listed_key__its_limits_hold),
        cmocka_unit_test(params_set__named_values__every_name_taken),
        cmocka_unit_test(params_set__no_such_value__names_listed),
        cmocka_unit_test(params_set__not_taken__usage_error),
        cmocka_unit_test(check_samples__powers_of_four__taken),
        cmocka_unit_test(params_set__malformed__usage_error_and_unchanged),
        cmocka_unit_test(params_set__errors__name_the_parameter),
        cmocka_unit_test(params_set__unknown_key__all_keys_listed),
        cmocka_unit_test(job_create__size_out_of_range__usage_error),
        cmocka_unit_test(job_create__largest_edge__laid_out),
        cmocka_unit_test(job__odd_size__every_pixel_has_one_place),
        cmocka_unit_test(job__directions__those_of_the_contract),
        cmocka_unit_test(registry__names__found_and_unique),
        cmocka_unit_test(registry__other_names__null),
        cmocka_unit_test(registry__defaults__within_the_limits),
    };
    return cmocka_run_group_tests_name("params", tests, NULL, NULL);
}
