/* Suite mlrta-table1: Table 1 of Reshetov, Soupikov and Hurley 2005, frames a second, with the cycles of the core model. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "cli/suite_machine.h"
#include "cli/suites/mlrta_runs.h"
#include "reports/views/mlrta_speeds.h"

/* The two of the paper, and the tracers through a BVH on the same rays. */
static const char *const kernels[] = {"kd16-primary", "mlrta-primary", "packet16-primary", "mft-primary"};
static const char *const scenes[] = {"builtin:rooms-804", "builtin:conference-282k", "builtin:tower-2195k", NULL}; /* as in the paper */
enum { KERNELS = sizeof kernels / sizeof *kernels };

typedef struct measured {
    mlrta_speed *rows;
    size_t count;
} measured;

static mlrta_speed speed_of(const run_result *r, const run_result *shaded, const char *scene_name)
{
    const sim_cycles *core = &r->core.core;
    const double all = (double)r->core.cycles;
    return (mlrta_speed){
        .scene = scene_name,
        .kernel = r->options.kernel->name,
        .pixels = (double)r->options.width * r->options.height,
        .cycles = (double)r->cycles,
        .shaded = (double)shaded->cycles,
        .clock_hz = (double)r->machine->clock_hz,
        .entry = (double)r->core.phase[KERNEL_PHASE_ENTRY] / all,
        .memory = (double)(core->l2 + core->memory + core->misses + core->prefetches) / all,
        .half_width = fmax(r->estimate.half_width_95, shaded->estimate.half_width_95),
    };
}

/* One kernel, with no shader and with the simple one. */
static base_status measure_kernel(suite *s, const suite_scene *on, const char *kernel, mlrta_speed *out, base_error *err)
{
    run_options options = suite_run_options(s, kernel_find(kernel), RUN_CORE);
    run_result plain = {0}, shaded = {0};
    base_status status = run_kernel(on->scene, s->options->machine, &options, &plain, err);
    options.params.shader = KERNEL_SHADER_SIMPLE;
    if (status == BASE_OK)
        status = run_kernel(on->scene, s->options->machine, &options, &shaded, err);
    if (status == BASE_OK)
        *out = speed_of(&plain, &shaded, on->name);
    run_result_destroy(&plain);
    run_result_destroy(&shaded);
    return status;
}

static base_status measure_scene(suite *s, const suite_scene *on, void *user, base_error *err)
{
    measured *m = user;
    base_status status = BASE_OK;
    for (int i = 0; status == BASE_OK && i < KERNELS; i++)
        status = measure_kernel(s, on, kernels[i], &m->rows[m->count++], err);
    return status;
}

static base_status measure(suite *s, base_error *err)
{
    char caption[240];
    const sim_machine *machine = s->options->machine;
    measured m = {.rows = calloc(s->scene_count * KERNELS, sizeof *m.rows)};
    base_status status = m.rows ? suite_machine_one_core(s, err) : base_fail(err, BASE_ERR_NOMEM, s->info->name, "out of memory");
    snprintf(caption, sizeof caption, "Measured at %ux%u pixels, machine %s, core model, one core of %u threads at %.2f GHz; default "
                                      "parameters.", s->width, s->height, machine->name, machine->threads, (double)machine->clock_hz / 1e9);
    if (status == BASE_OK)
        status = suite_each_scene(s, measure_scene, &m, err);
    report_page_add_heading(s->page, 1, "Table");
    if (status == BASE_OK)
        status = suite_add_table(s, "", mlrta_speeds_table(m.rows, m.count, caption), err);
    free(m.rows);
    return status;
}

const suite_info suite_mlrta_table1 = {
    .name = "mlrta-table1",
    .summary = "frames a second of one core at its clock, primary rays, core model (Reshetov and others 2005, Table 1)",
    .title = "MLRTA Table 1",
    .about = "Table 1 of Reshetov, Soupikov and Hurley's 'Multi-Level Ray Tracing Algorithm' (2005): frames a second with a null and "
             "with a simple shader, of packets from the root of a kd-tree (kd16-primary), of multi-level ray tracing (mlrta-primary) and of the two "
             "tracers through a BVH on the same rays, on one simulated core; and as published.",
    .scenes = scenes,
    .size = 1024,
    .takes = SUITE_TAKES_ERROR,
    .measure = measure,
};
