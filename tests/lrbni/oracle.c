/* References of the integer, move, memory, mask and scalar ops: bit by bit, digit by digit, or in wider integers. */
#include "tests/lrbni/oracle.h"

const int ref_swizzles[8][4] = {
    {0, 1, 2, 3}, /* dcba */
    {1, 0, 3, 2}, /* cdab */
    {2, 3, 0, 1}, /* badc */
    {0, 0, 0, 0}, /* aaaa */
    {1, 1, 1, 1}, /* bbbb */
    {2, 2, 2, 2}, /* cccc */
    {3, 3, 3, 3}, /* dddd */
    {1, 2, 0, 3}, /* dacb */
};

/* Bit (2 * bit of a + bit of b) of `truth`, for every bit below `width`. */
static uint64_t bit_by_bit(uint64_t a, uint64_t b, int width, unsigned truth)
{
    uint64_t result = 0;
    for (int i = width - 1; i >= 0; i--)
        result = result * 2 + (truth >> (2 * (a >> i & 1) + (b >> i & 1)) & 1);
    return result;
}

enum { AND = 8, OR = 14, XOR = 6, XNOR = 9, NOT_A_AND_B = 2, A_AND_NOT_B = 4, NOT_A = 3 };

/* Schoolbook addition, one bit after the other. */
static uint64_t add_bits(uint64_t a, uint64_t b, unsigned carry, int width)
{
    uint64_t result = 0;
    for (int i = 0; i < width; i++) {
        unsigned sum = (unsigned)(a >> i & 1) + (unsigned)(b >> i & 1) + carry;
        result |= (uint64_t)(sum & 1) << i;
        carry = sum >> 1;
    }
    return result;
}

/* Integer lanes */
uint32_t ref_add_pi(uint32_t a, uint32_t b) { return (uint32_t)add_bits(a, b, 0, 32); }
uint32_t ref_sub_pi(uint32_t a, uint32_t b) { return (uint32_t)add_bits(a, ~b, 1, 32); }
uint32_t ref_and_pi(uint32_t a, uint32_t b) { return (uint32_t)bit_by_bit(a, b, 32, AND); }
uint32_t ref_or_pi(uint32_t a, uint32_t b) { return (uint32_t)bit_by_bit(a, b, 32, OR); }
uint32_t ref_xor_pi(uint32_t a, uint32_t b) { return (uint32_t)bit_by_bit(a, b, 32, XOR); }

/* Two's complement value of 32 bits. */
static int64_t signed32(uint32_t a) { return (int64_t)a - (a >> 31 ? INT64_C(0x100000000) : 0); }

bool ref_cmpeq_pi(uint32_t a, uint32_t b) { return signed32(a) - signed32(b) == 0; }
bool ref_cmplt_pi(uint32_t a, uint32_t b) { return signed32(a) - signed32(b) < 0; }
bool ref_cmple_pi(uint32_t a, uint32_t b) { return signed32(a) - signed32(b) <= 0; }

/* Moves */
uint32_t ref_mov_ps(uint32_t b) { return b; }
uint32_t ref_mov_pi(uint32_t b) { return b; }
uint64_t ref_mov_pd(uint64_t b) { return b; }

int ref_shuf128x32_ps(int lane, unsigned blocks, unsigned words)
{
    int group = lane / 4, word = lane % 4;
    unsigned block_of[4], word_of[4];
    for (int i = 0; i < 4; i++, blocks /= 4, words /= 4) {
        block_of[i] = blocks % 4;
        word_of[i] = words % 4;
    }
    return (int)(block_of[group] * 4 + word_of[word]);
}

/* Mask registers */
uint32_t ref_kand(uint32_t a, uint32_t b) { return (uint32_t)bit_by_bit(a, b, 16, AND); }
uint32_t ref_kandn(uint32_t a, uint32_t b) { return (uint32_t)bit_by_bit(a, b, 16, NOT_A_AND_B); }
uint32_t ref_kor(uint32_t a, uint32_t b) { return (uint32_t)bit_by_bit(a, b, 16, OR); }
uint32_t ref_kxor(uint32_t a, uint32_t b) { return (uint32_t)bit_by_bit(a, b, 16, XOR); }
uint32_t ref_knot(uint32_t a) { return (uint32_t)bit_by_bit(a, 0, 16, NOT_A); }

ref_flags ref_kortest(uint32_t a, uint32_t b)
{
    int set = 0;
    for (int i = 0; i < 16; i++)
        set += (a >> i & 1) || (b >> i & 1);
    return (ref_flags){.zero = set == 0, .carry = set == 16};
}

uint32_t ref_kxnor(uint32_t a, uint32_t b) { return (uint32_t)bit_by_bit(a, b, 16, XNOR); }
uint32_t ref_kandnr(uint32_t a, uint32_t b) { return (uint32_t)bit_by_bit(a, b, 16, A_AND_NOT_B); }
uint32_t ref_kmov_kk(uint32_t a) { return a; }

/* Bytes as digits of base 256, masks of base 65536. */
uint32_t ref_kswapb(uint32_t a, uint32_t b) { return b % 256 * 256 + a / 256; }
uint32_t ref_kmovlhb(uint32_t a, uint32_t b) { return b % 256 * 256 + a % 256; }
uint64_t ref_kconcath(uint32_t a, uint32_t b) { return (a * UINT64_C(65536) + b) * 65536 * 65536; }
uint64_t ref_kconcatl(uint32_t a, uint32_t b) { return a * UINT64_C(65536) + b; }

