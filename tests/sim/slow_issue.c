#include "tests/sim/slow_issue.h"

#include <stdlib.h>
#include <string.h>

/* What is known of an op once it has issued. */
typedef struct issued_op {
    lrb_cost_class class_id;
    uint64_t cycle;
} issued_op;

/* A store that has issued, with the closely following ones before it that count as one with it. */
typedef struct issued_store {
    uint32_t line;
    uint32_t words;
    uint64_t ready;
} issued_store;

typedef struct slow_tile {
    const sim_machine *machine;
    const lrb_event *events;
    uint32_t count;
    uint32_t at; /* event that issues next, or a marker before it */
    uint32_t phase, region;
    uint64_t cycle;
    issued_op *ops; /* by their number in the tile; markers have none */
    uint32_t op_count;
    issued_store *stores;
    uint32_t store_count;
    uint64_t class_cycle[LRB_CLASS_COUNT]; /* of the last op of the class; 0: none */
    sim_issue_stats *stats;
    uint64_t *regions;
} slow_tile;

/* A reason to wait: when it ends, its rank among reasons that end together, and the bucket of its cycles. */
typedef struct reason {
    uint64_t end;
    unsigned rank;
    uint64_t *bucket;
} reason;

static void worse(reason *worst, uint64_t end, unsigned rank, uint64_t *bucket)
{
    if (end > worst->end || (end == worst->end && rank > worst->rank))
        *worst = (reason){end, rank, bucket};
}

static const lrb_op_info *info_of(const lrb_event *e)
{
    return &lrb_op_table[e->op & LRB_EVENT_ID];
}

/* Where the M for memory stands in the name of an event's shape, result first: before the _ it is stored to, behind it read; H is
 * a hint. */
static bool is_store(const lrb_event *e)
{
    return lrb_shape_table[info_of(e)->shape].name[0] == 'M' && info_of(e)->shape != LRB_SHAPE_MARK;
}

static bool is_vector_store(const lrb_event *e)
{
    return is_store(e) && strchr(lrb_shape_table[info_of(e)->shape].name, 'V');
}

static bool is_hint(const lrb_event *e)
{
    return info_of(e)->shape == LRB_SHAPE_H_M || info_of(e)->shape == LRB_SHAPE_H_MVI || info_of(e)->shape == LRB_SHAPE_H_VIM;
}

static bool is_load(const lrb_event *e)
{
    return strstr(lrb_shape_table[info_of(e)->shape].name, "_M") && !is_hint(e);
}

static bool is_vector(const lrb_event *e)
{
    return lrb_op_kind_of((lrb_op_id)(e->op & LRB_EVENT_ID)) == LRB_KIND_VECTOR;
}

static bool is_marker(const lrb_event *e)
{
    return info_of(e)->class_id == LRB_CLASS_marker;
}

/* Whether the lanes of source i go elsewhere, as shapes.def tells with an X: those of a register are source 0, those of S3 source 1. */
static bool moves_lanes(const lrb_event *e, int i)
{
    switch (info_of(e)->shape) {
    case LRB_SHAPE_V_VII:
    case LRB_SHAPE_VI_XII:
        return i == 0;
    case LRB_SHAPE_V_XI:
    case LRB_SHAPE_VI_XI:
    case LRB_SHAPE_V_VX:
    case LRB_SHAPE_VI_VX:
    case LRB_SHAPE_VD_ps: /* and conversions from and to doubles, which read their source as early */
    case LRB_SHAPE_VD_pi:
    case LRB_SHAPE_V_pd_I:
    case LRB_SHAPE_VI_pd_I:
    case LRB_SHAPE_V_Vpd_I:
    case LRB_SHAPE_VI_Vpd_I:
        return i == 1;
    case LRB_SHAPE_VI_XX:
    case LRB_SHAPE_VI_XXI:
        return i == 0 || i == 1;
    default:
        return false;
    }
}

/* Whether source i is a mask: of a vector op the third, of others what their shape calls K; and the old destination of a gather. */
static bool reads_mask(const lrb_event *e, int i)
{
    const char *name = lrb_shape_table[info_of(e)->shape].name, *from = strchr(name, '_');
    const bool has_vectors = strchr(name, 'V');
    if (has_vectors)
        return i == 2 || (i == 0 && info_of(e)->shape == LRB_SHAPE_VIK_VKV) || (i == 3 && name[0] == 'V' && strstr(name, "_MVI"));
    return from && i < 2 && (size_t)i + 1 < strlen(from) && from[i + 1] == 'K';
}

