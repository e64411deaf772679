#include "reports/html_page.h"

#include <errno.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "reports/text.h"

enum {
    SECTIONS_WORTH_LISTING = 3,
    PNG_HEAD_BYTES = 24, /* signature, then the length, name, width and height of the first chunk */
    BASE64_LINE = 76 / 4 * 3 /* source bytes a line */
};

static const size_t PICTURE_MAX_BYTES = (size_t)1 << 28;

/* STYLE(line) expands to: line "\n", */
#define STYLE(line) line "\n",
static const char *const style_lines[] = {
#include "reports/html_style.def"
};
#undef STYLE

struct report_page {
    char *title;
    FILE *body; /* writes to body_text */
    char *body_text;
    size_t body_bytes;
    FILE *sections; /* list items for the top of the page; writes to sections_text */
    char *sections_text;
    size_t sections_bytes;
    int sections_count;
    bool no_memory;
};

report_page *report_page_create(const char *title)
{
    report_page *page = calloc(1, sizeof *page);
    if (!page)
        return NULL;
    page->title = report_text_clean(title);
    page->body = open_memstream(&page->body_text, &page->body_bytes);
    page->sections = open_memstream(&page->sections_text, &page->sections_bytes);
    if (!page->title || !page->body || !page->sections)
        report_page_destroy(&page);
    return page;
}

void report_page_destroy(report_page **page)
{
    report_page *p = *page;
    *page = NULL;
    if (!p)
        return;
    if (p->body)
        fclose(p->body);
    if (p->sections)
        fclose(p->sections);
    free(p->body_text);
    free(p->sections_text);
    free(p->title);
    free(p);
}

static void put_element(FILE *out, const char *start, const char *text, const char *end)
{
    fputs(start, out);
    report_text_print_html(out, text);
    fputs(end, out);
}

void report_page_add_heading(report_page *page, int level, const char *text)
{
    if (!page)
        return;
    if (level > 1) {
        put_element(page->body, "<h3>", text, "</h3>\n");
        return;
    }
    page->sections_count++;
    fprintf(page->sections, "<li><a href=\"#section-%d\">", page->sections_count);
    put_element(page->sections, "", text, "</a></li>\n");
    fprintf(page->body, "<h2 id=\"section-%d\">", page->sections_count);
    put_element(page->body, "", text, "</h2>\n");
}

void report_page_add_paragraph(report_page *page, const char *text)
{
    if (page)
        put_element(page->body, "<p>", text, "</p>\n");
}

void report_page_add_code(report_page *page, const char *text)
{
    if (!page)
        return;
    char *copy = strdup(text);
    page->no_memory = page->no_memory || !copy;
    fputs("<pre><code>", page->body);
    for (char *line = copy, *next; line; line = next) {
        next = strchr(line, '\n');
        if (next)
            *next++ = '\0';
        put_element(page->body, "", line, next ? "\n" : "");
    }
    fputs("</code></pre>\n", page->body);
    free(copy);
}

base_status report_page_add_table(report_page *page, const report_table *table, base_error *err)
{
    if (!page)
        return base_fail(err, BASE_ERR_NOMEM, "page", "out of memory");
    return report_table_write_html(table, page->body, err);
}

/* A picture's file in memory. */
typedef struct picture {
    unsigned char *bytes;
    size_t size;
    uint32_t width, height;
} picture;

static uint32_t big_endian(const unsigned char *byte)
{
    return (uint32_t)byte[0] << 24 | (uint32_t)byte[1] << 16 | (uint32_t)byte[2] << 8 | byte[3];
}

static base_status read_stream(const char *path, FILE *in, picture *p, base_error *err)
{
    size_t room = 0;
    do {
        room = room ? 2 * room : 65536;
        unsigned char *bytes = realloc(p->bytes, room);
        if (!bytes)
            return base_fail(err, BASE_ERR_NOMEM, path, "out of memory");
        p->bytes = bytes;
        p->size += fread(p->bytes + p->size, 1, room - p->size, in);
    } while (p->size == room && room < PICTURE_MAX_BYTES);
    if (ferror(in))
        return base_fail(err, BASE_ERR_INPUT, path, "cannot be read: %s", strerror(errno));
    if (p->size == room)
        return base_fail(err, BASE_ERR_INPUT, path, "is too large for a page");
    return BASE_OK;
}

