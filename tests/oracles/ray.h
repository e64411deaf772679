/* Rays and hits as the oracles take and give them: plain, single, no lanes. */
#ifndef TESTS_ORACLES_RAY_H
#define TESTS_ORACLES_RAY_H

#include <stdint.h>

#define ORACLE_NO_HIT UINT32_C(0xffffffff)

/* Points org + t*dir; hits count for tmin < t < tmax, the interval being open at both ends. */
typedef struct oracle_ray {
    float org[3];
    float dir[3]; /* need not be normalised */
    float tmin;   /* at least 0 */
    float tmax;   /* may be +inf */
} oracle_ray;

/* The nearest hit of a ray. */
typedef struct oracle_hit {
    uint32_t id; /* index of the triangle in the scene, or ORACLE_NO_HIT */
    double t;    /* +inf without a hit */
    double u, v; /* weights of the triangle's second and third vertex; 0 without a hit */
} oracle_hit;

#endif
