/* Host speed of the kernels by level of accounting, with Embree for scale.
 *
 *   bench_levels [--size N] [--repeat N] [SCENE...]
 *
 * A SCENE is what scene_open takes (default builtin:hall-60k), the image N x N pixels (default 1024). One host thread. Kernels with soft
 * shadows run natively alone, without their filter, beside Embree on the same primary and shadow rays.
 * The ways to run a kernel take turns, so that noise of the host meets all alike; times are the median of --repeat runs
 * (default 5). Rows of CSV on stdout; lines of '#' name the compiler and the CPU, repeat the rows as a table, and
 * compare them with the targets. Missing a target is no failure.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/recorder.h"
#include "kernels/kernel.h"
#include "lrbni/ctx.h"
#include "scene/scene.h"
#include "sim/core.h"
#include "sim/issue.h"
#include "sim/machine.h"
#include "tests/bench/embree_packets.h"
#include "tests/bench/measure.h"

/* Ways to trace an image, in the order in which they take turns. */
typedef enum way { WAY_NATIVE, WAY_COUNT, WAY_RECORD, WAY_ISSUE, WAY_CORE, WAY_EMBREE, WAY_EMBREE_ROBUST, WAYS } way;
static const char *const way_names[WAYS] = {"native", "count", "record", "record+issue", "record+core", "embree16", "embree16-robust"};

static const double target_count_ratio = 1.5, target_count_vector_ops = 500e6, target_issue_events = 150e6,
                    target_core_events = 80e6;

/* One kernel on one scene. */
typedef struct bench {
    const kernel_info *kernel;
    const char *scene_name;
    kernel_job *job;
    lrb_ctx *ctx[WAY_ISSUE + 1];
    sim_issue *issue;
    const sim_machine *machine;
    embree_packets *embree[2]; /* without and with the robust flag; NULL: no Embree */
    int repeat;
    double seconds[WAYS][MEASURE_MAX_RUNS];
    uint64_t ops, vector_ops, events, rays; /* of one image; but for the rays 0 with soft shadows */
    uint64_t hits[2], blocked[2];           /* Embree's */
} bench;

static int fail(const base_error *err)
{
    fprintf(stderr, "bench_levels: error: %s: %s\n", err->what, err->why);
    return 1;
}

static bool is_soft(const bench *b) { return b->job->rows_host != NULL; }

/* Trace the image once at a level of accounting. */
static void trace_kernel(bench *b, way w)
{
    lrb_ctx *c = b->ctx[w];
    kernel_counts n = {0};
    kernel_tile_fn *tile_fn = b->kernel->tile[w == WAY_ISSUE ? LRB_RECORD : (int)w];
    const uint32_t tiles = kernel_job_tiles(b->job);
    uint64_t regions[SIM_MAX_REGIONS + 1];
    for (uint32_t tile = 0; tile < tiles; tile++) {
        lrb_ctx_begin(c);
        if (w == WAY_ISSUE)
            sim_issue_begin(b->issue);
        tile_fn(c, b->job, tile, &n);
        lrb_ctx_end(c);
        if (w == WAY_ISSUE)
            sim_issue_end(b->issue, regions);
    }
    b->rays = n.n[KERNEL_rays];
}

/* Tiles for a simulated core, recorded when it asks for them. */
typedef struct core_feed {
    recorder recorder;
    recording *tiles; /* by hardware thread */
    size_t next, count;
} core_feed;

static base_status next_tile(void *user, unsigned thread, const lrb_event **events, size_t *count, base_error *err)
{
    core_feed *f = user;
    *events = NULL;
    if (f->next == f->count)
        return BASE_OK;
    base_status status = recorder_tile(&f->recorder, f->next++, &f->tiles[thread], err);
    *events = status == BASE_OK ? f->tiles[thread].events : NULL;
    *count = f->tiles[thread].count;
    return status;
}

