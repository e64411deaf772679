/* Meshes of a glTF file to triangles of a scene. */
#ifndef SCENE_GLTF_MESH_HPP
#define SCENE_GLTF_MESH_HPP

#include <memory>
#include <vector>

#include "scene/gltf_accessor.hpp"
#include "scene/gltf_failure.hpp"
#include "scene/gltf_transform.hpp"
#include "scene/scene.h"

namespace gltf {

/**
 * Turn a failed status of a scene_ function into an exception: bad_alloc for BASE_ERR_NOMEM, else a failure.
 *
 * @param subject  an error's `what` that need not be repeated, or NULL
 */
void check(base_status status, const base_error &error, const char *subject = nullptr);

/* Appends meshes to a scene. */
class mesh_reader {
public:
    mesh_reader(const document &doc, scene *s) : doc_(doc), scene_(s), accessors_(doc.model.accessors.size()) {}

    /** All materials of the file, in its order, so that indices stay the same; then white, for primitives without. */
    void add_materials();

    /** The triangles of mesh `mesh` of node `node`. Errors (failure): what does not exist or is out of range. */
    void add(int mesh, size_t node, const transform &world);

private:
    struct primitive;

    const accessor &get(int index);
    void add_primitive(const tinygltf::Primitive &source, const std::string &where, const transform &world);
    void add_triangles(const primitive &p);

    const document &doc_;
    scene *scene_;
    std::vector<std::unique_ptr<accessor>> accessors_; /* checked ones */
};

} // namespace gltf

#endif
