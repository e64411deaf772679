#include "sim/issue.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "sim/pipeline.h"
#include "sim/profile_charge.h"

enum { OPS = 512 };
_Static_assert((int)LRB_OP_COUNT <= OPS, "the counters have a place for every op");

/* The state that every op reads and changes; a copy lives in host registers while a batch is timed. */
typedef struct pipeline {
    sim_blamed now;   /* of the last issue, bucket 0 */
    sim_blamed start; /* the next op issues later than this, unless it joins: end of `now`, or of what blocks the thread */
    uint32_t next;     /* number of the next op in the tile */
    uint32_t partners; /* set of classes of which an op may join the last one in V */
} pipeline;

struct sim_issue {
    const sim_machine *machine;
    sim_op_price *price; /* by the whole op field of an event, UINT16_MAX + 1 of them; most are never touched */

    /* The youngest ops. An older one is ready: two ops a cycle, so `window` of them take longer than any latency. */
    sim_result *results;
    uint32_t window; /* a power of two */
    pipeline pipe;
    sim_blamed class_free[LRB_CLASS_COUNT]; /* of lasting classes */
    sim_store_line stores[SIM_STORE_LINES];
    uint32_t phase, region;
    uint64_t phase_start, region_start; /* the cycles in which they began */
    uint64_t regions[SIM_MAX_REGIONS + 1];

    /* Of the tile; moved into the stats at its end. */
    uint64_t ops[SIM_MAX_PHASES][OPS]; /* by phase */
    uint64_t joins[OPS];     /* ops that joined another's cycle */
    uint64_t op_waited[OPS]; /* cycles waited for them, gaps left out */
    uint64_t waited[SIM_BUCKETS];
    uint64_t idle_lanes; /* of the phase */
    unsigned first_op; /* of the tile */
    sim_profile *profile; /* or NULL; not owned */
    sim_whereabouts at;
    sim_issue_stats stats;

    sim_observer *observer; /* or NULL */
    void *observer_user;
};

base_status sim_issue_create(const sim_machine *machine, sim_issue **out, base_error *err)
{
    sim_issue *s = calloc(1, sizeof *s);
    if (s) {
        s->machine = machine;
        s->window = sim_window(machine);
        s->results = calloc(s->window, sizeof *s->results);
        s->price = sim_op_prices(machine);
    }
    if (!s || !s->results || !s->price) {
        sim_issue_destroy(&s);
        return base_fail(err, BASE_ERR_NOMEM, "issue model", "out of memory");
    }
    *out = s;
    return BASE_OK;
}

void sim_issue_destroy(sim_issue **s)
{
    if (*s) {
        free((*s)->results);
        free((*s)->price);
        free(*s);
    }
    *s = NULL;
}

void sim_issue_begin(sim_issue *s)
{
    memset(s->results, 0, s->window * sizeof *s->results);
    memset(s->class_free, 0, sizeof s->class_free);
    memset(s->stores, 0, sizeof s->stores);
    memset(s->regions, 0, sizeof s->regions);
    s->pipe = (pipeline){.start = sim_end_of_cycle(0)};
    s->phase = 0;
    s->at = (sim_whereabouts){0};
    s->phase_start = s->region_start = 0;
    s->region = SIM_MAX_REGIONS;
}

/* Afterwards the class is busy, or the thread blocked. */
static void outlast(sim_issue *s, pipeline *pipe, const sim_op_price *p)
{
    s->class_free[p->class_id] = pipe->now + sim_blame(p->busy, SIM_BUCKET_BUSY + p->class_id);
    if (p->blocking)
        pipe->start = pipe->now + sim_blame(p->blocking, SIM_BUCKET_BLOCKED);
}

/* The op has just issued: in the cycle before, or after waiting behind the gap for what its bucket says. */
static void charge_profile(sim_issue *s, const sim_op_price *p, const lrb_event *e, bool joins, uint64_t gap, unsigned bucket,
                           uint64_t waited)
{
    const unsigned id = e->op & (OPS - 1);
    if (!joins) {
        sim_profile_wait(s->profile, &s->at, id, SIM_BUCKET_NONE, gap);
        sim_profile_wait(s->profile, &s->at, id, bucket, waited);
    }
    sim_profile_issue(s->profile, &s->at, id, p->lanes, e->mask, joins);
}

