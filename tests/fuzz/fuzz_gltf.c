/* libFuzzer target: any bytes either load as a scene that keeps scene.h's promises or fail with words. */
#include <stdint.h>
#include <stdlib.h>

#include "scene/gltf_loader.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void require(int condition)
{
    if (!condition)
        abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    scene *s;
    base_error err = {0};
    base_status status = scene_gltf_parse("input", data, size, &s, &err);
    if (status != BASE_OK) {
        require(!s && err.status == status && err.what[0] && err.why[0]);
        return 0;
    }
    require(s->triangle_count > 0 && s->triangle_count <= SCENE_MAX_TRIANGLES && s->camera_count > 0);
    for (size_t i = 0; i < s->triangle_count; i++)
        require(s->triangle_material[i] < s->material_count);
    for (int axis = 0; axis < 3; axis++)
        require(s->bounds_min[axis] <= s->bounds_max[axis]);
    for (size_t i = 0; i < s->camera_count; i++)
        require(scene_camera_check(&s->cameras[i], NULL) == BASE_OK);
    require(scene_light_check(&s->light, NULL) == BASE_OK);
    scene_destroy(&s);
    return 0;
}
