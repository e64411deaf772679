#include "sim/core.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "lrbni/memory.h"
#include "sim/branch.h"
#include "sim/pipeline.h"
#include "sim/slots.h"

enum { OPS = 512 };
_Static_assert((int)LRB_OP_COUNT <= OPS, "the counters have a place for every op");

#define NEVER UINT64_MAX

/* The result of an op that waited for its line: kept longer than others. */
typedef struct late_result {
    uint32_t number; /* of the op */
    sim_result result;
} late_result;

/* A hardware thread. Times are cycles, or blamed times where the type says so. */
typedef struct thread {
    const lrb_event *event, *end; /* the op that issues next, and the end of the tile */
    sim_blamed now;     /* of the last issue, bucket 0 */
    sim_blamed start;   /* the next op issues later than this, unless it joins */
    uint64_t waits_from; /* cycles before this are in a bucket, or in the gap */
    sim_result *results; /* of the youngest ops */
    uint32_t next;      /* number of the next op */
    uint32_t tile_first; /* number of the tile's first op */
    uint32_t partners;  /* set of classes of which an op may join the last one in V */
    uint32_t scratch;   /* displacement of the thread's scratch memory */
    uint64_t late_until; /* no late result is ready later */
    late_result *late;  /* by number of the op */
    sim_slots misses;
    sim_store_line stores[SIM_STORE_LINES];

    uint64_t cycles;    /* core cycles so far that belong to the thread's ops */
    uint64_t phase_start, region_start; /* of these */
    uint64_t vector_ops, idle_lanes;    /* of the phase */
    bool ran; /* it has issued an op in this run */
    uint32_t phase, region;
    uint64_t regions[SIM_MAX_REGIONS + 1]; /* of the tile */
} thread;

struct sim_core {
    const sim_machine *machine;
    sim_op_price *price;
    uint32_t window, late_window; /* powers of two */
    uint64_t gap;
    unsigned threads, line_bits, longest_latency;

    sim_blamed *ready; /* of each thread's next op; NEVER: the thread has none */
    uint64_t now;      /* cycle in which the core issued last */
    unsigned last;     /* thread that issued last */
    unsigned working;  /* threads that have an op to issue */
    thread *thread;
    sim_blamed class_free[LRB_CLASS_COUNT];
    sim_hierarchy *memory;
    sim_predictor *predictor;
    sim_slots prefetches; /* count 0: there may be none */

    uint64_t ops[OPS], op_cycles[OPS];
    uint64_t joins[LRB_CLASS_COUNT]; /* ops that joined another's cycle, by class */
    uint64_t core_waited[SIM_BUCKETS], thread_waited[SIM_BUCKETS];
    uint64_t core_gap, thread_gap, other_thread;
    uint64_t began; /* the run */
    sim_core_stats stats;
};

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
    thread *h = &s->thread[t];
    h->results = calloc(s->window, sizeof *h->results);
    h->late = calloc(s->late_window, sizeof *h->late);
    h->scratch = t * LRB_SCRATCH_BYTES;
    return slots_create(&h->misses, s->machine->memory.demand_misses_per_thread) && h->results && h->late;
}

static bool create_parts(sim_core *s)
{
    const sim_machine *machine = s->machine;
    s->window = sim_window(machine);
    s->late_window = late_window_of(machine);
    s->gap = machine->issue_gap;
    s->threads = machine->threads;
    s->line_bits = (unsigned)__builtin_ctz(machine->l1.line_bytes);
    s->longest_latency = sim_longest_latency(machine);
    s->last = s->threads - 1;
    s->price = sim_op_prices(machine);
    s->ready = calloc(s->threads, sizeof *s->ready);
    s->thread = calloc(s->threads, sizeof *s->thread);
    if (!s->price || !s->ready || !s->thread || !slots_create(&s->prefetches, machine->memory.prefetches_per_core))
        return false;
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
        free(s->thread[t].results);
        free(s->thread[t].late);
        free(s->thread[t].misses.until);
    }
    if (s) {
        free(s->price);
        free(s->ready);
        free(s->thread);
        free(s->prefetches.until);
        sim_hierarchy_destroy(&s->memory);
        sim_predictor_destroy(&s->predictor);
    }
    free(s);
    *core = NULL;
}

