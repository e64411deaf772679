#include "tests/sim/random_stream.h"

#include <string.h>

#include "lrbni/memory.h"
#include "lrbni/op_table.h"

/* What the ops of a tile have in common. */
typedef struct flavour {
    uint16_t ops[LRB_OP_COUNT]; /* to draw from */
    unsigned op_count;
    unsigned near, far;  /* of 16 sources so many are within 4 ops, so many anywhere; the rest are none */
    unsigned markers;    /* of 256 events */
    unsigned lines;      /* of memory that are in use */
    uint32_t line_step;  /* between them; 64 lines apart they share a place in the table of stores */
    uint32_t first_line;
} flavour;

static unsigned below(base_random *random, unsigned n)
{
    return (unsigned)(base_random_bits(random) % n);
}

static flavour random_flavour(base_random *random)
{
    flavour f = {.op_count = below(random, 3) ? 40 : 1 + below(random, 6)};
    for (unsigned i = 0; i < f.op_count; i++)
        do
            f.ops[i] = (uint16_t)below(random, LRB_OP_COUNT);
        while (lrb_op_table[f.ops[i]].class_id == LRB_CLASS_marker);
    if (below(random, 4) == 0)
        for (unsigned i = 0; i < f.op_count; i += 2) /* a tile of loads and stores */
            do
                f.ops[i] = (uint16_t)below(random, LRB_OP_COUNT);
            while (!lrb_op_is_memory((lrb_op_id)f.ops[i]));
    f.near = below(random, 9);
    f.far = below(random, 5);
    f.markers = below(random, 3) ? below(random, 8) : below(random, 60);
    f.lines = 1 + below(random, below(random, 2) ? 3 : 200);
    f.line_step = below(random, 2) ? 1 : 16u << below(random, 4);
    f.first_line = below(random, 2) ? below(random, 4) : (uint32_t)base_random_bits(random) / 64;
    if (below(random, 4) == 0)
        f.first_line = LRB_SCRATCH_ADDRESS / 64 - 2; /* into a thread's own memory */
    return f;
}

static uint16_t random_distance(base_random *random, const flavour *f)
{
    unsigned which = below(random, 16);
    if (which < f->near)
        return (uint16_t)(1 + below(random, 4));
    if (which < f->near + f->far)
        return (uint16_t)(1 + below(random, 1u << (1 + below(random, 16))) % 65535);
    return 0;
}

/* The last operand is a vector: V, VI, VD; in memory only where the shape does not load or store by itself. */
static int takes_s3(lrb_shape shape)
{
    const char *name = lrb_shape_table[shape].name;
    size_t length = strlen(name);
    return lrb_shape_table[shape].access == LRB_ACCESS_NONE && length > 2 &&
           (strchr("VX", name[length - 1]) || strchr("VX", name[length - 2]));
}

/* A form that the op can have. */
static unsigned random_form(base_random *random, lrb_shape shape)
{
    static const unsigned broadcasts[] = {0, LRB_FORM_4_BYTES, LRB_FORM_8_BYTES, LRB_FORM_16_BYTES, LRB_FORM_32_BYTES};
    unsigned broadcast = broadcasts[below(random, 5)];
    const char *name = lrb_shape_table[shape].name;
    if (shape == LRB_SHAPE_R_M || shape == LRB_SHAPE_M_R)
        return below(random, 2) ? LRB_FORM_8_BYTES : 0;
    if (strstr(name, "MS") || strstr(name, "MVI"))
        return below(random, 4) ? LRB_FORM_LINE : 0;
    if (lrb_shape_table[shape].access == LRB_ACCESS_LOAD || lrb_shape_table[shape].access == LRB_ACCESS_STORE)
        return broadcast;
    if (!takes_s3(shape))
        return LRB_FORM_REGISTER;
    switch (below(random, 3)) {
    case 0:
        return LRB_FORM_REGISTER;
    case 1:
        return LRB_FORM_SWIZZLE;
    default:
        return LRB_FORM_MEMORY | broadcast;
    }
}

static uint32_t random_address(base_random *random, const flavour *f, unsigned bytes)
{
    uint32_t line = f->first_line + f->line_step * below(random, f->lines);
    return line * 64 + below(random, 64 / bytes) * bytes;
}

static lrb_event random_op(base_random *random, const flavour *f)
{
    unsigned id = f->ops[below(random, f->op_count)];
    lrb_shape shape = lrb_op_table[id].shape;
    unsigned form = random_form(random, shape);
    lrb_event e = {.op = (uint16_t)(id | form), .mask = 0xffff};
    for (int i = 0; i < 4; i++)
        e.src[i] = random_distance(random, f);
    int is_vector = lrb_op_kind_of((lrb_op_id)id) == LRB_KIND_VECTOR;
    if (is_vector && below(random, 3) == 0)
        e.mask = (uint16_t)(below(random, 2) ? base_random_bits(random) : 1u << below(random, 16));
    if (lrb_op_access_of((lrb_op_id)id) != LRB_ACCESS_NONE || form & LRB_FORM_MEMORY) {
        unsigned bytes = form == LRB_FORM_LINE ? 1 : lrb_form_bytes(form) ? lrb_form_bytes(form) : is_vector ? 64 : 2;
        e.aux = random_address(random, f, bytes);
    } else if (lrb_op_table[id].class_id == LRB_CLASS_branch) {
        e.mask = (uint16_t)below(random, 2);
        e.aux = below(random, below(random, 2) ? 1000 : 8);
    } else if (id == LRB_OP_delay) {
        e.aux = below(random, below(random, 4) ? 20 : 300);
    }
    return e;
}

void random_stream(base_random *random, lrb_event *events, uint32_t count)
{
    static const uint16_t markers[] = {LRB_OP_phase, LRB_OP_region, LRB_OP_line};
    flavour f = random_flavour(random);
    for (uint32_t i = 0; i < count; i++) {
        if (below(random, 256) < f.markers)
            events[i] = (lrb_event){.op = markers[below(random, 3)], .aux = below(random, 20)};
        else
            events[i] = random_op(random, &f);
    }
}
