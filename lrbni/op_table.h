/* Ids, names and properties of the ops in ops.def. */
#ifndef LRBNI_OP_TABLE_H
#define LRBNI_OP_TABLE_H

#include <stdint.h>

#include "lrbni/cost_classes.h"

typedef enum lrb_op_id {
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) LRB_OP_##id, /* LRB_OP_add_ps, */
#include "lrbni/ops.def"
    LRB_OP_COUNT
} lrb_op_id;

/* Which operands an op has (lrbni/shapes.def). */
typedef enum lrb_shape {
#define SHAPE(name, access, reads, sentence) LRB_SHAPE_##name, /* LRB_SHAPE_V_VV, */
#include "lrbni/shapes.def"
    LRB_SHAPE_COUNT
} lrb_shape;

typedef enum lrb_mask_rule { LRB_MASK_NONE, LRB_MASK_MERGE, LRB_MASK_ZERO, LRB_MASK_SELECT, LRB_MASK_COUNT } lrb_mask_rule;
typedef enum lrb_round_rule { LRB_ROUND_EXACT, LRB_ROUND_RNE, LRB_ROUND_MODE, LRB_ROUND_ASSUMED, LRB_ROUND_COUNT } lrb_round_rule;

/* Which chips have an op: the original Larrabee, Knights Corner, both, or only the published intrinsics. */
typedef enum lrb_chips { LRB_CHIPS_NONE, LRB_CHIPS_L, LRB_CHIPS_K, LRB_CHIPS_LK, LRB_CHIPS_LIB, LRB_CHIPS_COUNT } lrb_chips;

/* What an op does to memory at its event's address. */
typedef enum lrb_access {
    LRB_ACCESS_NONE,
    LRB_ACCESS_LOAD,
    LRB_ACCESS_STORE,
    LRB_ACCESS_HINT /* nothing but a word to the caches: prefetch or evict, by the op */
} lrb_access;

/* What a hint asks of the core; of gathers and scatters to come the ones that only announce them ask nothing. */
typedef enum lrb_hint {
    LRB_HINT_NONE,
    LRB_HINT_PREFETCH1, /* a line to the first level, ... */
    LRB_HINT_PREFETCH2, /* ... or to the second */
    LRB_HINT_EVICT1,
    LRB_HINT_EVICT2,
    LRB_HINT_DELAY
} lrb_hint;

/* What a shape says of its ops (lrbni/shapes.def). */
typedef struct lrb_shape_info {
    const char *name; /* "V_VV" */
    lrb_access access;
    const char *reads; /* four letters, one a source: p plain, e early, a address, b jump, m mask */
    const char *sentence;
} lrb_shape_info;

typedef struct lrb_op_info {
    const char *id;       /* C name without the prefix; unique */
    const char *mnemonic; /* not unique: one instruction may have a float and an integer form here */
    lrb_shape shape;
    lrb_cost_class class_id;
    lrb_mask_rule mask;
    lrb_round_rule round;
    lrb_chips chips;
    const char *source;
    const char *formula;
} lrb_op_info;

/** Properties of every op, by id. */
extern const lrb_op_info lrb_op_table[LRB_OP_COUNT];

/** What each shape says of its ops. */
extern const lrb_shape_info lrb_shape_table[LRB_SHAPE_COUNT];

/** "L", "K", "L K", "library", "". */
extern const char *const lrb_chips_names[LRB_CHIPS_COUNT];

/** "merge", "zero", "select", ""; "exact", "nearest", "mode", "assumed". */
extern const char *const lrb_mask_names[LRB_MASK_COUNT];
extern const char *const lrb_round_names[LRB_ROUND_COUNT];

/* What kind of work an op is, for the totals in statistics ("ops": vector, scalar, memory). */
typedef enum lrb_op_kind { LRB_KIND_MARKER, LRB_KIND_VECTOR, LRB_KIND_MASK, LRB_KIND_SCALAR, LRB_KIND_BRANCH } lrb_op_kind;

/** Kind of an op: vector if it reads or writes a vector register. */
lrb_op_kind lrb_op_kind_of(lrb_op_id id);

/** What an op of this id does to memory whatever its form (an S3 memory operand is told by the event). */
lrb_access lrb_op_access_of(lrb_op_id id);

/** What an op of this id asks of the core beyond its pipes. */
lrb_hint lrb_op_hint_of(lrb_op_id id);

/** Whether an op of this id always reads or writes memory. */
int lrb_op_is_memory(lrb_op_id id);

/** Hash of the whole table: which instruction set a recording or a baseline was made with. */
uint64_t lrb_op_table_hash(void);

#endif