static base_status read_picture(const char *path, picture *p, base_error *err)
{
    static const unsigned char signature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    *p = (picture){0};
    FILE *in = fopen(path, "rb");
    if (!in)
        return base_fail(err, BASE_ERR_INPUT, path, "cannot be read: %s", strerror(errno));
    base_status status = read_stream(path, in, p, err);
    fclose(in);
    if (status == BASE_OK && (p->size < PNG_HEAD_BYTES || memcmp(p->bytes, signature, sizeof signature) != 0 ||
                              memcmp(p->bytes + 12, "IHDR", 4) != 0))
        status = base_fail(err, BASE_ERR_INPUT, path, "is no PNG file");
    if (status != BASE_OK) {
        free(p->bytes);
        return status;
    }
    p->width = big_endian(p->bytes + 16);
    p->height = big_endian(p->bytes + 20);
    return BASE_OK;
}

static void put_base64(FILE *out, const unsigned char *bytes, size_t size)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        size_t count = size - i < 3 ? size - i : 3;
        uint32_t group = (uint32_t)bytes[i] << 16;
        group |= count > 1 ? (uint32_t)bytes[i + 1] << 8 : 0;
        group |= count > 2 ? bytes[i + 2] : 0;
        if (i && i % BASE64_LINE == 0)
            fputc('\n', out);
        fputc(digits[group >> 18], out);
        fputc(digits[group >> 12 & 63], out);
        fputc(count > 1 ? digits[group >> 6 & 63] : '=', out);
        fputc(count > 2 ? digits[group & 63] : '=', out);
    }
}

static void put_picture(FILE *out, const report_figure *figure, const picture *p)
{
    fprintf(out, "<figure class=\"picture\"><img width=\"%lu\" height=\"%lu\" alt=\"", (unsigned long)p->width,
            (unsigned long)p->height);
    put_element(out, "", figure->alt, "\" src=\"data:image/png;base64,");
    put_base64(out, p->bytes, p->size);
    fputs("\">", out);
    if (figure->caption)
        put_element(out, "<figcaption>", figure->caption, "</figcaption>");
    fputs("</figure>\n", out);
}

base_status report_page_add_pictures(report_page *page, const report_figure *figures, size_t count, base_error *err)
{
    if (!page)
        return base_fail(err, BASE_ERR_NOMEM, "page", "out of memory");
    picture *pictures = calloc(count ? count : 1, sizeof *pictures);
    if (!pictures)
        return base_fail(err, BASE_ERR_NOMEM, "page", "out of memory");
    base_status status = BASE_OK;
    size_t read = 0;
    while (read < count && status == BASE_OK) {
        status = read_picture(figures[read].path, &pictures[read], err);
        read += status == BASE_OK;
    }
    if (status == BASE_OK) {
        fprintf(page->body, "<div class=\"pictures%s\">\n", count == 1 ? " single" : "");
        for (size_t i = 0; i < count; i++)
            put_picture(page->body, &figures[i], &pictures[i]);
        fputs("</div>\n", page->body);
    }
    for (size_t i = 0; i < read; i++)
        free(pictures[i].bytes);
    free(pictures);
    return status;
}

static void put_head(const report_page *page, FILE *out)
{
    fputs("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
          "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n",
          out);
    put_element(out, "<title>", page->title, "</title>\n<style>\n");
    for (size_t i = 0; i < sizeof style_lines / sizeof *style_lines; i++)
        fputs(style_lines[i], out);
    fputs("</style>\n</head>\n", out);
}

base_status report_page_write(report_page *page, FILE *out, base_error *err)
{
    /* A memory stream only fails when there is no memory. */
    if (!page || page->no_memory || fflush(page->body) != 0 || fflush(page->sections) != 0 || ferror(page->body) ||
        ferror(page->sections))
        return base_fail(err, BASE_ERR_NOMEM, "page", "out of memory");
    put_head(page, out);
    put_element(out, "<body>\n<main>\n<h1>", page->title, "</h1>\n");
    if (page->sections_count >= SECTIONS_WORTH_LISTING)
        fprintf(out, "<nav aria-label=\"Sections\">\n<ol>\n%s</ol>\n</nav>\n", page->sections_text);
    fwrite(page->body_text, 1, page->body_bytes, out);
    fputs("</main>\n</body>\n</html>\n", out);
    return BASE_OK;
}
