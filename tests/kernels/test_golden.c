/* Pictures, counts and event streams of the built-in scenes against a stored file: one build of the kernels against all
 * others, whatever the host's back end, the compiler, its level of optimisation or its liking for contracted
 * multiply-adds (hard case X14).
 *
 * usage: test_golden FILE            compare
 *        test_golden --update FILE   write the file: when a kernel, a scene or the op table was changed on purpose
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/builtin.h"
#include "tests/kernels/trace.h"

enum { SIZE = 32, MOST_LINES = 128, MOST_CHARACTERS = 2048 };

typedef struct golden {
    char lines[MOST_LINES][MOST_CHARACTERS];
    int count;
} golden;

static uint64_t ops_of_kind(const trace_picture *p, lrb_op_kind kind)
{
    uint64_t sum = 0;
    for (int op = 0; op < LRB_OP_COUNT; op++)
        if (lrb_op_kind_of((lrb_op_id)op) == kind)
            sum += p->ops[op];
    return sum;
}

/* One line: what was run, a hash of all pixels, every counter, ops by kind, and a hash of the event stream. */
static void add_line(golden *g, const char *scene_name, const kernel_info *kernel, unsigned cull, const trace_picture *p)
{
    char *line = g->lines[g->count++];
    size_t room = MOST_CHARACTERS;
    int n = snprintf(line, room, "%s %s cull_backface=%u picture=%016" PRIx64, scene_name, kernel->name, cull, trace_hash(p));
    for (int i = 0; i < KERNEL_COUNTER_COUNT; i++)
        if (kernel->counters >> i & 1)
            n += snprintf(line + n, room - (size_t)n, " %s=%" PRIu64, kernel_counter_table[i].name, p->counts.n[i]);
    n += snprintf(line + n, room - (size_t)n, " vector=%" PRIu64 " mask=%" PRIu64 " scalar=%" PRIu64 " branch=%" PRIu64,
                  ops_of_kind(p, LRB_KIND_VECTOR), ops_of_kind(p, LRB_KIND_MASK), ops_of_kind(p, LRB_KIND_SCALAR),
                  ops_of_kind(p, LRB_KIND_BRANCH));
    snprintf(line + n, room - (size_t)n, " idle_lanes=%" PRIu64 " events=%" PRIu64 ":%016" PRIx64, p->idle_lanes, p->events,
             p->events_hash);
}

/* All lines, traced now; the levels are compared with each other on the way. */
static golden golden_trace(void)
{
    static golden g;
    size_t scenes, kernels;
    const kernel_info *kernel_table = kernel_list(&kernels);
    const char *const *spec = scene_builtin_usual(&scenes);
    g.count = 0;
    for (size_t i = 0; i < scenes; i++) {
        scene *s = NULL;
        assert_int_equal(scene_open(spec[i], &s, NULL), BASE_OK);
        for (size_t k = 0; k < kernels; k++) {
            const kernel_info *kernel = &kernel_table[k];
            trace_trees trees = trace_trees_of(kernel, s, &s->cameras[0]);
            for (unsigned cull = 0; cull < 2; cull++) {
                trace_request request = {.kernel = kernel->name, .tree = trees.tree, .kdtree = trees.kdtree, .camera = &s->cameras[0], .width = SIZE,
                                         .height = SIZE, .cull = cull, .light = &s->light, .level = LRB_RECORD, .jobs = 2};
                trace_picture record = trace_run(&request);
                request.level = LRB_NATIVE;
                trace_picture native = trace_run(&request);
                trace_assert_equal(&record, &native, spec[i]);
                assert_true(g.count < MOST_LINES);
                add_line(&g, s->name, kernel, cull, &record);
                trace_free(&record);
                trace_free(&native);
            }
            trace_trees_destroy(&trees);
        }
        scene_destroy(&s);
    }
    return g;
}

static const char *golden_path;

static void golden__builtin_scenes__as_stored(void **state)
{
    golden now = golden_trace();
    char line[MOST_CHARACTERS + 2];
    int read = 0;
    (void)state;
    FILE *f = fopen(golden_path, "r");
    assert_non_null(f);
    while (fgets(line, sizeof line, f)) {
        if (line[0] == '#')
            continue;
        line[strcspn(line, "\n")] = 0;
        if (read >= now.count || strcmp(line, now.lines[read]) != 0)
            fail_msg("stored: %s\n#    now: %s", line, read < now.count ? now.lines[read] : "(nothing)");
        read++;
    }
    fclose(f);
    assert_int_equal(read, now.count);
}

static void golden__update__written(void **state)
{
    golden now = golden_trace();
    FILE *f = fopen(golden_path, "w");
    (void)state;
    assert_non_null(f);
    fprintf(f, "# Written by `ninja -C build update-golden-kernels`: %d x %d pixels, the scenes' own cameras.\n", SIZE, SIZE);
    for (int i = 0; i < now.count; i++)
        fprintf(f, "%s\n", now.lines[i]);
    assert_int_equal(fclose(f), 0);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest compare[] = {cmocka_unit_test(golden__builtin_scenes__as_stored)};
    const struct CMUnitTest update[] = {cmocka_unit_test(golden__update__written)};
    if (argc < 2)
        return 2;
    golden_path = argv[argc - 1];
    return argc > 2 ? cmocka_run_group_tests_name("golden", update, NULL, NULL)
                    : cmocka_run_group_tests_name("golden", compare, NULL, NULL);
}
