/* Kernels over one scene, every ray of theirs on trial. */
#ifndef CLI_SUITES_STABILITY_TRIAL_H
#define CLI_SUITES_STABILITY_TRIAL_H

#include "cli/suites/stability_kernels.h"
#include "cli/suites/stability_tally.h"

/* What to try. */
typedef struct stability_input {
    const scene *scene;
    const scene_camera *camera; /* one of the scene's, the first */
    const sim_machine *machine;
    const stability_kernels *kernels;
    unsigned width, height;
    bool cull;
    unsigned jobs;
} stability_input;

/** Called for each kernel and pixel, from the thread with number `worker`. */
typedef void stability_ray_fn(void *user, size_t kernel, size_t pixel, unsigned worker, const trial_ray *ray, const trial_finding *finding);

/** The same for each ray that a kernel with hard shadows traces from the light, and that it holds to be blocked within the span or not. */
typedef void stability_shadow_fn(void *user, size_t kernel, unsigned worker, const trial_ray *ray, trial_span span, const trial_finding *finding);

/**
 * Run all kernels over the scene and judge all their primary rays, which are the same for all.
 *
 * @param shadow  NULL: shadow rays are not judged
 *
 * Errors: those of run_kernel, BASE_ERR_NOMEM.
 */
base_status stability_try(const stability_input *input, stability_ray_fn *take, stability_shadow_fn *shadow, void *user, base_error *err);

#endif
