/* Ops made ready for the core's loop, a block at a time. Kernels are loops: what depends on a block's ops, masks of all lanes and
 * distances alone is found once and remembered, and what depends on addresses and other masks is put in each time. */
#include <stdlib.h>
#include <string.h>

#include "sim/core_state.h"

enum {
    SETS = 256,
    WAYS = 4,
    REACH = 64,      /* so far before its first op a block knows the classes of sources */
    LEAST_OPS = 16,  /* a block of so many ends with a branch: the next one then begins at the same op whatever came before */
    WORD = sizeof(uint64_t)
};

enum { ACCESS = SIM_PRICE_READS | SIM_PRICE_STORE };

/* The words of an event, each worked on in the same way. */
enum { OP_WORD = 0, MASK_WORD = 1, SOURCE_WORD = 2, AUX_WORD = 6 };
typedef uint16_t words __attribute__((vector_size(sizeof(lrb_event))));

/* Places of ops within a block. */
typedef struct places {
    uint32_t count;
    uint8_t at[CORE_BLOCK];
} places;

typedef struct block {
    uint32_t ops, phase;
    uint32_t reach;           /* ops before it that its latencies depend on, a multiple of WORD */
    uint64_t times;           /* it was taken since its ops were counted last */
    places accesses;          /* that load or store */
    places pairs;             /* that do so and may join an op that does */
    places masked;            /* whose mask may have any lanes */
    uint64_t before[REACH / WORD], before_cares[REACH / WORD]; /* producers of these ops, the last ones at the end */
    uint8_t producer[CORE_BLOCK];
    words event[CORE_BLOCK];  /* what its events must be; words of `open` stand for others too */
    core_op op[CORE_BLOCK];
} block;

/* The most recently used block first. */
typedef struct block_set {
    uint32_t hash[WAYS];
    block *block[WAYS];
} block_set;

struct core_blocks {
    words open;  /* words of a remembered event that stand for any within `range` from there on */
    words range;
    block_set set[SETS];
    block block[SETS * WAYS];
};

static void forget(core_blocks *b)
{
    for (size_t i = 0; i < SETS * WAYS; i++) {
        b->block[i].ops = 0;
        b->set[i / WAYS].block[i % WAYS] = &b->block[i];
    }
}

core_blocks *core_blocks_create(unsigned far)
{
    core_blocks *b = aligned_alloc(sizeof(words), sizeof *b);
    if (b) {
        memset(b, 0, sizeof *b);
        forget(b);
        /* A mask that was not of all lanes may be any, and so may numbers in `aux`. Distance 0 lies behind the largest. */
        const uint16_t d = (uint16_t)far, beyond = (uint16_t)-far, any = UINT16_MAX;
        b->open = (words){0, 0, d, d, d, d, 0, 0};
        b->range = (words){0, any, beyond, beyond, beyond, beyond, any, any};
    }
    return b;
}

/* Its ops go to those counted. */
static void settle(const sim_core *s, block *b)
{
    uint64_t *times = s->forms + (size_t)b->phase * CORE_FORMS;
    for (uint32_t i = 0; b->times && i < b->ops; i++)
        times[b->event[i][OP_WORD]] += b->times;
    b->times = 0;
}

void core_blocks_settle(sim_core *s)
{
    for (size_t i = 0; i < SETS * WAYS; i++)
        settle(s, &s->blocks->block[i]);
}

void core_blocks_forget(sim_core *s)
{
    core_blocks_settle(s);
    forget(s->blocks);
}

/* Whether two lines lie in the same bank. */
static bool share_bank(const sim_core *s, uint32_t a, uint32_t b)
{
    return s->machine->l1.banks && (a == b || (a > b ? a - b : b - a) % s->machine->l1.banks == 0);
}

static bool accesses_share_bank(const sim_core *s, const core_thread *h, const lrb_event *first, const lrb_event *e)
{
    return share_bank(s, (uint32_t)core_line_of(s, h, first), (uint32_t)core_line_of(s, h, e));
}

/* May two ops that access memory do so in the same cycle, but for their banks? */
static bool share_memory(const sim_core *s, const sim_op_price *p, const sim_op_price *q)
{
    const unsigned loaded = (p->flags & SIM_PRICE_READS ? p->bytes : 0) + (q->flags & SIM_PRICE_READS ? q->bytes : 0);
    const unsigned stored = (p->flags & SIM_PRICE_STORE ? p->bytes : 0) + (q->flags & SIM_PRICE_STORE ? q->bytes : 0);
    return loaded <= s->machine->l1.load_bytes_per_cycle && stored <= s->machine->l1.store_bytes_per_cycle;
}

/* May an op of price q issue in V beside the one before it, of price p? Its bank is another matter. */
static core_join may_join(const sim_core *s, const sim_op_price *p, const sim_op_price *q)
{
    if (!(p->partners >> q->class_id & 1))
        return CORE_APART;
    return p->flags & ACCESS && q->flags & ACCESS && !share_memory(s, p, q) ? CORE_CONFLICTS : CORE_JOINS;
}

