/* Every intrinsic against the ops that it stands for: the same bits, the same origin, the same events. And the rules that no op
 * knows: how masks find their origins, what an address is. */
#include <setjmp.h>
#include <stdalign.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "tests/library/intrinsic_call.h"
#include "tests/lrbni/operands.h"

/* The tables of all families, which tests/library/meson.build names. */
#define FAMILY(name) extern const call_pair calls_##name[];
CALL_FAMILIES
#undef FAMILY

static const call_pair *const families[] = {
#define FAMILY(name) calls_##name,
    CALL_FAMILIES
#undef FAMILY
};
enum { FAMILIES = sizeof families / sizeof *families, ROUNDS = 24 };

static alignas(64) uint32_t memory[CALL_WORDS];

void note_i(call_side *s, lrb_v16i v)
{
    lanes_store_pi(s->lanes, v.lanes);
    s->from = v.from;
    s->has_from = true;
}

void note_f(call_side *s, lrb_v16f v) { note_i(s, lrb_castps_pi(v)); }
void note_q(call_side *s, lrb_v8q v) { note_i(s, lrb_castpq_pi(v)); }
void note_d(call_side *s, lrb_v8d v) { note_i(s, lrb_castpq_pi(lrb_castpd_pq(v))); }
void note_k(call_side *s, lrb_k16 k) { note_bits(s, k.bits); }

void note_bits(call_side *s, uint64_t bits)
{
    memset(s->lanes, 0, sizeof s->lanes);
    memcpy(s->lanes, &bits, sizeof bits);
    s->has_from = false;
}

void note_out(call_side *s, uint32_t bits) { s->noted_out = bits; }

/* The same operands on either side: vectors that loads made, masks that compares made. */
typedef struct call_input {
    uint32_t words[3][16], index[16], memory[CALL_WORDS], masks[2];
} call_input;

static void make_input(call_input *in, int round, base_random *random)
{
    for (int v = 0; v < 3; v++)
        for (int i = 0; i < 16; i++)
            in->words[v][i] = round < 8 ? boundary_bits[(16 * round + 5 * v + (v + 1) * i) % BOUNDARY_BITS] : random_bits(random);
    for (int i = 0; i < 16; i++)
        in->index[i] = (uint32_t)(base_random_bits(random) % 121) - 60;
    for (int i = 0; i < CALL_WORDS; i++)
        in->memory[i] = random_bits(random);
    in->masks[0] = mask_number(round % MASKS, random);
    in->masks[1] = round & 1 ? in->masks[0] ^ 0xffff : (uint32_t)base_random_bits(random) & 0xffff;
}

/* A mask register with these bits, made by a compare. */
static lrb_k16 make_mask(lrb_ctx *c, uint32_t bits)
{
    uint32_t lanes[16], zeros[16] = {0};
    for (int i = 0; i < 16; i++)
        lanes[i] = bits >> i & 1;
    lrb_v16i a = {.lanes = lanes_load_pi(lanes)}, b = {.lanes = lanes_load_pi(zeros)};
    return lrb_cmplt_pi(c, b, a);
}

static void fill_side(call_side *s, lrb_ctx *c, lrb_segment segment, const call_input *in)
{
    *s = (call_side){.c = c, .p = lrb_segment_at(segment, 0), .memory = memory};
    for (int v = 0; v < 3; v++) {
        memcpy(memory, in->words[v], 64);
        s->f[v] = lrb_load_ps(c, lrb_at(s->p, 0));
        s->i[v] = lrb_load_pi(c, lrb_at(s->p, 0));
        s->q[v] = lrb_castpi_pq(s->i[v]);
        s->d[v] = lrb_castpq_pd(s->q[v]);
    }
    memcpy(memory, in->index, 64);
    s->index = lrb_load_pi(c, lrb_at(s->p, 0));
    for (int k = 0; k < 2; k++)
        s->k[k] = make_mask(c, in->masks[k]);
    memcpy(memory, in->memory, sizeof memory);
}

