/* Suite stability: a slice of the hard cases through every kernel; kernels broken on purpose, which the report must tell. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/suites/stability_cases.h"
#include "cli/suites/stability_hard.h"

static sim_machine *machine;

static int open_machine(void **state)
{
    base_error err = {0};
    command_list none = {0};
    (void)state;
    return command_machine("larrabee", &none, &machine, &err) == BASE_OK ? 0 : -1;
}

static int close_machine(void **state)
{
    (void)state;
    sim_machine_destroy(&machine);
    return 0;
}

static const suite_info info = {.name = "stability", .title = "test", .about = ""};

/* The tables of the hard cases with few frames, as JSON: by case, by place and, if a kernel has them, of hard shadows. */
static json_t *tables_of(const stability_kernels *kernels, unsigned frames)
{
    const suite_options options = {.machine = machine};
    suite s = {.info = &info, .options = &options, .jobs = 2, .page = report_page_create("test")};
    base_error err = {0};
    json_t *tables = json_array();
    if (stability_add_hard_cases(&s, kernels, frames, &err) != BASE_OK)
        fail_msg("%s: %s", err.what, err.why);
    for (size_t i = 0; i < s.table_count; i++) {
        json_array_append_new(tables, report_table_json(s.tables[i].table));
        report_table_destroy(&s.tables[i].table);
    }
    free(s.tables);
    report_page_destroy(&s.page);
    return tables;
}

/* A cell by the name of its column; the first column is the group, the kernel. */
static json_t *cell(const json_t *table, size_t row, const char *name)
{
    const json_t *columns = json_object_get(table, "columns"), *cells = json_array_get(json_object_get(table, "rows"), row);
    for (size_t i = 0; i < json_array_size(columns); i++)
        if (strcmp(json_string_value(json_object_get(json_array_get(columns, i), "name")), name) == 0)
            return json_array_get(cells, i);
    fail_msg("no column %s", name);
    return NULL;
}

static long long count_of(const json_t *table, size_t row, const char *name) { return json_integer_value(cell(table, row, name)); }

/* Of the rows of one kernel, `first` the first: shadow rays of every case, of which some are blocked, and nothing lost or wrong. */
static void check_shadows(const json_t *table, size_t first, const char *kernel)
{
    size_t cases;
    const stability_case *list = stability_case_list(&cases);
    for (size_t i = 0; i < cases; i++) {
        assert_string_equal(json_string_value(cell(table, first + i, "group")), kernel);
        assert_string_equal(json_string_value(cell(table, first + i, "case")), list[i].id);
    }
    assert_true(count_of(table, first + cases, "tries") > 10000 && count_of(table, first + cases, "blocked") > 3000);
    assert_int_equal(count_of(table, first + cases, "lost"), 0);
    assert_int_equal(count_of(table, first + cases, "wrong"), 0);
}

static void hard_cases__every_kernel_and_case__tried_hit_and_nothing_lost(void **state)
{
    const command_list all = {0};
    stability_kernels kernels = {0};
    size_t cases, shadow_rows = 0;
    const stability_case *list = stability_case_list(&cases);
    (void)state;
    stability_kernels_choose(&all, true, &kernels);
    json_t *tables = tables_of(&kernels, 1), *table = json_array_get(tables, 0), *shadows = json_array_get(tables, 2);
    for (size_t k = 0; k < kernels.count; k++)
        if (kernels.list[k]->defaults.hard_shadows) {
            check_shadows(shadows, shadow_rows, kernels.list[k]->name);
            shadow_rows += cases + 1;
        }
    assert_int_equal(json_array_size(json_object_get(shadows, "rows")), shadow_rows);
    assert_true(shadow_rows >= 2 * (cases + 1));
    assert_int_equal(json_array_size(json_object_get(table, "rows")), kernels.count * (cases + 1));
    assert_int_equal(json_array_size(json_object_get(json_array_get(tables, 1), "rows")), kernels.count * STABILITY_PLACES);
    for (size_t k = 0; k < kernels.count; k++)
        for (size_t i = 0; i < cases; i++) {
            const size_t row = k * (cases + 1) + i;
            assert_string_equal(json_string_value(cell(table, row, "group")), kernels.list[k]->name);
            assert_string_equal(json_string_value(cell(table, row, "case")), list[i].id);
            assert_true(count_of(table, row, "tries") > 500 && count_of(table, row, "hits") > 20);
            assert_int_equal(count_of(table, row, "lost"), 0);
            if (strcmp(list[i].id, "X5e") == 0) { /* edges do not leak, and there are many rays at them */
                assert_true(count_of(table, row, "at an edge") > 250);
                assert_int_equal(count_of(table, row, "leaks"), 0);
            }
        }
    json_decref(tables);
}

/* packet16-primary, whose first pixel with a hit is then broken. */
typedef void damage_fn(job_frame_tile *frame, unsigned block, unsigned pixel);
static damage_fn *damage;

static void broken_tile(lrb_ctx *c, const kernel_job *job, uint32_t tile, kernel_counts *n)
{
    kernel_find("packet16-primary")->tile[LRB_NATIVE](c, job, tile, n);
    for (unsigned i = 0; i < 256; i++)
        if (job->frame_host[tile].id[i / 16][i % 16] != JOB_NO_HIT && job->tiles_host[tile].pixels[i / 16] >> i % 16 & 1) {
            damage(&job->frame_host[tile], i / 16, i % 16);
            return;
        }
}

