/* Ids, names and properties of the ops in ops.def. */
#ifndef LRBNI_OP_TABLE_H
#define LRBNI_OP_TABLE_H

#include <stdint.h>

#include "lrbni/cost_classes.h"

typedef enum lrb_op_id {
#define OP(id, mnemonic, shape, class, mask, round, source, formula) LRB_OP_##id, /* LRB_OP_add_ps, */
#include "lrbni/ops.def"
    LRB_OP_COUNT
} lrb_op_id;

/* Operands of an op, result first: V 16 floats, VI 16 integers, K a mask, R a general register, P a pointer, F flags,
   M memory, I an immediate, B a branch. In ..V the last source may be S3: swizzled, or in memory. */
typedef enum lrb_shape {
    LRB_SHAPE_V_V,
    LRB_SHAPE_V_VV,
    LRB_SHAPE_V_VVV, /* the destination is a source as well */
    LRB_SHAPE_VI_V,
    LRB_SHAPE_VI_VV,
    LRB_SHAPE_V_VII,
    LRB_SHAPE_V_M,
    LRB_SHAPE_VI_M,
    LRB_SHAPE_M_V,
    LRB_SHAPE_M_VI,
    LRB_SHAPE_K_VV,
    LRB_SHAPE_KI_VV,
    LRB_SHAPE_K_KK,
    LRB_SHAPE_K_K,
    LRB_SHAPE_F_KK,
    LRB_SHAPE_K_R,
    LRB_SHAPE_R_K,
    LRB_SHAPE_R_R,
    LRB_SHAPE_R_RR,
    LRB_SHAPE_R_RI,
    LRB_SHAPE_P_PR,
    LRB_SHAPE_R_M,
    LRB_SHAPE_M_R,
    LRB_SHAPE_F_RR,
    LRB_SHAPE_B_F,
    LRB_SHAPE_B,
    LRB_SHAPE_MARK,
    LRB_SHAPE_COUNT
} lrb_shape;

typedef enum lrb_mask_rule { LRB_MASK_NONE, LRB_MASK_MERGE, LRB_MASK_ZERO, LRB_MASK_SELECT } lrb_mask_rule;
typedef enum lrb_round_rule { LRB_ROUND_EXACT, LRB_ROUND_RNE, LRB_ROUND_ASSUMED } lrb_round_rule;

typedef struct lrb_op_info {
    const char *id;       /* C name without the prefix; unique */
    const char *mnemonic; /* not unique: one instruction may have a float and an integer form here */
    lrb_shape shape;
    lrb_cost_class class_id;
    lrb_mask_rule mask;
    lrb_round_rule round;
    const char *source;
    const char *formula;
} lrb_op_info;

/** Properties of every op, by id. */
extern const lrb_op_info lrb_op_table[LRB_OP_COUNT];

/** "V_VV" and so on. */
extern const char *const lrb_shape_names[LRB_SHAPE_COUNT];

/* What kind of work an op is, for the totals in statistics ("ops": vector, scalar, memory). */
typedef enum lrb_op_kind { LRB_KIND_MARKER, LRB_KIND_VECTOR, LRB_KIND_MASK, LRB_KIND_SCALAR, LRB_KIND_BRANCH } lrb_op_kind;

/** Kind of an op: vector if it reads or writes a vector register. */
lrb_op_kind lrb_op_kind_of(lrb_op_id id);

/** Whether an op of this id always accesses memory (loads and stores; an S3 memory operand is told by the event). */
int lrb_op_is_memory(lrb_op_id id);

/** Hash of the whole table: which instruction set a recording or a baseline was made with. */
uint64_t lrb_op_table_hash(void);

#endif