/* How an event reads its source i: event.h says which source is what. */
static sim_consumer consumer_of(const lrb_event *e, int i)
{
    bool is_address = (is_load(e) || is_store(e) || is_hint(e)) ? i == 0 || i == 1 : (e->op & LRB_FORM_MEMORY) && i == 1;
    if (is_address)
        return SIM_CONSUMER_ADDRESS;
    if ((e->op & LRB_FORM_SWIZZLE && !is_load(e) && i == 1) || (is_vector_store(e) && i == 3) ||
        moves_lanes(e, i))
        return SIM_CONSUMER_SHUFFLE;
    if (info_of(e)->shape == LRB_SHAPE_B_F && i == 0)
        return SIM_CONSUMER_BRANCH;
    return reads_mask(e, i) ? SIM_CONSUMER_MASK : SIM_CONSUMER_PLAIN;
}

static unsigned latency_to(const sim_class_cost *cost, sim_consumer consumer)
{
    switch (consumer) {
    case SIM_CONSUMER_SHUFFLE:
        return cost->latency_to_shuffle;
    case SIM_CONSUMER_BRANCH:
        return cost->latency_to_branch;
    case SIM_CONSUMER_ADDRESS:
        return cost->latency_to_address;
    case SIM_CONSUMER_MASK:
        return cost->latency_to_mask;
    default:
        return cost->latency;
    }
}

/* The 32-bit words of its line that an access touches, bit 0 the first. */
static uint32_t words_touched(const lrb_event *e)
{
    uint32_t words = 0;
    uint32_t first = e->aux % 64 / 4;
    static const uint32_t words_of_form[16] = {[0x4] = 1, [0x5] = 2, [0x8] = 16, [0xc] = 4, [0xd] = 8}; /* event.h: the top bits of op */
    uint32_t many = words_of_form[(e->op & LRB_FORM_BYTES) >> 12];
    if (many == 0 && is_vector(e))
        return e->mask;
    if (many == 0)
        many = 1;
    if (many == 16)
        first = 0;
    for (uint32_t word = first; word < first + many && word < 16; word++)
        words |= 1u << word;
    return words;
}

/* The last store to a line of the same slot, if it was to this line; 64 slots, a line's is its number modulo 64. */
static const issued_store *last_store(const slow_tile *t, uint32_t line)
{
    for (uint32_t i = t->store_count; i > 0; i--) {
        const issued_store *store = &t->stores[i - 1];
        if (store->line % 64 == line % 64)
            return store->line == line ? store : NULL;
    }
    return NULL;
}

static void wait_for_sources(const slow_tile *t, const lrb_event *e, reason *worst)
{
    for (int i = 0; i < 4; i++) {
        if (e->src[i] == 0 || e->src[i] > t->op_count)
            continue;
        const issued_op *producer = &t->ops[t->op_count - e->src[i]];
        sim_consumer consumer = consumer_of(e, i);
        worse(worst, producer->cycle + latency_to(&t->machine->cost[producer->class_id], consumer),
              (unsigned)producer->class_id * SIM_CONSUMERS + consumer, &t->stats->operand[producer->class_id][consumer]);
    }
}

/* What holds an event up in this cycle; its bucket is NULL if nothing does. Of several reasons the one that ends last. */
static reason held_up(const slow_tile *t, const lrb_event *e)
{
    enum { STORE_RANK = 1000, BUSY_RANK, BLOCKED_RANK };
    reason worst = {0, 0, NULL};
    lrb_cost_class class_id = info_of(e)->class_id;
    const sim_class_cost *cost = &t->machine->cost[class_id];
    wait_for_sources(t, e, &worst);
    if (is_load(e) || e->op & LRB_FORM_MEMORY) {
        const issued_store *store = last_store(t, e->aux / 64);
        if (store && store->words & words_touched(e))
            worse(&worst, store->ready, STORE_RANK, &t->stats->store_forward);
    }
    if (t->class_cycle[class_id] && cost->throughput >= 2) /* in halves; 1.5 cycles are rounded up to 2 */
        worse(&worst, t->class_cycle[class_id] + (cost->throughput + 1) / 2, BUSY_RANK, &t->stats->busy[class_id]);
    if (t->op_count) {
        const issued_op *last = &t->ops[t->op_count - 1];
        if (t->machine->cost[last->class_id].blocking)
            worse(&worst, last->cycle + t->machine->cost[last->class_id].blocking, BLOCKED_RANK, &t->stats->blocked);
    }
    if (worst.end <= t->cycle)
        worst.bucket = NULL;
    return worst;
}

