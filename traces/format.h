/* The parts of a trace file outside its tiles; docs/trace-format.md describes the whole. All numbers are little-endian.
 *
 *   head, text | tiles, in order | index: an entry for each tile | text | tail
 */
#ifndef TRACES_FORMAT_H
#define TRACES_FORMAT_H

#include <stdint.h>

#define TRACE_VERSION 1u
#define TRACE_MAGIC "\x89LTR\r\n\x1a\n"  /* 8 bytes; a transfer as text changes some of them */
#define TRACE_TAIL_MAGIC "LTR end\n"     /* the last 8 bytes of a whole file */
#define TRACE_MAGIC_BYTES 8
#define TRACE_MAX_TEXT_BYTES (UINT32_C(1) << 20)
#define TRACE_MAX_TILE_EVENTS (UINT32_MAX - 65536u) /* positions in a tile are 32 bits and begin at LRB_FAR */

typedef struct trace_head {
    char magic[TRACE_MAGIC_BYTES];
    uint32_t version;
    uint32_t text_bytes; /* of the text behind the head: JSON, what was run */
    uint64_t ops_hash;   /* lrb_op_table_hash: what the ids of ops mean */
    uint32_t tiles;
    uint32_t zero;
    uint64_t hash; /* base_hash of all before this, and of the text */
} trace_head;
_Static_assert(sizeof(trace_head) == 40, "as in the file");

typedef struct trace_entry {
    uint64_t offset; /* of the tile in the file; tiles lie one behind the other */
    uint32_t size, plain_size;
    uint32_t events;
    uint32_t zero;
    uint64_t hash; /* base_hash of its bytes in the file */
} trace_entry;
_Static_assert(sizeof(trace_entry) == 32, "as in the file");

typedef struct trace_tail {
    uint64_t index_offset;
    uint64_t events;     /* of all tiles */
    uint32_t text_bytes; /* of the text behind the index: JSON, what the run counted */
    uint32_t zero;
    uint64_t hash; /* base_hash of the index, of the text and of all before this */
    char magic[TRACE_MAGIC_BYTES];
} trace_tail;
_Static_assert(sizeof(trace_tail) == 40, "as in the file");

#endif