/* Cycles up to now belong to the phase and region that end here. */
static void end_phase(sim_core *s, thread *h, uint32_t next)
{
    s->stats.phase[h->phase] += h->cycles - h->phase_start;
    s->stats.phase_vector_ops[h->phase] += h->vector_ops;
    s->stats.phase_idle_lanes[h->phase] += h->idle_lanes;
    h->phase_start = h->cycles;
    h->vector_ops = h->idle_lanes = 0;
    h->phase = next < SIM_MAX_PHASES ? next : SIM_MAX_PHASES - 1;
}

static void end_region(thread *h, uint32_t next)
{
    h->regions[h->region] += h->cycles - h->region_start;
    h->region_start = h->cycles;
    h->region = next < SIM_MAX_REGIONS ? next : SIM_MAX_REGIONS;
}

static void mark(sim_core *s, thread *h, const lrb_event *e)
{
    s->ops[e->op & (OPS - 1)]++;
    if ((e->op & LRB_EVENT_ID) == LRB_OP_phase)
        end_phase(s, h, e->aux);
    else if ((e->op & LRB_EVENT_ID) == LRB_OP_region)
        end_region(h, e->aux);
}

/* Pass the markers before the next op; false: the tile has none left. */
static inline bool find_op(sim_core *s, thread *h)
{
    while (h->event < h->end && s->price[h->event->op].flags & SIM_PRICE_MARKER)
        mark(s, h, h->event++);
    return h->event < h->end;
}

/* A tile's pipeline is empty; what blocks the thread stays. */
static void begin_tile(sim_core *s, thread *h)
{
    memset(h->results, 0, s->window * sizeof *h->results);
    memset(h->stores, 0, sizeof h->stores);
    memset(h->regions, 0, sizeof h->regions);
    h->tile_first = h->next;
    h->late_until = 0;
    h->partners = 0;
    h->phase = 0;
    h->region = SIM_MAX_REGIONS;
    h->phase_start = h->region_start = h->cycles;
}

static void end_tile(sim_core *s, thread *h, const sim_core_feed *feed)
{
    end_phase(s, h, 0);
    end_region(h, 0);
    if (feed->done)
        feed->done(feed->user, (unsigned)(h - s->thread), h->regions);
}

/* Give a thread the next tile that has an op; without one, it has no more work. */
static base_status next_tile(sim_core *s, thread *h, const sim_core_feed *feed, base_error *err)
{
    for (;;) {
        size_t count = 0;
        base_status status = feed->next(feed->user, (unsigned)(h - s->thread), &h->event, &count, err);
        if (status != BASE_OK)
            return status;
        if (!h->event) {
            s->ready[h - s->thread] = NEVER;
            s->working--;
            return BASE_OK;
        }
        h->end = h->event + count;
        begin_tile(s, h);
        if (find_op(s, h))
            return BASE_OK;
        end_tile(s, h, feed);
    }
}

/* Results older than the window, of ops that waited for their lines. */
static void need_late(const sim_core *s, const thread *h, const sim_op_price *p, const lrb_event *e, sim_blamed *at)
{
    for (unsigned i = 0; i < SIM_MAX_SOURCES; i++) {
        uint32_t distance = e->src[i], number = h->next - distance;
        const late_result *late = &h->late[number & (s->late_window - 1)];
        if (distance >= s->window && distance <= h->next - h->tile_first && late->number == number)
            sim_need(late->result.ready[p->consumer[i]], at);
    }
}

/* When the thread's next op can issue, as far as its operands, its class and what blocks the thread are concerned. */
static inline sim_blamed earliest(const sim_core *s, const thread *h, const sim_op_price *p, const lrb_event *e)
{
    sim_blamed at = h->start;
    for (unsigned i = 0; i < SIM_MAX_SOURCES; i++)
        sim_need_source(h->results, s->window, h->next, p, e, i, &at);
    if (h->late_until > sim_time_of(at))
        need_late(s, h, p, e, &at);
    if (p->flags & SIM_PRICE_READS)
        sim_need_stored(h->stores, p, e, &at);
    if (p->flags & SIM_PRICE_LASTING)
        sim_need(s->class_free[p->class_id], &at);
    return at;
}

