/* Machines: the built-in ones are complete and sourced, overrides and the hash follow the values, and the manual names
 * every field. */
#include <unistd.h>

#include "tests/sim/machine_text.h"

static sim_machine *load(const char *name)
{
    sim_machine *machine = NULL;
    base_error err = {0};
    if (sim_machine_load(name, &machine, &err) != BASE_OK)
        fail_msg("%s: %s", err.what, err.why);
    assert_non_null(machine);
    return machine;
}

static void builtin__each_loads__named_and_checked(void **state)
{
    (void)state;
    size_t count = 0;
    const char *const *names = sim_machine_names(&count);
    assert_int_equal(count, 4);
    for (size_t i = 0; i < count; i++) {
        sim_machine *machine = load(names[i]);
        assert_string_equal(machine->name, names[i]);
        assert_true(strlen(machine->description) > 10);
        assert_int_equal(sim_machine_check(machine, NULL), BASE_OK);
        sim_machine_destroy(&machine);
        assert_null(machine);
        sim_machine_destroy(&machine);
    }
}

/* The values that the cost table of the sources gives, and where the two machines differ. */
static void builtin__cost_table__as_published(void **state)
{
    (void)state;
    sim_machine *lrb = load("larrabee"), *knc = load("knc");
    assert_int_equal(lrb->issue_gap, 1);
    assert_int_equal(knc->issue_gap, 2);
    assert_int_equal(lrb->clock_hz, 1000000000);
    assert_int_equal(knc->clock_hz, 1100000000);
    assert_int_equal(lrb->cost[LRB_CLASS_vector_load].pipes, SIM_PIPE_U | SIM_PIPE_V);
    assert_int_equal(knc->cost[LRB_CLASS_vector_load].pipes, SIM_PIPE_U);
    assert_int_equal(lrb->l2.size_bytes, 256 * 1024);
    assert_int_equal(knc->l2.size_bytes, 512 * 1024);
    assert_int_equal(lrb->cost[LRB_CLASS_vector_lookup].latency, 4);
    assert_int_equal(knc->cost[LRB_CLASS_vector_lookup].latency, 6);
    assert_int_equal(knc->cost[LRB_CLASS_vector_lookup].throughput, 4);
    for (int i = 0; i < 2; i++) {
        const sim_machine *m = i ? knc : lrb;
        const sim_class_cost *alu = &m->cost[LRB_CLASS_vector_alu];
        assert_int_equal(m->threads, 4);
        assert_int_equal(alu->pipes, SIM_PIPE_U);
        assert_int_equal(alu->latency, 4);
        assert_int_equal(alu->latency_to_shuffle, 6);
        assert_int_equal(alu->throughput, 2);
        assert_int_equal(alu->blocking, 0);
        assert_int_equal(m->cost[LRB_CLASS_vector_compare].latency, 6);
        assert_int_equal(m->cost[LRB_CLASS_scalar_alu].throughput, 1);
        assert_int_equal(m->cost[LRB_CLASS_scalar_alu].latency_to_address, 2);
        assert_int_equal(m->cost[LRB_CLASS_scalar_multiply].blocking, 10);
        assert_int_equal(m->cost[LRB_CLASS_scalar_load].latency, 3);
        assert_int_equal(m->cost[LRB_CLASS_scalar_compare].latency_to_branch, 0);
        assert_int_equal(m->cost[LRB_CLASS_mask_test].latency_to_branch, 0);
        assert_int_equal(m->cost[LRB_CLASS_branch].pipes, SIM_PIPE_V);
        assert_int_equal(m->branch.mispredict_penalty, 4);
        assert_int_equal(m->l1.size_bytes, 32 * 1024);
        assert_int_equal(m->l2.latency, 24);
        assert_int_equal(m->memory.latency, 300);
        assert_int_equal(m->memory.cycles_per_line_tenths, 144);
        assert_int_equal(m->cost[LRB_CLASS_marker].pipes, 0);
        assert_int_equal(m->cost[LRB_CLASS_marker].latency, 0);
    }
    sim_machine_destroy(&lrb);
    sim_machine_destroy(&knc);
}

