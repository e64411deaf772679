/* The algorithms for primary rays beside each other, on the same rays: host speed, simulated cycles, and what their trees cost.
 *
 *   bench_algorithms [--size N] [--repeat N] [SCENE...]
 *
 * A SCENE is what scene_open takes (default builtin:rooms-804, hall-60k, conference-282k, tower-2195k and dragon-7m), the image N x N pixels (default 512).
 * One host thread. All kernels must hit the same, bit for bit, or the benchmark fails. Times are of the processor: of the native kernels, taking
 * turns, the median of --repeat runs (default 5); of a tree's building, once. Cycles are those of the core model, machine larrabee. Peak
 * memory is that of a process that opens the scene, builds the tree and traces the image natively. The kernels on the kd-tree have the same one: it
 * is built once, for the first of them, and then read from a file in the folder for temporary ones. Rows of CSV on stdout; lines of
 * '#' name the compiler and the CPU.
 */
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/clock.h"
#include "cli/run.h"
#include "lrbni/ctx.h"
#include "tests/bench/measure.h"

enum { KERNELS = 4 };
static const char *const kernel_names[KERNELS] = {"packet16-primary", "mft-primary", "kd16-primary", "mlrta-primary"};

/* What a process of its own finds out. */
typedef struct tree_cost {
    double build_seconds;
    size_t bytes, peak_bytes;
} tree_cost;

/* One kernel on the scene. */
typedef struct bench {
    run_result native; /* with the tree and the job */
    lrb_ctx *ctx;
    tree_cost tree;
    double seconds[MEASURE_MAX_RUNS];
    double cycles;
} bench;

/* What does not change from scene to scene. */
typedef struct bench_setting {
    measure_picture picture;
    sim_machine *machine;
    char folder[64]; /* of the kd-tree's file */
} bench_setting;

static int fail(const base_error *err)
{
    fprintf(stderr, "bench_algorithms: error: %s: %s\n", err->what, err->why);
    return 1;
}

static base_status run(const scene *s, const bench_setting *set, int kernel, run_model model, run_result *out, base_error *err)
{
    const kernel_info *info = kernel_find(kernel_names[kernel]);
    const unsigned size = set->picture.size;
    const run_options options = {.kernel = info, .params = info->defaults, .width = size, .height = size, .model = model, .jobs = 1,
                                 .cache = set->folder};
    return run_kernel(s, set->machine, &options, out, err);
}

/* Bytes that a traversal reads. */
static size_t tree_bytes(const run_result *r)
{
    const kdtree *k = r->kdtree;
    if (!k)
        return r->tree->node_count * sizeof *r->tree->nodes + r->tree->record_count * sizeof *r->tree->records;
    return k->node_count * sizeof *k->nodes + k->list_count * sizeof *k->lists + k->record_count * sizeof *k->records;
}

/* In the child: open, build, trace; the cost goes into the pipe. */
static int spend(const char *spec, const bench_setting *set, int kernel, int pipe_end)
{
    scene *s = NULL;
    run_result r = {0};
    base_error err = {0};
    tree_cost cost = {0};
    base_status status = scene_open(spec, &s, &err);
    const double start = clock_processor_seconds();
    if (status == BASE_OK)
        status = run(s, set, kernel, RUN_NATIVE, &r, &err);
    if (status != BASE_OK)
        return fail(&err);
    cost.build_seconds = clock_processor_seconds() - start - r.processor_seconds;
    cost.bytes = tree_bytes(&r);
    const int whole = write(pipe_end, &cost, sizeof cost) == (ssize_t)sizeof cost;
    run_result_destroy(&r);
    scene_destroy(&s);
    return !whole;
}

/* A tree's cost, found by a process of its own, so that nobody else's memory counts; false if it failed. */
static bool measure_tree(const char *spec, const bench_setting *set, int kernel, tree_cost *out)
{
    int ends[2], state = 1;
    struct rusage usage;
    if (pipe(ends) != 0)
        return false;
    fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        _exit(spend(spec, set, kernel, ends[1]));
    }
    close(ends[1]);
    const bool whole = child > 0 && read(ends[0], out, sizeof *out) == (ssize_t)sizeof *out;
    close(ends[0]);
    if (child < 0 || wait4(child, &state, 0, &usage) != child || !WIFEXITED(state) || WEXITSTATUS(state) != 0 || !whole)
        return false;
    out->peak_bytes = (size_t)usage.ru_maxrss * 1024;
    return true;
}

static double trace_once(bench *b)
{
    const kernel_job *job = b->native.job;
    kernel_counts n = {{0}};
    const double start = clock_processor_seconds();
    for (uint32_t tile = 0; tile < kernel_job_tiles(job); tile++) {
        lrb_ctx_begin(b->ctx);
        b->native.options.kernel->tile[LRB_NATIVE](b->ctx, job, tile, &n);
        lrb_ctx_end(b->ctx);
    }
    return clock_processor_seconds() - start;
}

static base_status simulate(const scene *s, const bench_setting *set, int kernel, bench *b, base_error *err)
{
    run_result r = {0};
    base_status status = run(s, set, kernel, RUN_CORE, &r, err);
    b->cycles = (double)r.cycles;
    run_result_destroy(&r);
    return status;
}

