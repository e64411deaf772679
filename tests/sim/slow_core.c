#include "tests/sim/slow_core.h"

#include <stdlib.h>
#include <string.h>

#include "lrbni/memory.h"
#include "tests/sim/slow_memory.h"

/* The order of reasons that end together; operands are 0 .. RANK_L2-1. */
enum {
    RANK_L2 = 1000, RANK_MEMORY, RANK_STORE, RANK_BUSY, RANK_BLOCKED, RANK_DELAY, RANK_MISPREDICT, RANK_BTB, RANK_MISSES,
    RANK_PREFETCHES
};

/* A bucket: which number of sim_cycles. */
#define BUCKET(member) (offsetof(sim_cycles, member) / sizeof(uint64_t))

typedef struct reason {
    uint64_t end; /* first cycle in which it does not hold the op up */
    unsigned rank;
    size_t bucket;
} reason;

static const reason no_reason = {0, 0, BUCKET(gap)};

typedef struct issued_op {
    lrb_cost_class class_id;
    uint64_t cycle;
    uint64_t late; /* its line arrived so many cycles later */
    int source;    /* from this level; 3: memory */
} issued_op;

typedef struct stored {
    bool any;
    uint32_t line, words;
    uint64_t ready;
} stored;

typedef struct slow_thread {
    slow_core_tile *tile; /* NULL: no work */
    size_t at;            /* event that issues next */
    issued_op *ops;       /* of the tile; owned */
    size_t op_count, op_room;
    stored stores[64];
    uint32_t phase, region;
    uint64_t issued;      /* cycle of its last issue; 0: none */
    reason behind;        /* what its last op does to the next one */
    reason lines;         /* rule 7, found when it was chosen */
    reason last;          /* that held up its next op */
    uint64_t *misses;     /* arrivals; owned */
} slow_thread;

typedef struct slow_core {
    const sim_machine *machine;
    slow_core_tile *tiles;
    size_t tile_count, next_tile;
    slow_thread *threads;
    unsigned last;   /* thread that issued last */
    uint64_t cycle, last_cycle; /* now, and of the last issue of any thread */
    uint64_t class_cycle[LRB_CLASS_COUNT]; /* of the last op of the class; 0: none */
    uint64_t *prefetches; /* arrivals; owned */
    slow_memory memory;
    sim_core_stats *stats;
    bool no_memory;
} slow_core;

static unsigned id_of(const lrb_event *e) { return e->op & LRB_EVENT_ID; }
static const lrb_op_info *info_of(const lrb_event *e) { return &lrb_op_table[id_of(e)]; }
static bool is_marker(const lrb_event *e) { return info_of(e)->class_id == LRB_CLASS_marker; }
static bool is_vector(const lrb_event *e) { return lrb_op_kind_of((lrb_op_id)id_of(e)) == LRB_KIND_VECTOR; }
static bool is_store(const lrb_event *e) { return lrb_op_access_of((lrb_op_id)id_of(e)) == LRB_ACCESS_STORE; }
static bool is_load(const lrb_event *e)
{
    return lrb_op_access_of((lrb_op_id)id_of(e)) == LRB_ACCESS_LOAD || e->op & LRB_FORM_MEMORY;
}

/* An access under a mask of no lanes; an S3 in memory is read whatever the mask. */
static bool is_idle(const lrb_event *e) { return e->mask == 0 && !(e->op & LRB_FORM_MEMORY); }

static const sim_class_cost *cost_of(const slow_core *s, const lrb_event *e) { return &s->machine->cost[info_of(e)->class_id]; }

static void worse(reason *worst, reason other)
{
    if (other.end > worst->end || (other.end == worst->end && other.rank > worst->rank))
        *worst = other;
}

static uint64_t line_of(const slow_core *s, const slow_thread *t, const lrb_event *e)
{
    uint64_t address = e->aux;
    if (address >= LRB_SCRATCH_ADDRESS)
        address += (uint64_t)(t - s->threads) * LRB_SCRATCH_BYTES;
    return address / s->machine->l1.line_bytes;
}

static unsigned bytes_of(const lrb_event *e)
{
    static const unsigned bytes_of_form[16] = {[0x4] = 4, [0x5] = 8, [0x8] = 64, [0xc] = 16, [0xd] = 32}; /* event.h: the top bits of op */
    const unsigned bytes = bytes_of_form[(e->op & LRB_FORM_BYTES) >> 12];
    return bytes ? bytes : is_vector(e) ? 64 : 4;
}