/* Every number has a basis and a source that begins with a key of the manual's list of sources, or with "none". */
static void builtin__every_number__has_basis_and_known_source(void **state)
{
    (void)state;
    size_t count = 0;
    char *docs = read_whole(MACHINE_DOCS);
    const char *const *names = sim_machine_names(&count);
    for (size_t i = 0; i < count; i++) {
        sim_machine *machine = load(names[i]);
        sim_field_view view;
        for (size_t number = 0; number < SIM_FIELDS; number++) {
            char row[80];
            if (!sim_machine_field(machine, number, &view))
                continue;
            assert_true(strlen(view.value) > 0 && strlen(view.source) > 0 && strlen(view.sentence) > 20);
            assert_true(view.basis < SIM_BASIS_OVERRIDE);
            if (!view.given)
                continue;
            size_t key = strspn(view.source, "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789");
            snprintf(row, sizeof row, "| %.*s |", (int)key, view.source);
            if (strncmp(view.source, "none: ", 6) != 0 && (key == 0 || !strstr(docs, row)))
                fail_msg("%s: %s.%s: source '%s' has no key of the manual", names[i], view.section, view.key,
                         view.source);
            if (strncmp(view.source, "none", 4) == 0)
                assert_int_equal(view.basis, SIM_BASIS_ASSUMED);
        }
        sim_machine_destroy(&machine);
    }
    free(docs);
}

static void docs__every_field__is_named(void **state)
{
    (void)state;
    char *docs = read_whole(MACHINE_DOCS);
    sim_machine *machine = load("larrabee");
    sim_field_view view;
    size_t fields = 0;
    for (size_t number = 0; number < SIM_FIELDS; number++) {
        char name[140];
        if (!sim_machine_field(machine, number, &view))
            continue;
        fields++;
        if (number < SIM_PLAIN_FIELDS)
            snprintf(name, sizeof name, "| `%s.%s` | %s |", view.section, view.key, view.used_by);
        else
            snprintf(name, sizeof name, "| `%s` |", view.key);
        if (!strstr(docs, name))
            fail_msg("docs/machine-model.md has no row for %s", name);
    }
    assert_true(fields > 100);
    sim_machine_destroy(&machine);
    free(docs);
}

/* Fields exist where they mean something; elsewhere the member is the latency. */
static void field__optional_keys__only_where_they_apply(void **state)
{
    (void)state;
    sim_machine *machine = load("knc");
    sim_field_view view;
    assert_true(sim_machine_field(machine, sim_class_field(LRB_CLASS_mask_test, SIM_KEY_latency_to_branch), &view));
    assert_string_equal(view.section, "mask_test");
    assert_string_equal(view.key, "latency_to_branch");
    assert_string_equal(view.value, "0");
    assert_string_equal(view.unit, "cycles");
    assert_string_equal(sim_basis_name(view.basis), "inferred");
    assert_string_equal(view.used_by, "issue, core");
    assert_false(sim_machine_field(machine, sim_class_field(LRB_CLASS_vector_alu, SIM_KEY_latency_to_branch), &view));
    assert_false(sim_machine_field(machine, sim_class_field(LRB_CLASS_marker, SIM_KEY_latency), &view));
    assert_false(sim_machine_field(machine, SIM_FIELDS, &view));
    assert_int_equal(machine->cost[LRB_CLASS_vector_compare].latency_to_branch, 6);
    assert_int_equal(machine->cost[LRB_CLASS_vector_compare].latency_to_shuffle, 6);
    assert_true(sim_machine_field(machine, sim_class_field(LRB_CLASS_scalar_alu, SIM_KEY_throughput), &view));
    assert_string_equal(view.value, "0.5");
    assert_true(sim_machine_field(machine, SIM_FIELD_memory_cycles_per_line, &view));
    assert_string_equal(view.value, "14.4");
    sim_machine_destroy(&machine);
}

