/* References of what loads, stores and hints touch: by counting, digit by digit. */
#include "tests/lrbni/oracle.h"

static int element_of_memory(int lane, ref_load_form form)
{
    return form == REF_LOAD_1TO16 ? 0 : form == REF_LOAD_4TO16 ? lane % 4 : lane;
}

/* REF_LOAD(load_ps) */
#define REF_LOAD(id) \
    int ref_##id(int lane, ref_load_form form) { return element_of_memory(lane, form); }
REF_LOAD(load_ps)
REF_LOAD(load_pi)
REF_LOAD(load_pd)
REF_LOAD(load_pq)
REF_LOAD(load_nt_ps)
REF_LOAD(load_nt_pi)
REF_LOAD(load_nt_pd)
REF_LOAD(load_nt_pq)

/* REF_STORE(store_ps): element i receives lane i */
#define REF_STORE(id) \
    int ref_##id(int word) { return word; }
REF_STORE(store_ps)
REF_STORE(store_pi)
REF_STORE(store_pd)
REF_STORE(store_pq)
REF_STORE(store_nt_ps)
REF_STORE(store_nt_pi)
REF_STORE(store_nt_pd)
REF_STORE(store_nt_pq)
REF_STORE(storenr_ps)
REF_STORE(storenr_pd)
REF_STORE(storenrngo_ps)
REF_STORE(storenrngo_pd)

/* Walk the stream as the guide's programs do: from its start, one selected lane after the other, until the lane is met. `line` 0: the
 * lane counts only if no line has begun since, 1: only if one has, -1: always. */
static int walk(uint32_t k, uint32_t start, int bytes, int lane, int line)
{
    int offset = 0, lines = 0;
    if (!(k >> lane & 1))
        return REF_NOWHERE;
    for (int i = 0; i < lane; i++) {
        if (!(k >> i & 1))
            continue;
        offset += bytes;
        lines += (start + (uint32_t)offset) % 64 == 0;
    }
    return line < 0 || lines == line ? offset : REF_NOWHERE;
}

/* A high part's address is 64 bytes above the start of the stream. */
static int high(uint32_t k, uint32_t address, int bytes, int lane)
{
    int offset = walk(k, address - 64, bytes, lane, 1);
    return offset == REF_NOWHERE ? REF_NOWHERE : offset - 64;
}

/* REF_PARTS(loadunpack, _ps): the low and the high op */
#define REF_PARTS(stem, suffix)                                                                                              \
    int ref_##stem##l##suffix(uint32_t k, uint32_t address, int bytes, int lane) { return walk(k, address, bytes, lane, 0); } \
    int ref_##stem##h##suffix(uint32_t k, uint32_t address, int bytes, int lane) { return high(k, address, bytes, lane); }
REF_PARTS(loadunpack, _ps)
REF_PARTS(loadunpack, _pi)
REF_PARTS(loadunpack, _pd)
REF_PARTS(loadunpack, _pq)
REF_PARTS(loadunpack, _up_ps)
REF_PARTS(loadunpack, _up_pi)
REF_PARTS(packstore, _ps)
REF_PARTS(packstore, _pi)
REF_PARTS(packstore, _pd)
REF_PARTS(packstore, _pq)
REF_PARTS(packstore, _down_ps)
REF_PARTS(packstore, _down_pi)

/* REF_WHOLE(expand_ps) */
#define REF_WHOLE(id) \
    int ref_##id(uint32_t k, uint32_t address, int bytes, int lane) { return walk(k, address, bytes, lane, -1); }
REF_WHOLE(expand_ps)
REF_WHOLE(expand_pi)
REF_WHOLE(expand_pd)
REF_WHOLE(expand_pq)
REF_WHOLE(compress_ps)
REF_WHOLE(compress_pi)
REF_WHOLE(compress_pd)
REF_WHOLE(compress_pq)

