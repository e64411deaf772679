/* glTF 2.0 files (.glb, .gltf) in: the one place that knows tinygltf. */
#ifndef SCENE_GLTF_LOADER_H
#define SCENE_GLTF_LOADER_H

#include <stddef.h>

#include "lrbni/base/status.h"
#include "scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * Load the triangles, base colours, cameras and light of a glTF file's default scene.
 *
 * Triangles come in the order of scene nodes (depth first), primitives and indices, in world space. Modes
 * TRIANGLES, TRIANGLE_STRIP and TRIANGLE_FAN; indices of 8, 16, 32 bits or none; sparse and strided accessors.
 * Points and lines are left out. No compression extension, no skinning, no morph targets: a required extension
 * that would change the geometry is an error.
 *
 * @param out  a scene that scene_finish has completed; owned by the caller
 *
 * Errors: BASE_ERR_INPUT naming the file and the field (missing, truncated, an index or accessor out of range, no
 * triangles, a cycle of nodes, NaN), BASE_ERR_NOMEM.
 */
base_status scene_gltf_load(const char *path, scene **out, base_error *err);

/** The same from memory (a .glb or the JSON text of a .gltf without external files); `name` is used in errors. */
base_status scene_gltf_parse(const char *name, const unsigned char *data, size_t size, scene **out, base_error *err);

#ifdef __cplusplus
}
#endif
#endif