static void put_place(places *p, uint32_t at) { p->at[p->count++] = (uint8_t)at; }

/* Class of the op `distance` before op i of the block; before the block, this becomes part of what it must find there. */
static unsigned producer_at(block *b, const core_thread *h, uint32_t i, uint32_t distance)
{
    if (distance <= i)
        return b->producer[i - distance];
    const uint32_t back = distance - i;
    const uint8_t producer = h->producer[h->issued - h->issued_begin - back];
    ((uint8_t *)b->before)[REACH - back] = producer;
    ((uint8_t *)b->before_cares)[REACH - back] = 0xff;
    if (back > b->reach)
        b->reach = (back + WORD - 1) / WORD * WORD;
    return producer;
}

/* Sources of op i for which it may have to wait. At most two ops issue in a cycle: a result is ready by the issue of the op before
 * this one if it takes no longer than the ops in between. */
static void find_sources(const sim_core *s, const core_thread *h, block *b, uint32_t i, const lrb_event *e)
{
    core_op *op = &b->op[i];
    unsigned count = 0;
    for (unsigned k = 0; k < SIM_MAX_SOURCES; k++) {
        const uint32_t distance = e->src[k];
        if (distance == 0 || distance >= s->blocks->open[SOURCE_WORD])
            continue;
        if (distance > i + REACH) {
            op->flags |= CORE_MANY_SOURCES;
            continue;
        }
        const unsigned latency = producer_at(b, h, i, distance) + s->price[e->op].consumer[k];
        if (sim_time_of(s->latency[latency]) <= (distance - 1) / 2 * s->gap)
            continue;
        if (distance == 1)
            op->join = CORE_APART;
        if (count == CORE_SOURCES || distance > -INT8_MIN) {
            op->flags |= CORE_MANY_SOURCES;
            continue;
        }
        op->source[count] = (int8_t) - (int)distance;
        op->latency[count++] = (uint8_t)latency;
    }
}

/* What is remembered of an event. */
static words remembered(const core_blocks *blocks, const lrb_event *e)
{
    words w;
    memcpy(&w, e, sizeof w);
    if (e->mask != UINT16_MAX)
        w[MASK_WORD] = 0;
    for (unsigned i = SOURCE_WORD; i < AUX_WORD; i++)
        if (w[i] == 0 || w[i] > blocks->open[i])
            w[i] = blocks->open[i];
    w[AUX_WORD] = w[AUX_WORD + 1] = 0;
    return w;
}

/* Op i of a block, which is behind one of price `before`. */
static void record_op(const sim_core *s, const core_thread *h, block *b, uint32_t i, const lrb_event *e, const sim_op_price *before)
{
    const sim_op_price *p = &s->price[e->op];
    core_op *op = &b->op[i];
    *op = (core_op){.flags = p->flags, .join = CORE_JOINS};
    memset(op->latency, CORE_READY * SIM_CONSUMERS, sizeof op->latency);
    if (before)
        op->join = (uint8_t)may_join(s, before, p);
    b->producer[i] = (uint8_t)(p->class_id * SIM_CONSUMERS);
    b->event[i] = remembered(s->blocks, e);
    find_sources(s, h, b, i, e);
    if (p->flags & ACCESS) {
        put_place(&b->accesses, i);
        op->access = (uint8_t)b->accesses.count;
    }
    if (before && before->flags & ACCESS && p->flags & ACCESS && op->join == CORE_JOINS)
        put_place(&b->pairs, i);
    if (e->mask != 0xffff)
        put_place(&b->masked, i);
}

/* Learn the block that begins here, in the place of another one. */
static void record(sim_core *s, const core_thread *h, block *b)
{
    const sim_op_price *before = NULL;
    uint32_t i = 0;
    settle(s, b);
    b->phase = h->phase;
    b->reach = b->accesses.count = b->pairs.count = b->masked.count = 0;
    memset(b->before_cares, 0, sizeof b->before_cares);
    memset(b->before, 0, sizeof b->before);
    for (const lrb_event *e = h->undecoded; e < h->end && i < CORE_BLOCK; e++, i++) {
        const sim_op_price *p = &s->price[e->op];
        if (p->flags & SIM_PRICE_MARKER || (i >= LEAST_OPS && before->flags & SIM_PRICE_BRANCH))
            break;
        record_op(s, h, b, i, e, before);
        before = p;
    }
    b->ops = i;
}

/* Whether the events that come are those of a block. */
static bool comes_next(const core_blocks *blocks, const block *b, const core_thread *h)
{
    if (b->ops > (size_t)(h->end - h->undecoded) || b->phase != h->phase)
        return false;
    const words open = blocks->open, all_range = blocks->range;
    words fits = ~(words){0};
    for (uint32_t i = 0; i < b->ops; i++) {
        words event;
        memcpy(&event, &h->undecoded[i], sizeof event);
        const words range = (words)(b->event[i] == open) & all_range;
        fits &= (words)(event - b->event[i] <= range);
    }
    uint64_t half[2];
    memcpy(half, &fits, sizeof half);
    uint64_t differs = ~(half[0] & half[1]);
    const uint8_t *producer = h->producer + (h->issued - h->issued_begin) - b->reach;
    for (uint32_t i = (REACH - b->reach) / WORD; i < REACH / WORD; i++, producer += WORD) {
        uint64_t word;
        memcpy(&word, producer, WORD);
        differs |= (word ^ b->before[i]) & b->before_cares[i];
    }
    return b->ops && !differs;
}

