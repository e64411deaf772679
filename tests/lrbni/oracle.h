/* One scalar reference per row of ops.def: what the op must give, written from the row's formula and isa-facts by other
 * means than the op (doubles, wider integers, bit by bit), and sharing no code with it.
 *
 * Floats are passed and returned as their bits. A row without a reference does not build: the declarations come from
 * ops.def, and every row is called by the test of its shape (rows.h).
 */
#ifndef TESTS_LRBNI_ORACLE_H
#define TESTS_LRBNI_ORACLE_H

#include <stdbool.h>
#include <stdint.h>

/* The flags that a compare leaves. */
typedef struct ref_flags {
    bool zero, carry, less;
} ref_flags;

/* A lane and the bit of the mask beside it: carry, borrow or sign. */
typedef struct ref_carry {
    uint32_t value;
    bool bit;
} ref_carry;

/* The state of the machine that float ops depend on. */
enum { REF_NEAREST, REF_DOWN, REF_UP, REF_TOWARDS_ZERO };

typedef struct ref_control {
    int rounding;
    bool flush_to_zero, denormals_are_zero;
} ref_control;

/* The conditions that a conditional jump may ask for. */
typedef enum ref_condition { REF_ZERO, REF_NOT_ZERO, REF_BELOW, REF_LESS, REF_CONDITIONS } ref_condition;

/* Where a load finds lane i. */
typedef enum ref_load_form { REF_LOAD_FULL, REF_LOAD_1TO16, REF_LOAD_4TO16, REF_LOAD_FORMS } ref_load_form;

enum { REF_NOWHERE = -1000 };

/* One lane of a vector op: sources in the order of the ISA, d the old destination. */
#define REF_V_V(id) uint32_t ref_##id(uint32_t b);
#define REF_VI_V(id) uint32_t ref_##id(uint32_t b);
#define REF_V_VV(id) uint32_t ref_##id(uint32_t a, uint32_t b);
#define REF_VI_VV(id) uint32_t ref_##id(uint32_t a, uint32_t b);
#define REF_V_VVV(id) uint32_t ref_##id(uint32_t d, uint32_t a, uint32_t b);
#define REF_VD_V(id) uint64_t ref_##id(uint64_t b);
/* The same where lanes differ, or with immediates: rounding (0 to 3: nearest, down, up, to zero) and exponent adjust, interval and
 * sign, number of a field, a table of 21 bits. */
