/* Random rays and triangles for the tests of the oracles; the same on every host. */
#ifndef TESTS_ORACLES_SOUP_H
#define TESTS_ORACLES_SOUP_H

#include <math.h>

#include "lrbni/base/random.h"
#include "scene/scene.h"
#include "tests/oracles/ray.h"

/* Each component uniform in [-size, size), rounded to float. */
static inline void soup_point(base_random *random, double size, float out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = (float)base_random_range(random, -size, size);
}

/* Integer components in [-size, size]: sums and products of a few are exact in integers and float alike. */
static inline void soup_integer_point(base_random *random, int size, float out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = (float)((int)(base_random_bits(random) % (unsigned)(2 * size + 1)) - size);
}

/* Triangles of about the given size with a first vertex in the cube [-1, 1)^3. */
static inline void soup_triangles(base_random *random, double size, scene_triangle *out, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        soup_point(random, 1.0, out[i].v[0]);
        for (int j = 1; j < 3; j++) {
            soup_point(random, size, out[i].v[j]);
            for (int k = 0; k < 3; k++)
                out[i].v[j][k] += out[i].v[0][k];
        }
    }
}

/* Rays from outside through the cube [-1, 1)^3, and from inside in any direction, alternating. */
static inline void soup_rays(base_random *random, oracle_ray *out, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        float target[3];
        soup_point(random, i % 2 ? 1.0 : 4.0, out[i].org);
        soup_point(random, 1.0, target);
        for (int k = 0; k < 3; k++)
            out[i].dir[k] = target[k] - out[i].org[k];
        out[i].tmin = 0.0f;
        out[i].tmax = INFINITY;
    }
}

#endif