/* A number that other blocks seldom have: of some of its ops. */
static uint32_t hash_of(const core_thread *h)
{
    static const uint8_t samples[] = {0, 3, 6, 9, 12, 15};
    const size_t left = (size_t)(h->end - h->undecoded);
    uint64_t hash = h->phase;
    for (size_t i = 0; i < sizeof samples && samples[i] < left; i++)
        hash = (hash ^ h->undecoded[samples[i]].op) * UINT64_C(0x9e3779b97f4a7c15);
    return (uint32_t)(hash >> 32);
}

/* The block that comes next: one that is known, or else learned in the place of the one of its set that was not used for longest. */
static block *find_block(sim_core *s, const core_thread *h)
{
    const uint32_t hash = hash_of(h);
    block_set *set = &s->blocks->set[hash % SETS];
    unsigned way = 0;
    while (way < WAYS && !(set->hash[way] == hash && comes_next(s->blocks, set->block[way], h)))
        way++;
    const bool known = way < WAYS;
    way -= !known;
    block *b = set->block[way];
    for (; way > 0; way--) {
        set->block[way] = set->block[way - 1];
        set->hash[way] = set->hash[way - 1];
    }
    set->block[0] = b;
    set->hash[0] = hash;
    if (!known)
        record(s, h, b);
    return b;
}

/* Ops are numbered on, and the youngest stay in reach of the next ones. */
static void make_room(const sim_core *s, core_thread *h)
{
    const size_t place = (size_t)(h->issued - h->issued_begin);
    if (place + CORE_BLOCK <= CORE_ROOM(s->window))
        return;
    memmove(h->issued_begin, h->issued - s->window, s->window * sizeof *h->issued);
    memmove(h->producer, h->producer + place - s->window, s->window);
    h->issued = h->issued_begin + s->window;
}

/* Lanes that are off, and accesses of none. */
static void count_masks(sim_core *s, core_thread *h, const block *b)
{
    for (uint32_t k = 0; k < b->masked.count; k++) {
        const core_op *op = &h->block[b->masked.at[k]];
        const lrb_event *e = &h->block_events[b->masked.at[k]];
        s->stats.phase_idle_lanes[h->phase] += (unsigned)__builtin_popcount(s->price[e->op].lanes & ~(unsigned)e->mask);
        if (op->flags & ACCESS && core_moves_nothing(e)) {
            s->idle_accesses++;
            h->access[op->access] = h->access[0];
        }
    }
}

/* What the block's ops access. */
static void put_lines(const sim_core *s, core_thread *h, const block *b)
{
    const unsigned known_shift = s->memory->known_shift;
    for (uint32_t k = 0; k < b->accesses.count; k++) {
        const uint64_t line = core_line_of(s, h, &h->block_events[b->accesses.at[k]]);
        h->access[k + 1] = (core_access){line, sim_known_slot(line, known_shift)};
    }
    for (uint32_t k = 0; k < b->pairs.count; k++) {
        const lrb_event *e = &h->block_events[b->pairs.at[k]];
        if (accesses_share_bank(s, h, e - 1, e))
            h->block[b->pairs.at[k]].join = CORE_CONFLICTS;
    }
}

/* May the block's first op join the last one of the block before? */
static core_join first_join(const sim_core *s, const core_thread *h, const lrb_event *last, const lrb_event *first)
{
    const sim_op_price *p = &s->price[last->op], *q = &s->price[first->op];
    const core_join join = may_join(s, p, q);
    return join == CORE_JOINS && p->flags & ACCESS && q->flags & ACCESS && accesses_share_bank(s, h, last, first) ? CORE_CONFLICTS : join;
}

void core_blocks_next(sim_core *s, core_thread *h)
{
    const lrb_event *const last = h->op > h->block ? core_event_of(h) - 1 : NULL;
    h->first = core_number(h);
    make_room(s, h);
    block *b = find_block(s, h);
    b->times++;
    memcpy(h->block, b->op, b->ops * sizeof *b->op);
    memcpy(h->producer + (h->issued - h->issued_begin), b->producer, sizeof b->producer);
    h->block_events = h->undecoded;
    h->undecoded += b->ops;
    h->op = h->block;
    h->block_end = h->block + b->ops;
    put_lines(s, h, b);
    count_masks(s, h, b);
    if (!last)
        h->block[0].join = CORE_APART;
    else if (h->block[0].join != CORE_APART)
        h->block[0].join = (uint8_t)first_join(s, h, last, h->block_events);
}
