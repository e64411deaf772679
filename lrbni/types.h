/* The values that ops take and return. At LRB_RECORD each also knows which event made it. */
#ifndef LRBNI_TYPES_H
#define LRBNI_TYPES_H

#include <stdbool.h>
#include <stdint.h>

#include "lrbni/ctx.h"
#include "lrbni/host/lanes.h"

#ifndef LRB_LEVEL
#error "define LRB_LEVEL as LRB_NATIVE (0), LRB_COUNT (1) or LRB_RECORD (2) when compiling a kernel"
#endif

#define LRB_INLINE static inline __attribute__((always_inline))

#if LRB_LEVEL == LRB_RECORD
#define LRB_ORIGIN uint32_t from; /* id of the event that made the value; 0: made before the stream began */
#else
#define LRB_ORIGIN
#endif

/* 16 floats in a vector register. */
typedef struct lrb_v16f {
    lrb_f32x16 lanes;
    LRB_ORIGIN
} lrb_v16f;

/* 16 integers of 32 bits in a vector register. */
typedef struct lrb_v16i {
    lrb_i32x16 lanes;
    LRB_ORIGIN
} lrb_v16i;

/* 8 doubles in a vector register; bits 7 to 0 of a mask are theirs, the others are not looked at (ISAM 2.1.2). */
typedef struct lrb_v8d {
    lrb_f64x8 lanes;
    LRB_ORIGIN
} lrb_v8d;

/* 8 integers of 64 bits in a vector register. */
typedef struct lrb_v8q {
    lrb_i64x8 lanes;
    LRB_ORIGIN
} lrb_v8q;

/* A mask register: bit i is lane i, bits 16 and up are 0. */
typedef struct lrb_k16 {
    uint32_t bits;
    LRB_ORIGIN
} lrb_k16;

/* A general register of 64 bits. */
typedef struct lrb_r64 {
    uint64_t value;
    LRB_ORIGIN
} lrb_r64;

/* The flags that a compare leaves for one conditional jump. */
typedef struct lrb_flags {
    bool zero, carry, less; /* equal, unsigned below (kortest: all ones), signed less */
    LRB_ORIGIN
} lrb_flags;

/* A general register that holds an address: of the host for the data, simulated for the caches. */
typedef struct lrb_ptr {
    unsigned char *host;
    uint32_t address;
    LRB_ORIGIN
} lrb_ptr;

/* A memory operand: base register, index register (or none) and displacement, added up; addressing is part of the op. */
typedef struct lrb_mem {
    unsigned char *host;
    uint32_t address;
#if LRB_LEVEL == LRB_RECORD
    uint32_t base_from, index_from;
#endif
} lrb_mem;

/* The operand that the ISA calls S3: the last source, in a register, swizzled on the way, or in memory. */
#define LRB_S3(name, type)                      \
    typedef struct name {                       \
        type lanes;                             \
        uint32_t address;                       \
        uint16_t form; /* LRB_FORM_ bits */     \
        LRB_ORIGIN                              \
    } name
LRB_S3(lrb_s3f, lrb_f32x16);
LRB_S3(lrb_s3i, lrb_i32x16);
LRB_S3(lrb_s3d, lrb_f64x8);
LRB_S3(lrb_s3q, lrb_i64x8);
#undef LRB_S3

#if LRB_LEVEL == LRB_RECORD
#define LRB_FROM(value) ((value).from)
#define LRB_SET_FROM(value, id) ((value).from = (id))
#else
#define LRB_FROM(value) ((void)(value), 0u)
#define LRB_SET_FROM(value, id) ((void)(value), (void)(id))
#endif

#endif