/* The 32-bit words of its 64 bytes that an access touches. */
static uint32_t words_of(const lrb_event *e)
{
    uint32_t words = 0, first = e->aux % 64 / 4;
    if ((e->op & LRB_FORM_BYTES) == LRB_FORM_LINE)
        return 0xffff;
    if (bytes_of(e) == 64)
        return e->mask;
    for (uint32_t word = first; word < first + bytes_of(e) / 4 && word < 16; word++)
        words |= 1u << word;
    return words;
}

static sim_consumer consumer_of(const lrb_event *e, int i)
{
    const char read = lrb_shape_table[info_of(e)->shape].reads[i];
    if (i == 1 && e->op & LRB_FORM_MEMORY)
        return SIM_CONSUMER_ADDRESS;
    if (i == 1 && e->op & LRB_FORM_SWIZZLE && lrb_op_access_of((lrb_op_id)id_of(e)) == LRB_ACCESS_NONE)
        return SIM_CONSUMER_SHUFFLE;
    return read == 'a'   ? SIM_CONSUMER_ADDRESS
           : read == 'e' ? SIM_CONSUMER_SHUFFLE
           : read == 'b' ? SIM_CONSUMER_BRANCH
           : read == 'm' ? SIM_CONSUMER_MASK
                         : SIM_CONSUMER_PLAIN;
}

static unsigned latency_to(const sim_class_cost *cost, sim_consumer consumer)
{
    const unsigned latency[SIM_CONSUMERS] = {cost->latency, cost->latency_to_shuffle, cost->latency_to_branch,
                                             cost->latency_to_address, cost->latency_to_mask};
    return latency[consumer];
}

static void wait_for_sources(const slow_core *s, const slow_thread *t, const lrb_event *e, reason *worst)
{
    for (int i = 0; i < 4; i++) {
        if (e->src[i] == 0 || e->src[i] > t->op_count)
            continue;
        const issued_op *p = &t->ops[t->op_count - e->src[i]];
        sim_consumer c = consumer_of(e, i);
        reason r = {p->cycle + latency_to(&s->machine->cost[p->class_id], c) + p->late,
                    (unsigned)p->class_id * SIM_CONSUMERS + c, BUCKET(operand) + (unsigned)p->class_id * SIM_CONSUMERS + c};
        if (p->late && p->source == 2)
            r = (reason){r.end, RANK_L2, BUCKET(l2)};
        else if (p->late)
            r = (reason){r.end, RANK_MEMORY, BUCKET(memory)};
        worse(worst, r);
    }
}

/* What holds a thread's next op up in this cycle, gaps apart; of several reasons the one that ends last. end <= cycle: nothing. */
static reason held_up(const slow_core *s, const slow_thread *t)
{
    const lrb_event *e = &t->tile->events[t->at];
    const lrb_cost_class k = info_of(e)->class_id;
    reason worst = no_reason;
    wait_for_sources(s, t, e, &worst);
    if (is_load(e)) {
        const stored *place = &t->stores[e->aux / 64 % 64];
        if (place->any && place->line == e->aux / 64 && place->words & words_of(e))
            worse(&worst, (reason){place->ready, RANK_STORE, BUCKET(store_forward)});
    }
    if (s->class_cycle[k] && s->machine->cost[k].throughput >= 2) /* in halves; 1.5 cycles are rounded up to 2 */
        worse(&worst, (reason){s->class_cycle[k] + (s->machine->cost[k].throughput + 1) / 2, RANK_BUSY, BUCKET(busy) + k});
    worse(&worst, t->behind);
    worse(&worst, t->lines);
    return worst;
}

/* Rule 7: the reason, or one that has ended. */
static reason held_by_lines(slow_core *s, const slow_thread *t)
{
    const lrb_event *e = &t->tile->events[t->at];
    const unsigned misses = s->machine->memory.demand_misses_per_thread, prefetches = s->machine->memory.prefetches_per_core;
    const lrb_hint hint = lrb_op_hint_of((lrb_op_id)id_of(e));
    const bool demand = is_load(e) || is_store(e), prefetch = hint == LRB_HINT_PREFETCH1 || hint == LRB_HINT_PREFETCH2;
    const uint64_t *arrivals = demand ? t->misses : s->prefetches;
    const unsigned places = demand ? misses : prefetch ? prefetches : 0;
    if (!places || is_idle(e) || !slow_memory_must_ask(&s->memory, hint == LRB_HINT_PREFETCH2 ? 2 : 1, line_of(s, t, e), s->cycle))
        return no_reason;
    uint64_t first = UINT64_MAX;
    for (unsigned i = 0; i < places; i++)
        first = arrivals[i] < first ? arrivals[i] : first;
    return demand ? (reason){first, RANK_MISSES, BUCKET(misses)} : (reason){first, RANK_PREFETCHES, BUCKET(prefetches)};
}

