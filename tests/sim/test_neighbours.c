/* Machines one step away: one field differs, by the step that its kind has, and each passes its checks. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "sim/neighbours.h"

static const uint32_t all_classes = (UINT32_C(1) << LRB_CLASS_COUNT) - 1;

static sim_machine *load(const char *name)
{
    sim_machine *machine = NULL;
    assert_int_equal(sim_machine_load(name, &machine, NULL), BASE_OK);
    return machine;
}

static size_t fields_that_differ(const sim_machine *a, const sim_machine *b)
{
    size_t count = 0;
    for (size_t number = 0; number < SIM_FIELDS; number++) {
        sim_field_view x, y;
        if (sim_machine_field(a, number, &x) && sim_machine_field(b, number, &y))
            count += strcmp(x.value, y.value) != 0 && (x.given || y.given);
    }
    return count;
}

static bool has(const sim_machine *machine, const sim_neighbours *n, const char *section, const char *key, const char *value)
{
    for (size_t i = 0; i < n->count; i++) {
        sim_field_view view;
        sim_machine_field(machine, n->list[i].field, &view);
        if (strcmp(view.section, section) == 0 && strcmp(view.key, key) == 0 && strcmp(n->list[i].value, value) == 0)
            return true;
    }
    return false;
}

static void neighbours__every_machine__one_field_and_good(void **state)
{
    size_t count;
    const char *const *names = sim_machine_names(&count);
    (void)state;
    for (size_t i = 0; i < count; i++) {
        sim_machine *machine = load(names[i]);
        sim_neighbours n;
        assert_int_equal(sim_neighbours_create(machine, "core", all_classes, &n, NULL), BASE_OK);
        assert_true(n.count > 100);
        for (size_t k = 0; k < n.count; k++) {
            sim_field_view view;
            assert_true(sim_machine_field(n.list[k].machine, n.list[k].field, &view));
            assert_string_equal(view.value, n.list[k].value);
            assert_non_null(strstr(view.used_by, "core"));
            assert_int_equal(sim_machine_check(n.list[k].machine, NULL), BASE_OK);
            assert_int_equal(fields_that_differ(machine, n.list[k].machine), 1);
            assert_true(sim_machine_hash(n.list[k].machine) != sim_machine_hash(machine));
        }
        sim_neighbours_destroy(&n);
        sim_machine_destroy(&machine);
    }
}

static void steps__each_kind__as_the_header_says(void **state)
{
    sim_machine *machine = load("larrabee");
    sim_neighbours n;
    (void)state;
    assert_int_equal(sim_machine_set(machine, "vector_alu.latency=4", NULL), BASE_OK);
    assert_int_equal(sim_machine_set(machine, "vector_alu.pipes=U", NULL), BASE_OK);
    assert_int_equal(sim_machine_set(machine, "vector_alu.throughput=1", NULL), BASE_OK);
    assert_int_equal(sim_machine_set(machine, "memory.latency=304", NULL), BASE_OK);
    assert_int_equal(sim_machine_set(machine, "l1.size_bytes=32768", NULL), BASE_OK);
    assert_int_equal(sim_machine_set(machine, "threads=1", NULL), BASE_OK);
    assert_int_equal(sim_neighbours_create(machine, "core", all_classes, &n, NULL), BASE_OK);
    assert_true(has(machine, &n, "vector_alu", "latency", "3") && has(machine, &n, "vector_alu", "latency", "5"));
    assert_true(has(machine, &n, "vector_alu", "pipes", "V") && has(machine, &n, "vector_alu", "pipes", "UV"));
    assert_true(has(machine, &n, "vector_alu", "throughput", "1.5"));
    assert_false(has(machine, &n, "vector_alu", "throughput", "0.5")); /* needs both pipes: not alone */
    assert_true(has(machine, &n, "memory", "latency", "274") && has(machine, &n, "memory", "latency", "334"));
    assert_true(has(machine, &n, "l1", "size_bytes", "16384") && has(machine, &n, "l1", "size_bytes", "65536"));
    assert_true(has(machine, &n, "machine", "threads", "2"));
    assert_false(has(machine, &n, "machine", "threads", "0"));
    assert_false(has(machine, &n, "machine", "clock_hz", "1100000000")); /* no model reads it */
    bool line_stuck = false; /* both levels have the same */
    for (size_t i = 0; i < n.stuck_count; i++)
        line_stuck |= n.stuck[i] == SIM_FIELD_l1_line_bytes;
    assert_true(line_stuck);
    sim_neighbours_destroy(&n);
    sim_machine_destroy(&machine);
}

static void selection__model_and_classes__theirs_only(void **state)
{
    sim_machine *machine = load("knc");
    sim_neighbours n;
    (void)state;
    assert_int_equal(sim_neighbours_create(machine, "issue", UINT32_C(1) << LRB_CLASS_vector_alu, &n, NULL), BASE_OK);
    assert_true(n.count > 4);
    for (size_t i = 0; i < n.count; i++) {
        sim_field_view view;
        sim_machine_field(machine, n.list[i].field, &view);
        assert_true(strcmp(view.section, "vector_alu") == 0 || n.list[i].field < SIM_PLAIN_FIELDS);
        assert_non_null(strstr(view.used_by, "issue"));
    }
    assert_false(has(machine, &n, "memory", "latency", "270"));
    sim_neighbours_destroy(&n);
    assert_null(n.list);
    sim_machine_destroy(&machine);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(neighbours__every_machine__one_field_and_good),
        cmocka_unit_test(steps__each_kind__as_the_header_says),
        cmocka_unit_test(selection__model_and_classes__theirs_only),
    };
    return cmocka_run_group_tests_name("neighbours", tests, NULL, NULL);
}
