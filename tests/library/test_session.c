/* Sessions: addresses, pieces of work, models, totals. Compiled at LRB_RECORD; tests/library/counted.c is the same kernel at
 * LRB_COUNT. */
#include <pthread.h>
#include <setjmp.h>
#include <stdalign.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <jansson.h>

#include "lanetrace/session.h"
#include "sim/issue.h"
#include "tests/library/saxpy.h"

enum { N = 256 };

static alignas(64) float x[N], y[N], expected[N];

static void fill(void)
{
    for (int i = 0; i < N; i++) {
        x[i] = (float)i;
        y[i] = 0.5f * (float)i;
        expected[i] = 2.0f * x[i] + y[i];
    }
}

static lanetrace_session *open_session(const char *model)
{
    lanetrace_session *s;
    base_error err;
    assert_int_equal(lanetrace_open(&(lanetrace_options){.name = "saxpy", .model = model}, &s, &err), BASE_OK);
    return s;
}

static void run_saxpy(lanetrace_session *s, void (*saxpy)(lrb_ctx *, lrb_segment, lrb_segment, float, int), lrb_segment xs, lrb_segment ys)
{
    lrb_ctx *c;
    base_error err;
    assert_int_equal(lanetrace_begin(s, &c, &err), BASE_OK);
    assert_ptr_equal(c, lanetrace_ctx());
    saxpy(c, xs, ys, 2.0f, N);
    assert_int_equal(lanetrace_end(s, &err), BASE_OK);
    assert_null(lanetrace_ctx());
}

static lanetrace_session *mapped_session(const char *model, lrb_segment *xs, lrb_segment *ys)
{
    lanetrace_session *s = open_session(model);
    assert_int_equal(lanetrace_map(s, "x", x, sizeof x, xs, NULL), BASE_OK);
    assert_int_equal(lanetrace_map(s, "y", y, sizeof y, ys, NULL), BASE_OK);
    fill();
    return s;
}

