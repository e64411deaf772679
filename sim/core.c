#include "sim/core_state.h"

static void end_tile(sim_core *s, core_thread *h, const sim_core_feed *feed)
{
    core_end_tile(s, h);
    if (feed->done)
        feed->done(feed->user, (unsigned)(h - s->thread), h->regions);
}

/* Give a thread the next tile that has an op; without one, it has no more work. */
static base_status next_tile(sim_core *s, core_thread *h, const sim_core_feed *feed, base_error *err)
{
    const unsigned t = (unsigned)(h - s->thread);
    for (;;) {
        const lrb_event *events = NULL;
        size_t count = 0;
        base_status status = feed->next(feed->user, t, &events, &count, err);
        h->end = NULL;
        if (status != BASE_OK)
            return status;
        if (!events) {
            s->turn[t] = s->turn[t + s->threads] = CORE_NEVER;
            s->working--;
            return BASE_OK;
        }
        if (core_begin_tile(s, h, events, count))
            return BASE_OK;
        end_tile(s, h, feed);
    }
}

/* Results of ops that waited for their lines. */
static __attribute__((noinline)) sim_blamed need_late(const sim_core *s, const core_thread *h, sim_blamed at)
{
    const lrb_event *e = core_event_of(h);
    const sim_op_price *p = core_price_of(s, h);
    const uint32_t next = core_number(h);
    for (unsigned i = 0; i < SIM_MAX_SOURCES; i++) {
        const uint32_t distance = e->src[i], number = next - distance;
        const core_late_result *late = &h->late[number & (s->late_window - 1)];
        if (distance > 0 && distance <= next - h->tile_first && late->number == number && late->arrival > 0)
            sim_need(sim_blame(late->arrival + sim_time_of(late->price->latency.ready[p->consumer[i]]), late->bucket), &at);
    }
    return at;
}

/* What few ops wait for: their class, and more sources than the loop knows of. */
static __attribute__((noinline)) sim_blamed need_more(const sim_core *s, const core_thread *h, sim_blamed at)
{
    const lrb_event *e = core_event_of(h);
    const sim_op_price *p = core_price_of(s, h);
    const uint8_t *producer = h->producer + (h->issued - h->issued_begin);
    if (h->op->flags & CORE_MANY_SOURCES)
        for (unsigned i = 0; i < SIM_MAX_SOURCES; i++)
            if (e->src[i] && e->src[i] < s->window)
                sim_need(h->issued[-(int)e->src[i]] + s->latency[*(producer - e->src[i]) + p->consumer[i]], &at);
    if (h->op->flags & SIM_PRICE_LASTING)
        sim_need(s->class_free[p->class_id], &at);
    return at;
}

/* Numbers that were just stored one by one are loaded one by one: a host's vector load would wait until they are in its cache. */
static inline uint64_t keep_scalar(uint64_t number)
{
    __asm__("" : "+r"(number));
    return number;
}

static inline sim_blamed later(sim_blamed a, sim_blamed b) { return a > b ? a : b; }

/* When the thread's next op can issue, as far as its operands, its class and what blocks the thread are concerned. Which thread
 * issues next varies so much that the host cannot foresee what its op waits for: so sources are compared without branches. */
static inline sim_blamed earliest(const sim_core *s, const core_thread *h, const sim_blamed now, sim_blamed start)
{
    const core_op *op = h->op;
    const sim_blamed *issued = h->issued;
    sim_blamed at = start;
    for (unsigned i = 0; i < CORE_SOURCES; i++)
        at = later(keep_scalar(issued[op->source[i]]) + s->latency[op->latency[i]], at);
    if (h->unsettled_until > now) {
        if (h->late_until > now)
            at = need_late(s, h, at);
        if (op->flags & SIM_PRICE_READS)
            sim_need_stored(h->stores, core_price_of(s, h), core_event_of(h), &at);
    }
    if (op->flags & (SIM_PRICE_LASTING | CORE_MANY_SOURCES))
        at = need_more(s, h, at);
    return at;
}

enum { ACCESS = SIM_PRICE_READS | SIM_PRICE_STORE };

/* How long the thread's next op is held up in cycle `now` because as many lines as may be are under way; 0: it is not. */
static __attribute__((noinline)) sim_blamed held_by_lines(const sim_core *s, const core_thread *h, uint64_t now)
{
    const lrb_event *e = core_event_of(h);
    if (core_moves_nothing(e))
        return 0;
    if (h->op->flags & ACCESS) {
        uint64_t free_at = h->misses.free_at;
        const bool held = free_at > now && sim_hierarchy_would_miss(s->memory, core_line_of(s, h, e), now);
        return held ? sim_blame(free_at, SIM_BUCKET_MISSES) : 0;
    }
    uint64_t free_at = s->prefetches.free_at;
    const lrb_hint hint = lrb_op_hint_of((lrb_op_id)(e->op & LRB_EVENT_ID));
    bool misses = hint == LRB_HINT_PREFETCH1   ? sim_hierarchy_would_miss(s->memory, core_line_of(s, h, e), now)
                  : hint == LRB_HINT_PREFETCH2 ? sim_hierarchy_would_miss_l2(s->memory, core_line_of(s, h, e), now)
                                               : false;
    return free_at > now && misses ? sim_blame(free_at, SIM_BUCKET_PREFETCHES) : 0;
}

