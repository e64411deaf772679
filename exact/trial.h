/* A kernel on trial: what is exactly true of a ray in a scene, and what an answer of floats is worth (docs/accuracy.md).
 *
 * All triangles are looked at for every ray. A filter in double precision, with room for its own rounding, passes over those
 * whose border the ray misses by more than TRIAL_EDGE_ULP; of the others everything is found in rational arithmetic.
 * Triangles without area, and those with a vertex that is not finite, are hit by no ray.
 */
#ifndef EXACT_TRIAL_H
#define EXACT_TRIAL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "lrbni/base/status.h"
#include "scene/scene.h"

#define TRIAL_NO_HIT UINT32_MAX

/* A ray is at an edge if it passes a triangle's border within this many units of exact_border_ulp: float arithmetic may then
   hold it for either side of the border. */
#define TRIAL_EDGE_ULP 4.0

/* A distance may be off by what moves the triangle's plane by this many units of 2^-24 of the largest distance at hand: that of
   the farthest vertex, or of the hit. */
#define TRIAL_PLANE_ULP 16.0

typedef enum trial_verdict {
    TRIAL_RIGHT, /* the nearest triangle, or none where there is none */
    TRIAL_TIE,   /* another triangle that is hit, as near as float arithmetic can tell */
    TRIAL_EDGE,  /* not the nearest, but the ray is at an edge of a triangle in question, or starts within rounding of it */
    TRIAL_LOST,  /* a triangle is hit, off its edges, and nothing was found or only something behind it */
    TRIAL_WRONG, /* a triangle that the ray misses by more than rounding, a distance or an order of equals that is not right */
    TRIAL_VERDICTS
} trial_verdict;

/* What a kernel says of a ray. */
typedef struct trial_answer {
    uint32_t id;   /* index of the triangle, or TRIAL_NO_HIT */
    float t, u, v; /* of a hit: distance along the direction, weights of the second and third vertex */
} trial_answer;

typedef struct trial_finding {
    trial_verdict verdict;
    bool leak;           /* nothing was found, and something is hit, at its edge or not */
    double t_ulp;        /* error of t in units of its last place; these three: of RIGHT and TIE with a hit, else 0 */
    double plane_ulp;    /* the same error as a distance from the triangle's plane, in the units of TRIAL_PLANE_ULP */
    double point_ulp;    /* how far off the ray the point lies that u and v stand for, in the same units */
} trial_finding;

/* Triangles as seen from one origin. */
typedef struct trial_view trial_view;

/**
 * @param triangles  count; kept by reference, the caller's for as long as the view is used
 * @param cull       triangles are hit from their front side only
 * @param out        free with trial_view_destroy; may be read by several threads
 *
 * Errors: BASE_ERR_NOMEM.
 */
base_status trial_view_create(const scene_triangle *triangles, size_t count, const float origin[3], bool cull, trial_view **out,
                              base_error *err);

/** Free a view; sets the pointer to NULL. */
void trial_view_destroy(trial_view **view);

/* What is true of one ray; of one thread. */
typedef struct trial_ray trial_ray;

/** Free it with trial_ray_destroy. Errors: BASE_ERR_NOMEM. */
base_status trial_ray_create(trial_ray **out, base_error *err);
void trial_ray_destroy(trial_ray **ray);

/** Find out about the ray from the view's origin in a direction, finite and not 0. Errors: BASE_ERR_NOMEM. */
base_status trial_ray_find(trial_ray *ray, const trial_view *view, const float direction[3], base_error *err);

/** The nearest triangle that the ray hits, of equally near ones the first, or TRIAL_NO_HIT. */
uint32_t trial_ray_nearest(const trial_ray *ray);

/** Exact distance of that hit, rounded to double; infinite without one. */
double trial_ray_distance(const trial_ray *ray);

/** Whether the ray passes within TRIAL_EDGE_ULP of the border of any triangle. */
bool trial_ray_at_edge(const trial_ray *ray);

/** Judge an answer about the ray that was found out about last. */
trial_finding trial_ray_answer(const trial_ray *ray, const trial_answer *answer);

/* Between which distances a triangle blocks a ray; both ends are outside. */
typedef struct trial_span {
    float nearest, farthest;
} trial_span;

/** Whether a triangle blocks the ray there. */
bool trial_ray_blocked(const trial_ray *ray, trial_span span);

/**
 * Judge the answer that the ray is blocked there, or is not: RIGHT, EDGE, LOST (a triangle blocks it, off its edges and by more than
 * rounding within the span, and the answer is that none does) or WRONG (the answer is that one does, and none could).
 */
trial_finding trial_ray_answer_blocked(const trial_ray *ray, trial_span span, bool answer);

#endif
