/* The rules of machine_fields.def as a table: find a field, read its value from text, write it back. Private to sim. */
#ifndef SIM_MACHINE_FIELDS_H
#define SIM_MACHINE_FIELDS_H

#include "sim/machine.h"

typedef enum sim_field_kind {
    SIM_KIND_WHOLE,
    SIM_KIND_WIDE,
    SIM_KIND_HALVES,
    SIM_KIND_TENTHS,
    SIM_KIND_PIPES
} sim_field_kind;

typedef enum sim_field_default { SIM_DEFAULT_REQUIRED, SIM_DEFAULT_AS_LATENCY, SIM_DEFAULT_ZERO } sim_field_default;

/* A row of machine_fields.def. */
typedef struct sim_field_rule {
    const char *section; /* NULL for a cost class's field */
    const char *key;
    const char *unit;
    const char *used_by;
    const char *sentence;
    sim_field_kind kind;
    sim_field_default fallback;
    uint64_t min, max;    /* in units, halves or tenths, as the kind says */
    size_t offset;        /* in struct sim_machine, or in sim_class_cost */
    uint32_t classes;     /* bit c: cost class c has the field; 0 for a plain one */
} sim_field_rule;

/* A field: a rule and, for a cost class's field, which class. */
typedef struct sim_field {
    const sim_field_rule *rule;
    const char *section;
    lrb_cost_class cost_class; /* LRB_CLASS_COUNT for a plain field */
    size_t offset;             /* in struct sim_machine: a uint64_t for SIM_KIND_WIDE, else an unsigned */
} sim_field;

/** Describe field `number`; false if there is no such field. */
bool sim_field_get(size_t number, sim_field *field);

/** Number of the field `key` in `section`, or SIM_FIELDS. */
size_t sim_field_find(const char *section, const char *key);

/** Is there a field in this section? */
bool sim_section_exists(const char *section);

/**
 * Read a value: digits with at most one '.', or U, V, UV; the same in every locale.
 *
 * @param text    no blanks around it
 * @param status  status and @param what name of the field for the error
 * @param value   receives the value, in units, halves, tenths or pipe bits
 */
base_status sim_field_read(const sim_field_rule *rule, const char *text, base_status status, const char *what,
                           uint64_t *value, base_error *err);

/** Write a value as a description would, in at most 23 bytes and a 0. */
void sim_field_write(const sim_field_rule *rule, uint64_t value, char text[24]);

#endif
