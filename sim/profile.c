#include "sim/profile.h"

#include <stdlib.h>

#include "sim/profile_charge.h"

enum { FIRST_LINES = 256, KINDS = 3 };

base_status sim_profile_create(sim_profile **out, base_error *err)
{
    sim_profile *p = calloc(1, sizeof *p);
    if (p)
        p->lines = calloc(FIRST_LINES, sizeof *p->lines);
    if (!p || !p->lines) {
        sim_profile_destroy(&p);
        return base_fail(err, BASE_ERR_NOMEM, "profile", "out of memory");
    }
    p->line_capacity = FIRST_LINES;
    *out = p;
    return BASE_OK;
}

void sim_profile_destroy(sim_profile **p)
{
    if (*p)
        free((*p)->lines);
    free(*p);
    *p = NULL;
}

/* Where a site is in the table, or the empty place where it belongs. */
static size_t find_line(const sim_line_cost *lines, size_t capacity, uint32_t site)
{
    size_t place = (site * UINT32_C(2654435761)) & (capacity - 1);
    while (lines[place].used && lines[place].site != site)
        place = (place + 1) & (capacity - 1);
    return place;
}

/* Twice the room. */
static bool grow_lines(sim_profile *p)
{
    size_t capacity = 2 * p->line_capacity;
    sim_line_cost *lines = calloc(capacity, sizeof *lines);
    if (!lines)
        return false;
    for (size_t i = 0; i < p->line_capacity; i++)
        if (p->lines[i].used)
            lines[find_line(lines, capacity, p->lines[i].site)] = p->lines[i];
    free(p->lines);
    p->lines = lines;
    p->line_capacity = capacity;
    return true;
}

/* The place of a line in the table; one that has no room is left out, and the profile is a failure. */
static size_t line_of(sim_profile *p, uint32_t site)
{
    size_t place = find_line(p->lines, p->line_capacity, site);
    if (p->lines[place].used)
        return place;
    if (p->line_count >= p->line_capacity / 2) {
        if (!grow_lines(p)) {
            p->failed = true;
            return 0;
        }
        place = find_line(p->lines, p->line_capacity, site);
    }
    p->lines[place].used = true;
    p->lines[place].site = site;
    p->line_count++;
    return place;
}

/* The places of an op: of its kind, its phase and its line. */
static void costs_of(sim_profile *p, sim_whereabouts *at, unsigned id, sim_cost *costs[KINDS])
{
    if (at->line >= p->line_capacity || !p->lines[at->line].used || p->lines[at->line].site != at->site)
        at->line = line_of(p, at->site);
    costs[0] = &p->op[id];
    costs[1] = &p->phase[at->phase];
    costs[2] = &p->lines[at->line].cost;
}

void sim_profile_issue(sim_profile *p, sim_whereabouts *at, unsigned id, unsigned lanes, unsigned mask, bool joins)
{
    sim_cost *costs[KINDS];
    costs_of(p, at, id, costs);
    for (int k = 0; k < KINDS; k++) {
        costs[k]->ops++;
        costs[k]->vector_ops += lanes & 1;
        costs[k]->idle_lanes += (unsigned)__builtin_popcount(lanes & ~mask);
        costs[k]->issued_one += !joins;
    }
    if (joins) {
        costs_of(p, &p->last_at, p->last_id, costs);
        for (int k = 0; k < KINDS; k++) {
            costs[k]->issued_one--;
            costs[k]->issued_pair++;
        }
    } else {
        p->last_at = *at;
        p->last_id = id;
    }
}

void sim_profile_wait(sim_profile *p, sim_whereabouts *at, unsigned id, unsigned bucket, uint64_t cycles)
{
    sim_cost *costs[KINDS];
    if (cycles == 0) /* and nothing is to blame */
        return;
    costs_of(p, at, id, costs);
    for (int k = 0; k < KINDS; k++)
        costs[k]->waited[bucket] += cycles;
}

