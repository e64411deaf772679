#include "sim/issue.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { STORE_LINES = 64, FORMS = 16, MAX_SOURCES = 4, OPS = 128 };
_Static_assert((int)LRB_OP_COUNT <= OPS, "the price table has a place for every op");

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
_Static_assert(BUCKETS <= 256, "a bucket is 8 bits");
typedef uint64_t blamed_time;

static inline blamed_time blame(uint64_t time, unsigned bucket) { return time << 8 | bucket; }
static inline blamed_time latest(blamed_time a, blamed_time b) { return a > b ? a : b; }

/* The machine's prices for an op in one form, ready for the loop; 32 bytes. */
typedef struct op_price {
    uint8_t class_id;
    uint8_t consumer[MAX_SOURCES]; /* sim_consumer of each source */
    bool is_marker, reads_memory, is_store, is_vector;
    bool may_start_pair, may_join; /* U, and V beside an older op */
    uint8_t words;                 /* of its line that it touches: 0: those of the mask; otherwise as many from its address on */
    uint8_t exclusive;             /* class + 1 if no two ops of the class share a cycle, else 0 */
    bool lasting;                  /* busy for several cycles, or blocking: rare, and kept out of the common path */
    uint16_t busy;                 /* cycles before another op of the class may issue */
    uint16_t blocking;
    uint8_t pad[14];
} op_price;
_Static_assert(sizeof(op_price) == 32, "a power of two");

/* When a result is ready for each kind of consumer. */
typedef struct result {
    blamed_time ready[SIM_CONSUMERS];
} result;

typedef struct store_line {
    uint32_t line;    /* address / 64 */
    uint32_t words;   /* bit i: 32-bit word i was stored */
    blamed_time ready; /* when a load may read them */
} store_line;

/* The state that every op reads and changes; a copy lives in host registers while a batch is timed. */
typedef struct pipeline {
    uint64_t now;         /* cycle of the last issue; the tile's first possible one is 1 */
    uint64_t earliest;    /* cycle of the next issue, if nothing holds it up */
    uint32_t next;        /* number of the next op in the tile */
    unsigned first_class; /* class of the op that issued first in `now` */
    bool joinable;        /* an op may still join in V */
    blamed_time blocked;
} pipeline;

struct sim_issue {
    const sim_machine *machine;
    op_price price[FORMS][OPS];
    result latency[LRB_CLASS_COUNT]; /* by class and consumer */

    /* The youngest ops. An older one is ready: two ops a cycle, so `window` of them take longer than any latency. */
    result *results;
    uint32_t window; /* a power of two */
    pipeline pipe;
    blamed_time class_free[LRB_CLASS_COUNT]; /* of lasting classes */
    store_line stores[STORE_LINES];
    uint32_t phase, region;
    uint64_t phase_start, region_start; /* the cycles in which they began */
    uint64_t regions[SIM_MAX_REGIONS + 1];
    uint64_t joins;      /* ops that joined another's cycle */
    uint64_t first_gaps; /* tiles that have issued anything: their first op waits for no gap */
    uint64_t waited[BUCKETS];
    sim_issue_stats stats;
};

static void consumers_of(lrb_op_id id, unsigned form, uint8_t consumer[MAX_SOURCES])
{
    memset(consumer, SIM_CONSUMER_PLAIN, MAX_SOURCES);
    switch (lrb_op_table[id].shape) {
    case LRB_SHAPE_M_V:
    case LRB_SHAPE_M_VI:
        consumer[3] = SIM_CONSUMER_SHUFFLE; /* stored data is read early */
        consumer[0] = consumer[1] = SIM_CONSUMER_ADDRESS;
        break;
    case LRB_SHAPE_V_M:
    case LRB_SHAPE_VI_M:
    case LRB_SHAPE_R_M:
    case LRB_SHAPE_M_R:
        consumer[0] = consumer[1] = SIM_CONSUMER_ADDRESS;
        break;
    case LRB_SHAPE_V_VII:
        consumer[0] = SIM_CONSUMER_SHUFFLE;
        break;
    case LRB_SHAPE_B_F:
        consumer[0] = SIM_CONSUMER_BRANCH;
        break;
    default:
        break;
    }
    if (form & LRB_FORM_MEMORY)
        consumer[1] = SIM_CONSUMER_ADDRESS;
    else if (form & LRB_FORM_SWIZZLE)
        consumer[1] = SIM_CONSUMER_SHUFFLE;
}

