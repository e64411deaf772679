#include "sim/op_price.h"

#include <stdbool.h>
#include <stdlib.h>

#include "lrbni/event.h"

enum { FORMS = 16 };

static sim_consumer consumer_of(char read)
{
    switch (read) {
    case 'e':
        return SIM_CONSUMER_SHUFFLE;
    case 'a':
        return SIM_CONSUMER_ADDRESS;
    case 'b':
        return SIM_CONSUMER_BRANCH;
    case 'm':
        return SIM_CONSUMER_MASK;
    default:
        return SIM_CONSUMER_PLAIN;
    }
}

static void consumers_of(lrb_op_id id, unsigned form, uint8_t consumer[SIM_MAX_SOURCES])
{
    const char *reads = lrb_shape_table[lrb_op_table[id].shape].reads;
    for (unsigned i = 0; i < SIM_MAX_SOURCES; i++)
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
    latency[SIM_CONSUMER_MASK] = cost->latency_to_mask;
}

static uint8_t flags_of(lrb_op_id id, unsigned form, const sim_class_cost *cost)
{
    unsigned flags = lrb_op_table[id].shape == LRB_SHAPE_MARK ? SIM_PRICE_MARKER : 0;
    switch (lrb_op_access_of(id)) {
    case LRB_ACCESS_NONE:
        break;
    case LRB_ACCESS_LOAD:
        flags |= SIM_PRICE_READS;
        break;
    case LRB_ACCESS_STORE:
        flags |= SIM_PRICE_STORE;
        break;
    case LRB_ACCESS_HINT:
        break;
    }
    if (lrb_op_hint_of(id) != LRB_HINT_NONE)
        flags |= SIM_PRICE_HINT;
    if (form & LRB_FORM_MEMORY)
        flags |= SIM_PRICE_READS;
    if (lrb_op_kind_of(id) == LRB_KIND_BRANCH)
        flags |= SIM_PRICE_BRANCH;
    if (cost->throughput > 2 || cost->blocking)
        flags |= SIM_PRICE_LASTING;
    return (uint8_t)flags;
}

static void price_op(sim_op_price *p, const sim_machine *machine, lrb_op_id id, unsigned form)
{
    unsigned k = lrb_op_table[id].class_id;
    const sim_class_cost *cost = &machine->cost[k];
    uint32_t latency[SIM_CONSUMERS];
    bool is_vector = lrb_op_kind_of(id) == LRB_KIND_VECTOR;
    latencies_of(cost, latency);
    for (unsigned kind = 0; kind < SIM_CONSUMERS; kind++)
        p->latency.ready[kind] = sim_blame(latency[kind], SIM_BUCKET_OPERAND + k * SIM_CONSUMERS + kind);
    consumers_of(id, form, p->consumer);
    p->class_id = (uint8_t)k;
    p->partners = partners_of(machine, k);
    p->words = lrb_form_bytes(form) || is_vector ? (1u << lrb_form_bytes(form) / 4) - 1 : 1;
    p->word_shift = lrb_form_bytes(form) == 64 ? 0 : 15;
    p->lanes = is_vector ? 0xffff : 0;
    p->flags = flags_of(id, form, cost);
    p->busy = (uint16_t)((cost->throughput + 1) / 2);
    p->blocking = (uint16_t)cost->blocking;
    p->bytes = (uint8_t)(lrb_form_bytes(form) ? lrb_form_bytes(form) : is_vector ? 64 : 4);
}

sim_op_price *sim_op_prices(const sim_machine *machine)
{
    sim_op_price *prices = calloc((size_t)UINT16_MAX + 1, sizeof *prices);
    for (unsigned form = 0; prices && form < FORMS; form++)
        for (int id = 0; id < LRB_OP_COUNT; id++)
            price_op(&prices[form << 12 | (unsigned)id], machine, (lrb_op_id)id, form << 12);
    return prices;
}

uint32_t sim_longest_latency(const sim_machine *machine)
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