static inline uint64_t line_of(const sim_core *s, const thread *h, const lrb_event *e)
{
    uint64_t address = e->aux;
    return (address + (address >= LRB_SCRATCH_ADDRESS ? h->scratch : 0)) >> s->line_bits;
}

/* How long the op is held up in cycle `now` because as many lines as may be are under way; 0: it is not. */
static sim_blamed held_by_lines(const sim_core *s, const thread *h, const sim_op_price *p, const lrb_event *e, uint64_t now)
{
    if (p->flags & (SIM_PRICE_READS | SIM_PRICE_STORE)) {
        uint64_t free_at = sim_slots_free_at(&h->misses);
        return free_at > now && sim_hierarchy_would_miss(s->memory, line_of(s, h, e), now) ? sim_blame(free_at, SIM_BUCKET_MISSES) : 0;
    }
    uint64_t free_at = sim_slots_free_at(&s->prefetches);
    unsigned id = e->op & LRB_EVENT_ID;
    bool misses = id == LRB_OP_prefetch1   ? sim_hierarchy_would_miss(s->memory, line_of(s, h, e), now)
                  : id == LRB_OP_prefetch2 ? sim_hierarchy_would_miss_l2(s->memory, line_of(s, h, e), now)
                                           : false;
    return free_at > now && misses ? sim_blame(free_at, SIM_BUCKET_PREFETCHES) : 0;
}

/* The data of an op that has issued comes later than from the first level. */
static void delay_result(sim_core *s, thread *h, const sim_op_price *p, sim_fetch fetch)
{
    sim_result *r = &h->results[h->next & (s->window - 1)];
    unsigned bucket = fetch.from == SIM_LEVEL_2 ? SIM_BUCKET_L2 : SIM_BUCKET_MEMORY;
    for (int kind = 0; kind < SIM_CONSUMERS; kind++)
        r->ready[kind] = sim_blame(fetch.arrival + sim_time_of(p->latency.ready[kind]), bucket);
    h->late[h->next & (s->late_window - 1)] = (late_result){.number = h->next, .result = *r};
    if (fetch.arrival + s->longest_latency > h->late_until)
        h->late_until = fetch.arrival + s->longest_latency;
}

static inline void access_memory(sim_core *s, thread *h, const sim_op_price *p, const lrb_event *e)
{
    sim_fetch fetch = sim_hierarchy_access(s->memory, line_of(s, h, e), s->now);
    if (fetch.asked)
        sim_slots_take(&h->misses, fetch.arrival);
    if (fetch.arrival > s->now && p->flags & SIM_PRICE_READS)
        delay_result(s, h, p, fetch);
}

/* The thread issues nothing before then, and nothing joins the op. */
static void hold_thread(thread *h, sim_blamed until)
{
    h->start = until > h->start ? until : h->start;
    h->partners = 0;
}

static void take_branch(sim_core *s, thread *h, const lrb_event *e)
{
    const sim_prediction how = sim_predictor_branch(s->predictor, e->aux, e->mask & 1);
    const unsigned penalty = how == SIM_MISPREDICTED ? s->machine->branch.mispredict_penalty
                             : how == SIM_BTB_MISS   ? s->machine->branch.btb_miss_penalty
                                                     : 0;
    s->stats.mispredicted += how == SIM_MISPREDICTED;
    s->stats.btb_misses += how == SIM_BTB_MISS;
    s->stats.branches++;
    if (penalty)
        hold_thread(h, h->now + sim_blame(penalty + 1, how == SIM_MISPREDICTED ? SIM_BUCKET_MISPREDICT : SIM_BUCKET_BTB_MISS));
}

static void prefetch(sim_core *s, uint64_t line, sim_level level)
{
    bool misses = level == SIM_LEVEL_1 ? sim_hierarchy_would_miss(s->memory, line, s->now)
                                       : sim_hierarchy_would_miss_l2(s->memory, line, s->now);
    if (misses && s->prefetches.count)
        sim_slots_take(&s->prefetches, sim_hierarchy_prefetch(s->memory, line, s->now, level).arrival);
    else
        s->memory->counts.dropped_prefetches++;
}

