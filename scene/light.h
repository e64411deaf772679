/* The scene's light: a parallelogram, and the point that the kernels with hard shadows and the shading use. */
#ifndef SCENE_LIGHT_H
#define SCENE_LIGHT_H

#include "lrbni/base/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Points corner + a*u + b*v with a, b in [0,1]; the parallelogram shines towards u x v, the point both ways. */
typedef struct scene_light {
    int has_area, has_point; /* which of the two the scene itself gave */
    double corner[3], u[3], v[3];
    double point[3]; /* of the punctual light, else the parallelogram's centre */
} scene_light;

/**
 * Complete a light (docs/interface.md): without an area light, a square a quarter of the bounds' diagonal above
 * their centre, a tenth of the diagonal wide, facing down; without a point light, the centre of the area light.
 */
void scene_light_complete(scene_light *light, const double bounds_min[3], const double bounds_max[3]);

/** Scale the edge vectors about the light's centre by `factor`. */
void scene_light_scale(scene_light *light, double factor);

/** All numbers finite, u x v not zero if there is an area. Errors: BASE_ERR_INPUT naming the field. */
base_status scene_light_check(const scene_light *light, base_error *err);

#ifdef __cplusplus
}
#endif
#endif
