/* The kernels fit the machine's registers: no value of a vector or mask register ever has to be spilled, in any phase, on any
 * path of the box test, with and without culling. (A compiler for one path would spill no less: sim/registers.h.) */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "kernels/kernel.h"
#include "scene/builtin.h"
#include "sim/registers.h"
#include "tests/kernels/trace.h"

enum { SIZE = 32 };

static sim_registers_stats analyse(const kernel_info *kernel, const kernel_params *params, const trace_trees *trees, const scene *s,
                                   kernel_counts *n)
{
    sim_registers *r = NULL;
    lrb_ctx *c = NULL;
    kernel_job *job = trace_job(&(trace_request){.kernel = kernel->name, .tree = trees->tree, .kdtree = trees->kdtree, .params = params,
                                                 .cull = params->cull_backface, .camera = &s->cameras[0], .light = &s->light,
                                                 .width = SIZE, .height = SIZE});
    assert_int_equal(sim_registers_create(sim_file_registers, &r, NULL), BASE_OK);
    assert_int_equal(lrb_ctx_create(sim_registers_events, r, &c, NULL), BASE_OK);
    for (uint32_t tile = 0; tile < kernel_job_tiles(job); tile++) {
        kernel->annotated(c, job, tile, n);
        lrb_ctx_end(c);
        assert_int_equal(sim_registers_end(r, NULL), BASE_OK);
    }
    sim_registers_stats stats = *sim_registers_get(r);
    lrb_ctx_destroy(&c);
    sim_registers_destroy(&r);
    kernel_job_destroy(&job);
    return stats;
}

static void check(const kernel_info *kernel, const kernel_params *params, const char *scene_name, const sim_registers_stats *s)
{
    const uint64_t phases = kernel->phases | (params->shader ? UINT64_C(1) << KERNEL_PHASE_SHADING : 0);
    for (int phase = 0; phase < KERNEL_PHASE_COUNT; phase++) {
        assert_int_equal(s->ops[phase] > 0, phases >> phase & 1);
        for (int file = 0; file < SIM_FILES; file++) {
            const sim_pressure *p = &s->pressure[phase][file];
            if (p->stores || p->reloads)
                fail_msg("%s on %s, %s: %llu %s registers needed, %llu spills and %llu reloads", kernel->name, scene_name,
                         kernel_phase_names[phase], (unsigned long long)p->max, sim_file_names[file], (unsigned long long)p->stores,
                         (unsigned long long)p->reloads);
            if (p->max > (file == SIM_FILE_GENERAL ? 16u : sim_file_registers[file]))
                fail_msg("%s on %s, %s: %llu %s registers needed", kernel->name, scene_name, kernel_phase_names[phase], (unsigned long long)p->max, sim_file_names[file]);
        }
    }
}

/* Every way to shrink frusta, on the smallest scene. */
static void check_shrinking(const kernel_info *kernel, const trace_trees *trees, const scene *s, kernel_counts *n)
{
    kernel_params params = kernel->defaults;
    if (!(kernel->params >> KERNEL_PARAM_SHRINK & 1) || s->triangle_count > 10000)
        return;
    for (params.shrink = KERNEL_SHRINK_CORNERS; params.shrink <= KERNEL_SHRINK_RAYS; params.shrink++) {
        sim_registers_stats stats = analyse(kernel, &params, trees, s, n);
        check(kernel, &params, s->name, &stats);
    }
}

/* Several passes of samples, on the smallest scene. */
static void check_passes(const kernel_info *kernel, const trace_trees *trees, const scene *s, kernel_counts *n)
{
    kernel_params params = kernel->defaults;
    if (params.samples == 0 || s->triangle_count > 10000)
        return;
    params.samples = 64;
    sim_registers_stats stats = analyse(kernel, &params, trees, s, n);
    check(kernel, &params, s->name, &stats);
}

/* With the simple shader behind the rays. */
static void check_shader(const kernel_info *kernel, const trace_trees *trees, const scene *s, kernel_counts *n)
{
    kernel_params params = kernel->defaults;
    if (!(kernel->params >> KERNEL_PARAM_SHADER & 1))
        return;
    params.shader = KERNEL_SHADER_SIMPLE;
    sim_registers_stats stats = analyse(kernel, &params, trees, s, n);
    check(kernel, &params, s->name, &stats);
}

/* With blocked shadow rays that stay in their packets. */
static void check_late_termination(const kernel_info *kernel, const trace_trees *trees, const scene *s, kernel_counts *n)
{
    kernel_params params = kernel->defaults;
    if (!params.early_termination)
        return;
    params.early_termination = 0;
    sim_registers_stats stats = analyse(kernel, &params, trees, s, n);
    check(kernel, &params, s->name, &stats);
}

static void registers__every_kernel_usual_scenes__nothing_spilled(void **state)
{
    size_t kernels, scenes;
    const kernel_info *kernel = kernel_list(&kernels);
    const char *const *spec = scene_builtin_usual(&scenes);
    kernel_counts n = {{0}};
    (void)state;
    for (size_t i = 0; i < scenes; i++) {
        scene *s = NULL;
        assert_int_equal(scene_open(spec[i], &s, NULL), BASE_OK);
        for (size_t k = 0; k < kernels; k++) {
            trace_trees trees = trace_trees_of(&kernel[k], s, &s->cameras[0]);
            for (unsigned cull = 0; cull < 2; cull++) {
                kernel_params params = kernel[k].defaults;
                params.cull_backface = cull;
                sim_registers_stats stats = analyse(&kernel[k], &params, &trees, s, &n);
                check(&kernel[k], &params, s->name, &stats);
            }
            check_shrinking(&kernel[k], &trees, s, &n);
            check_passes(&kernel[k], &trees, s, &n);
            check_shader(&kernel[k], &trees, s, &n);
            check_late_termination(&kernel[k], &trees, s, &n);
            trace_trees_destroy(&trees);
        }
        scene_destroy(&s);
    }
    /* All paths of the box test have been taken. */
    assert_true(n.n[KERNEL_units_common] > 0 && n.n[KERNEL_units_blend] > 0 && n.n[KERNEL_units_zero] > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(registers__every_kernel_usual_scenes__nothing_spilled),
    };
    return cmocka_run_group_tests_name("registers", tests, NULL, NULL);
}