/* A line is under way until then: it takes a place whose line has arrived. */
static void put_under_way(uint64_t *arrivals, unsigned places, uint64_t arrival, uint64_t cycle)
{
    for (unsigned i = 0; i < places; i++)
        if (arrivals[i] <= cycle) {
            arrivals[i] = arrival;
            return;
        }
    abort(); /* rule 7 was broken */
}

static void access_line(slow_core *s, slow_thread *t, const lrb_event *e, issued_op *op)
{
    slow_access a = slow_memory_access(&s->memory, line_of(s, t, e), s->cycle);
    if (a.asked)
        put_under_way(t->misses, s->machine->memory.demand_misses_per_thread, a.arrival, s->cycle);
    if (is_load(e) && a.arrival > s->cycle) {
        op->late = a.arrival - s->cycle;
        op->source = a.source;
    }
}

static void remember_store(slow_core *s, slow_thread *t, const lrb_event *e)
{
    stored *place = &t->stores[e->aux / 64 % 64];
    stored new = {true, e->aux / 64, words_of(e), s->cycle + cost_of(s, e)->latency};
    if (place->any && place->line == new.line && place->ready > s->cycle) {
        new.words |= place->words;
        new.ready = place->ready > new.ready ? place->ready : new.ready;
    }
    *place = new;
}

static void take_branch(slow_core *s, slow_thread *t, const lrb_event *e)
{
    int how = slow_memory_branch(&s->memory, e->aux, e->mask & 1);
    s->stats->branches++;
    s->stats->mispredicted += how == 1;
    s->stats->btb_misses += how == 2;
    if (how == 1 && s->machine->branch.mispredict_penalty)
        worse(&t->behind, (reason){s->cycle + s->machine->branch.mispredict_penalty + 1, RANK_MISPREDICT, BUCKET(mispredict)});
    if (how == 2 && s->machine->branch.btb_miss_penalty)
        worse(&t->behind, (reason){s->cycle + s->machine->branch.btb_miss_penalty + 1, RANK_BTB, BUCKET(btb_miss)});
}

static void take_hint(slow_core *s, slow_thread *t, const lrb_event *e)
{
    const unsigned prefetches = s->machine->memory.prefetches_per_core;
    const lrb_hint hint = lrb_op_hint_of((lrb_op_id)id_of(e));
    const int level = hint == LRB_HINT_PREFETCH1 || hint == LRB_HINT_EVICT1 ? 1 : 2;
    const uint64_t line = line_of(s, t, e);
    if (is_idle(e))
        return;
    if (hint == LRB_HINT_DELAY && e->aux)
        worse(&t->behind, (reason){s->cycle + e->aux, RANK_DELAY, BUCKET(delay)});
    else if (hint == LRB_HINT_EVICT1 || hint == LRB_HINT_EVICT2)
        slow_memory_evict(&s->memory, level, line);
    else if (hint != LRB_HINT_PREFETCH1 && hint != LRB_HINT_PREFETCH2)
        return;
    else if (prefetches && slow_memory_must_ask(&s->memory, level, line, s->cycle))
        put_under_way(s->prefetches, prefetches, slow_memory_prefetch(&s->memory, level, line, s->cycle), s->cycle);
    else
        s->memory.counts->dropped_prefetches++;
}