#define REF_VI_ps_II(id) uint32_t ref_##id(uint32_t b, int mode, int adjust);
#define REF_V_pi_II(id) uint32_t ref_##id(uint32_t b, int mode, int adjust);
#define REF_V_V_II(id) uint32_t ref_##id(uint32_t b, int mode, int adjust);
#define REF_VD_V_II(id) uint64_t ref_##id(uint64_t b, int mode, int adjust);
#define REF_V_V_NS(id) uint32_t ref_##id(uint32_t b, int interval, int sign);
#define REF_VD_V_NS(id) uint64_t ref_##id(uint64_t b, int interval, int sign);
#define REF_VD_ps(id) uint64_t ref_##id(uint32_t b);
#define REF_VD_pi(id) uint64_t ref_##id(uint32_t b);
#define REF_V_pd_I(id) uint32_t ref_##id(uint64_t b, int mode);
#define REF_VI_pd_I(id) uint32_t ref_##id(uint64_t b, int mode);
#define REF_V_Vpd_I(id) uint32_t ref_##id(uint64_t b, int mode);
#define REF_VI_Vpd_I(id) uint32_t ref_##id(uint64_t b, int mode);
#define REF_VI_ps(id) uint32_t ref_##id(uint32_t b);
#define REF_V_pi(id) uint32_t ref_##id(uint32_t b);
#define REF_VI_Vps_I(id) uint32_t ref_##id(uint32_t d, uint32_t b, int field);
#define REF_V_Vpi(id) uint32_t ref_##id(uint32_t a, uint32_t b);
#define REF_V_VV_I(id) uint32_t ref_##id(uint32_t d, uint32_t b, uint32_t table);
#define REF_V_VVpi(id) uint32_t ref_##id(uint32_t d, uint32_t a, uint32_t b);
#define REF_VD_VVpq(id) uint64_t ref_##id(uint64_t d, uint64_t a, uint64_t b);
#define REF_VD_VV(id) uint64_t ref_##id(uint64_t a, uint64_t b);
#define REF_VD_VVV(id) uint64_t ref_##id(uint64_t d, uint64_t a, uint64_t b);
#define REF_KD_VV(id) bool ref_##id(uint64_t a, uint64_t b);
/* With a mask bit, with the four lanes of S3's group, with a mask bit as second result. */
#define REF_V_KVV(id) uint32_t ref_##id(bool k, uint32_t a, uint32_t b);
#define REF_VD_KVV(id) uint64_t ref_##id(bool k, uint64_t a, uint64_t b);
#define REF_V_VX(id) uint32_t ref_##id(uint32_t a, const uint32_t group[4]);
#define REF_VK_VV(id) uint32_t ref_##id(uint32_t a, uint32_t b, bool *k);
#define REF_K_VV(id) bool ref_##id(uint32_t a, uint32_t b);
#define REF_KI_VV(id) bool ref_##id(uint32_t a, uint32_t b);
/* The lane of the source that lane `lane` takes; the word of memory that it takes; the lane that word `word` receives. */
#define REF_V_VII(id) int ref_##id(int lane, unsigned blocks, unsigned words);
#define REF_V_M(id) int ref_##id(int lane, ref_load_form form);
#define REF_VI_M(id) int ref_##id(int lane, ref_load_form form);
#define REF_VD_M(id) int ref_##id(int lane, ref_load_form form);
#define REF_VQ_M(id) int ref_##id(int lane, ref_load_form form);
#define REF_M_V(id) int ref_##id(int word);
#define REF_M_VI(id) int ref_##id(int word);
#define REF_M_VD(id) int ref_##id(int word);
#define REF_M_VQ(id) int ref_##id(int word);
#define REF_ML_V(id) int ref_##id(int word);
#define REF_ML_VD(id) int ref_##id(int word);
/* The lane that an element becomes, by the number of the conversion in lrbni/conversions.def; the element that a lane becomes. */
#define REF_V_MC(id) uint32_t ref_##id(int up, const unsigned char *element);
#define REF_VI_MC(id) uint32_t ref_##id(int up, const unsigned char *element);
#define REF_MC_V(id) void ref_##id(int down, uint32_t lane, unsigned char *element);
#define REF_MC_VI(id) void ref_##id(int down, uint32_t lane, unsigned char *element);
/* Where a lane's element of a stream is, in bytes from the op's address; REF_NOWHERE: the op does not move the lane. */
#define REF_STREAM(id) int ref_##id(uint32_t k, uint32_t address, int bytes, int lane);
#define REF_V_MS(id) REF_STREAM(id)
#define REF_VI_MS(id) REF_STREAM(id)
#define REF_VD_MS(id) REF_STREAM(id)
#define REF_VQ_MS(id) REF_STREAM(id)
#define REF_MS_V(id) REF_STREAM(id)
#define REF_MS_VI(id) REF_STREAM(id)
#define REF_MS_VD(id) REF_STREAM(id)
#define REF_MS_VQ(id) REF_STREAM(id)
#define REF_V_MSC(id) REF_STREAM(id)
#define REF_VI_MSC(id) REF_STREAM(id)
#define REF_MSC_V(id) REF_STREAM(id)
#define REF_MSC_VI(id) REF_STREAM(id)
/* The lanes that one execution completes, by the addresses of all. */
#define REF_EXECUTION(id) uint32_t ref_##id(uint32_t k, const uint32_t addresses[16]);
#define REF_V_MVI(id) REF_EXECUTION(id)
#define REF_VI_MVI(id) REF_EXECUTION(id)
#define REF_VD_MVI(id) REF_EXECUTION(id)
#define REF_VQ_MVI(id) REF_EXECUTION(id)
#define REF_MVI_V(id) REF_EXECUTION(id)
#define REF_MVI_VI(id) REF_EXECUTION(id)
#define REF_MVI_VD(id) REF_EXECUTION(id)
#define REF_MVI_VQ(id) REF_EXECUTION(id)
#define REF_H_MVI(id) REF_EXECUTION(id)
/* The lanes that the hint is about. */
#define REF_H_VIM(id) REF_EXECUTION(id)
/* Masks and general registers. */
#define REF_K_KK(id) uint32_t ref_##id(uint32_t a, uint32_t b);
#define REF_K_K(id) uint32_t ref_##id(uint32_t a);
#define REF_F_KK(id) ref_flags ref_##id(uint32_t a, uint32_t b);
#define REF_K_R(id) uint32_t ref_##id(uint64_t a);
#define REF_R_K(id) uint64_t ref_##id(uint32_t a);
#define REF_R_R(id) uint64_t ref_##id(uint64_t a);
#define REF_R_RR(id) uint64_t ref_##id(uint64_t a, uint64_t b);
#define REF_R_RI(id) uint64_t ref_##id(uint64_t a, unsigned n);
#define REF_F_RR(id) ref_flags ref_##id(uint64_t a, uint64_t b);
/* Simulated address; the value that `bytes` of memory give; what memory becomes. */
#define REF_P_PR(id) uint32_t ref_##id(uint32_t base, uint64_t index, unsigned scale, int32_t displacement);
#define REF_R_M(id) uint64_t ref_##id(const unsigned char *bytes);
#define REF_M_R(id) void ref_##id(unsigned char *bytes, uint64_t a);
/* Whether the jump is taken; the aux of a marker's event. */
#define REF_B_F(id) bool ref_##id(ref_flags flags, ref_condition condition);
#define REF_B(id) bool ref_##id(void);
/* The state that `bytes` of memory give, and the other way. */
#define REF_C_M(id) ref_control ref_##id(const unsigned char *bytes);
#define REF_M_C(id) void ref_##id(unsigned char *bytes, ref_control control);
/* The aux of a hint's event. */
#define REF_H_M(id) uint32_t ref_##id(uint32_t address);
#define REF_H_R(id) uint32_t ref_##id(uint64_t a);
#define REF_MARK(id) uint32_t ref_##id(uint32_t number);

