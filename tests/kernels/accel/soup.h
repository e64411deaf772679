/* Scenes of loose triangles for tests of acceleration structures: name, count and triangles are set, nothing else. */
#ifndef TESTS_KERNELS_ACCEL_SOUP_H
#define TESTS_KERNELS_ACCEL_SOUP_H

#include <stddef.h>
#include <stdint.h>

#include "scene/scene.h"

/** A scene of `count` triangles, all at the origin; the caller moves them, and frees them with soup_free. */
scene soup_create(const char *name, size_t count);

void soup_free(scene *s);

/** Triangles of edge lengths up to `size`, evenly over the cube [-1,1]^3. */
scene soup_random(uint64_t seed, size_t count, double size);

/** Dense clusters of unlike sizes, and a few triangles that span the whole scene. */
scene soup_clustered(uint64_t seed, size_t count);

/** The same triangle over and over. */
scene soup_identical(size_t count);

/** Triangles strung along the x axis, all in the plane z = 0, each with a corner on the axis. */
scene soup_collinear(size_t count);

/** Overlapping triangles in the plane y = 0.25. */
scene soup_coplanar(uint64_t seed, size_t count);

/** Needles: one long edge across the scene, a million times as long as the short one. */
scene soup_needles(uint64_t seed, size_t count);

/** The triangles of soup_random, multiplied by `scale` and then moved by `offset` on every axis. */
scene soup_placed(uint64_t seed, size_t count, float scale, float offset);

/** Triangles of size 2^k beside x = 2^k, k = 80 down to -80, `copies` of each: a split in the middle of space peels
    off one size at a time. */
scene soup_telescope(size_t copies);

/** soup_random with every `stride`-th triangle made degenerate: a point, two equal corners or three in line. */
scene soup_degenerate(uint64_t seed, size_t count, size_t stride);

#endif
