#include "scene/builtin/noise.h"

#include <stdint.h>

/* The value at a lattice point, in [-1, 1]. */
static double lattice(int64_t x, int64_t y, int64_t z)
{
    uint64_t h = (uint64_t)x * UINT64_C(0x9e3779b97f4a7c15) ^ (uint64_t)y * UINT64_C(0xc2b2ae3d27d4eb4f)
        ^ (uint64_t)z * UINT64_C(0x165667b19e3779f9);
    h = (h ^ h >> 31) * UINT64_C(0xbf58476d1ce4e5b9);
    h = (h ^ h >> 29) * UINT64_C(0x94d049bb133111eb);
    return (double)(h >> 40) / (double)(1 << 23) - 1.0;
}

/* From 0 to 1 with no slope and no curvature at the ends. */
static double fade(double t)
{
    return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

static double between(double a, double b, double t)
{
    return a + (b - a) * t;
}

double scene_noise(scene_point p)
{
    double fx = floor(p.x), fy = floor(p.y), fz = floor(p.z);
    int64_t x = (int64_t)fx, y = (int64_t)fy, z = (int64_t)fz;
    double u = fade(p.x - fx), v = fade(p.y - fy), w = fade(p.z - fz), level[2];
    for (int k = 0; k < 2; k++)
        level[k] = between(between(lattice(x, y, z + k), lattice(x + 1, y, z + k), u),
            between(lattice(x, y + 1, z + k), lattice(x + 1, y + 1, z + k), u), v);
    return between(level[0], level[1], w);
}

double scene_noise_sum(scene_point p, unsigned octaves)
{
    double sum = 0, share = 1;
    for (unsigned i = 0; i < octaves; i++) {
        sum += share * scene_noise(p);
        share *= 0.5;
        /* off the lattice of the octave before, or the origin would be a point of all of them */
        p = scene_at(2.0 * p.x + 0.37, 2.0 * p.y + 0.59, 2.0 * p.z + 0.11);
    }
    return sum;
}
