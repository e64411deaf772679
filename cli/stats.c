#include "cli/stats.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>

#include "cli/identity.h"
#include "cli/version.h"

/* Decimals that reals keep in JSON. */
enum { RATIO_DECIMALS = 6, SECONDS_DECIMALS = 6 };

static json_t *hash_json(uint64_t hash)
{
    char text[20];
    snprintf(text, sizeof text, "%016" PRIx64, hash);
    return json_string(text);
}

static json_t *integer(uint64_t value) { return json_integer((json_int_t)value); }

static json_t *ops_json(const run_result *r)
{
    run_op_totals t = run_totals(r);
    json_t *object = json_object(), *by_op = json_object();
    json_object_set_new(object, "total", integer(t.total));
    json_object_set_new(object, "vector", integer(t.vector));
    json_object_set_new(object, "scalar", integer(t.scalar));
    json_object_set_new(object, "memory", integer(t.memory));
    json_object_set_new(object, "lane_utilisation", report_json_real(t.lane_utilisation, RATIO_DECIMALS));
    for (int i = 0; i < LRB_OP_COUNT; i++) {
        const char *mnemonic = lrb_op_table[i].mnemonic;
        if (!r->ops[i] || lrb_op_kind_of((lrb_op_id)i) == LRB_KIND_MARKER)
            continue;
        json_int_t before = json_integer_value(json_object_get(by_op, mnemonic)); /* two rows may share a mnemonic */
        json_object_set_new(by_op, mnemonic, json_integer(before + (json_int_t)r->ops[i]));
    }
    json_object_set_new(object, "by_op", by_op);
    return object;
}

static json_t *phases_json(const run_result *r)
{
    json_t *object = json_object();
    for (int i = 0; i < KERNEL_PHASE_COUNT; i++)
        json_object_set_new(object, kernel_phase_names[i], integer(r->issue.phase[i]));
    return object;
}

/* Cycles waited for results of one class, however they were to be read. */
static uint64_t operand_wait(const sim_issue_stats *s, int class_id)
{
    uint64_t sum = 0;
    for (int kind = 0; kind < SIM_CONSUMERS; kind++)
        sum += s->operand[class_id][kind];
    return sum;
}

static void set_if_any(json_t *object, const char *prefix, const char *name, uint64_t value)
{
    char key[64];
    snprintf(key, sizeof key, "%s%s", prefix, name);
    if (value)
        json_object_set_new(object, key, integer(value));
}

static json_t *stalls_json(const run_result *r)
{
    const sim_issue_stats *s = &r->issue;
    json_t *object = json_object();
    json_object_set_new(object, "issued_one", integer(s->issued_one));
    json_object_set_new(object, "issued_pair", integer(s->issued_pair));
    for (int k = 0; k < LRB_CLASS_COUNT; k++)
        set_if_any(object, "operand_", lrb_cost_classes[k].name, operand_wait(s, k));
    set_if_any(object, "", "store_forward", s->store_forward);
    for (int k = 0; k < LRB_CLASS_COUNT; k++)
        set_if_any(object, "busy_", lrb_cost_classes[k].name, s->busy[k]);
    set_if_any(object, "", "blocked", s->blocked);
    set_if_any(object, "", "gap", s->gap);
    return object;
}

void stats_basis_shares(const run_result *r, double share[SIM_BASIS_COUNT])
{
    static const sim_class_key latency_key[SIM_CONSUMERS] = {
        [SIM_CONSUMER_PLAIN] = SIM_KEY_latency,
        [SIM_CONSUMER_SHUFFLE] = SIM_KEY_latency_to_shuffle,
        [SIM_CONSUMER_BRANCH] = SIM_KEY_latency_to_branch,
        [SIM_CONSUMER_ADDRESS] = SIM_KEY_latency_to_address,
    };
    const sim_issue_stats *s = &r->issue;
    const sim_machine_value *v = r->machine->values;
    uint64_t cycles[SIM_BASIS_COUNT] = {0};
    for (int i = 0; i < LRB_CLASS_COUNT; i++) {
        lrb_cost_class k = (lrb_cost_class)i;
        cycles[v[sim_class_field(k, SIM_KEY_throughput)].basis] += s->issued_by_class[k] + s->busy[k];
        for (int kind = 0; kind < SIM_CONSUMERS; kind++) {
            size_t field = sim_class_field(k, latency_key[kind]);
            cycles[v[v[field].given ? field : sim_class_field(k, SIM_KEY_latency)].basis] += s->operand[k][kind];
        }
    }
    cycles[v[sim_class_field(LRB_CLASS_vector_store, SIM_KEY_latency)].basis] += s->store_forward;
    cycles[v[sim_class_field(LRB_CLASS_scalar_multiply, SIM_KEY_blocking)].basis] += s->blocked;
    cycles[v[SIM_FIELD_machine_issue_gap].basis] += s->gap;
    for (int i = 0; i < SIM_BASIS_COUNT; i++)
        share[i] = s->cycles ? (double)cycles[i] / (double)s->cycles : 0;
}

static json_t *cycles_json(const run_result *r)
{
    json_t *object = json_object();
    json_object_set_new(object, "total", integer(r->cycles));
    json_object_set_new(object, "per_ray", report_json_real((double)r->cycles / (double)r->counts.n[KERNEL_rays], RATIO_DECIMALS));
    if (r->options.model == RUN_ISSUE) {
        double share[SIM_BASIS_COUNT];
        json_t *basis = json_object();
        stats_basis_shares(r, share);
        for (int i = 0; i < SIM_BASIS_COUNT; i++)
            json_object_set_new(basis, sim_basis_name((sim_basis)i), report_json_real(share[i], RATIO_DECIMALS));
        json_object_set_new(object, "by_phase", phases_json(r));
        json_object_set_new(object, "by_stall", stalls_json(r));
        json_object_set_new(object, "by_basis", basis);
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
    if (accounted) {
        json_t *machine = json_object();
        json_object_set_new(machine, "name", json_string(r->machine->name));
        json_object_set_new(machine, "hash", hash_json(sim_machine_hash(r->machine)));
        json_object_set_new(stats, "machine", machine);
    }
    json_object_set(stats, "scene", json_object_get(run, "scene"));
    json_object_set(stats, "image", json_object_get(run, "image"));
    json_object_set_new(stats, "counts", identity_counts_json(r));
    json_decref(run);
    if (accounted) {
        json_object_set_new(stats, "ops", ops_json(r));
        json_object_set_new(stats, "cycles", cycles_json(r));
    }
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
    run_op_totals totals = run_totals(r);
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
    if (r->options.model != RUN_NATIVE) {
        snprintf(text, sizeof text, "Lane utilisation of vector ops: %.1f %%.", 100 * run_totals(r).lane_utilisation);
        report_table_add_note(t, text);
    }
    if (r->options.model == RUN_ISSUE) {
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

report_table *stats_table(const run_result *r, double load_seconds)
{
    bool accounted = r->options.model != RUN_NATIVE;
    char title[384];
    snprintf(title, sizeof title, "%s on %s (%zu triangles), %ux%u, model %s%s%s", r->options.kernel->name, r->scene_name,
             r->triangle_count, r->options.width, r->options.height, run_model_names[r->options.model],
             accounted ? ", machine " : "", accounted ? r->machine->name : "");
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
    if (r->options.model == RUN_ISSUE) {
        add_object(t, r, "cycles by phase", phases_json(r));
        add_object(t, r, "cycles by stall", stalls_json(r));
    }
    add_notes(t, r, load_seconds);
    return t;
}