/* Trace the image once with a core that is cold at first. */
static void trace_core(bench *b)
{
    core_feed f = {.count = kernel_job_tiles(b->job), .tiles = calloc(b->machine->threads, sizeof *f.tiles)};
    const sim_core_feed feed = {.next = next_tile, .user = &f};
    sim_core *core = NULL;
    base_error err = {0};
    const recorder_input input = {.first_pass = f.count, .tiles = f.count, .kernel = b->kernel, .job = b->job};
    base_status status = recorder_create(&input, b->machine, 0, &f.recorder, &err);
    if (status == BASE_OK)
        status = sim_core_create(b->machine, &core, &err);
    if (status == BASE_OK)
        status = sim_core_run(core, &feed, &err);
    if (status != BASE_OK)
        exit(fail(&err));
    for (unsigned t = 0; t < b->machine->threads; t++)
        recording_free(&f.tiles[t]);
    free(f.tiles);
    sim_core_destroy(&core);
    recorder_destroy(&f.recorder);
}

static void trace_embree(bench *b, int robust)
{
    const uint32_t tiles = kernel_job_tiles(b->job);
    b->hits[robust] = b->blocked[robust] = 0;
    for (uint32_t tile = 0; tile < tiles; tile++) {
        b->hits[robust] += embree_packets_trace(b->embree[robust], b->job, tile);
        if (is_soft(b))
            b->blocked[robust] += embree_packets_shadows(b->embree[robust], b->job, tile);
    }
}

static bool has_way(const bench *b, way w)
{
    return w < WAY_EMBREE ? w == WAY_NATIVE || !is_soft(b) : b->embree[w - WAY_EMBREE] != NULL;
}

static double time_way(bench *b, way w)
{
    double start = measure_seconds();
    if (w < WAY_CORE)
        trace_kernel(b, w);
    else if (w == WAY_CORE)
        trace_core(b);
    else
        trace_embree(b, w == WAY_EMBREE_ROBUST);
    return measure_seconds() - start;
}

/* Ops and events of one image, from the first round, which warms the host up and is not timed. */
static void count_work(bench *b)
{
    for (int w = 0; w < WAYS; w++)
        if (has_way(b, (way)w))
            time_way(b, (way)w);
    b->ops = b->vector_ops = b->events = 0;
    for (int id = 0; id < LRB_OP_COUNT; id++) {
        uint64_t n = b->ctx[WAY_COUNT]->ops[id];
        b->ops += n;
        b->vector_ops += lrb_op_kind_of((lrb_op_id)id) == LRB_KIND_VECTOR ? n : 0;
        b->events += sim_issue_get(b->issue)->ops[id];
    }
}

static double seconds_of(const bench *b, way w)
{
    return measure_median(b->seconds[w], b->repeat);
}

static void print_rate(bool known, uint64_t count, double seconds)
{
    if (known)
        printf(",%.0f", (double)count / seconds);
    else
        printf(",");
}

static void print_rows(const bench *b)
{
    for (int w = 0; w < WAYS; w++) {
        if (!has_way(b, (way)w))
            continue;
        const double seconds = seconds_of(b, (way)w);
        printf("levels/%s/%s/%s,%u,%.6f,%.3f", b->kernel->name, way_names[w], b->scene_name, b->job->width, seconds,
               seconds / seconds_of(b, WAY_NATIVE));
        print_rate(w < WAY_EMBREE && b->ops, b->ops, seconds);
        print_rate(w < WAY_EMBREE && b->ops, b->vector_ops, seconds);
        print_rate(w == WAY_RECORD || w == WAY_ISSUE || w == WAY_CORE, b->events, seconds);
        print_rate(true, b->rays, seconds);
        printf("\n");
    }
}

static void print_million(bool known, uint64_t count, double seconds)
{
    if (known)
        printf(" %12.1f", 1e-6 * (double)count / seconds);
    else
        printf(" %12s", "-");
}

