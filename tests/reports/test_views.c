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
#include "reports/views/mft_light_size.h"
#include "reports/views/mft_packet256.h"
#include "reports/views/mft_prediction.h"
#include "reports/views/mft_quality.h"
#include "reports/views/mft_table1.h"
#include "reports/views/mft_table2.h"
#include "reports/views/mlrta_adaptive.h"
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

/* The reading with the least error is the one whose costs were chosen; a row that it is far off in is put down to its main event. */
static void prediction__far_row__the_event_that_makes_it_so(void **state)
{
    (void)state;
    const char *const machines[] = {"one", "two"};
    const double cost[MFT_EVENTS] = {0, 1000, 0, 0};
    mft_events events[8];
    make_events(events, cost);
    const mft_measured m = {machines, 2, events, 8, 2};
    json_t *far = json_of(mft_prediction_far(&m)), *left = json_of(mft_prediction_left(&m, NULL));
    assert_true(fabs(number(left, 0, "T-Rex (69K tri)") - 94.1e6 / 1218e3) < 0.06 && number(left, 0, "a box costs here") == 1000);
    json_decref(left);
    assert_int_equal(json_array_size(json_object_get(far, "rows")), 8);
    assert_string_equal(json_string_value(cell(far, 0, "most cycles are for")), "AABB test, a box");
    assert_true(fabs(number(far, 0, "cost that would be right") - 94.1e6 / 1218e3) < 0.06);
    assert_true(number(far, 0, "share") == 100 && number(far, 0, "one") == 1000 && number(far, 0, "two") == 2000);
    assert_true(fabs(number(far, 0, "error") - 100 * (1218e3 * 1000 / 94.1e6 - 1)) < 0.06);
    json_decref(far);
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
    assert_true(json_is_null(cell(summary, 0, "P-Frusta, worst")));
    assert_true(number(summary, 0, "P-Packet, worst") == number(summary, 0, "all, worst"));
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

static void paper__rows_of_table_2__doubts_named_and_absent_cells_missing(void **state)
{
    (void)state;
    for (size_t shrink = 0; shrink < MFT_SHRINKS; shrink++) {
        const mft_paper_row row = mft_paper_shrink_row(shrink);
        for (int m = 0; m < MFT_CYCLES; m++)
            assert_true(row.value[m] > 0 && isnan(mft_paper_shrink_change(shrink, (mft_metric)m)) == (shrink == 0));
        assert_true(isnan(row.value[MFT_CYCLES]));
        assert_string_equal(row.doubt, strcmp(mft_shrink_names[shrink], "CR") == 0 ? "uncertain: after culling" : "");
    }
    assert_true(isnan(mft_paper_additional_tests(0)) && mft_paper_additional_tests(1) == 386e3);
    assert_true(fabs(mft_paper_shrink_change(3, MFT_AABB) - 155) < 1e-9);
}

/* The counts of the paper, on the scene that stands in for its own. */
static void fill_shrink_rows(mft_shrink_row rows[MFT_SHRINKS], const char *scene)
{
    for (size_t shrink = 0; shrink < MFT_SHRINKS; shrink++) {
        rows[shrink] = (mft_shrink_row){.scene = scene, .shrink = shrink, .additional = mft_paper_additional_tests(shrink), .frame = 1000 - 50 * (double)shrink};
        for (int m = 0; m < MFT_CYCLES; m++)
            rows[shrink].value[m] = mft_paper_shrink_row(shrink).value[m];
        rows[shrink].value[MFT_CYCLES] = 800 - 40 * (double)shrink;
    }
}

static void table2__counts_of_the_paper__its_changes(void **state)
{
    (void)state;
    mft_shrink_row rows[MFT_SHRINKS];
    fill_shrink_rows(rows, "creature-69k");
    json_t *changes = json_of(mft_table2_changes(rows, MFT_SHRINKS, NULL)), *same = json_of(mft_table2_differences(rows, MFT_SHRINKS));
    assert_int_equal(json_array_size(json_object_get(changes, "rows")), 6);
    assert_true(fabs(number(changes, 0, "intersection tests") - number(changes, 1, "intersection tests")) < 0.1);
    assert_true(fabs(number(changes, 4, "AABB tests") - number(changes, 5, "AABB tests")) < 1);
    assert_true(fabs(number(changes, 0, "cycles") + 5) < 0.06 && fabs(number(changes, 2, "cycles of the frame") + 10) < 0.06);
    assert_string_equal(json_string_value(cell(changes, 1, "doubtful readings")), "uncertain: after culling");
    assert_true(json_is_null(cell(changes, 1, "cycles")) && json_is_null(cell(changes, 3, "doubtful readings")));
    assert_int_equal(json_array_size(json_object_get(same, "rows")), 0);
    rows[1].value[MFT_ISECT] = rows[0].value[MFT_ISECT];
    json_t *other = json_of(mft_table2_differences(rows, MFT_SHRINKS));
    assert_int_equal(json_array_size(json_object_get(other, "rows")), 1);
    assert_non_null(strstr(json_string_value(cell(other, 0, "in words")), "shrinks 0.071 times"));
    json_decref(changes);
    json_decref(same);
    json_decref(other);
}

static void table2__other_scenes__published_rows_apart(void **state)
{
    (void)state;
    mft_shrink_row rows[2 * MFT_SHRINKS];
    fill_shrink_rows(rows, "a");
    fill_shrink_rows(rows + MFT_SHRINKS, "b");
    json_t *counts = json_of(mft_table2_counts(rows, 2 * MFT_SHRINKS, NULL)), *none = json_of(mft_table2_differences(rows, 2 * MFT_SHRINKS));
    assert_int_equal(json_array_size(json_object_get(counts, "rows")), 3 * MFT_SHRINKS);
    assert_string_equal(json_string_value(cell(counts, 8, "group")), "published, not measured here");
    assert_string_equal(json_string_value(cell(counts, 8, "basis")), "published");
    assert_int_equal(json_array_size(json_object_get(none, "rows")), 0);
    json_decref(counts);
    json_decref(none);
}

static void light_size__two_scenes__ratios_and_a_series_for_each(void **state)
{
    (void)state;
    const mft_row packet = {.scene = "a", .algorithm = MFT_S_PACKET, .pixels = 10, .value = {8, 8, 24, 6, 90}};
    const mft_row frusta = {.scene = "a", .algorithm = MFT_S_FRUSTA, .pixels = 10, .value = {4, 2, 2, 12, 30}};
    mft_light_row rows[4] = {{.scale = 0.5, .packet = packet, .frusta = frusta, .penumbra = 0.25}, {.scale = 1, .packet = packet, .frusta = packet}};
    mft_light_series series;
    rows[2] = rows[0];
    rows[3] = rows[1];
    rows[2].packet.scene = rows[3].packet.scene = "b";
    json_t *table = json_of(mft_light_size_reductions(rows, 4, NULL)), *counts = json_of(mft_light_size_counts(rows, 4, NULL));
    assert_int_equal(json_array_size(json_object_get(counts, "rows")), 8);
    assert_true(number(table, 0, "cycles") == 3 && number(table, 0, "AABB tests") == 12 && number(table, 0, "intersection tests") == 0.5);
    assert_true(number(table, 1, "cycles") == 1 && number(table, 2, "light scale") == 0.5 && number(table, 0, "penumbra") == 25);
    assert_true(json_is_null(cell(table, 4, "light scale")) && fabs(number(table, 4, "AABB tests") - 36234.0 / 1518) < 0.01);
    assert_int_equal(mft_light_series_create(rows, 4, 2, &series, NULL), BASE_OK);
    assert_int_equal(series.count, 4);
    assert_string_equal(series.series[2].name, "b, cycles");
    assert_true(series.series[0].x[1] == 1 && series.series[0].y[0] == 3 && series.series[1].y[0] == 12);
    mft_light_series_destroy(&series);
    json_decref(table);
    json_decref(counts);
}

static void packet256__one_scene__against_frusta_and_packets(void **state)
{
    (void)state;
    const mft_packet256_row row = {.packet16 = {.scene = "a", .algorithm = MFT_S_PACKET, .pixels = 10, .value = {8, 8, 24, 6, 50}},
                                   .packet256 = {.scene = "a", .algorithm = MFT_S_PACKET, .pixels = 10, .value = {4, 2, 90, 6, 100}},
                                   .frusta = {.scene = "a", .algorithm = MFT_S_FRUSTA, .pixels = 10, .value = {4, 2, 20, 12, 30}},
                                   .boxes = 19};
    json_t *ratios = json_of(mft_packet256_ratios(&row, 1, NULL)), *counts = json_of(mft_packet256_counts(&row, 1, NULL));
    assert_string_equal(json_string_value(cell(ratios, 0, "rays")), "primary and shadow");
    assert_string_equal(json_string_value(cell(ratios, 0, "boxes against frusta")), "5.0% fewer");
    assert_string_equal(json_string_value(cell(ratios, 0, "AABB tests against frusta")), "4.50 times");
    assert_string_equal(json_string_value(cell(ratios, 0, "speed against frusta")), "30%");
    assert_string_equal(json_string_value(cell(ratios, 0, "speed against packets of 16")), "50%");
    assert_string_equal(json_string_value(cell(ratios, 1, "boxes against frusta")), "3% to 4% fewer");
    assert_string_equal(json_string_value(cell(counts, 1, "algorithm")), "S-Packet, 256 rays");
    assert_true(number(counts, 0, "boxes") == 24 && number(counts, 1, "boxes") == 19 && number(counts, 1, "AABB tests") == 90);
    json_decref(ratios);
    json_decref(counts);
}

static void quality__errors__by_region_of_the_reference_and_hits_only(void **state)
{
    (void)state;
    const float reference[] = {0, 1, 0.5f, 0.25f, 0.5f, 1}, seen[] = {0, 0.5f, 0.75f, 0.25f, 0, 0};
    const unsigned char mask[] = {1, 1, 1, 1, 1, 0};
    mft_error error[MFT_REGIONS];
    mft_errors_of(seen, reference, mask, 6, error);
    assert_true(error[MFT_INSIDE].pixels == 3 && error[MFT_OUTSIDE].pixels == 2);
    assert_true(fabs(error[MFT_INSIDE].rmse - sqrt((0.0625 + 0.25) / 3)) < 1e-12 && fabs(error[MFT_INSIDE].bias + 0.25 / 3) < 1e-12);
    assert_true(error[MFT_INSIDE].worst == 0.5 && error[MFT_OUTSIDE].worst == 0.5 && error[MFT_OUTSIDE].bias == -0.25);
    mft_errors_of(seen, reference, mask, 0, error);
    assert_true(error[MFT_INSIDE].pixels == 0 && isnan(error[MFT_INSIDE].rmse));
}

static void quality__tables_and_points__rows_in_their_order(void **state)
{
    (void)state;
    mft_quality_row rows[MFT_QUALITY_WAYS] = {{0}};
    mft_quality_points points;
    for (unsigned i = 0; i < MFT_QUALITY_WAYS; i++)
        rows[i] = (mft_quality_row){.scene = "a", .samples = mft_quality_samples[i / 4], .interleaved = i / 2 % 2, .filtered = i % 2,
                                    .rays = mft_quality_samples[i / 4], .cycles = 10 * mft_quality_samples[i / 4], .cycles_per_pixel = i / 4 + 1,
                                    .error = {{.rmse = 1.0 / (i + 1), .pixels = 1}}};
    const mft_figure5_row figure[] = {{.scene = "a", .width = 8, .height = 6, .rays = 0.0625, .error = {{.rmse = 0.5, .pixels = 1}}},
                                      {.scene = "a", .width = 16, .height = 12, .interleaved = true, .filtered = true, .rays = 0.0625}};
    json_t *table = json_of(mft_quality_figure5(figure, 2, NULL)), *all = json_of(mft_quality_errors(rows, MFT_QUALITY_WAYS, NULL));
    assert_int_equal(json_array_size(json_object_get(all, "rows")), MFT_QUALITY_WAYS);
    assert_true(number(table, 1, "shadow rays") == 6.25 && number(table, 0, "inside penumbrae, RMSE") == 0.5);
    assert_true(json_is_null(cell(table, 0, "outside, worst")));
    assert_string_equal(json_string_value(cell(table, 1, "picture")), "16x12");
    assert_string_equal(json_string_value(cell(table, 1, "interleaved")), "yes");
    mft_quality_points_of(rows, &points);
    assert_true(points.x[3][1] == 2 && fabs(points.y[3][1] - 1.0 / 8) < 1e-12);
    assert_true(points.y[3][3] == points.y[1][3] && fabs(points.y[0][3] - 1.0 / 13) < 1e-12);
    assert_string_equal(points.series[3].name, "interleaved, filtered");
    json_decref(table);
    json_decref(all);
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

/* Two tiles of one pixel: one simple and without error, one complex, whose error falls as its samples grow. */
static mlrta_adaptive_scene two_tiles(mlrta_adaptive_tile tiles[2], unsigned char rates[2])
{
    static const double complexity[2] = {1, 100}, error[2] = {0, 16};
    for (int i = 0; i < 2; i++) {
        tiles[i].complexity = complexity[i];
        for (int rate = 0; rate < MLRTA_RATES; rate++) {
            tiles[i].rays[rate] = mlrta_rate_samples[rate];
            tiles[i].cycles[rate] = 10 * mlrta_rate_samples[rate];
            tiles[i].error[rate] = error[i] / mlrta_rate_samples[rate];
        }
    }
    return (mlrta_adaptive_scene){"two", 2, tiles, rates, 2};
}

static void adaptive__simple_and_complex_tile__samples_where_the_error_is(void **state)
{
    mlrta_adaptive_tile tiles[2];
    unsigned char rates[2];
    const mlrta_adaptive_scene scene = two_tiles(tiles, rates);
    (void)state;
    for (int way = MLRTA_BY_ROOT; way < MLRTA_WAYS; way++) {
        const mlrta_sampling s = mlrta_choose_samples(&scene, (mlrta_way)way, 1);
        assert_true(rates[0] == 0 && rates[1] == 1);
        assert_true(s.rays == (0.25 + 1) / 2 && s.cycles == 10 * s.rays && fabs(s.rmse - sqrt(16.0 / 6)) < 1e-12);
        assert_true(fabs(s.by_chance - sqrt((64.0 / 2 + 16.0 / 2) / 6)) < 1e-12 && s.share[0] == 0.5 && s.share[1] == 0.5);
    }
    tiles[0].complexity = 100; /* the measure says nothing: only the error does */
    mlrta_choose_samples(&scene, MLRTA_BY_STEPS, 1);
    assert_true(rates[0] == 1 && rates[1] == 1);
    mlrta_choose_samples(&scene, MLRTA_BY_ERROR, 1);
    assert_true(rates[0] == 0 && rates[1] == 1);
}

static void adaptive__table_and_plot__saved_rays_and_published(void **state)
{
    mlrta_adaptive_tile tiles[2];
    unsigned char rates[2];
    mlrta_adaptive_plot plot;
    const mlrta_adaptive_scene scene = two_tiles(tiles, rates);
    json_t *t = json_of(mlrta_adaptive_table(&scene, 1, "caption"));
    (void)state;
    assert_int_equal(json_array_size(json_object_get(t, "rows")), 2 * MLRTA_WAYS);
    assert_true(number(t, 0, "rays") == 1 && json_is_null(cell(t, 0, "rays saved")));
    assert_true(number(t, 1, "rays saved") == 37.5 && number(t, 1, "cycles saved") == 37.5 && number(t, 1, "tiles with 1/4") == 50);
    assert_true(number(t, MLRTA_WAYS, "rays") == 4 && fabs(number(t, MLRTA_WAYS + 2, "rays saved") - 100 * (1 - 4.25 / 8)) < 0.051);
    assert_non_null(strstr(json_string_value(json_array_get(json_object_get(t, "notes"), 0)), "50%"));
    json_decref(t);
    mlrta_adaptive_plot_of(&scene, &plot);
    assert_true(plot.series[0].count == MLRTA_RATES && plot.rays[0][3] == 16 && plot.rays[1][0] == 0.25);
    for (int i = 1; i < MLRTA_ADAPTIVE_POINTS; i++)
        assert_true(plot.rays[1][i] >= plot.rays[1][i - 1] && plot.rmse[2][i] <= plot.rmse[2][i - 1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(paper__rows_of_table_1__whole_and_doubts_named),
        cmocka_unit_test(prediction__known_costs__known_cycles),
        cmocka_unit_test(prediction__far_row__the_event_that_makes_it_so),
        cmocka_unit_test(prediction__event_that_did_not_happen__rows_missing_and_said),
        cmocka_unit_test(table1__large_difference__in_words_and_a_small_one_not),
        cmocka_unit_test(paper__rows_of_table_2__doubts_named_and_absent_cells_missing),
        cmocka_unit_test(table2__counts_of_the_paper__its_changes),
        cmocka_unit_test(table2__other_scenes__published_rows_apart),
        cmocka_unit_test(light_size__two_scenes__ratios_and_a_series_for_each),
        cmocka_unit_test(packet256__one_scene__against_frusta_and_packets),
        cmocka_unit_test(quality__errors__by_region_of_the_reference_and_hits_only),
        cmocka_unit_test(quality__tables_and_points__rows_in_their_order),
        cmocka_unit_test(adaptive__simple_and_complex_tile__samples_where_the_error_is),
        cmocka_unit_test(adaptive__table_and_plot__saved_rays_and_published),
        cmocka_unit_test(models__median_and_worst__by_size),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
