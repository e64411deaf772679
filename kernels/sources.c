#include "kernels/sources.h"

#include <ctype.h>
#include <string.h>

#include "kernels/source_texts.h"

const kernel_source *kernel_source_list(size_t *count)
{
    *count = kernel_source_text_count;
    return kernel_source_texts;
}

const kernel_source *kernel_source_find(unsigned number)
{
    for (size_t i = 0; i < kernel_source_text_count; i++)
        if (kernel_source_texts[i].number == number)
            return &kernel_source_texts[i];
    return NULL;
}

unsigned kernel_source_lines(const kernel_source *source)
{
    unsigned lines = 0;
    for (size_t i = 0; i < source->size; i++)
        lines += source->text[i] == '\n';
    return lines + (source->size > 0 && source->text[source->size - 1] != '\n');
}

kernel_source_line kernel_source_at(const kernel_source *source, unsigned number)
{
    const char *line = number ? source->text : NULL, *end = source->text + source->size;
    for (unsigned i = 1; line && i < number; i++) {
        const char *feed = memchr(line, '\n', (size_t)(end - line));
        line = feed ? feed + 1 : NULL;
    }
    if (!line || line == end)
        return (kernel_source_line){NULL, 0};
    const char *feed = memchr(line, '\n', (size_t)(end - line));
    return (kernel_source_line){line, (size_t)((feed ? feed : end) - line)};
}

/* "LRB_INLINE lrb_k16 slab16_test(lrb_ctx *c, ..." gives slab16_test: what stands before the first parenthesis. */
static kernel_source_line name_before_parenthesis(kernel_source_line line)
{
    const char *open = memchr(line.text, '(', line.length), *start = open;
    while (start && start > line.text && (isalnum((unsigned char)start[-1]) || start[-1] == '_'))
        start--;
    return (kernel_source_line){open && start < open ? start : NULL, open ? (size_t)(open - start) : 0};
}

kernel_source_line kernel_source_function(const kernel_source *source, unsigned number)
{
    kernel_source_line name = {NULL, 0}, latest = {NULL, 0};
    const char *end = source->text + source->size;
    unsigned n = 1;
    for (const char *line = source->text; line < end && n <= number; n++) {
        const char *feed = memchr(line, '\n', (size_t)(end - line));
        size_t length = (size_t)((feed ? feed : end) - line);
        if (length > 0 && line[0] == '{')
            name = latest;
        else if (length > 0 && (isalpha((unsigned char)line[0]) || line[0] == '_'))
            latest = name_before_parenthesis((kernel_source_line){line, length});
        line += length + 1;
    }
    return name;
}
