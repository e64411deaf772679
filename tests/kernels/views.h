/* Cameras that tracers find hard, for any scene: exact axes, points on the geometry, planes seen edge-on. */
#ifndef TESTS_KERNELS_VIEWS_H
#define TESTS_KERNELS_VIEWS_H

#include "scene/scene.h"

#define VIEWS_MOST 24

typedef struct views {
    size_t count;
    scene_camera camera[VIEWS_MOST]; /* named after what is hard about them; the first is the scene's own first */
} views;

/** The views of a scene; `seed` chooses the triangles that they are about. */
views views_of(const scene *s, uint64_t seed);

/** A camera with exactly these axes. */
scene_camera views_camera(const char *name, const double position[3], const double forward[3], const double up[3], double yfov);

#endif