static void take_hint(sim_core *s, thread *h, const lrb_event *e)
{
    switch (e->op & LRB_EVENT_ID) {
    case LRB_OP_prefetch1:
        prefetch(s, line_of(s, h, e), SIM_LEVEL_1);
        break;
    case LRB_OP_prefetch2:
        prefetch(s, line_of(s, h, e), SIM_LEVEL_2);
        break;
    case LRB_OP_evict1:
        sim_cache_evict(s->memory->l1, line_of(s, h, e));
        break;
    case LRB_OP_evict2:
        sim_cache_evict(s->memory->l2, line_of(s, h, e));
        break;
    default: /* delay */
        if (e->aux)
            hold_thread(h, h->now + sim_blame(e->aux, SIM_BUCKET_DELAY));
        break;
    }
}

/* Put the cycles before `cycle` that a thread has spent into their buckets. */
static void settle(sim_core *s, thread *h, uint64_t cycle)
{
    const sim_blamed ready = s->ready[h - s->thread];
    const uint64_t ready_at = sim_time_of(ready);
    if (cycle <= h->waits_from)
        return;
    s->thread_waited[ready & 0xff] += (ready_at < cycle ? ready_at : cycle) - h->waits_from;
    s->other_thread += ready_at < cycle ? cycle - ready_at : 0;
    h->waits_from = cycle;
}

/* A class is busy, for the threads whose next op is of it too. */
static void keep_busy(sim_core *s, const thread *h, const sim_op_price *p)
{
    const sim_blamed until = h->now + sim_blame(p->busy, SIM_BUCKET_BUSY + p->class_id);
    s->class_free[p->class_id] = until;
    for (unsigned t = 0; t < s->threads; t++) {
        thread *other = &s->thread[t];
        if (other == h || s->ready[t] >= until || s->price[other->event->op].class_id != p->class_id)
            continue;
        settle(s, other, s->now + 1);
        s->ready[t] = until;
    }
}

/* An op of a lasting class has issued: the class is busy for all threads, and the thread perhaps blocked. */
static void outlast(sim_core *s, thread *h, const sim_op_price *p)
{
    if (p->busy > 1)
        keep_busy(s, h, p);
    if (p->blocking)
        hold_thread(h, h->now + sim_blame(p->blocking, SIM_BUCKET_BLOCKED));
}

/* The thread's next op issues in this cycle. */
static inline void perform(sim_core *s, thread *h, const sim_op_price *p, const lrb_event *e)
{
    s->ops[e->op & (OPS - 1)]++;
    h->start = sim_end_of_cycle(h->now);
    h->partners = p->partners;
    sim_put_result(&h->results[h->next & (s->window - 1)], &p->latency, h->now);
    h->vector_ops += p->lanes & 1;
    h->idle_lanes += (unsigned)__builtin_popcount(p->lanes & ~(unsigned)e->mask);
    if (p->flags) {
        if (p->flags & (SIM_PRICE_READS | SIM_PRICE_STORE)) {
            s->stats.memory_operands += (e->op & LRB_FORM_MEMORY) != 0;
            access_memory(s, h, p, e);
            if (p->flags & SIM_PRICE_STORE)
                sim_remember_store(h->stores, p, e, h->now);
        }
        if (p->flags & SIM_PRICE_LASTING)
            outlast(s, h, p);
        if (p->flags & SIM_PRICE_BRANCH)
            take_branch(s, h, e);
        if (p->flags & SIM_PRICE_HINT)
            take_hint(s, h, e);
    }
    h->next++;
    h->event++;
}

