/* Geometry for the hard cases: points, frames, closed surfaces, and the places and sizes that every case is run at. */
#ifndef TESTS_HARD_SHAPES_H
#define TESTS_HARD_SHAPES_H

#include <stddef.h>

#include "lrbni/base/random.h"
#include "scene/scene.h"

/* Offset on every axis, and size; algorithms H: offsets 0, 1e3, 1e6 and scales 1e-4, 1, 1e4. */
typedef struct shapes_place {
    double offset, scale;
} shapes_place;

#define SHAPES_PLACES 9
extern const shapes_place shapes_places[SHAPES_PLACES];

/** Whether at least 16 bits of a shape's coordinates survive there. */
int shapes_place_is_fine(shapes_place p);

/** A random point in [-size, size]^3. */
void shapes_point(base_random *r, double size, double out[3]);

/** A random unit vector. */
void shapes_direction(base_random *r, double out[3]);

/** scale * p + offset, rounded to float. */
void shapes_put(shapes_place place, const double p[3], float out[3]);

/** A random point in [-size, size]^3, put there. */
void shapes_put_point(base_random *r, shapes_place place, double size, float out[3]);

/** d scaled to `length`, rounded to float. */
void shapes_scaled(const double d[3], double length, float out[3]);

/** Two unit vectors that with the unit vector d form a frame. */
void shapes_frame(const double d[3], double right[3], double down[3]);

/* A closed surface around the origin of its place. */
typedef struct shapes_mesh {
    size_t triangle_count, vertex_count;
    scene_triangle *triangles; /* owned */
    float (*vertices)[3];      /* owned */
    uint32_t (*corner)[3];     /* indices of the triangles' vertices; owned */
} shapes_mesh;

/** A sphere of about unit radius, bumpy by `bumps` of it, turned at random, at a place. */
shapes_mesh shapes_sphere(base_random *r, int rings, int sectors, double bumps, shapes_place place);

/** A box, each side n x n squares, turned at random or (turned = 0) with its sides along the axes. */
shapes_mesh shapes_box(base_random *r, int n, int turned, shapes_place place);

void shapes_free(shapes_mesh *m);

/** A scene that shares the triangles: name, count and triangles are set, nothing else. */
scene shapes_scene(const shapes_mesh *m);

#endif