/* Join the op before in V, or issue in a new cycle as early as everything allows. */
static inline __attribute__((always_inline)) void issue_op(sim_issue *s, pipeline *pipe, sim_result *results, uint32_t window,
                                                           sim_blamed gap, const sim_op_price *p, const lrb_event *e,
                                                           const bool profiled)
{
    sim_blamed at = pipe->start;
    for (unsigned i = 0; i < SIM_MAX_SOURCES; i++)
        sim_need_source(results, window, pipe->next, p, e, i, &at);
    if (p->flags & SIM_PRICE_READS) {
        sim_need_stored(s->stores, p, e, &at);
        s->stats.memory_operands += (e->op & LRB_FORM_MEMORY) != 0;
    }
    if (p->flags & SIM_PRICE_LASTING)
        sim_need(s->class_free[p->class_id], &at);
    if (at == pipe->start && pipe->partners >> p->class_id & 1) {
        s->joins[e->op & (OPS - 1)]++;
        pipe->partners = 0;
        if (profiled)
            charge_profile(s, p, e, true, 0, 0, 0);
    } else {
        const sim_blamed earliest = pipe->now + gap;
        pipe->now = sim_without_bucket(earliest);
        if (at > earliest) {
            s->waited[at & 0xff] += (at - earliest + 0xff) >> 8;
            s->op_waited[e->op & (OPS - 1)] += (at - earliest + 0xff) >> 8;
            pipe->now = sim_without_bucket(at);
        }
        pipe->partners = p->partners;
        if (profiled)
            charge_profile(s, p, e, false, pipe->next ? sim_time_of(gap) - 1 : 0, at & 0xff,
                           at > earliest ? (at - earliest + 0xff) >> 8 : 0);
    }
    sim_put_result(&results[pipe->next++ & (window - 1)], &p->latency, pipe->now);
    pipe->start = sim_end_of_cycle(pipe->now);
    if (p->flags & SIM_PRICE_LASTING)
        outlast(s, pipe, p);
    if (p->flags & SIM_PRICE_STORE)
        sim_remember_store(s->stores, p, e, pipe->now);
    if (e->mask != 0xffff)
        s->idle_lanes += (unsigned)__builtin_popcount(p->lanes & ~(unsigned)e->mask);
}

/* Cycles since the tile began. */
static uint64_t cycles_so_far(const sim_issue *s)
{
    /* The first op issues a gap after time 0, in cycle 1. */
    return s->pipe.next ? (s->pipe.now >> 8) - s->machine->issue_gap + 1 : 0;
}

/* Cycles up to now belong to the phase and region that end here. */
static void end_phase(sim_issue *s, uint32_t next)
{
    uint64_t now = cycles_so_far(s);
    s->stats.phase[s->phase] += now - s->phase_start;
    s->stats.phase_idle_lanes[s->phase] += s->idle_lanes;
    s->phase_start = now;
    s->idle_lanes = 0;
    s->phase = s->at.phase = next < SIM_MAX_PHASES ? next : SIM_MAX_PHASES - 1;
}

static void end_region(sim_issue *s, uint32_t next)
{
    uint64_t now = cycles_so_far(s);
    s->regions[s->region] += now - s->region_start;
    s->region_start = now;
    s->region = next < SIM_MAX_REGIONS ? next : SIM_MAX_REGIONS;
}

static void mark(sim_issue *s, const lrb_event *e)
{
    if ((e->op & LRB_EVENT_ID) == LRB_OP_phase)
        end_phase(s, e->aux);
    else if ((e->op & LRB_EVENT_ID) == LRB_OP_region)
        end_region(s, e->aux);
    else if ((e->op & LRB_EVENT_ID) == LRB_OP_line)
        s->at.site = e->aux;
}

/* Tell the observer of an event that the model has just passed; `before` is when the op before it issued. */
static void tell(const sim_issue *s, const lrb_event *e, const sim_op_price *p, sim_blamed before)
{
    bool marker = p->flags & SIM_PRICE_MARKER;
    uint64_t cycle = cycles_so_far(s);
    sim_issued issued = {.event = e, .cycle = cycle, .ready = cycle};
    if (!marker) {
        issued.ready += sim_time_of(p->latency.ready[SIM_CONSUMER_PLAIN]);
        issued.in_v = s->pipe.next > 1 && s->pipe.now == before;
    }
    s->observer(s->observer_user, &issued);
}

