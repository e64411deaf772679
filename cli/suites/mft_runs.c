#include "cli/suites/mft_runs.h"

#include <math.h>

const char *const mft_suite_scenes[] = {"builtin:creature-69k", "builtin:fern-212k", "builtin:hall-60k", "builtin:forest-174k", NULL};

const char *mft_kernel(mft_algorithm algorithm)
{
    static const char *const kernels[MFT_ALGORITHMS] = {"packet16-primary", "mft-primary", "packet16-soft", "mft-soft"};
    return kernels[algorithm];
}

int mft_algorithms_measured(void)
{
    int count = 0;
    while (count < MFT_ALGORITHMS && kernel_find(mft_kernel((mft_algorithm)count)) && kernel_find(mft_kernel((mft_algorithm)(count + 1))))
        count += 2;
    return count;
}

run_options mft_kernel_options(const suite *s, const char *kernel)
{
    run_options options = suite_run_options(s, kernel_find(kernel), RUN_CORE);
    options.params.cull_backface = 1;
    if (s->options->error > 0)
        options.params.filter = 0;
    return options;
}

run_options mft_run_options(const suite *s, mft_algorithm algorithm)
{
    return mft_kernel_options(s, mft_kernel(algorithm));
}

uint64_t mft_cycles(const run_result *result) { return result->cycles - result->core.phase[KERNEL_PHASE_FILTER]; }

mft_row mft_row_of(const run_result *result, const char *scene_name, mft_algorithm algorithm)
{
    const uint64_t *n = result->counts.n;
    const sim_cycles *core = &result->core.core;
    const uint64_t *phase = result->core.phase;
    return (mft_row){
        .scene = scene_name,
        .algorithm = algorithm,
        .pixels = (double)result->options.width * result->options.height,
        .value = {[MFT_TRIS] = (double)n[KERNEL_tri_accesses], [MFT_CULLED] = (double)n[KERNEL_tri_after_culling],
                  [MFT_AABB] = (double)n[KERNEL_aabb_tests], [MFT_ISECT] = (double)n[KERNEL_isect_tests], [MFT_CYCLES] = (double)mft_cycles(result)},
        .phase = {(double)phase[KERNEL_PHASE_SETUP], (double)phase[KERNEL_PHASE_TRAVERSAL], (double)phase[KERNEL_PHASE_CULLING],
                  (double)phase[KERNEL_PHASE_INTERSECTION], (double)phase[KERNEL_PHASE_SHADING], result->options.params.filter ? (double)phase[KERNEL_PHASE_FILTER] : (double)NAN},
        .memory = (double)(core->l2 + core->memory + core->misses + core->prefetches) / (double)result->core.cycles,
        .half_width = result->estimate.half_width_95,
    };
}
