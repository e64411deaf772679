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

enum { SIZE = 44, TILES = 9 }; /* a tile is 16 pixels wide */

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

static void record(const kernel_info *kernel, const scene *s, recording tiles[TILES])
{
    kernel_job *job = NULL;
    lrb_ctx *c = NULL;
    recording *into = NULL;
    kernel_counts n = {{0}};
    bvh *tree = trace_tree(s, kernel->defaults.max_leaf);
    assert_int_equal(kernel_job_create(tree, &s->cameras[0], &s->light, SIZE, SIZE, &kernel->defaults, &job, NULL), BASE_OK);
    assert_int_equal(kernel_job_tiles(job), TILES);
    assert_int_equal(lrb_ctx_create(append, &into, &c, NULL), BASE_OK);
    for (uint32_t i = 0; i < TILES; i++) {
        into = &tiles[i];
        kernel->tile[LRB_RECORD](c, job, i, &n);
        lrb_ctx_end(c);
    }
    lrb_ctx_destroy(&c);
    kernel_job_destroy(&job);
    bvh_destroy(&tree);
}

static void compare(const kernel_info *kernel, const scene *s, const char *machine_name)
{
    static core_pair p;
    recording tiles[TILES] = {{0}};
    sim_machine *machine = NULL;
    assert_int_equal(sim_machine_load(machine_name, &machine, NULL), BASE_OK);
    record(kernel, s, tiles);
    p.count = TILES;
    for (size_t i = 0; i < TILES; i++)
        p.tiles[i] = (slow_core_tile){.events = tiles[i].events, .count = tiles[i].count};
    if (!core_pair_run(&p, machine)) {
        core_pair_print_differences(&p);
        fail_msg("%s on %s: the two simulators differ", kernel->name, machine_name);
    }
    assert_true(p.fast.cycles > 10000);
    if (strcmp(machine_name, "ideal") == 0) /* it has no stalls */
        assert_int_equal(p.fast.cycles, p.fast.core.issued_one + p.fast.core.issued_pair);
    for (size_t i = 0; i < TILES; i++)
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