static void lose(job_frame_tile *frame, unsigned block, unsigned pixel)
{
    frame->id[block][pixel] = JOB_NO_HIT;
    frame->t[block][pixel] = INFINITY;
}

static void move(job_frame_tile *frame, unsigned block, unsigned pixel) { frame->t[block][pixel] *= 1.5f; }

/* Sums over all cases of a broken kernel. */
static void count_broken(damage_fn *how, long long *lost, long long *wrong, long long *leaks)
{
    kernel_info broken = *kernel_find("packet16-primary");
    const stability_kernels kernels = {.list = {&broken}, .count = 1};
    size_t cases;
    (void)stability_case_list(&cases);
    broken.tile[LRB_NATIVE] = broken_tile;
    damage = how;
    json_t *tables = tables_of(&kernels, 1), *table = json_array_get(tables, 0);
    *lost = count_of(table, cases, "lost");
    *wrong = count_of(table, cases, "wrong");
    *leaks = count_of(table, cases, "leaks");
    json_decref(tables);
}

static void hard_cases__hits_taken_away__lost(void **state)
{
    long long lost, wrong, leaks;
    (void)state;
    count_broken(lose, &lost, &wrong, &leaks);
    assert_true(lost > 50 && leaks >= lost);
    assert_true(wrong <= 1);
}

static void hard_cases__distances_changed__wrong(void **state)
{
    long long lost, wrong, leaks;
    (void)state;
    count_broken(move, &lost, &wrong, &leaks);
    assert_true(wrong > 50 && lost == 0);
}

/* kd16-shadow, which takes what is in the shadow of one tile for lit, or what is lit for dark. */
static bool broken_to_dark;

static void broken_shadows(lrb_ctx *c, const kernel_job *job, uint32_t tile, kernel_counts *n)
{
    kernel_find("kd16-shadow")->tile[LRB_NATIVE](c, job, tile, n);
    for (unsigned i = 0; i < 256; i++)
        job->shadows_host[tile].visibility[i / 16][i % 16] = broken_to_dark ? 0.0f : 1.0f;
}

static void hard_cases__all_shadows_lit_or_dark__lost_or_wrong(void **state)
{
    kernel_info broken = *kernel_find("kd16-shadow");
    const stability_kernels kernels = {.list = {&broken}, .count = 1};
    size_t cases;
    (void)state;
    (void)stability_case_list(&cases);
    broken.tile[LRB_NATIVE] = broken_shadows;
    for (int dark = 0; dark < 2; dark++) {
        broken_to_dark = dark;
        json_t *tables = tables_of(&kernels, 1), *table = json_array_get(tables, 2);
        const long long tries = count_of(table, cases, "tries"), blocked = count_of(table, cases, "blocked");
        const long long lost = count_of(table, cases, "lost"), wrong = count_of(table, cases, "wrong");
        if (dark)
            assert_true(lost == 0 && wrong > (tries - blocked) / 2 && wrong <= tries - blocked);
        else
            assert_true(wrong == 0 && lost > blocked / 2 && lost <= blocked && count_of(table, cases, "leaks") == blocked);
        json_decref(tables);
    }
}

static void frames__all_48__different_and_orthogonal(void **state)
{
    (void)state;
    for (unsigned i = 0; i < STABILITY_FRAMES; i++)
        for (unsigned j = 0; j <= i; j++) {
            const stability_frame a = stability_frame_of(i), b = stability_frame_of(j);
            assert_int_equal(1 << a.axis[0] | 1 << a.axis[1] | 1 << a.axis[2], 7);
            assert_int_equal(memcmp(a.axis, b.axis, sizeof a.axis) == 0 && memcmp(a.sign, b.sign, sizeof a.sign) == 0, i == j);
        }
}

/* Mirrored or not, a camera is one that scenes may have. */
static void look__all_frames__a_valid_camera(void **state)
{
    static const double eye[3] = {0.3, 1, -2}, target[3] = {0.5, 0.1, 0.4};
    (void)state;
    for (unsigned i = 0; i < STABILITY_FRAMES; i++) {
        base_error err = {0};
        stability_scene s = {.machine = machine, .place = {10, 2}, .frame = stability_frame_of(i), .err = &err};
        stability_look(&s, eye, target, 1, 16, 16);
        if (scene_camera_check(&s.camera, &err) != BASE_OK)
            fail_msg("frame %u: %s: %s", i, err.what, err.why);
        stability_scene_clear(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames__all_48__different_and_orthogonal),
        cmocka_unit_test(look__all_frames__a_valid_camera),
        cmocka_unit_test(hard_cases__every_kernel_and_case__tried_hit_and_nothing_lost),
        cmocka_unit_test(hard_cases__hits_taken_away__lost),
        cmocka_unit_test(hard_cases__distances_changed__wrong),
        cmocka_unit_test(hard_cases__all_shadows_lit_or_dark__lost_or_wrong),
    };
    return cmocka_run_group_tests_name("suite stability", tests, open_machine, close_machine);
}
