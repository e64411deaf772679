/* What both ends of a trace expect the next event to be (docs/trace-format.md, 'Expectations').
 *
 * Kernels are loops: what follows two branches is nearly always what followed them before. So a tile's stream is cut into
 * blocks, each named by the two branches before it and the ways they went, and each place in a block is a site, which
 * remembers the event that came there last. What changes from one visit to the next is remembered by where it comes from:
 * - a source is the latest event of some name, so its distance follows, however long the way between the two was;
 * - a mask is the one that other events had from the same maker, for they read the same register;
 * - an address is that of another access through the same base register, plus the difference of the two sites;
 * - a branch goes where it went when the branches before it went the same ways.
 * The encoder writes down only what differs; the decoder expects the same and needs nothing else. Prediction as a way to
 * compress traces: VPC3 (docs/bibliography.md).
 */
#ifndef TRACES_PREDICTOR_H
#define TRACES_PREDICTOR_H

#include <stdbool.h>
#include <stdint.h>

#include "lrbni/event.h"
#include "lrbni/op_table.h"

enum {
    TRACE_SITES = 4096,   /* places; the first is never used */
    TRACE_BLOCKS = 1024,  /* places in the table of blocks, half of which are used at most */
    TRACE_NAMES = 4096,   /* of makers: sites of different blocks behind the same branch share them */
    TRACE_FIXED = 4096,   /* makers that are one event of a name, not its latest */
    TRACE_OUTCOMES = 1024 /* places in the table of branches */
};
enum { TRACE_SOURCES = 4, TRACE_MASK_SOURCE = 2, TRACE_NO_BASE = 4 };

#define TRACE_NO_OP UINT16_MAX /* of a site where no event has been */

typedef enum trace_kind { TRACE_KIND_OP, TRACE_KIND_COMPARE, TRACE_KIND_BRANCH, TRACE_KIND_MARKER } trace_kind;

/* A place in a block, and the event that came there last; 32 bytes. */
typedef struct trace_site {
    uint16_t op, mask;
    uint16_t maker[TRACE_SOURCES + 1]; /* of each source; 0: none. The last stays 0: the base of what has no base */
    uint16_t next;                     /* the site behind it in the block; 0: none yet */
    uint16_t name;                     /* under which others find what it makes */
    uint8_t base;                      /* index of the maker that its address is relative to, or TRACE_NO_BASE */
    uint8_t kind;                      /* trace_kind */
    uint32_t aux;
    uint32_t offset; /* of its address from its base's; both lack the same constant */
    uint32_t token;  /* what a branch adds to the names of the blocks behind it */
} trace_site;

/* An event that others read. */
typedef struct trace_maker {
    uint32_t position;      /* of the event among the tile's ops */
    uint32_t mask;          /* that others had from it */
    uint32_t base;          /* address that it stands for, if ... */
    uint32_t base_position; /* ... this is `position` */
} trace_maker;

typedef struct trace_block {
    uint32_t key; /* 0: a free place */
    uint32_t site;
} trace_block;

typedef struct trace_predictor {
    uint32_t position; /* of the next op; the first of a tile has LRB_FAR, so that position 0 is long ago */
    uint32_t at;       /* site of the next event */
    uint32_t history;  /* the ways of branches, the latest in bit 0 */
    uint32_t last[2];  /* the last branch and the one before it, with their ways */
    uint32_t sites, blocks, fixed; /* that are in use */
    trace_site site[TRACE_SITES];
    trace_block block[TRACE_BLOCKS];
    trace_maker maker[TRACE_NAMES + TRACE_FIXED]; /* 0 stays as it is: nobody */
    uint16_t outcome[TRACE_OUTCOMES];
    uint16_t name_at[LRB_FAR]; /* names of the last LRB_FAR ops, by position; what lies before the tile is never read */
} trace_predictor;

/** Begin a tile. The first time on memory that is all 0. */
void trace_predictor_begin(trace_predictor *p);

/** The block behind the last two branches; made if it is new. */
uint32_t trace_predictor_block(trace_predictor *p);