static bool same_frames(const bench *a, const bench *b)
{
    const kernel_job *job = a->native.job;
    return memcmp(job->frame_host, b->native.job->frame_host, (size_t)job->tiles_x * job->tiles_y * sizeof *job->frame_host) == 0;
}

static void print_row(const scene *s, const measure_picture *o, const bench *b)
{
    const double rays = (double)o->size * o->size, seconds = measure_median(b->seconds, o->repeat);
    printf("algorithms/%s/%s,%u,%.6f,%.0f,%.0f,%.2f,%.3f,%zu,%zu\n", b->native.options.kernel->name, s->name, o->size, seconds, rays / seconds,
           b->cycles, b->cycles / rays, b->tree.build_seconds, b->tree.bytes, b->tree.peak_bytes);
    fflush(stdout);
}

static base_status measure_kernels(const scene *s, const bench_setting *set, bench b[KERNELS], base_error *err)
{
    base_status status = BASE_OK;
    for (int k = 0; status == BASE_OK && k < KERNELS; k++) {
        status = run(s, set, k, RUN_NATIVE, &b[k].native, err);
        if (status == BASE_OK)
            status = lrb_ctx_create(NULL, NULL, &b[k].ctx, err);
        if (status == BASE_OK && !same_frames(&b[0], &b[k]))
            status = base_fail(err, BASE_ERR_INPUT, kernel_names[k], "hits on %s are not those of %s", s->name, kernel_names[0]);
    }
    for (int i = 0; status == BASE_OK && i < set->picture.repeat; i++)
        for (int k = 0; k < KERNELS; k++)
            b[k].seconds[i] = trace_once(&b[k]);
    for (int k = 0; status == BASE_OK && k < KERNELS; k++) {
        status = simulate(s, set, k, &b[k], err);
        if (status == BASE_OK)
            print_row(s, &set->picture, &b[k]);
    }
    return status;
}

/* Whether a kernel has the tree of the one before it: the kd-tree. */
static bool shares_tree(int kernel)
{
    return kernel > 0 && kernel_find(kernel_names[kernel])->accel == KERNEL_ACCEL_KDTREE &&
           kernel_find(kernel_names[kernel - 1])->accel == KERNEL_ACCEL_KDTREE;
}

static int bench_scene(const char *spec, const bench_setting *set)
{
    bench b[KERNELS] = {0};
    scene *s = NULL;
    base_error err = {0};
    for (int k = 0; k < KERNELS; k++) {
        if (shares_tree(k))
            b[k].tree = b[k - 1].tree;
        else if (!measure_tree(spec, set, k, &b[k].tree))
            return 1; /* the child has said why */
    }
    base_status status = scene_open(spec, &s, &err);
    if (status == BASE_OK)
        status = measure_kernels(s, set, b, &err);
    for (int k = 0; k < KERNELS; k++) {
        lrb_ctx_destroy(&b[k].ctx);
        run_result_destroy(&b[k].native);
    }
    scene_destroy(&s);
    return status == BASE_OK ? 0 : fail(&err);
}

/* Remove the tree's files, and the folder. */
static void remove_folder(const char *folder)
{
    DIR *d = opendir(folder);
    struct dirent *e;
    while (d && (e = readdir(d)) != NULL)
        unlinkat(dirfd(d), e->d_name, 0); /* neither . nor .. is a file */
    if (d)
        closedir(d);
    rmdir(folder);
}

/* A scene, in a folder of its own. */
static int bench_in_folder(const char *spec, bench_setting *set)
{
    base_error err = {0};
    snprintf(set->folder, sizeof set->folder, "%s/bench_algorithms.XXXXXX", P_tmpdir);
    if (!mkdtemp(set->folder)) {
        base_fail(&err, BASE_ERR_IO, set->folder, "no folder can be made");
        return fail(&err);
    }
    const int failed = bench_scene(spec, set);
    remove_folder(set->folder);
    return failed;
}

int main(int argc, char **argv)
{
    static const char *const scenes[] = {"builtin:rooms-804", "builtin:hall-60k", "builtin:conference-282k", "builtin:tower-2195k",
                                         "builtin:dragon-7m"};
    bench_setting set = {.picture = {.size = 512, .repeat = 5}};
    base_error err = {0};
    const int first = measure_picture_parse(argc, argv, JOB_MAX_SIZE, &set.picture);
    int failed = 0;
    if (first == 0) {
        fprintf(stderr, "bench_algorithms: error: usage: bench_algorithms [--size 1..%u] [--repeat 1..%d] [SCENE...]\n", JOB_MAX_SIZE, MEASURE_MAX_RUNS);
        return 2;
    }
    if (sim_machine_load("larrabee", &set.machine, &err) != BASE_OK)
        return fail(&err);
    measure_print_head();
    printf("# machine %s; median of %d native runs in turn, one thread\n", set.machine->name, set.picture.repeat);
    printf("row,size,native_seconds,native_rays_per_s,core_cycles,cycles_per_ray,build_cpu_seconds,tree_bytes,peak_bytes\n");
    for (size_t i = 0; first == argc && i < sizeof scenes / sizeof *scenes; i++)
        failed |= bench_in_folder(scenes[i], &set);
    for (int i = first; i < argc; i++)
        failed |= bench_in_folder(argv[i], &set);
    sim_machine_destroy(&set.machine);
    return failed;
}
