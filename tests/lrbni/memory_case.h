/* What tests of vector loads and stores share: one application of one op between two pages that nothing may touch.
 *
 * The first byte that the op may touch is the first of its page, or the last one the last, or it lies in the middle; alignment is asked of
 * simulated addresses alone, so that any access can be put there. Everything else follows from the references: where each lane's element
 * is, and what it becomes.
 */
#ifndef TESTS_LRBNI_MEMORY_CASE_H
#define TESTS_LRBNI_MEMORY_CASE_H

#include <stdlib.h>
#include <sys/mman.h>

#define LRB_CONTROL 1
#include "lrbni/conversions.h"
#include "tests/lrbni/case.h"

enum { MEMORY_PAGE = 4096, MEMORY_ADDRESS = 0x40000 };

/* Operands and results of one application; what the row's function needs. */
typedef struct memory_case {
    lrb_ctx *c;
    lrb_mem m;
    bool masked;
    uint32_t k; /* in, and out where the op changes it */
    int conversion;
    unsigned scale;
    ref_control control; /* state of the machine */
    alignas(64) uint32_t lanes[16], old[16], index[16];
    uint32_t out[16];
} memory_case;

typedef enum memory_kind { MEMORY_PLAIN, MEMORY_STREAM, MEMORY_GATHER } memory_kind;

/* An op, or one of its forms, to be driven. */
typedef struct memory_row {
    const char *name;
    unsigned op;
    memory_kind kind;
    bool store, wide;
    bool always_masked, never_masked;
    int period;      /* of plain loads: elements that are read; of plain stores: written */
    int conversions; /* 1: none */
    bool integer;    /* conversions are those of integers */
    void (*run)(memory_case *t);
    int (*plain)(int lane, ref_load_form form); /* the row's reference, by kind */
    int (*written)(int word);
    int (*stream)(uint32_t k, uint32_t address, int bytes, int lane);
    uint32_t (*execution)(uint32_t k, const uint32_t addresses[16]);
} memory_row;

/* The page between two others, and what it should become. */
typedef struct memory_block {
    unsigned char *guarded; /* three pages */
    unsigned char *page;
    unsigned char expected[MEMORY_PAGE];
    base_random random;
} memory_block;

