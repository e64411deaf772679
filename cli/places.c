#include "cli/places.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

place_groups place_groups_of(const sim_cycles *c)
{
    place_groups g = {.cycles = sim_cycles_sum(c), .issue = c->issued_one + c->issued_pair,
                      .memory = c->l2 + c->memory + c->misses + c->prefetches, .operand = c->store_forward};
    for (int k = 0; k < LRB_CLASS_COUNT; k++)
        for (int kind = 0; kind < SIM_CONSUMERS; kind++)
            g.operand += c->operand[k][kind];
    g.other = g.cycles - g.issue - g.operand - g.memory;
    return g;
}

static place place_of(const sim_place *cost)
{
    place p = {.source = kernel_source_find(cost->site >> 16), .cost = *cost};
    if (p.source)
        p.function = kernel_source_function(p.source, cost->site & 0xffff);
    return p;
}

/* Put a line to the function or source of the same name, or begin it. */
static void add_to(place *list, size_t *count, const place *line, bool by_function)
{
    for (size_t i = 0; i < *count; i++)
        if (list[i].cost.site >> 16 == line->cost.site >> 16 && (!by_function || list[i].function.text == line->function.text)) {
            sim_place_add(&list[i].cost, &line->cost);
            return;
        }
    list[*count] = *line;
    if (!by_function)
        list[*count].function = (kernel_source_line){NULL, 0};
    (*count)++;
}

static int by_cycles(const void *a, const void *b)
{
    const place *p = a, *q = b;
    uint64_t x = sim_cycles_sum(&p->cost.cycles), y = sim_cycles_sum(&q->cost.cycles);
    if (x != y)
        return x < y ? 1 : -1;
    return (p->cost.site > q->cost.site) - (p->cost.site < q->cost.site);
}

base_status places_create(const run_result *result, places *out, base_error *err)
{
    sim_place *costs;
    *out = (places){0};
    base_status status = sim_profile_lines(result->profile, &costs, &out->line_count, err);
    if (status != BASE_OK)
        return status;
    out->lines = calloc(out->line_count + 1, sizeof *out->lines);
    out->functions = calloc(out->line_count + 1, sizeof *out->functions);
    out->sources = calloc(out->line_count + 1, sizeof *out->sources);
    if (!out->lines || !out->functions || !out->sources)
        status = base_fail(err, BASE_ERR_NOMEM, "profile", "out of memory");
    for (size_t i = 0; status == BASE_OK && i < out->line_count; i++) {
        out->lines[i] = place_of(&costs[i]);
        add_to(out->functions, &out->function_count, &out->lines[i], true);
        add_to(out->sources, &out->source_count, &out->lines[i], false);
        sim_place_add(&out->total, &costs[i]);
    }
    free(costs);
    if (status == BASE_OK) {
        qsort(out->functions, out->function_count, sizeof *out->functions, by_cycles);
        qsort(out->sources, out->source_count, sizeof *out->sources, by_cycles);
    }
    return status;
}

void places_destroy(places *p)
{
    free(p->lines);
    free(p->functions);
    free(p->sources);
    *p = (places){0};
}

const char *place_function_name(const place *p, char name[64])
{
    snprintf(name, 64, "%.*s", p->function.text ? (int)p->function.length : 6, p->function.text ? p->function.text : "(none)");
    return name;
}

const char *place_source_name(const place *p, char name[64])
{
    if (p->source)
        return p->source->path;
    snprintf(name, 64, "source %u", p->cost.site >> 16);
    return name;
}