static void options__wrong__named(void **state)
{
    (void)state;
    static const char *const bad[] = {"vector_alu.speed=1"}, *const names[17] = {"a"};
    const struct {
        lanetrace_options options;
        const char *what;
    } cases[] = {
        {{.machine = "pentium"}, "pentium"},
        {{.model = "guess"}, "model"},
        {{.set = bad, .sets = 1}, "speed"},
        {{.phases = names, .phase_count = 17}, "phases"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        lanetrace_session *s;
        base_error err;
        assert_int_equal(lanetrace_open(&cases[i].options, &s, &err), BASE_ERR_USAGE);
        assert_null(s);
        assert_true(strstr(err.what, cases[i].what) || strstr(err.why, cases[i].what));
    }
}

static void map__arrays__pages_in_order_whatever_the_host_address(void **state)
{
    (void)state;
    lanetrace_session *s = open_session(NULL);
    lrb_segment a, b, c;
    char *memory = malloc(9000);
    assert_int_equal(lanetrace_map(s, "a", memory + 4003, 4997, &a, NULL), BASE_OK);
    assert_int_equal(lanetrace_map(s, "b", memory + 1, 100, &b, NULL), BASE_OK);
    assert_int_equal(a.address, 4096);
    assert_int_equal(b.address, 3 * 4096);
    base_error err;
    assert_int_equal(lanetrace_map(s, "c", memory + 50, 1, &c, &err), BASE_ERR_USAGE);
    assert_string_equal(err.what, "c");
    assert_int_equal(lanetrace_map(s, "c", memory + 4000, 4, &c, &err), BASE_ERR_USAGE);
    assert_int_equal(lanetrace_map(s, "c", memory + 4000, 3, &c, &err), BASE_OK);
    lanetrace_unmap(s, memory + 1);
    lanetrace_unmap(s, memory + 2);
    assert_int_equal(lanetrace_map(s, "c", memory + 50, 1, &c, &err), BASE_OK);
    assert_int_equal(lanetrace_map(s, "huge", memory + 9000, (size_t)1 << 31, &c, &err), BASE_ERR_INPUT);
    lanetrace_close(&s);
    assert_null(s);
    free(memory);
}

static void address__mapped_and_not__by_array_and_by_first_touch(void **state)
{
    (void)state;
    lrb_segment xs, ys;
    lanetrace_session *s = mapped_session(NULL, &xs, &ys);
    enum { LINES = 3000 };
    char *memory = aligned_alloc(64, 64 * LINES);
    for (int piece = 0; piece < 2; piece++) {
        assert_int_equal(lanetrace_begin(s, NULL, NULL), BASE_OK);
        assert_int_equal(lanetrace_address(&y[3]), ys.address + 12);
        for (int i = 0; i < LINES; i++) /* in an order of its own */
            assert_int_equal(lanetrace_address(memory + 64 * (7 * i % LINES) + i % 64), 0x80000000u + 64u * (uint32_t)i + (uint32_t)i % 64);
        for (int i = 0; i < LINES; i++)
            assert_int_equal(lanetrace_address(memory + 64 * (7 * i % LINES)), 0x80000000u + 64u * (uint32_t)i);
        assert_int_equal(lanetrace_end(s, NULL), BASE_OK);
    }
    free(memory);
    lanetrace_close(&s);
}

static void piece__out_of_order__refused(void **state)
{
    (void)state;
    lanetrace_session *s = open_session(NULL), *other = open_session(NULL);
    base_error err;
    assert_int_equal(lanetrace_end(s, &err), BASE_ERR_USAGE);
    assert_int_equal(lanetrace_begin(s, NULL, &err), BASE_OK);
    assert_int_equal(lanetrace_begin(other, NULL, &err), BASE_ERR_USAGE);
    assert_int_equal(lanetrace_end(other, &err), BASE_ERR_USAGE);
    assert_int_equal(lanetrace_end(s, &err), BASE_OK);
    lanetrace_close(&s);
    lanetrace_close(&other);
}

static void count__kernel_at_either_level__same_totals(void **state)
{
    (void)state;
    lrb_segment xs, ys;
    uint64_t cycles[2], ops[2];
    for (int i = 0; i < 2; i++) {
        lanetrace_session *s = mapped_session("count", &xs, &ys);
        run_saxpy(s, i ? saxpy_recorded : saxpy_counted, xs, ys);
        assert_memory_equal(y, expected, sizeof y);
        cycles[i] = lanetrace_cycles(s);
        ops[i] = lanetrace_ops(s);
        assert_int_equal(lanetrace_op_count(s, "madd213_ps"), N / 16);
        assert_int_equal(lanetrace_op_count(s, "store_ps"), N / 16);
        assert_int_equal(lanetrace_op_count(s, "no_such_op"), 0);
        lanetrace_close(&s);
    }
    assert_int_equal(cycles[0], cycles[1]);
    assert_int_equal(ops[0], ops[1]);
    assert_int_equal(ops[0], 2 + N / 16 * 7);
}

static void issue__kernel_that_counts__refused(void **state)
{
    (void)state;
    lrb_segment xs, ys;
    base_error err;
    lanetrace_session *s = mapped_session("issue", &xs, &ys);
    lrb_ctx *c;
    assert_int_equal(lanetrace_begin(s, &c, &err), BASE_OK);
    saxpy_counted(c, xs, ys, 2.0f, N);
    assert_int_equal(lanetrace_end(s, &err), BASE_ERR_USAGE);
    assert_non_null(strstr(err.why, "LRB_LEVEL=2"));
    lanetrace_close(&s);
}

/* The model alone, without a session. */
static uint64_t cycles_alone(int pieces, lrb_segment xs, lrb_segment ys)
{
    sim_machine *machine;
    sim_issue *issue;
    lrb_ctx *c;
    uint64_t regions[SIM_MAX_REGIONS + 1];
    assert_int_equal(sim_machine_load("larrabee", &machine, NULL), BASE_OK);
    assert_int_equal(sim_issue_create(machine, &issue, NULL), BASE_OK);
    assert_int_equal(lrb_ctx_create(sim_issue_events, issue, &c, NULL), BASE_OK);
    for (int i = 0; i < pieces; i++) {
        sim_issue_begin(issue);
        saxpy_recorded(c, xs, ys, 2.0f, N);
        lrb_ctx_end(c);
        sim_issue_end(issue, regions);
    }
    uint64_t cycles = sim_issue_get(issue)->cycles;
    lrb_ctx_destroy(&c);
    sim_issue_destroy(&issue);
    sim_machine_destroy(&machine);
    return cycles;
}

static void issue__pieces__cycles_of_the_model(void **state)
{
    (void)state;
    lrb_segment xs, ys;
    lanetrace_session *s = mapped_session("issue", &xs, &ys);
    for (int i = 0; i < 3; i++)
        run_saxpy(s, saxpy_recorded, xs, ys);
    assert_int_equal(lanetrace_cycles(s), cycles_alone(3, xs, ys));
    lanetrace_close(&s);
}

typedef struct thread_work {
    lanetrace_session *s;
    lrb_segment xs, ys;
} thread_work;

static void *run_pieces(void *work)
{
    thread_work *w = work;
    lrb_ctx *c;
    for (int i = 0; i < 50; i++) {
        if (lanetrace_begin(w->s, &c, NULL) != BASE_OK)
            return w;
        saxpy_recorded(c, w->xs, w->ys, 2.0f, N);
        if (lanetrace_end(w->s, NULL) != BASE_OK)
            return w;
    }
    return NULL;
}

static void issue__pieces_on_four_threads__same_totals(void **state)
{
    (void)state;
    static alignas(64) float out[4][N];
    pthread_t threads[4];
    thread_work work[4];
    lrb_segment xs, ys;
    lanetrace_session *s = mapped_session("issue", &xs, &ys);
    for (int i = 0; i < 4; i++) {
        work[i] = (thread_work){.s = s, .xs = xs};
        assert_int_equal(lanetrace_map(s, "out", out[i], sizeof out[i], &work[i].ys, NULL), BASE_OK);
    }
    for (int i = 0; i < 4; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, run_pieces, &work[i]), 0);
    for (int i = 0; i < 4; i++) {
        void *failed;
        pthread_join(threads[i], &failed);
        assert_null(failed);
    }
    assert_int_equal(lanetrace_cycles(s), cycles_alone(200, xs, ys));
    lanetrace_close(&s);
}

