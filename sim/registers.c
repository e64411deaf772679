#include "sim/registers.h"

#include <stdlib.h>
#include <string.h>

enum { SOURCES = 4 };
#define NO_USE UINT32_MAX

const char *const sim_file_names[SIM_FILES] = {"vector", "mask", "general"};
const unsigned sim_file_registers[SIM_FILES] = {SIM_VECTOR_REGISTERS, SIM_MASK_REGISTERS, 0};

sim_register_file sim_file_of(lrb_op_id id)
{
    switch (lrb_shape_table[lrb_op_table[id].shape].name[0]) { /* the letter of the result (lrbni/shapes.def) */
    case 'V':
        return SIM_FILE_VECTOR;
    case 'K':
        return SIM_FILE_MASK;
    case 'R':
    case 'P':
        return SIM_FILE_GENERAL;
    default:
        return SIM_FILES;
    }
}

/* An op of the tile and the value that it makes. */
typedef struct value {
    uint32_t source[SOURCES]; /* numbers of the ops that made its sources; NO_USE: none */
    uint32_t after[SOURCES];  /* the op that reads source i next; NO_USE: none does */
    uint32_t use;             /* the op that reads the value next; NO_USE: none does any more */
    uint8_t file, phase;
    bool in_memory; /* it has been spilled */
    bool in_register;
} value;

/* The registers of a file. */
typedef struct bank {
    uint32_t held[SIM_MOST_REGISTERS]; /* values, by the number of their op */
    unsigned count;
    uint64_t live; /* values that are still read, wherever they are */
} bank;

struct sim_registers {
    value *values; /* of the tile so far */
    size_t count, capacity;
    uint8_t phase;
    bool failed; /* out of memory */
    unsigned registers[SIM_FILES];
    bank banks[SIM_FILES];
    uint32_t far[SOURCES]; /* of the next op: distance of a source that its event does not tell; 0: none */
    uint8_t file[LRB_OP_COUNT];
    sim_spill *spills; /* of the tile */
    size_t spill_count, spill_capacity;
    sim_registers_stats stats;
};

base_status sim_registers_create(const unsigned registers[SIM_FILES], sim_registers **out, base_error *err)
{
    sim_registers *r = calloc(1, sizeof *r);
    if (!r)
        return base_fail(err, BASE_ERR_NOMEM, "registers", "out of memory");
    memcpy(r->registers, registers, sizeof r->registers);
    for (int id = 0; id < LRB_OP_COUNT; id++)
        r->file[id] = (uint8_t)sim_file_of((lrb_op_id)id);
    *out = r;
    return BASE_OK;
}

void sim_registers_destroy(sim_registers **r)
{
    if (*r) {
        free((*r)->values);
        free((*r)->spills);
    }
    free(*r);
    *r = NULL;
}

static bool grow(sim_registers *r, size_t count)
{
    size_t capacity = r->capacity ? r->capacity : 1 << 14;
    while (capacity < r->count + count)
        capacity *= 2;
    if (capacity == r->capacity)
        return true;
    value *values = realloc(r->values, capacity * sizeof *values);
    if (values) {
        r->values = values;
        r->capacity = capacity;
    }
    return values;
}

static void append(sim_registers *r, const lrb_event *e)
{
    value *v = &r->values[r->count];
    *v = (value){.use = NO_USE, .file = r->file[e->op & LRB_EVENT_ID], .phase = r->phase};
    for (int i = 0; i < SOURCES; i++) {
        size_t distance = r->far[i] ? r->far[i] : e->src[i];
        v->source[i] = distance && distance <= r->count ? (uint32_t)(r->count - distance) : NO_USE;
    }
    memset(r->far, 0, sizeof r->far);
    r->count++;
}

void sim_registers_events(void *registers, const lrb_event *events, uint32_t count)
{
    sim_registers *r = registers;
    r->failed |= !grow(r, count);
    for (const lrb_event *e = events; !r->failed && e < events + count; e++) {
        unsigned id = e->op & LRB_EVENT_ID;
        if (id == LRB_OP_phase)
            r->phase = (uint8_t)(e->aux < SIM_MAX_PHASES ? e->aux : SIM_MAX_PHASES - 1);
        else if (id == LRB_OP_far)
            r->far[e->aux % SOURCES] = e->aux / SOURCES;
        else if (lrb_op_table[id].shape != LRB_SHAPE_MARK)
            append(r, e);
    }
}

/* Backwards through the tile: who reads each value first, and who next after each reading. */
static void find_uses(sim_registers *r)
{
    for (size_t i = r->count; i-- > 0;)
        for (int k = SOURCES - 1; k >= 0; k--) {
            value *v = &r->values[i];
            if (v->source[k] == NO_USE)
                continue;
            value *made = &r->values[v->source[k]];
            v->after[k] = made->use;
            made->use = (uint32_t)i;
        }
}

static bool is_source(const value *v, uint32_t number)
{
    for (int k = 0; k < SOURCES; k++)
        if (v->source[k] == number)
            return true;
    return false;
}

static void drop(sim_registers *r, bank *b, unsigned place)
{
    r->values[b->held[place]].in_register = false;
    b->held[place] = b->held[--b->count];
}