/** The site behind the last one of a block. */
uint32_t trace_predictor_extend(trace_predictor *p, uint32_t site);

/**
 * The site for an event whose op is not that of site `at`: `at` itself where no event has been, else the first of a block
 * for events of this op that come there.
 */
uint32_t trace_predictor_turn(trace_predictor *p, uint32_t at, uint16_t op);

/** Source `i` of the event to come was made `distance` ops before it, not by the maker expected. */
void trace_learn_source(trace_predictor *p, trace_site *s, unsigned i, uint16_t distance);

/** Sources known, the aux was not what was expected. */
void trace_learn_aux(const trace_predictor *p, trace_site *s, uint32_t aux);

/** Sources known, the mask was not what was expected. */
void trace_learn_mask(trace_predictor *p, trace_site *s, uint16_t mask);

/** Whether a source may be so far back: in this tile. */
static inline bool trace_distance_is_good(const trace_predictor *p, uint16_t distance)
{
    return distance <= p->position - LRB_FAR;
}

static inline uint16_t trace_expected_distance(const trace_predictor *p, uint32_t maker)
{
    uint32_t distance = p->position - p->maker[maker].position;
    return (uint16_t)(distance < LRB_FAR ? distance : 0);
}

static inline uint32_t trace_expected_aux(const trace_predictor *p, const trace_site *s)
{
    const trace_maker *base = &p->maker[s->maker[s->base]];
    return base->base_position == base->position ? base->base + s->offset : s->aux;
}

static inline uint32_t trace_outcome_index(const trace_predictor *p, const trace_site *s)
{
    return (p->history ^ s->token) % TRACE_OUTCOMES;
}

static inline uint16_t trace_expected_mask(const trace_predictor *p, const trace_site *s)
{
    if (s->kind == TRACE_KIND_BRANCH)
        return p->outcome[trace_outcome_index(p, s)];
    uint32_t maker = s->maker[TRACE_MASK_SOURCE];
    return (uint16_t)(maker ? p->maker[maker].mask : s->mask);
}

/** All four, source 0 in the low 16 bits. */
static inline uint64_t trace_expected_distances(const trace_predictor *p, const trace_site *s)
{
    return (uint64_t)trace_expected_distance(p, s->maker[0]) | (uint64_t)trace_expected_distance(p, s->maker[1]) << 16 |
           (uint64_t)trace_expected_distance(p, s->maker[2]) << 32 | (uint64_t)trace_expected_distance(p, s->maker[3]) << 48;
}

/** A branch went the way that `mask` says: off to another block. */
static inline uint32_t trace_predictor_jump(trace_predictor *p, const trace_site *s, uint16_t mask)
{
    p->outcome[trace_outcome_index(p, s)] = mask;
    p->history = p->history << 1 | (mask & 1);
    p->last[1] = p->last[0];
    p->last[0] = s->token << 1 | (mask & 1);
    return trace_predictor_block(p);
}

/** Step behind an event of site `s`, which now holds it but for its mask and aux. */
static inline void trace_predictor_advance(trace_predictor *p, trace_site *s, uint16_t mask, uint32_t aux)
{
    s->aux = aux;
    if (s->maker[s->base]) {
        trace_maker *base = &p->maker[s->maker[s->base]];
        if (base->base_position != base->position) {
            base->base = aux - s->offset;
            base->base_position = base->position;
        }
    }
    if (s->kind != TRACE_KIND_MARKER) {
        p->maker[s->name].position = p->position;
        p->name_at[p->position++ % LRB_FAR] = s->name;
    }
    if (s->kind == TRACE_KIND_COMPARE) /* most often every lane that is asked says yes, or the same as the others do */
        p->maker[s->name].mask = mask;
    if (s->kind == TRACE_KIND_BRANCH)
        p->at = trace_predictor_jump(p, s, mask);
    else
        p->at = s->next ? s->next : trace_predictor_extend(p, (uint32_t)(s - p->site));
}

#endif