static void record_store(slow_tile *t, const lrb_event *e)
{
    issued_store store = {e->aux / 64, words_touched(e), t->cycle + t->machine->cost[info_of(e)->class_id].latency};
    const issued_store *before = last_store(t, store.line);
    if (before && before->ready > t->cycle) {
        store.words |= before->words;
        store.ready = before->ready > store.ready ? before->ready : store.ready;
    }
    t->stores[t->store_count++] = store;
}

/* Let the next event issue in this cycle. */
static void issue(slow_tile *t)
{
    const lrb_event *e = &t->events[t->at++];
    if (is_store(e))
        record_store(t, e);
    t->ops[t->op_count++] = (issued_op){info_of(e)->class_id, t->cycle};
    t->class_cycle[info_of(e)->class_id] = t->cycle;
    t->stats->ops[e->op & LRB_EVENT_ID]++;
    t->stats->memory_operands += e->op & LRB_FORM_MEMORY ? 1 : 0;
    t->stats->phase_vector_ops[t->phase] += is_vector(e);
    for (int lane = 0; lane < 16; lane++)
        t->stats->phase_idle_lanes[t->phase] += is_vector(e) && !(e->mask >> lane & 1);
}

/* Take in the markers before the next op. */
static void pass_markers(slow_tile *t)
{
    for (; t->at < t->count && is_marker(&t->events[t->at]); t->at++) {
        const lrb_event *e = &t->events[t->at];
        t->stats->ops[e->op & LRB_EVENT_ID]++;
        if ((e->op & LRB_EVENT_ID) == LRB_OP_phase)
            t->phase = e->aux < SIM_MAX_PHASES ? e->aux : SIM_MAX_PHASES - 1;
        else if ((e->op & LRB_EVENT_ID) == LRB_OP_region)
            t->region = e->aux < SIM_MAX_REGIONS ? e->aux : SIM_MAX_REGIONS;
    }
}

/* An op has just issued in U: may the next one join it in V? */
static bool joins(const slow_tile *t, lrb_cost_class first)
{
    if (t->at == t->count)
        return false;
    const lrb_event *e = &t->events[t->at];
    const sim_class_cost *cost = &t->machine->cost[info_of(e)->class_id], *first_cost = &t->machine->cost[first];
    if (!(first_cost->pipes & SIM_PIPE_U) || first_cost->blocking || !(cost->pipes & SIM_PIPE_V) || cost->blocking)
        return false;
    return !held_up(t, e).bucket;
}

/* One cycle: it lies in a gap, or the next op waits, or one or two ops issue. */
static void step(slow_tile *t)
{
    const lrb_event *e = &t->events[t->at];
    lrb_cost_class first = info_of(e)->class_id;
    t->stats->cycles++;
    t->stats->phase[t->phase]++;
    t->stats->op_cycles[e->op & LRB_EVENT_ID]++;
    t->regions[t->region]++;
    if (t->op_count && t->cycle < t->ops[t->op_count - 1].cycle + t->machine->issue_gap) {
        t->stats->gap++;
        return;
    }
    reason why = held_up(t, e);
    if (why.bucket) {
        (*why.bucket)++;
        return;
    }
    issue(t);
    t->stats->issued_by_class[first]++;
    t->stats->op_issues[e->op & LRB_EVENT_ID]++;
    pass_markers(t);
    if (joins(t, first)) {
        issue(t);
        pass_markers(t);
        t->stats->issued_pair++;
    } else {
        t->stats->issued_one++;
    }
}

bool slow_issue_tile(const sim_machine *machine, const lrb_event *events, uint32_t count, sim_issue_stats *stats,
                     uint64_t regions[SIM_MAX_REGIONS + 1])
{
    slow_tile t = {.machine = machine, .events = events, .count = count, .region = SIM_MAX_REGIONS, .stats = stats,
                   .regions = regions};
    t.ops = calloc((size_t)count + 1, sizeof *t.ops);
    t.stores = calloc((size_t)count + 1, sizeof *t.stores);
    bool good = t.ops && t.stores;
    if (good) {
        for (int i = 0; i <= SIM_MAX_REGIONS; i++)
            regions[i] = 0;
        pass_markers(&t);
        for (t.cycle = 1; t.at < t.count; t.cycle++)
            step(&t);
    }
    free(t.ops);
    free(t.stores);
    return good;
}
