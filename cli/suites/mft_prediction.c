/* Suite mft-prediction: what events cost on the simulated core, times the counts that the MFT paper published, against its cycles. */
#include <stdio.h>
#include <stdlib.h>

#include "cli/suite_machine.h"
#include "cli/suites/mft_runs.h"
#include "reports/views/mft_prediction.h"

enum { MACHINES = 4, MACHINE_NAME_BYTES = 60 };

typedef struct measured {
    suite_machine machines[MACHINES];
    char names[MACHINES][MACHINE_NAME_BYTES];
    mft_events *events; /* by scene, then by machine, then by algorithm */
} measured;

/* Which phases of a kernel are charged to which event. */
static mft_events events_of(const run_result *r, size_t machine, mft_algorithm a, const char *scene_name)
{
    const uint64_t *phase = r->core.phase, *n = r->counts.n;
    return (mft_events){
        .machine = machine,
        .algorithm = a,
        .scene = scene_name,
        .cycles = {[MFT_EVENT_SETUP] = (double)(phase[KERNEL_PHASE_SETUP] + phase[KERNEL_PHASE_SHADING]),
                   [MFT_EVENT_AABB] = (double)phase[KERNEL_PHASE_TRAVERSAL],
                   [MFT_EVENT_TRI] = (double)phase[KERNEL_PHASE_CULLING], [MFT_EVENT_ISECT] = (double)phase[KERNEL_PHASE_INTERSECTION]},
        .events = {[MFT_EVENT_SETUP] = (double)r->options.width * r->options.height, [MFT_EVENT_AABB] = (double)n[KERNEL_aabb_tests],
                   [MFT_EVENT_TRI] = (double)n[KERNEL_tri_accesses], [MFT_EVENT_ISECT] = (double)n[KERNEL_isect_tests]},
    };
}

static base_status take_events(const suite *s, const suite_run_entry *entry, const run_result *result, void *user, base_error *err)
{
    const measured *m = user;
    const size_t algorithms = (size_t)mft_algorithms_measured();
    (void)err;
    m->events[entry->row] = events_of(result, entry->row / algorithms % MACHINES, (mft_algorithm)(entry->row % algorithms),
                                      s->scenes[entry->scene].name);
    return BASE_OK;
}

static base_status measure_events(suite *s, measured *m, base_error *err)
{
    const size_t algorithms = (size_t)mft_algorithms_measured();
    suite_runs runs = {0};
    for (size_t a = algorithms; a-- > 0;)
        for (size_t i = 0; i < s->scene_count * MACHINES; i++)
            suite_runs_add(&runs, (suite_run_entry){.scene = i / MACHINES, .row = i * algorithms + a, .machine = m->machines[i % MACHINES].machine,
                                                    .options = mft_run_options(s, (mft_algorithm)a), .take = take_events});
    return suite_runs_take(s, &runs, m, err);
}

static base_status make_machines(const suite *s, measured *m, base_error *err)
{
    static const suite_change *const changes[MACHINES] = {NULL, suite_without_threads, suite_without_caches, suite_without_caches_and_threads};
    base_status status = suite_machine_one_core(s, err);
    for (int i = 0; status == BASE_OK && i < MACHINES; i++) {
        status = suite_machine_create(s, changes[i], &m->machines[i], err);
        if (status != BASE_OK)
            return status;
        const unsigned threads = m->machines[i].machine->threads;
        snprintf(m->names[i], MACHINE_NAME_BYTES, "%u thread%s%s", threads, threads == 1 ? "" : "s", i >= 2 ? ", no cache misses" : "");
    }
    return status;
}

static base_status add_plot(suite *s, const mft_measured *m, base_error *err)
{
    mft_prediction_points points;
    mft_prediction_points_of(m, &points);
    const report_plot plot = {points.title, {"published cycles (millions)", true}, {"predicted cycles (millions)", true},
                              points.series, points.count};
    return suite_add_plot(s, "-plot", &plot, "The reading with the least median error.", err);
}

static base_status add_results(suite *s, const measured *found, base_error *err)
{
    const char *const names[MACHINES] = {found->names[0], found->names[1], found->names[2], found->names[3]};
    const mft_measured m = {names, MACHINES, found->events, s->scene_count * MACHINES * (size_t)mft_algorithms_measured(),
                            (size_t)mft_algorithms_measured()};
    char caption[SUITE_CHANGED_BYTES + 240];
    snprintf(caption, sizeof caption, "Costs measured at %ux%u pixels on %zu scene%s, machine %s, core model. No cache misses: %s.",
             s->width, s->height, s->scene_count, s->scene_count == 1 ? "" : "s", s->options->machine->name, found->machines[2].changed);
    report_page_add_heading(s->page, 1, "Errors");
    base_status status = suite_add_table(s, "", mft_prediction_summary(&m, caption), err);
    if (status == BASE_OK)
        status = add_plot(s, &m, err);
    if (status == BASE_OK)
        status = suite_add_table(s, "-far", mft_prediction_far(&m), err);
    if (status == BASE_OK)
        status = suite_add_table(s, "-left", mft_prediction_left(&m, caption), err);
    report_page_add_heading(s->page, 1, "Rows");
    if (status == BASE_OK)
        status = suite_add_table(s, "-rows", mft_prediction_rows(&m, caption), err);
    report_page_add_heading(s->page, 1, "Costs");
    return status == BASE_OK ? suite_add_table(s, "-costs", mft_prediction_costs(&m, caption), err) : status;
}

static base_status measure(suite *s, base_error *err)
{
    measured m = {.events = calloc(s->scene_count * MACHINES * MFT_ALGORITHMS, sizeof *m.events)};
    base_status status = m.events ? make_machines(s, &m, err) : base_fail(err, BASE_ERR_NOMEM, s->info->name, "out of memory");
    if (status == BASE_OK)
        status = measure_events(s, &m, err);
    if (status == BASE_OK)
        status = add_results(s, &m, err);
    for (int i = 0; i < MACHINES; i++)
        sim_machine_destroy(&m.machines[i].machine);
    free(m.events);
    return status;
}

const suite_info suite_mft_prediction = {
    .name = "mft-prediction",
    .summary = "the counts that the MFT paper published through the simulated core, against its cycles",
    .title = "the MFT paper's counts through the simulated core",
    .about = "What a box test, a triangle access, an intersection test and the set-up of a pixel cost in the core model, measured "
             "on scenes of ours, times the counts that Benthin and Wald published in Table 1 (2009), against the cycles that they "
             "published. No constant is fitted to the paper.",
    .scenes = mft_suite_scenes,
    .size = 512,
    .takes = SUITE_TAKES_ERROR,
    .measure = measure,
};
