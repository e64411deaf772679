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

/* What the loop over a block reads, in a place that no store of the loop can change. */
typedef struct decoder {
    const sim_op_price *price;
    uint8_t *producer;
    uint16_t window;
    uint64_t scratch;
    unsigned line_bits, known_shift;
    uint32_t known_none;
} decoder;

/* One number for each source of an op, worked on together. */
typedef uint16_t four_sources __attribute__((vector_size(8)));

/* Where the sources of an op are among the youngest ops, and how long they take. Those that it does not have, and those of long ago,
 * are behind the window, and ready. */
static inline void place_sources(const decoder *d, core_op *op, const lrb_event *e, const sim_op_price *p, uint32_t number)
{
    four_sources distance;
    uint32_t consumers;
    memcpy(&distance, e->src, sizeof distance);
    memcpy(&consumers, p->consumer, sizeof consumers);
    const four_sources recent = (four_sources)(distance - 1 < (uint16_t)(d->window - 1));
    const four_sources place = (((uint16_t)number - distance) & (uint16_t)(d->window - 1) & recent) | (d->window & ~recent);
    memcpy(op->source, &place, sizeof place);
    op->latencies = consumers + (d->producer[place[0]] | (uint32_t)d->producer[place[1]] << 8 | (uint32_t)d->producer[place[2]] << 16 |
                                 (uint32_t)d->producer[place[3]] << 24);
}

enum { ACCESS = SIM_PRICE_READS | SIM_PRICE_STORE };

/* Whether two lines lie in the same bank. */
static bool share_bank(const sim_core *s, uint64_t a, uint64_t b)
{
    return s->machine->l1.banks && (a == b || (a > b ? a - b : b - a) % s->machine->l1.banks == 0);
}

/* May two ops that access memory do so in the same cycle? */
static bool share_memory(const sim_core *s, const core_thread *h, const lrb_event *first, const sim_op_price *p, const lrb_event *e,
                         const sim_op_price *q)
{
    const unsigned loaded = (p->flags & SIM_PRICE_READS ? p->bytes : 0) + (q->flags & SIM_PRICE_READS ? q->bytes : 0);
    const unsigned stored = (p->flags & SIM_PRICE_STORE ? p->bytes : 0) + (q->flags & SIM_PRICE_STORE ? q->bytes : 0);
    return loaded <= s->machine->l1.load_bytes_per_cycle && stored <= s->machine->l1.store_bytes_per_cycle &&
           !share_bank(s, core_line_of(s, h, first), core_line_of(s, h, e));
}

/* May an op issue in V beside the one before it, first, whose price is p? */
static inline core_join may_join(const sim_core *s, const core_thread *h, const lrb_event *first, const sim_op_price *p,
                                 const lrb_event *e, const sim_op_price *q)
{
    const unsigned join = p->partners >> q->class_id & 1;
    if (join && p->flags & ACCESS && q->flags & ACCESS && !share_memory(s, h, first, p, e, q))
        return CORE_CONFLICTS;
    return join ? CORE_JOINS : CORE_APART;
}

/* Lanes that are off, and accesses of none. */
static void count_mask(sim_core *s, const core_thread *h, const lrb_event *e, const sim_op_price *p)
{
    s->stats.phase_idle_lanes[h->decoded_phase] += (unsigned)__builtin_popcount(p->lanes & ~(unsigned)e->mask);
    s->idle_accesses += p->flags & ACCESS && core_moves_nothing(e);
}

/* Make ready the op of this number, which stands behind `markers`. */
static inline void decode_op(const decoder *d, core_op *op, const lrb_event *e, const sim_op_price *p, uint32_t number, uint32_t markers)
{
    const bool accesses = p->flags & ACCESS && !core_moves_nothing(e);
    op->event = e;
    op->line = SIM_NO_LINE;
    op->slot = d->known_none;
    if (accesses) {
        op->line = (e->aux + (e->aux >= LRB_SCRATCH_ADDRESS ? d->scratch : 0)) >> d->line_bits;
        op->slot = sim_known_slot(op->line, d->known_shift);
    }
    op->pause = markers;
    op->flags = p->flags;
    op->place = (uint16_t)(number & (d->window - 1u));
    place_sources(d, op, e, p, number);
    d->producer[op->place] = (uint8_t)(p->class_id * SIM_CONSUMERS);
}

/* Make the next ops of the tile ready. All before have issued. */
static void decode(sim_core *s, core_thread *h)
{
    const decoder d = {s->price, h->producer, (uint16_t)s->window, h->scratch, s->line_bits, s->memory->known_shift, s->memory->known_count};
    uint32_t number = h->decoded_ops, markers = 0;
    uint64_t *forms = s->forms + (size_t)h->decoded_phase * CORE_FORMS;
    core_op *op = h->block;
    const lrb_event *e = h->decoded, *before = h->before, *const end = h->end;
    const sim_op_price *last = before ? &d.price[before->op] : NULL;
    h->first = number;
    for (; e < end && op < h->block + CORE_BLOCK; e++) {
        const sim_op_price *p = &d.price[e->op];
        forms[e->op]++;
        if (p->flags & SIM_PRICE_MARKER) {
            markers++;
            if ((e->op & LRB_EVENT_ID) == LRB_OP_phase) {
                h->decoded_phase = e->aux < SIM_MAX_PHASES ? e->aux : SIM_MAX_PHASES - 1;
                forms = s->forms + (size_t)h->decoded_phase * CORE_FORMS;
            }
            continue;
        }
        if (e->mask != 0xffff)
            count_mask(s, h, e, p);
        decode_op(&d, op, e, p, number++, markers);
        op++->join = last ? (uint8_t)may_join(s, h, before, last, e, p) : CORE_APART;
        before = e;
        last = p;
        markers = 0;
    }
    op->pause = CORE_END;
    h->decoded_ops = number;
    h->trailing = markers;
    h->decoded = e;
    h->before = before;
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
    memset(h->producer, CORE_READY * SIM_CONSUMERS, s->window + 1);
    memset(h->stores, 0, sizeof h->stores);
    memset(h->regions, 0, sizeof h->regions);
    h->tile_first = h->decoded_ops;
    h->late_until = h->unsettled_until = 0;
    h->before = NULL;
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
