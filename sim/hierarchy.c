#include "sim/hierarchy.h"

#include <stdlib.h>

void sim_hierarchy_destroy(sim_hierarchy **h)
{
    if (*h) {
        sim_cache_destroy(&(*h)->l1);
        sim_cache_destroy(&(*h)->l2);
        free((*h)->to_l1.lines);
        free((*h)->to_l2.lines);
        free((*h)->known);
    }
    free(*h);
    *h = NULL;
}

/* No line is known, and that which is none lies in the free place behind all others. */
static bool know_none(sim_hierarchy *h)
{
    const uint64_t places = h->l1->sets * h->l1->ways;
    h->known_shift = 31;
    while (1u << (32 - h->known_shift) < 2 * places && h->known_shift > 1)
        h->known_shift--;
    h->known_count = 1u << (32 - h->known_shift);
    h->known = malloc((h->known_count + 1) * sizeof *h->known);
    h->lines = h->l1->lines;
    h->used = h->l1->used;
    for (uint32_t i = 0; h->known && i <= h->known_count; i++)
        h->known[i] = (uint32_t)places;
    return h->known;
}

base_status sim_hierarchy_create(const sim_machine *machine, unsigned lines, sim_hierarchy **out, base_error *err)
{
    sim_hierarchy *h = calloc(1, sizeof *h);
    *out = h;
    if (h) {
        h->l2_line_tenths = machine->l2.cycles_per_line_tenths;
        h->memory_line_tenths = sim_machine_memory_tenths(machine);
        h->l2_extra = machine->l2.latency - machine->l1.latency;
        h->memory_extra = machine->memory.latency - machine->l1.latency;
        h->to_l1.lines = calloc(lines, sizeof *h->to_l1.lines);
        h->to_l2.lines = calloc(lines, sizeof *h->to_l2.lines);
    }
    base_status status = BASE_OK;
    if (!h || !h->to_l1.lines || !h->to_l2.lines)
        status = base_fail(err, BASE_ERR_NOMEM, "core model", "out of memory");
    if (status == BASE_OK)
        status = sim_cache_create(machine->l1.size_bytes, machine->l1.ways, machine->l1.line_bytes, &h->l1, err);
    if (status == BASE_OK)
        status = sim_cache_create(machine->l2.size_bytes, machine->l2.ways, machine->l2.line_bytes, &h->l2, err);
    if (status == BASE_OK && !know_none(h))
        status = base_fail(err, BASE_ERR_NOMEM, "core model", "out of memory");
    if (status != BASE_OK)
        sim_hierarchy_destroy(out);
    return status;
}

/* When a line arrives that is on its way, and from where; arrival 0 if it is not. Lines that have arrived stay until
   add_flight needs their place. */
static sim_fetch find_flight(const sim_flight *f, uint64_t line, uint64_t now)
{
    if (f->latest > now)
        for (unsigned i = 0; i < f->count; i++)
            if (f->lines[i].line == line && f->lines[i].arrival > now)
                return (sim_fetch){.arrival = f->lines[i].arrival, .from = f->lines[i].from};
    return (sim_fetch){.arrival = 0};
}

static void add_flight(sim_flight *f, uint64_t line, uint64_t now, sim_fetch fetch)
{
    if (fetch.arrival <= now)
        return;
    for (unsigned i = 0; i < f->count;)
        if (f->lines[i].arrival <= now)
            f->lines[i] = f->lines[--f->count];
        else
            i++;
    f->lines[f->count].line = line;
    f->lines[f->count].arrival = fetch.arrival;
    f->lines[f->count++].from = fetch.from;
    f->latest = fetch.arrival > f->latest ? fetch.arrival : f->latest;
}

/* When a line asked for now is sent, in cycles; the level is then busy with it. */
static uint64_t send_line(uint64_t *level_free, uint32_t tenths, uint64_t now)
{
    uint64_t sent = now * 10 > *level_free ? now * 10 : *level_free;
    *level_free = sent + tenths;
    return (sent + 9) / 10;
}

static sim_fetch fetch_from_memory(sim_hierarchy *h, uint64_t line, uint64_t now)
{
    sim_fetch fetch = {.from = SIM_LEVEL_MEMORY, .asked = true};
    fetch.arrival = send_line(&h->memory_free, h->memory_line_tenths, now) + h->memory_extra;
    h->counts.memory_lines++;
    add_flight(&h->to_l2, line, now, fetch);
    return fetch;
}

/* The place of a line is known if it is in the first level and not on its way there. */
static void know(sim_hierarchy *h, uint64_t line, bool on_its_way)
{
    const uint64_t places = h->l1->sets * h->l1->ways;
    h->known[sim_known_slot(line, h->known_shift)] = (uint32_t)(on_its_way ? places : sim_cache_place(h->l1, line));
}

/* The first level asks for a line. */
static sim_fetch fetch_to_l1(sim_hierarchy *h, uint64_t line, uint64_t now)
{
    sim_fetch coming = find_flight(&h->to_l2, line, now), fetch;
    bool hit = sim_cache_touch(h->l2, line);
    h->counts.l2_accesses++;
    if (hit || coming.arrival) {
        fetch = (sim_fetch){.from = SIM_LEVEL_2, .asked = true};
        fetch.arrival = send_line(&h->l2_free, h->l2_line_tenths, now) + h->l2_extra;
        if (coming.arrival > fetch.arrival) {
            fetch.arrival = coming.arrival;
            fetch.from = SIM_LEVEL_MEMORY;
        }
    } else {
        fetch = fetch_from_memory(h, line, now);
        h->counts.l2_misses++;
    }
    add_flight(&h->to_l1, line, now, fetch);
    know(h, line, true);
    return fetch;
}

bool sim_hierarchy_would_miss(const sim_hierarchy *h, uint64_t line, uint64_t now)
{
    return !sim_cache_holds(h->l1, line) && !find_flight(&h->to_l1, line, now).arrival;
}

bool sim_hierarchy_would_miss_l2(const sim_hierarchy *h, uint64_t line, uint64_t now)
{
    return !sim_cache_holds(h->l2, line) && !find_flight(&h->to_l2, line, now).arrival;
}

sim_fetch sim_hierarchy_access(sim_hierarchy *h, uint64_t line, uint64_t now)
{
    const bool hit = sim_cache_touch(h->l1, line);
    const sim_fetch coming = find_flight(&h->to_l1, line, now);
    if (hit || coming.arrival) {
        h->counts.l1_waits += coming.arrival > 0;
        know(h, line, coming.arrival > 0);
        return coming;
    }
    h->counts.l1_misses++;
    return fetch_to_l1(h, line, now);
}

sim_fetch sim_hierarchy_prefetch(sim_hierarchy *h, uint64_t line, uint64_t now, sim_level level)
{
    h->counts.prefetches++;
    if (level == SIM_LEVEL_1) {
        sim_cache_touch(h->l1, line);
        return fetch_to_l1(h, line, now);
    }
    sim_cache_touch(h->l2, line);
    return fetch_from_memory(h, line, now);
}
