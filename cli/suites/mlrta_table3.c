/* Suite mlrta-table3: Table 3 of Reshetov, Soupikov and Hurley 2005, primary rays and shadow rays of a point light. */
#include "cli/suites/mlrta_runs.h"

static base_status measure(suite *s, base_error *err) { return mlrta_measure_table(s, 3, mlrta_shadow_kernels, err); }

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
