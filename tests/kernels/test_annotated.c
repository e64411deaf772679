/* Annotated kernels: the same stream but for the markers, which point at the lines of ops, and at what made their sources. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "kernels/kernel.h"
#include "kernels/sources.h"
#include "scene/builtin.h"
#include "tests/kernels/trace.h"

enum { SIZE = 32 };

/* A tile's events as they come. */
typedef struct stream {
    lrb_event *events;
    size_t count, capacity;
} stream;

static void append(void *user, const lrb_event *events, uint32_t count)
{
    stream *s = user;
    if (s->count + count > s->capacity) {
        s->capacity = 2 * (s->count + count);
        s->events = realloc(s->events, s->capacity * sizeof *s->events);
        assert_non_null(s->events);
    }
    memcpy(s->events + s->count, events, count * sizeof *events);
    s->count += count;
}

static stream record(kernel_tile_fn *tile, const kernel_job *job, uint32_t number)
{
    stream s = {0};
    lrb_ctx *c = NULL;
    kernel_counts n = {{0}};
    assert_int_equal(lrb_ctx_create(append, &s, &c, NULL), BASE_OK);
    tile(c, job, number, &n);
    lrb_ctx_end(c);
    lrb_ctx_destroy(&c);
    return s;
}

/* Does the line, as the sources have it, hold the name of the op? Forms add to the name in front and behind. */
static void check_line(uint32_t site, unsigned id)
{
    static struct {
        uint32_t site;
        unsigned id;
    } checked[4096]; /* most have been looked at before */
    size_t place = (site * 31 + id) % (sizeof checked / sizeof *checked);
    if (checked[place].site == site && checked[place].id == id)
        return;
    checked[place].site = site;
    checked[place].id = id;
    const kernel_source *source = kernel_source_find(site >> 16);
    assert_non_null(source);
    kernel_source_line line = kernel_source_at(source, site & 0xffff);
    if (id == LRB_OP_jcc ? !memmem(line.text, line.length, "lrb_j", 5) :
                           !memmem(line.text, line.length, lrb_op_table[id].id, strlen(lrb_op_table[id].id)))
        if (!((id == LRB_OP_load_ps || id == LRB_OP_load_pi) && memmem(line.text, line.length, "lrb_load_", 9)) &&
            !(id == LRB_OP_cmp && memmem(line.text, line.length, "lrb_cmp_ptr", 11)))
            fail_msg("%s:%u has no %s: %.*s", source->path, site & 0xffff, lrb_op_table[id].id, (int)line.length, line.text);
}

/* A marker of a far source: too far, and not as far as the tile's beginning. */
static void check_far(const lrb_event *e, size_t ops)
{
    assert_true(e->aux >> 2 >= LRB_FAR && e->aux >> 2 <= ops);
}

/* The streams of a tile, side by side; returns the number of lines' markers. */
static size_t compare(const stream *plain, const stream *lines, size_t *far)
{
    size_t markers = 0, at = 0, ops = 0;
    uint32_t site = 0;
    for (size_t i = 0; i < lines->count; i++) {
        const lrb_event *e = &lines->events[i];
        if ((e->op & LRB_EVENT_ID) == LRB_OP_line) {
            assert_int_not_equal(e->aux, site); /* a marker only where the line changes */
            site = e->aux;
            markers++;
            continue;
        }
        if ((e->op & LRB_EVENT_ID) == LRB_OP_far) {
            check_far(e, ops);
            ++*far;
            continue;
        }
        assert_true(at < plain->count);
        assert_memory_equal(e, &plain->events[at], sizeof *e);
        at++;
        if (lrb_op_kind_of((lrb_op_id)(e->op & LRB_EVENT_ID)) == LRB_KIND_MARKER)
            continue;
        ops++;
        check_line(site, e->op & LRB_EVENT_ID);
    }
    assert_int_equal(at, plain->count);
    return markers;
}

static void annotated__every_kernel_and_scene__the_stream_of_record_and_markers(void **state)
{
    size_t kernels, scenes, far = 0;
    const kernel_info *kernel = kernel_list(&kernels);
    const scene_builtin *builtin = scene_builtin_list(&scenes);
    (void)state;
    for (size_t i = 0; i < scenes; i++) {
        scene *s = NULL;
        char spec[128];
        snprintf(spec, sizeof spec, "builtin:%s", builtin[i].name);
        assert_int_equal(scene_open(spec, &s, NULL), BASE_OK);
        for (size_t k = 0; k < kernels; k++) {
            bvh *tree = trace_tree(s, kernel[k].defaults.max_leaf);
            kernel_job *job = NULL;
            assert_int_equal(kernel_job_create(tree, &s->cameras[0], &s->light, SIZE, SIZE, &kernel[k].defaults, &job, NULL), BASE_OK);
            for (uint32_t tile = 0; tile < kernel_job_tiles(job); tile++) {
                stream plain = record(kernel[k].tile[LRB_RECORD], job, tile), lines = record(kernel[k].annotated, job, tile);
                size_t markers = compare(&plain, &lines, &far);
                assert_true(markers > plain.count / 10);
                free(plain.events);
                free(lines.events);
            }
            kernel_job_destroy(&job);
            bvh_destroy(&tree);
        }
        scene_destroy(&s);
    }
    assert_true(far > 0); /* the longest tiles have some */
}

static void sources__lines_and_functions__found(void **state)
{
    static const char text[] = "#include \"a.h\"\n\ntypedef struct s {\n    int i;\n} s;\n\n/* A function. */\nLRB_INLINE void first(lrb_ctx *c,\n"
                               "                      int i)\n{\n    op(c);\n}\n\nstatic int second(void)\n{\n    return 1;\n}";
    const kernel_source source = {1, "a.c", text, sizeof text - 1};
    (void)state;
    assert_int_equal(kernel_source_lines(&source), 17);
    assert_memory_equal(kernel_source_at(&source, 1).text, "#include", 8);
    assert_int_equal(kernel_source_at(&source, 2).length, 0);
    assert_int_equal(kernel_source_at(&source, 17).length, 1);
    assert_null(kernel_source_at(&source, 0).text);
    assert_null(kernel_source_at(&source, 18).text);
    assert_null(kernel_source_function(&source, 4).text);
    assert_null(kernel_source_function(&source, 9).text);
    assert_int_equal(kernel_source_function(&source, 11).length, 5);
    assert_memory_equal(kernel_source_function(&source, 11).text, "first", 5);
    assert_memory_equal(kernel_source_function(&source, 16).text, "second", 6);
}

static void sources__every_number__one_file(void **state)
{
    size_t count;
    const kernel_source *list = kernel_source_list(&count);
    (void)state;
    assert_int_equal(count, KERNEL_SOURCE_MFT_SOFT);
    for (size_t i = 0; i < count; i++) {
        assert_ptr_equal(kernel_source_find(list[i].number), &list[i]);
        assert_int_equal(strlen(list[i].text), list[i].size);
    }
    assert_null(kernel_source_find(0));
    assert_null(kernel_source_find(KERNEL_SOURCE_MFT_SOFT + 1));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(annotated__every_kernel_and_scene__the_stream_of_record_and_markers),
        cmocka_unit_test(sources__lines_and_functions__found),
        cmocka_unit_test(sources__every_number__one_file),
    };
    return cmocka_run_group_tests_name("annotated", tests, NULL, NULL);
}
