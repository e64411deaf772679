#include <stdlib.h>

#include "sim/core_state.h"

static unsigned lines_under_way(const sim_machine *machine)
{
    return machine->threads * machine->memory.demand_misses_per_thread + machine->memory.prefetches_per_core;
}

/* So many ops, at two a cycle, take longer than any line; distances are below LRB_FAR. A power of two. */
static uint32_t late_window_of(const sim_machine *machine)
{
    uint64_t tenths = sim_machine_memory_tenths(machine);
    tenths = machine->l2.cycles_per_line_tenths > tenths ? machine->l2.cycles_per_line_tenths : tenths;
    uint64_t longest = machine->memory.latency + machine->l2.latency + sim_longest_latency(machine) +
                       (lines_under_way(machine) + 1) * (tenths / 10 + 1);
    uint32_t window = 64;
    while (window < LRB_FAR && window < 2 * longest)
        window *= 2;
    return window;
}

static bool slots_create(sim_slots *slots, unsigned count)
{
    *slots = (sim_slots){.count = count, .until = calloc(count ? count : 1, sizeof *slots->until)};
    return slots->until;
}

static bool thread_create(sim_core *s, unsigned t)
{
    core_thread *h = &s->thread[t];
    h->issued_begin = calloc(CORE_ROOM(s->window), sizeof *h->issued_begin);
    h->issued = h->issued_begin + s->window;
    h->producer = calloc(CORE_ROOM(s->window), 1);
    h->op = h->block_end = h->block;
    h->late = calloc(s->late_window, sizeof *h->late);
    h->scratch = t * LRB_SCRATCH_BYTES;
    return slots_create(&h->misses, s->machine->memory.demand_misses_per_thread) && h->issued_begin && h->producer && h->late;
}

/* By class; the price of any of its ops has them. */
static void fill_latencies(sim_core *s)
{
    for (int id = 0; id < LRB_OP_COUNT; id++)
        for (int kind = 0; kind < SIM_CONSUMERS; kind++)
            s->latency[s->price[id].class_id * SIM_CONSUMERS + kind] = s->price[id].latency.ready[kind];
}

static bool create_parts(sim_core *s)
{
    const sim_machine *machine = s->machine;
    s->window = sim_window(machine);
    s->late_window = late_window_of(machine);
    s->gap = machine->issue_gap;
    s->blamed_gap = sim_blame(s->gap, SIM_BUCKET_NONE);
    s->threads = machine->threads;
    s->line_bits = (unsigned)__builtin_ctz(machine->l1.line_bytes);
    s->longest_latency = sim_longest_latency(machine);
    s->last = s->threads - 1;
    s->price = sim_op_prices(machine);
    s->blocks = core_blocks_create(2 * (s->longest_latency + 1));
    s->forms = calloc((size_t)SIM_MAX_PHASES * CORE_FORMS, sizeof *s->forms);
    s->thread = calloc(s->threads, sizeof *s->thread);
    if (!s->price || !s->blocks || !s->forms || !s->thread || !slots_create(&s->prefetches, machine->memory.prefetches_per_core))
        return false;
    fill_latencies(s);
    for (unsigned t = 0; t < s->threads; t++)
        if (!thread_create(s, t))
            return false;
    return true;
}

base_status sim_core_create(const sim_machine *machine, sim_core **out, base_error *err)
{
    sim_core *s = calloc(1, sizeof *s);
    base_status status = BASE_OK;
    *out = s;
    if (s)
        s->machine = machine;
    if (!s || !create_parts(s))
        status = base_fail(err, BASE_ERR_NOMEM, "core model", "out of memory");
    if (status == BASE_OK)
        status = sim_hierarchy_create(machine, lines_under_way(machine), &s->memory, err);
    for (unsigned t = 0; status == BASE_OK && t < s->threads; t++)
        s->thread[t].access[0] = (core_access){.line = SIM_NO_LINE, .slot = s->memory->known_count};
    if (status == BASE_OK)
        status = sim_predictor_create(machine->branch.btb_entries, machine->branch.btb_ways, &s->predictor, err);
    if (status != BASE_OK)
        sim_core_destroy(out);
    return status;
}

void sim_core_destroy(sim_core **core)
{
    sim_core *s = *core;
    for (unsigned t = 0; s && s->thread && t < s->threads; t++) {
        free(s->thread[t].issued_begin);
        free(s->thread[t].producer);
        free(s->thread[t].late);
        free(s->thread[t].misses.until);
    }
    if (s) {
        free(s->price);
        free(s->blocks);
        free(s->forms);
        free(s->thread);
        free(s->prefetches.until);
        sim_hierarchy_destroy(&s->memory);
        sim_predictor_destroy(&s->predictor);
    }
    free(s);
    *core = NULL;
}
