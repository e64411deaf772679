/* Simulated memory: blocks of host memory that have an address on the simulated machine.
 *
 * Addresses are what caches see. They depend on sizes and the order of mapping alone, never on a host pointer.
 * 32 bits: 4 GiB, of which the top 256 MiB hold the scratch of the hardware threads.
 */
#ifndef LRBNI_MEMORY_H
#define LRBNI_MEMORY_H

#include <stddef.h>
#include <stdint.h>

#include "lrbni/base/status.h"

#define LRB_SCRATCH_ADDRESS UINT32_C(0xf0000000)
#define LRB_SCRATCH_BYTES 65536u /* of one hardware thread */
#define LRB_PAGE_BYTES 4096u     /* segments start at multiples of it */

typedef struct lrb_segment {
    unsigned char *host; /* aligned to 64 bytes; not owned */
    uint32_t address;    /* simulated, a multiple of LRB_PAGE_BYTES */
    size_t size;         /* bytes */
} lrb_segment;

typedef struct lrb_memory {
    uint32_t next; /* address of the next segment */
} lrb_memory;

/** Simulated memory without any segments. */
lrb_memory lrb_memory_empty(void);

/**
 * Give `size` bytes of host memory a simulated address, behind all segments mapped before.
 *
 * @param name  of the segment, for the error
 * @param host  64-byte aligned, owned by the caller, who keeps it as long as the segment is used
 *
 * Errors: BASE_ERR_INPUT if the simulated memory is full.
 */
base_status lrb_memory_map(lrb_memory *memory, const char *name, void *host, size_t size, lrb_segment *out, base_error *err);

#endif
