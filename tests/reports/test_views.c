/* Views: tables from plain numbers, beside the paper's. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <jansson.h>
#include <math.h>
#include <string.h>

#include "reports/paper.h"
#include "reports/views/mft_prediction.h"
#include "reports/views/mft_table1.h"
#include "reports/views/model_speeds.h"

/* A cell of a table's JSON. */
static const json_t *cell(const json_t *table, size_t row, const char *column)
{
    size_t i;
    json_t *c;
    json_array_foreach(json_object_get(table, "columns"), i, c)
        if (strcmp(json_string_value(json_object_get(c, "name")), column) == 0)
            return json_array_get(json_array_get(json_object_get(table, "rows"), row), i);
    fail_msg("no column %s", column);
    return NULL;
}

static double number(const json_t *table, size_t row, const char *column) { return json_number_value(cell(table, row, column)); }

static json_t *json_of(report_table *table)
{
    assert_non_null(table);
    json_t *json = report_table_json(table);
    assert_non_null(json);
    report_table_destroy(&table);
    return json;
}

static void paper__rows_of_table_1__whole_and_doubts_named(void **state)
{
    (void)state;
    for (size_t scene = 0; scene < MFT_SCENES; scene++)
        for (int a = 0; a < MFT_ALGORITHMS; a++) {
            const mft_paper_row row = mft_paper_row_of(scene, (mft_algorithm)a);
            for (int m = 0; m < MFT_METRICS; m++)
                assert_true(row.value[m] > 0);
        }
    assert_string_equal(mft_paper_row_of(0, MFT_P_PACKET).doubt, "inferred: after culling");
    assert_string_equal(mft_paper_row_of(1, MFT_S_PACKET).doubt, "uncertain: after culling, cycles");
    assert_string_equal(mft_paper_row_of(2, MFT_S_FRUSTA).doubt, "");
    assert_int_equal(mft_scene_of("hall-60k"), 2);
    assert_int_equal(mft_scene_of("hall-60"), MFT_SCENES);
    assert_true(isnan(mft_paper_value(0, MFT_S_PACKET, "cycles_with_shading")));
    assert_null(report_paper_entry("mft_table1", "T-Rex", "P-Packet", "cycles"));
}

/* Two scenes of which every event costs what `cost` says, on two machines, of which the second is twice as dear. */
static void make_events(mft_events events[8], const double cost[MFT_EVENTS])
{
    size_t count = 0;
    for (size_t machine = 0; machine < 2; machine++)
        for (int a = 0; a < 2; a++)
            for (int scene = 0; scene < 2; scene++) {
                mft_events *e = &events[count++];
                *e = (mft_events){.machine = machine, .algorithm = (mft_algorithm)a, .scene = scene ? "b" : "a"};
                for (int k = 0; k < MFT_EVENTS; k++) {
                    e->events[k] = 100 * (scene + 1) * (k + 1);
                    e->cycles[k] = e->events[k] * cost[k] * (double)(machine + 1);
                }
            }
}

static void prediction__known_costs__known_cycles(void **state)
{
    (void)state;
    const char *const machines[] = {"one", "two"};
    const double cost[MFT_EVENTS] = {4, 20, 30, 50};
    mft_events events[8];
    make_events(events, cost);
    const mft_measured m = {machines, 2, events, 8, 2};
    json_t *rows = json_of(mft_prediction_rows(&m, NULL)), *costs = json_of(mft_prediction_costs(&m, NULL));
    /* T-Rex, P-Packet: 1218K boxes or pairs, 399K accesses, 399K tests, 94.1M cycles */
    const double box = 4 * 1048576.0 + 20 * 1218e3 + 30 * 399e3 + 50 * 399e3, pair = box + 20 * 1218e3;
    assert_true(fabs(number(rows, 0, "predicted") - box) < 1);
    assert_true(fabs(number(rows, 8, "predicted") - pair) < 1);
    assert_true(fabs(number(rows, 16, "predicted") - 2 * box) < 1);
    assert_true(fabs(number(rows, 0, "error") - 100 * (box / 94.1e6 - 1)) < 0.06);
    assert_true(fabs(number(rows, 0, "AABB tests") - 100 * 20 * 1218e3 / box) < 0.06);
    assert_string_equal(json_string_value(cell(rows, 8, "group")), "one; a test is a pair");
    assert_true(number(costs, 1, "cycles") == 20 && number(costs, 1, "least scene") == 20 && number(costs, 9, "cycles") == 40);
    json_decref(rows);
    json_decref(costs);
}