/* Without its line a latency_to_... is the latency, and says so; blocking is none. */
static void field__left_out__default_follows_latency(void **state)
{
    (void)state;
    char *text = edited("latency_to_address = 11 |", "# latency_to_address = 11 |");
    sim_machine *machine = NULL;
    sim_field_view view;
    assert_int_equal(sim_machine_parse("test.ini", text, strlen(text), &machine, NULL), BASE_OK);
    assert_int_equal(machine->cost[LRB_CLASS_scalar_multiply].latency_to_address, 10);
    size_t number = sim_class_field(LRB_CLASS_scalar_multiply, SIM_KEY_latency_to_address);
    assert_true(sim_machine_field(machine, number, &view));
    assert_string_equal(view.value, "10");
    assert_string_equal(view.source, "default: as latency");
    assert_int_equal(view.basis, SIM_BASIS_INFERRED);
    assert_false(view.given);
    assert_int_equal(sim_machine_set(machine, "scalar_multiply.latency=12", NULL), BASE_OK);
    assert_int_equal(machine->cost[LRB_CLASS_scalar_multiply].latency_to_address, 12);
    assert_true(sim_machine_field(machine, sim_class_field(LRB_CLASS_vector_alu, SIM_KEY_blocking), &view));
    assert_string_equal(view.source, "default: none");
    sim_machine_destroy(&machine);
    free(text);
}

static void load__name_or_path__errors_name_it(void **state)
{
    (void)state;
    sim_machine *machine = NULL;
    base_error err = {0};
    assert_int_equal(sim_machine_load("pentium", &machine, &err), BASE_ERR_USAGE);
    assert_string_equal(err.what, "pentium");
    assert_string_equal(err.why, "no such machine; built in: larrabee, knc, ideal, wide; a path has a '/' or ends in .ini");
    assert_int_equal(sim_machine_load("no-such-file.ini", &machine, &err), BASE_ERR_INPUT);
    assert_string_equal(err.what, "no-such-file.ini");
    assert_int_equal(sim_machine_load("/", &machine, &err), BASE_ERR_INPUT);
    assert_null(machine);
    machine = load(MACHINE_INI);
    sim_machine *builtin = load("larrabee");
    assert_int_equal(sim_machine_hash(machine), sim_machine_hash(builtin));
    sim_machine_destroy(&machine);
    sim_machine_destroy(&builtin);
}

static void load__over_one_mebibyte__refused(void **state)
{
    (void)state;
    char path[] = "./machine_XXXXXX";
    int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    FILE *file = fdopen(descriptor, "wb");
    assert_non_null(file);
    char *good = read_whole(MACHINE_INI);
    size_t size = strlen(good);
    fputs(good, file);
    for (; size < 1 << 20; size++)
        fputc('\n', file);
    fflush(file);
    sim_machine *machine = load(path);
    sim_machine_destroy(&machine);
    fputc('\n', file);
    fclose(file);
    base_error err = {0};
    assert_int_equal(sim_machine_load(path, &machine, &err), BASE_ERR_INPUT);
    assert_string_equal(err.what, path);
    assert_string_equal(err.why, "larger than 1 MiB");
    remove(path);
    free(good);
}

static void set__good__value_basis_and_member_follow(void **state)
{
    (void)state;
    sim_machine *machine = load("larrabee");
    sim_field_view view;
    assert_int_equal(sim_machine_set(machine, "vector_alu.latency=5", NULL), BASE_OK);
    assert_int_equal(sim_machine_set(machine, "vector_alu.throughput=1.5", NULL), BASE_OK);
    assert_int_equal(sim_machine_set(machine, "issue_gap=2", NULL), BASE_OK);
    assert_int_equal(sim_machine_set(machine, "machine.threads=2", NULL), BASE_OK);
    assert_int_equal(sim_machine_set(machine, "vector_load.pipes=U", NULL), BASE_OK);
    assert_int_equal(sim_machine_set(machine, "memory.cycles_per_line=20.5", NULL), BASE_OK);
    assert_int_equal(sim_machine_set(machine, "clock_hz=5000000000", NULL), BASE_OK);
    assert_int_equal(machine->cost[LRB_CLASS_vector_alu].latency, 5);
    assert_int_equal(machine->cost[LRB_CLASS_vector_alu].throughput, 3);
    assert_int_equal(machine->issue_gap, 2);
    assert_int_equal(machine->threads, 2);
    assert_int_equal(machine->cost[LRB_CLASS_vector_load].pipes, SIM_PIPE_U);
    assert_int_equal(machine->memory.cycles_per_line_tenths, 205);
    assert_true(machine->clock_hz == UINT64_C(5000000000));
    assert_true(sim_machine_field(machine, sim_class_field(LRB_CLASS_vector_alu, SIM_KEY_throughput), &view));
    assert_string_equal(view.value, "1.5");
    assert_int_equal(view.basis, SIM_BASIS_OVERRIDE);
    assert_string_equal(sim_basis_name(view.basis), "override");
    assert_string_equal(view.source, "--set");
    assert_int_equal(sim_machine_check(machine, NULL), BASE_OK);
    sim_machine_destroy(&machine);
}