/* The loop. Twice in the program, so that a profile and an observer that are not there cost nothing. */
static inline __attribute__((always_inline)) void time_events(sim_issue *s, const lrb_event *events, uint32_t count, const bool watched)
{
    pipeline pipe = s->pipe;
    sim_result *const results = s->results;
    const uint32_t window = s->window;
    const sim_blamed gap = sim_blame(s->machine->issue_gap, SIM_BUCKET_NONE);
    uint64_t *ops = s->ops[s->phase];
    for (const lrb_event *e = events; e < events + count; e++) {
        const sim_op_price *p = &s->price[e->op];
        const sim_blamed before = pipe.now;
        ops[e->op & (OPS - 1)]++;
        if (p->flags & SIM_PRICE_MARKER) {
            s->pipe = pipe;
            mark(s, e);
            ops = s->ops[s->phase];
        } else {
            issue_op(s, &pipe, results, window, gap, p, e, watched && s->profile);
        }
        if (watched && s->observer) {
            s->pipe = pipe;
            tell(s, e, p, before);
        }
    }
    s->pipe = pipe;
}

void sim_issue_events(void *simulator, const lrb_event *events, uint32_t count)
{
    sim_issue *s = simulator;
    for (const lrb_event *e = events; s->pipe.next == 0 && e < events + count; e++)
        if (!(s->price[e->op].flags & SIM_PRICE_MARKER)) {
            s->first_op = e->op & (OPS - 1);
            break;
        }
    if (s->profile || s->observer)
        time_events(s, events, count, true);
    else
        time_events(s, events, count, false);
}

void sim_issue_set_profile(sim_issue *s, sim_profile *profile)
{
    s->profile = profile;
}

void sim_issue_observe(sim_issue *s, sim_observer *observer, void *user)
{
    s->observer = observer;
    s->observer_user = user;
}

/* Ops that did not join issued first in their cycle, a gap after the one before; the tile's first op waited for no gap. */
static void collect_op(const sim_issue *s, int id, sim_issue_stats *to)
{
    uint64_t ops = 0;
    for (int phase = 0; phase < SIM_MAX_PHASES; phase++) {
        ops += s->ops[phase][id];
        to->phase_vector_ops[phase] += lrb_op_kind_of((lrb_op_id)id) == LRB_KIND_VECTOR ? s->ops[phase][id] : 0;
    }
    to->ops[id] += ops;
    if (lrb_op_table[id].shape == LRB_SHAPE_MARK)
        return;
    uint64_t issues = ops - s->joins[id], gaps = issues - (s->pipe.next && s->first_op == (unsigned)id);
    to->op_issues[id] += issues;
    to->op_cycles[id] += issues + gaps * (s->machine->issue_gap - 1) + s->op_waited[id];
    to->gap += gaps * (s->machine->issue_gap - 1);
    to->issued_by_class[lrb_op_table[id].class_id] += issues;
    to->issued_one += issues - s->joins[id];
    to->issued_pair += s->joins[id];
}

/* Move what the loop has summed up in the tile into the stats. */
static void collect(sim_issue *s, sim_issue_stats *to)
{
    const uint64_t *waited = s->waited;
    for (int id = 0; id < LRB_OP_COUNT; id++)
        collect_op(s, id, to);
    for (int k = 0; k < LRB_CLASS_COUNT; k++) {
        for (int kind = 0; kind < SIM_CONSUMERS; kind++)
            to->operand[k][kind] += waited[SIM_BUCKET_OPERAND + k * SIM_CONSUMERS + kind];
        to->busy[k] += waited[SIM_BUCKET_BUSY + k];
    }
    to->store_forward += waited[SIM_BUCKET_STORE];
    to->blocked += waited[SIM_BUCKET_BLOCKED];
    memset(s->ops, 0, sizeof s->ops);
    memset(s->op_waited, 0, sizeof s->op_waited);
    memset(s->joins, 0, sizeof s->joins);
    memset(s->waited, 0, sizeof s->waited);
}

void sim_issue_end(sim_issue *s, uint64_t regions[SIM_MAX_REGIONS + 1])
{
    end_phase(s, 0);
    end_region(s, SIM_MAX_REGIONS);
    s->stats.cycles += cycles_so_far(s);
    collect(s, &s->stats);
    memcpy(regions, s->regions, sizeof s->regions);
}

const sim_issue_stats *sim_issue_get(const sim_issue *s)
{
    return &s->stats;
}

void sim_issue_stats_add(sim_issue_stats *to, const sim_issue_stats *from)
{
    /* All members are uint64_t counts. */
    uint64_t *t = (uint64_t *)to;
    const uint64_t *f = (const uint64_t *)from;
    for (size_t i = 0; i < sizeof *to / sizeof *t; i++)
        t[i] += f[i];
}
