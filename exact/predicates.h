/* Oracle O2: ray tracing's predicates in exact arithmetic. Inputs are the floats as they are, nothing is rounded.
 *
 * Definitions are those of docs/kernels.md: points of a ray are org + t*dir; a triangle's normal is
 * N = (v1-v0) x (v2-v0) and its front is seen where N.dir < 0; its edges and vertices belong to it. All inputs must be
 * finite (asserted) unless a function says otherwise; vertices may coincide and directions may be zero. Nothing here
 * shares code with the kernels. Memory is GMP's: when it runs out, the process aborts.
 */
#ifndef EXACT_PREDICATES_H
#define EXACT_PREDICATES_H

#include <gmp.h>

/* Where a ray meets the plane of a triangle, and whether that is inside. Set up with exact_hit_init. */
typedef struct exact_hit {
    int hit;         /* 1 iff det != 0, t > 0, u >= 0, v >= 0 and u + v <= 1 */
    int facing;      /* sign of det = -N.dir: 1 front, -1 back, 0 parallel to the plane or a triangle without area */
    mpq_t t;         /* exact; 0 if facing is 0 */
    double t_double; /* t rounded to nearest, infinite if it is too large; 0 if facing is 0 */
    double u, v;     /* weights of v1 and v2, rounded likewise; also set when they lie outside the triangle */
} exact_hit;

/** Set up a hit that says 'none'; owned by the caller: free with exact_hit_clear. */
void exact_hit_init(exact_hit *hit);

/** Free what a hit holds. */
void exact_hit_clear(exact_hit *hit);

/**
 * Intersect one ray with one triangle.
 *
 * @param out  set up by exact_hit_init; overwritten
 * @return     out->hit
 */
int exact_ray_triangle(const float org[3], const float dir[3], const float v0[3], const float v1[3],
                       const float v2[3], exact_hit *out);

/** Whether a triangle's normal, (v1-v0) x (v2-v0), is not 0. */
int exact_triangle_has_area(const float v0[3], const float v1[3], const float v2[3]);

/** Sign of a's t minus b's t: -1, 0 or 1. Both must have facing != 0 (asserted). */
int exact_hit_compare_t(const exact_hit *a, const exact_hit *b);

/** Sign of the hit's t minus `value`, which may be infinite but not NaN. facing must not be 0 (asserted). */
int exact_hit_compare_value(const exact_hit *hit, double value);

/**
 * How far the ray passes from the three edges, as angles seen from the ray's origin, in units of float rounding.
 *
 * For the edge from a to b (vertices relative to the origin, exactly) the angle between the ray and the plane through
 * the origin and the edge has the sine |dir.(a x b)| / (|dir| |a x b|). It is given in units of
 * 2^-23 * max(1, M / min(|a|,|b|)), M being the largest coordinate of a, b and the origin as they stand in the scene:
 * translating a vertex of magnitude M to the ray's origin may itself cost M * 2^-24, which is seen from |a| as an
 * angle. The numerator is exact; the quotient carries a relative error of some 1e-15.
 *
 * @param margin  out, 3 values, for the edges v0v1, v1v2, v2v0: positive on the side of the triangle's interior and
 *                negative beyond the edge, so that the ray hits iff none is negative, but for these cases: an edge
 *                whose line passes through the origin, and a zero direction, give 0; if the origin lies in the
 *                triangle's plane, where there is no hit and no interior side, all are 0 or negative.
 */
void exact_edge_margins_ulp(const float org[3], const float dir[3], const float v0[3], const float v1[3],
                            const float v2[3], double margin[3]);

/** The smallest magnitude of the three margins: how close the ray comes to the line of an edge. At least 0. */
double exact_edge_distance_ulp(const float org[3], const float dir[3], const float v0[3], const float v1[3],
                               const float v2[3]);

/**
 * How far the ray passes from the triangle's border, inside or outside: the sine of the angle, seen from the ray's origin, to
 * the nearest point of the three edges, in units of float rounding, 2^-23. Unlike the margins above it knows that edges
 * end. At most 2^23, which also stands for angles beyond 90 degrees and for a zero direction. Exact but for the last
 * division and square roots (1e-15).
 */
double exact_border_ulp(const float org[3], const float dir[3], const float v0[3], const float v1[3], const float v2[3]);

/* The stretch of a ray inside a box. Set up with exact_interval_init. */
typedef struct exact_interval {
    int empty;           /* no t >= 0 has org + t*dir in the closed box; the rest is 0 then */
    int unbounded;       /* the direction is 0 and the origin is inside: exit is infinite, `exit` is 0 */
    mpq_t entry, exit;   /* exact, 0 <= entry <= exit */
    double entry_double; /* rounded to nearest */
    double exit_double;  /* rounded to nearest; +inf if unbounded */
} exact_interval;

/** Set up an empty interval; owned by the caller: free with exact_interval_clear. */
void exact_interval_init(exact_interval *interval);

/** Free what an interval holds. */
void exact_interval_clear(exact_interval *interval);

/**
 * The t >= 0 for which a ray is inside a closed box.
 *
 * @param lo, hi  corners; a box with lo > hi on some axis is empty, in any other the corners must be finite
 * @param out     set up by exact_interval_init; overwritten
 */
void exact_box_interval(const float org[3], const float dir[3], const float lo[3], const float hi[3],
                        exact_interval *out);

/** Whether exact_box_interval is not empty. */
int exact_ray_box(const float org[3], const float dir[3], const float lo[3], const float hi[3]);

/**
 * Whether any ray of a cone hits a triangle (det != 0 and t > 0, edges belong to the triangle).
 *
 * The cone's rays start at `org`; their directions are the convex combinations of four corners, in any order. Corners
 * may coincide, be collinear, lie in a plane or be zero (a zero corner adds nothing).
 *
 * @param cull_backface  1: hits from behind do not count
 *
 * Source: the cone is the union of the cones over its independent triples of corners (Caratheodory), each an
 * intersection of three half-spaces, against which the triangle is clipped (Sutherland and Hodgman 1974).
 */
int exact_cone_triangle(const float org[3], const float corner[4][3], const float v0[3], const float v1[3],
                        const float v2[3], int cull_backface);

/** Whether any ray of such a cone has a point in a closed box at t >= 0. An empty box (lo > hi) has none. */
int exact_cone_box(const float org[3], const float corner[4][3], const float lo[3], const float hi[3]);

#endif
