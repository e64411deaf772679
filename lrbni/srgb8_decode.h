/* Linear light of the 256 values of 8-bit sRGB. */
#ifndef LRBNI_SRGB8_DECODE_H
#define LRBNI_SRGB8_DECODE_H

#include <stdint.h>

/**
 * Bits of the float nearest to x / 12.92 where x <= 0.04045, ((x + 0.055) / 1.055)^2.4 above, x = number / 255 (IEC 61966-2-1).
 * Hardware tables are not published. test_conversions recomputes it with MPFR.
 */
extern const uint32_t lrb_srgb8_bits[256];

#endif
