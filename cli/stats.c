#include "cli/stats.h"

#include <stdio.h>
#include <string.h>
#include <sys/resource.h>

#include "cli/identity.h"
#include "cli/registers_report.h"
#include "cli/version.h"
#include "reports/accounts.h"

/* Decimals that reals keep in JSON. */
enum { RATIO_DECIMALS = 6, SECONDS_DECIMALS = 6 };

static json_t *integer(uint64_t value) { return json_integer((json_int_t)value); }

/* The part of the statistics that does not know what was run. */
static report_accounts accounts_of(const run_result *r)
{
    return (report_accounts){.machine = r->machine, .ops = r->ops, .memory_operands = r->memory_operands, .idle_lanes = r->idle_lanes,
                             .cycles = r->cycles};
}

static json_t *ops_json(const run_result *r)
{
    const report_accounts a = accounts_of(r);
    return report_ops_json(&a);
}

static json_t *phases_json(const run_result *r)
{
    const uint64_t *phase = r->options.model == RUN_CORE ? r->core.phase : r->issue.phase;
    json_t *object = json_object();
    for (int i = 0; i < KERNEL_PHASE_COUNT; i++)
        if (kernel_has_phase(r->options.kernel, i, phase[i]))
            json_object_set_new(object, kernel_phase_names[i], integer(phase[i]));
    return object;
}

sim_cycles stats_cycles(const run_result *r)
{
    const sim_issue_stats *s = &r->issue;
    if (r->options.model == RUN_CORE)
        return r->core.core;
    sim_cycles cycles = {.issued_one = s->issued_one, .issued_pair = s->issued_pair, .gap = s->gap, .store_forward = s->store_forward,
                         .blocked = s->blocked};
    memcpy(cycles.operand, s->operand, sizeof cycles.operand);
    memcpy(cycles.busy, s->busy, sizeof cycles.busy);
    return cycles;
}

void stats_cycles_by_field(const run_result *r, uint64_t cycles[SIM_FIELDS])
{
    const sim_cycles s = stats_cycles(r);
    report_cycles_by_field(r->machine, &s, r->options.model == RUN_CORE ? r->core.issued_by_class : r->issue.issued_by_class, cycles);
}

void stats_basis_shares(const run_result *r, double share[SIM_BASIS_COUNT])
{
    uint64_t by_field[SIM_FIELDS], cycles[SIM_BASIS_COUNT] = {0}, sum = 0;
    stats_cycles_by_field(r, by_field);
    for (size_t field = 0; field < SIM_FIELDS; field++) {
        cycles[r->machine->values[field].basis] += by_field[field];
        sum += by_field[field];
    }
    for (int i = 0; i < SIM_BASIS_COUNT; i++)
        share[i] = sum ? (double)cycles[i] / (double)sum : 0;
}

static json_t *basis_json(const run_result *r)
{
    double share[SIM_BASIS_COUNT];
    json_t *basis = json_object();
    stats_basis_shares(r, share);
    for (int i = 0; i < SIM_BASIS_COUNT; i++)
        json_object_set_new(basis, sim_basis_name((sim_basis)i), report_json_real(share[i], RATIO_DECIMALS));
    return basis;
}

/* Core cycles that began with an op of each mnemonic, or in which it was waited for. */
static json_t *op_cycles_json(const run_result *r)
{
    const uint64_t *cycles = r->options.model == RUN_CORE ? r->core.op_cycles : r->issue.op_cycles;
    json_t *object = json_object();
    for (int i = 0; i < LRB_OP_COUNT; i++) {
        const char *mnemonic = lrb_op_table[i].mnemonic;
        json_int_t before = json_integer_value(json_object_get(object, mnemonic)); /* two rows may share a mnemonic */
        if (cycles[i])
            json_object_set_new(object, mnemonic, json_integer(before + (json_int_t)cycles[i]));
    }
    return object;
}