static void price_op(sim_issue *s, lrb_op_id id, unsigned form)
{
    op_price *p = &s->price[form >> 12][id];
    lrb_shape shape = lrb_op_table[id].shape;
    const sim_class_cost *cost = &s->machine->cost[lrb_op_table[id].class_id];
    p->class_id = (uint8_t)lrb_op_table[id].class_id;
    consumers_of(id, form, p->consumer);
    p->is_marker = shape == LRB_SHAPE_MARK;
    p->is_vector = lrb_op_kind_of(id) == LRB_KIND_VECTOR;
    p->is_store = shape == LRB_SHAPE_M_V || shape == LRB_SHAPE_M_VI || shape == LRB_SHAPE_M_R;
    p->reads_memory = (lrb_op_is_memory(id) && !p->is_store) || form & LRB_FORM_MEMORY;
    p->words = form & LRB_FORM_4TO16 ? 4 : form & LRB_FORM_CONVERT || !p->is_vector ? 1 : 0;
    p->may_start_pair = (cost->pipes & SIM_PIPE_U) && !cost->blocking;
    p->may_join = (cost->pipes & SIM_PIPE_V) && !cost->blocking;
    p->busy = (uint16_t)((cost->throughput + 1) / 2);
    p->blocking = (uint16_t)cost->blocking;
    p->exclusive = cost->throughput > 1 ? (uint8_t)(p->class_id + 1) : 0;
    p->lasting = p->busy > 1 || p->blocking;
}

/* Latencies by class; returns the longest time for which an op can hold up a later one. */
static uint32_t price_classes(sim_issue *s)
{
    uint32_t longest = 1;
    for (unsigned k = 0; k < LRB_CLASS_COUNT; k++) {
        const sim_class_cost *cost = &s->machine->cost[k];
        const uint32_t latency[SIM_CONSUMERS] = {
            [SIM_CONSUMER_PLAIN] = cost->latency,
            [SIM_CONSUMER_SHUFFLE] = cost->latency_to_shuffle,
            [SIM_CONSUMER_BRANCH] = cost->latency_to_branch,
            [SIM_CONSUMER_ADDRESS] = cost->latency_to_address,
        };
        for (unsigned kind = 0; kind < SIM_CONSUMERS; kind++) {
            s->latency[k].ready[kind] = blame(latency[kind], BUCKET_OPERAND + k * SIM_CONSUMERS + kind);
            longest = latency[kind] > longest ? latency[kind] : longest;
        }
    }
    return longest;
}

