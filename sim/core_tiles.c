#include <string.h>

#include "sim/core_state.h"

/* Cycles up to now belong to the phase and region that end here. */
static void end_phase(sim_core *s, core_thread *h, uint32_t next)
{
    s->stats.phase[h->phase] += h->cycles - h->phase_start;
    h->phase_start = h->cycles;
    h->phase = h->at.phase = next < SIM_MAX_PHASES ? next : SIM_MAX_PHASES - 1;
}

static void end_region(core_thread *h, uint32_t next)
{
    h->regions[h->region] += h->cycles - h->region_start;
    h->region_start = h->cycles;
    h->region = next < SIM_MAX_REGIONS ? next : SIM_MAX_REGIONS;
}

static void pass(sim_core *s, core_thread *h, const lrb_event *markers, uint32_t count)
{
    for (const lrb_event *e = markers; e < markers + count; e++) {
        if (s->observer)
            core_tell(s, h, e);
        if ((e->op & LRB_EVENT_ID) == LRB_OP_phase)
            end_phase(s, h, e->aux);
        else if ((e->op & LRB_EVENT_ID) == LRB_OP_region)
            end_region(h, e->aux);
        else if ((e->op & LRB_EVENT_ID) == LRB_OP_line)
            h->at.site = e->aux;
    }
}

/* One number for each source of an op, worked on together. */
typedef uint16_t four_sources __attribute__((vector_size(8)));

static inline four_sources load_four(const uint16_t numbers[SIM_MAX_SOURCES])
{
    four_sources four;
    memcpy(&four, numbers, sizeof four);
    return four;
}

/* Where the sources of an op are among the results. Those that it does not have, and those of long ago, are 0: behind the window. */
static inline void place_sources(core_op *op, uint32_t number, uint32_t window)
{
    const four_sources distance = load_four(op->event->src);
    const four_sources recent = (four_sources)(distance - 1 < (uint16_t)(window - 1));
    const four_sources place = ((uint16_t)number - distance) & (uint16_t)(window - 1);
    const four_sources source = place * SIM_CONSUMERS + (four_sources){op->price->consumer[0], op->price->consumer[1], op->price->consumer[2], op->price->consumer[3]};
    const four_sources chosen = (source & recent) | ((uint16_t)(window * SIM_CONSUMERS) & ~recent);
    memcpy(op->source, &chosen, sizeof chosen);
}

/* Lanes of the ops of a phase. */
typedef struct lane_counts {
    uint64_t vector_ops, idle_lanes;
} lane_counts;

static void add_lanes(sim_core *s, core_thread *h, lane_counts *lanes)
{
    s->stats.phase_vector_ops[h->decoded_phase] += lanes->vector_ops;
    s->stats.phase_idle_lanes[h->decoded_phase] += lanes->idle_lanes;
    *lanes = (lane_counts){0};
}

/* Make the next ops of the tile ready. All before have issued. */
static void decode(sim_core *s, core_thread *h)
{
    const uint32_t window = s->window;
    uint32_t number = h->next, markers = 0;
    core_op *op = h->block;
    const lrb_event *e = h->decoded;
    lane_counts lanes = {0};
    for (; e < h->end && op < h->block + CORE_BLOCK; e++) {
        const sim_op_price *p = &s->price[e->op];
        s->ops[e->op & (CORE_OPS - 1)]++;
        if (p->flags & SIM_PRICE_MARKER) {
            markers++;
            if ((e->op & LRB_EVENT_ID) == LRB_OP_phase) {
                add_lanes(s, h, &lanes);
                h->decoded_phase = e->aux < SIM_MAX_PHASES ? e->aux : SIM_MAX_PHASES - 1;
            }
            continue;
        }
        lanes.vector_ops += p->lanes & 1;
        lanes.idle_lanes += (unsigned)__builtin_popcount(p->lanes & ~(unsigned)e->mask);
        s->stats.memory_operands += (e->op & LRB_FORM_MEMORY) != 0;
        *op = (core_op){.price = p, .event = e, .pause = markers};
        place_sources(op++, number++, window);
        markers = 0;
    }
    add_lanes(s, h, &lanes);
    op->pause = CORE_END;
    h->trailing = markers;
    h->decoded = e;
    h->op = h->block;
}

bool core_pass_markers(sim_core *s, core_thread *h)
{
    while (h->op->pause == CORE_END) {
        pass(s, h, h->decoded - h->trailing, h->trailing);
        h->trailing = 0;
        if (h->decoded == h->end)
            return false;
        decode(s, h);
    }
    pass(s, h, h->op->event - h->op->pause, h->op->pause);
    return true;
}

bool core_begin_tile(sim_core *s, core_thread *h, const lrb_event *events, size_t count)
{
    memset(h->results, 0, s->window * sizeof *h->results);
    memset(h->stores, 0, sizeof h->stores);
    memset(h->regions, 0, sizeof h->regions);
    h->tile_first = h->next;
    h->late_until = h->stores_until = 0;
    h->partners = 0;
    h->phase = h->decoded_phase = 0;
    h->at = (sim_whereabouts){0};
    h->region = SIM_MAX_REGIONS;
    h->phase_start = h->region_start = h->cycles;
    h->decoded = events;
    h->end = events + count;
    decode(s, h);
    return core_find_op(s, h);
}

void core_end_tile(sim_core *s, core_thread *h)
{
    end_phase(s, h, 0);
    end_region(h, 0);
}