static json_t *lanes_json(const run_result *r)
{
    const bool core = r->options.model == RUN_CORE;
    const uint64_t *ops = core ? r->core.phase_vector_ops : r->issue.phase_vector_ops;
    const uint64_t *idle = core ? r->core.phase_idle_lanes : r->issue.phase_idle_lanes;
    json_t *object = json_object();
    for (int i = 0; i < KERNEL_PHASE_COUNT; i++)
        if (ops[i])
            json_object_set_new(object, kernel_phase_names[i],
                                report_json_real(1 - (double)idle[i] / (16.0 * (double)ops[i]), RATIO_DECIMALS));
    return object;
}

static json_t *memory_json(const run_result *r)
{
    const sim_hierarchy_counts *m = &r->core.memory;
    json_t *object = json_object();
    json_object_set_new(object, "l1_accesses", integer(m->l1_accesses));
    json_object_set_new(object, "l1_waits", integer(m->l1_waits));
    json_object_set_new(object, "l1_misses", integer(m->l1_misses));
    json_object_set_new(object, "l2_accesses", integer(m->l2_accesses));
    json_object_set_new(object, "l2_misses", integer(m->l2_misses));
    json_object_set_new(object, "prefetches", integer(m->prefetches));
    json_object_set_new(object, "dropped_prefetches", integer(m->dropped_prefetches));
    json_object_set_new(object, "memory_lines", integer(m->memory_lines));
    json_object_set_new(object, "bank_conflicts", integer(r->core.bank_conflicts));
    return object;
}

static json_t *branches_json(const run_result *r)
{
    json_t *object = json_object();
    json_object_set_new(object, "total", integer(r->core.branches));
    json_object_set_new(object, "mispredicted", integer(r->core.mispredicted));
    json_object_set_new(object, "btb_misses", integer(r->core.btb_misses));
    return object;
}

/* Lower bounds of the cycles. */
static json_t *bounds_json(const run_result *r)
{
    json_t *object = json_object();
    json_object_set_new(object, "dependence", integer(sim_bound_dependence(r->machine, &r->chains)));
    json_object_set_new(object, "ports", integer(sim_bound_ports(r->machine, r->ops)));
    json_object_set_new(object, "memory", integer(sim_bound_memory(r->machine, &r->core.memory)));
    return object;
}

/* How well a sampled run knows its cycles. */
static json_t *estimate_json(const run_result *r)
{
    json_t *object = json_object();
    json_object_set_new(object, "rel_half_width_95", report_json_real(r->estimate.half_width_95, RATIO_DECIMALS));
    json_object_set_new(object, "tiles_simulated", integer(r->estimate.tiles_simulated));
    json_object_set_new(object, "tiles_total", integer(r->estimate.tiles));
    return object;
}

static bool has_stalls(const run_result *r) { return r->options.model == RUN_ISSUE || r->options.model == RUN_CORE; }

static json_t *cycles_json(const run_result *r)
{
    json_t *object = json_object();
    json_object_set_new(object, "total", integer(r->cycles));
    json_object_set_new(object, "per_ray", report_json_real((double)r->cycles / (double)r->counts.n[KERNEL_rays], RATIO_DECIMALS));
    if (has_stalls(r)) {
        const sim_cycles cycles = stats_cycles(r);
        json_object_set_new(object, "by_phase", phases_json(r));
        json_object_set_new(object, "by_stall", report_stalls_json(&cycles));
        json_object_set_new(object, "by_basis", basis_json(r));
        json_object_set_new(object, "by_op", op_cycles_json(r));
        json_object_set_new(object, "lane_utilisation", lanes_json(r));
    }
    if (r->options.model == RUN_CORE) {
        json_object_set_new(object, "cores", integer(r->machine->cores));
        json_object_set_new(object, "threads", integer(r->machine->threads));
        json_object_set_new(object, "threads_by_stall", report_stalls_json(&r->core.threads));
        if (r->estimate.tiles)
            json_object_set_new(object, "estimate", estimate_json(r));
        if (r->estimate.tiles_simulated == r->estimate.tiles) /* bounds are those of all tiles */
            json_object_set_new(object, "bounds", bounds_json(r));
        json_object_set_new(object, "memory", memory_json(r));
        json_object_set_new(object, "branches", branches_json(r));
    }
    return object;
}

