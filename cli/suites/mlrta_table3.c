/* Suite mlrta-table3: Table 3 of Reshetov, Soupikov and Hurley 2005, primary rays and shadow rays of a point light; and where the tests of
 * shadow rays differ between packets from the root and from entry points.
 */
#include <stdio.h>
#include <stdlib.h>

#include "cli/suites/mlrta_runs.h"
#include "reports/views/mlrta_shadows.h"

/* Runs of each algorithm: primary rays alone, and with shadow rays. */
enum { PRIMARY, BOTH, RUNS };

/* What they have counted in each 16x16 tile of a scene. */
typedef struct tile_counts {
    kernel_counts *run[MLRTA_ALGORITHMS][RUNS];
    size_t tiles;
} tile_counts;

/* Count by tiles; with shadow rays the sum too. A unit of work is an initial tile of 16 pixels, whatever is so by default. */
static base_status count_run(const suite *s, const scene *input, const char *kernel, tile_counts *to, kernel_counts **by_tile, mlrta_counts *sum,
                             base_error *err)
{
    run_options options = suite_run_options(s, kernel_find(kernel), RUN_NATIVE);
    run_result result = {0};
    options.params.its = 0;
    options.keep_tile_counts = true;
    base_status status = run_kernel(input, s->options->machine, &options, &result, err);
    if (status == BASE_OK) {
        to->tiles = kernel_job_tiles(result.job);
        *sum = mlrta_counts_of(&result);
        *by_tile = result.tile_counts;
        result.tile_counts = NULL;
    }
    run_result_destroy(&result);
    return status;
}

/* All runs of a scene. Packets from the root know no tiles: theirs is the run of the table. */
static base_status count_scene(const suite *s, const scene *input, tile_counts *to, mlrta_row *row, base_error *err)
{
    const char *const *const kernels[RUNS] = {mlrta_primary_kernels, mlrta_shadow_kernels};
    base_status status = BASE_OK;
    for (int a = 0; a < MLRTA_ALGORITHMS; a++)
        for (int r = 0; status == BASE_OK && r < RUNS; r++)
            status = count_run(s, input, kernels[r][a], to, &to->run[a][r], &row->counts[a], err);
    return status == BASE_OK ? mlrta_count_kernel(s, input, mlrta_shadow_kernels[MLRTA_WITH], &row->counts[MLRTA_WITH], err) : status;
}

/* Of the shadow rays of a tile. */
static uint64_t shadow_count(const tile_counts *c, mlrta_algorithm a, size_t tile, kernel_counter counter)
{
    return c->run[a][BOTH][tile].n[counter] - c->run[a][PRIMARY][tile].n[counter];
}

/* What the search for a tile's shadow rays has found. */
static mlrta_found found_of(const tile_counts *c, size_t tile)
{
    if (shadow_count(c, MLRTA_WITH, tile, KERNEL_units_divergent_tiles))
        return MLRTA_FOUND_NO_BOUNDS;
    return shadow_count(c, MLRTA_WITH, tile, KERNEL_units_empty_tiles) ? MLRTA_FOUND_NOTHING : MLRTA_FOUND_ENTRY;
}

static void add_tile(const tile_counts *c, size_t tile, mlrta_shadows *row)
{
    mlrta_shadow_tests *to = &row->found[found_of(c, tile)];
    if (shadow_count(c, MLRTA_WITHOUT, tile, KERNEL_rays_shadow) == 0)
        return;
    to->tiles++;
    to->packets += (double)shadow_count(c, MLRTA_WITHOUT, tile, KERNEL_units_hard_packets);
    for (int a = 0; a < MLRTA_ALGORITHMS; a++) {
        to->cells[a] += (double)shadow_count(c, (mlrta_algorithm)a, tile, KERNEL_traversed_cells);
        to->tests[a] += (double)shadow_count(c, (mlrta_algorithm)a, tile, KERNEL_isect_tests);
        to->hits[a] += (double)shadow_count(c, (mlrta_algorithm)a, tile, KERNEL_isect_hits);
    }
    to->more += shadow_count(c, MLRTA_WITH, tile, KERNEL_isect_tests) > shadow_count(c, MLRTA_WITHOUT, tile, KERNEL_isect_tests);
}

typedef struct measured {
    mlrta_row *rows;
    mlrta_shadows *shadows;
    size_t count;
} measured;

static base_status measure_scene(suite *s, const suite_scene *on, void *user, base_error *err)
{
    measured *m = user;
    tile_counts c = {.tiles = 0};
    mlrta_row *row = &m->rows[m->count];
    mlrta_shadows *shadows = &m->shadows[m->count++];
    *row = (mlrta_row){.scene = on->name, .packets = mlrta_packets(s)};
    shadows->scene = on->name;
    base_status status = count_scene(s, on->scene, &c, row, err);
    for (size_t tile = 0; status == BASE_OK && tile < c.tiles; tile++)
        add_tile(&c, tile, shadows);
    for (int a = 0; a < MLRTA_ALGORITHMS; a++)
        for (int r = 0; r < RUNS; r++)
            free(c.run[a][r]);
    return status;
}

static base_status measure(suite *s, base_error *err)
{
    measured m = {.rows = calloc(s->scene_count, sizeof *m.rows), .shadows = calloc(s->scene_count, sizeof *m.shadows)};
    char caption[200];
    base_status status = m.rows && m.shadows ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, s->info->name, "out of memory");
    if (status == BASE_OK)
        status = suite_each_scene(s, measure_scene, &m, err);
    if (status == BASE_OK)
        status = mlrta_add_tables(s, 3, mlrta_shadow_kernels, m.rows, err);
    snprintf(caption, sizeof caption, "%ux%u pixels, shadow rays alone, by tiles of 16x16 pixels with shadow rays; counts are per packet of "
                                      "shadow rays that starts at the root.", s->width, s->height);
    if (status == BASE_OK)
        status = suite_add_table(s, "-shadows", mlrta_shadows_table(m.shadows, s->scene_count, caption), err);
    free(m.rows);
    free(m.shadows);
    return status;
}

const suite_info suite_mlrta_table3 = {
    .name = "mlrta-table3",
    .summary = "the same, with shadow rays of a point light (Reshetov and others 2005, Table 3)",
    .title = "MLRTA Table 3",
    .about = "Table 3 of Reshetov, Soupikov and Hurley's 'Multi-Level Ray Tracing Algorithm' (2005): cells traversed and intersection "
             "tests of primary rays and of shadow rays of one point light, together, divided by the packets of primary rays; traced "
             "from the root of the kd-tree (no MLRT) and from entry points (MLRT), measured here and as published.",
    .scenes = mlrta_suite_scenes,
    .size = 1024,
    .measure = measure,
};
