/* Spills as events: a stream worked out by hand, and random ones, which must fit the registers afterwards. */
#include "tests/sim/core_timeline.h"

#include "lrbni/base/random.h"
#include "lrbni/memory.h"
#include "sim/spill.h"
#include "tests/sim/random_stream.h"

/* A tile as it is with spills; the caller frees the events. */
typedef struct spilled_tile {
    lrb_event *events;
    size_t count, spills;
    sim_spill first[600]; /* of the spills */
} spilled_tile;

static spilled_tile spill(const unsigned registers[SIM_FILES], const lrb_event *events, uint32_t count)
{
    sim_registers *r = NULL;
    spilled_tile tile = {0};
    assert_int_equal(sim_registers_create(registers, &r, NULL), BASE_OK);
    sim_registers_events(r, events, count);
    assert_int_equal(sim_registers_end(r, NULL), BASE_OK);
    const sim_spill *spills = sim_registers_spills(r, &tile.spills);
    assert_int_equal(sim_spill_events(events, count, spills, tile.spills, &tile.events, &tile.count, NULL), BASE_OK);
    for (size_t i = 0; i < tile.spills && i < 600; i++)
        tile.first[i] = spills[i];
    sim_registers_destroy(&r);
    return tile;
}

static lrb_event op(lrb_op_id id, unsigned s0, unsigned s1)
{
    return (lrb_event){.op = (uint16_t)id, .mask = 0xffff, .src = {(uint16_t)s0, (uint16_t)s1}};
}

/* So many values are made, and read one by one in the order of their making. */
static uint32_t make_and_read(lrb_event *events, lrb_op_id make, lrb_op_id read, unsigned values)
{
    for (unsigned i = 0; i < values; i++) {
        events[i] = op(make, 0, 0);
        events[values + i] = op(read, values, values);
    }
    return 2 * values;
}

static void check_op(const lrb_event *e, lrb_op_id id, unsigned s0, unsigned s3)
{
    assert_int_equal(e->op, id);
    assert_int_equal(e->src[0], s0);
    assert_int_equal(e->src[3], s3);
}

enum { VECTORS = SIM_VECTOR_REGISTERS + 1, MASKS = SIM_MASK_REGISTERS + 1 };

static void spill__33_vectors__the_one_read_last_is_stored_and_comes_back(void **state)
{
    lrb_event events[2 * VECTORS];
    (void)state;
    spilled_tile tile = spill(sim_file_registers, events, make_and_read(events, LRB_OP_xor_pi, LRB_OP_mul_ps, VECTORS));
    assert_int_equal(tile.spills, 2);
    assert_int_equal(tile.count, 2 * VECTORS + 2);
    check_op(&tile.events[32], LRB_OP_store_ps, 0, 1); /* the 32nd one, just made */
    check_op(&tile.events[33], LRB_OP_xor_pi, 0, 0);
    for (unsigned i = 34; i < 65; i++)
        check_op(&tile.events[i], LRB_OP_mul_ps, 34, 0);
    check_op(&tile.events[65], LRB_OP_load_ps, 0, 0);
    check_op(&tile.events[66], LRB_OP_mul_ps, 1, 0);
    check_op(&tile.events[67], LRB_OP_mul_ps, 34, 0);
    assert_int_equal(tile.events[65].aux, tile.events[32].aux);
    assert_int_equal(tile.events[32].aux % 64, 0);
    assert_in_range(tile.events[32].aux, LRB_SCRATCH_ADDRESS, LRB_SCRATCH_ADDRESS + LRB_SCRATCH_BYTES - 64);
    free(tile.events);
}

