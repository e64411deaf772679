/* What events say, exactly: op, form, mask, distances, address; how they are batched, and how tiles begin again. */
#include <stdlib.h>

#include "tests/lrbni/case.h"

enum { KEPT = 1 << 18 };

/* A sink that keeps everything. */
typedef struct record {
    lrb_event *events;
    size_t count;
    uint32_t batches, largest, last;
} record;

static void keep(void *user, const lrb_event *events, uint32_t count)
{
    record *r = user;
    assert_true(r->count + count <= KEPT && count > 0);
    memcpy(r->events + r->count, events, count * sizeof *events);
    r->count += count;
    r->batches++;
    r->last = count;
    r->largest = count > r->largest ? count : r->largest;
}

typedef struct fixture {
    lrb_ctx *c;
    record record;
} fixture;

static int setup(void **state)
{
    fixture *f = calloc(1, sizeof *f);
    f->record.events = malloc(KEPT * sizeof *f->record.events);
    *state = f;
    return lrb_ctx_create(keep, &f->record, &f->c, NULL) == BASE_OK ? 0 : -1;
}

static int teardown(void **state)
{
    fixture *f = *state;
    lrb_ctx_destroy(&f->c);
    free(f->record.events);
    free(f);
    return 0;
}

static void check(const lrb_event *e, unsigned op, unsigned mask, unsigned s0, unsigned s1, unsigned s2, unsigned s3, uint32_t aux)
{
    if (e->op != op || e->mask != mask || e->src[0] != s0 || e->src[1] != s1 || e->src[2] != s2 || e->src[3] != s3 || e->aux != aux)
        fail_msg("event op %04x mask %04x src %u %u %u %u aux %x; expected op %04x mask %04x src %u %u %u %u aux %x", e->op, e->mask,
                 e->src[0], e->src[1], e->src[2], e->src[3], e->aux, op, mask, s0, s1, s2, s3, aux);
}

static void event__layout__sixteen_bytes(void **state)
{
    (void)state;
    assert_int_equal(sizeof(lrb_event), 16);
    assert_int_equal(offsetof(lrb_event, mask), 2);
    assert_int_equal(offsetof(lrb_event, src), 4);
    assert_int_equal(offsetof(lrb_event, aux), 12);
}

