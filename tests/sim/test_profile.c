/* Profiles: what the models charge to phases, ops and lines is what they say themselves, on random tiles and machines; and it
 * changes no number of theirs. Lines are held against phases: in a stream with the two markers exchanged, each is the other. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "lrbni/base/random.h"
#include "sim/core.h"
#include "sim/issue.h"
#include "tests/sim/random_machine.h"
#include "tests/sim/random_stream.h"

enum { TILES = 6, MOST_EVENTS = 1200, ROUNDS = 60 };

typedef struct work {
    lrb_event events[TILES][MOST_EVENTS];
    uint32_t count[TILES];
    int next;
} work;

static void draw(base_random *random, work *w)
{
    for (int i = 0; i < TILES; i++) {
        w->count[i] = (uint32_t)(base_random_bits(random) % MOST_EVENTS);
        random_stream(random, w->events[i], w->count[i]);
    }
}

/* Lines become phases and phases lines. */
static void exchange(work *w)
{
    for (int i = 0; i < TILES; i++)
        for (uint32_t e = 0; e < w->count[i]; e++)
            if (w->events[i][e].op == LRB_OP_line)
                w->events[i][e].op = LRB_OP_phase;
            else if (w->events[i][e].op == LRB_OP_phase)
                w->events[i][e].op = LRB_OP_line;
}

static sim_issue_stats run_issue(const sim_machine *machine, const work *w, sim_profile *profile)
{
    sim_issue *s = NULL;
    uint64_t regions[SIM_MAX_REGIONS + 1];
    assert_int_equal(sim_issue_create(machine, &s, NULL), BASE_OK);
    sim_issue_set_profile(s, profile);
    for (int i = 0; i < TILES; i++) {
        sim_issue_begin(s);
        sim_issue_events(s, w->events[i], w->count[i]);
        sim_issue_end(s, regions);
    }
    sim_issue_stats stats = *sim_issue_get(s);
    sim_issue_destroy(&s);
    return stats;
}

static base_status next_tile(void *user, unsigned thread, const lrb_event **events, size_t *count, base_error *err)
{
    work *w = user;
    (void)thread, (void)err;
    *events = w->next < TILES ? w->events[w->next] : NULL;
    *count = w->next < TILES ? w->count[w->next++] : 0;
    return BASE_OK;
}

static sim_core_stats run_core(const sim_machine *machine, work *w, sim_profile *profile)
{
    const sim_core_feed feed = {.next = next_tile, .user = w};
    sim_core *core = NULL;
    w->next = 0;
    assert_int_equal(sim_core_create(machine, &core, NULL), BASE_OK);
    if (profile)
        sim_core_set_profile(core, profile);
    assert_int_equal(sim_core_run(core, &feed, NULL), BASE_OK);
    sim_core_stats stats = sim_core_get(core);
    sim_core_destroy(&core);
    return stats;
}

/* What the models' statistics have in common. */
typedef struct expected {
    sim_cycles cycles;
    const uint64_t *ops, *op_issues, *op_cycles, *phase, *phase_vector_ops, *phase_idle_lanes;
} expected;

static expected of_issue(const sim_issue_stats *s)
{
    expected e = {.cycles = {.issued_one = s->issued_one, .issued_pair = s->issued_pair, .gap = s->gap, .blocked = s->blocked,
                             .store_forward = s->store_forward},
                  .ops = s->ops, .op_issues = s->op_issues, .op_cycles = s->op_cycles, .phase = s->phase,
                  .phase_vector_ops = s->phase_vector_ops, .phase_idle_lanes = s->phase_idle_lanes};
    memcpy(e.cycles.operand, s->operand, sizeof e.cycles.operand);
    memcpy(e.cycles.busy, s->busy, sizeof e.cycles.busy);
    return e;
}

static expected of_core(const sim_core_stats *s)
{
    return (expected){.cycles = s->core, .ops = s->ops, .op_issues = s->op_issues, .op_cycles = s->op_cycles, .phase = s->phase,
                      .phase_vector_ops = s->phase_vector_ops, .phase_idle_lanes = s->phase_idle_lanes};
}

static void check_phases_and_ops(const sim_profile *p, const expected *e)
{
    sim_place phases = {0}, ops = {0};
    for (unsigned phase = 0; phase < SIM_MAX_PHASES; phase++) {
        sim_place place = sim_profile_phase(p, phase);
        assert_int_equal(sim_cycles_sum(&place.cycles), e->phase[phase]);
        assert_int_equal(place.vector_ops, e->phase_vector_ops[phase]);
        assert_int_equal(place.idle_lanes, e->phase_idle_lanes[phase]);
        sim_place_add(&phases, &place);
    }
    for (int id = 0; id < LRB_OP_COUNT; id++) {
        sim_place place = sim_profile_op(p, (lrb_op_id)id);
        bool marker = lrb_op_kind_of((lrb_op_id)id) == LRB_KIND_MARKER;
        assert_int_equal(place.ops, marker ? 0 : e->ops[id]);
        assert_int_equal(place.cycles.issued_one + place.cycles.issued_pair, e->op_issues[id]);
        assert_int_equal(sim_cycles_sum(&place.cycles), e->op_cycles[id]);
        sim_place_add(&ops, &place);
    }
    assert_memory_equal(&phases.cycles, &e->cycles, sizeof e->cycles);
    assert_memory_equal(&ops.cycles, &e->cycles, sizeof e->cycles);
}

