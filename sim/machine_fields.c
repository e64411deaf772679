#include "sim/machine_fields.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

/* The words of the table. */
#define NO_MODEL "no model"
#define CORE_ONLY "core"
#define ISSUE_ON "issue, core"
#define COUNT_ON "count, issue, core"

#define BIT(id) (UINT32_C(1) << LRB_CLASS_##id)
#define ALL_CLASSES (((UINT32_C(1) << LRB_CLASS_COUNT) - 1) & ~BIT(marker))
#define FLAG_WRITERS (BIT(scalar_compare) | BIT(mask_test))
#define VECTOR_WRITERS                                                                                                 \
    (BIT(vector_alu) | BIT(vector_permute) | BIT(vector_convert) | BIT(vector_lookup) |                              \
     BIT(vector_transcendental) | BIT(vector_load) | BIT(vector_load_convert) | BIT(vector_gather))
#define LINE_BY_LINE (BIT(vector_gather) | BIT(vector_scatter))
#define REGISTER_WRITERS                                                                                               \
    (BIT(scalar_alu) | BIT(scalar_shift) | BIT(scalar_multiply) | BIT(scalar_bit) | BIT(scalar_load) | BIT(mask_move))

_Static_assert(LRB_CLASS_COUNT < 32, "sets of cost classes are 32-bit words");

/* How many of the kept counts make one unit. */
#define SCALE_WHOLE 1
#define SCALE_WIDE 1
#define SCALE_HALVES 2
#define SCALE_TENTHS 10
#define SCALE_PIPES 1