/* Run one call on one side; what it did to memory is left there. */
static void run_side(call_side *s, void (*call)(call_side *), lrb_ctx *c, lrb_segment segment, const call_input *in)
{
    fill_side(s, c, segment, in);
    for (int k = 0; k < 2; k++)
        lanetrace_made(s->k[k]);
    call(s);
}

static void compare_sides(const call_pair *call, const call_side *a, const call_side *b, const uint32_t *memory_a)
{
    ptrdiff_t events = a->c->free_event - a->c->events;
    if (memcmp(a->lanes, b->lanes, sizeof a->lanes) != 0)
        for (int i = 0; i < 16; i++)
            if (a->lanes[i] != b->lanes[i])
                fail_msg("%s: word %d is %08x, with ops %08x", call->name, i, a->lanes[i], b->lanes[i]);
    if (a->noted_out != b->noted_out)
        fail_msg("%s: the mask beside it is %04x, with ops %04x", call->name, a->noted_out, b->noted_out);
    if (a->has_from && b->has_from && a->from != b->from)
        fail_msg("%s: made by event %u, with ops %u", call->name, a->from, b->from);
    if (memcmp(memory_a, memory, sizeof memory) != 0)
        fail_msg("%s: leaves other memory than ops do", call->name);
    if (events != b->c->free_event - b->c->events)
        fail_msg("%s: %td events, with ops %td", call->name, events, b->c->free_event - b->c->events);
    for (ptrdiff_t i = 0; i < events; i++) {
        const lrb_event *x = &a->c->events[i], *y = &b->c->events[i];
        if (memcmp(x, y, sizeof *x) != 0)
            fail_msg("%s: event %td is %s %04x mask %04x src %u %u %u %u aux %x, with ops %s %04x mask %04x src %u %u %u %u aux %x", call->name,
                     i, lrb_op_table[x->op & LRB_EVENT_ID].id, x->op, x->mask, x->src[0], x->src[1], x->src[2], x->src[3], x->aux,
                     lrb_op_table[y->op & LRB_EVENT_ID].id, y->op, y->mask, y->src[0], y->src[1], y->src[2], y->src[3], y->aux);
    }
}

static void check_call(const call_pair *call, lanetrace_session *s, lrb_segment segment, lrb_ctx *direct)
{
    base_random random = {.state = 7};
    call_input in;
    for (int round = 0; round < ROUNDS; round++) {
        call_side a, b;
        lrb_ctx *c;
        uint32_t memory_a[CALL_WORDS];
        make_input(&in, round, &random);
        assert_int_equal(lanetrace_begin(s, &c, NULL), BASE_OK);
        run_side(&a, call->intrinsic, c, segment, &in);
        memcpy(memory_a, memory, sizeof memory_a);
        lrb_ctx_begin(direct);
        run_side(&b, call->ops, direct, segment, &in);
        compare_sides(call, &a, &b, memory_a);
        assert_int_equal(lanetrace_end(s, NULL), BASE_OK);
    }
}

static void every_intrinsic__against_its_ops__same_bits_and_events(void **state)
{
    (void)state;
    lanetrace_session *s;
    lrb_segment segment;
    lrb_ctx *direct;
    int calls = 0;
    assert_int_equal(lanetrace_open(NULL, &s, NULL), BASE_OK);
    assert_int_equal(lanetrace_map(s, "memory", memory, sizeof memory, &segment, NULL), BASE_OK);
    assert_int_equal(lrb_ctx_create(NULL, NULL, &direct, NULL), BASE_OK);
    for (int f = 0; f < FAMILIES; f++)
        for (const call_pair *call = families[f]; call->name; call++, calls++)
            check_call(call, s, segment, direct);
    print_message("# %d calls\n", calls);
    lrb_ctx_destroy(&direct);
    lanetrace_close(&s);
}

static void every_intrinsic__of_the_list__is_called(void **state)
{
    (void)state;
    static const char *const names[] = {
#include <intrinsic_names.h> /* made from the list */
    };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        bool called = false;
        for (int f = 0; f < FAMILIES && !called; f++)
            for (const call_pair *call = families[f]; call->name && !called; call++)
                called = strcmp(call->name, names[i]) == 0;
        if (!called)
            fail_msg("%s is in the list, and no test calls it", names[i]);
    }
}

