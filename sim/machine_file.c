/* Reads a machine description: INI text, through inih. inih hands over keys and values; what it lets pass (unknown
 * empty sections, over-long lines, indented lines, bytes that are no text) is refused here, in the reader that feeds it
 * line by line. The first error stops the reading. */
#include <ini.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim/machine_fields.h"
#include "sim/machine_values.h"

typedef struct machine_parser {
    const char *label;
    const char *next, *end; /* text not yet handed to inih */
    sim_machine *machine;
    base_error *err;
    base_status status;
    unsigned line;                    /* of the line handed over last; from 1 */
    unsigned name_line, description_line; /* 0: not given yet */
    unsigned value_line[SIM_FIELDS];  /* 0: not given yet */
    char what[256];
} machine_parser;

/* "FILE", "FILE:LINE", each with ": FIELD" unless `field` is "". Long paths lose their beginning. */
static const char *place(machine_parser *p, unsigned line, const char *field)
{
    size_t length = strlen(p->label);
    const char *tail = length > 120 ? p->label + (length - 117) : p->label;
    const char *cut = length > 120 ? "..." : "";
    const char *colon = *field ? ": " : "";
    if (line)
        snprintf(p->what, sizeof p->what, "%s%s:%u%s%s", cut, tail, line, colon, field);
    else
        snprintf(p->what, sizeof p->what, "%s%s%s%s", cut, tail, colon, field);
    return p->what;
}

#define FAIL(p, line, field, ...)                                                                                      \
    ((p)->status = base_fail((p)->err, BASE_ERR_INPUT, place((p), (line), (field)), __VA_ARGS__))

/* Section lines, which inih reports only through the keys that follow: "[name]", then blanks or a comment. */
static void check_section_line(machine_parser *p, const char *line, size_t length)
{
    char name[64];
    const char *close = memchr(line, ']', length);
    if (!close) {
        FAIL(p, p->line, "", "a section has no ']'");
        return;
    }
    const char *rest = close + 1;
    while (rest < line + length && (*rest == ' ' || *rest == '\t'))
        rest++;
    if (rest < line + length && *rest != ';' && *rest != '#') {
        FAIL(p, p->line, "", "text after ']'");
        return;
    }
    snprintf(name, sizeof name, "%.*s", (int)(close - line - 1 > 63 ? 63 : close - line - 1), line + 1);
    if (!sim_section_exists(name))
        FAIL(p, p->line, "", "[%.40s]: no such section of a machine", name);
}

static void check_line(machine_parser *p, const char *line, size_t length, int limit)
{
    if (length > (size_t)limit) {
        FAIL(p, p->line, "", "the line is longer than %d bytes", limit);
        return;
    }
    for (size_t i = 0; i < length; i++) {
        unsigned char byte = (unsigned char)line[i];
        if ((byte < ' ' && byte != '\t') || byte > '~') {
            FAIL(p, p->line, "", "byte 0x%02x is not printable ASCII", byte);
            return;
        }
    }
    size_t blanks = 0;
    while (blanks < length && (line[blanks] == ' ' || line[blanks] == '\t'))
        blanks++;
    if (blanks == length || line[blanks] == '#' || line[blanks] == ';')
        return;
    if (blanks > 0)
        FAIL(p, p->line, "", "the line is indented");
    else if (line[0] == '[')
        check_section_line(p, line, length);
    else if (!memchr(line, '=', length))
        FAIL(p, p->line, "", "neither [SECTION] nor KEY = VALUE");
}

/* inih's fgets: one line, or NULL at the end and after an error. */
static char *read_line(char *buffer, int size, void *user)
{
    machine_parser *p = user;
    if (p->status != BASE_OK || p->next == p->end)
        return NULL;
    const char *start = p->next;
    const char *newline = memchr(start, '\n', (size_t)(p->end - start));
    size_t length = (size_t)((newline ? newline : p->end) - start);
    p->next = newline ? newline + 1 : p->end;
    p->line++;
    if (length > 0 && start[length - 1] == '\r')
        length--;
    check_line(p, start, length, size - 3);
    if (p->status != BASE_OK)
        return NULL;
    memcpy(buffer, start, length);
    buffer[length] = '\n';
    buffer[length + 1] = 0;
    return buffer;
}

/* Cut `text` at its first '|'; both sides lose the blanks around it. Returns the right side, NULL without '|'. */
static char *cut_at_bar(char *text)
{
    char *bar = strchr(text, '|');
    char *end = bar ? bar : text + strlen(text);
    while (end > text && (end[-1] == ' ' || end[-1] == '\t'))
        end--;
    *end = 0;
    return bar ? bar + 1 + strspn(bar + 1, " \t") : NULL;
}

static bool read_basis(const char *word, sim_basis *basis)
{
    for (int b = 0; b < SIM_BASIS_OVERRIDE; b++)
        if (strcmp(word, sim_basis_name((sim_basis)b)) == 0) {
            *basis = (sim_basis)b;
            return true;
        }
    return false;
}