/* May two ops access memory in the same cycle? */
static bool share_memory(sim_core *s, const thread *h, const lrb_event *first, const lrb_event *e)
{
    enum { ACCESS = SIM_PRICE_READS | SIM_PRICE_STORE };
    const sim_op_price *p = &s->price[first->op], *q = &s->price[e->op];
    const unsigned banks = s->machine->l1.banks;
    if (!(p->flags & ACCESS) || !(q->flags & ACCESS))
        return true;
    const unsigned loaded = (p->flags & SIM_PRICE_READS ? p->bytes : 0) + (q->flags & SIM_PRICE_READS ? q->bytes : 0);
    const unsigned stored = (p->flags & SIM_PRICE_STORE ? p->bytes : 0) + (q->flags & SIM_PRICE_STORE ? q->bytes : 0);
    const bool conflict = banks && line_of(s, h, first) % banks == line_of(s, h, e) % banks;
    if (!conflict && loaded <= s->machine->l1.load_bytes_per_cycle && stored <= s->machine->l1.store_bytes_per_cycle)
        return true;
    s->stats.bank_conflicts++;
    return false;
}

/* May the next op, which nothing holds up, join the one that has just issued? */
static inline bool joins(sim_core *s, const thread *h, const lrb_event *first, const sim_op_price *p, const lrb_event *e)
{
    enum { MEMORY = SIM_PRICE_READS | SIM_PRICE_STORE | SIM_PRICE_HINT };
    if (!(h->partners >> p->class_id & 1))
        return false;
    return !(p->flags & MEMORY) || (!held_by_lines(s, h, p, e, s->now) && share_memory(s, h, first, e));
}

/* The thread that issues next, and when: the first that can, in turn after the one that issued last. */
static inline unsigned choose(const sim_core *s, uint64_t *cycle)
{
    unsigned t = s->last, chosen = 0;
    uint64_t best = NEVER;
    for (unsigned i = 0; i < s->threads; i++) {
        t = t + 1 == s->threads ? 0 : t + 1;
        uint64_t at = sim_time_of(s->ready[t]);
        at = at > s->now ? at : s->now + 1;
        chosen = at < best ? t : chosen;
        best = at < best ? at : best;
    }
    *cycle = best;
    return chosen;
}

/* The cycles since the thread issued last, and those since the core did, go to their buckets; the thread issues now. */
static inline void charge(sim_core *s, thread *h, sim_blamed ready, uint64_t cycle, unsigned id)
{
    const uint64_t ready_at = sim_time_of(ready), idle = cycle - s->now - 1;
    s->thread_waited[ready & 0xff] += ready_at - h->waits_from;
    s->other_thread += cycle - ready_at;
    if (idle) {
        uint64_t gap_end = sim_time_of(h->now) + s->gap;
        gap_end = gap_end < cycle ? gap_end : cycle;
        uint64_t in_gap = gap_end > s->now + 1 ? gap_end - s->now - 1 : 0;
        s->core_gap += in_gap;
        s->core_waited[ready & 0xff] += idle - in_gap;
    }
    s->op_cycles[id] += idle + 1;
    h->cycles += idle + 1;
    s->now = cycle;
    h->now = sim_blame(cycle, 0);
}

/* One thread issues an op, and perhaps the one after it, in this cycle. */
static inline base_status issue(sim_core *s, thread *h, const sim_core_feed *feed, base_error *err)
{
    const lrb_event *first = h->event;
    perform(s, h, &s->price[first->op], first);
    bool more = find_op(s, h);
    sim_blamed at = NEVER;
    if (more) {
        const sim_op_price *p = &s->price[h->event->op];
        at = earliest(s, h, p, h->event);
        if (at == h->start && joins(s, h, first, p, h->event)) {
            s->joins[p->class_id]++;
            perform(s, h, p, h->event);
            h->partners = 0;
            more = find_op(s, h);
            if (more)
                at = earliest(s, h, &s->price[h->event->op], h->event);
        }
    }
    h->waits_from = s->now + s->gap;
    if (!more) {
        end_tile(s, h, feed);
        base_status status = next_tile(s, h, feed, err);
        if (status != BASE_OK || !h->event)
            return status;
        at = earliest(s, h, &s->price[h->event->op], h->event);
    }
    const sim_blamed gap_end = sim_blame(h->waits_from, SIM_BUCKET_NONE);
    s->ready[h - s->thread] = at > gap_end ? at : gap_end;
    return BASE_OK;
}

