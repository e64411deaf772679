/* Who is right where a kernel's closest hits and Embree's differ: exact arithmetic decides, ray by ray.
 *
 * The rule. Ids equal: agreed, if our t is right. Two hits whose t are within `t_relative`: a tie (coplanar
 * triangles, a shared edge), if ours is a hit. Otherwise both triangles are intersected exactly and our answer is
 * taken as two claims, 'the ray hits our triangle' and 'it does not hit Embree's in front of that'. If both are true,
 * Embree is wrong. A false claim is excused if the ray passes within `edge_ulp` of the border of the very triangle
 * that the claim is about: all three edges are looked at, so being near the line of one but outside another is no
 * excuse. Else ours is wrong. Where t differ, ours must be that of our triangle within rounding: a first-order bound
 * on a float intersection test, which grows at grazing incidence.
 *
 * Only the two triangles named are looked at. A ray that leaks through the common edge of two triangles while Embree
 * names the one on the wrong side counts as Embree's error, although the right one was missed: leaks are for
 * brute_force.h to count.
 */
#ifndef TESTS_ORACLES_HIT_JUDGE_H
#define TESTS_ORACLES_HIT_JUDGE_H

#include <stddef.h>
#include <stdint.h>

#include "scene/scene.h"
#include "tests/oracles/ray.h"

typedef enum judge_verdict {
    JUDGE_AGREE,        /* the same triangle, or both none */
    JUDGE_TIE,          /* different, but at the same t within the tolerance, or at an end of the ray's range */
    JUDGE_EMBREE_WRONG, /* exact arithmetic says that ours is right */
    JUDGE_NEAR_EDGE,    /* ours is wrong by no more than the tolerance at an edge */
    JUDGE_OURS_WRONG,   /* a failure */
    JUDGE_VERDICTS
} judge_verdict;

typedef struct judge_options {
    double t_relative; /* two t are equal within this share of the larger */
    double edge_ulp;   /* units of exact_edge_margins_ulp */
    int cull_backface; /* 1: triangles seen from behind are not hit */
} judge_options;

typedef struct judge_summary {
    uint64_t count[JUDGE_VERDICTS]; /* rays by verdict */
    size_t first_wrong;             /* index of the first ray with JUDGE_OURS_WRONG, SIZE_MAX without one */
} judge_summary;

/** t within 1e-5, edges within 4 units, both sides of a triangle are hit. */
judge_options judge_options_default(void);

/** Name of a verdict for test output, such as "near edge". */
const char *judge_verdict_name(judge_verdict verdict);

/**
 * Judge one ray.
 *
 * @param triangles  triangle_count; ids are indices. An id of ours that is neither an index nor ORACLE_NO_HIT, or a hit
 *                   whose t is NaN, is JUDGE_OURS_WRONG; Embree's id must be in range (asserted)
 * @param ours       of the kernel under test; u and v are not looked at
 * @param embree     of embree_oracle_closest for the same ray and the same culling
 */
judge_verdict hit_judge_ray(const judge_options *options, const scene_triangle *triangles, size_t triangle_count,
                            const oracle_ray *ray, const oracle_hit *ours, const oracle_hit *embree);

/**
 * Judge many rays. Agreement costs two comparisons a ray; only differences cost exact arithmetic.
 *
 * @param rays, ours, embree  ray_count each
 * @param jobs                host threads; the result does not depend on it
 * @param verdicts            out, ray_count, or NULL
 */
judge_summary hit_judge_rays(const judge_options *options, const scene_triangle *triangles, size_t triangle_count,
                             const oracle_ray *rays, const oracle_hit *ours, const oracle_hit *embree,
                             size_t ray_count, unsigned jobs, judge_verdict *verdicts);

#endif
