#include "reports/accounts.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include <jansson.h>

static json_t *integer(uint64_t value) { return json_integer((json_int_t)value); }

report_op_totals report_accounts_totals(const report_accounts *a)
{
    report_op_totals t = {.memory = a->memory_operands};
    for (int i = 0; i < LRB_OP_COUNT; i++) {
        lrb_op_kind kind = lrb_op_kind_of((lrb_op_id)i);
        if (kind == LRB_KIND_MARKER)
            continue;
        t.total += a->ops[i];
        *(kind == LRB_KIND_VECTOR ? &t.vector : &t.scalar) += a->ops[i];
        t.memory += lrb_op_is_memory((lrb_op_id)i) ? a->ops[i] : 0;
    }
    if (t.vector)
        t.lane_utilisation = 1.0 - (double)a->idle_lanes / (16.0 * (double)t.vector);
    return t;
}

json_t *report_machine_json(const sim_machine *machine)
{
    char hash[20];
    snprintf(hash, sizeof hash, "%016" PRIx64, sim_machine_hash(machine));
    return json_pack("{s:s, s:s}", "name", machine->name, "hash", hash);
}

static json_t *by_op_json(const uint64_t *ops)
{
    json_t *by_op = json_object();
    for (int i = 0; i < LRB_OP_COUNT; i++) {
        const char *mnemonic = lrb_op_table[i].mnemonic;
        if (!ops[i] || lrb_op_kind_of((lrb_op_id)i) == LRB_KIND_MARKER)
            continue;
        json_int_t before = json_integer_value(json_object_get(by_op, mnemonic)); /* two rows may share a mnemonic */
        json_object_set_new(by_op, mnemonic, json_integer(before + (json_int_t)ops[i]));
    }
    return by_op;
}

json_t *report_ops_json(const report_accounts *a)
{
    report_op_totals t = report_accounts_totals(a);
    json_t *object = json_object();
    json_object_set_new(object, "total", integer(t.total));
    json_object_set_new(object, "vector", integer(t.vector));
    json_object_set_new(object, "scalar", integer(t.scalar));
    json_object_set_new(object, "memory", integer(t.memory));
    json_object_set_new(object, "lane_utilisation", report_json_real(t.lane_utilisation, REPORT_RATIO_DECIMALS));
    json_object_set_new(object, "by_op", by_op_json(a->ops));
    return object;
}

static json_t *phases_json(const report_accounts *a)
{
    json_t *object = json_object();
    for (size_t i = 0; i < SIM_MAX_PHASES; i++) {
        char number[24];
        snprintf(number, sizeof number, "%zu", i);
        if (i < a->phase_count || a->issue->phase[i])
            json_object_set_new(object, i < a->phase_count ? a->phases[i] : number, integer(a->issue->phase[i]));
    }
    return object;
}

static void set_if_any(json_t *object, const char *prefix, const char *name, uint64_t value)
{
    char key[64];
    snprintf(key, sizeof key, "%s%s", prefix, name);
    if (value)
        json_object_set_new(object, key, integer(value));
}

/* Cycles waited for results of one class, however they were to be read. */
static uint64_t operand_wait(const sim_cycles *s, int class_id)
{
    uint64_t sum = 0;
    for (int kind = 0; kind < SIM_CONSUMERS; kind++)
        sum += s->operand[class_id][kind];
    return sum;
}

json_t *report_stalls_json(const sim_cycles *s)
{
    json_t *object = json_object();
    json_object_set_new(object, "issued_one", integer(s->issued_one));
    json_object_set_new(object, "issued_pair", integer(s->issued_pair));
    for (int k = 0; k < LRB_CLASS_COUNT; k++)
        set_if_any(object, "operand_", lrb_cost_classes[k].name, operand_wait(s, k));
    set_if_any(object, "", "l2", s->l2);
    set_if_any(object, "", "memory", s->memory);
    set_if_any(object, "", "store_forward", s->store_forward);
    for (int k = 0; k < LRB_CLASS_COUNT; k++)
        set_if_any(object, "busy_", lrb_cost_classes[k].name, s->busy[k]);
    set_if_any(object, "", "blocked", s->blocked);
    set_if_any(object, "", "delay", s->delay);
    set_if_any(object, "", "mispredict", s->mispredict);
    set_if_any(object, "", "btb_miss", s->btb_miss);
    set_if_any(object, "", "misses_under_way", s->misses);
    set_if_any(object, "", "prefetches_under_way", s->prefetches);
    set_if_any(object, "", "gap", s->gap);
    set_if_any(object, "", "other_thread", s->other_thread);
    set_if_any(object, "", "no_work", s->no_work);
    return object;
}

/* Where the cycles of the model issue went. */
static sim_cycles cycles_of(const sim_issue_stats *s)
{
    sim_cycles cycles = {.issued_one = s->issued_one, .issued_pair = s->issued_pair, .gap = s->gap, .store_forward = s->store_forward,
                         .blocked = s->blocked};
    memcpy(cycles.operand, s->operand, sizeof cycles.operand);
    memcpy(cycles.busy, s->busy, sizeof cycles.busy);
    return cycles;
}

