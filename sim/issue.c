#include "sim/issue.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { STORE_LINES = 64, FORMS = 16, MAX_SOURCES = 4, OPS = 512 };
_Static_assert((int)LRB_OP_COUNT <= OPS, "the counters have a place for every op");
_Static_assert((int)LRB_CLASS_COUNT <= 32, "a set of classes is 32 bits");

/*
 * Buckets of waiting cycles. A time and the bucket that is to blame for it travel in one number, time << 8 | bucket:
 * the largest of several is the latest, and says whom to blame; of equal times the last bucket in this list.
 */
enum {
    BUCKET_OPERAND = 0, /* + class * SIM_CONSUMERS + consumer */
    BUCKET_STORE = LRB_CLASS_COUNT * SIM_CONSUMERS,
    BUCKET_BUSY, /* + class */
    BUCKET_BLOCKED = BUCKET_BUSY + LRB_CLASS_COUNT,
    BUCKET_NONE,
    BUCKETS
};
_Static_assert(BUCKETS <= 255, "a bucket is 8 bits, and 255 is later than all of them");

typedef uint64_t blamed_time;

static inline blamed_time blame(uint64_t time, unsigned bucket) { return time << 8 | bucket; }
static inline blamed_time without_bucket(blamed_time t) { return t & ~UINT64_C(0xff); }
static inline blamed_time end_of_cycle(blamed_time t) { return t | 0xff; }

/* When a result is ready for each kind of consumer. */
typedef struct result {
    blamed_time ready[SIM_CONSUMERS];
} result;

enum { PRICE_MARKER = 1, PRICE_READS = 2, PRICE_STORE = 4, PRICE_LASTING = 8 };

/* The machine's prices for an op in one form, ready for the loop; 64 bytes. */
typedef struct op_price {
    result latency;
    uint8_t consumer[MAX_SOURCES]; /* sim_consumer of each source */
    uint32_t partners; /* set of classes: ops of these may join this one in V; empty if it cannot issue in U beside another */
    uint32_t words;    /* of its line that it touches, from its address on; 0: those of the mask */
    uint8_t class_id;
    uint8_t flags;     /* PRICE_...; LASTING: busy for several cycles, or blocking: rare, and kept out of the common path */
    uint16_t lanes;    /* all ones for a vector op */
    uint64_t pad[2];
} op_price;
_Static_assert(sizeof(op_price) == 64, "a power of two");

typedef struct store_line {
    uint32_t line;     /* address / 64 */
    uint32_t words;    /* bit i: 32-bit word i was stored */
    blamed_time ready; /* when a load may read them */
} store_line;

/* The state that every op reads and changes; a copy lives in host registers while a batch is timed. */
typedef struct pipeline {
    blamed_time now;   /* of the last issue, bucket 0 */
    blamed_time start; /* the next op issues later than this, unless it joins: end of `now`, or of what blocks the thread */
    uint32_t next;     /* number of the next op in the tile */
    uint32_t partners; /* set of classes of which an op may join the last one in V */
} pipeline;

struct sim_issue {
    const sim_machine *machine;
    op_price *price; /* by the whole op field of an event, UINT16_MAX + 1 of them; most are never touched */

    /* The youngest ops. An older one is ready: two ops a cycle, so `window` of them take longer than any latency. */
    result *results;
    uint32_t window; /* a power of two */
    pipeline pipe;
    blamed_time class_free[LRB_CLASS_COUNT]; /* of lasting classes */
    store_line stores[STORE_LINES];
    uint32_t phase, region;
    uint64_t phase_start, region_start; /* the cycles in which they began */
    uint64_t regions[SIM_MAX_REGIONS + 1];

    /* Of the tile; moved into the stats at its end. */
    uint64_t ops[OPS];
    uint64_t joins[LRB_CLASS_COUNT]; /* ops that joined another's cycle, by class */
    uint64_t waited[BUCKETS];
    sim_issue_stats stats;
};

