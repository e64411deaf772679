/* Suite mlrta-table2: Table 2 of Reshetov, Soupikov and Hurley 2005, primary rays. */
#include <stdlib.h>

#include "cli/suites/mlrta_runs.h"

typedef struct measured {
    mlrta_row *rows;
    size_t count;
} measured;

static base_status measure_scene(suite *s, const suite_scene *on, void *user, base_error *err)
{
    measured *m = user;
    mlrta_row *row = &m->rows[m->count++];
    base_status status = BASE_OK;
    *row = (mlrta_row){.scene = on->name, .packets = mlrta_packets(s)};
    for (int a = 0; status == BASE_OK && a < MLRTA_ALGORITHMS; a++)
        status = mlrta_count_kernel(s, on->scene, mlrta_primary_kernels[a], &row->counts[a], err);
    return status;
}

static base_status measure(suite *s, base_error *err)
{
    measured m = {.rows = calloc(s->scene_count, sizeof *m.rows)};
    base_status status = m.rows ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, s->info->name, "out of memory");
    if (status == BASE_OK)
        status = suite_each_scene(s, measure_scene, &m, err);
    if (status == BASE_OK)
        status = mlrta_add_tables(s, 2, mlrta_primary_kernels, m.rows, err);
    free(m.rows);
    return status;
}

const suite_info suite_mlrta_table2 = {
    .name = "mlrta-table2",
    .summary = "packets from the root of a kd-tree against entry points, primary rays (Reshetov and others 2005, Table 2)",
    .title = "MLRTA Table 2",
    .about = "Table 2 of Reshetov, Soupikov and Hurley's 'Multi-Level Ray Tracing Algorithm' (2005): cells that primary rays traverse "
             "and intersection tests a 4x4 packet, traced from the root of the kd-tree (no MLRT) and from entry points (MLRT), "
             "measured here and as published.",
    .scenes = mlrta_suite_scenes,
    .size = 1024,
    .measure = measure,
};