base_status sim_issue_create(const sim_machine *machine, sim_issue **out, base_error *err)
{
    sim_issue *s = calloc(1, sizeof *s);
    if (s) {
        s->machine = machine;
        for (unsigned form = 0; form < FORMS; form++)
            for (int id = 0; id < LRB_OP_COUNT; id++)
                price_op(s, (lrb_op_id)id, form << 12);
        uint32_t longest = price_classes(s);
        for (s->window = 64; s->window < 2 * (longest + 1);)
            s->window *= 2;
        s->results = calloc(s->window, sizeof *s->results);
    }
    if (!s || !s->results) {
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
    s->pipe = (pipeline){.earliest = 1};
    s->phase = 0;
    s->phase_start = s->region_start = 0;
    s->region = SIM_MAX_REGIONS;
}

/* The 32-bit words of its line that an access touches. */
static inline uint32_t words_of(const op_price *p, const lrb_event *e)
{
    return p->words ? ((1u << p->words) - 1) << e->aux / 4 % 16 : e->mask;
}

static inline blamed_time store_ready(const sim_issue *s, const op_price *p, const lrb_event *e)
{
    const store_line *line = &s->stores[e->aux / 64 % STORE_LINES];
    return line->line == e->aux / 64 && line->words & words_of(p, e) ? line->ready : 0;
}

static inline void remember_store(sim_issue *s, const op_price *p, const lrb_event *e, uint64_t now)
{
    store_line *line = &s->stores[e->aux / 64 % STORE_LINES];
    uint32_t words = words_of(p, e);
    blamed_time ready = blame(now + s->machine->cost[p->class_id].latency, BUCKET_STORE);
    if (line->line == e->aux / 64 && line->ready >= blame(now + 1, 0)) {
        words |= line->words; /* stores to one line that follow each other closely count as one, ready with the last of them */
        ready = latest(ready, line->ready);
    }
    *line = (store_line){e->aux / 64, words, ready};
}

/* When source i is ready. Distance 0 and distances beyond the window: long ago. */
static inline blamed_time source_ready(const result *results, uint32_t window, uint32_t next, const op_price *p, const lrb_event *e,
                                       unsigned i)
{
    blamed_time ready = results[(next - e->src[i]) & (window - 1)].ready[p->consumer[i]];
    return e->src[i] - 1u < window - 1u ? ready : 0;
}

/* When everything that an op needs is there: operands, stored data, its class if that is busy for long, the thread. */
static inline blamed_time needs_ready(const sim_issue *s, const pipeline *pipe, const op_price *p, const lrb_event *e)
{
    const result *r = s->results;
    blamed_time at = latest(latest(source_ready(r, s->window, pipe->next, p, e, 0), source_ready(r, s->window, pipe->next, p, e, 1)),
                            latest(source_ready(r, s->window, pipe->next, p, e, 2), source_ready(r, s->window, pipe->next, p, e, 3)));
    if (p->reads_memory)
        at = latest(at, store_ready(s, p, e));
    if (p->lasting)
        at = latest(at, s->class_free[p->class_id]);
    return latest(at, pipe->blocked);
}

/* Join the op before in V, or issue in a new cycle as early as everything allows. Without branches: which of the two it
   is changes too irregularly for a host to predict. */
static inline void issue_op(sim_issue *s, pipeline *pipe, uint32_t gap, const op_price *p, const lrb_event *e)
{
    blamed_time at = needs_ready(s, pipe, p, e);
    bool join = pipe->joinable & p->may_join & (at < blame(pipe->now + 1, 0)) & (p->exclusive != pipe->first_class + 1);
    at = latest(at, blame(pipe->earliest, BUCKET_NONE));
    s->waited[at & 0xff] += join ? 0 : (at >> 8) - pipe->earliest;
    uint64_t now = join ? pipe->now : at >> 8;
    s->joins += join;
    s->stats.issued_by_class[p->class_id] += !join;
    result *r = &s->results[pipe->next++ & (s->window - 1)];
    for (int kind = 0; kind < SIM_CONSUMERS; kind++)
        r->ready[kind] = blame(now, 0) + s->latency[p->class_id].ready[kind];
    pipe->now = now;
    pipe->earliest = now + gap;
    pipe->first_class = join ? pipe->first_class : p->class_id;
    pipe->joinable = p->may_start_pair & !join;
    if (p->lasting) {
        s->class_free[p->class_id] = blame(now + p->busy, BUCKET_BUSY + p->class_id);
        pipe->blocked = p->blocking ? blame(now + p->blocking, BUCKET_BLOCKED) : pipe->blocked;
    }
    if (p->is_store)
        remember_store(s, p, e, now);
    s->stats.memory_operands += (e->op & LRB_FORM_MEMORY) != 0;
    if (p->is_vector && e->mask != 0xffff)
        s->stats.idle_lanes += 16u - (unsigned)__builtin_popcount(e->mask);
}

/* Cycles up to now belong to the phase and region that end here. */
static void end_phase(sim_issue *s, uint32_t next)
{
    s->stats.phase[s->phase] += s->pipe.now - s->phase_start;
    s->phase_start = s->pipe.now;
    s->phase = next < SIM_MAX_PHASES ? next : SIM_MAX_PHASES - 1;
}

static void end_region(sim_issue *s, uint32_t next)
{
    s->regions[s->region] += s->pipe.now - s->region_start;
    s->region_start = s->pipe.now;
    s->region = next < SIM_MAX_REGIONS ? next : SIM_MAX_REGIONS;
}

static void mark(sim_issue *s, const lrb_event *e)
{
    if ((e->op & LRB_EVENT_ID) == LRB_OP_phase)
        end_phase(s, e->aux);
    else
        end_region(s, e->aux);
}

void sim_issue_events(void *simulator, const lrb_event *events, uint32_t count)
{
    sim_issue *s = simulator;
    pipeline pipe = s->pipe;
    const uint32_t gap = s->machine->issue_gap;
    for (const lrb_event *e = events; e < events + count; e++) {
        const op_price *p = &s->price[e->op >> 12][e->op & (OPS - 1)];
        s->stats.ops[e->op & (OPS - 1)]++;
        if (p->is_marker) {
            s->pipe = pipe;
            mark(s, e);
        } else {
            issue_op(s, &pipe, gap, p, e);
        }
    }
    s->pipe = pipe;
}

/* Move what the loop has summed up since the last tile into the stats. */
static void collect(sim_issue *s, sim_issue_stats *to)
{
    const uint64_t *waited = s->waited;
    uint64_t issues = 0;
    for (int k = 0; k < LRB_CLASS_COUNT; k++)
        issues += to->issued_by_class[k];
    to->issued_pair = s->joins;
    to->issued_one = issues - s->joins;
    to->gap = (issues - s->first_gaps) * (s->machine->issue_gap - 1);
    for (int k = 0; k < LRB_CLASS_COUNT; k++) {
        for (int kind = 0; kind < SIM_CONSUMERS; kind++)
            to->operand[k][kind] += waited[BUCKET_OPERAND + k * SIM_CONSUMERS + kind];
        to->busy[k] += waited[BUCKET_BUSY + k];
    }
    to->store_forward += waited[BUCKET_STORE];
    to->blocked += waited[BUCKET_BLOCKED];
    memset(s->waited, 0, sizeof s->waited);
}

void sim_issue_end(sim_issue *s, uint64_t regions[SIM_MAX_REGIONS + 1])
{
    end_phase(s, 0);
    end_region(s, SIM_MAX_REGIONS);
    s->stats.cycles += s->pipe.now;
    s->first_gaps += s->pipe.next > 0;
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