/* The comment of each op is its number in the stream. */
static void sequence__by_hand__every_field(void **state)
{
    fixture *f = *state;
    lrb_ctx *c = f->c;
    const uint32_t scratch = LRB_SCRATCH_ADDRESS;
    lrb_ctx_begin(c);
    lrb_r64 i = lrb_mov(c, lrb_imm(2));                                                          /* 0 */
    lrb_ptr p = lrb_lea(c, lrb_segment_at(c->scratch, 128), i, 8, 48);                           /* 1: 192 */
    lrb_v16f a = lrb_load_ps(c, lrb_at(p, 64));                                                  /* 2 */
    lrb_v16f b = lrb_load_1to16_ps(c, lrb_at_index(p, i, 4, -4));                                /* 3 */
    lrb_k16 k = lrb_cmple_ps_s3(c, a, lrb_swizzle_ps(b, LRB_CDAB));                              /* 4: all, 0 <= 0 */
    lrb_k16 some = lrb_kand(c, k, lrb_mask(0x0f0f));                                             /* 5 */
    lrb_v16f d = lrb_mask_madd231_ps_s3(c, a, some, b, lrb_full_ps(lrb_at(p, 128)));             /* 6 */
    d = lrb_mask_mul_ps_s3(c, d, lrb_mask(0x8001), d, lrb_4to16_ps(lrb_at(p, 16)));              /* 7 */
    lrb_phase(c, 77);                                                                            /* no number */
    lrb_mask_store_ps(c, lrb_at_index(p, i, 8, 48), some, d);                                    /* 8 */
    lrb_flags flags = lrb_kortest(c, k, some);                                                   /* 9 */
    uint32_t line = __LINE__ + 1;
    bool taken = lrb_jb(c, flags);                                                               /* 10: all ones */
    lrb_store32(c, lrb_at_index(p, i, 1, 0), lrb_kmov_rk(c, some));                              /* 11, 12 */
    lrb_v16i x = lrb_mask_sub_pi(c, lrb_castps_pi(d), some, lrb_castps_pi(a), lrb_castps_pi(b)); /* 13 */
    lrb_store_pi(c, lrb_at(p, 0), x);                                                            /* 14 */
    assert_true(taken);
    lrb_ctx_end(c);

    const lrb_event *e = f->record.events;
    assert_int_equal(f->record.count, 16);
    assert_int_equal(f->record.batches, 1);
    check(&e[0], LRB_OP_mov, 0xffff, 0, 0, 0, 0, 0);
    check(&e[1], LRB_OP_lea, 0xffff, 0, 1, 0, 0, 0);
    check(&e[2], LRB_OP_load_ps, 0xffff, 1, 0, 0, 0, scratch + 256);
    check(&e[3], LRB_OP_load_ps | LRB_FORM_4_BYTES, 0xffff, 2, 3, 0, 0, scratch + 196);
    check(&e[4], LRB_OP_cmple_ps | LRB_FORM_SWIZZLE, 0xffff, 2, 1, 0, 0, 0);
    check(&e[5], LRB_OP_kand, 0xffff, 1, 0, 0, 0, 0);
    check(&e[6], LRB_OP_madd231_ps | LRB_FORM_MEMORY, 0x0f0f, 3, 5, 1, 4, scratch + 320);
    check(&e[7], LRB_OP_mul_ps | LRB_FORM_MEMORY | LRB_FORM_16_BYTES, 0x8001, 1, 6, 0, 1, scratch + 208);
    check(&e[8], LRB_OP_phase, 0, 0, 0, 0, 0, 77);
    check(&e[9], LRB_OP_store_ps, 0x0f0f, 7, 8, 3, 1, scratch + 256);
    check(&e[10], LRB_OP_kortest, 0xffff, 5, 4, 0, 0, 0);
    check(&e[11], LRB_OP_jcc, 1, 1, 0, 0, 0, LRB_SOURCE << 16 | line);
    check(&e[12], LRB_OP_kmov_rk, 0xffff, 6, 0, 0, 0, 0);
    check(&e[13], LRB_OP_store32, 0xffff, 11, 12, 0, 1, scratch + 194);
    check(&e[14], LRB_OP_sub_pi, 0x0f0f, 11, 10, 8, 6, 0);
    check(&e[15], LRB_OP_store_pi, 0xffff, 13, 0, 0, 1, scratch + 192);
}