static void cycles__33_vectors__as_worked_out_by_hand(void **state)
{
    const char *const one_thread[] = {"threads=1", NULL};
    lrb_event events[2 * VECTORS];
    (void)state;
    sim_machine *machine = machine_of("larrabee", one_thread);
    const uint32_t count = make_and_read(events, LRB_OP_xor_pi, LRB_OP_mul_ps, VECTORS);
    spilled_tile tile = spill(sim_file_registers, events, count);
    assert_int_equal(run_tiles(machine, events, count, 1).cycles, 66);
    /* 32 makings; the store reads as a shuffle does, 6 cycles behind the last; then one making and 31 readings. */
    const uint64_t store = 32 + 6, readings = store + 1 + 31;
    assert_int_equal(run_tiles(machine, tile.events, 65, 1).cycles, readings);
    assert_int_equal(run_tiles(machine, tile.events, 66, 1).cycles, readings); /* the reload beside the last of them, in V */
    /* The line that the store missed is still on its way; 4 cycles from a load to its use, and the reading behind that. */
    const uint64_t arrival = store + machine->memory.latency - machine->l1.latency;
    assert_int_equal(run_tiles(machine, tile.events, 67, 1).cycles, arrival + 4);
    assert_int_equal(run_tiles(machine, tile.events, 68, 1).cycles, arrival + 5);
    free(tile.events);
    sim_machine_destroy(&machine);
}

static void spill__9_masks__through_a_general_register(void **state)
{
    lrb_event events[2 * MASKS];
    (void)state;
    spilled_tile tile = spill(sim_file_registers, events, make_and_read(events, LRB_OP_cmplt_ps, LRB_OP_kortest, MASKS));
    assert_int_equal(tile.spills, 2);
    assert_int_equal(tile.count, 2 * MASKS + 4);
    check_op(&tile.events[8], LRB_OP_kmov_rk, 1, 0);
    check_op(&tile.events[9], LRB_OP_store16, 0, 1);
    check_op(&tile.events[10], LRB_OP_cmplt_ps, 0, 0);
    check_op(&tile.events[11], LRB_OP_kortest, 11, 0);
    check_op(&tile.events[18], LRB_OP_load16, 0, 0);
    check_op(&tile.events[19], LRB_OP_kmov_kr, 1, 0);
    check_op(&tile.events[20], LRB_OP_kortest, 1, 0);
    check_op(&tile.events[21], LRB_OP_kortest, 11, 0);
    assert_int_equal(tile.events[18].aux, tile.events[9].aux);
    free(tile.events);
}

static void spill__too_many_at_once__an_error(void **state)
{
    enum { VALUES = SIM_SPILL_SLOTS + VECTORS };
    static lrb_event events[2 * VALUES];
    const uint32_t count = make_and_read(events, LRB_OP_xor_pi, LRB_OP_mul_ps, VALUES);
    sim_registers *r = NULL;
    lrb_event *out = NULL;
    size_t spill_count = 0, out_count = 0;
    base_error err = {0};
    (void)state;
    assert_int_equal(sim_registers_create(sim_file_registers, &r, NULL), BASE_OK);
    sim_registers_events(r, events, count);
    assert_int_equal(sim_registers_end(r, NULL), BASE_OK);
    const sim_spill *spills = sim_registers_spills(r, &spill_count);
    assert_int_equal(sim_spill_events(events, count, spills, spill_count, &out, &out_count, &err), BASE_ERR_USAGE);
    assert_null(out);
    assert_string_equal(err.what, "registers");
    sim_registers_destroy(&r);
}

static sim_registers_stats analyse(const unsigned registers[SIM_FILES], const lrb_event *events, uint32_t count)
{
    sim_registers *r = NULL;
    assert_int_equal(sim_registers_create(registers, &r, NULL), BASE_OK);
    sim_registers_events(r, events, count);
    assert_int_equal(sim_registers_end(r, NULL), BASE_OK);
    sim_registers_stats stats = *sim_registers_get(r);
    sim_registers_destroy(&r);
    return stats;
}

enum { MANY = 2000 };

/* What the results of ops mean, as numbers of ops of the tile, and what lies in memory. */
typedef struct meanings {
    uint32_t of[MANY], memory[LRB_SCRATCH_BYTES];
} meanings;

