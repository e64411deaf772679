/* Sampled simulation against the truth: how often the stated interval holds the cycles of the full core model.
 *
 *   bench_sample [--size N] [--trials N] [--error E,E,...] [--kernel NAME] [--scene SCENE]
 *
 * For the kernel, or both of primary rays on the BVH, and the scene, or each of three built-in ones, the image is simulated in full once, and then sampled with that many seeds. Rows of
 * CSV on stdout: trials whose interval holds the truth, mean and root mean square of their relative errors, mean half-width, tiles and
 * seconds of the host's processor, and how many times faster than the full run that is; lines of '#' name the compiler and the CPU.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "cli/run.h"
#include "scene/builtin.h"
#include "scene/scene.h"
#include "tests/bench/measure.h"

/* Sums over the trials. */
typedef struct trials {
    int count, hold;
    double error, squares, half_width, tiles, seconds;
} trials;

/* Run the kernel; seconds of the host's processor, which other work on the host does not count among, tree and all. */
static base_status run_timed(const scene *s, const sim_machine *machine, const run_options *options, run_result *r, double *seconds, base_error *err)
{
    const clock_t begin = clock();
    base_status status = run_kernel(s, machine, options, r, err);
    *seconds = (double)(clock() - begin) / CLOCKS_PER_SEC;
    return status;
}

static base_status sample(const scene *s, const sim_machine *machine, run_options *options, double truth, trials *t, base_error *err)
{
    run_result r;
    double seconds;
    options->seed = (uint64_t)t->count * 7919 + 1;
    base_status status = run_timed(s, machine, options, &r, &seconds, err);
    if (status == BASE_OK) {
        double error = (double)r.cycles / truth - 1;
        t->count++;
        t->hold += fabs((double)r.cycles - truth) <= r.estimate.half_width_95 * (double)r.cycles;
        t->error += error;
        t->squares += error * error;
        t->half_width += r.estimate.half_width_95;
        t->tiles += (double)r.estimate.tiles_simulated;
        t->seconds += seconds;
    }
    run_result_destroy(&r);
    return status;
}

/* What the trials are held against. */
typedef struct truth {
    double cycles, seconds;
} truth;

static base_status bench_error(const scene *s, const sim_machine *machine, run_options *options, const truth *full, int count, base_error *err)
{
    base_status status = BASE_OK;
    trials t = {0};
    while (status == BASE_OK && t.count < count)
        status = sample(s, machine, options, full->cycles, &t, err);
    if (status != BASE_OK)
        return status;
    printf("%s,%s,%u,%g,%d,%d,%.6f,%.6f,%.6f,%.1f,%.4f,%.4f,%.1f\n", options->kernel->name, s->name, options->width, options->error, t.count, t.hold,
           t.error / t.count, sqrt(t.squares / t.count), t.half_width / t.count, t.tiles / t.count, full->seconds, t.seconds / t.count, full->seconds / (t.seconds / t.count));
    fflush(stdout);
    return BASE_OK;
}

/* The full run once, then samples of every error. */
static base_status bench_scene(const scene *s, const sim_machine *machine, run_options *options, const char *errors, int count, base_error *err)
{
    run_result r;
    truth full;
    options->error = 0;
    base_status status = run_timed(s, machine, options, &r, &full.seconds, err);
    full.cycles = (double)r.cycles;
    run_result_destroy(&r);
    for (const char *at = errors; status == BASE_OK && at; at = strchr(at, ',') ? strchr(at, ',') + 1 : NULL) {
        options->error = strtod(at, NULL);
        status = bench_error(s, machine, options, &full, count, err);
    }
    return status;
}

/* What is sampled. */
typedef struct plan {
    const char *kernel, *scene; /* or NULL: all */
    const char *errors;
    int trials;
} plan;

static base_status bench_run(const plan *p, const char *kernel, const char *spec, const sim_machine *machine, run_options *options, base_error *err)
{
    scene *s = NULL;
    options->kernel = kernel_find(kernel);
    if (!options->kernel)
        return base_fail(err, BASE_ERR_USAGE, "--kernel", "no kernel '%s'", kernel);
    options->params = options->kernel->defaults;
    base_status status = scene_open(spec, &s, err);
    if (status == BASE_OK)
        status = bench_scene(s, machine, options, p->errors, p->trials, err);
    scene_destroy(&s);
    return status;
}

static base_status bench_all(const plan *p, const sim_machine *machine, run_options *options, base_error *err)
{
    static const char *const kernels[] = {"packet16-primary", "mft-primary"};
    const char *const *kernel = p->kernel ? &p->kernel : kernels, *const *spec = &p->scene;
    const size_t kernel_count = p->kernel ? 1 : 2;
    size_t scenes = 1;
    if (!p->scene)
        spec = scene_builtin_usual(&scenes);
    base_status status = BASE_OK;
    for (size_t i = 0; status == BASE_OK && i < kernel_count * scenes; i++)
        status = bench_run(p, kernel[i % kernel_count], spec[i / kernel_count], machine, options, err);
    return status;
}

int main(int argc, char **argv)
{
    base_error err = {0};
    sim_machine *machine = NULL;
    run_options options = {.width = 512, .height = 512, .model = RUN_CORE, .jobs = 1};
    plan p = {.errors = "0.03", .trials = 40};
    for (int i = 1; i + 1 < argc; i += 2) {
        if (strcmp(argv[i], "--size") == 0)
            options.width = options.height = (unsigned)strtoul(argv[i + 1], NULL, 10);
        else if (strcmp(argv[i], "--trials") == 0)
            p.trials = (int)strtol(argv[i + 1], NULL, 10);
        else if (strcmp(argv[i], "--error") == 0)
            p.errors = argv[i + 1];
        else if (strcmp(argv[i], "--kernel") == 0)
            p.kernel = argv[i + 1];
        else if (strcmp(argv[i], "--scene") == 0)
            p.scene = argv[i + 1];
        else
            return fprintf(stderr, "bench_sample: error: %s: no such option\n", argv[i]), 2;
    }
    measure_print_head();
    printf("kernel,scene,size,error,trials,hold,bias,rms,half_width,tiles,full_s,sampled_s,times_faster\n");
    base_status status = sim_machine_load("larrabee", &machine, &err);
    if (status == BASE_OK)
        status = bench_all(&p, machine, &options, &err);
    sim_machine_destroy(&machine);
    if (status != BASE_OK)
        fprintf(stderr, "bench_sample: error: %s: %s\n", err.what, err.why);
    return status == BASE_OK ? 0 : 1;
}
