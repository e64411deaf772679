#include "sim/core_state.h"

/* The data of an op that has issued comes later than from the first level. */
void core_delay_result(sim_core *s, core_thread *h, const sim_op_price *p, sim_fetch fetch)
{
    const uint32_t number = core_number(h);
    h->late[number & (s->late_window - 1)] =
        (core_late_result){.number = number, .bucket = fetch.from == SIM_LEVEL_2 ? SIM_BUCKET_L2 : SIM_BUCKET_MEMORY,
                           .arrival = fetch.arrival, .price = p};
    const sim_blamed until = sim_blame(fetch.arrival + s->longest_latency, 0);
    h->late_until = until > h->late_until ? until : h->late_until;
    core_unsettle(h, until);
}

/* The thread issues nothing before then, a later cycle, so nothing joins the op. */
static void hold_thread(core_thread *h, sim_blamed until)
{
    h->start = until > h->start ? until : h->start;
}

void core_take_branch(sim_core *s, core_thread *h, const lrb_event *e)
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

void core_take_hint(sim_core *s, core_thread *h, const lrb_event *e)
{
    if (core_moves_nothing(e))
        return;
    switch (lrb_op_hint_of((lrb_op_id)(e->op & LRB_EVENT_ID))) {
    case LRB_HINT_PREFETCH1:
        prefetch(s, core_line_of(s, h, e), SIM_LEVEL_1);
        break;
    case LRB_HINT_PREFETCH2:
        prefetch(s, core_line_of(s, h, e), SIM_LEVEL_2);
        break;
    case LRB_HINT_EVICT1:
        sim_cache_evict(s->memory->l1, core_line_of(s, h, e));
        break;
    case LRB_HINT_EVICT2:
        sim_cache_evict(s->memory->l2, core_line_of(s, h, e));
        break;
    case LRB_HINT_NONE:
        break;
    case LRB_HINT_DELAY:
        if (e->aux)
            hold_thread(h, h->now + sim_blame(e->aux, SIM_BUCKET_DELAY));
        break;
    }
}

/* A class is busy, for the threads whose next op is of it too. */
static void keep_busy(sim_core *s, const core_thread *h, const sim_op_price *p)
{
    const sim_blamed until = h->now + sim_blame(p->busy, SIM_BUCKET_BUSY + p->class_id);
    s->class_free[p->class_id] = until;
    for (unsigned t = 0; t < s->threads; t++) {
        core_thread *other = &s->thread[t];
        const sim_blamed ready = s->turn[t] + s->why[t];
        if (other == h || s->turn[t] == CORE_NEVER || core_price_of(s, other)->class_id != p->class_id || ready >= until)
            continue;
        const uint64_t gap_end = sim_time_of(other->now) + s->gap, from = gap_end > s->now + 1 ? gap_end : s->now + 1;
        s->thread_waited[s->why[t]] -= sim_time_of(ready) > from ? sim_time_of(ready) - from : 0; /* it waits for the class instead */
        core_set_turn(s, t, until, from);
    }
}

/* An op of a lasting class has issued: the class is busy for all threads, and the thread perhaps blocked. */
void core_outlast(sim_core *s, core_thread *h, const sim_op_price *p)
{
    if (p->busy > 1)
        keep_busy(s, h, p);
    if (p->blocking)
        hold_thread(h, h->now + sim_blame(p->blocking, SIM_BUCKET_BLOCKED));
}

static void tell_of_all(sim_core *s)
{
    for (uint32_t op = 0; op <= UINT16_MAX; op++)
        s->price[op].flags |= SIM_PRICE_TOLD;
    core_blocks_forget(s);
}

void sim_core_set_profile(sim_core *s, sim_profile *profile)
{
    s->profile = profile;
    tell_of_all(s);
}

void sim_core_observe(sim_core *s, sim_observer *observer, void *user)
{
    s->observer = observer;
    s->observer_user = user;
    tell_of_all(s);
}

void core_tell_op(sim_core *s, core_thread *h, const lrb_event *e, bool joined)
{
    if (s->profile)
        sim_profile_issue(s->profile, &h->at, e->op & (CORE_OPS - 1), s->price[e->op].lanes, e->mask, joined);
    if (s->observer)
        core_tell(s, h, e);
}

void core_tell(sim_core *s, const core_thread *h, const lrb_event *e)
{
    const uint64_t cycle = s->now - s->gap;
    sim_issued issued = {.event = e, .cycle = cycle, .ready = cycle, .thread = (unsigned)(h - s->thread)};
    if (!(s->price[e->op].flags & SIM_PRICE_MARKER)) {
        const uint32_t number = core_number(h);
        const core_late_result *late = &h->late[number & (s->late_window - 1)];
        const bool is_late = late->number == number && late->arrival > s->now;
        issued.ready = (is_late ? late->arrival : s->now) - s->gap + sim_time_of(s->price[e->op].latency.ready[SIM_CONSUMER_PLAIN]);
        issued.in_v = s->told == s->now; /* two ops of a cycle are of one thread */
        s->told = s->now;
    }
    s->observer(s->observer_user, &issued);
}