/* Whether that is worth asking: some limit is reached, and the op may ask for a line. */
static inline bool may_be_held(const sim_core *s, const core_thread *h, uint64_t now)
{
    return ((h->misses.free_at > now) | (s->prefetches.free_at > now)) && h->op->flags & (ACCESS | SIM_PRICE_HINT);
}

/* The line is not simply there. */
static __attribute__((noinline)) void access_memory(sim_core *s, core_thread *h, const core_op *op)
{
    const sim_fetch fetch = sim_hierarchy_access(s->memory, h->access[op->access].line, s->now);
    if (fetch.asked)
        sim_slots_take(&h->misses, fetch.arrival);
    if (fetch.arrival > s->now && op->flags & SIM_PRICE_READS)
        core_delay_result(s, h, core_price_of(s, h), fetch);
}

static void remember_store(const sim_core *s, core_thread *h, const core_op *op)
{
    const sim_store_line *line = &h->stores[core_event_of(h)->aux / 64 % SIM_STORE_LINES];
    if (h->access[op->access].line == SIM_NO_LINE)
        return;
    sim_remember_store(h->stores, core_price_of(s, h), core_event_of(h), h->now);
    core_unsettle(h, line->ready);
}

/* Ops that do more than to give a result and to use a line. */
enum { EFFECTS = SIM_PRICE_STORE | SIM_PRICE_LASTING | SIM_PRICE_BRANCH | SIM_PRICE_HINT | SIM_PRICE_TOLD };

/* What such an op does when it issues. Gives what the next op issues later than. */
static __attribute__((noinline)) sim_blamed take_effect(sim_core *s, core_thread *h, bool joined)
{
    const core_op *op = h->op;
    const unsigned flags = op->flags;
    h->start = sim_end_of_cycle(h->now);
    if (flags & SIM_PRICE_BRANCH)
        core_take_branch(s, h, core_event_of(h));
    if (flags & SIM_PRICE_STORE)
        remember_store(s, h, op);
    if (flags & SIM_PRICE_LASTING)
        core_outlast(s, h, core_price_of(s, h));
    if (flags & SIM_PRICE_HINT)
        core_take_hint(s, h, core_event_of(h));
    if (flags & SIM_PRICE_TOLD)
        core_tell_op(s, h, core_event_of(h), joined);
    return h->start;
}

/* The thread's next op issues in this cycle. Gives what the one behind it issues later than, if it does not join. */
static inline sim_blamed perform(sim_core *s, core_thread *h, const sim_blamed now, const bool joined)
{
    const core_op *const op = h->op;
    sim_blamed *const issued = h->issued;
    sim_blamed start = sim_end_of_cycle(now);
    *issued = now;
    const core_access *a = &h->access[op->access];
    if (!sim_hierarchy_hits(s->memory, a->line, a->slot))
        access_memory(s, h, op);
    if (op->flags & EFFECTS)
        start = take_effect(s, h, joined);
    h->op = op + 1;
    h->issued = issued + 1;
    return start;
}

/* May the next op, which can issue at `at`, join the one that has just issued? */
static inline bool joins(sim_core *s, const core_thread *h, const sim_blamed now, sim_blamed at)
{
    if (h->op->join == CORE_APART)
        return false;
    __asm__(""); /* two branches: the first is known long before the second */
    if (at != sim_end_of_cycle(now))
        return false;
    if (h->op->flags & (ACCESS | SIM_PRICE_HINT) && held_by_lines(s, h, s->now))
        return false;
    s->stats.bank_conflicts += h->op->join == CORE_CONFLICTS;
    return h->op->join == CORE_JOINS;
}

/* Cycles in which no thread issued, before this one does, go to their buckets, but for the gaps: these are what is left of all
 * cycles. */
static __attribute__((noinline)) void charge_idle(sim_core *s, core_thread *h, unsigned t, uint64_t cycle)
{
    const uint64_t gap_end = sim_time_of(h->now) + s->gap, idle_from = gap_end > s->now + 1 ? gap_end : s->now + 1;
    const unsigned bucket = s->why[t], id = core_event_of(h)->op & (CORE_OPS - 1);
    s->core_waited[bucket] += cycle - idle_from;
    s->op_waited[id] += cycle - s->now - 1;
    if (s->profile) {
        sim_profile_wait(s->profile, &h->at, id, SIM_BUCKET_NONE, idle_from - s->now - 1);
        sim_profile_wait(s->profile, &h->at, id, bucket, cycle - idle_from);
    }
}