static __attribute__((unused)) memory_block *memory_block_create(uint64_t seed)
{
    memory_block *b = calloc(1, sizeof *b);
    assert_non_null(b);
    b->guarded = mmap(NULL, 3 * MEMORY_PAGE, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    assert_true(b->guarded != MAP_FAILED);
    b->page = b->guarded + MEMORY_PAGE;
    assert_int_equal(mprotect(b->page, MEMORY_PAGE, PROT_READ | PROT_WRITE), 0);
    b->random.state = seed;
    for (int i = 0; i < MEMORY_PAGE; i += 4) {
        uint32_t word = random_bits(&b->random);
        memcpy(b->page + i, &word, 4);
    }
    memcpy(b->expected, b->page, MEMORY_PAGE);
    return b;
}

static __attribute__((unused)) void memory_block_free(memory_block *b)
{
    munmap(b->guarded, 3 * MEMORY_PAGE);
    free(b);
}

static unsigned memory_below(base_random *random, unsigned n) { return (unsigned)(base_random_bits(random) % n); }

/* A lane's bits from its element, and back, by the row's conversion. */
static uint64_t memory_up(const memory_row *row, int conversion, const unsigned char *element)
{
    uint64_t bits = 0;
    if (row->wide)
        memcpy(&bits, element, 8);
    else
        bits = row->integer ? ref_load_up_pi(conversion, element) : ref_load_up_ps(conversion, element);
    return bits;
}

static void memory_down(const memory_row *row, const memory_case *t, uint64_t lane, unsigned char *element)
{
    if (row->wide)
        memcpy(element, &lane, 8);
    else if (row->integer)
        ref_store_down_pi(t->conversion, (uint32_t)lane, element);
    else
        ref_down_in_state(t->control, t->conversion, (uint32_t)lane, element);
}

static int memory_element_bytes(const memory_row *row, int conversion)
{
    const lrb_conversion *table = row->store ? lrb_downs : lrb_ups;
    const int first = row->store ? LRB_DOWN_PS_COUNT : LRB_UP_PS_COUNT;
    return row->wide ? 8 : (int)table[row->integer ? first + conversion : conversion].bytes;
}

/* Where each lane's element is, from the op's address, and which lanes the op moves. */
typedef struct memory_places {
    int64_t at[16];
    uint32_t moved;
    int bytes;
} memory_places;

static memory_places memory_find(const memory_row *row, const memory_case *t)
{
    const int lanes = case_lanes(row->wide);
    const uint32_t k = (t->masked ? t->k : 0xffff) & ((1u << lanes) - 1);
    memory_places p = {.bytes = memory_element_bytes(row, t->conversion)};
    uint32_t addresses[16] = {0};
    for (int i = 0; i < lanes; i++) {
        const ref_load_form form = row->period == 1 ? REF_LOAD_1TO16 : row->period == 4 ? REF_LOAD_4TO16 : REF_LOAD_FULL;
        if (row->kind == MEMORY_PLAIN && row->store)
            p.at[i] = i < row->period ? p.bytes * (row->written ? row->written(i) : i) : REF_NOWHERE;
        else if (row->kind == MEMORY_PLAIN)
            p.at[i] = p.bytes * (row->plain ? row->plain(i, form) : ref_load_ps(i, form));
        else if (row->kind == MEMORY_STREAM)
            p.at[i] = row->stream(k, t->m.address, p.bytes, i);
        else
            p.at[i] = (int64_t)(int32_t)t->index[i] * (int64_t)t->scale;
        p.moved |= (uint32_t)((k >> i & 1) && (row->kind == MEMORY_GATHER || p.at[i] != REF_NOWHERE)) << i;
        addresses[i] = (uint32_t)((int64_t)t->m.address + p.at[i]);
    }
    if (row->kind == MEMORY_GATHER)
        p.moved = row->execution(k, addresses);
    return p;
}

/* A simulated address that the op may have: aligned to what it touches, or to an element. */
static uint32_t memory_address(const memory_row *row, int bytes, base_random *random)
{
    uint32_t align = row->kind == MEMORY_PLAIN ? (uint32_t)(bytes * (row->period ? row->period : case_lanes(row->wide))) : (uint32_t)bytes;
    return MEMORY_ADDRESS + memory_below(random, 256) / align * align;
}

/* Put the host's side of the access where its first or last byte is the page's, or in between. */
static void memory_place(memory_case *t, const memory_places *p, memory_block *b)
{
    int64_t first = INT32_MAX, last = INT32_MIN;
    for (int i = 0; i < 16; i++)
        if (p->moved >> i & 1) {
            first = p->at[i] < first ? p->at[i] : first;
            last = p->at[i] + p->bytes > last ? p->at[i] + p->bytes : last;
        }
    if (!p->moved)
        t->m.host = memory_below(&b->random, 2) ? b->guarded : NULL; /* no byte of it is there */
    else if (memory_below(&b->random, 3) == 0)
        t->m.host = b->page - first + memory_below(&b->random, (unsigned)(MEMORY_PAGE - (last - first))) / 8 * 8;
    else
        t->m.host = memory_below(&b->random, 2) ? b->page - first : b->page + MEMORY_PAGE - last;
}

/* What the page, or the register, should become. */
static void memory_expect(const memory_row *row, const memory_case *t, const memory_places *p, memory_block *b, uint32_t expected[16])
{
    memcpy(expected, t->old, 64);
    for (int i = 0; i < case_lanes(row->wide); i++) {
        if (!(p->moved >> i & 1))
            continue;
        unsigned char *element = b->expected + (t->m.host + p->at[i] - b->page);
        if (row->store)
            memory_down(row, t, case_get(t->lanes, row->wide, i), element);
        else
            case_set(expected, row->wide, i, memory_up(row, t->conversion, element));
    }
}

static uint32_t memory_words(bool wide, uint32_t lanes)
{
    uint32_t words = 0;
    for (int i = 0; i < 16; i++)
        words |= (lanes >> (wide ? i / 2 : i) & 1) << i;
    return words;
}

static void memory_check_event(const memory_row *row, const memory_case *t, const memory_places *p, uint32_t k)
{
    const lrb_event *e = &t->c->events[0];
    static const struct { int bytes; unsigned form; } forms[] = {
        {64, 0}, {32, LRB_FORM_32_BYTES}, {16, LRB_FORM_16_BYTES}, {8, LRB_FORM_8_BYTES}, {4, LRB_FORM_4_BYTES}, {0, LRB_FORM_4_BYTES}};
    const int touched = p->bytes * (row->period ? row->period : case_lanes(row->wide));
    unsigned form = p->moved ? LRB_FORM_LINE : 0;
    uint32_t address = t->m.address, mask = memory_words(row->wide, row->kind == MEMORY_PLAIN && !row->store ? k : p->moved);
    if (row->kind == MEMORY_PLAIN)
        for (int i = 5; i >= 0; i--)
            form = touched >= forms[i].bytes ? forms[i].form : form;
    if (row->kind == MEMORY_STREAM && row->stream(0xffff, MEMORY_ADDRESS + 64, p->bytes, 0) == REF_NOWHERE)
        address -= address % 64; /* a high part: the beginning of its line */
    if (row->kind == MEMORY_GATHER && p->moved)
        address += (uint32_t)p->at[__builtin_ctz(p->moved)];
    if (t->c->next_event != LRB_FAR + 1 || e->op != (row->op | form) || e->mask != mask || e->aux != address || e->src[0] || e->src[1] ||
        e->src[2] || e->src[3])
        fail_msg("%s: %u events, op %04x mask %04x aux %x, expected %04x %04x %x", row->name, t->c->next_event - LRB_FAR, e->op, e->mask,
                 e->aux, row->op | form, mask, address);
}

/* One application: against the references, and the whole page. */
static void memory_check(const memory_row *row, memory_case *t, memory_block *b)
{
    const uint32_t lanes = (1u << case_lanes(row->wide)) - 1, k = t->masked ? t->k : 0xffff;
    const memory_places p = memory_find(row, t);
    uint32_t expected[16];
    memory_place(t, &p, b);
    memory_expect(row, t, &p, b, expected);
    memcpy(t->out, t->old, sizeof t->out);
    lrb_ctx_begin(t->c);
    t->c->control = (lrb_control){(uint8_t)t->control.rounding, t->control.flush_to_zero, t->control.denormals_are_zero};
    row->run(t);
    if (memcmp(t->out, expected, sizeof expected) != 0)
        for (int i = 0; i < 16; i++)
            if (t->out[i] != expected[i])
                fail_msg("%s word %d, mask %04x, conversion %d, address %x: got %08x, expected %08x", row->name, i, k, t->conversion,
                         t->m.address, t->out[i], expected[i]);
    if (memcmp(b->page, b->expected, MEMORY_PAGE) != 0)
        for (int i = 0; i < MEMORY_PAGE; i++)
            if (b->page[i] != b->expected[i])
                fail_msg("%s mask %04x, conversion %d, address %x, host %d: byte %d is %02x, expected %02x", row->name, k, t->conversion,
                         t->m.address, (int)(t->m.host - b->page), i, b->page[i], b->expected[i]);
    if (row->kind == MEMORY_GATHER && t->k != (k & lanes & ~p.moved))
        fail_msg("%s leaves mask %04x of %04x, completed %04x", row->name, t->k, k, p.moved);
    memory_check_event(row, t, &p, k & lanes);
}

/* Indices within the page, near each other or not, some of them equal; negative ones too. */
static void memory_indices(memory_case *t, int bytes, base_random *random)
{
    const int span = memory_below(random, 2) ? 24 : 1000;
    t->scale = 1u << memory_below(random, 4);
    while (t->scale % (unsigned)bytes && bytes % (int)t->scale && memory_below(random, 2))
        t->scale = 1u << memory_below(random, 4);
    const int step = bytes > (int)t->scale ? bytes / (int)t->scale : 1; /* so that elements are aligned */
    const int most = 3000 / ((int)t->scale * step), places = span < most ? span : most;
    for (int i = 0; i < 16; i++)
        t->index[i] = (uint32_t)(step * ((int)memory_below(random, (unsigned)places) - places / 2));
}

static ref_control memory_state(base_random *random)
{
    const unsigned state = memory_below(random, 16);
    return (ref_control){.rounding = state % 4, .flush_to_zero = state / 4 % 2, .denormals_are_zero = state / 8};
}

/** Drive a row: every conversion under no mask and under every mask, `rounds` times, half of them in another state of the machine. */
static __attribute__((unused)) void memory_drive(lrb_ctx *c, const memory_row *row, int rounds)
{
    memory_block *b = memory_block_create(60 + row->op);
    memory_case t = {.c = c};
    for (int round = 0; round < rounds; round++)
        for (t.conversion = 0; t.conversion < row->conversions; t.conversion++)
            for (int mask = row->always_masked ? 0 : -1; mask < (row->never_masked ? 0 : MASKS); mask++) {
                const int bytes = memory_element_bytes(row, t.conversion);
                t.masked = mask >= 0;
                t.k = mask < 0 ? 0 : mask_number(mask, &b->random);
                t.control = memory_below(&b->random, 2) ? (ref_control){0} : memory_state(&b->random);
                for (int i = 0; i < 16; i++) {
                    t.lanes[i] = random_bits(&b->random);
                    t.old[i] = 0x7fa5c300u + (uint32_t)i;
                }
                t.m.address = memory_address(row, bytes, &b->random);
                memory_indices(&t, bytes, &b->random);
                memory_check(row, &t, b);
            }
    memory_block_free(b);
}

#endif