static void issue(slow_core *s, slow_thread *t)
{
    const lrb_event *e = &t->tile->events[t->at++];
    const sim_class_cost *cost = cost_of(s, e);
    issued_op op = {info_of(e)->class_id, s->cycle, 0, 0};
    t->behind = t->lines = no_reason;
    if (cost->blocking)
        worse(&t->behind, (reason){s->cycle + cost->blocking, RANK_BLOCKED, BUCKET(blocked)});
    if ((is_load(e) || is_store(e)) && !is_idle(e))
        access_line(s, t, e, &op);
    if (is_store(e) && !is_idle(e))
        remember_store(s, t, e);
    if (info_of(e)->class_id == LRB_CLASS_branch)
        take_branch(s, t, e);
    take_hint(s, t, e);
    t->ops[t->op_count++] = op;
    t->issued = s->cycle;
    s->class_cycle[op.class_id] = s->cycle;
    s->stats->ops[id_of(e)]++;
    s->stats->memory_operands += e->op & LRB_FORM_MEMORY ? 1 : 0;
    s->stats->phase_vector_ops[t->phase] += is_vector(e);
    for (int lane = 0; lane < 16; lane++)
        s->stats->phase_idle_lanes[t->phase] += is_vector(e) && !(e->mask >> lane & 1);
}

static void pass_markers(slow_core *s, slow_thread *t)
{
    for (; t->at < t->tile->count && is_marker(&t->tile->events[t->at]); t->at++) {
        const lrb_event *e = &t->tile->events[t->at];
        s->stats->ops[id_of(e)]++;
        if (id_of(e) == LRB_OP_phase)
            t->phase = e->aux < SIM_MAX_PHASES ? e->aux : SIM_MAX_PHASES - 1;
        else if (id_of(e) == LRB_OP_region)
            t->region = e->aux < SIM_MAX_REGIONS ? e->aux : SIM_MAX_REGIONS;
    }
}

/* Take the next tile that has an op. */
static void take_tile(slow_core *s, slow_thread *t)
{
    for (t->tile = NULL; !t->tile && s->next_tile < s->tile_count;) {
        t->tile = &s->tiles[s->next_tile++];
        t->at = t->op_count = t->phase = 0;
        t->region = SIM_MAX_REGIONS;
        memset(t->stores, 0, sizeof t->stores);
        pass_markers(s, t);
        if (t->at == t->tile->count)
            t->tile = NULL;
        else if (t->op_room < t->tile->count) {
            free(t->ops);
            t->op_room = t->tile->count;
            t->ops = calloc(t->op_room, sizeof *t->ops);
            s->no_memory |= !t->ops;
        }
    }
}

static bool share_memory(slow_core *s, const slow_thread *t, const lrb_event *a, const lrb_event *b)
{
    const unsigned banks = s->machine->l1.banks;
    if ((!is_load(a) && !is_store(a)) || (!is_load(b) && !is_store(b)))
        return true;
    unsigned loaded = 0, stored_bytes = 0;
    for (int i = 0; i < 2; i++) {
        loaded += is_load(i ? b : a) ? bytes_of(i ? b : a) : 0;
        stored_bytes += is_store(i ? b : a) ? bytes_of(i ? b : a) : 0;
    }
    bool conflict = (banks && line_of(s, t, a) % banks == line_of(s, t, b) % banks) ||
                    loaded > s->machine->l1.load_bytes_per_cycle || stored_bytes > s->machine->l1.store_bytes_per_cycle;
    s->stats->bank_conflicts += conflict;
    return !conflict;
}

/* An op of the tile has just issued in U: may the next one join it in V? */
static bool joins(slow_core *s, slow_thread *t, const lrb_event *first)
{
    if (t->at == t->tile->count)
        return false;
    const lrb_event *e = &t->tile->events[t->at];
    const sim_class_cost *a = cost_of(s, first), *b = cost_of(s, e);
    if (!(a->pipes & SIM_PIPE_U) || a->blocking || !(b->pipes & SIM_PIPE_V) || b->blocking || t->behind.end)
        return false;
    return held_up(s, t).end <= s->cycle && held_by_lines(s, t).end <= s->cycle && share_memory(s, t, first, e);
}

/* The cycles since the core issued last, and this one, belong to the op that issues now. */
static void charge(slow_core *s, slow_thread *t)
{
    uint64_t *core = (uint64_t *)&s->stats->core, cycles = s->cycle - s->last_cycle;
    const lrb_event *e = &t->tile->events[t->at];
    for (uint64_t c = s->last_cycle + 1; c < s->cycle; c++)
        core[t->issued && c < t->issued + s->machine->issue_gap ? BUCKET(gap) : t->last.bucket]++;
    s->stats->op_cycles[id_of(e)] += cycles;
    s->stats->issued_by_class[info_of(e)->class_id]++;
    s->stats->op_issues[id_of(e)]++;
    s->stats->phase[t->phase] += cycles;
    t->tile->regions[t->region] += cycles;
}

