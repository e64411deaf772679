#include "sim/machine.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lrbni/base/hash.h"
#include "sim/cache.h"
#include "sim/machine_fields.h"
#include "sim/machine_values.h"

const char *sim_basis_name(sim_basis basis)
{
    static const char *const names[SIM_BASIS_COUNT] = {"documented", "measured", "inferred", "assumed", "override"};
    return names[basis];
}

const char *const *sim_machine_names(size_t *count)
{
    *count = sim_builtin_count;
    return sim_builtin_names;
}

static void set_default(sim_machine *machine, size_t number, const sim_field *field)
{
    sim_machine_value *slot = &machine->values[number];
    bool zero = field->rule->fallback == SIM_DEFAULT_ZERO;
    slot->value = zero ? 0 : machine->values[sim_class_field(field->cost_class, SIM_KEY_latency)].value;
    slot->basis = SIM_BASIS_INFERRED;
    snprintf(slot->source, sizeof slot->source, "%s", zero ? "default: none" : "default: as latency");
}

static void store_member(sim_machine *machine, const sim_field *field, uint64_t value)
{
    char *member = (char *)machine + field->offset;
    unsigned narrow = (unsigned)value;
    if (field->rule->kind == SIM_KIND_WIDE)
        memcpy(member, &value, sizeof value);
    else
        memcpy(member, &narrow, sizeof narrow);
}

void sim_machine_refresh(sim_machine *machine)
{
    sim_field field;
    /* A class that lacks a latency_to_... field behaves as if it had the default. */
    for (size_t c = 0; c < LRB_CLASS_COUNT; c++) {
        unsigned latency = (unsigned)machine->values[sim_class_field((lrb_cost_class)c, SIM_KEY_latency)].value;
        machine->cost[c].latency_to_shuffle = latency;
        machine->cost[c].latency_to_branch = latency;
        machine->cost[c].latency_to_address = latency;
        machine->cost[c].latency_to_mask = latency;
    }
    for (size_t number = 0; number < SIM_FIELDS; number++) {
        if (!sim_field_get(number, &field))
            continue;
        if (!machine->values[number].given && field.rule->fallback != SIM_DEFAULT_REQUIRED)
            set_default(machine, number, &field);
        store_member(machine, &field, machine->values[number].value);
    }
}

/* Say why `number` is at fault; to be returned from a flaw_in_... function. */
__attribute__((format(printf, 3, 4)))
static size_t flaw(char why[SIM_MACHINE_TEXT_SIZE], size_t number, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(why, SIM_MACHINE_TEXT_SIZE, format, args);
    va_end(args);
    return number;
}

static size_t flaw_in_class(const sim_machine *machine, lrb_cost_class c, char why[SIM_MACHINE_TEXT_SIZE])
{
    const sim_class_cost *cost = &machine->cost[c];
    if (cost->throughput == 1 && cost->pipes != (SIM_PIPE_U | SIM_PIPE_V))
        return flaw(why, sim_class_field(c, SIM_KEY_throughput), "0.5, two a cycle, needs both pipes");
    if (cost->latency_to_shuffle < cost->latency)
        return flaw(why, sim_class_field(c, SIM_KEY_latency_to_shuffle), "%u is less than latency, %u",
                    cost->latency_to_shuffle, cost->latency);
    if (cost->latency_to_address < cost->latency)
        return flaw(why, sim_class_field(c, SIM_KEY_latency_to_address), "%u is less than latency, %u",
                    cost->latency_to_address, cost->latency);
    return SIM_FIELDS;
}

static bool is_power_of_two(unsigned n)
{
    return n != 0 && (n & (n - 1)) == 0;
}

