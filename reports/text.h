/* Text and numbers for reports, the same under every locale. All text is UTF-8. */
#ifndef REPORTS_TEXT_H
#define REPORTS_TEXT_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    REPORT_NUMBER_BYTES = 512,   /* room for any number below, thousands separators and terminator included */
    REPORT_MAX_DECIMALS = 17
};

/**
 * A copy of `text` that every writer can print: bytes that are no UTF-8 become U+FFFD, control characters blanks.
 * Returns memory for free(), or NULL when there is none.
 */
char *report_text_clean(const char *text);

/**
 * Width of `text` on a terminal, in character cells: 0 for combining marks, 2 for East Asian wide characters and
 * pictographs, else 1. A compact list of ranges, not the whole of Unicode's tables.
 */
int report_text_width(const char *text);

/** Print `text` as HTML content or attribute value: & < > " ' escaped, and cleaned as report_text_clean does. */
void report_text_print_html(FILE *out, const char *text);

/** Write an integer, with commas between thousands if `grouped`. */
void report_format_integer(char out[REPORT_NUMBER_BYTES], int64_t value, bool grouped);

/**
 * Write a finite number with a point and exactly `decimals` digits after it (0 to REPORT_MAX_DECIMALS; no point for
 * 0), correctly rounded (exact ties to even); a zero has no sign.
 */
void report_format_real(char out[REPORT_NUMBER_BYTES], double value, int decimals, bool grouped);

/**
 * Write a number in thousands (K), millions (M), 10^9 (G) or 10^12 (T), with `decimals` digits; below 1000 without a
 * letter, and without decimals if it is whole. For people only: digits are lost.
 */
void report_format_scaled(char out[REPORT_NUMBER_BYTES], double value, int decimals);

#ifdef __cplusplus
}
#endif
#endif