/* A spill stores the value that it names, or brings it back, from the place where that was stored. Gives its events. */
static size_t check_spill(meanings *m, const sim_spill *s, const lrb_event *events, size_t at)
{
    const bool mask = s->file == SIM_FILE_MASK;
    const lrb_event *e = &events[at], *access = mask && s->store ? e + 1 : e;
    uint32_t *place = &m->memory[access->aux - LRB_SCRATCH_ADDRESS];
    assert_int_equal(e->op, s->store ? (mask ? LRB_OP_kmov_rk : LRB_OP_store_ps) : (mask ? LRB_OP_load16 : LRB_OP_load_ps));
    if (s->store)
        *place = m->of[at - (mask ? e->src[0] : e->src[3])];
    else
        m->of[mask ? at + 1 : at] = *place;
    assert_int_equal(*place, s->value);
    return mask ? 2 : 1;
}

/* The ops of the tile are all there, in their order, and read what they did; nothing else but the spills is. Without markers. */
static void check_meaning(const lrb_event *events, uint32_t count, const spilled_tile *tile)
{
    static meanings m;
    const sim_spill *s = tile->first;
    size_t at = 0;
    assert_in_range(tile->count, count, MANY);
    assert_in_range(tile->spills, 0, 600);
    for (uint32_t i = 0; i < count; i++) {
        for (; s < tile->first + tile->spills && s->before == i; s++)
            at += check_spill(&m, s, tile->events, at);
        const lrb_event *e = &tile->events[at];
        assert_true(e->op == events[i].op && e->mask == events[i].mask && e->aux == events[i].aux);
        for (int k = 0; k < 4; k++) {
            const unsigned distance = events[i].src[k];
            if (distance && distance <= i)
                assert_int_equal(m.of[at - e->src[k]], i - distance);
            else
                assert_int_equal(e->src[k], 0);
        }
        m.of[at++] = i;
    }
    assert_int_equal(at, tile->count);
}

/* Any ops, and near sources, so that not all values live for ever. */
static uint32_t random_ops(base_random *random, lrb_event *events, uint32_t count)
{
    uint32_t ops = 0;
    random_stream(random, events, count);
    for (uint32_t i = 0; i < count; i++) {
        if (lrb_op_table[events[i].op & LRB_EVENT_ID].shape == LRB_SHAPE_MARK)
            continue;
        events[ops] = events[i];
        for (int k = 0; k < 4; k++)
            events[ops].src[k] %= 24;
        ops++;
    }
    return ops;
}

static void spill__random_streams__fit_the_registers_and_mean_the_same(void **state)
{
    enum { EVENTS = 300, STREAMS = 200 };
    static const unsigned few[SIM_FILES] = {6, 5, 0};
    static lrb_event events[EVENTS];
    base_random random = {.state = 33};
    size_t spills = 0;
    (void)state;
    for (int i = 0; i < STREAMS; i++) {
        const uint32_t ops = random_ops(&random, events, EVENTS);
        spilled_tile tile = spill(few, events, ops);
        sim_registers_stats after = analyse(few, tile.events, (uint32_t)tile.count);
        for (int phase = 0; phase < SIM_MAX_PHASES; phase++)
            for (int file = 0; file < SIM_FILE_GENERAL; file++) {
                assert_in_range(after.pressure[phase][file].max, 0, few[file]);
                assert_int_equal(after.pressure[phase][file].stores, 0);
                assert_int_equal(after.pressure[phase][file].reloads, 0);
            }
        check_meaning(events, ops, &tile);
        spills += tile.spills;
        free(tile.events);
    }
    assert_true(spills > STREAMS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spill__33_vectors__the_one_read_last_is_stored_and_comes_back),
        cmocka_unit_test(cycles__33_vectors__as_worked_out_by_hand),
        cmocka_unit_test(spill__9_masks__through_a_general_register),
        cmocka_unit_test(spill__too_many_at_once__an_error),
        cmocka_unit_test(spill__random_streams__fit_the_registers_and_mean_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