static void prediction__event_that_did_not_happen__rows_missing_and_said(void **state)
{
    (void)state;
    const char *const machines[] = {"one", "two"};
    const double cost[MFT_EVENTS] = {4, 20, 30, 50};
    mft_events events[8];
    make_events(events, cost);
    for (int i = 0; i < 8; i++)
        if (events[i].algorithm == MFT_P_FRUSTA)
            events[i].events[MFT_EVENT_ISECT] = events[i].cycles[MFT_EVENT_ISECT] = 0;
    const mft_measured m = {machines, 2, events, 8, 2};
    json_t *rows = json_of(mft_prediction_rows(&m, NULL)), *summary = json_of(mft_prediction_summary(&m, NULL));
    assert_true(json_is_null(cell(rows, 1, "predicted")) && json_is_null(cell(rows, 1, "error")));
    assert_true(json_is_null(cell(summary, 0, "frusta, worst")));
    assert_true(number(summary, 0, "packets, worst") == number(summary, 0, "all, worst"));
    assert_int_equal(json_array_size(json_object_get(summary, "notes")), 3);
    json_decref(rows);
    json_decref(summary);
}

static void table1__large_difference__in_words_and_a_small_one_not(void **state)
{
    (void)state;
    mft_row rows[] = {{.scene = "hall-60k", .algorithm = MFT_P_PACKET, .pixels = 1048576, .value = {383e3, 278e3, 5830e3, 278e3, 246.9e6}, .memory = 0.25},
                      {.scene = "hall-60k", .algorithm = MFT_P_FRUSTA, .pixels = 1048576, .value = {204e3, 34e3, 388e3, 150e3, 31.5e6}}};
    json_t *same = json_of(mft_table1_differences(rows, 2));
    assert_int_equal(json_array_size(json_object_get(same, "rows")), 0);
    json_decref(same);
    rows[1].value[MFT_CYCLES] *= 1.26;
    json_t *other = json_of(mft_table1_differences(rows, 2));
    const char *words = json_string_value(cell(other, 0, "in words"));
    assert_non_null(strstr(words, "P-Packet has 1.00 times the published triangle accesses"));
    assert_non_null(strstr(words, "25% of them waiting for memory"));
    assert_non_null(strstr(words, "1.26 times the cycles"));
    json_decref(other);
}

static void models__median_and_worst__by_size(void **state)
{
    (void)state;
    const model_speed rows[] = {
        {"a", "k", "native", "", 1, 1, false, 0, 1000, 0, 0}, {"a", "k", "count", "", 2, 1, true, 900, 1000, 0, 0}, {"a", "k", "core", "", 50, 1, true, 1000, 1000, 0, 0},
        {"b", "k", "native", "", 2, 2, false, 0, 2000, 0, 0}, {"b", "k", "count", "", 8, 2, true, 2600, 2000, 0, 0}, {"b", "k", "core", "", 40, 2, true, 2000, 2000, 3, 9},
    };
    model_speed_series series;
    json_t *summary = json_of(model_speeds_summary(rows, 6, NULL)), *table = json_of(model_speeds_table(rows, 6, NULL));
    assert_true(number(summary, 1, "error, worst") == 30 && number(summary, 1, "error, median") == 20);
    assert_true(number(summary, 1, "x native, median") == 3 && number(summary, 2, "x native, worst") == 50);
    assert_true(json_is_null(cell(summary, 0, "error, median")) && json_is_null(cell(table, 3, "cycles")));
    assert_true(number(table, 1, "error") == -10 && number(table, 5, "tiles simulated") == 3);
    assert_int_equal(model_speed_series_create(rows, 6, &series, NULL), BASE_OK);
    assert_int_equal(series.count, 1); /* native has no error, and core's is 0 */
    assert_true(series.series[0].x[1] == 4 && fabs(series.series[0].y[1] - 30) < 1e-9);
    model_speed_series_destroy(&series);
    json_decref(summary);
    json_decref(table);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(paper__rows_of_table_1__whole_and_doubts_named),
        cmocka_unit_test(prediction__known_costs__known_cycles),
        cmocka_unit_test(prediction__event_that_did_not_happen__rows_missing_and_said),
        cmocka_unit_test(table1__large_difference__in_words_and_a_small_one_not),
        cmocka_unit_test(models__median_and_worst__by_size),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
