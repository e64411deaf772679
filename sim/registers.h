/* Registers that a stream needs: how many values are live in each phase, and what does not fit.
 *
 * A value is made by one op and lives to the last op that reads it; a copy of it costs nothing, and an op may write its
 * result into the register of a source that it reads last. The pressure of an op is the number of values of a file that
 * are live before it or, with its result, after it, whichever is more.
 *
 * What does not fit is spilled by the furthest next use (Belady 1966): of the values in registers the one that is read
 * again last goes to scratch memory, once, and comes back when it is read. The policy looks ahead in this very stream,
 * with no regard to other paths through the kernel, so no compiler would spill less often.
 *
 * What no event tells: values made before the tile began (pointers to its data, constants, the mask of all lanes), which
 * are left out. Streams of annotated kernels (lrbni/annotate.h) tell all other uses; in other streams, uses LRB_FAR ops
 * after the making are not seen.
 */
#ifndef SIM_REGISTERS_H
#define SIM_REGISTERS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "lrbni/base/status.h"
#include "lrbni/event.h"
#include "lrbni/op_table.h"
#include "sim/issue.h"

typedef enum sim_register_file { SIM_FILE_VECTOR, SIM_FILE_MASK, SIM_FILE_GENERAL, SIM_FILES } sim_register_file;

/** "vector", "mask", "general". */
extern const char *const sim_file_names[SIM_FILES];

/* Registers of each file; 0: no limit. Of general ones the stream does not tell enough to spill. */
enum { SIM_VECTOR_REGISTERS = 32, SIM_MASK_REGISTERS = 8, SIM_MOST_REGISTERS = 64 };

/** {SIM_VECTOR_REGISTERS, SIM_MASK_REGISTERS, 0}. */
extern const unsigned sim_file_registers[SIM_FILES];

/** The file that holds what an op makes; SIM_FILES: it makes nothing that a register holds (flags, stores, jumps). */
sim_register_file sim_file_of(lrb_op_id id);

/* Of one phase and file; sums and maxima over tiles. */
typedef struct sim_pressure {
    uint64_t live;            /* pressure, summed over the ops of the phase */
    uint64_t max;             /* the largest pressure */
    uint64_t stores, reloads; /* spills */
} sim_pressure;

typedef struct sim_registers_stats {
    uint64_t ops[SIM_MAX_PHASES];
    sim_pressure pressure[SIM_MAX_PHASES][SIM_FILES];
    uint64_t tiles;
} sim_registers_stats;

/* A value goes from its register to memory, or comes back, before the op of this number issues. Values are named by their ops. */
typedef struct sim_spill {
    uint32_t before, value;
    sim_register_file file;
    bool store;
} sim_spill;

typedef struct sim_registers sim_registers;

/**
 * @param registers  of each file, 4 to SIM_MOST_REGISTERS, or 0: no limit
 *
 * Errors: BASE_ERR_NOMEM.
 */
base_status sim_registers_create(const unsigned registers[SIM_FILES], sim_registers **out, base_error *err);

/** Free; sets the pointer to NULL. */
void sim_registers_destroy(sim_registers **r);

/** Take the next events of a tile. Has the signature of lrb_event_sink; `r` is the sim_registers. Errors wait for the end. */
void sim_registers_events(void *r, const lrb_event *events, uint32_t count);

/** End the tile and add it to the stats. Errors: BASE_ERR_NOMEM. */
base_status sim_registers_end(sim_registers *r, base_error *err);

/** The spills of the tile that ended last, in their order; they hold until the next tile ends. */
const sim_spill *sim_registers_spills(const sim_registers *r, size_t *count);

/** The sums over all tiles that have ended. */
const sim_registers_stats *sim_registers_get(const sim_registers *r);

/** Add `from` to `to`. */
void sim_registers_stats_add(sim_registers_stats *to, const sim_registers_stats *from);

#endif