static sim_consumer consumer_of(char read)
{
    switch (read) {
    case 'e':
        return SIM_CONSUMER_SHUFFLE;
    case 'a':
        return SIM_CONSUMER_ADDRESS;
    case 'b':
        return SIM_CONSUMER_BRANCH;
    default:
        return SIM_CONSUMER_PLAIN;
    }
}

static void consumers_of(lrb_op_id id, unsigned form, uint8_t consumer[MAX_SOURCES])
{
    const char *reads = lrb_shape_table[lrb_op_table[id].shape].reads;
    for (unsigned i = 0; i < MAX_SOURCES; i++)
        consumer[i] = (uint8_t)consumer_of(reads[i]);
    if (form & LRB_FORM_MEMORY)
        consumer[1] = SIM_CONSUMER_ADDRESS;
    else if (form & LRB_FORM_SWIZZLE && lrb_op_access_of(id) == LRB_ACCESS_NONE)
        consumer[1] = SIM_CONSUMER_SHUFFLE;
}

/* Classes whose ops may join one of class k in V. */
static uint32_t partners_of(const sim_machine *machine, unsigned k)
{
    uint32_t partners = 0;
    if (!(machine->cost[k].pipes & SIM_PIPE_U) || machine->cost[k].blocking)
        return 0;
    for (unsigned other = 0; other < LRB_CLASS_COUNT; other++)
        if ((machine->cost[other].pipes & SIM_PIPE_V) && !machine->cost[other].blocking)
            partners |= UINT32_C(1) << other;
    if (machine->cost[k].throughput > 1) /* no two ops of the class share a cycle */
        partners &= ~(UINT32_C(1) << k);
    return partners;
}

static void latencies_of(const sim_class_cost *cost, uint32_t latency[SIM_CONSUMERS])
{
    latency[SIM_CONSUMER_PLAIN] = cost->latency;
    latency[SIM_CONSUMER_SHUFFLE] = cost->latency_to_shuffle;
    latency[SIM_CONSUMER_BRANCH] = cost->latency_to_branch;
    latency[SIM_CONSUMER_ADDRESS] = cost->latency_to_address;
}

static void price_op(sim_issue *s, lrb_op_id id, unsigned form)
{
    op_price *p = &s->price[form | id];
    lrb_shape shape = lrb_op_table[id].shape;
    unsigned k = lrb_op_table[id].class_id;
    const sim_class_cost *cost = &s->machine->cost[k];
    uint32_t latency[SIM_CONSUMERS];
    bool is_vector = lrb_op_kind_of(id) == LRB_KIND_VECTOR;
    bool is_store = lrb_op_access_of(id) == LRB_ACCESS_STORE;
    bool reads_memory = lrb_op_access_of(id) == LRB_ACCESS_LOAD || form & LRB_FORM_MEMORY;
    latencies_of(cost, latency);
    for (unsigned kind = 0; kind < SIM_CONSUMERS; kind++)
        p->latency.ready[kind] = blame(latency[kind], BUCKET_OPERAND + k * SIM_CONSUMERS + kind);
    consumers_of(id, form, p->consumer);
    p->class_id = (uint8_t)k;
    p->partners = partners_of(s->machine, k);
    p->words = is_vector ? (1u << lrb_form_bytes(form) / 4) - 1 : 1;
    p->lanes = is_vector ? 0xffff : 0;
    p->flags = (uint8_t)((shape == LRB_SHAPE_MARK ? PRICE_MARKER : 0) | (reads_memory ? PRICE_READS : 0) |
                         (is_store ? PRICE_STORE : 0) | (cost->throughput > 2 || cost->blocking ? PRICE_LASTING : 0));
}

/* The longest time for which an op can hold up a later one. */
static uint32_t longest_latency(const sim_machine *machine)
{
    uint32_t longest = 1;
    for (unsigned k = 0; k < LRB_CLASS_COUNT; k++) {
        uint32_t latency[SIM_CONSUMERS];
        latencies_of(&machine->cost[k], latency);
        for (unsigned kind = 0; kind < SIM_CONSUMERS; kind++)
            longest = latency[kind] > longest ? latency[kind] : longest;
    }
    return longest;
}