/* A sum and its carries come from one event, which reads destination, S3, write-mask and the carries in. */
static void carries__two_results__one_event_with_four_sources(void **state)
{
    fixture *f = *state;
    lrb_ctx *c = f->c;
    const uint32_t scratch = LRB_SCRATCH_ADDRESS;
    lrb_ctx_begin(c);
    lrb_ptr p = lrb_segment_at(c->scratch, 0);
    lrb_v16i a = lrb_load_pi(c, lrb_at(p, 0));                                                        /* 0 */
    lrb_v16i b = lrb_load_pi(c, lrb_at(p, 64));                                                       /* 1 */
    lrb_k16 k = lrb_test_pi(c, a, b), carry = lrb_mask(0);                                            /* 2 */
    lrb_v16i sum = lrb_addsetc_pi(c, a, b, &carry);                                                   /* 3 */
    sum = lrb_mask_adc_pi_s3(c, sum, k, carry, lrb_swizzle_pi(b, LRB_BADC), &carry);                  /* 4 */
    lrb_v16i blend = lrb_blendm_pi_s3(c, carry, sum, lrb_1to16_pi(lrb_at(p, 4)));                      /* 5 */
    lrb_v8q wide = lrb_mask_xor_pq(c, lrb_castpi_pq(a), lrb_mask(0xff81), lrb_castpi_pq(blend), lrb_castpi_pq(sum)); /* 6 */
    blend = lrb_alignd_pi(c, lrb_castpq_pi(wide), blend, 3);                                          /* 7 */
    assert_false(lrb_jkzd(c, lrb_mask(1)));                                                           /* 8 */
    assert_true(lrb_jkzd(c, lrb_kand(c, carry, lrb_mask(0))));                                        /* 9, 10 */
    lrb_ctx_end(c);

    const lrb_event *e = f->record.events;
    assert_int_equal(f->record.count, 11);
    check(&e[2], LRB_OP_test_pi, 0xffff, 2, 1, 0, 0, 0);
    check(&e[3], LRB_OP_addsetc_pi, 0xffff, 0, 2, 0, 3, 0);
    check(&e[4], LRB_OP_adc_pi | LRB_FORM_SWIZZLE, 0, 1, 3, 2, 1, 0);
    check(&e[5], LRB_OP_blendm_pi | LRB_FORM_MEMORY | LRB_FORM_4_BYTES, 0xffff, 1, 0, 1, 0, scratch + 4);
    check(&e[6], LRB_OP_xor_pq, 0xc003, 1, 2, 0, 6, 0);
    check(&e[7], LRB_OP_alignd_pi, 0xffff, 1, 2, 0, 0, 0);
    assert_int_equal(e[8].op, LRB_OP_jkzd);
    assert_int_equal(e[8].mask, 0);
    check(&e[9], LRB_OP_kand, 0xffff, 5, 0, 0, 0, 0);
    assert_int_equal(e[10].mask, 1);
    assert_int_equal(e[10].src[0], 1);
}

/* An untaken jump says so too, and an unconditional one is taken. */
static void branches__taken_or_not__in_the_mask(void **state)
{
    fixture *f = *state;
    lrb_ctx_begin(f->c);
    lrb_flags flags = lrb_cmp(f->c, lrb_imm(1), lrb_imm(2));
    assert_false(lrb_jz(f->c, flags));
    assert_true(lrb_jl(f->c, flags));
    lrb_jmp(f->c);
    lrb_ctx_end(f->c);
    assert_int_equal(f->record.count, 4);
    assert_int_equal(f->record.events[1].mask, 0);
    assert_int_equal(f->record.events[1].src[0], 1);
    assert_int_equal(f->record.events[2].mask, 1);
    assert_int_equal(f->record.events[2].src[0], 2);
    assert_int_equal(f->record.events[3].mask, 1);
    assert_int_equal(f->record.events[3].src[0], 0);
}

static void emit_ops(lrb_ctx *c, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        lrb_mov(c, lrb_imm(i));
}

/* Distances go up to LRB_FAR - 1; from there on, 'long ago'. */
static void distance__at_far__becomes_zero(void **state)
{
    fixture *f = *state;
    lrb_ctx_begin(f->c);
    lrb_r64 old = lrb_mov(f->c, lrb_imm(1));
    emit_ops(f->c, LRB_FAR - 3);
    lrb_popcnt(f->c, old); /* event LRB_FAR - 2 */
    lrb_popcnt(f->c, old);
    lrb_popcnt(f->c, old);
    lrb_ctx_end(f->c);
    assert_int_equal(f->record.events[LRB_FAR - 2].src[0], LRB_FAR - 2);
    assert_int_equal(f->record.events[LRB_FAR - 1].src[0], LRB_FAR - 1);
    assert_int_equal(f->record.events[LRB_FAR].src[0], 0);
    for (uint32_t i = 0; i < LRB_FAR - 2; i++)
        assert_int_equal(f->record.events[i].src[0], 0);
}

