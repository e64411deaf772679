/* References of the ops of eight doubles. */
#include "tests/lrbni/oracle.h"

static const uint64_t QUIET = 0x0008000000000000, SIGN = 0x8000000000000000;
static const ref_control START = {0};

static uint64_t fused(uint64_t x, uint64_t y, uint64_t z, bool negate_product, bool negate_addend)
{
    return ref_fused(true, START, (ref_sources){x, y, z, negate_product, negate_addend});
}

uint64_t ref_add_pd(uint64_t a, uint64_t b) { return ref_sum(true, START, a, b, false, false); }
uint64_t ref_addn_pd(uint64_t a, uint64_t b) { return ref_sum(true, START, a, b, true, true); }
uint64_t ref_sub_pd(uint64_t a, uint64_t b) { return ref_sum(true, START, a, b, false, true); }
uint64_t ref_subr_pd(uint64_t a, uint64_t b) { return ref_sum(true, START, b, a, false, true); }
uint64_t ref_mul_pd(uint64_t a, uint64_t b) { return ref_product(true, START, a, b); }

uint64_t ref_madd132_pd(uint64_t d, uint64_t a, uint64_t b) { return fused(d, b, a, false, false); }
uint64_t ref_madd213_pd(uint64_t d, uint64_t a, uint64_t b) { return fused(a, d, b, false, false); }
uint64_t ref_madd231_pd(uint64_t d, uint64_t a, uint64_t b) { return fused(a, b, d, false, false); }
uint64_t ref_msub132_pd(uint64_t d, uint64_t a, uint64_t b) { return fused(d, b, a, false, true); }
uint64_t ref_msub213_pd(uint64_t d, uint64_t a, uint64_t b) { return fused(a, d, b, false, true); }
uint64_t ref_msub231_pd(uint64_t d, uint64_t a, uint64_t b) { return fused(a, b, d, false, true); }
uint64_t ref_msubr132_pd(uint64_t d, uint64_t a, uint64_t b) { return fused(d, b, a, true, false); }
uint64_t ref_msubr213_pd(uint64_t d, uint64_t a, uint64_t b) { return fused(a, d, b, true, false); }
uint64_t ref_msubr231_pd(uint64_t d, uint64_t a, uint64_t b) { return fused(a, b, d, true, false); }
uint64_t ref_maddn132_pd(uint64_t d, uint64_t a, uint64_t b) { return fused(d, b, a, true, true); }
uint64_t ref_maddn213_pd(uint64_t d, uint64_t a, uint64_t b) { return fused(a, d, b, true, true); }
uint64_t ref_maddn231_pd(uint64_t d, uint64_t a, uint64_t b) { return fused(a, b, d, true, true); }
uint64_t ref_msubr23c1_pd(uint64_t a, uint64_t b) { return fused(a, b, 0x3ff0000000000000, true, false); }

/* Place of a double that is no NaN on the number line; both zeros are at 0. */
static int64_t place(uint64_t bits)
{
    int64_t magnitude = (int64_t)(bits & ~SIGN);
    return bits & SIGN ? -magnitude : magnitude;
}

static bool is_nan(uint64_t bits) { return ref_is_nan_lane(true, bits); }
static bool unordered(uint64_t a, uint64_t b) { return is_nan(a) || is_nan(b); }
static bool less(uint64_t a, uint64_t b) { return !unordered(a, b) && place(a) < place(b); }
static bool equal(uint64_t a, uint64_t b) { return !unordered(a, b) && place(a) == place(b); }

uint64_t ref_min_pd(uint64_t a, uint64_t b) { return less(a, b) ? a : b; }
uint64_t ref_max_pd(uint64_t a, uint64_t b) { return less(b, a) ? a : b; }

uint64_t ref_gmin_pd(uint64_t a, uint64_t b)
{
    if (unordered(a, b))
        return !is_nan(a) ? a : !is_nan(b) ? b : a | QUIET;
    return less(a, b) ? a : b;
}

uint64_t ref_gmax_pd(uint64_t a, uint64_t b)
{
    if (unordered(a, b))
        return ref_gmin_pd(a, b);
    return less(a, b) ? b : a;
}

uint64_t ref_blendm_pd(bool k, uint64_t a, uint64_t b) { return k ? b : a; }

bool ref_cmpeq_pd(uint64_t a, uint64_t b) { return equal(a, b); }
bool ref_cmplt_pd(uint64_t a, uint64_t b) { return less(a, b); }
bool ref_cmple_pd(uint64_t a, uint64_t b) { return less(a, b) || equal(a, b); }
bool ref_cmpunord_pd(uint64_t a, uint64_t b) { return unordered(a, b); }
bool ref_cmpneq_pd(uint64_t a, uint64_t b) { return !equal(a, b); }
bool ref_cmpnlt_pd(uint64_t a, uint64_t b) { return !less(a, b); }
bool ref_cmpnle_pd(uint64_t a, uint64_t b) { return !less(a, b) && !equal(a, b); }
bool ref_cmpord_pd(uint64_t a, uint64_t b) { return !unordered(a, b); }
