#include "lrbni/op_table.h"

#include <string.h>

#include "lrbni/base/hash.h"

const lrb_op_info lrb_op_table[LRB_OP_COUNT] = {
/* {"add_ps", "vaddps", LRB_SHAPE_V_VV, LRB_CLASS_vector_alu, LRB_MASK_MERGE, LRB_ROUND_RNE, LRB_CHIPS_LK, "L1OM ...", "d[i] = ..."}, */
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula)                          \
    {#id, mnemonic, LRB_SHAPE_##shape, LRB_CLASS_##class, LRB_MASK_##mask, LRB_ROUND_##round, LRB_CHIPS_##chips, \
     source, formula},
#include "lrbni/ops.def"
};

const lrb_shape_info lrb_shape_table[LRB_SHAPE_COUNT] = {
#define SHAPE(name, access, reads, sentence) {#name, LRB_ACCESS_##access, reads, sentence}, /* {"V_M", LRB_ACCESS_LOAD, "aapp", "16 ..."}, */
#include "lrbni/shapes.def"
};

const char *const lrb_chips_names[LRB_CHIPS_COUNT] = {"", "L", "K", "L K", "library"};

const char *const lrb_mask_names[LRB_MASK_COUNT] = {
    [LRB_MASK_NONE] = "", [LRB_MASK_MERGE] = "merge", [LRB_MASK_ZERO] = "zero", [LRB_MASK_SELECT] = "select"};

const char *const lrb_round_names[LRB_ROUND_COUNT] = {
    [LRB_ROUND_EXACT] = "exact", [LRB_ROUND_RNE] = "nearest", [LRB_ROUND_MODE] = "mode", [LRB_ROUND_ASSUMED] = "assumed"};

lrb_op_kind lrb_op_kind_of(lrb_op_id id)
{
    switch (lrb_op_table[id].class_id) {
    case LRB_CLASS_marker:
        return LRB_KIND_MARKER;
    case LRB_CLASS_vector_alu:
    case LRB_CLASS_vector_compare:
    case LRB_CLASS_vector_permute:
    case LRB_CLASS_vector_convert:
    case LRB_CLASS_vector_lookup:
    case LRB_CLASS_vector_transcendental:
    case LRB_CLASS_vector_load:
    case LRB_CLASS_vector_load_convert:
    case LRB_CLASS_vector_store:
    case LRB_CLASS_vector_gather:
    case LRB_CLASS_vector_scatter:
        return LRB_KIND_VECTOR;
    case LRB_CLASS_mask_alu:
    case LRB_CLASS_mask_move:
    case LRB_CLASS_mask_test:
        return LRB_KIND_MASK;
    case LRB_CLASS_branch:
        return LRB_KIND_BRANCH;
    default:
        return LRB_KIND_SCALAR;
    }
}

lrb_access lrb_op_access_of(lrb_op_id id)
{
    return lrb_shape_table[lrb_op_table[id].shape].access;
}

lrb_hint lrb_op_hint_of(lrb_op_id id)
{
    switch ((int)id) {
    case LRB_OP_prefetch1:
    case LRB_OP_prefetch1_ex:
    case LRB_OP_prefetch1_nt:
    case LRB_OP_prefetch1_ex_nt:
    case LRB_OP_prefetch1_miss:
    case LRB_OP_gatherpfd:
    case LRB_OP_scatterpfd:
        return LRB_HINT_PREFETCH1;
    case LRB_OP_prefetch2:
    case LRB_OP_prefetch2_ex:
    case LRB_OP_prefetch2_nt:
    case LRB_OP_prefetch2_ex_nt:
    case LRB_OP_gatherpf2d:
    case LRB_OP_scatterpf2d:
        return LRB_HINT_PREFETCH2;
    case LRB_OP_evict1:
        return LRB_HINT_EVICT1;
    case LRB_OP_evict2:
        return LRB_HINT_EVICT2;
    case LRB_OP_delay:
        return LRB_HINT_DELAY;
    default:
        return LRB_HINT_NONE;
    }
}

int lrb_op_is_memory(lrb_op_id id)
{
    lrb_access access = lrb_op_access_of(id);
    return access == LRB_ACCESS_LOAD || access == LRB_ACCESS_STORE;
}

uint64_t lrb_op_table_hash(void)
{
    uint64_t hash = BASE_HASH_START;
    for (int i = 0; i < LRB_OP_COUNT; i++) {
        const lrb_op_info *op = &lrb_op_table[i];
        hash = base_hash(hash, op->id, strlen(op->id) + 1);
        hash = base_hash(hash, op->mnemonic, strlen(op->mnemonic) + 1);
        hash = base_hash(hash, op->formula, strlen(op->formula) + 1);
        const unsigned char properties[] = {(unsigned char)op->shape, (unsigned char)op->class_id, (unsigned char)op->mask,
                                            (unsigned char)op->round, (unsigned char)op->chips};
        hash = base_hash(hash, properties, sizeof properties);
    }
    return hash;
}