static size_t flaw_in_caches(const sim_machine *m, char why[SIM_MACHINE_TEXT_SIZE])
{
    if (!is_power_of_two(m->l1.line_bytes))
        return flaw(why, SIM_FIELD_l1_line_bytes, "%u is not a power of two", m->l1.line_bytes);
    if (m->l2.line_bytes != m->l1.line_bytes)
        return flaw(why, SIM_FIELD_l2_line_bytes, "%u is not l1.line_bytes, %u", m->l2.line_bytes, m->l1.line_bytes);
    if (!sim_cache_fits(m->l1.size_bytes, m->l1.ways, m->l1.line_bytes))
        return flaw(why, SIM_FIELD_l1_size_bytes, "%u is not a power of two times l1.ways x l1.line_bytes, %u x %u",
                    m->l1.size_bytes, m->l1.ways, m->l1.line_bytes);
    if (!sim_cache_fits(m->l2.size_bytes, m->l2.ways, m->l2.line_bytes))
        return flaw(why, SIM_FIELD_l2_size_bytes, "%u is not a power of two times l2.ways x l2.line_bytes, %u x %u",
                    m->l2.size_bytes, m->l2.ways, m->l2.line_bytes);
    if (m->l2.latency < m->l1.latency)
        return flaw(why, SIM_FIELD_l2_latency, "%u is less than l1.latency, %u", m->l2.latency, m->l1.latency);
    if (m->l2.remote_latency < m->l2.latency)
        return flaw(why, SIM_FIELD_l2_remote_latency, "%u is less than l2.latency, %u", m->l2.remote_latency,
                    m->l2.latency);
    if (m->memory.latency < m->l2.latency)
        return flaw(why, SIM_FIELD_memory_latency, "%u is less than l2.latency, %u", m->memory.latency, m->l2.latency);
    return SIM_FIELDS;
}

size_t sim_machine_flaw(const sim_machine *machine, char why[SIM_MACHINE_TEXT_SIZE])
{
    for (size_t c = 0; c < LRB_CLASS_COUNT; c++) {
        size_t number = flaw_in_class(machine, (lrb_cost_class)c, why);
        if (number != SIM_FIELDS)
            return number;
    }
    if (!sim_cache_fits(machine->branch.btb_entries, machine->branch.btb_ways, 1))
        return flaw(why, SIM_FIELD_branch_btb_entries, "%u is not a power of two times branch.btb_ways, %u",
                    machine->branch.btb_entries, machine->branch.btb_ways);
    return flaw_in_caches(machine, why);
}

base_status sim_machine_check(const sim_machine *machine, base_error *err)
{
    char why[SIM_MACHINE_TEXT_SIZE], what[80];
    sim_field field;
    if (!sim_field_get(sim_machine_flaw(machine, why), &field))
        return BASE_OK;
    snprintf(what, sizeof what, "%s.%s", field.section, field.rule->key);
    return base_fail(err, BASE_ERR_USAGE, what, "%s", why);
}

base_status sim_machine_set(sim_machine *machine, const char *assignment, base_error *err)
{
    char name[80], what[100];
    const char *equals = strchr(assignment, '=');
    if (!equals)
        return base_fail(err, BASE_ERR_USAGE, "--set", "'%.60s' is not FIELD=VALUE", assignment);
    snprintf(what, sizeof what, "--set %.*s", (int)(equals - assignment > 79 ? 79 : equals - assignment), assignment);
    size_t number = SIM_FIELDS;
    if ((size_t)(equals - assignment) < sizeof name) {
        snprintf(name, sizeof name, "%.*s", (int)(equals - assignment), assignment);
        char *dot = strchr(name, '.');
        if (dot)
            *dot = 0;
        number = dot ? sim_field_find(name, dot + 1) : sim_field_find("machine", name);
    }
    sim_field field;
    if (!sim_field_get(number, &field))
        return base_fail(err, BASE_ERR_USAGE, what, "no such field of a machine");
    sim_machine_value *slot = &machine->values[number];
    base_status status = sim_field_read(field.rule, equals + 1, BASE_ERR_USAGE, what, &slot->value, err);
    if (status != BASE_OK)
        return status;
    slot->basis = SIM_BASIS_OVERRIDE;
    slot->given = true;
    snprintf(slot->source, sizeof slot->source, "--set");
    sim_machine_refresh(machine);
    return BASE_OK;
}