base_status sim_issue_create(const sim_machine *machine, sim_issue **out, base_error *err)
{
    sim_issue *s = calloc(1, sizeof *s);
    if (s) {
        s->machine = machine;
        for (s->window = 64; s->window < 2 * (longest_latency(machine) + 1);)
            s->window *= 2;
        s->results = calloc(s->window, sizeof *s->results);
        s->price = calloc((size_t)UINT16_MAX + 1, sizeof *s->price);
    }
    if (!s || !s->results || !s->price) {
        sim_issue_destroy(&s);
        return base_fail(err, BASE_ERR_NOMEM, "issue model", "out of memory");
    }
    for (unsigned form = 0; form < FORMS; form++)
        for (int id = 0; id < LRB_OP_COUNT; id++)
            price_op(s, (lrb_op_id)id, form << 12);
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
    s->pipe = (pipeline){.start = end_of_cycle(0)};
    s->phase = 0;
    s->phase_start = s->region_start = 0;
    s->region = SIM_MAX_REGIONS;
}

/* The 32-bit words of its line that an access touches. */
static inline uint32_t words_of(const op_price *p, const lrb_event *e)
{
    return p->words ? p->words << e->aux / 4 % 16 : e->mask;
}

static inline store_line *line_of(sim_issue *s, const lrb_event *e)
{
    return &s->stores[e->aux / 64 % STORE_LINES];
}

static inline void remember_store(sim_issue *s, const op_price *p, const lrb_event *e, blamed_time now)
{
    store_line *line = line_of(s, e);
    uint32_t words = words_of(p, e);
    blamed_time ready = now + blame(s->machine->cost[p->class_id].latency, BUCKET_STORE);
    if (line->line == e->aux / 64 && line->ready > end_of_cycle(now)) {
        words |= line->words; /* stores to one line that follow each other closely count as one, ready with the last of them */
        ready = ready > line->ready ? ready : line->ready;
    }
    *line = (store_line){.line = e->aux / 64, .words = words, .ready = ready};
}

/*
 * The loop below is the hottest of the program. A host waits for a chain from each op's issue time to the next one's, so
 * what can be predicted is a branch, which the host runs ahead of, and not a conditional move, which it waits for: kernels
 * are loops, and their ops meet the same waits again and again. The empty statement keeps compilers from turning
 * the branch into a move.
 */
static inline void need(blamed_time ready, blamed_time *at)
{
    if (ready > *at) {
        __asm__("" : "+r"(ready));
        *at = ready;
    }
}

/* Source i must be ready. Distance 0 and distances beyond the window: long ago. */
static inline void need_source(const result *results, uint32_t window, uint32_t next, const op_price *p, const lrb_event *e,
                               unsigned i, blamed_time *at)
{
    uint32_t distance = e->src[i];
    if (distance - 1 < window - 1)
        need(results[(next - distance) & (window - 1)].ready[p->consumer[i]], at);
}

/* What was stored where the op reads must be there. */
static inline void need_stored(sim_issue *s, const op_price *p, const lrb_event *e, blamed_time *at)
{
    const store_line *line = line_of(s, e);
    if (line->ready > *at && line->line == e->aux / 64 && line->words & words_of(p, e))
        *at = line->ready;
}

/* Afterwards the class is busy, or the thread blocked. */
static void outlast(sim_issue *s, pipeline *pipe, const op_price *p)
{
    const sim_class_cost *cost = &s->machine->cost[p->class_id];
    s->class_free[p->class_id] = pipe->now + blame((cost->throughput + 1) / 2, BUCKET_BUSY + p->class_id);
    if (cost->blocking)
        pipe->start = pipe->now + blame(cost->blocking, BUCKET_BLOCKED);
}

/* Leave the times at which the result is ready. */
static inline void put_result(result *r, const result *latency, blamed_time now)
{
    for (int kind = 0; kind < SIM_CONSUMERS; kind++)
        r->ready[kind] = now + latency->ready[kind];
}