uint32_t ref_kextract(uint64_t a, unsigned n)
{
    for (; n < 3; n++)
        a /= 65536;
    return (uint32_t)(a % 65536);
}

uint32_t ref_kmov_kr(uint64_t a) { return (uint32_t)(a % 65536); }
uint64_t ref_kmov_rk(uint32_t a) { return a % 65536; }

/* General registers */
uint64_t ref_mov(uint64_t a) { return a; }
uint64_t ref_add(uint64_t a, uint64_t b) { return add_bits(a, b, 0, 64); }
uint64_t ref_sub(uint64_t a, uint64_t b) { return add_bits(a, ~b, 1, 64); }
uint64_t ref_and(uint64_t a, uint64_t b) { return bit_by_bit(a, b, 64, AND); }
uint64_t ref_or(uint64_t a, uint64_t b) { return bit_by_bit(a, b, 64, OR); }
uint64_t ref_xor(uint64_t a, uint64_t b) { return bit_by_bit(a, b, 64, XOR); }

uint64_t ref_shl(uint64_t a, unsigned n)
{
    for (; n > 0; n--)
        a = add_bits(a, a, 0, 64);
    return a;
}

uint64_t ref_shr(uint64_t a, unsigned n)
{
    for (; n > 0; n--)
        a /= 2;
    return a;
}

uint64_t ref_imul(uint64_t a, uint64_t b)
{
    uint64_t product = 0;
    for (int i = 63; i >= 0; i--) {
        product = add_bits(product, product, 0, 64);
        if (b >> i & 1)
            product = add_bits(product, a, 0, 64);
    }
    return product;
}

uint64_t ref_bsfi(uint64_t a, uint64_t b)
{
    for (int position = 0; position < 64; position++)
        if ((b >> position & 1) && (int64_t)a < position)
            return (uint64_t)position;
    return UINT64_MAX;
}

/* Upwards, so that the last one found is the highest. */
uint64_t ref_bsri(uint64_t a, uint64_t b)
{
    uint64_t found = UINT64_MAX;
    for (int position = 0; position < 64 && position < (int64_t)a; position++)
        if (b >> position & 1)
            found = (uint64_t)position;
    return found;
}

uint64_t ref_bsff(uint64_t a) { return ref_bsfi((uint64_t)INT64_C(-1), a); }
uint64_t ref_bsrf(uint64_t a) { return ref_bsri(1000, a); }

uint64_t ref_tzcnti(uint64_t a, uint64_t b)
{
    int64_t position = (int64_t)a < 0 ? 0 : (int64_t)a;
    uint64_t count = 0;
    if (position > 63)
        return 64;
    for (; position < 64 && !(b >> position & 1); position++)
        count++;
    return count;
}

uint64_t ref_tzcnt(uint64_t a) { return ref_tzcnti(0, a); }

uint64_t ref_lzcnt(uint64_t a)
{
    uint64_t count = 64;
    for (; a; a /= 2)
        count--;
    return count;
}

/* Digits of base 16. */
uint64_t ref_quadmask16(uint64_t a)
{
    uint64_t result = 0;
    for (int j = 0; j < 4; j++, a /= 16)
        result += a % 16 ? UINT64_C(1) << j : 0;
    return result;
}

uint64_t ref_bts(uint64_t a, uint64_t b)
{
    uint64_t result = 0;
    for (unsigned i = 0; i < 64; i++)
        if ((a >> i & 1) || i == b % 64)
            result |= UINT64_C(1) << i;
    return result;
}

uint64_t ref_popcnt(uint64_t a)
{
    uint64_t count = 0;
    for (; a; a /= 2)
        count += a % 2;
    return count;
}

uint32_t ref_lea(uint32_t base, uint64_t index, unsigned scale, int32_t displacement)
{
    uint64_t address = add_bits(base, ref_imul(index, scale), 0, 64);
    return (uint32_t)add_bits(address, (uint64_t)(int64_t)displacement, 0, 32);
}

/* Flags from the difference in wider integers: of the unsigned values, and of the signed ones. */
ref_flags ref_cmp(uint64_t a, uint64_t b)
{
    __extension__ typedef __int128 wide;
    wide below = (wide)a - (wide)b, less = (wide)(int64_t)a - (wide)(int64_t)b;
    return (ref_flags){.zero = below == 0, .carry = below < 0, .less = less < 0};
}

ref_flags ref_test(uint64_t a, uint64_t b)
{
    uint64_t both = bit_by_bit(a, b, 64, AND);
    return (ref_flags){.zero = both == 0, .less = both / (UINT64_C(1) << 63) == 1};
}

/* Branches and markers */
bool ref_jcc(ref_flags flags, ref_condition condition)
{
    const bool holds[REF_CONDITIONS] = {flags.zero, !flags.zero, flags.carry, flags.less};
    return holds[condition];
}

bool ref_jkzd(uint32_t a) { return a == 0; }
bool ref_jknzd(uint32_t a) { return a > 0; }
bool ref_jmp(void) { return true; }
uint32_t ref_phase(uint32_t number) { return number; }
uint32_t ref_region(uint32_t number) { return number; }
uint32_t ref_line(uint32_t number) { return number; }
uint32_t ref_far(uint32_t number) { return number; }

uint32_t ref_delay(uint64_t a) { return (uint32_t)(a % 4294967296u); }
uint32_t ref_spflt(uint64_t a) { return (void)a, 0; }