static void print_table(const bench *b)
{
    printf("#\n# %s on %s, %ux%u: ", b->kernel->name, b->scene_name, b->job->width, b->job->height);
    if (b->ops)
        printf("%.1f M ops, %.1f M of them 16-lane, %.1f M events; ", 1e-6 * (double)b->ops, 1e-6 * (double)b->vector_ops, 1e-6 * (double)b->events);
    printf("millions a second:\n");
    printf("# %-16s %9s %9s %12s %12s %12s %12s\n", "", "seconds", "x native", "ops", "16-lane ops", "events", "rays");
    for (int w = 0; w < WAYS; w++) {
        if (!has_way(b, (way)w))
            continue;
        const double seconds = seconds_of(b, (way)w);
        printf("# %-16s %9.4f %9.2f", way_names[w], seconds, seconds / seconds_of(b, WAY_NATIVE));
        print_million(w < WAY_EMBREE && b->ops, b->ops, seconds);
        print_million(w < WAY_EMBREE && b->ops, b->vector_ops, seconds);
        print_million(w == WAY_RECORD || w == WAY_ISSUE || w == WAY_CORE, b->events, seconds);
        print_million(true, b->rays, seconds);
        printf("\n");
    }
    if (b->embree[0])
        printf("# Embree: %llu hits, robust %llu, of %llu rays; packets of 16 are %s here\n", (unsigned long long)b->hits[0],
               (unsigned long long)b->hits[1], (unsigned long long)b->rays,
               embree_packets_native16(b->embree[0]) ? "its own code" : "split");
    if (b->embree[0] && is_soft(b))
        printf("# Embree: %llu blocked, robust %llu\n", (unsigned long long)b->blocked[0], (unsigned long long)b->blocked[1]);
}

static void print_target(const char *what, double value, double target, bool at_most, const char *unit)
{
    bool reached = at_most ? value <= target : value >= target;
    printf("# target: %s %s %g%s: %s (%.4g%s)\n", what, at_most ? "at most" : "at least", target, unit,
           reached ? "reached" : "not reached", value, unit);
}

static void print_targets(const bench *b)
{
    const double count = seconds_of(b, WAY_COUNT);
    print_target("count is native times", count / seconds_of(b, WAY_NATIVE), target_count_ratio, true, "");
    print_target("16-lane ops in count", 1e-6 * (double)b->vector_ops / count, 1e-6 * target_count_vector_ops, false, " M/s");
    print_target("events in record+issue", 1e-6 * (double)b->events / seconds_of(b, WAY_ISSUE), 1e-6 * target_issue_events, false,
                 " M/s");
    print_target("events in record+core", 1e-6 * (double)b->events / seconds_of(b, WAY_CORE), 1e-6 * target_core_events, false,
                 " M/s");
}

static base_status create(bench *b, const sim_machine *machine, const bvh *tree, const scene_camera *camera, const scene_light *light,
                          unsigned size, base_error *err)
{
    kernel_params params = b->kernel->defaults;
    params.filter = 0;
    base_status status = kernel_job_create(tree, camera, light, size, size, &params, &b->job, err);
    if (status == BASE_OK)
        status = sim_issue_create(machine, &b->issue, err);
    for (int w = 0; w <= WAY_ISSUE && status == BASE_OK; w++)
        status = lrb_ctx_create(w == WAY_ISSUE ? sim_issue_events : NULL, b->issue, &b->ctx[w], err);
    return status;
}

static void destroy(bench *b)
{
    for (int w = 0; w <= WAY_ISSUE; w++)
        lrb_ctx_destroy(&b->ctx[w]);
    sim_issue_destroy(&b->issue);
    kernel_job_destroy(&b->job);
}

