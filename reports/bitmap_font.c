#include "reports/bitmap_font.h"

#include <assert.h>
#include <string.h>

enum { GLYPH_ROWS = 7 };

typedef struct glyph {
    char character;
    int drop; /* rows by which a descender hangs below the others */
    const char *rows[GLYPH_ROWS];
} glyph;

/* {'-', 0, {".....", ".....", ".....", ".###.", ".....", ".....", "....."}}, */
#define GLYPH(character, drop, ...) {character, drop, {__VA_ARGS__}},
static const glyph glyphs[] = {
#include "reports/glyphs.def"
};
#undef GLYPH

static const glyph missing = {'\0', 0, {"#####", "#...#", "#...#", "#...#", "#...#", "#...#", "#####"}};

static const glyph *find(char character)
{
    if (character >= 'A' && character <= 'Z')
        character = (char)(character - 'A' + 'a');
    for (size_t i = 0; i < sizeof glyphs / sizeof *glyphs; i++)
        if (glyphs[i].character == character)
            return &glyphs[i];
    return &missing;
}

bool report_font_has(char character)
{
    return find(character) != &missing;
}

int report_font_width(const char *text, int scale)
{
    size_t length = strlen(text);
    return length ? ((int)length * REPORT_GLYPH_ADVANCE - (REPORT_GLYPH_ADVANCE - REPORT_GLYPH_WIDTH)) * scale : 0;
}

void report_font_draw(report_image *image, int x, int y, int scale, const char *text, report_color color)
{
    assert(scale >= 1);
    for (; *text; text++, x += REPORT_GLYPH_ADVANCE * scale) {
        const glyph *g = find(*text);
        for (int row = 0; row < GLYPH_ROWS; row++)
            for (int dot = 0; dot < REPORT_GLYPH_WIDTH; dot++)
                if (g->rows[row][dot] == '#')
                    report_image_fill(image, x + dot * scale, y + (g->drop + row) * scale, scale, scale, color);
    }
}