static json_t *json_of(const lanetrace_session *s)
{
    char *text = NULL;
    size_t size;
    FILE *stream = open_memstream(&text, &size);
    assert_int_equal(lanetrace_write_json(s, stream, NULL), BASE_OK);
    fclose(stream);
    json_t *json = json_loads(text, 0, NULL);
    assert_non_null(json);
    free(text);
    return json;
}

static void reports__json_and_table__what_the_totals_say(void **state)
{
    (void)state;
    lrb_segment xs, ys;
    lanetrace_session *s = mapped_session("issue", &xs, &ys);
    run_saxpy(s, saxpy_recorded, xs, ys);
    json_t *json = json_of(s), *value;
    json_t *cycles = json_object_get(json, "cycles");
    json_int_t total = json_integer_value(json_object_get(cycles, "total")), by_stall = 0, by_phase = 0;
    const char *key;
    assert_string_equal(json_string_value(json_object_get(json, "schema")), "lanetrace-session-1");
    assert_string_equal(json_string_value(json_object_get(json, "name")), "saxpy");
    assert_int_equal(total, lanetrace_cycles(s));
    json_object_foreach(json_object_get(cycles, "by_stall"), key, value)
        by_stall += json_integer_value(value);
    json_object_foreach(json_object_get(cycles, "by_phase"), key, value)
        by_phase += json_integer_value(value);
    assert_int_equal(by_stall, total);
    assert_int_equal(by_phase, total);
    json_t *by_op = json_object_get(json_object_get(json, "ops"), "by_op");
    assert_int_equal(json_integer_value(json_object_get(by_op, "vmadd213ps")), N / 16);
    json_decref(json);
    char *text = NULL;
    size_t size;
    FILE *stream = open_memstream(&text, &size);
    assert_int_equal(lanetrace_print(s, stream, NULL), BASE_OK);
    fclose(stream);
    assert_non_null(strstr(text, "saxpy, model issue, machine larrabee"));
    assert_non_null(strstr(text, "vmadd213ps"));
    free(text);
    lanetrace_close(&s);
}

static void overrides_and_phases__given__used(void **state)
{
    (void)state;
    static const char *const set[] = {"issue_gap=2"}, *const phases[] = {"first"};
    lrb_segment xs, ys;
    lanetrace_session *slow;
    lanetrace_options options = {.set = set, .sets = 1, .phases = phases, .phase_count = 1};
    lanetrace_session *plain = mapped_session("issue", &xs, &ys);
    assert_int_equal(lanetrace_open(&options, &slow, NULL), BASE_OK);
    run_saxpy(plain, saxpy_recorded, xs, ys);
    run_saxpy(slow, saxpy_recorded, xs, ys);
    assert_true(lanetrace_cycles(slow) > lanetrace_cycles(plain));
    json_t *json = json_of(slow);
    assert_int_equal(json_integer_value(json_object_get(json_object_get(json_object_get(json, "cycles"), "by_phase"), "first")),
                     lanetrace_cycles(slow));
    json_decref(json);
    lanetrace_close(&slow);
    lanetrace_close(&plain);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(options__wrong__named),
        cmocka_unit_test(map__arrays__pages_in_order_whatever_the_host_address),
        cmocka_unit_test(address__mapped_and_not__by_array_and_by_first_touch),
        cmocka_unit_test(piece__out_of_order__refused),
        cmocka_unit_test(count__kernel_at_either_level__same_totals),
        cmocka_unit_test(issue__kernel_that_counts__refused),
        cmocka_unit_test(issue__pieces__cycles_of_the_model),
        cmocka_unit_test(issue__pieces_on_four_threads__same_totals),
        cmocka_unit_test(reports__json_and_table__what_the_totals_say),
        cmocka_unit_test(overrides_and_phases__given__used),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