/* The newest mask of equal bits is the origin; none is, for bits that no op of the piece made lately. */
static void mask__by_value__newest_of_the_last_eight(void **state)
{
    (void)state;
    lanetrace_session *s;
    lrb_ctx *c;
    assert_int_equal(lanetrace_open(NULL, &s, NULL), BASE_OK);
    assert_int_equal(lanetrace_begin(s, &c, NULL), BASE_OK);
    assert_int_equal(lanetrace_k(0x00ff).from, 0);
    lrb_k16 first = make_mask(c, 0x00ff), second = make_mask(c, 0x00ff);
    lanetrace_made(first);
    assert_int_equal(lanetrace_k(0x00ff).from, first.from);
    lanetrace_made(second);
    assert_int_equal(lanetrace_k(0x00ff).from, second.from);
    assert_int_equal(lanetrace_k(0x00fe).from, 0);
    for (uint32_t i = 0; i < 7; i++)
        lanetrace_made(make_mask(c, i));
    assert_int_equal(lanetrace_k(0x00ff).from, second.from);
    lanetrace_made(make_mask(c, 7));
    assert_int_equal(lanetrace_k(0x00ff).from, 0);
    assert_int_equal(lanetrace_end(s, NULL), BASE_OK);
    assert_int_equal(lanetrace_begin(s, &c, NULL), BASE_OK);
    assert_int_equal(lanetrace_k(7).from, 0);
    assert_int_equal(lanetrace_end(s, NULL), BASE_OK);
    lanetrace_close(&s);
}

/* Unmapped memory: loads are distinct lines of their own, and the same line again is the same address. */
static void load__unmapped_memory__address_by_first_touch(void **state)
{
    (void)state;
    static alignas(64) float x[64];
    lanetrace_session *s;
    lrb_ctx *c;
    assert_int_equal(lanetrace_open(NULL, &s, NULL), BASE_OK);
    assert_int_equal(lanetrace_begin(s, &c, NULL), BASE_OK);
    (void)_mm512_load_ps(x + 32);
    (void)_mm512_load_ps(x);
    (void)_mm512_load_ps(x + 32);
    assert_int_equal(c->events[0].aux, 0x80000000);
    assert_int_equal(c->events[1].aux, 0x80000040);
    assert_int_equal(c->events[2].aux, 0x80000000);
    assert_int_equal(lanetrace_end(s, NULL), BASE_OK);
    lanetrace_close(&s);
}

/* C leaves the order of operands open; with the intrinsics it is from left to right. */
static void operands__that_are_ops__from_left_to_right(void **state)
{
    (void)state;
    static const unsigned expected[] = {LRB_OP_add_ps, LRB_OP_mul_ps, LRB_OP_cmplt_ps, LRB_OP_sub_ps, LRB_OP_sub_ps};
    lanetrace_session *s;
    lrb_ctx *c;
    assert_int_equal(lanetrace_open(NULL, &s, NULL), BASE_OK);
    assert_int_equal(lanetrace_begin(s, &c, NULL), BASE_OK);
    __m512 a = _mm512_undefined_ps();
    (void)_mm512_mask_sub_ps(_mm512_add_ps(a, a), _mm512_cmplt_ps_mask(_mm512_mul_ps(a, a), a), a, _mm512_sub_ps(a, a));
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++)
        assert_int_equal(c->events[i].op, expected[i]);
    assert_int_equal(lanetrace_end(s, NULL), BASE_OK);
    lanetrace_close(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_intrinsic__against_its_ops__same_bits_and_events),
        cmocka_unit_test(every_intrinsic__of_the_list__is_called),
        cmocka_unit_test(mask__by_value__newest_of_the_last_eight),
        cmocka_unit_test(operands__that_are_ops__from_left_to_right),
        cmocka_unit_test(load__unmapped_memory__address_by_first_touch),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
