/* A pinhole camera and the primary rays it stands for (docs/interface.md). */
#ifndef SCENE_CAMERA_H
#define SCENE_CAMERA_H

#include "lrbni/base/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct scene_camera {
    char name[64];
    double position[3];
    double forward[3], right[3], up[3]; /* orthonormal, right = forward x up */
    double yfov;                        /* full vertical opening angle [rad], in (0, pi) */
} scene_camera;

/**
 * A camera at `eye` looking at `target`.
 *
 * @param up    need not be orthogonal to the view; if parallel to it, another axis is taken
 * @param yfov  full vertical opening angle [rad]
 */
scene_camera scene_camera_look_at(const char *name, const double eye[3], const double target[3], const double up[3], double yfov);

/** A camera that sees the whole of a box from above one of its corners; for scenes that bring none. */
scene_camera scene_camera_framing(const double bounds_min[3], const double bounds_max[3]);

/** Finite position, orthonormal axes within 1e-6, yfov in (0, pi). Errors: BASE_ERR_INPUT naming the camera. */
base_status scene_camera_check(const scene_camera *camera, base_error *err);

/*
 * The primary rays of an image as three vectors: pixel (x, y) has direction d00 + x*dx + y*dy, not normalised,
 * its component along `forward` being 1, so that the ray parameter is the depth. In float, because these are the
 * bits that every kernel works with; they are rounded once, from double.
 */
typedef struct scene_primary_rays {
    float origin[3];
    float d00[3], dx[3], dy[3];
} scene_primary_rays;

/** The primary rays of a width x height image. */
scene_primary_rays scene_camera_rays(const scene_camera *camera, unsigned width, unsigned height);

#ifdef __cplusplus
}
#endif
#endif
