/* The reader of machine descriptions: every kind of mistake is refused, naming file, line and field. */
#include "tests/sim/machine_text.h"

/* Line of the description in which `needle` begins. */
static unsigned line_of(const char *text, const char *needle)
{
    const char *at = strstr(text, needle);
    assert_non_null(at);
    unsigned line = 1;
    for (; text < at; text++)
        line += *text == '\n';
    return line;
}

/* The description with `old` replaced by `new` fails as "test.ini[:LINE]: WHAT" and WHY; LINE is that of `where`. */
static void check_refused(const char *old, const char *new, const char *where, const char *what, const char *why)
{
    char *text = edited(old, new), place[300];
    sim_machine *machine = (sim_machine *)text;
    base_error err = {0};
    if (where)
        snprintf(place, sizeof place, "test.ini:%u%s%s", line_of(text, where), *what ? ": " : "", what);
    else
        snprintf(place, sizeof place, "test.ini%s%s", *what ? ": " : "", what);
    assert_int_equal(sim_machine_parse("test.ini", text, strlen(text), &machine, &err), BASE_ERR_INPUT);
    assert_null(machine);
    assert_int_equal(err.status, BASE_ERR_INPUT);
    assert_string_equal(err.what, place);
    assert_string_equal(err.why, why);
    assert_int_equal(sim_machine_parse("test.ini", text, strlen(text), &machine, NULL), BASE_ERR_INPUT);
    free(text);
}