static json_t *host_json(const run_result *r, double load_seconds)
{
    struct rusage usage;
    json_t *object = json_object();
    getrusage(RUSAGE_SELF, &usage);
    json_object_set_new(object, "load_s", report_json_real(load_seconds, SECONDS_DECIMALS));
    json_object_set_new(object, "build_s", report_json_real(r->build_seconds, SECONDS_DECIMALS));
    json_object_set_new(object, "kernel_s", report_json_real(r->kernel_seconds, SECONDS_DECIMALS));
    if (r->options.model == RUN_NATIVE)
        json_object_set_new(object, "ops_per_s", json_null());
    else
        json_object_set_new(object, "ops_per_s", report_json_real((double)run_totals(r).total / r->kernel_seconds, 0));
    json_object_set_new(object, "jobs", integer(r->options.jobs));
    json_object_set_new(object, "slowdown_vs_native", json_null());
    json_object_set_new(object, "peak_rss_bytes", json_integer((json_int_t)usage.ru_maxrss * 1024));
    return object;
}

json_t *stats_json(const run_result *r, double load_seconds, int with_host)
{
    json_t *stats = json_object();
    bool accounted = r->options.model != RUN_NATIVE;
    json_t *run = r->traced ? json_deep_copy(r->traced) : identity_json(r);
    json_object_set_new(stats, "schema", json_string("lanetrace-stats-1"));
    json_object_set(stats, "kernel", json_object_get(run, "kernel"));
    json_object_set(stats, "params", json_object_get(run, "params"));
    json_object_set_new(stats, "model", json_string(run_model_names[r->options.model]));
    if (accounted)
        json_object_set_new(stats, "machine", report_machine_json(r->machine));
    json_object_set(stats, "scene", json_object_get(run, "scene"));
    json_object_set(stats, "image", json_object_get(run, "image"));
    json_object_set_new(stats, "counts", identity_counts_json(r));
    json_decref(run);
    if (accounted) {
        json_object_set_new(stats, "ops", ops_json(r));
        json_object_set_new(stats, "cycles", cycles_json(r));
    }
    if (r->options.registers)
        json_object_set_new(stats, "registers", registers_json(r));
    if (with_host) {
        json_t *build = json_object();
        json_object_set_new(build, "version", json_string(VERSION_NUMBER));
        json_object_set_new(build, "backend", json_string(VERSION_BACKEND));
        json_object_set_new(build, "compiler", json_string(VERSION_COMPILER));
        json_object_set_new(stats, "host", host_json(r, load_seconds));
        json_object_set_new(stats, "build", build);
    }
    return stats;
}

/* One statistic: its value, and the same for each ray. */
static void add_row(report_table *t, const run_result *r, const char *name, uint64_t value)
{
    report_table_begin_row(t);
    report_table_add_text(t, name);
    report_table_add_integer(t, (int64_t)value);
    report_table_add_real(t, (double)value / (double)r->counts.n[KERNEL_rays]);
}

static void add_counts(report_table *t, const run_result *r)
{
    report_table_begin_group(t, "counts");
    for (int i = 0; i < KERNEL_COUNTER_COUNT; i++)
        if (r->options.kernel->counters >> i & 1)
            add_row(t, r, kernel_counter_table[i].name, r->counts.n[i]);
}

static void add_ops(report_table *t, const run_result *r)
{
    report_op_totals totals = run_totals(r);
    report_table_begin_group(t, "ops");
    add_row(t, r, "total", totals.total);
    add_row(t, r, "vector", totals.vector);
    add_row(t, r, "scalar and mask", totals.scalar);
    add_row(t, r, "that access memory", totals.memory);
}

static void add_object(report_table *t, const run_result *r, const char *group, json_t *numbers)
{
    const char *key;
    json_t *value;
    report_table_begin_group(t, group);
    json_object_foreach(numbers, key, value)
        add_row(t, r, key, (uint64_t)json_integer_value(value));
    json_decref(numbers);
}

