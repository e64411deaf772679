/* The shading and shadow part of a job: the light, the sets of samples, normals, and the rays they make. */
#ifndef KERNELS_JOB_SHADOW_H
#define KERNELS_JOB_SHADOW_H

#include <stdbool.h>

#include "kernels/job.h"

/**
 * Fill in the light of a job's constants, and lay out sets of samples, normals and shadows if params.samples is not 0, normals and
 * shades if there is a shader. No kernel takes both.
 * Maps no segment.
 *
 * @param job    with its tree, its tiles and its constants; owns what is allocated, also after a failure
 * @param light  of the scene, not scaled; NULL if params.samples is 0 and nothing reads the light
 *
 * Errors: BASE_ERR_USAGE naming --samples, BASE_ERR_NOMEM.
 */
base_status job_shadow_create(kernel_job *job, const scene_light *light, base_error *err);

/** Free what job_shadow_create has allocated. */
void job_shadow_destroy(kernel_job *job);

/* A shadow ray: points org + t*dir. Between 0 and 1 it goes from a hit to a sample of the light, or from a point light to a hit. */
typedef struct job_shadow_ray {
    float org[3], dir[3];
} job_shadow_ray;

/** The set of samples that the pixel's pass uses. */
unsigned job_shadow_set(const kernel_job *job, unsigned pixel, unsigned pass);

/**
 * The shadow ray of a pixel that has a hit in the frame, the bits that the kernels trace; of job->params.samples above 0.
 *
 * @param pass    below job->sample_passes
 * @param sample  0..15
 *
 * Returns false if the pixel has no hit, or sees the light from behind or from below its own surface: nothing is traced.
 */
bool job_shadow_ray_of(const kernel_job *job, unsigned x, unsigned y, unsigned pass, unsigned sample, job_shadow_ray *out);

/** The same from the light's point to the pixel's hit, of a job with params.hard_shadows. */
bool job_hard_shadow_ray_of(const kernel_job *job, unsigned x, unsigned y, job_shadow_ray *out);

#endif