/* Issue an op, and perhaps the one after it, in this cycle. Gives when the next one can issue; 0: the tile has none left. */
static inline __attribute__((always_inline)) sim_blamed issue(sim_core *s, core_thread *h, const sim_blamed now)
{
    sim_blamed start = perform(s, h, now, false);
    if (core_find_op(s, h)) {
        const sim_blamed at = earliest(s, h, now, start);
        if (!joins(s, h, now, at))
            return at;
        s->joins[core_event_of(h)->op & (CORE_OPS - 1)]++;
        start = perform(s, h, now, true);
        if (core_find_op(s, h))
            return earliest(s, h, now, start);
    }
    h->start = start;
    return 0;
}

/* The first turn after that of thread t, with the place in the order of choice added: its own next one is the last among equals.
 * Mostly the thread behind it is ready, or else another one: a branch, so that the host goes on before it knows when the next op of
 * this thread can issue. The empty statement keeps it one. */
static inline uint64_t next_turn(const sim_core *s, unsigned threads, unsigned t, uint64_t own, uint64_t soonest)
{
    uint64_t first = own + threads;
    for (unsigned i = 1; i < threads; i++) {
        const uint64_t mine = s->turn[t + i];
        if (mine <= soonest) {
            __asm__("");
            return soonest + i;
        }
        first = mine + i < first ? mine + i : first;
    }
    return first;
}

/* A thread is dry: it takes the next tile. Its next op, if it has one, can issue at *at. */
static base_status run_dry(sim_core *s, core_thread *h, const sim_core_feed *feed, sim_blamed *at, base_error *err)
{
    end_tile(s, h, feed);
    base_status status = next_tile(s, h, feed, err);
    if (status == BASE_OK && h->end)
        *at = earliest(s, h, h->now, h->start);
    return status;
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
        core_thread *h = &s->thread[t];
        h->now = sim_blame(s->now + 1 - s->gap, 0);
        h->start = sim_end_of_cycle(h->now);
        status = next_tile(s, h, feed, err);
        h->works = h->end;
        s->runs_of_threads += h->works;
        if (status == BASE_OK && h->works)
            core_set_turn(s, t, sim_blame(s->now + 1, SIM_BUCKET_NONE), s->now + 1);
    }
    return status;
}

/* Threads that ran dry had no work. All ops are counted. */
static void end_run(sim_core *s)
{
    core_blocks_settle(s);
    s->stats.cycles += s->now - s->began;
    for (unsigned t = 0; t < s->threads; t++)
        s->stats.threads.no_work += s->now - (s->thread[t].works ? sim_time_of(s->thread[t].now) : s->began);
}

/* The thread whose turn it is: from the turn and place that next_turn found after thread `last`. */
static inline unsigned thread_of(unsigned threads, unsigned last, uint64_t turn)
{
    const unsigned t = last + (unsigned)(turn & (CORE_TURN - 1));
    if ((threads & (threads - 1)) == 0)
        return t & (threads - 1);
    return t >= threads ? t - threads : t;
}

/* The first turn of all threads, that of thread t, which issued last, with the last place. */
static uint64_t any_turn(const sim_core *s, unsigned t)
{
    const uint64_t soonest = (s->now + 1) * CORE_TURN;
    return next_turn(s, s->threads, t, later(s->turn[t], soonest), soonest);
}

/* The loop, while there is work: a turn of a thread after the other. Twice in the program, so that four threads, which all machines
 * have, are told apart by the compiler. */
static inline __attribute__((always_inline)) base_status take_turns(sim_core *s, const unsigned threads, const sim_core_feed *feed,
                                                                    base_error *err)
{
    uint64_t turn = any_turn(s, s->last);
    while (true) {
        const unsigned t = thread_of(threads, s->last, turn);
        const uint64_t cycle = turn / CORE_TURN;
        const sim_blamed now = sim_without_bucket(turn);
        core_thread *h = &s->thread[t];
        if (may_be_held(s, h, cycle)) {
            sim_blamed held = held_by_lines(s, h, cycle);
            if (held) {
                core_set_turn(s, t, held, cycle);
                turn = any_turn(s, s->last);
                continue;
            }
        }
        if (cycle > s->now + 1)
            charge_idle(s, h, t, cycle);
        h->cycles += cycle - s->now;
        s->now = cycle;
        h->now = now;
        s->last = t;
        sim_blamed at = issue(s, h, now);
        if (!at) {
            const base_status status = run_dry(s, h, feed, &at, err);
            if (status != BASE_OK || !s->working)
                return status;
            if (!h->end) {
                turn = any_turn(s, t);
                continue;
            }
        }
        at = later(at, now + s->blamed_gap);
        core_set_turn(s, t, at, cycle + s->gap);
        turn = next_turn(s, threads, t, sim_without_bucket(at), now + CORE_TURN);
    }
}

base_status sim_core_run(sim_core *s, const sim_core_feed *feed, base_error *err)
{
    base_status status = begin_run(s, feed, err);
    if (status == BASE_OK && s->working)
        status = s->threads == 4 ? take_turns(s, 4, feed, err) : take_turns(s, s->threads, feed, err);
    if (status == BASE_OK)
        end_run(s);
    return status;
}
