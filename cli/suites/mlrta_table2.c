/* Suite mlrta-table2: Table 2 of Reshetov, Soupikov and Hurley 2005, primary rays. */
#include "cli/suites/mlrta_runs.h"

static base_status measure(suite *s, base_error *err) { return mlrta_measure_table(s, 2, mlrta_primary_kernels, err); }

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
