#include "scene/light.h"

#include <math.h>

#include "scene/scene.h"
#include "scene/vector.h"

void scene_light_complete(scene_light *light, const double bounds_min[3], const double bounds_max[3])
{
    if (!light->has_area) {
        double extent[3], center[3];
        for (int axis = 0; axis < 3; axis++) {
            extent[axis] = bounds_max[axis] - bounds_min[axis];
            center[axis] = 0.5 * (bounds_min[axis] + bounds_max[axis]);
            light->u[axis] = light->v[axis] = 0;
        }
        double diagonal = sqrt(scene_dot(extent, extent));
        if (!(diagonal > 0))
            diagonal = 1;
        double width = diagonal / 10;
        light->u[0] = width; /* x cross z is -y: facing down */
        light->v[2] = width;
        light->corner[0] = center[0] - width / 2;
        light->corner[1] = center[1] + diagonal / 4;
        light->corner[2] = center[2] - width / 2;
    }
    if (!light->has_point)
        for (int axis = 0; axis < 3; axis++)
            light->point[axis] = light->corner[axis] + 0.5 * (light->u[axis] + light->v[axis]);
}

void scene_light_scale(scene_light *light, double factor)
{
    for (int axis = 0; axis < 3; axis++) {
        light->corner[axis] += 0.5 * (1 - factor) * (light->u[axis] + light->v[axis]);
        light->u[axis] *= factor;
        light->v[axis] *= factor;
    }
}

base_status scene_light_check(const scene_light *light, base_error *err)
{
    const struct {
        const char *name;
        const double *value;
    } fields[] = {{"light.corner", light->corner}, {"light.u", light->u}, {"light.v", light->v}, {"light.point", light->point}};
    for (unsigned i = 0; i < sizeof fields / sizeof fields[0]; i++)
        if (!scene_within(fields[i].value, 10 * SCENE_MAX_COORDINATE))
            return base_fail(err, BASE_ERR_INPUT, fields[i].name, "(%g, %g, %g) is not within %g of the origin",
                             fields[i].value[0], fields[i].value[1], fields[i].value[2], 10 * SCENE_MAX_COORDINATE);
    double normal[3];
    scene_cross(normal, light->u, light->v);
    if (light->has_area && !(scene_dot(normal, normal) > 0))
        return base_fail(err, BASE_ERR_INPUT, "light", "u and v are parallel or zero, so the light has no area");
    return BASE_OK;
}