unsigned sim_machine_memory_tenths(const sim_machine *machine)
{
    const uint64_t chip = machine->memory.chip_bytes_per_cycle;
    uint64_t share = chip ? ((uint64_t)machine->cores * machine->l1.line_bytes * 10 + chip - 1) / chip : 0;
    return share > machine->memory.cycles_per_line_tenths ? (unsigned)share : machine->memory.cycles_per_line_tenths;
}

void sim_machine_destroy(sim_machine **machine)
{
    free(*machine);
    *machine = NULL;
}

bool sim_machine_field(const sim_machine *machine, size_t number, sim_field_view *view)
{
    sim_field field;
    if (!sim_field_get(number, &field))
        return false;
    const sim_machine_value *slot = &machine->values[number];
    *view = (sim_field_view){.section = field.section, .key = field.rule->key, .unit = field.rule->unit,
                             .source = slot->source, .used_by = field.rule->used_by, .sentence = field.rule->sentence,
                             .basis = slot->basis, .given = slot->given};
    sim_field_write(field.rule, slot->value, view->value);
    return true;
}

uint64_t sim_machine_hash(const sim_machine *machine)
{
    uint64_t hash = BASE_HASH_START;
    sim_field_view view;
    for (size_t number = 0; number < SIM_FIELDS; number++) {
        char line[120];
        if (!sim_machine_field(machine, number, &view))
            continue;
        int size = snprintf(line, sizeof line, "%s.%s=%s\n", view.section, view.key, view.value);
        hash = base_hash(hash, line, (size_t)size);
    }
    return hash;
}

enum { FILE_LIMIT = 1 << 20 };

static base_status load_file(const char *path, sim_machine **out, base_error *err)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        return base_fail(err, BASE_ERR_INPUT, path, "%s", strerror(errno));
    base_status status = BASE_OK;
    char *text = malloc(FILE_LIMIT + 1);
    if (!text) {
        status = base_fail(err, BASE_ERR_NOMEM, path, "out of memory");
    } else {
        errno = 0;
        size_t size = fread(text, 1, FILE_LIMIT + 1, file);
        if (ferror(file))
            status = base_fail(err, BASE_ERR_INPUT, path, "%s", strerror(errno));
        else if (size > FILE_LIMIT)
            status = base_fail(err, BASE_ERR_INPUT, path, "larger than 1 MiB");
        else
            status = sim_machine_parse(path, text, size, out, err);
    }
    free(text);
    fclose(file);
    return status;
}

static base_status fail_unknown(const char *name, base_error *err)
{
    char known[200] = "";
    size_t used = 0;
    for (size_t i = 0; i < sim_builtin_count && used < sizeof known; i++)
        used += (size_t)snprintf(known + used, sizeof known - used, "%s%s", i ? ", " : "", sim_builtin_names[i]);
    return base_fail(err, BASE_ERR_USAGE, name, "no such machine; built in: %s; a path has a '/' or ends in .ini",
                     known);
}

base_status sim_machine_load(const char *name_or_path, sim_machine **out, base_error *err)
{
    size_t length = strlen(name_or_path);
    *out = NULL;
    if (strchr(name_or_path, '/') || (length >= 4 && strcmp(name_or_path + length - 4, ".ini") == 0))
        return load_file(name_or_path, out, err);
    for (size_t i = 0; i < sim_builtin_count; i++)
        if (strcmp(sim_builtin_names[i], name_or_path) == 0)
            return sim_machine_parse(sim_builtin_machines[i].label, sim_builtin_machines[i].text,
                                     sim_builtin_machines[i].size, out, err);
    return fail_unknown(name_or_path, err);
}
