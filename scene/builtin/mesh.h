/* Builds a scene from plain shapes: the pencil that the built-in scenes are drawn with.
 *
 * Lengths are metres, y is up, angles are turns (1 = a full circle). Shapes are given in the mesh's current frame
 * and painted with its current material. Every shape states which side is its front. Calls after a failure do
 * nothing; scene_mesh_end returns the first failure.
 *
 * All arithmetic is +, -, *, / and square roots in double, rounded once to float, so that the triangles are
 * the same bits on every host. C leaves the order of arguments open: draw each random number into a variable of
 * its own before it is used in a call.
 */
#ifndef SCENE_BUILTIN_MESH_H
#define SCENE_BUILTIN_MESH_H

#include <stddef.h>
#include <stdint.h>

#include "lrbni/base/random.h"
#include "lrbni/base/status.h"
#include "scene/builtin/point.h"
#include "scene/scene.h"

/* A place and three axes, right-handed, so that fronts stay fronts; orthonormal but where a shape needs a shear. */
typedef struct scene_frame {
    scene_point origin, x, y, z;
} scene_frame;

typedef struct scene_mesh {
    scene *target;
    base_error *err;
    base_status status; /* BASE_OK until something fails */
    scene_frame frame;  /* save it before scene_mesh_enter, put it back afterwards */
    uint32_t material;  /* for the triangles that follow */
    base_random random;
} scene_mesh;

/* The faces of a box, by the axis they look along. */
enum {
    SCENE_FACE_LEFT = 1,   /* -x */
    SCENE_FACE_RIGHT = 2,  /* +x */
    SCENE_FACE_BOTTOM = 4, /* -y */
    SCENE_FACE_TOP = 8,    /* +y */
    SCENE_FACE_BACK = 16,  /* -z */
    SCENE_FACE_FRONT = 32, /* +z */
    SCENE_FACES_AROUND = 51,   /* no top, no bottom: a leg between a floor and a table top */
    SCENE_FACES_STANDING = 59, /* no bottom: it stands on something */
    SCENE_FACES_HANGING = 55,  /* no top */
    SCENE_FACES_NO_BACK = 47, /* it stands or hangs on a wall behind it, or on one to its right */
    SCENE_FACES_NO_RIGHT = 61,
    SCENE_FACES_ALL = 63
};

/** A mesh that draws into `target` in its world frame; both pointers are borrowed. */
scene_mesh scene_mesh_begin(scene *target, uint64_t seed, base_error *err);

/**
 * The verdict on everything drawn.
 *
 * Errors: the first failure of any call; BASE_ERR_UNSUPPORTED if the scene does not hold exactly `expected`
 * triangles (a fault of the scene's own design).
 */
base_status scene_mesh_end(scene_mesh *m, size_t expected);

/** Add a material of that linear colour and make it the current one. Returns its index, 0 after a failure. */
uint32_t scene_mesh_paint(scene_mesh *m, double red, double green, double blue);

/** Uniform random number in [low, high) from the mesh's own seed. */
double scene_mesh_random(scene_mesh *m, double low, double high);

/** Cosine and sine of an angle in turns, from a polynomial: equal on every host, exact at quarter turns. */
void scene_direction(double turns, double *cosine, double *sine);

/** Move the current frame to (x, y, z) and turn it about its y axis, z towards x. Returns the frame before. */
scene_frame scene_mesh_enter(scene_mesh *m, double x, double y, double z, double turns);

/** Turn the current frame about its own x axis (y towards z) or z axis (x towards y). */
void scene_mesh_pitch(scene_mesh *m, double turns);
void scene_mesh_roll(scene_mesh *m, double turns);

/** One triangle, front where a, b, c run counter-clockwise; none if two corners round to the same floats. */
void scene_mesh_triangle(scene_mesh *m, scene_point a, scene_point b, scene_point c);

/** Two triangles, a b c and a c d; one if two neighbouring corners coincide. */
void scene_mesh_quad(scene_mesh *m, scene_point a, scene_point b, scene_point c, scene_point d);

/** A level rectangle at height y, 2 triangles: a floor faces up, a ceiling down. */
void scene_mesh_floor(scene_mesh *m, double x0, double z0, double x1, double z1, double y);
void scene_mesh_ceiling(scene_mesh *m, double x0, double z0, double x1, double z1, double y);

/** A box with the given faces (SCENE_FACE_...), 2 triangles each, seen from outside. */
void scene_mesh_box(scene_mesh *m, scene_point low, scene_point high, unsigned faces);

/** The same seen from inside: a room. */
void scene_mesh_room(scene_mesh *m, scene_point low, scene_point high, unsigned faces);

/** A box of the given width and depth about the line from a to b, 12 triangles; 8 without ends. */
void scene_mesh_beam(scene_mesh *m, scene_point a, scene_point b, double width, double depth, int with_ends);

/* A point of a profile: `out` is a radius or the distance from a wall. */
typedef struct scene_profile {
    double out, up;
} scene_profile;

/**
 * Turn a profile about the y axis, front where it is seen from outside when it runs upwards.
 *
 * @param profile  `count` points; a radius of 0 closes the shape with a fan
 * @param sides    at least 3; 2 * sides triangles between two rings, `sides` between a ring and a point of the axis
 */
void scene_mesh_lathe(scene_mesh *m, const scene_profile *profile, size_t count, unsigned sides);

/**
 * Draw a profile along x from x0 to x1, front towards +z when it runs upwards; 2 triangles a step.
 *
 * @param mitre0, mitre1  at the ends x moves by these times `out`, so that two mouldings meet in a corner
 */
void scene_mesh_moulding(scene_mesh *m, const scene_profile *profile, size_t count, double x0, double x1,
    double mitre0, double mitre1);

/** A pipe of `sides` sides along a path of `count` points, seen from outside; open ends. 2 * sides a step. */
void scene_mesh_pipe(scene_mesh *m, const scene_point *path, size_t count, double radius, unsigned sides);

/** A pipe hanging from a to b with its middle `sag` lower, a parabola of `steps` steps. */
void scene_mesh_rope(scene_mesh *m, scene_point a, scene_point b, double sag, double radius, unsigned steps,
    unsigned sides);

/** A ring about the y axis, radius `major`, of a pipe of radius `minor`: 2 * rings * sides. */
void scene_mesh_torus(scene_mesh *m, double major, double minor, unsigned rings, unsigned sides);

/**
 * A sheet of across * along cells, front along (d/du) x (d/dv).
 *
 * @param place  the point at (u, v), both in [0, 1]; `user` is passed through
 */
void scene_mesh_sheet(scene_mesh *m, unsigned across, unsigned along,
    scene_point (*place)(const void *user, double u, double v), const void *user);

/**
 * The same as a cloth: a second sheet behind it seen from the other side, cut along the same diagonals so that the
 * two never cross; 4 * across * along triangles.
 *
 * @param half  moves the front; the back moves by its opposite [m]
 */
void scene_mesh_fabric(scene_mesh *m, unsigned across, unsigned along,
    scene_point (*place)(const void *user, double u, double v), const void *user, scene_point half);

#endif