/* Markers take a place in the batch, but distances do not see them. */
static void markers__between_op_and_use__not_counted(void **state)
{
    fixture *f = *state;
    lrb_ctx_begin(f->c);
    lrb_r64 r = lrb_mov(f->c, lrb_imm(1));
    for (uint32_t i = 0; i < 3 * LRB_BATCH; i++)
        lrb_region(f->c, i);
    lrb_popcnt(f->c, r);
    lrb_ctx_end(f->c);
    assert_int_equal(f->record.count, 3 * LRB_BATCH + 2);
    for (uint32_t i = 0; i < 3 * LRB_BATCH; i++)
        check(&f->record.events[i + 1], LRB_OP_region, 0, 0, 0, 0, 0, i);
    check(&f->record.events[3 * LRB_BATCH + 1], LRB_OP_popcnt, 0xffff, 1, 0, 0, 0, 0);
}

/* Every count around one and two batches, markers among the ops: full batches, then the rest, and no empty one. */
static void batches__around_their_size__complete_and_in_order(void **state)
{
    fixture *f = *state;
    for (uint32_t count = LRB_BATCH - 2; count <= 2 * LRB_BATCH + 2; count += count == LRB_BATCH + 2 ? LRB_BATCH - 4 : 1) {
        f->record = (record){.events = f->record.events};
        lrb_ctx_begin(f->c);
        for (uint32_t i = 0; i < count; i++) {
            if (i % 7 == 3)
                lrb_phase(f->c, i);
            else
                lrb_store32(f->c, lrb_at(lrb_segment_at(f->c->scratch, 4 * i), 0), lrb_imm(i));
        }
        assert_int_equal(f->record.count, count / LRB_BATCH * LRB_BATCH);
        lrb_ctx_end(f->c);
        assert_int_equal(f->record.count, count);
        assert_int_equal(f->record.batches, (count + LRB_BATCH - 1) / LRB_BATCH);
        assert_true(f->record.largest <= LRB_BATCH);
        for (uint32_t i = 0; i < count; i++)
            assert_int_equal(f->record.events[i].aux, i % 7 == 3 ? i : LRB_SCRATCH_ADDRESS + 4 * i);
    }
}

/* A second tile of the same ops leaves the same events, however the first one ended. */
static void tiles__second_like_first__same_events(void **state)
{
    fixture *f = *state;
    size_t sizes[2] = {0};
    for (int tile = 0; tile < 2; tile++) {
        lrb_ctx_begin(f->c);
        assert_int_equal(f->c->next_event, LRB_FAR);
        assert_ptr_equal(f->c->free_event, f->c->events);
        lrb_r64 r = lrb_mov(f->c, lrb_imm(3));
        lrb_phase(f->c, 5);
        for (int i = 0; i < 700; i++)
            r = lrb_add(f->c, r, r);
        lrb_ctx_end(f->c);
        sizes[tile] = f->record.count - (tile ? sizes[0] : 0);
    }
    assert_int_equal(sizes[0], 702);
    assert_int_equal(sizes[1], 702);
    assert_memory_equal(f->record.events, f->record.events + 702, 702 * sizeof(lrb_event));
}

/* An empty tile leaves nothing. */
static void tiles__empty__no_batch(void **state)
{
    fixture *f = *state;
    lrb_ctx_begin(f->c);
    lrb_ctx_end(f->c);
    assert_int_equal(f->record.batches, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(event__layout__sixteen_bytes),
        cmocka_unit_test_setup_teardown(sequence__by_hand__every_field, setup, teardown),
        cmocka_unit_test_setup_teardown(carries__two_results__one_event_with_four_sources, setup, teardown),
        cmocka_unit_test_setup_teardown(branches__taken_or_not__in_the_mask, setup, teardown),
        cmocka_unit_test_setup_teardown(distance__at_far__becomes_zero, setup, teardown),
        cmocka_unit_test_setup_teardown(markers__between_op_and_use__not_counted, setup, teardown),
        cmocka_unit_test_setup_teardown(batches__around_their_size__complete_and_in_order, setup, teardown),
        cmocka_unit_test_setup_teardown(tiles__second_like_first__same_events, setup, teardown),
        cmocka_unit_test_setup_teardown(tiles__empty__no_batch, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