static const sim_field_rule plain_rules[SIM_PLAIN_FIELDS] = {
/* {"machine", "threads", "threads", CORE_ONLY, "hardware ...", SIM_KIND_WHOLE, SIM_DEFAULT_REQUIRED, 1, 64, ...}, */
#define FIELD(section, key, member, kind, min, max, fallback, unit, used_by, sentence)                                 \
    {#section, #key, unit, used_by, sentence, SIM_KIND_##kind, SIM_DEFAULT_##fallback,                                 \
     (uint64_t)((min) * SCALE_##kind), (uint64_t)((max) * SCALE_##kind), offsetof(sim_machine, member), 0},
#define CLASS_FIELD(key, kind, min, max, fallback, classes, unit, used_by, sentence)
#include "sim/machine_fields.def"
};

static const sim_field_rule class_rules[SIM_CLASS_KEYS] = {
/* {NULL, "latency", "cycles", ISSUE_ON, "issue of ...", SIM_KIND_WHOLE, SIM_DEFAULT_REQUIRED, 1, 1000, ...}, */
#define FIELD(section, key, member, kind, min, max, fallback, unit, used_by, sentence)
#define CLASS_FIELD(key, kind, min, max, fallback, classes, unit, used_by, sentence)                                   \
    {NULL, #key, unit, used_by, sentence, SIM_KIND_##kind, SIM_DEFAULT_##fallback,                                     \
     (uint64_t)((min) * SCALE_##kind), (uint64_t)((max) * SCALE_##kind), offsetof(sim_class_cost, key), classes},
#include "sim/machine_fields.def"
};

static unsigned scale_of(sim_field_kind kind)
{
    return kind == SIM_KIND_HALVES ? SCALE_HALVES : kind == SIM_KIND_TENTHS ? SCALE_TENTHS : SCALE_WHOLE;
}

bool sim_field_get(size_t number, sim_field *field)
{
    if (number < SIM_PLAIN_FIELDS) {
        const sim_field_rule *rule = &plain_rules[number];
        *field = (sim_field){rule, rule->section, LRB_CLASS_COUNT, rule->offset};
        return true;
    }
    if (number >= SIM_FIELDS)
        return false;
    size_t cost_class = (number - SIM_PLAIN_FIELDS) / SIM_CLASS_KEYS;
    const sim_field_rule *rule = &class_rules[(number - SIM_PLAIN_FIELDS) % SIM_CLASS_KEYS];
    if (!(rule->classes >> cost_class & 1))
        return false;
    *field = (sim_field){rule, lrb_cost_classes[cost_class].name, (lrb_cost_class)cost_class,
                         offsetof(sim_machine, cost) + cost_class * sizeof(sim_class_cost) + rule->offset};
    return true;
}

size_t sim_field_find(const char *section, const char *key)
{
    sim_field field;
    for (size_t number = 0; number < SIM_FIELDS; number++)
        if (sim_field_get(number, &field) && strcmp(field.section, section) == 0 && strcmp(field.rule->key, key) == 0)
            return number;
    return SIM_FIELDS;
}

bool sim_section_exists(const char *section)
{
    sim_field field;
    for (size_t number = 0; number < SIM_FIELDS; number++)
        if (sim_field_get(number, &field) && strcmp(field.section, section) == 0)
            return true;
    return false;
}

/* Digits, perhaps '.' and digits. A value too large for any field stays at this, which no range includes. */
#define TOO_LARGE UINT64_C(1000000000000000)

/* What came of reading a decimal number as a count of 1/scale. */
typedef enum decimal_result { DECIMAL_OK, DECIMAL_NONE, DECIMAL_INEXACT } decimal_result;

static decimal_result read_decimal(const char *text, unsigned scale, uint64_t *value)
{
    uint64_t whole = 0;
    unsigned tenths = 0;
    bool exact = true;
    if (*text < '0' || *text > '9')
        return DECIMAL_NONE;
    for (; *text >= '0' && *text <= '9'; text++)
        whole = whole >= TOO_LARGE / 10 ? TOO_LARGE : whole * 10 + (uint64_t)(*text - '0');
    if (*text == '.') {
        text++;
        if (*text < '0' || *text > '9')
            return DECIMAL_NONE;
        tenths = (unsigned)(*text++ - '0');
        for (; *text >= '0' && *text <= '9'; text++)
            exact = exact && *text == '0';
    }
    if (*text)
        return DECIMAL_NONE;
    *value = whole * scale + tenths * scale / 10;
    return exact && tenths * scale % 10 == 0 ? DECIMAL_OK : DECIMAL_INEXACT;
}

static base_status read_pipes(const char *text, base_status status, const char *what, uint64_t *value, base_error *err)
{
    if (strcmp(text, "U") == 0)
        *value = SIM_PIPE_U;
    else if (strcmp(text, "V") == 0)
        *value = SIM_PIPE_V;
    else if (strcmp(text, "UV") == 0)
        *value = SIM_PIPE_U | SIM_PIPE_V;
    else
        return base_fail(err, status, what, "'%.40s' is not U, V or UV", text);
    return BASE_OK;
}

base_status sim_field_read(const sim_field_rule *rule, const char *text, base_status status, const char *what,
                           uint64_t *value, base_error *err)
{
    uint64_t number = 0;
    char min[24], max[24];
    if (!*text)
        return base_fail(err, status, what, "no value");
    if (rule->kind == SIM_KIND_PIPES)
        return read_pipes(text, status, what, value, err);
    switch (read_decimal(text, scale_of(rule->kind), &number)) {
    case DECIMAL_NONE:
        return base_fail(err, status, what, "'%.40s' is not a plain decimal number", text);
    case DECIMAL_INEXACT:
        return base_fail(err, status, what, "%.40s is not a %s", text,
                         rule->kind == SIM_KIND_HALVES   ? "multiple of 0.5"
                         : rule->kind == SIM_KIND_TENTHS ? "multiple of 0.1"
                                                         : "whole number");
    case DECIMAL_OK:
        break;
    }
    if (number < rule->min || number > rule->max) {
        sim_field_write(rule, rule->min, min);
        sim_field_write(rule, rule->max, max);
        return base_fail(err, status, what, "%.40s is not in %s..%s", text, min, max);
    }
    *value = number;
    return BASE_OK;
}

void sim_field_write(const sim_field_rule *rule, uint64_t value, char text[24])
{
    unsigned scale = scale_of(rule->kind);
    if (rule->kind == SIM_KIND_PIPES)
        snprintf(text, 24, "%s%s", value & SIM_PIPE_U ? "U" : "", value & SIM_PIPE_V ? "V" : "");
    else if (value % scale)
        snprintf(text, 24, "%" PRIu64 ".%c", value / scale, (char)('0' + value % scale * 10 / scale));
    else
        snprintf(text, 24, "%" PRIu64, value / scale);
}
