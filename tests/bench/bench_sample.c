/* Sampled simulation against the truth: how often the stated interval holds the cycles of the full core model.
 *
 *   bench_sample [--size N] [--trials N] [--error E]
 *
 * For both kernels and every built-in scene the image is simulated in full once, and then sampled with that many seeds. Rows of
 * CSV on stdout: trials whose interval holds the truth, mean and root mean square of their relative errors, mean tiles and
 * seconds, and how many times faster than the full run that is; lines of '#' name the compiler and the CPU.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/run.h"
#include "scene/builtin.h"
#include "scene/scene.h"
#include "tests/bench/measure.h"

/* Sums over the trials. */
typedef struct trials {
    int count, hold;
    double error, squares, tiles, seconds;
} trials;

static base_status sample(const scene *s, const sim_machine *machine, run_options *options, double truth, trials *t, base_error *err)
{
    run_result r;
    options->seed = (uint64_t)t->count * 7919 + 1;
    base_status status = run_kernel(s, machine, options, &r, err);
    if (status == BASE_OK) {
        double error = (double)r.cycles / truth - 1;
        t->count++;
        t->hold += fabs((double)r.cycles - truth) <= r.estimate.half_width_95 * (double)r.cycles;
        t->error += error;
        t->squares += error * error;
        t->tiles += (double)r.estimate.tiles_simulated;
        t->seconds += r.kernel_seconds;
    }
    run_result_destroy(&r);
    return status;
}

static base_status bench_scene(const scene *s, const sim_machine *machine, run_options *options, double error, int count, base_error *err)
{
    run_result full;
    options->error = 0;
    base_status status = run_kernel(s, machine, options, &full, err);
    const double truth = (double)full.cycles, seconds = full.kernel_seconds;
    run_result_destroy(&full);
    options->error = error;
    trials t = {0};
    while (status == BASE_OK && t.count < count)
        status = sample(s, machine, options, truth, &t, err);
    if (status != BASE_OK)
        return status;
    printf("%s,%s,%u,%g,%d,%d,%.6f,%.6f,%.1f,%.4f,%.4f,%.1f\n", options->kernel->name, s->name, options->width, error, t.count, t.hold,
           t.error / t.count, sqrt(t.squares / t.count), t.tiles / t.count, seconds, t.seconds / t.count, seconds / (t.seconds / t.count));
    fflush(stdout);
    return BASE_OK;
}

static base_status bench_all(const sim_machine *machine, run_options *options, double error, int count, base_error *err)
{
    static const char *const kernels[] = {"packet16-primary", "mft-primary"};
    size_t scenes;
    const char *const *spec = scene_builtin_usual(&scenes);
    base_status status = BASE_OK;
    for (size_t i = 0; status == BASE_OK && i < 2 * scenes; i++) {
        scene *s = NULL;
        options->kernel = kernel_find(kernels[i % 2]);
        options->params = options->kernel->defaults;
        status = scene_open(spec[i / 2], &s, err);
        if (status == BASE_OK)
            status = bench_scene(s, machine, options, error, count, err);
        scene_destroy(&s);
    }
    return status;
}

int main(int argc, char **argv)
{
    base_error err = {0};
    sim_machine *machine = NULL;
    run_options options = {.width = 512, .height = 512, .model = RUN_CORE, .jobs = 1};
    double error = 0.03;
    int count = 40;
    for (int i = 1; i + 1 < argc; i += 2) {
        if (strcmp(argv[i], "--size") == 0)
            options.width = options.height = (unsigned)strtoul(argv[i + 1], NULL, 10);
        else if (strcmp(argv[i], "--trials") == 0)
            count = (int)strtol(argv[i + 1], NULL, 10);
        else if (strcmp(argv[i], "--error") == 0)
            error = strtod(argv[i + 1], NULL);
        else
            return fprintf(stderr, "bench_sample: error: %s: no such option\n", argv[i]), 2;
    }
    measure_print_head();
    printf("kernel,scene,size,error,trials,hold,bias,rms,tiles,full_s,sampled_s,times_faster\n");
    base_status status = sim_machine_load("larrabee", &machine, &err);
    if (status == BASE_OK)
        status = bench_all(machine, &options, error, count, &err);
    sim_machine_destroy(&machine);
    if (status != BASE_OK)
        fprintf(stderr, "bench_sample: error: %s: %s\n", err.what, err.why);
    return status == BASE_OK ? 0 : 1;
}
