/* References of the integer lanes, of permutes and of bit-fields: with wider integers, by division, or one bit after the other. */
#include "tests/lrbni/oracle.h"

static const int64_t two32 = INT64_C(1) << 32;

/* Two's complement value of 32 bits, and the 32 bits of a value. */
static int64_t value_of(uint32_t a) { return (int64_t)a - (a >= 0x80000000 ? two32 : 0); }
static uint32_t bits_of(int64_t value) { return (uint32_t)(((value % two32) + two32) % two32); }

/* Quotient by 2^32, rounded down. */
static int64_t high_part(int64_t value) { return (value - (int64_t)bits_of(value)) / two32; }

/* Arithmetic */
uint32_t ref_subr_pi(uint32_t a, uint32_t b) { return bits_of((int64_t)b - a); }
uint32_t ref_mull_pi(uint32_t a, uint32_t b) { return bits_of(value_of(a) * value_of(b)); }
uint32_t ref_mulh_pi(uint32_t a, uint32_t b) { return bits_of(high_part(value_of(a) * value_of(b))); }

/* Schoolbook product of digits of base 2^16. */
uint32_t ref_mulh_pu(uint32_t a, uint32_t b)
{
    uint32_t a0 = a % 65536, a1 = a / 65536, b0 = b % 65536, b1 = b / 65536;
    uint64_t middle = (uint64_t)a1 * b0 + (uint64_t)a0 * b1 + (uint64_t)a0 * b0 / 65536;
    return (uint32_t)((uint64_t)a1 * b1 + middle / 65536);
}

uint32_t ref_madd231_pi(uint32_t d, uint32_t a, uint32_t b) { return bits_of((int64_t)ref_mull_pi(b, a) + d); }

/* Element 1 is the factor, element 0 the addend. */
uint32_t ref_madd233_pi(uint32_t a, const uint32_t group[4]) { return ref_madd231_pi(group[0], a, group[1]); }

uint32_t ref_clampz_pi(uint32_t a, uint32_t b)
{
    if (value_of(a) < 0 || value_of(b) < 0)
        return 0;
    return value_of(a) > value_of(b) ? b : a;
}

uint32_t ref_min_pi(uint32_t a, uint32_t b) { return value_of(a) - value_of(b) > 0 ? b : a; }
uint32_t ref_max_pi(uint32_t a, uint32_t b) { return value_of(a) - value_of(b) > 0 ? a : b; }
uint32_t ref_min_pu(uint32_t a, uint32_t b) { return (int64_t)a - (int64_t)b > 0 ? b : a; }
uint32_t ref_max_pu(uint32_t a, uint32_t b) { return (int64_t)a - (int64_t)b > 0 ? a : b; }

/* Sums: what does not fit is the carry, a difference below 0 the borrow. */
static ref_carry sum_of(int64_t value) { return (ref_carry){.value = bits_of(value), .bit = value < 0 || value >= two32}; }

ref_carry ref_adc_pi(uint32_t d, bool k, uint32_t b) { return sum_of((int64_t)d + b + (k ? 1 : 0)); }
ref_carry ref_sbb_pi(uint32_t d, bool k, uint32_t b) { return sum_of((int64_t)d - b - (k ? 1 : 0)); }
ref_carry ref_sbbr_pi(uint32_t d, bool k, uint32_t b) { return sum_of((int64_t)b - d - (k ? 1 : 0)); }
ref_carry ref_addsetc_pi(uint32_t d, uint32_t b) { return sum_of((int64_t)d + b); }
ref_carry ref_subsetb_pi(uint32_t d, uint32_t b) { return sum_of((int64_t)d - b); }
ref_carry ref_subrsetb_pi(uint32_t d, uint32_t b) { return sum_of((int64_t)b - d); }

ref_carry ref_addsets_pi(uint32_t a, uint32_t b)
{
    uint32_t sum = bits_of(value_of(a) + value_of(b));
    return (ref_carry){.value = sum, .bit = value_of(sum) < 0};
}

/* Logic: every bit of the result from the two bits there. */
static uint64_t bit_at(uint64_t a, unsigned i) { return a / (UINT64_C(1) << i) % 2; }

static uint64_t logic(uint64_t a, uint64_t b, const char truth[4])
{
    uint64_t result = 0;
    for (unsigned i = 0; i < 64; i++)
        result += truth[2 * bit_at(a, i) + bit_at(b, i)] == '1' ? UINT64_C(1) << i : 0;
    return result;
}

uint32_t ref_andn_pi(uint32_t a, uint32_t b) { return (uint32_t)logic(a, b, "0100"); }
uint64_t ref_and_pq(uint64_t a, uint64_t b) { return logic(a, b, "0001"); }
uint64_t ref_or_pq(uint64_t a, uint64_t b) { return logic(a, b, "0111"); }
uint64_t ref_xor_pq(uint64_t a, uint64_t b) { return logic(a, b, "0110"); }
uint64_t ref_andn_pq(uint64_t a, uint64_t b) { return logic(a, b, "0100"); }
uint64_t ref_mov_pq(uint64_t b) { return b; }
uint32_t ref_blendm_pi(bool k, uint32_t a, uint32_t b) { return k ? b : a; }
uint64_t ref_blendm_pq(bool k, uint64_t a, uint64_t b) { return k ? b : a; }

/* Shifts: one place after the other. */
static uint32_t shift_left(uint32_t a, uint32_t n)
{
    for (; n > 0 && a; n--)
        a = bits_of((int64_t)a * 2);
    return a;
}

