/* Scenes of suite stability: triangles, a camera and an image size, made in code, at a place and in a frame.
 *
 * A case is written in coordinates of its own, about 1 in size around 0. They are permuted and mirrored by the frame, scaled and
 * moved by the place, and rounded to float; points on pixel rays are made from the rays that the kernels trace.
 */
#ifndef CLI_SUITES_STABILITY_SCENE_H
#define CLI_SUITES_STABILITY_SCENE_H

#include <stddef.h>

#include "lrbni/base/random.h"
#include "lrbni/base/status.h"
#include "scene/scene.h"
#include "sim/machine.h"

/* Offset on every axis, and size. */
typedef struct stability_place {
    double offset, scale;
} stability_place;

/* A permutation of the axes and signs: coordinate k of space is sign[k] * coordinate axis[k] of the case. */
enum { STABILITY_FRAMES = 48 };
typedef struct stability_frame {
    int axis[3];
    double sign[3];
} stability_frame;

/** One of the 48; 0 leaves everything as it is. */
stability_frame stability_frame_of(unsigned number);

typedef struct stability_scene {
    const sim_machine *machine; /* that kernels run on; it times nothing here */
    stability_place place;
    stability_frame frame;
    base_random random;
    unsigned variant; /* which of a case's variants: counts up over places and frames */
    unsigned width, height;
    scene_camera camera;
    double light[3]; /* the point light, in coordinates of space */
    size_t count, room;
    scene_triangle *triangles;
    double (*ideal)[3][3]; /* the triangles before they were rounded to float */
    float (*directions)[3]; /* of the pixels, row by row; filled by stability_aim */
    base_status status;    /* of all calls so far: the first failure */
    base_error *err;
} stability_scene;

/** Free what a scene holds. */
void stability_scene_clear(stability_scene *s);

/** A camera in the case's coordinates; its image. */
void stability_look(stability_scene *s, const double eye[3], const double target[3], double yfov, unsigned width, unsigned height);

/** The point light, in the case's coordinates. */
void stability_light(stability_scene *s, const double point[3]);

/** Add a triangle in the case's coordinates. */
void stability_add(stability_scene *s, const double a[3], const double b[3], const double c[3]);

/** Add a triangle in coordinates of space. */
void stability_add_placed(stability_scene *s, double vertex[3][3]);

/** Find the directions of all pixels; the camera is there. */
void stability_aim(stability_scene *s);

/** The point of space at distance t, in units of the place's scale, on the ray of a pixel, which may lie between pixels or
    beyond the image; that is at least 2 x 2. */
void stability_along(const stability_scene *s, double x, double y, double t, double out[3]);

/** A triangle about the ray of a pixel at distance t, `reach` pixels large. */
void stability_add_about(stability_scene *s, double x, double y, double reach, double t);

/** A random point in [-size, size]^3, a random unit vector. */
void stability_random_point(stability_scene *s, double size, double out[3]);
void stability_random_direction(stability_scene *s, double out[3]);

/** `count` triangles of about `size` with first vertices in [-1, 1]^3. */
void stability_soup(stability_scene *s, unsigned count, double size);

/** A box of 12 triangles along the axes. */
void stability_box(stability_scene *s, const double low[3], const double high[3]);

/** A camera somewhere about the soup, looking into it. */
void stability_look_anywhere(stability_scene *s, unsigned width, unsigned height);

/** A whole number below `limit`. */
unsigned stability_random_below(stability_scene *s, unsigned limit);

#endif
