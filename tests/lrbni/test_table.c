/* The table of ops: ids unique and small enough for events and the issue model, names in the right places, nothing empty,
 * shapes that agree with classes, rules and formulas. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "lrbni/event.h"
#include "lrbni/op_table.h"

enum { ISSUE_MODEL_OPS = 512 }; /* sim/issue.c sizes its tables with it */

static void ids__all__fit_and_differ(void **state)
{
    (void)state;
    assert_true(LRB_OP_COUNT <= LRB_EVENT_ID + 1);
    assert_true((int)LRB_OP_COUNT <= ISSUE_MODEL_OPS);
    assert_int_equal(LRB_EVENT_ID & (LRB_FORM_SWIZZLE | LRB_FORM_MEMORY | LRB_FORM_BYTES), 0);
    for (int i = 0; i < LRB_OP_COUNT; i++)
        for (int j = 0; j < i; j++)
            assert_string_not_equal(lrb_op_table[i].id, lrb_op_table[j].id);
}

/* The text of every row, by the row's own id, so that the table cannot be out of step with the enum. */
static void rows__text__of_the_same_id(void **state)
{
    (void)state;
#define OP(id_, mnemonic_, shape_, class, mask_, round_, chips_, source_, formula_)       \
    assert_string_equal(lrb_op_table[LRB_OP_##id_].id, #id_);                             \
    assert_string_equal(lrb_op_table[LRB_OP_##id_].mnemonic, mnemonic_);                  \
    assert_string_equal(lrb_shape_table[lrb_op_table[LRB_OP_##id_].shape].name, #shape_);      \
    assert_string_equal(lrb_cost_classes[lrb_op_table[LRB_OP_##id_].class_id].name, #class); \
    assert_true(lrb_op_table[LRB_OP_##id_].mask == LRB_MASK_##mask_);                     \
    assert_true(lrb_op_table[LRB_OP_##id_].round == LRB_ROUND_##round_);                  \
    assert_true(lrb_op_table[LRB_OP_##id_].chips == LRB_CHIPS_##chips_);
#include "lrbni/ops.def"
}

static void rows__text__not_empty(void **state)
{
    (void)state;
    for (int i = 0; i < LRB_OP_COUNT; i++) {
        const lrb_op_info *op = &lrb_op_table[i];
        if (!op->mnemonic[0] || !op->source[0] || !op->formula[0] || strpbrk(op->formula, "\"\n\t") || strlen(op->formula) > 100)
            fail_msg("%s: mnemonic '%s', source '%s', formula '%s'", op->id, op->mnemonic, op->source, op->formula);
        if (op->round == LRB_ROUND_ASSUMED)
            assert_non_null(strstr(op->source, "assumed"));
    }
}

/* A mnemonic stands for one shape and its integer or general twin: no two rows have both equal. */
static void rows__mnemonic_and_shape__unique(void **state)
{
    (void)state;
    for (int i = 0; i < LRB_OP_COUNT; i++)
        for (int j = 0; j < i; j++)
            if (lrb_op_table[i].shape == lrb_op_table[j].shape)
                assert_string_not_equal(lrb_op_table[i].mnemonic, lrb_op_table[j].mnemonic);
}

static void shapes__all__named_once_and_used(void **state)
{
    (void)state;
    for (int i = 0; i < LRB_SHAPE_COUNT; i++) {
        int used = 0;
        assert_non_null(lrb_shape_table[i].name);
        assert_int_equal(strspn(lrb_shape_table[i].reads, "peabm"), 4);
        assert_int_equal(strlen(lrb_shape_table[i].reads), 4);
        for (int j = 0; j < i; j++)
            assert_string_not_equal(lrb_shape_table[i].name, lrb_shape_table[j].name);
        for (int j = 0; j < LRB_OP_COUNT; j++)
            used += (int)lrb_op_table[j].shape == i;
        if (!used)
            fail_msg("no op has the shape %s", lrb_shape_table[i].name);
    }
}

/* Whether one of the operands of a shape's name, as "V_VV", is a vector; V counts in "VI" too. */
static int has(const char *shape, char operand)
{
    return strcmp(shape, "MARK") != 0 && strchr(shape, operand) != NULL;
}

/* The kind follows from the operands, and so does the mask rule; a mask that is an operand is no write-mask. */
static void shapes__operands__agree_with_kind_and_mask(void **state)
{
    (void)state;
    for (int i = 0; i < LRB_OP_COUNT; i++) {
        const char *shape = lrb_shape_table[lrb_op_table[i].shape].name;
        lrb_op_kind kind = lrb_op_kind_of((lrb_op_id)i), expected = LRB_KIND_SCALAR;
        lrb_mask_rule rule = LRB_MASK_NONE;
        if (strcmp(shape, "MARK") == 0)
            expected = LRB_KIND_MARKER;
        else if (shape[0] == 'B')
            expected = LRB_KIND_BRANCH;
        else if (has(shape, 'V'))
            expected = LRB_KIND_VECTOR;
        else if (has(shape, 'K'))
            expected = LRB_KIND_MASK;
        if (has(shape, 'V'))
            rule = strstr(shape, "_K") || strncmp(shape, "ML", 2) == 0 ? LRB_MASK_NONE
                   : shape[0] == 'V'                                   ? LRB_MASK_MERGE
                   : shape[0] == 'K'                                   ? LRB_MASK_ZERO
                                                                       : LRB_MASK_SELECT;
        if (kind != expected || lrb_op_table[i].mask != rule || lrb_op_is_memory((lrb_op_id)i) != (has(shape, 'M') && shape[0] != 'H'))
            fail_msg("%s of shape %s: kind %d, mask rule %d, memory %d", lrb_op_table[i].id, shape, kind, lrb_op_table[i].mask,
                     lrb_op_is_memory((lrb_op_id)i));
    }
}

/* What a shape does to memory follows from its letters, and what is an address or stored data from that. */
static void shapes__operands__agree_with_access_and_reads(void **state)
{
    (void)state;
    for (int i = 0; i < LRB_SHAPE_COUNT; i++) {
        const lrb_shape_info *shape = &lrb_shape_table[i];
        lrb_access expected = !has(shape->name, 'M') ? LRB_ACCESS_NONE
                              : shape->name[0] == 'M' ? LRB_ACCESS_STORE
                              : shape->name[0] == 'H' ? LRB_ACCESS_HINT
                                                      : LRB_ACCESS_LOAD;
        if (shape->access != expected || (memcmp(shape->reads, "aa", 2) == 0) != (expected != LRB_ACCESS_NONE))
            fail_msg("shape %s: access %d, reads %s", shape->name, shape->access, shape->reads);
    }
}

/* The hash names the table: it is the same in every run, and depends on text that can be checked here. */
static void hash__twice__same_and_not_empty(void **state)
{
    (void)state;
    assert_true(lrb_op_table_hash() == lrb_op_table_hash());
    assert_true(lrb_op_table_hash() != UINT64_C(0xcbf29ce484222325));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ids__all__fit_and_differ),
        cmocka_unit_test(rows__text__of_the_same_id),
        cmocka_unit_test(rows__text__not_empty),
        cmocka_unit_test(rows__mnemonic_and_shape__unique),
        cmocka_unit_test(shapes__all__named_once_and_used),
        cmocka_unit_test(shapes__operands__agree_with_kind_and_mask),
        cmocka_unit_test(shapes__operands__agree_with_access_and_reads),
        cmocka_unit_test(hash__twice__same_and_not_empty),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