static void take_value(machine_parser *p, size_t number, const char *name, const char *text)
{
    char parts[SIM_MACHINE_TEXT_SIZE];
    sim_field field;
    sim_machine_value *slot = &p->machine->values[number];
    sim_field_get(number, &field);
    if (p->value_line[number]) {
        FAIL(p, p->line, name, "given twice, first in line %u", p->value_line[number]);
        return;
    }
    p->value_line[number] = p->line;
    snprintf(parts, sizeof parts, "%s", text);
    char *basis = cut_at_bar(parts);
    char *source = basis ? cut_at_bar(basis) : NULL;
    p->status = sim_field_read(field.rule, parts, BASE_ERR_INPUT, place(p, p->line, name), &slot->value, p->err);
    if (p->status != BASE_OK)
        return;
    if (!basis || !*basis)
        FAIL(p, p->line, name, "no basis: write VALUE | BASIS | SOURCE");
    else if (!read_basis(basis, &slot->basis))
        FAIL(p, p->line, name, "'%.40s' is not documented, measured, inferred or assumed", basis);
    else if (!source || !*source)
        FAIL(p, p->line, name, "no source: write VALUE | BASIS | SOURCE");
    else {
        slot->given = true;
        snprintf(slot->source, sizeof slot->source, "%s", source);
    }
}

/* `name` and `description`: plain text, no basis. */
static void take_text(machine_parser *p, const char *name, const char *text, char *out, size_t size, unsigned *line)
{
    if (*line)
        FAIL(p, p->line, name, "given twice, first in line %u", *line);
    else if (!*text)
        FAIL(p, p->line, name, "no value");
    else if (strlen(text) >= size)
        FAIL(p, p->line, name, "longer than %zu bytes", size - 1);
    else {
        *line = p->line;
        snprintf(out, size, "%s", text);
    }
}

/* The name becomes part of statistics and file names. */
static void take_name(machine_parser *p, const char *text)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_";
    if (text[strspn(text, letters)])
        FAIL(p, p->line, "machine.name", "'%.40s' has more than letters, digits, '-' and '_'", text);
    else
        take_text(p, "machine.name", text, p->machine->name, sizeof p->machine->name, &p->name_line);
}

static int take_pair(void *user, const char *section, const char *key, const char *text)
{
    machine_parser *p = user;
    char name[128];
    if (p->status != BASE_OK)
        return 0;
    snprintf(name, sizeof name, "%s.%s", section, key);
    size_t number = sim_field_find(section, key);
    if (!*section)
        FAIL(p, p->line, key, "stands before the first section");
    else if (strcmp(name, "machine.name") == 0)
        take_name(p, text);
    else if (strcmp(name, "machine.description") == 0)
        take_text(p, name, text, p->machine->description, sizeof p->machine->description, &p->description_line);
    else if (number == SIM_FIELDS)
        FAIL(p, p->line, name, "no such field of a machine");
    else
        take_value(p, number, name, text);
    return p->status == BASE_OK;
}

/* Is no field of this class given? Then the whole section is missing, which deserves its own words. */
static bool class_is_absent(const machine_parser *p, lrb_cost_class c)
{
    for (int key = 0; key < SIM_CLASS_KEYS; key++)
        if (p->value_line[sim_class_field(c, (sim_class_key)key)])
            return false;
    return true;
}

static void check_complete(machine_parser *p)
{
    sim_field field;
    if (!p->name_line)
        FAIL(p, 0, "machine.name", "missing");
    else if (!p->description_line)
        FAIL(p, 0, "machine.description", "missing");
    for (size_t number = 0; number < SIM_FIELDS && p->status == BASE_OK; number++) {
        char name[80];
        if (!sim_field_get(number, &field) || p->value_line[number] || field.rule->fallback != SIM_DEFAULT_REQUIRED)
            continue;
        snprintf(name, sizeof name, "%s.%s", field.section, field.rule->key);
        if (field.cost_class != LRB_CLASS_COUNT && class_is_absent(p, field.cost_class))
            FAIL(p, 0, field.section, "no price for this cost class: every class but marker needs one");
        else
            FAIL(p, 0, name, "missing");
    }
}

static void check_consistent(machine_parser *p)
{
    char why[SIM_MACHINE_TEXT_SIZE], name[80];
    sim_field field;
    size_t number = sim_machine_flaw(p->machine, why);
    if (!sim_field_get(number, &field))
        return;
    snprintf(name, sizeof name, "%s.%s", field.section, field.rule->key);
    FAIL(p, p->value_line[number], name, "%s", why);
}

static void run_parser(machine_parser *p)
{
    int first_bad = ini_parse_stream(read_line, p, take_pair, p);
    if (p->status == BASE_OK && first_bad == -2)
        p->status = base_fail(p->err, BASE_ERR_NOMEM, p->label, "out of memory");
    else if (p->status == BASE_OK && first_bad != 0)
        FAIL(p, (unsigned)first_bad, "", "neither [SECTION] nor KEY = VALUE");
    if (p->status == BASE_OK)
        check_complete(p);
    if (p->status != BASE_OK)
        return;
    sim_machine_refresh(p->machine);
    check_consistent(p);
}

base_status sim_machine_parse(const char *label, const char *text, size_t size, sim_machine **out, base_error *err)
{
    *out = NULL;
    machine_parser p = {.label = label, .next = text, .end = text + size, .err = err, .status = BASE_OK};
    p.machine = calloc(1, sizeof *p.machine);
    if (!p.machine)
        return base_fail(err, BASE_ERR_NOMEM, label, "out of memory");
    run_parser(&p);
    if (p.status != BASE_OK)
        sim_machine_destroy(&p.machine);
    *out = p.machine;
    return p.status;
}