/* Join the op before in V, or issue in a new cycle as early as everything allows. */
static inline void issue_op(sim_issue *s, pipeline *pipe, result *results, uint32_t window, blamed_time gap, const op_price *p,
                            const lrb_event *e)
{
    blamed_time at = pipe->start;
    for (unsigned i = 0; i < MAX_SOURCES; i++)
        need_source(results, window, pipe->next, p, e, i, &at);
    if (p->flags & PRICE_READS) {
        need_stored(s, p, e, &at);
        s->stats.memory_operands += (e->op & LRB_FORM_MEMORY) != 0;
    }
    if (p->flags & PRICE_LASTING)
        need(s->class_free[p->class_id], &at);
    if (at == pipe->start && pipe->partners >> p->class_id & 1) {
        s->joins[p->class_id]++;
        pipe->partners = 0;
    } else {
        const blamed_time earliest = pipe->now + gap;
        pipe->now = without_bucket(earliest);
        if (at > earliest) {
            s->waited[at & 0xff] += (at - earliest + 0xff) >> 8;
            pipe->now = without_bucket(at);
        }
        pipe->partners = p->partners;
    }
    put_result(&results[pipe->next++ & (window - 1)], &p->latency, pipe->now);
    pipe->start = end_of_cycle(pipe->now);
    if (p->flags & PRICE_LASTING)
        outlast(s, pipe, p);
    if (p->flags & PRICE_STORE)
        remember_store(s, p, e, pipe->now);
    if (e->mask != 0xffff)
        s->stats.idle_lanes += (unsigned)__builtin_popcount(p->lanes & ~(unsigned)e->mask);
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
    s->phase_start = now;
    s->phase = next < SIM_MAX_PHASES ? next : SIM_MAX_PHASES - 1;
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
}

void sim_issue_events(void *simulator, const lrb_event *events, uint32_t count)
{
    sim_issue *s = simulator;
    pipeline pipe = s->pipe;
    result *const results = s->results;
    const uint32_t window = s->window;
    const blamed_time gap = blame(s->machine->issue_gap, BUCKET_NONE);
    for (const lrb_event *e = events; e < events + count; e++) {
        const op_price *p = &s->price[e->op];
        s->ops[e->op & (OPS - 1)]++;
        if (p->flags & PRICE_MARKER) {
            s->pipe = pipe;
            mark(s, e);
        } else {
            issue_op(s, &pipe, results, window, gap, p, e);
        }
    }
    s->pipe = pipe;
}

/* Ops that did not join issued first in their cycle. */
static void collect_issues(const sim_issue *s, sim_issue_stats *to)
{
    uint64_t issues = 0, joins = 0;
    for (int id = 0; id < LRB_OP_COUNT; id++) {
        bool marker = lrb_op_table[id].shape == LRB_SHAPE_MARK;
        to->ops[id] += s->ops[id];
        to->issued_by_class[lrb_op_table[id].class_id] += marker ? 0 : s->ops[id];
        issues += marker ? 0 : s->ops[id];
    }
    for (int k = 0; k < LRB_CLASS_COUNT; k++) {
        to->issued_by_class[k] -= s->joins[k];
        joins += s->joins[k];
    }
    issues -= joins;
    to->issued_pair += joins;
    to->issued_one += issues - joins;
    if (issues > 0) /* the first one waits for no gap */
        to->gap += (issues - 1) * (s->machine->issue_gap - 1);
}

/* Move what the loop has summed up in the tile into the stats. */
static void collect(sim_issue *s, sim_issue_stats *to)
{
    const uint64_t *waited = s->waited;
    collect_issues(s, to);
    for (int k = 0; k < LRB_CLASS_COUNT; k++) {
        for (int kind = 0; kind < SIM_CONSUMERS; kind++)
            to->operand[k][kind] += waited[BUCKET_OPERAND + k * SIM_CONSUMERS + kind];
        to->busy[k] += waited[BUCKET_BUSY + k];
    }
    to->store_forward += waited[BUCKET_STORE];
    to->blocked += waited[BUCKET_BLOCKED];
    memset(s->ops, 0, sizeof s->ops);
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
