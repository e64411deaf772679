#include "sim/neighbours.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim/machine_fields.h"

enum { MOST_STEPS = 2 };

static bool is_size(const sim_field_rule *rule)
{
    static const char *const units[] = {"bytes", "entries", "ways", "banks"};
    for (size_t i = 0; i < sizeof units / sizeof *units; i++)
        if (strcmp(rule->unit, units[i]) == 0)
            return true;
    return false;
}

/* Values one step away, in the field's own units, smaller ones first; returns how many. */
static int steps_of(const sim_field_rule *rule, uint64_t value, uint64_t steps[MOST_STEPS])
{
    int count = 0;
    if (rule->kind == SIM_KIND_PIPES) {
        for (uint64_t pipes = SIM_PIPE_U; pipes <= (SIM_PIPE_U | SIM_PIPE_V); pipes++)
            if (pipes != value)
                steps[count++] = pipes;
        return count;
    }
    uint64_t step = (value + 5) / 10 > 1 ? (value + 5) / 10 : 1;
    uint64_t less = is_size(rule) ? value / 2 : value - step, more = is_size(rule) ? 2 * value : value + step;
    if (value > 0 && less >= rule->min && less < value)
        steps[count++] = less;
    if (more <= rule->max && more > value)
        steps[count++] = more;
    return count;
}

/* The machine with one field changed; *out NULL if no such machine passes its checks. */
static base_status change(const sim_machine *machine, const sim_field *field, uint64_t value, sim_machine **out, base_error *err)
{
    char assignment[120], text[24];
    sim_field_write(field->rule, value, text);
    snprintf(assignment, sizeof assignment, "%s.%s=%s", field->section, field->rule->key, text);
    *out = malloc(sizeof **out);
    if (!*out)
        return base_fail(err, BASE_ERR_NOMEM, "machine", "out of memory");
    **out = *machine;
    if (sim_machine_set(*out, assignment, NULL) != BASE_OK || sim_machine_check(*out, NULL) != BASE_OK)
        sim_machine_destroy(out);
    return BASE_OK;
}

/* All neighbours in one field. */
static base_status add_field(const sim_machine *machine, size_t number, const sim_field *field, sim_neighbours *out, base_error *err)
{
    uint64_t steps[MOST_STEPS];
    const size_t before = out->count;
    int count = steps_of(field->rule, machine->values[number].value, steps);
    base_status status = BASE_OK;
    for (int i = 0; status == BASE_OK && i < count; i++) {
        sim_neighbour *n = &out->list[out->count];
        *n = (sim_neighbour){.field = number};
        status = change(machine, field, steps[i], &n->machine, err);
        sim_field_write(field->rule, steps[i], n->value);
        out->count += n->machine != NULL;
    }
    if (count > 0 && out->count == before)
        out->stuck[out->stuck_count++] = number;
    return status;
}

base_status sim_neighbours_create(const sim_machine *machine, const char *model, uint32_t classes, sim_neighbours *out, base_error *err)
{
    *out = (sim_neighbours){.list = calloc((size_t)SIM_FIELDS * MOST_STEPS, sizeof *out->list),
                            .stuck = calloc(SIM_FIELDS, sizeof *out->stuck)};
    if (!out->list || !out->stuck)
        return base_fail(err, BASE_ERR_NOMEM, "machine", "out of memory");
    base_status status = BASE_OK;
    for (size_t number = 0; status == BASE_OK && number < SIM_FIELDS; number++) {
        sim_field field;
        if (!sim_field_get(number, &field) || !strstr(field.rule->used_by, model))
            continue;
        if (field.cost_class == LRB_CLASS_COUNT || classes >> field.cost_class & 1)
            status = add_field(machine, number, &field, out, err);
    }
    return status;
}

void sim_neighbours_destroy(sim_neighbours *n)
{
    for (size_t i = 0; n->list && i < n->count; i++)
        sim_machine_destroy(&n->list[i].machine);
    free(n->list);
    free(n->stuck);
    *n = (sim_neighbours){0};
}