/* All threads begin: their first ops can issue in the next cycle. */
static base_status begin_run(sim_core *s, const sim_core_feed *feed, base_error *err)
{
    base_status status = BASE_OK;
    if (s->now == 0)
        s->now = s->gap; /* times stay above 0 where a thread's gap reaches back */
    s->began = s->now;
    s->working = s->threads;
    for (unsigned t = 0; t < s->threads && status == BASE_OK; t++) {
        thread *h = &s->thread[t];
        h->waits_from = s->now + 1;
        h->now = sim_blame(s->now + 1 - s->gap, 0);
        h->start = sim_end_of_cycle(h->now);
        h->ran = false;
        status = next_tile(s, h, feed, err);
        if (status == BASE_OK && h->event)
            s->ready[t] = sim_blame(s->now + 1, SIM_BUCKET_NONE);
    }
    return status;
}

/* Threads that ran dry had no work; the others issued a gap apart. */
static void end_run(sim_core *s)
{
    s->stats.cycles += s->now - s->began;
    for (unsigned t = 0; t < s->threads; t++)
        s->stats.threads.no_work += s->now - (s->thread[t].ran ? sim_time_of(s->thread[t].now) : s->began);
}

base_status sim_core_run(sim_core *s, const sim_core_feed *feed, base_error *err)
{
    base_status status = begin_run(s, feed, err);
    while (status == BASE_OK && s->working) {
        uint64_t cycle;
        const unsigned t = choose(s, &cycle);
        thread *h = &s->thread[t];
        const lrb_event *e = h->event;
        const sim_op_price *p = &s->price[e->op];
        if (p->flags & (SIM_PRICE_READS | SIM_PRICE_STORE | SIM_PRICE_HINT)) {
            sim_blamed held = held_by_lines(s, h, p, e, cycle);
            if (held) {
                settle(s, h, cycle);
                s->ready[t] = held;
                continue;
            }
        }
        charge(s, h, s->ready[t], cycle, e->op & (OPS - 1));
        s->thread_gap += h->ran ? s->gap - 1 : 0;
        h->ran = true;
        s->last = t;
        status = issue(s, h, feed, err);
    }
    if (status == BASE_OK)
        end_run(s);
    return status;
}

/* Ops that did not join issued first in their cycle. */
static void collect_issues(const sim_core *s, sim_core_stats *to)
{
    uint64_t issues = 0, joins_sum = 0;
    for (int id = 0; id < LRB_OP_COUNT; id++) {
        uint64_t issued = lrb_op_table[id].shape == LRB_SHAPE_MARK ? 0 : s->ops[id];
        to->ops[id] = s->ops[id];
        to->op_cycles[id] = s->op_cycles[id];
        to->issued_by_class[lrb_op_table[id].class_id] += issued;
        issues += issued;
    }
    for (int k = 0; k < LRB_CLASS_COUNT; k++) {
        to->issued_by_class[k] -= s->joins[k];
        joins_sum += s->joins[k];
    }
    issues -= joins_sum;
    to->core.issued_pair = to->threads.issued_pair = joins_sum;
    to->core.issued_one = to->threads.issued_one = issues - joins_sum;
}

static void collect_waits(const uint64_t waited[SIM_BUCKETS], sim_cycles *to)
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

sim_core_stats sim_core_get(const sim_core *s)
{
    sim_core_stats stats = s->stats;
    collect_issues(s, &stats);
    collect_waits(s->core_waited, &stats.core);
    collect_waits(s->thread_waited, &stats.threads);
    stats.core.gap = s->core_gap;
    stats.threads.gap = s->thread_gap;
    stats.threads.other_thread = s->other_thread;
    stats.memory = s->memory->counts;
    return stats;
}

void sim_core_stats_idle(sim_core_stats *stats, const sim_machine *machine, uint64_t cycles)
{
    stats->cycles += cycles;
    stats->core.no_work += cycles;
    stats->threads.no_work += cycles * machine->threads;
}

void sim_core_stats_add(sim_core_stats *to, const sim_core_stats *from)
{
    /* All members are uint64_t counts. */
    uint64_t *t = (uint64_t *)to;
    const uint64_t *f = (const uint64_t *)from;
    for (size_t i = 0; i < sizeof *to / sizeof *t; i++)
        t[i] += f[i];
}