static void parse__bad_value__names_line_and_field(void **state)
{
    (void)state;
    static const struct {
        const char *value, *why;
    } cases[] = {
        {"0", "0 is not in 1..1000"},
        {"1001", "1001 is not in 1..1000"},
        {"99999999999999999999999", "99999999999999999999999 is not in 1..1000"},
        {"-4", "'-4' is not a plain decimal number"},
        {"+4", "'+4' is not a plain decimal number"},
        {"0x4", "'0x4' is not a plain decimal number"},
        {"4e0", "'4e0' is not a plain decimal number"},
        {"4,0", "'4,0' is not a plain decimal number"},
        {"4.", "'4.' is not a plain decimal number"},
        {".5", "'.5' is not a plain decimal number"},
        {"1.2.3", "'1.2.3' is not a plain decimal number"},
        {"4 5", "'4 5' is not a plain decimal number"},
        {"nan", "'nan' is not a plain decimal number"},
        {"inf", "'inf' is not a plain decimal number"},
        {"four", "'four' is not a plain decimal number"},
        {"4.5", "4.5 is not a whole number"},
        {"4.00001", "4.00001 is not a whole number"},
        {"", "no value"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char line[120];
        snprintf(line, sizeof line, "latency    = %s | inferred | MM bench_vpu", cases[i].value);
        check_refused("latency    = 4 | inferred | MM bench_vpu", line, line, "vector_alu.latency", cases[i].why);
    }
    check_refused("throughput = 1 | inferred | SEI (recalled): one", "throughput = 1.3 | inferred | SEI",
                  "throughput = 1.3", "vector_alu.throughput", "1.3 is not a multiple of 0.5");
    check_refused("throughput = 1 | inferred | SEI (recalled): one", "throughput = 0.0 | inferred | SEI",
                  "throughput = 0.0", "vector_alu.throughput", "0.0 is not in 0.5..1000");
    check_refused("= 14.4 |", "= 14.45 |", "= 14.45 |", "memory.cycles_per_line", "14.45 is not a multiple of 0.1");
    check_refused("pipes      = V |", "pipes      = VU |", "pipes      = VU", "branch.pipes", "'VU' is not U, V or UV");
    check_refused("clock_hz  = 1000000000", "clock_hz  = 100000000001", "clock_hz  = 1", "machine.clock_hz",
                  "100000000001 is not in 1..100000000000");
}

static void parse__bad_basis_or_source__names_line_and_field(void **state)
{
    (void)state;
    const char *old = "issue_gap = 1  | assumed | none: not published; Knights Corner needs 2, so look at both";
    const char *bar = "no basis: write VALUE | BASIS | SOURCE", *source = "no source: write VALUE | BASIS | SOURCE";
    check_refused(old, "issue_gap = 1", "issue_gap", "machine.issue_gap", bar);
    check_refused(old, "issue_gap = 1 |", "issue_gap", "machine.issue_gap", bar);
    check_refused(old, "issue_gap = 1 | assumed", "issue_gap", "machine.issue_gap", source);
    check_refused(old, "issue_gap = 1 | assumed | ", "issue_gap", "machine.issue_gap", source);
    check_refused(old, "issue_gap = 1 | guessed | X", "issue_gap", "machine.issue_gap",
                  "'guessed' is not documented, measured, inferred or assumed");
    check_refused(old, "issue_gap = 1 | override | X", "issue_gap", "machine.issue_gap",
                  "'override' is not documented, measured, inferred or assumed");
}

static void parse__missing__names_field_or_class(void **state)
{
    (void)state;
    const char *price = "no price for this cost class: every class but marker needs one";
    check_refused("issue_gap = 1", "# ", NULL, "machine.issue_gap", "missing");
    check_refused("name = larrabee\n", "", NULL, "machine.name", "missing");
    check_refused("description = ", "# ", NULL, "machine.description", "missing");
    check_refused("throughput = 10 |", "# ", NULL, "scalar_multiply.throughput", "missing");
    check_refused("btb_ways ", "# ", NULL, "branch.btb_ways", "missing");
    for (int c = 0; c < LRB_CLASS_COUNT; c++) {
        char header[64], *text, *at, *end;
        sim_machine *machine;
        base_error err = {0};
        if (c == LRB_CLASS_marker)
            continue;
        /* Blank the lines of the class's fields; those of prediction in [branch] stay. */
        snprintf(header, sizeof header, "\n[%s]\n", lrb_cost_classes[c].name);
        text = read_whole(MACHINE_INI);
        at = strstr(text, header);
        assert_non_null(at);
        at += strlen(header);
        end = c == LRB_CLASS_branch ? strstr(at, "mispredict") : strstr(at, "\n[");
        for (; at < end; at++)
            *at = *at == '\n' ? '\n' : ' ';
        assert_int_equal(sim_machine_parse("test.ini", text, strlen(text), &machine, &err), BASE_ERR_INPUT);
        assert_string_equal(err.why, price);
        snprintf(header, sizeof header, "test.ini: %s", lrb_cost_classes[c].name);
        assert_string_equal(err.what, header);
        free(text);
    }
}

static void parse__unknown_or_twice__refused(void **state)
{
    (void)state;
    check_refused("\nthreads ", "\nthread ", "thread ", "machine.thread", "no such field of a machine");
    check_refused("[l1]", "[l9]", "[l9]", "", "[l9]: no such section of a machine");
    check_refused("[l1]", "[empty]\n[l1]", "[empty]", "", "[empty]: no such section of a machine");
    check_refused("[l1]", "[marker]\n[l1]", "[marker]", "", "[marker]: no such section of a machine");
    check_refused("[vector_compare]", "latency_to_branch = 1 | assumed | none: x\n[vector_compare]",
                  "latency_to_branch = 1 | assumed", "vector_alu.latency_to_branch", "no such field of a machine");
    char twice[80], *text = edited("[l1]", "[l1]");
    snprintf(twice, sizeof twice, "given twice, first in line %u", line_of(text, "issue_gap = 1"));
    free(text);
    check_refused("\n[scalar_alu]", "issue_gap = 3 | assumed | none: x\n[scalar_alu]", "issue_gap = 3",
                  "machine.issue_gap", twice);
    check_refused("name = larrabee", "name = a\nname = b", "name = b", "machine.name", "given twice, first in line 10");
}

static void parse__bad_line__names_line(void **state)
{
    (void)state;
    char line[300] = "# ";
    check_refused("[l1]", "[l1", "[l1", "", "a section has no ']'");
    check_refused("[l1]", "[l1] size", "[l1] size", "", "text after ']'");
    check_refused("[l1]", "l1", "l1\n", "", "neither [SECTION] nor KEY = VALUE");
    check_refused("issue_gap", " issue_gap", " issue_gap", "", "the line is indented");
    check_refused("# Larrabee", "a = 1 | assumed | none: x\n#", "a = 1", "a", "stands before the first section");
    check_refused("Larrabee, one", "Larrab\xc3\xa9" "e, one", "description", "", "byte 0xc3 is not printable ASCII");
    check_refused("Larrabee, one", "Larrabee\x01, one", "description", "", "byte 0x01 is not printable ASCII");
    check_refused("name = larrabee", "name = larra bee", "name = larra", "machine.name",
                  "'larra bee' has more than letters, digits, '-' and '_'");
    check_refused("name = larrabee", "name = a12345678901234567890123456789012", "name = a", "machine.name",
                  "longer than 31 bytes");
    memset(line + 2, 'x', 196);
    check_refused("[l1]", line, line, "", "the line is longer than 197 bytes");
}

/* A zero byte inside the text is an error, not an early end. */
static void parse__zero_byte__refused(void **state)
{
    (void)state;
    char *text = read_whole(MACHINE_INI);
    size_t size = strlen(text);
    sim_machine *machine = NULL;
    base_error err = {0};
    text[size - 1] = 0;
    assert_int_equal(sim_machine_parse("test.ini", text, size, &machine, &err), BASE_ERR_INPUT);
    assert_string_equal(err.why, "byte 0x00 is not printable ASCII");
    assert_int_equal(sim_machine_parse("test.ini", text, 0, &machine, &err), BASE_ERR_INPUT);
    assert_string_equal(err.what, "test.ini: machine.name");
    free(text);
}

/* A path longer than an error can hold loses its beginning, not the line and the field. */
static void parse__long_path__error_keeps_its_end(void **state)
{
    (void)state;
    char label[2000], *text = edited("issue_gap = 1", "issue_gap = 0");
    sim_machine *machine = NULL;
    base_error err = {0};
    memset(label, 'd', sizeof label);
    memcpy(label + sizeof label - 7, "/x.ini", 7);
    assert_int_equal(sim_machine_parse(label, text, strlen(text), &machine, &err), BASE_ERR_INPUT);
    assert_memory_equal(err.what, "...ddd", 6);
    assert_non_null(strstr(err.what, "d/x.ini:16: machine.issue_gap"));
    free(text);
}

static void parse__fields_contradict__refused_with_line(void **state)
{
    (void)state;
    check_refused("throughput = 1 | inferred | LST\n", "throughput = 0.5 | inferred | LST\n",
                  "throughput = 0.5 | inferred | LST\n", "vector_compare.throughput",
                  "0.5, two a cycle, needs both pipes");
    check_refused("latency_to_shuffle = 6 | inferred", "latency_to_shuffle = 3 | inferred", "latency_to_shuffle = 3",
                  "vector_alu.latency_to_shuffle", "3 is less than latency, 4");
    check_refused("latency_to_address = 11", "latency_to_address = 9", "latency_to_address = 9",
                  "scalar_multiply.latency_to_address", "9 is less than latency, 10");
    check_refused("size_bytes = 262144", "size_bytes = 262145", "size_bytes = 262145", "l2.size_bytes",
                  "262145 is not a power of two times l2.ways x l2.line_bytes, 8 x 64");
    check_refused("size_bytes = 32768", "size_bytes = 49152", "size_bytes = 49152", "l1.size_bytes",
                  "49152 is not a power of two times l1.ways x l1.line_bytes, 8 x 64");
    check_refused("btb_entries = 256", "btb_entries = 255", "btb_entries = 255", "branch.btb_entries",
                  "255 is not a power of two times branch.btb_ways, 4");
    check_refused("remote_latency  = 247", "remote_latency  = 23", "remote_latency  = 23", "l2.remote_latency",
                  "23 is less than l2.latency, 24");
    check_refused("latency         = 300", "latency         = 20", "latency         = 20", "memory.latency",
                  "20 is less than l2.latency, 24");
}

/* Carriage returns, a missing last newline, a source with bars and a comment behind a value are all accepted. */
static void parse__other_layouts__same_values(void **state)
{
    (void)state;
    char *plain = edited("[l1]", "[l1]"), *bars, *crlf = calloc(2, strlen(plain) + 1), *out = crlf;
    assert_non_null(crlf);
    for (const char *in = plain; *in; in++) {
        if (*in == '\n')
            *out++ = '\r';
        *out++ = *in;
    }
    assert_int_equal(hash_of_text(crlf), hash_of_text(plain));
    bars = edited("| inferred | LST\n", "|inferred|LST | and more ; a remark\n");
    assert_int_equal(hash_of_text(bars), hash_of_text(plain));
    plain[strlen(plain) - 1] = 0;
    assert_int_equal(hash_of_text(plain), hash_of_text(crlf));
    free(plain);
    free(bars);
    free(crlf);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parse__bad_value__names_line_and_field),
        cmocka_unit_test(parse__bad_basis_or_source__names_line_and_field),
        cmocka_unit_test(parse__missing__names_field_or_class),
        cmocka_unit_test(parse__unknown_or_twice__refused),
        cmocka_unit_test(parse__bad_line__names_line),
        cmocka_unit_test(parse__zero_byte__refused),
        cmocka_unit_test(parse__long_path__error_keeps_its_end),
        cmocka_unit_test(parse__fields_contradict__refused_with_line),
        cmocka_unit_test(parse__other_layouts__same_values),
    };
    return cmocka_run_group_tests_name("sim/machine_file", tests, NULL, NULL);
}
