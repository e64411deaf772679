/* A machine description: what each cost class costs, and the numbers of threads, branches, caches and memory.
 *
 * A machine is data: an INI file (sim/machines/, or the user's own) whose fields sim/machine_fields.def lists; every
 * number carries its basis and its source. docs/machine-model.md says what the fields mean and what no machine
 * description can say. This file knows costs, not ops and not values. */
#ifndef SIM_MACHINE_H
#define SIM_MACHINE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "lrbni/base/status.h"
#include "lrbni/cost_classes.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Where a number comes from. */
typedef enum sim_basis {
    SIM_BASIS_DOCUMENTED, /* stated for this machine by its maker or by a primary source */
    SIM_BASIS_MEASURED,   /* measured on this machine, published */
    SIM_BASIS_INFERRED,   /* follows from documents or measurements of this machine or of a close relative */
    SIM_BASIS_ASSUMED,    /* nothing published: an estimate, with its reason */
    SIM_BASIS_OVERRIDE,   /* set by the user over the description */
    SIM_BASIS_COUNT
} sim_basis;

/** The word that a description and the reports use: "documented", "measured", ..., "override". */
const char *sim_basis_name(sim_basis basis);

/* Bits of sim_class_cost.pipes. */
enum { SIM_PIPE_U = 1, SIM_PIPE_V = 2 };

/* The price of a cost class; machine_fields.def has the meaning of each member. All latencies are in cycles; where a
 * class has no such field (latency_to_branch of a vector op) the member holds its latency. */
typedef struct sim_class_cost {
    unsigned pipes;              /* SIM_PIPE_U, SIM_PIPE_V or both */
    unsigned latency;            /* >= 1 */
    unsigned throughput;         /* HALF cycles, >= 1 */
    unsigned latency_to_shuffle; /* >= latency */
    unsigned latency_to_branch;  /* may be 0 */
    unsigned latency_to_address; /* >= latency */
    unsigned latency_to_mask;    /* may be 0 */
    unsigned blocking;           /* cycles; 0 = none */
} sim_class_cost;

/* Plain fields: SIM_FIELD_machine_clock_hz, ... */
typedef enum sim_plain_field {
#define FIELD(section, key, member, kind, min, max, fallback, unit, used_by, sentence) SIM_FIELD_##section##_##key,
#define CLASS_FIELD(key, kind, min, max, fallback, classes, unit, used_by, sentence)
#include "sim/machine_fields.def"
    SIM_PLAIN_FIELDS
} sim_plain_field;

/* Fields of each cost class: SIM_KEY_pipes, SIM_KEY_latency, ... */
typedef enum sim_class_key {
#define FIELD(section, key, member, kind, min, max, fallback, unit, used_by, sentence)
#define CLASS_FIELD(key, kind, min, max, fallback, classes, unit, used_by, sentence) SIM_KEY_##key,
#include "sim/machine_fields.def"
    SIM_CLASS_KEYS
} sim_class_key;

/* Field numbers are 0 .. SIM_FIELDS-1: the plain fields, then SIM_CLASS_KEYS for every cost class. Not every number
 * is a field: sim_machine_field says which. */
enum { SIM_FIELDS = (int)SIM_PLAIN_FIELDS + (int)LRB_CLASS_COUNT * (int)SIM_CLASS_KEYS };

/** Number of a cost class's field, for its basis and source. */
static inline size_t sim_class_field(lrb_cost_class cost_class, sim_class_key key)
{
    return (size_t)SIM_PLAIN_FIELDS + (size_t)cost_class * SIM_CLASS_KEYS + (size_t)key;
}

enum { SIM_MACHINE_NAME_SIZE = 32, SIM_MACHINE_TEXT_SIZE = 200 };

/* A field as it was given; `value` counts units, halves, tenths or pipe bits, as the field's kind says. */
typedef struct sim_machine_value {
    uint64_t value;
    sim_basis basis;
    bool given; /* by the file or by --set; otherwise the default */
    char source[SIM_MACHINE_TEXT_SIZE];
} sim_machine_value;