static void note_spill(sim_registers *r, const value *op, uint32_t number, bool store)
{
    if (r->spill_count == r->spill_capacity) {
        const size_t capacity = r->spill_capacity ? 2 * r->spill_capacity : 64;
        sim_spill *spills = realloc(r->spills, capacity * sizeof *spills);
        r->failed |= !spills;
        if (!spills)
            return;
        r->spills = spills;
        r->spill_capacity = capacity;
    }
    r->spills[r->spill_count++] = (sim_spill){.before = (uint32_t)(op - r->values), .value = number,
                                              .file = (sim_register_file)r->values[number].file, .store = store};
}

/* A register becomes free: of the values that are not kept for the op, the one that is read again last goes to memory. */
static void spill(sim_registers *r, const value *op, bool keep_sources, sim_register_file file)
{
    bank *b = &r->banks[file];
    unsigned victim = 0;
    uint32_t furthest = 0;
    for (unsigned i = 0; i < b->count; i++) {
        uint32_t use = r->values[b->held[i]].use;
        if (use > furthest && !(keep_sources && is_source(op, b->held[i]))) {
            furthest = use;
            victim = i;
        }
    }
    value *v = &r->values[b->held[victim]];
    if (!v->in_memory) {
        r->stats.pressure[op->phase][file].stores++;
        note_spill(r, op, b->held[victim], true);
    }
    v->in_memory = true;
    drop(r, b, victim);
}

/* Put a value into a register. */
static void hold(sim_registers *r, const value *op, bool keep_sources, uint32_t number)
{
    value *v = &r->values[number];
    bank *b = &r->banks[v->file];
    if (b->count == r->registers[v->file])
        spill(r, op, keep_sources, (sim_register_file)v->file);
    b->held[b->count++] = number;
    v->in_register = true;
}

/* Values that no op reads any more leave their registers. */
static void bury(sim_registers *r, uint32_t number)
{
    value *v = &r->values[number];
    bank *b = &r->banks[v->file];
    if (v->use != NO_USE)
        return;
    b->live--;
    for (unsigned i = 0; v->in_register && i < b->count; i++)
        if (b->held[i] == number)
            drop(r, b, i);
}

/* The op's sources come into registers, and those that it reads last leave them. */
static void read_sources(sim_registers *r, value *op)
{
    for (int k = 0; k < SOURCES; k++) {
        uint32_t number = op->source[k];
        if (number == NO_USE)
            continue;
        value *v = &r->values[number];
        if (v->file < SIM_FILES && r->registers[v->file] && !v->in_register) {
            r->stats.pressure[op->phase][v->file].reloads++;
            hold(r, op, true, number);
            note_spill(r, op, number, false);
        }
    }
    for (int k = 0; k < SOURCES; k++) {
        uint32_t number = op->source[k];
        if (number == NO_USE || r->values[number].file == SIM_FILES)
            continue;
        r->values[number].use = op->after[k];
        bury(r, number);
    }
}

static void write_result(sim_registers *r, uint32_t number)
{
    value *v = &r->values[number];
    if (v->file == SIM_FILES)
        return;
    r->banks[v->file].live++;
    if (r->registers[v->file])
        hold(r, v, false, number);
}

static void step(sim_registers *r, uint32_t number)
{
    value *op = &r->values[number];
    uint64_t before[SIM_FILES];
    for (int f = 0; f < SIM_FILES; f++)
        before[f] = r->banks[f].live;
    read_sources(r, op);
    write_result(r, number);
    for (int f = 0; f < SIM_FILES; f++) {
        sim_pressure *p = &r->stats.pressure[op->phase][f];
        uint64_t live = before[f] > r->banks[f].live ? before[f] : r->banks[f].live;
        p->live += live;
        p->max = live > p->max ? live : p->max;
    }
    r->stats.ops[op->phase]++;
    if (op->file != SIM_FILES)
        bury(r, number);
}

base_status sim_registers_end(sim_registers *r, base_error *err)
{
    memset(r->banks, 0, sizeof r->banks);
    r->spill_count = 0;
    if (!r->failed) {
        find_uses(r);
        for (size_t i = 0; i < r->count; i++)
            step(r, (uint32_t)i);
        r->stats.tiles++;
    }
    const bool failed = r->failed;
    r->count = 0;
    r->phase = 0;
    r->failed = false;
    return failed ? base_fail(err, BASE_ERR_NOMEM, "registers", "out of memory for the ops of a tile") : BASE_OK;
}

const sim_spill *sim_registers_spills(const sim_registers *r, size_t *count)
{
    *count = r->spill_count;
    return r->spills;
}

const sim_registers_stats *sim_registers_get(const sim_registers *r)
{
    return &r->stats;
}

void sim_registers_stats_add(sim_registers_stats *to, const sim_registers_stats *from)
{
    for (int phase = 0; phase < SIM_MAX_PHASES; phase++) {
        to->ops[phase] += from->ops[phase];
        for (int f = 0; f < SIM_FILES; f++) {
            sim_pressure *t = &to->pressure[phase][f];
            const sim_pressure *p = &from->pressure[phase][f];
            t->live += p->live;
            t->max = p->max > t->max ? p->max : t->max;
            t->stores += p->stores;
            t->reloads += p->reloads;
        }
    }
    to->tiles += from->tiles;
}
