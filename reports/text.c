#include "reports/text.h"

#include <assert.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { REPLACEMENT = 0xfffd };

/* Length of the UTF-8 sequence that a first byte announces, 0 for a byte that cannot start one. */
static int sequence_length(unsigned char first)
{
    if (first < 0x80)
        return 1;
    if (first >= 0xc2 && first < 0xe0)
        return 2;
    if (first >= 0xe0 && first < 0xf0)
        return 3;
    if (first >= 0xf0 && first < 0xf5)
        return 4;
    return 0;
}

/* Take one character off the front of a text that does not end yet. A wrong byte counts as one U+FFFD. */
static uint32_t next_character(const char **text)
{
    static const uint32_t smallest[5] = {0, 0, 0x80, 0x800, 0x10000};
    const unsigned char *byte = (const unsigned char *)*text;
    int length = sequence_length(byte[0]);
    uint32_t character = length > 1 ? byte[0] & (0x7fu >> length) : byte[0];
    for (int i = 1; i < length; i++) {
        if ((byte[i] & 0xc0) != 0x80)
            length = 0;
        else
            character = character << 6 | (byte[i] & 0x3f);
    }
    *text += length ? length : 1;
    if (!length || character < smallest[length] || (character >= 0xd800 && character < 0xe000) || character > 0x10ffff)
        return REPLACEMENT;
    if (character < 0x20 || (character >= 0x7f && character < 0xa0))
        return ' ';
    return character;
}

/* Append a character; returns the position behind it. At most 3 bytes a source byte, 4 a character. */
static char *put_character(char *out, uint32_t character)
{
    if (character < 0x80) {
        *out++ = (char)character;
        return out;
    }
    int tail = character < 0x800 ? 1 : character < 0x10000 ? 2 : 3;
    static const unsigned char lead[4] = {0, 0xc0, 0xe0, 0xf0};
    *out++ = (char)(lead[tail] | character >> 6 * tail);
    while (tail-- > 0)
        *out++ = (char)(0x80 | (character >> 6 * tail & 0x3f));
    return out;
}

char *report_text_clean(const char *text)
{
    char *copy = malloc(3 * strlen(text) + 1);
    char *end = copy;
    if (!copy)
        return NULL;
    while (*text)
        end = put_character(end, next_character(&text));
    *end = '\0';
    return copy;
}

typedef struct character_range {
    uint32_t first, last;
    int width;
} character_range;

static int character_width(uint32_t character)
{
    static const character_range special[] = {
        {0x0300, 0x036f, 0},   {0x1100, 0x115f, 2},   {0x1ab0, 0x1aff, 0},   {0x1dc0, 0x1dff, 0},
        {0x200b, 0x200f, 0},   {0x20d0, 0x20ff, 0},   {0x2e80, 0x303e, 2},   {0x3041, 0xa4cf, 2},
        {0xac00, 0xd7a3, 2},   {0xf900, 0xfaff, 2},   {0xfe00, 0xfe0f, 0},   {0xfe20, 0xfe2f, 0},
        {0xfe30, 0xfe6f, 2},   {0xff00, 0xff60, 2},   {0xffe0, 0xffe6, 2},   {0x1f300, 0x1faff, 2},
        {0x20000, 0x3fffd, 2}, {0xe0100, 0xe01ef, 0},
    };
    for (size_t i = 0; i < sizeof special / sizeof *special; i++)
        if (character >= special[i].first && character <= special[i].last)
            return special[i].width;
    return 1;
}

int report_text_width(const char *text)
{
    int width = 0;
    while (*text)
        width += character_width(next_character(&text));
    return width;
}

void report_text_print_html(FILE *out, const char *text)
{
    while (*text) {
        uint32_t character = next_character(&text);
        char bytes[5];
        switch (character) {
        case '&':
            fputs("&amp;", out);
            break;
        case '<':
            fputs("&lt;", out);
            break;
        case '>':
            fputs("&gt;", out);
            break;
        case '"':
            fputs("&quot;", out);
            break;
        case '\'':
            fputs("&#39;", out);
            break;
        default:
            *put_character(bytes, character) = '\0';
            fputs(bytes, out);
        }
    }
}

/* Put commas into the digits before the point. */
static void group_thousands(char text[REPORT_NUMBER_BYTES])
{
    char *digits = text + (*text == '-');
    size_t count = strspn(digits, "0123456789");
    for (size_t i = count; i > 3;) {
        i -= 3;
        memmove(digits + i + 1, digits + i, strlen(digits + i) + 1);
        digits[i] = ',';
    }
}

void report_format_integer(char out[REPORT_NUMBER_BYTES], int64_t value, bool grouped)
{
    snprintf(out, REPORT_NUMBER_BYTES, "%" PRId64, value);
    if (grouped)
        group_thousands(out);
}

void report_format_real(char out[REPORT_NUMBER_BYTES], double value, int decimals, bool grouped)
{
    assert(isfinite(value) && decimals >= 0 && decimals <= REPORT_MAX_DECIMALS);
    /* printf's decimal point may be a comma, or several bytes, in the program's locale: only digits are kept. */
    char raw[REPORT_NUMBER_BYTES];
    snprintf(raw, sizeof raw, "%.*f", decimals, value);
    char *from = raw + (*raw == '-');
    char *to = out;
    size_t whole = strspn(from, "0123456789");
    if (*raw == '-' && strpbrk(raw, "123456789"))
        *to++ = '-';
    memcpy(to, from, whole);
    to += whole;
    if (decimals > 0) {
        *to++ = '.';
        memcpy(to, raw + strlen(raw) - decimals, (size_t)decimals);
        to += decimals;
    }
    *to = '\0';
    if (grouped)
        group_thousands(out);
}

/* Whether the whole part of a formatted number has more than three digits. */
static bool needs_larger_unit(const char *text)
{
    return strspn(text + (*text == '-'), "0123456789") > 3;
}

void report_format_scaled(char out[REPORT_NUMBER_BYTES], double value, int decimals)
{
    static const char letters[] = {'\0', 'K', 'M', 'G', 'T'};
    static const double units[] = {1, 1e3, 1e6, 1e9, 1e12};
    size_t last = sizeof units / sizeof *units - 1;
    size_t i = 0;
    report_format_real(out, value, value == trunc(value) ? 0 : decimals, false);
    /* Judged after rounding: 999,999 in thousands would read 1000.0K. */
    while (i < last && needs_larger_unit(out))
        report_format_real(out, value / units[++i], decimals, false);
    if (i == last)
        group_thousands(out);
    if (letters[i]) {
        size_t length = strlen(out);
        out[length] = letters[i];
        out[length + 1] = '\0';
    }
}