/* Read its members freely; change them only through sim_machine_set, which keeps `values` and the rest in step. */
typedef struct sim_machine {
    char name[SIM_MACHINE_NAME_SIZE];
    char description[SIM_MACHINE_TEXT_SIZE];
    uint64_t clock_hz;
    unsigned threads, cores, issue_gap;
    sim_class_cost cost[LRB_CLASS_COUNT]; /* that of `marker` is all 0: it is no instruction */
    struct {
        unsigned mispredict_penalty, btb_miss_penalty, btb_entries, btb_ways;
    } branch;
    struct {
        unsigned size_bytes, ways, line_bytes, latency, banks, load_bytes_per_cycle, store_bytes_per_cycle;
    } l1;
    struct {
        unsigned size_bytes, ways, line_bytes, latency, remote_latency, cycles_per_line_tenths;
    } l2;
    struct {
        unsigned latency, cycles_per_line_tenths, demand_misses_per_thread, prefetches_per_core, chip_bytes_per_cycle;
    } memory;
    sim_machine_value values[SIM_FIELDS];
} sim_machine;

/** Names of the built-in machines; *count of them. The strings live as long as the program. */
const char *const *sim_machine_names(size_t *count);

/**
 * Load a machine description and check it.
 *
 * @param name_or_path  a built-in machine's name, or the path of a description: it contains a '/' or ends in ".ini"
 * @param out           receives the machine, owned by the caller (sim_machine_destroy); NULL on failure
 *
 * Errors: BASE_ERR_USAGE no such name; BASE_ERR_INPUT a file that cannot be read, is over 1 MiB or is wrong, with
 * file, line and field; BASE_ERR_NOMEM.
 */
base_status sim_machine_load(const char *name_or_path, sim_machine **out, base_error *err);

/**
 * The same from text in memory.
 *
 * @param label  stands for the file in error messages
 * @param text   `size` bytes, need not end in 0; not kept
 */
base_status sim_machine_parse(const char *label, const char *text, size_t size, sim_machine **out, base_error *err);

/**
 * Override one field: "vector_alu.latency=5"; fields of [machine] need no prefix: "issue_gap=2". Its basis becomes
 * SIM_BASIS_OVERRIDE; defaults that follow it are made anew. What holds between fields is left to sim_machine_check,
 * so that several can be changed one after the other. On failure the machine is as before.
 *
 * Errors: BASE_ERR_USAGE no such field, or a value of the wrong kind or out of range.
 */
base_status sim_machine_set(sim_machine *machine, const char *assignment, base_error *err);

/**
 * Check what holds between fields (a cache's size is sets x ways x line, ...); call it after the last set.
 *
 * Errors: BASE_ERR_USAGE with the field at fault.
 */
base_status sim_machine_check(const sim_machine *machine, base_error *err);

/** Least distance between two lines that one of the machine's cores receives from memory, in tenths of a cycle: its own
 * limit, or its share of the chip's. */
unsigned sim_machine_memory_tenths(const sim_machine *machine);

/** Free *machine, which may be NULL, and set it to NULL. */
void sim_machine_destroy(sim_machine **machine);

/** Names the values of all fields, given or default; not the name, the description, the bases and the sources. */
uint64_t sim_machine_hash(const sim_machine *machine);

/* One field for reports. The strings belong to the machine or to the program. */
typedef struct sim_field_view {
    const char *section;  /* "machine", "vector_alu" */
    const char *key;      /* "latency" */
    const char *unit;     /* "cycles"; "" for pipes */
    const char *source;   /* for a default: what it follows */
    const char *used_by;  /* the models that read it */
    const char *sentence; /* what it means */
    sim_basis basis;
    bool given;     /* false: the default */
    char value[24]; /* as a description writes it: "4", "0.5", "UV" */
} sim_field_view;

/**
 * Describe field `number`; in the order of the numbers this is the canonical print of a machine.
 *
 * @param view  receives the field
 * @return      false if there is no such field (this class has none of this key); then *view is not written
 */
bool sim_machine_field(const sim_machine *machine, size_t number, sim_field_view *view);

#ifdef __cplusplus
}
#endif
#endif
