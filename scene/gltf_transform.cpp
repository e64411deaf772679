#include "scene/gltf_transform.hpp"

#include <cmath>

#include "scene/gltf_failure.hpp"

namespace gltf {

bool transform::is_identity() const
{
    const transform identity;
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 4; c++)
            if (m[r][c] != identity.m[r][c])
                return false;
    return true;
}

double transform::determinant() const
{
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

transform transform::times(const transform &inner) const
{
    transform product;
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 4; c++)
            product.m[r][c] =
                m[r][0] * inner.m[0][c] + m[r][1] * inner.m[1][c] + m[r][2] * inner.m[2][c] + (c == 3 ? m[r][3] : 0);
    return product;
}

/* Stored by columns. */
static transform from_matrix(const std::vector<double> &columns, size_t index)
{
    const double tolerance = 1e-6;
    if (std::fabs(columns[3]) > tolerance || std::fabs(columns[7]) > tolerance || std::fabs(columns[11]) > tolerance ||
        std::fabs(columns[15] - 1) > tolerance)
        fail("node %zu: the last row of its matrix is not 0 0 0 1", index);
    transform t;
    for (size_t r = 0; r < 3; r++)
        for (size_t c = 0; c < 4; c++)
            t.m[r][c] = columns[4 * c + r];
    return t;
}

/* The rotation of a quaternion (x, y, z, w), which need not be quite of unit length. */
static void set_rotation(transform *t, const std::vector<double> &quaternion, size_t index)
{
    double largest = 0, q[4], length = 0;
    for (double component : quaternion)
        largest = std::fmax(largest, std::fabs(component));
    if (!(largest > 0))
        fail("node %zu: rotation is zero", index);
    for (size_t i = 0; i < 4; i++) { /* by the largest first, lest squares overflow */
        q[i] = quaternion[i] / largest;
        length += q[i] * q[i];
    }
    for (double &component : q)
        component /= std::sqrt(length);
    double x = q[0], y = q[1], z = q[2], w = q[3];
    const double rotation[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
                                   {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
                                   {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}};
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++)
            t->m[r][c] = rotation[r][c];
}

transform node_transform(const tinygltf::Node &node, size_t index)
{
    transform t;
    if (node.matrix.size() == 16)
        return from_matrix(node.matrix, index);
    if (node.rotation.size() == 4)
        set_rotation(&t, node.rotation, index);
    for (size_t r = 0; r < 3; r++) {
        if (node.scale.size() == 3)
            for (size_t c = 0; c < 3; c++)
                t.m[r][c] *= node.scale[c];
        if (node.translation.size() == 3)
            t.m[r][3] = node.translation[r];
    }
    return t;
}

} // namespace gltf
