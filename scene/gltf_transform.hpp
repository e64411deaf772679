/* Affine transforms of glTF nodes, in double. */
#ifndef SCENE_GLTF_TRANSFORM_HPP
#define SCENE_GLTF_TRANSFORM_HPP

#include "scene/gltf_tinygltf.hpp"

namespace gltf {

/* Row, column; a point p goes to m[r][0..2] . p + m[r][3]. */
struct transform {
    double m[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};

    bool is_identity() const;
    /* Negative if it turns things inside out. */
    double determinant() const;
    /* First `inner`, then this. */
    transform times(const transform &inner) const;
};

/**
 * A node's own transform: its matrix, or its translation * rotation * scale.
 *
 * Errors (failure): a matrix whose last row is not (0, 0, 0, 1), a rotation that is zero.
 */
transform node_transform(const tinygltf::Node &node, size_t index);

} // namespace gltf

#endif