static uint32_t shift_right(uint32_t a, uint32_t n)
{
    for (; n > 0 && a; n--)
        a /= 2;
    return a;
}

static uint32_t shift_signed(uint32_t a, uint32_t n)
{
    for (n = n > 32 ? 32 : n; n > 0; n--)
        a = a / 2 + (a & 0x80000000);
    return a;
}

uint32_t ref_sll_pi(uint32_t a, uint32_t b) { return shift_left(a, b % 32); }
uint32_t ref_srl_pi(uint32_t a, uint32_t b) { return shift_right(a, b % 32); }
uint32_t ref_sra_pi(uint32_t a, uint32_t b) { return shift_signed(a, b % 32); }
uint32_t ref_sllv_pi(uint32_t a, uint32_t b) { return shift_left(a, b); }
uint32_t ref_srlv_pi(uint32_t a, uint32_t b) { return shift_right(a, b); }
uint32_t ref_srav_pi(uint32_t a, uint32_t b) { return shift_signed(a, b); }
uint32_t ref_slli_pi(uint32_t b, unsigned n) { return shift_left(b, n); }
uint32_t ref_srli_pi(uint32_t b, unsigned n) { return shift_right(b, n); }
uint32_t ref_srai_pi(uint32_t b, unsigned n) { return shift_signed(b, n); }

/* Bits dealt out: position p of the result is the next bit of b if p is a multiple of `period`, else the next one of a. */
static uint64_t deal(uint64_t a, uint64_t b, unsigned period, unsigned width)
{
    uint64_t result = 0;
    unsigned next_a = 0, next_b = 0;
    for (unsigned p = 0; p < width; p++)
        if (p % period == 0 ? bit_at(b, next_b++) : bit_at(a, next_a++))
            result |= UINT64_C(1) << p;
    return result;
}

uint32_t ref_bitinterleave11_pi(uint32_t a, uint32_t b) { return (uint32_t)deal(a, b, 2, 32); }
uint32_t ref_bitinterleave21_pi(uint32_t a, uint32_t b) { return (uint32_t)deal(a, b, 3, 32); }
uint64_t ref_bitinterleave11(uint64_t a, uint64_t b) { return deal(a, b, 2, 64); }
uint64_t ref_bitinterleave21(uint64_t a, uint64_t b) { return deal(a, b, 3, 64); }

/* Bit p of the field comes from n places below, going round. */
static uint64_t insert(uint64_t d, uint64_t b, unsigned width, unsigned n, unsigned low, unsigned high)
{
    uint64_t result = 0;
    for (unsigned p = 0; p < width; p++)
        if (low <= p && p <= high ? bit_at(b, (p + width - n) % width) : bit_at(d, p))
            result |= UINT64_C(1) << p;
    return result;
}

uint32_t ref_insertfield_pi(uint32_t d, uint32_t b, unsigned n, unsigned low, unsigned high)
{
    return (uint32_t)insert(d, b, 32, n, low, high);
}

uint32_t ref_rotatefield_pi(uint32_t b, unsigned n, unsigned low, unsigned high) { return (uint32_t)insert(0, b, 32, n, low, high); }

uint64_t ref_insertfield(uint64_t a, uint64_t b, unsigned n, unsigned low, unsigned high) { return insert(a, b, 64, n, low, high); }
uint64_t ref_rotatefield(uint64_t a, unsigned n, unsigned low, unsigned high) { return insert(0, a, 64, n, low, high); }

/* Compares */
bool ref_cmpneq_pi(uint32_t a, uint32_t b) { return value_of(a) != value_of(b); }
bool ref_cmpnlt_pi(uint32_t a, uint32_t b) { return value_of(a) - value_of(b) >= 0; }
bool ref_cmpnle_pi(uint32_t a, uint32_t b) { return value_of(a) - value_of(b) > 0; }
bool ref_cmpeq_pu(uint32_t a, uint32_t b) { return (int64_t)a - (int64_t)b == 0; }
bool ref_cmplt_pu(uint32_t a, uint32_t b) { return (int64_t)a - (int64_t)b < 0; }
bool ref_cmple_pu(uint32_t a, uint32_t b) { return (int64_t)a - (int64_t)b <= 0; }
bool ref_cmpneq_pu(uint32_t a, uint32_t b) { return (int64_t)a - (int64_t)b != 0; }
bool ref_cmpnlt_pu(uint32_t a, uint32_t b) { return (int64_t)a - (int64_t)b >= 0; }
bool ref_cmpnle_pu(uint32_t a, uint32_t b) { return (int64_t)a - (int64_t)b > 0; }

bool ref_test_pi(uint32_t a, uint32_t b)
{
    for (unsigned i = 0; i < 32; i++)
        if (bit_at(a, i) && bit_at(b, i))
            return true;
    return false;
}

/* Permutes: digits of base 4 of the immediate, the lowest for lane or block 0. */
static int digit(unsigned n, int place)
{
    while (place-- > 0)
        n /= 4;
    return (int)(n % 4);
}

int ref_shuf128x32_pi(int lane, unsigned blocks, unsigned words) { return 4 * digit(blocks, lane / 4) + digit(words, lane % 4); }
int ref_pshufd_pi(int lane, unsigned n) { return lane - lane % 4 + digit(n, lane % 4); }
int ref_permf32x4_ps(int lane, unsigned n) { return 4 * digit(n, lane / 4) + lane % 4; }
int ref_permd_pi(int lane, uint32_t index) { return (void)lane, (int)(index % 16); }
int ref_alignd_pi(int lane, unsigned n) { return lane + (int)n; }