/* The lines of a profile as phases: 15 and beyond in one. Streams begin in line 0, as in phase 0. */
static void check_lines(const sim_profile *p, const expected *exchanged)
{
    sim_place *lines, phases[SIM_MAX_PHASES] = {{0}};
    size_t count;
    assert_int_equal(sim_profile_lines(p, &lines, &count, NULL), BASE_OK);
    for (size_t i = 0; i < count; i++) {
        assert_true(i == 0 || lines[i - 1].site < lines[i].site);
        sim_place_add(&phases[lines[i].site < SIM_MAX_PHASES ? lines[i].site : SIM_MAX_PHASES - 1], &lines[i]);
    }
    for (int i = 0; i < SIM_MAX_PHASES; i++) {
        assert_int_equal(sim_cycles_sum(&phases[i].cycles), exchanged->phase[i]);
        assert_int_equal(phases[i].vector_ops, exchanged->phase_vector_ops[i]);
        assert_int_equal(phases[i].idle_lanes, exchanged->phase_idle_lanes[i]);
    }
    free(lines);
}

static sim_profile *empty(void)
{
    sim_profile *p = NULL;
    assert_int_equal(sim_profile_create(&p, NULL), BASE_OK);
    return p;
}

static void issue__random_machines__profile_is_the_statistics(void **state)
{
    base_random random = {.state = 81};
    work *w = malloc(sizeof *w);
    (void)state;
    assert_non_null(w);
    for (int round = 0; round < ROUNDS; round++) {
        sim_machine *machine = NULL;
        sim_profile *p = empty();
        assert_int_equal(random_machine(&random, &machine, NULL), BASE_OK);
        draw(&random, w);
        sim_issue_stats plain = run_issue(machine, w, NULL), profiled = run_issue(machine, w, p);
        assert_memory_equal(&plain, &profiled, sizeof plain);
        expected e = of_issue(&plain);
        check_phases_and_ops(p, &e);
        exchange(w);
        sim_issue_stats other = run_issue(machine, w, NULL);
        expected exchanged = of_issue(&other);
        check_lines(p, &exchanged);
        sim_profile_destroy(&p);
        sim_machine_destroy(&machine);
    }
    free(w);
}

static void core__random_machines__profile_is_the_statistics(void **state)
{
    base_random random = {.state = 82};
    work *w = malloc(sizeof *w);
    (void)state;
    assert_non_null(w);
    for (int round = 0; round < ROUNDS; round++) {
        sim_machine *machine = NULL;
        sim_profile *p = empty();
        assert_int_equal(random_core_machine(&random, &machine, NULL), BASE_OK);
        draw(&random, w);
        sim_core_stats plain = run_core(machine, w, NULL), profiled = run_core(machine, w, p);
        assert_memory_equal(&plain, &profiled, sizeof plain);
        expected e = of_core(&plain);
        check_phases_and_ops(p, &e);
        exchange(w);
        sim_core_stats other = run_core(machine, w, NULL);
        expected exchanged = of_core(&other);
        check_lines(p, &exchanged);
        sim_profile_destroy(&p);
        sim_machine_destroy(&machine);
    }
    free(w);
}

/* More lines than the table has room for at first; profiles of parts add up to that of the whole. */
static void lines__many__kept_and_added_up(void **state)
{
    enum { LINES = 3000 };
    static lrb_event events[2 * LINES];
    sim_machine *machine = NULL;
    sim_profile *whole = empty(), *sum = empty();
    sim_place *lines, *summed;
    size_t count, summed_count;
    uint64_t cycles = 0;
    work *w = calloc(1, sizeof *w);
    (void)state;
    assert_non_null(w);
    assert_int_equal(sim_machine_load("larrabee", &machine, NULL), BASE_OK);
    for (uint32_t i = 0; i < LINES; i++) {
        events[2 * i] = (lrb_event){.op = LRB_OP_line, .aux = (i * 7919 % LINES) << 13};
        events[2 * i + 1] = (lrb_event){.op = LRB_OP_add_ps, .mask = 0xffff, .src = {1}};
    }
    for (int part = 0; part < 5; part++) { /* 1200 events each */
        w->count[0] = MOST_EVENTS;
        memcpy(w->events[0], events + part * MOST_EVENTS, sizeof w->events[0]);
        sim_profile *p = empty();
        cycles += run_issue(machine, w, p).cycles;
        run_issue(machine, w, whole);
        assert_int_equal(sim_profile_add(sum, p, NULL), BASE_OK);
        sim_profile_destroy(&p);
    }
    assert_int_equal(sim_profile_lines(whole, &lines, &count, NULL), BASE_OK);
    assert_int_equal(sim_profile_lines(sum, &summed, &summed_count, NULL), BASE_OK);
    assert_int_equal(count, LINES);
    assert_int_equal(summed_count, LINES);
    assert_memory_equal(lines, summed, count * sizeof *lines);
    for (size_t i = 0; i < count; i++) {
        assert_int_equal(lines[i].ops, 1);
        cycles -= sim_cycles_sum(&lines[i].cycles);
    }
    assert_int_equal(cycles, 0);
    free(lines), free(summed), free(w);
    sim_profile_destroy(&whole);
    sim_profile_destroy(&sum);
    sim_machine_destroy(&machine);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(issue__random_machines__profile_is_the_statistics),
        cmocka_unit_test(core__random_machines__profile_is_the_statistics),
        cmocka_unit_test(lines__many__kept_and_added_up),
    };
    return cmocka_run_group_tests_name("profile", tests, NULL, NULL);
}