static void add_notes(report_table *t, const run_result *r, double load_seconds)
{
    char text[256];
    if (r->estimate.tiles) {
        snprintf(text, sizeof text, "Cycles are an estimate from %zu of %zu tiles: within %.2f %% of the truth, with 95 %% confidence.",
                 r->estimate.tiles_simulated, r->estimate.tiles, 100 * r->estimate.half_width_95);
        report_table_add_note(t, text);
    }
    if (r->options.model != RUN_NATIVE) {
        size_t length = (size_t)snprintf(text, sizeof text, "Lane utilisation of vector ops: %.1f %%",
                                         100 * run_totals(r).lane_utilisation);
        json_t *lanes = has_stalls(r) ? lanes_json(r) : NULL, *share;
        const char *phase;
        json_object_foreach(lanes, phase, share)
            length += (size_t)snprintf(text + length, sizeof text - length, ", %s %.1f %%", phase, 100 * json_real_value(share));
        snprintf(text + length, sizeof text - length, ".");
        json_decref(lanes);
        report_table_add_note(t, text);
    }
    if (has_stalls(r)) {
        double share[SIM_BASIS_COUNT];
        size_t length = (size_t)snprintf(text, sizeof text, "Cycles by the basis of the machine's numbers:");
        stats_basis_shares(r, share);
        for (int i = 0; i < SIM_BASIS_COUNT; i++)
            length += (size_t)snprintf(text + length, sizeof text - length, " %s %.1f %%%s", sim_basis_name((sim_basis)i),
                                       100 * share[i], i + 1 < SIM_BASIS_COUNT ? "," : ".");
        report_table_add_note(t, text);
    }
    snprintf(text, sizeof text, "Host: load %.3f s, BVH %.3f s, kernel %.3f s on %u thread%s; %s.", load_seconds, r->build_seconds,
             r->kernel_seconds, r->options.jobs, r->options.jobs == 1 ? "" : "s", VERSION_LINE);
    report_table_add_note(t, text);
}

void stats_title(const run_result *r, char *title, size_t size)
{
    bool accounted = r->options.model != RUN_NATIVE;
    snprintf(title, size, "%s on %s (%zu triangles), %ux%u, model %s%s%s", r->options.kernel->name, r->scene_name,
             r->triangle_count, r->options.width, r->options.height, run_model_names[r->options.model],
             accounted ? ", machine " : "", accounted ? r->machine->name : "");
}

report_table *stats_table(const run_result *r, double load_seconds)
{
    bool accounted = r->options.model != RUN_NATIVE;
    char title[STATS_TITLE_SIZE];
    stats_title(r, title, sizeof title);
    report_table *t = report_table_create(title);
    report_table_add_column(t, &(report_column){.name = "statistic"});
    report_table_add_column(t, &(report_column){.name = "value", .kind = REPORT_INTEGER});
    report_table_add_column(t, &(report_column){.name = "per ray", .kind = REPORT_REAL, .decimals = 3});
    add_counts(t, r);
    if (accounted) {
        add_ops(t, r);
        report_table_begin_group(t, "simulated cycles");
        add_row(t, r, "total", r->cycles);
    }
    if (has_stalls(r)) {
        const sim_cycles cycles = stats_cycles(r);
        add_object(t, r, "cycles by phase", phases_json(r));
        add_object(t, r, "cycles by stall", report_stalls_json(&cycles));
        add_object(t, r, "cycles by op, issue and waiting", op_cycles_json(r));
    }
    if (r->options.model == RUN_CORE) {
        add_object(t, r, "cycles of the threads by stall", report_stalls_json(&r->core.threads));
        if (r->estimate.tiles_simulated == r->estimate.tiles)
            add_object(t, r, "lower bounds of the cycles", bounds_json(r));
        add_object(t, r, "memory", memory_json(r));
        add_object(t, r, "branches", branches_json(r));
    }
    add_notes(t, r, load_seconds);
    return t;
}
