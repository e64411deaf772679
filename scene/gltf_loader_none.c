/* Stands in for gltf_loader.cpp in builds without tinygltf. */
#include "scene/gltf_loader.h"

base_status scene_gltf_load(const char *path, scene **out, base_error *err)
{
    *out = NULL;
    return base_fail(err, BASE_ERR_UNSUPPORTED, path, "this build reads no glTF files (option gltf); use a builtin: scene");
}

base_status scene_gltf_parse(const char *name, const unsigned char *data, size_t size, scene **out, base_error *err)
{
    (void)data;
    (void)size;
    return scene_gltf_load(name, out, err);
}
