/* Annotated kernels: the same stream but for the markers, which point at the lines of ops, and at what made their sources. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
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

/* Calls whose names are not that of the op, or of one of them. */
static const struct {
    unsigned id;
    const char *name;
} other_names[] = {
    {LRB_OP_jcc, "lrb_j"},
    {LRB_OP_cmp, "lrb_cmp_ptr"},
    {LRB_OP_load_ps, "lrb_load_"},
    {LRB_OP_load_ps, "lrb_mask_load_1to16_ps"},
    {LRB_OP_load_pi, "lrb_load_"},
    {LRB_OP_store_ps, "lrb_store_4_ps"},
    {LRB_OP_gatherd_ps, "lrb_gather_all_ps"}, /* the loop of a whole gather is one call */
    {LRB_OP_kortest, "lrb_gather_all_ps"},
    {LRB_OP_jcc, "lrb_gather_all_ps"},
};

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
    const char *name = lrb_op_table[id].id;
    for (size_t i = 0; i < sizeof other_names / sizeof *other_names; i++)
        if (id == other_names[i].id && memmem(line.text, line.length, other_names[i].name, strlen(other_names[i].name)))
            name = other_names[i].name;
    if (!memmem(line.text, line.length, name, strlen(name)))
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
        if (at >= plain->count)
            fail_msg("%zu ops, and more with lines", plain->count);
        if (memcmp(e, &plain->events[at], sizeof *e) != 0)
            fail_msg("event %zu differs", at);
        at++;
        if (lrb_op_kind_of((lrb_op_id)(e->op & LRB_EVENT_ID)) == LRB_KIND_MARKER)
            continue;
        ops++;
        check_line(site, e->op & LRB_EVENT_ID);
    }
    assert_int_equal(at, plain->count);
    return markers;
}

static void annotated__every_kernel_usual_scenes__the_stream_of_record_and_markers(void **state)
{
    size_t kernels, scenes, far = 0;
    const kernel_info *kernel = kernel_list(&kernels);
    const char *const *spec = scene_builtin_usual(&scenes);
    (void)state;
    for (size_t i = 0; i < scenes; i++) {
        scene *s = NULL;
        assert_int_equal(scene_open(spec[i], &s, NULL), BASE_OK);
        for (size_t k = 0; k < kernels; k++) {
            trace_trees trees = trace_trees_of(&kernel[k], s, &s->cameras[0]);
            kernel_job *job = trace_job(&(trace_request){.kernel = kernel[k].name, .tree = trees.tree, .kdtree = trees.kdtree,
                                                         .camera = &s->cameras[0], .light = &s->light, .width = SIZE, .height = SIZE});
            for (uint32_t tile = 0; tile < kernel_job_tiles(job); tile++) {
                stream plain = record(kernel[k].tile[LRB_RECORD], job, tile), lines = record(kernel[k].annotated, job, tile);
                size_t markers = compare(&plain, &lines, &far);
                assert_true(markers > plain.count / 10);
                free(plain.events);
                free(lines.events);
            }
            kernel_job_destroy(&job);
            trace_trees_destroy(&trees);
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
    assert_int_equal(count, KERNEL_SOURCE_END - 1);
    for (size_t i = 0; i < count; i++) {
        assert_ptr_equal(kernel_source_find(list[i].number), &list[i]);
        assert_int_equal(strlen(list[i].text), list[i].size);
    }
    assert_null(kernel_source_find(0));
    assert_null(kernel_source_find(KERNEL_SOURCE_END));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(annotated__every_kernel_usual_scenes__the_stream_of_record_and_markers),
        cmocka_unit_test(sources__lines_and_functions__found),
        cmocka_unit_test(sources__every_number__one_file),
    };
    return cmocka_run_group_tests_name("annotated", tests, NULL, NULL);
}
