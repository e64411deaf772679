#include "sim/spill.h"

#include <stdlib.h>

#include "lrbni/memory.h"
#include "lrbni/op_table.h"

enum { SOURCES = 4, MOST_OPS = 2 /* of a spill */ };

/* Where the result of an op of the tile is. */
typedef struct copy {
    uint32_t number; /* of the op in the new stream that left it in its register */
    uint32_t last;   /* op of the tile that reads it last; 0: none */
    uint32_t slot;   /* in memory */
} copy;

typedef struct spiller {
    lrb_event *out;
    size_t count;
    uint32_t ops; /* of these events */
    copy *copies; /* by op of the tile */
    uint32_t busy[SIM_FILES][SIM_SPILL_SLOTS]; /* op of the tile that reads the slot's value last; 0: free */
} spiller;

static bool is_op(const lrb_event *e) { return lrb_op_table[e->op & LRB_EVENT_ID].shape != LRB_SHAPE_MARK; }

/* How long each value is wanted. */
static void find_last_uses(spiller *s, const lrb_event *events, size_t count)
{
    uint32_t number = 0, far[SOURCES] = {0};
    for (const lrb_event *e = events; e < events + count; e++) {
        if ((e->op & LRB_EVENT_ID) == LRB_OP_far)
            far[e->aux % SOURCES] = e->aux / SOURCES;
        if (!is_op(e))
            continue;
        for (unsigned i = 0; i < SOURCES; i++) {
            const uint32_t distance = far[i] ? far[i] : e->src[i];
            if (distance && distance <= number)
                s->copies[number - distance].last = number;
            far[i] = 0;
        }
        number++;
    }
}

static void put(spiller *s, lrb_event e)
{
    s->out[s->count++] = e;
    s->ops += is_op(&e);
}

static uint16_t distance_to(const spiller *s, uint32_t value)
{
    const uint32_t distance = s->ops - s->copies[value].number;
    return (uint16_t)(distance < LRB_FAR ? distance : 0);
}

/* The lowest slot whose value is wanted no more. */
static bool take_slot(spiller *s, const sim_spill *spill)
{
    uint32_t *busy = s->busy[spill->file], slot = 0;
    while (slot < SIM_SPILL_SLOTS && busy[slot] >= spill->before && busy[slot])
        slot++;
    if (slot == SIM_SPILL_SLOTS)
        return false;
    busy[slot] = s->copies[spill->value].last;
    s->copies[spill->value].slot = slot;
    return true;
}

/* Masks, of two bytes, lie behind the vectors. */
static uint32_t address_of(const spiller *s, const sim_spill *spill)
{
    const uint32_t end = LRB_SCRATCH_ADDRESS + LRB_SCRATCH_BYTES, slot = s->copies[spill->value].slot + 1;
    return spill->file == SIM_FILE_MASK ? end - 2 * slot : end - (2 + 64) * SIM_SPILL_SLOTS + 64 * (SIM_SPILL_SLOTS - slot);
}

static void put_store(spiller *s, const sim_spill *spill)
{
    lrb_event store = {.op = LRB_OP_store_ps, .mask = 0xffff, .aux = address_of(s, spill)};
    store.src[3] = distance_to(s, spill->value);
    if (spill->file == SIM_FILE_MASK) {
        put(s, (lrb_event){.op = LRB_OP_kmov_rk, .mask = 0xffff, .src = {store.src[3]}});
        store.op = LRB_OP_store16;
        store.src[3] = 1;
    }
    put(s, store);
}

static void put_reload(spiller *s, const sim_spill *spill)
{
    const bool is_mask = spill->file == SIM_FILE_MASK;
    put(s, (lrb_event){.op = is_mask ? LRB_OP_load16 : LRB_OP_load_ps, .mask = 0xffff, .aux = address_of(s, spill)});
    if (is_mask)
        put(s, (lrb_event){.op = LRB_OP_kmov_kr, .mask = 0xffff, .src = {1}});
    s->copies[spill->value].number = s->ops - 1;
}

/* The op of this number of the tile: its sources are now where their copies are. */
static void put_op(spiller *s, const lrb_event *e, uint32_t number)
{
    lrb_event op = *e;
    for (unsigned i = 0; i < SOURCES; i++)
        op.src[i] = e->src[i] && e->src[i] <= number ? distance_to(s, number - e->src[i]) : 0;
    s->copies[number].number = s->ops;
    put(s, op);
}

static bool put_all(spiller *s, const lrb_event *events, size_t count, const sim_spill *spills, size_t spill_count)
{
    const sim_spill *spill = spills, *const end = spills + spill_count;
    uint32_t number = 0;
    for (const lrb_event *e = events; e < events + count; e++) {
        if (!is_op(e)) {
            if ((e->op & LRB_EVENT_ID) != LRB_OP_far)
                put(s, *e);
            continue;
        }
        for (; spill < end && spill->before == number; spill++) {
            if (spill->store && !take_slot(s, spill))
                return false;
            if (spill->store)
                put_store(s, spill);
            else
                put_reload(s, spill);
        }
        put_op(s, e, number++);
    }
    return true;
}

base_status sim_spill_events(const lrb_event *events, size_t count, const sim_spill *spills, size_t spill_count, lrb_event **out,
                             size_t *out_count, base_error *err)
{
    spiller s = {.out = malloc((count + MOST_OPS * spill_count) * sizeof *s.out), .copies = calloc(count, sizeof *s.copies)};
    base_status status = BASE_OK;
    *out = NULL;
    if (!s.out || !s.copies) {
        status = base_fail(err, BASE_ERR_NOMEM, "registers", "out of memory for the spills of a tile");
    } else {
        find_last_uses(&s, events, count);
        if (!put_all(&s, events, count, spills, spill_count))
            status = base_fail(err, BASE_ERR_USAGE, "registers", "more than %d spilled values are in memory at once", SIM_SPILL_SLOTS);
    }
    free(s.copies);
    if (status != BASE_OK) {
        free(s.out);
        return status;
    }
    *out = s.out;
    *out_count = s.count;
    return BASE_OK;
}