static void set__bad__refused_and_unchanged(void **state)
{
    (void)state;
    static const struct {
        const char *assignment, *what, *why;
    } cases[] = {
        {"vector_alu.latency", "--set", "'vector_alu.latency' is not FIELD=VALUE"},
        {"vector_alu.latency=0", "--set vector_alu.latency", "0 is not in 1..1000"},
        {"vector_alu.latency=", "--set vector_alu.latency", "no value"},
        {"vector_alu.latency= 5", "--set vector_alu.latency", "' 5' is not a plain decimal number"},
        {"vector_alu.latency=5 | measured | x", "--set vector_alu.latency",
         "'5 | measured | x' is not a plain decimal number"},
        {"vector_alu.throughput=0.25", "--set vector_alu.throughput", "0.25 is not a multiple of 0.5"},
        {"vector_alu.speed=5", "--set vector_alu.speed", "no such field of a machine"},
        {"latency=5", "--set latency", "no such field of a machine"},
        {"marker.latency=5", "--set marker.latency", "no such field of a machine"},
        {"name=x", "--set name", "no such field of a machine"},
        {".issue_gap=2", "--set .issue_gap", "no such field of a machine"},
        {"=2", "--set ", "no such field of a machine"},
        {"vector_load.pipes=W", "--set vector_load.pipes", "'W' is not U, V or UV"},
    };
    sim_machine *machine = load("larrabee"), *before = load("larrabee");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        base_error err = {0};
        assert_int_equal(sim_machine_set(machine, cases[i].assignment, &err), BASE_ERR_USAGE);
        assert_string_equal(err.what, cases[i].what);
        assert_string_equal(err.why, cases[i].why);
    }
    char long_name[400];
    memset(long_name, 'x', sizeof long_name);
    memcpy(long_name + sizeof long_name - 3, "=1", 3);
    assert_int_equal(sim_machine_set(machine, long_name, NULL), BASE_ERR_USAGE);
    assert_memory_equal(machine, before, sizeof *machine);
    sim_machine_destroy(&machine);
    sim_machine_destroy(&before);
}

static void check__after_set__names_the_field(void **state)
{
    (void)state;
    sim_machine *machine = load("larrabee");
    base_error err = {0};
    assert_int_equal(sim_machine_set(machine, "l1.line_bytes=96", NULL), BASE_OK);
    assert_int_equal(sim_machine_check(machine, &err), BASE_ERR_USAGE);
    assert_string_equal(err.what, "l1.line_bytes");
    assert_string_equal(err.why, "96 is not a power of two");
    assert_int_equal(sim_machine_set(machine, "l1.line_bytes=128", NULL), BASE_OK);
    assert_int_equal(sim_machine_check(machine, &err), BASE_ERR_USAGE);
    assert_string_equal(err.what, "l2.line_bytes");
    assert_int_equal(sim_machine_set(machine, "l2.line_bytes=128", NULL), BASE_OK);
    assert_int_equal(sim_machine_check(machine, &err), BASE_OK);
    assert_int_equal(sim_machine_set(machine, "l2.latency=2", NULL), BASE_OK);
    assert_int_equal(sim_machine_check(machine, &err), BASE_ERR_USAGE);
    assert_string_equal(err.what, "l2.latency");
    sim_machine_destroy(&machine);
}