/* The latency of a level of memory has one field. */
static void charge_plain_fields(const sim_cycles *s, uint64_t by_field[SIM_FIELDS])
{
    by_field[sim_class_field(LRB_CLASS_vector_store, SIM_KEY_latency)] += s->store_forward;
    by_field[sim_class_field(LRB_CLASS_scalar_multiply, SIM_KEY_blocking)] += s->blocked;
    by_field[sim_class_field(LRB_CLASS_delay, SIM_KEY_throughput)] += s->delay;
    by_field[SIM_FIELD_machine_issue_gap] += s->gap;
    by_field[SIM_FIELD_l2_latency] += s->l2;
    by_field[SIM_FIELD_memory_latency] += s->memory;
    by_field[SIM_FIELD_branch_mispredict_penalty] += s->mispredict;
    by_field[SIM_FIELD_branch_btb_miss_penalty] += s->btb_miss;
    by_field[SIM_FIELD_memory_demand_misses_per_thread] += s->misses;
    by_field[SIM_FIELD_memory_prefetches_per_core] += s->prefetches;
}

void report_cycles_by_field(const sim_machine *machine, const sim_cycles *s, const uint64_t *issued, uint64_t by_field[SIM_FIELDS])
{
    static const sim_class_key latency_key[SIM_CONSUMERS] = {
        [SIM_CONSUMER_PLAIN] = SIM_KEY_latency,
        [SIM_CONSUMER_SHUFFLE] = SIM_KEY_latency_to_shuffle,
        [SIM_CONSUMER_BRANCH] = SIM_KEY_latency_to_branch,
        [SIM_CONSUMER_ADDRESS] = SIM_KEY_latency_to_address,
        [SIM_CONSUMER_MASK] = SIM_KEY_latency_to_mask,
    };
    memset(by_field, 0, SIM_FIELDS * sizeof *by_field);
    for (int i = 0; i < LRB_CLASS_COUNT; i++) {
        lrb_cost_class k = (lrb_cost_class)i;
        by_field[sim_class_field(k, SIM_KEY_throughput)] += issued[k] + s->busy[k];
        for (int kind = 0; kind < SIM_CONSUMERS; kind++) {
            size_t field = sim_class_field(k, latency_key[kind]);
            by_field[machine->values[field].given ? field : sim_class_field(k, SIM_KEY_latency)] += s->operand[k][kind];
        }
    }
    charge_plain_fields(s, by_field);
}

void report_basis_shares(const report_accounts *a, double share[SIM_BASIS_COUNT])
{
    uint64_t by_field[SIM_FIELDS] = {0}, cycles[SIM_BASIS_COUNT] = {0}, sum = 0;
    if (a->issue) {
        const sim_cycles s = cycles_of(a->issue);
        report_cycles_by_field(a->machine, &s, a->issue->issued_by_class, by_field);
    }
    for (size_t field = 0; field < SIM_FIELDS; field++) {
        cycles[a->machine->values[field].basis] += by_field[field];
        sum += by_field[field];
    }
    for (int i = 0; i < SIM_BASIS_COUNT; i++)
        share[i] = sum ? (double)cycles[i] / (double)sum : 0;
}

json_t *report_cycles_json(const report_accounts *a)
{
    json_t *object = json_object();
    json_object_set_new(object, "total", integer(a->cycles));
    if (a->issue) {
        double share[SIM_BASIS_COUNT];
        const sim_cycles cycles = cycles_of(a->issue);
        json_t *basis = json_object();
        report_basis_shares(a, share);
        for (int i = 0; i < SIM_BASIS_COUNT; i++)
            json_object_set_new(basis, sim_basis_name((sim_basis)i), report_json_real(share[i], REPORT_RATIO_DECIMALS));
        json_object_set_new(object, "by_phase", phases_json(a));
        json_object_set_new(object, "by_stall", report_stalls_json(&cycles));
        json_object_set_new(object, "by_basis", basis);
    }
    return object;
}

static void add_row(report_table *t, const char *name, uint64_t value)
{
    report_table_begin_row(t);
    report_table_add_text(t, name);
    report_table_add_integer(t, (int64_t)value);
}

static void add_object(report_table *t, const char *group, json_t *numbers)
{
    const char *key;
    json_t *value;
    report_table_begin_group(t, group);
    json_object_foreach(numbers, key, value)
        add_row(t, key, (uint64_t)json_integer_value(value));
    json_decref(numbers);
}

static void add_notes(report_table *t, const report_accounts *a)
{
    char text[256];
    double share[SIM_BASIS_COUNT];
    snprintf(text, sizeof text, "Lane utilisation of vector ops: %.1f %%.", 100 * report_accounts_totals(a).lane_utilisation);
    report_table_add_note(t, text);
    if (!a->issue)
        return;
    size_t length = (size_t)snprintf(text, sizeof text, "Cycles by the basis of the machine's numbers:");
    report_basis_shares(a, share);
    for (int i = 0; i < SIM_BASIS_COUNT; i++)
        length += (size_t)snprintf(text + length, sizeof text - length, " %s %.1f %%%s", sim_basis_name((sim_basis)i),
                                   100 * share[i], i + 1 < SIM_BASIS_COUNT ? "," : ".");
    report_table_add_note(t, text);
}

void report_accounts_rows(report_table *t, const report_accounts *a)
{
    report_op_totals totals = report_accounts_totals(a);
    report_table_begin_group(t, "ops");
    add_row(t, "total", totals.total);
    add_row(t, "vector", totals.vector);
    add_row(t, "scalar and mask", totals.scalar);
    add_row(t, "that access memory", totals.memory);
    add_object(t, "ops by instruction", by_op_json(a->ops));
    report_table_begin_group(t, "simulated cycles");
    add_row(t, "total", a->cycles);
    if (a->issue) {
        const sim_cycles cycles = cycles_of(a->issue);
        add_object(t, "cycles by phase", phases_json(a));
        add_object(t, "cycles by stall", report_stalls_json(&cycles));
    }
    add_notes(t, a);
}
