#include "traces/predictor.h"

#include <string.h>

/* Spread a number over 32 bits: Knuth's multiplicative hashing by the golden ratio. */
static uint32_t spread(uint32_t x)
{
    return x * UINT32_C(0x9e3779b1);
}

/* All sites and blocks are in use: begin with none again. Events before this are still found by their names. */
static void forget_sites(trace_predictor *p)
{
    memset(p->block, 0, sizeof p->block);
    p->sites = 1;
    p->blocks = p->fixed = 0;
}

void trace_predictor_begin(trace_predictor *p)
{
    for (uint32_t i = 0; i < TRACE_NAMES + p->fixed; i++)
        p->maker[i] = (trace_maker){.base_position = 1}; /* no position: no base is known */
    memset(p->outcome, 0, sizeof p->outcome);
    forget_sites(p);
    p->position = LRB_FAR;
    p->history = p->last[0] = p->last[1] = 0;
    p->at = trace_predictor_block(p);
}

/* A site where no event has been. */
static uint32_t new_site(trace_predictor *p, uint32_t name)
{
    name %= TRACE_NAMES;
    p->site[p->sites] = (trace_site){.op = TRACE_NO_OP, .name = (uint16_t)(name ? name : 1), .base = TRACE_NO_BASE};
    return p->sites++;
}

static uint32_t place_of(uint32_t key)
{
    return spread(key) / (UINT32_MAX / TRACE_BLOCKS + 1);
}

/* The block of that key, a new one with names from `name` on if there is none. */
static uint32_t find_block(trace_predictor *p, uint32_t key, uint32_t name)
{
    key += key == 0;
    uint32_t i = place_of(key);
    while (p->block[i].key != key && p->block[i].key)
        i = (i + 1) % TRACE_BLOCKS;
    if (p->block[i].key)
        return p->block[i].site;
    if (p->sites == TRACE_SITES || p->blocks == TRACE_BLOCKS / 2) {
        forget_sites(p);
        i = place_of(key);
    }
    p->blocks++;
    p->block[i] = (trace_block){.key = key, .site = new_site(p, name)};
    return p->block[i].site;
}

uint32_t trace_predictor_block(trace_predictor *p)
{
    return find_block(p, spread(p->last[0]) ^ spread(p->last[1] + 1) >> 5, spread(p->last[0]) >> 16);
}

uint32_t trace_predictor_extend(trace_predictor *p, uint32_t site)
{
    uint32_t name = p->site[site].name + 1u;
    if (p->sites == TRACE_SITES) {
        forget_sites(p);
        return new_site(p, name);
    }
    p->site[site].next = (uint16_t)new_site(p, name);
    return p->site[site].next;
}

/* A site is to hold events of that op. */
static void set_op(trace_site *s, uint16_t op)
{
    lrb_op_id id = (lrb_op_id)(op & LRB_EVENT_ID);
    lrb_cost_class class_id = lrb_op_table[id].class_id;
    *s = (trace_site){.op = op, .mask = 0xffff, .next = s->next, .name = s->name, .token = op};
    s->base = op & LRB_FORM_MEMORY ? 1 : lrb_op_access_of(id) != LRB_ACCESS_NONE ? 0 : TRACE_NO_BASE;
    s->kind = class_id == LRB_CLASS_marker           ? TRACE_KIND_MARKER
              : class_id == LRB_CLASS_branch         ? TRACE_KIND_BRANCH
              : class_id == LRB_CLASS_vector_compare ? TRACE_KIND_COMPARE
                                                     : TRACE_KIND_OP;
}

uint32_t trace_predictor_turn(trace_predictor *p, uint32_t at, uint16_t op)
{
    if (p->site[at].op != TRACE_NO_OP)
        at = find_block(p, spread(at << 16 | op) + 1, p->site[at].name + 3u * op);
    if (p->site[at].op != op)
        set_op(&p->site[at], op);
    return at;
}

void trace_learn_source(trace_predictor *p, trace_site *s, unsigned i, uint16_t distance)
{
    uint32_t position = p->position - distance;
    uint32_t name = distance ? p->name_at[position % LRB_FAR] : 0;
    if (name == 0 || p->maker[name].position == position) {
        s->maker[i] = (uint16_t)name;
        return;
    }
    /* An older event of that name: one that loops behind it did not make anew, but others of the name did. */
    if (s->maker[i] < TRACE_NAMES) {
        if (p->fixed == TRACE_FIXED)
            return;
        s->maker[i] = (uint16_t)(TRACE_NAMES + p->fixed++);
    }
    p->maker[s->maker[i]] = (trace_maker){.position = position, .mask = p->maker[name].mask, .base_position = 1};
}

void trace_learn_aux(const trace_predictor *p, trace_site *s, uint32_t aux)
{
    const trace_maker *base = &p->maker[s->maker[s->base]];
    if (base->base_position == base->position)
        s->offset = aux - base->base;
    if (s->kind == TRACE_KIND_BRANCH)
        s->token = spread(aux) >> 8 ^ s->op;
}

void trace_learn_mask(trace_predictor *p, trace_site *s, uint16_t mask)
{
    s->mask = mask;
    p->maker[s->maker[TRACE_MASK_SOURCE]].mask = mask;
}