void sim_cycles_of_buckets(const uint64_t waited[SIM_BUCKETS], sim_cycles *to)
{
    for (int k = 0; k < LRB_CLASS_COUNT; k++) {
        for (int kind = 0; kind < SIM_CONSUMERS; kind++)
            to->operand[k][kind] = waited[SIM_BUCKET_OPERAND + k * SIM_CONSUMERS + kind];
        to->busy[k] = waited[SIM_BUCKET_BUSY + k];
    }
    to->l2 = waited[SIM_BUCKET_L2];
    to->memory = waited[SIM_BUCKET_MEMORY];
    to->store_forward = waited[SIM_BUCKET_STORE];
    to->blocked = waited[SIM_BUCKET_BLOCKED];
    to->delay = waited[SIM_BUCKET_DELAY];
    to->mispredict = waited[SIM_BUCKET_MISPREDICT];
    to->btb_miss = waited[SIM_BUCKET_BTB_MISS];
    to->misses = waited[SIM_BUCKET_MISSES];
    to->prefetches = waited[SIM_BUCKET_PREFETCHES];
}

uint64_t sim_cycles_sum(const sim_cycles *c)
{
    /* All members are uint64_t cycles. */
    const uint64_t *members = (const uint64_t *)c;
    uint64_t sum = 0;
    for (size_t i = 0; i < sizeof *c / sizeof *members; i++)
        sum += members[i];
    return sum;
}

void sim_place_add(sim_place *to, const sim_place *from)
{
    uint64_t *t = (uint64_t *)&to->cycles;
    const uint64_t *f = (const uint64_t *)&from->cycles;
    to->ops += from->ops;
    to->vector_ops += from->vector_ops;
    to->idle_lanes += from->idle_lanes;
    for (size_t i = 0; i < sizeof to->cycles / sizeof *t; i++)
        t[i] += f[i];
}

static sim_place place_of(const sim_cost *c, uint32_t site)
{
    sim_place place = {.site = site, .ops = c->ops, .vector_ops = c->vector_ops, .idle_lanes = c->idle_lanes};
    sim_cycles_of_buckets(c->waited, &place.cycles);
    place.cycles.issued_one = c->issued_one;
    place.cycles.issued_pair = c->issued_pair;
    place.cycles.gap = c->waited[SIM_BUCKET_NONE];
    return place;
}

sim_place sim_profile_phase(const sim_profile *p, unsigned phase)
{
    return place_of(&p->phase[phase], 0);
}

sim_place sim_profile_op(const sim_profile *p, lrb_op_id id)
{
    return place_of(&p->op[id], 0);
}

static int by_site(const void *a, const void *b)
{
    const uint32_t x = ((const sim_place *)a)->site, y = ((const sim_place *)b)->site;
    return (x > y) - (x < y);
}

base_status sim_profile_lines(const sim_profile *p, sim_place **lines, size_t *count, base_error *err)
{
    *lines = p->failed ? NULL : malloc((p->line_count + 1) * sizeof **lines);
    *count = 0;
    if (!*lines)
        return base_fail(err, BASE_ERR_NOMEM, "profile", "out of memory");
    for (size_t i = 0; i < p->line_capacity; i++)
        if (p->lines[i].used)
            (*lines)[(*count)++] = place_of(&p->lines[i].cost, p->lines[i].site);
    qsort(*lines, *count, sizeof **lines, by_site);
    return BASE_OK;
}

static void add_costs(sim_cost *to, const sim_cost *from)
{
    /* All members are uint64_t counts. */
    uint64_t *t = (uint64_t *)to;
    const uint64_t *f = (const uint64_t *)from;
    for (size_t i = 0; i < sizeof *to / sizeof *t; i++)
        t[i] += f[i];
}

base_status sim_profile_add(sim_profile *to, const sim_profile *from, base_error *err)
{
    for (int id = 0; id < LRB_OP_COUNT; id++)
        add_costs(&to->op[id], &from->op[id]);
    for (int phase = 0; phase < SIM_MAX_PHASES; phase++)
        add_costs(&to->phase[phase], &from->phase[phase]);
    for (size_t i = 0; i < from->line_capacity; i++)
        if (from->lines[i].used) {
            size_t line = line_of(to, from->lines[i].site); /* which may move the lines */
            add_costs(&to->lines[line].cost, &from->lines[i].cost);
        }
    to->failed |= from->failed;
    return to->failed ? base_fail(err, BASE_ERR_NOMEM, "profile", "out of memory") : BASE_OK;
}