/* The chosen thread issues. */
static void issue_cycle(slow_core *s, slow_thread *t)
{
    const lrb_event *first = &t->tile->events[t->at];
    charge(s, t);
    issue(s, t);
    pass_markers(s, t);
    bool pair = joins(s, t, first);
    if (pair) {
        issue(s, t);
        pass_markers(s, t);
    }
    sim_cycles *buckets[] = {&s->stats->core, &s->stats->threads};
    for (int i = 0; i < 2; i++)
        *(pair ? &buckets[i]->issued_pair : &buckets[i]->issued_one) += 1;
    s->last = (unsigned)(t - s->threads);
    s->last_cycle = s->cycle;
    t->last = no_reason;
    if (t->at == t->tile->count)
        take_tile(s, t);
}

typedef enum state { NO_WORK, IN_GAP, HELD, READY } state;

/* What a thread is in this cycle, before anything issues. */
static state state_of(const slow_core *s, slow_thread *t)
{
    if (!t->tile)
        return NO_WORK;
    if (t->issued && s->cycle < t->issued + s->machine->issue_gap)
        return IN_GAP;
    reason why = held_up(s, t);
    if (why.end <= s->cycle)
        return READY;
    t->last = why;
    return HELD;
}

/* One cycle of all threads. */
static void step(slow_core *s)
{
    const unsigned threads = s->machine->threads;
    uint64_t *bucket = (uint64_t *)&s->stats->threads;
    unsigned issued = threads;
    state states[64];
    for (unsigned i = 0; i < threads; i++)
        states[i] = state_of(s, &s->threads[i]);
    for (unsigned i = 1; i <= threads && issued == threads; i++) {
        unsigned t = (s->last + i) % threads;
        if (states[t] != READY)
            continue;
        reason lines = held_by_lines(s, &s->threads[t]);
        if (lines.end > s->cycle) {
            s->threads[t].lines = s->threads[t].last = lines;
            states[t] = HELD;
        } else {
            issued = t;
        }
    }
    for (unsigned t = 0; t < threads; t++) /* the thread that issues gets its bucket when it does */
        if (t != issued)
            bucket[states[t] == NO_WORK ? BUCKET(no_work) : states[t] == IN_GAP ? BUCKET(gap)
                   : states[t] == HELD  ? s->threads[t].last.bucket : BUCKET(other_thread)]++;
    if (issued < threads)
        issue_cycle(s, &s->threads[issued]);
}

static bool any_work(const slow_core *s)
{
    for (unsigned t = 0; t < s->machine->threads; t++)
        if (s->threads[t].tile)
            return true;
    return false;
}

static bool prepare(slow_core *s)
{
    const sim_machine *machine = s->machine;
    s->threads = calloc(machine->threads, sizeof *s->threads);
    s->prefetches = calloc(machine->memory.prefetches_per_core + 1, sizeof *s->prefetches);
    bool good = slow_memory_init(&s->memory, machine, &s->stats->memory) && s->threads && s->prefetches;
    for (unsigned t = 0; good && t < machine->threads; t++) {
        s->threads[t].misses = calloc(machine->memory.demand_misses_per_thread, sizeof *s->threads[t].misses);
        good = s->threads[t].misses;
        take_tile(s, &s->threads[t]);
    }
    s->last = machine->threads - 1;
    return good && !s->no_memory;
}

bool slow_core_run(const sim_machine *machine, slow_core_tile *tiles, size_t tile_count, sim_core_stats *stats)
{
    slow_core s = {.machine = machine, .tiles = tiles, .tile_count = tile_count, .stats = stats};
    memset(stats, 0, sizeof *stats);
    for (size_t i = 0; i < tile_count; i++)
        memset(tiles[i].regions, 0, sizeof tiles[i].regions);
    bool good = prepare(&s);
    for (s.cycle = 1; good && any_work(&s); s.cycle++) {
        step(&s);
        good = !s.no_memory;
    }
    stats->cycles = s.cycle - 1;
    for (unsigned t = 0; s.threads && t < machine->threads; t++) {
        free(s.threads[t].ops);
        free(s.threads[t].misses);
    }
    free(s.threads);
    free(s.prefetches);
    slow_memory_free(&s.memory);
    return good;
}