/* Integer lanes: with immediates, with a bit of a mask in and out, with one lane's group of four of S3. */
#define REF_VI_VVV(id) uint32_t ref_##id(uint32_t d, uint32_t a, uint32_t b);
#define REF_VI_VX(id) uint32_t ref_##id(uint32_t a, const uint32_t group[4]);
#define REF_VI_VI(id) uint32_t ref_##id(uint32_t b, unsigned n);
#define REF_VI_VIII(id) uint32_t ref_##id(uint32_t b, unsigned n, unsigned low, unsigned high);
#define REF_VI_VVIII(id) uint32_t ref_##id(uint32_t d, uint32_t b, unsigned n, unsigned low, unsigned high);
#define REF_VIK_VKV(id) ref_carry ref_##id(uint32_t d, bool k, uint32_t b);
#define REF_VIK_V(id) ref_carry ref_##id(uint32_t d, uint32_t b);
#define REF_VIK_VV(id) ref_carry ref_##id(uint32_t a, uint32_t b);
#define REF_VI_KVV(id) uint32_t ref_##id(bool k, uint32_t a, uint32_t b);
#define REF_VQ_V(id) uint64_t ref_##id(uint64_t b);
#define REF_VQ_VV(id) uint64_t ref_##id(uint64_t a, uint64_t b);
#define REF_VQ_KVV(id) uint64_t ref_##id(bool k, uint64_t a, uint64_t b);
/* The lane that lane `lane` takes: of a; of b; of b by the index in a; of b (0 to 15) or a (16 to 31). */
#define REF_VI_XII(id) int ref_##id(int lane, unsigned blocks, unsigned words);
#define REF_VI_XI(id) int ref_##id(int lane, unsigned n);
#define REF_V_XI(id) int ref_##id(int lane, unsigned n);
#define REF_VI_XX(id) int ref_##id(int lane, uint32_t index);
#define REF_VI_XXI(id) int ref_##id(int lane, unsigned n);
/* More of masks and general registers. */
#define REF_R_KK(id) uint64_t ref_##id(uint32_t a, uint32_t b);
#define REF_K_RI(id) uint32_t ref_##id(uint64_t a, unsigned n);
#define REF_B_K(id) bool ref_##id(uint32_t a);
#define REF_R_RIII(id) uint64_t ref_##id(uint64_t a, unsigned n, unsigned low, unsigned high);
#define REF_R_RRIII(id) uint64_t ref_##id(uint64_t a, uint64_t b, unsigned n, unsigned low, unsigned high);

#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) REF_##shape(id) /* uint32_t ref_add_ps(...); */
#include "lrbni/ops.def"

/** The source lane, within its group of four, of lane 0, 1, 2, 3 for each swizzle: dcba cdab badc aaaa bbbb cccc dddd dacb. */
extern const int ref_swizzles[8][4];

/** Whether the bits are a NaN's; of a double if `wide`. */
bool ref_is_nan(uint32_t bits);
static inline bool ref_is_nan_lane(bool wide, uint64_t bits)
{
    return wide ? (bits << 1) > UINT64_C(0xffe0000000000000) : ref_is_nan((uint32_t)bits);
}

/** Value of a float's or a double's bits, and the bits of a value that the format has. */
double ref_value(bool wide, uint64_t bits);
uint64_t ref_bits(bool wide, double d);

/* x * y + z, each part negated or not. */
typedef struct ref_sources {
    uint64_t x, y, z;
    bool negate_product, negate_addend;
} ref_sources;

/** Multiply-add, product and sum of floats or (`wide`) doubles in any state, rounded once. */
uint64_t ref_fused(bool wide, ref_control control, ref_sources s);
uint64_t ref_product(bool wide, ref_control control, uint64_t x, uint64_t y);
uint64_t ref_sum(bool wide, ref_control control, uint64_t x, uint64_t z, bool negate_x, bool negate_z);

/** ref_store_down_ps in a state of the machine: its rounding mode is that of halves and integers. */
void ref_down_in_state(ref_control control, int down, uint32_t lane, unsigned char *element);

#endif