/* Each field alone changes the hash: set it to another value that its range allows. */
static void hash__any_value__changes_it(void **state)
{
    (void)state;
    static const char *const others[] = {"1", "2", "64", "2048", "U", "V"};
    for (size_t number = 0; number < SIM_FIELDS; number++) {
        sim_machine *machine = load("knc");
        uint64_t before = sim_machine_hash(machine);
        sim_field_view view;
        bool changed = false;
        if (sim_machine_field(machine, number, &view)) {
            for (size_t i = 0; i < sizeof others / sizeof *others && !changed; i++) {
                char assignment[120];
                snprintf(assignment, sizeof assignment, "%s.%s=%s", view.section, view.key, others[i]);
                changed = strcmp(view.value, others[i]) != 0 && sim_machine_set(machine, assignment, NULL) == BASE_OK;
            }
            if (!changed || sim_machine_hash(machine) == before)
                fail_msg("%s.%s does not change the hash", view.section, view.key);
        }
        sim_machine_destroy(&machine);
    }
    sim_machine *lrb = load("larrabee"), *knc = load("knc");
    assert_true(sim_machine_hash(lrb) != sim_machine_hash(knc));
    sim_machine_destroy(&lrb);
    sim_machine_destroy(&knc);
}

static void hash__source_basis_name_or_layout__keeps_it(void **state)
{
    (void)state;
    static const char *const edits[][2] = {
        {"none: not published; Knights", "ANA: quite another source; Knights"},
        {"issue_gap = 1  | assumed", "issue_gap=1.0|documented"},
        {"name = larrabee", "name = other"},
        {"description = Larrabee", "description = Something"},
        {"# Larrabee", "; Larrabee"},
        {"latency_to_address = 3 | inferred | MM", "# | MM"}, /* the default has the same value */
    };
    sim_machine *builtin = load("larrabee");
    for (size_t i = 0; i < sizeof edits / sizeof *edits; i++) {
        char *text = edited(edits[i][0], edits[i][1]);
        assert_int_equal(hash_of_text(text), sim_machine_hash(builtin));
        free(text);
    }
    sim_machine_destroy(&builtin);
}

/* What the view prints is a description again, of the same machine. */
static void field__printed_and_parsed__same_machine(void **state)
{
    (void)state;
    sim_machine *machine = load("knc"), *again = NULL;
    char *text = calloc(1, 1 << 18);
    size_t used = (size_t)sprintf(text, "[machine]\nname = again\ndescription = printed\n");
    sim_field_view view;
    base_error err = {0};
    for (size_t number = 0; number < SIM_FIELDS; number++)
        if (sim_machine_field(machine, number, &view))
            used += (size_t)sprintf(text + used, "[%s]\n%s = %s | %s | %s\n", view.section, view.key, view.value,
                                    sim_basis_name(view.basis), view.source);
    if (sim_machine_parse("again.ini", text, used, &again, &err) != BASE_OK)
        fail_msg("%s: %s", err.what, err.why);
    assert_int_equal(sim_machine_hash(again), sim_machine_hash(machine));
    assert_memory_equal(again->cost, machine->cost, sizeof machine->cost);
    assert_memory_equal(&again->memory, &machine->memory, sizeof machine->memory);
    sim_machine_destroy(&machine);
    sim_machine_destroy(&again);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(builtin__each_loads__named_and_checked),
        cmocka_unit_test(builtin__cost_table__as_published),
        cmocka_unit_test(builtin__every_number__has_basis_and_known_source),
        cmocka_unit_test(docs__every_field__is_named),
        cmocka_unit_test(field__optional_keys__only_where_they_apply),
        cmocka_unit_test(field__left_out__default_follows_latency),
        cmocka_unit_test(load__name_or_path__errors_name_it),
        cmocka_unit_test(load__over_one_mebibyte__refused),
        cmocka_unit_test(set__good__value_basis_and_member_follow),
        cmocka_unit_test(set__bad__refused_and_unchanged),
        cmocka_unit_test(check__after_set__names_the_field),
        cmocka_unit_test(hash__any_value__changes_it),
        cmocka_unit_test(hash__source_basis_name_or_layout__keeps_it),
        cmocka_unit_test(field__printed_and_parsed__same_machine),
    };
    return cmocka_run_group_tests_name("sim/machine", tests, NULL, NULL);
}