/* One kernel: build its tree, time all ways, print. */
static base_status bench_kernel(const kernel_info *kernel, const scene *s, const sim_machine *machine, embree_packets *embree[2],
                                const measure_picture *o, base_error *err)
{
    bench b = {.kernel = kernel, .scene_name = s->name, .machine = machine, .embree = {embree[0], embree[1]}, .repeat = o->repeat};
    bvh_options build = bvh_options_default();
    const scene_camera *camera;
    bvh *tree = NULL;
    double seconds;
    build.max_leaf = kernel->defaults.max_leaf;
    build.bins = kernel->defaults.bins;
    base_status status = scene_find_camera(s, NULL, &camera, err);
    if (status == BASE_OK)
        status = measure_bvh_build(s, &build, o->repeat, &seconds, &tree, err);
    if (status == BASE_OK)
        status = create(&b, machine, tree, camera, &s->light, o->size, err);
    if (status == BASE_OK) {
        printf("# BVH with leaves of up to %u: %.4f s on one thread, %.3f s per million triangles\n", build.max_leaf, seconds,
               seconds * 1e6 / (double)s->triangle_count);
        count_work(&b);
        for (int run = 0; run < o->repeat; run++)
            for (int w = 0; w < WAYS; w++)
                if (has_way(&b, (way)w))
                    b.seconds[w][run] = time_way(&b, (way)w);
        print_rows(&b);
        print_table(&b);
        if (!is_soft(&b))
            print_targets(&b);
        fflush(stdout);
    }
    destroy(&b);
    bvh_destroy(&tree);
    return status;
}

/* Embree's two trees; without Embree a line that says why not. */
static void create_embree(const scene *s, embree_packets *embree[2])
{
    for (int robust = 0; robust < 2; robust++) {
        base_error err = {0};
        double seconds;
        if (embree_packets_create(s, robust, &seconds, &embree[robust], &err) != BASE_OK)
            printf("# without Embree: %s\n", err.why);
        else
            printf("# Embree's BVH%s: %.4f s on one thread, %.3f s per million triangles\n", robust ? ", robust" : "", seconds,
                   seconds * 1e6 / (double)s->triangle_count);
    }
}

static int bench_scene(const char *spec, const sim_machine *machine, const measure_picture *o)
{
    static const char *const kernels[] = {"packet16-primary", "mft-primary", "packet16-soft", "mft-soft"};
    scene *s = NULL;
    embree_packets *embree[2] = {NULL, NULL};
    base_error err = {0};
    base_status status = scene_open(spec, &s, &err);
    if (status != BASE_OK)
        return fail(&err);
    printf("# %s: %zu triangles\n", s->name, s->triangle_count);
    create_embree(s, embree);
    for (size_t i = 0; i < sizeof kernels / sizeof *kernels && status == BASE_OK; i++)
        status = bench_kernel(kernel_find(kernels[i]), s, machine, embree, o, &err);
    for (int robust = 0; robust < 2; robust++)
        embree_packets_destroy(&embree[robust]);
    scene_destroy(&s);
    return status == BASE_OK ? 0 : fail(&err);
}

int main(int argc, char **argv)
{
    measure_picture o = {.size = 1024, .repeat = 5};
    sim_machine *machine = NULL;
    base_error err = {0};
    int failed = 0, first = measure_picture_parse(argc, argv, JOB_MAX_SIZE, &o);
    if (first == 0) {
        fprintf(stderr, "bench_levels: error: usage: bench_levels [--size 1..%u] [--repeat 1..%d] [SCENE...]\n", JOB_MAX_SIZE,
                MEASURE_MAX_RUNS);
        return 2;
    }
    if (sim_machine_load("larrabee", &machine, &err) != BASE_OK)
        return fail(&err);
    measure_print_head();
    printf("# machine %s; median of %d runs in turn, one thread\n", machine->name, o.repeat);
    printf("row,size,seconds,times_native,ops_per_s,vector_ops_per_s,events_per_s,rays_per_s\n");
    if (first == argc)
        failed = bench_scene("builtin:hall-60k", machine, &o);
    for (int i = first; i < argc; i++)
        failed |= bench_scene(argv[i], machine, &o);
    sim_machine_destroy(&machine);
    return failed;
}
