/* The core model on recorded kernels: the fast simulator and the slow one give the same numbers. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "kernels/kernel.h"
#include "scene/scene.h"
#include "tests/kernels/trace.h"
#include "tests/sim/core_pair.h"

enum { SIZE = 44, MOST_TILES = 18 }; /* a tile is 16 pixels wide; a second pass has as many */

/* The events of a tile. */
typedef struct recording {
    lrb_event *events; /* owned */
    size_t count;
} recording;

static void append(void *user, const lrb_event *events, uint32_t count)
{
    recording *r = *(recording **)user;
    r->events = realloc(r->events, (r->count + count) * sizeof *events);
    assert_non_null(r->events);
    memcpy(r->events + r->count, events, count * sizeof *events);
    r->count += count;
}

/* Returns the number of tiles. */
static uint32_t record(const kernel_info *kernel, const scene *s, recording tiles[MOST_TILES])
{
    lrb_ctx *c = NULL;
    recording *into = NULL;
    kernel_counts n = {{0}};
    kernel_params params = kernel->defaults;
    params.its = 0; /* a tile a unit of work */
    trace_trees trees = trace_trees_of(kernel, s, &s->cameras[0]);
    kernel_job *job = trace_job(&(trace_request){.kernel = kernel->name, .tree = trees.tree, .kdtree = trees.kdtree, .params = &params,
                                                 .camera = &s->cameras[0], .light = &s->light, .width = SIZE, .height = SIZE});
    const uint32_t count = kernel_job_tiles(job);
    assert_int_equal(kernel_job_first_pass(job), MOST_TILES / 2);
    assert_true(count <= MOST_TILES);
    assert_int_equal(lrb_ctx_create(append, &into, &c, NULL), BASE_OK);
    for (uint32_t i = 0; i < count; i++) {
        into = &tiles[i];
        kernel->tile[LRB_RECORD](c, job, i, &n);
        lrb_ctx_end(c);
    }
    lrb_ctx_destroy(&c);
    kernel_job_destroy(&job);
    trace_trees_destroy(&trees);
    return count;
}

static void compare(const kernel_info *kernel, const scene *s, const char *machine_name)
{
    static core_pair p;
    recording tiles[MOST_TILES] = {{0}};
    sim_machine *machine = NULL;
    assert_int_equal(sim_machine_load(machine_name, &machine, NULL), BASE_OK);
    p.count = record(kernel, s, tiles);
    for (size_t i = 0; i < p.count; i++)
        p.tiles[i] = (slow_core_tile){.events = tiles[i].events, .count = tiles[i].count};
    if (!core_pair_run(&p, machine)) {
        core_pair_print_differences(&p);
        fail_msg("%s on %s: the two simulators differ", kernel->name, machine_name);
    }
    assert_true(p.fast.cycles > 10000);
    if (strcmp(machine_name, "ideal") == 0) /* it has no stalls */
        assert_int_equal(p.fast.cycles, p.fast.core.issued_one + p.fast.core.issued_pair);
    for (size_t i = 0; i < p.count; i++)
        free(tiles[i].events);
    sim_machine_destroy(&machine);
}

static void recorded__every_kernel_and_machine__fast_equals_slow(void **state)
{
    (void)state;
    size_t kernels, machines;
    const kernel_info *kernel = kernel_list(&kernels);
    const char *const *names = sim_machine_names(&machines);
    scene *s = NULL;
    assert_int_equal(scene_open("builtin:rooms-804", &s, NULL), BASE_OK);
    for (size_t k = 0; k < kernels; k++)
        for (size_t m = 0; m < machines; m++)
            compare(&kernel[k], s, names[m]);
    scene_destroy(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(recorded__every_kernel_and_machine__fast_equals_slow),
    };
    return cmocka_run_group_tests_name("kernels/core", tests, NULL, NULL);
}