/* The lanes in the line of the lowest selected one, of the first `lanes`. */
static uint32_t same_line(uint32_t k, const uint32_t addresses[16], int lanes)
{
    uint32_t completed = 0;
    int lowest = -1;
    for (int i = 0; i < lanes; i++) {
        if (!(k >> i & 1))
            continue;
        if (lowest < 0)
            lowest = i;
        if ((addresses[i] ^ addresses[lowest]) < 64 && addresses[i] - addresses[i] % 64 == addresses[lowest] - addresses[lowest] % 64)
            completed |= 1u << i;
    }
    return completed;
}

/* REF_LINE(gatherd_ps, 16) */
#define REF_LINE(id, lanes) \
    uint32_t ref_##id(uint32_t k, const uint32_t addresses[16]) { return same_line(k, addresses, lanes); }
REF_LINE(gatherd_ps, 16)
REF_LINE(gatherd_pi, 16)
REF_LINE(gatherd_pd, 8)
REF_LINE(gatherd_pq, 8)
REF_LINE(scatterd_ps, 16)
REF_LINE(scatterd_pi, 16)
REF_LINE(scatterd_pd, 8)
REF_LINE(scatterd_pq, 8)
REF_LINE(gatherpfd, 16)
REF_LINE(gatherpf2d, 16)
REF_LINE(scatterpfd, 16)
REF_LINE(scatterpf2d, 16)

/* REF_ALL(gatherpf0hintd_ps, 16) */
#define REF_ALL(id, lanes) \
    uint32_t ref_##id(uint32_t k, const uint32_t addresses[16]) { return (void)addresses, k % (1u << (lanes)); }
REF_ALL(gatherpf0hintd_ps, 16)
REF_ALL(gatherpf0hintd_pd, 8)
REF_ALL(scatterpf0hintd_ps, 16)
REF_ALL(scatterpf0hintd_pd, 8)

/* General registers: digits of base 256, the lowest first. */
static uint64_t digits(const unsigned char *bytes, int count)
{
    uint64_t value = 0;
    while (count > 0)
        value = 256 * value + bytes[--count];
    return value;
}

/* The same, less the base's power if the highest bit is set. */
static uint64_t signed_digits(const unsigned char *bytes, int count)
{
    return digits(bytes, count) - (bytes[count - 1] >= 128 ? UINT64_C(1) << (8 * count) : 0);
}

static void put_digits(unsigned char *bytes, int count, uint64_t a)
{
    for (int i = 0; i < count; i++, a /= 256)
        bytes[i] = (unsigned char)(a % 256);
}

uint64_t ref_load8(const unsigned char *bytes) { return digits(bytes, 1); }
uint64_t ref_load16(const unsigned char *bytes) { return digits(bytes, 2); }
uint64_t ref_load32(const unsigned char *bytes) { return digits(bytes, 4); }
uint64_t ref_load64(const unsigned char *bytes) { return digits(bytes, 8); }
uint64_t ref_load8s(const unsigned char *bytes) { return signed_digits(bytes, 1); }
uint64_t ref_load16s(const unsigned char *bytes) { return signed_digits(bytes, 2); }
uint64_t ref_load32s(const unsigned char *bytes) { return signed_digits(bytes, 4); }
void ref_store8(unsigned char *bytes, uint64_t a) { put_digits(bytes, 1, a); }
void ref_store16(unsigned char *bytes, uint64_t a) { put_digits(bytes, 2, a); }
void ref_store32(unsigned char *bytes, uint64_t a) { put_digits(bytes, 4, a); }
void ref_store64(unsigned char *bytes, uint64_t a) { put_digits(bytes, 8, a); }

/* REF_HINT(prefetch1): the event has the address as it is */
#define REF_HINT(id) \
    uint32_t ref_##id(uint32_t address) { return address; }
REF_HINT(prefetch1)
REF_HINT(prefetch1_ex)
REF_HINT(prefetch1_nt)
REF_HINT(prefetch1_ex_nt)
REF_HINT(prefetch1_miss)
REF_HINT(prefetch2)
REF_HINT(prefetch2_ex)
REF_HINT(prefetch2_nt)
REF_HINT(prefetch2_ex_nt)
REF_HINT(evict1)
REF_HINT(evict2)
