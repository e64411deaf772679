/* A small font of 5 x 7 dots, descenders two more, for numbers and captions inside pictures. */
#ifndef REPORTS_BITMAP_FONT_H
#define REPORTS_BITMAP_FONT_H

#include <stdbool.h>

#include "reports/image.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { REPORT_GLYPH_WIDTH = 5, REPORT_GLYPH_HEIGHT = 9, REPORT_GLYPH_ADVANCE = 6 };

/**
 * Whether a character has its own glyph: digits, letters (capitals are drawn as small letters), the blank and
 * . , : + - _ % / ( ) = < >
 */
bool report_font_has(char character);

/** Width in pixels of a text whose dots are `scale` pixels wide; 0 for an empty text. */
int report_font_width(const char *text, int scale);

/**
 * Draw a text with the top left of its first glyph at (x, y), cut at the image's edges. Each byte that has no glyph
 * is drawn as a box. scale >= 1.
 */
void report_font_draw(report_image *image, int x, int y, int scale, const char *text, report_color color);

#ifdef __cplusplus
}
#endif
#endif
