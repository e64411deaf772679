#include "scene/gltf_mesh.hpp"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstring>
#include <new>
#include <string>
#include <utility>

namespace gltf {

/* A primitive that is ready to be cut into triangles. */
struct mesh_reader::primitive {
    const std::string &where; /* for errors */
    const accessor &positions;
    const accessor *indices; /* NULL: the vertices in their order */
    const transform &world;
    bool is_identity, flipped;
    int mode;
    size_t triangle_count;
    uint32_t material;
};

namespace {

/* Like a cast, but defined for what a float cannot hold: infinity, which scene_finish then refuses by name. */
float round_once(double x)
{
    if (std::fabs(x) > double(FLT_MAX) * (1 + 0x1p-25))
        return std::copysign(HUGE_VALF, static_cast<float>(std::copysign(1.0, x)));
    return static_cast<float>(x);
}

/* Elements that make up triangle t, in the specification's order (glTF 2.0, 3.7.2.1). */
void triangle_elements(int mode, size_t t, size_t element[3])
{
    switch (mode) {
    case TINYGLTF_MODE_TRIANGLE_STRIP:
        element[0] = t;
        element[1] = t + 1 + t % 2;
        element[2] = t + 2 - t % 2;
        return;
    case TINYGLTF_MODE_TRIANGLE_FAN:
        element[0] = t + 1;
        element[1] = t + 2;
        element[2] = 0;
        return;
    default:
        for (size_t corner = 0; corner < 3; corner++)
            element[corner] = 3 * t + corner;
    }
}

bool is_position(const accessor &a)
{
    switch (a.component_type()) {
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
    case TINYGLTF_COMPONENT_TYPE_BYTE: /* these four: KHR_mesh_quantization */
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return a.type() == TINYGLTF_TYPE_VEC3;
    default:
        return false;
    }
}

bool is_index(const accessor &a)
{
    switch (a.component_type()) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return a.type() == TINYGLTF_TYPE_SCALAR;
    default:
        return false;
    }
}

size_t count_triangles(const std::string &where, int mode, size_t elements)
{
    if (mode != TINYGLTF_MODE_TRIANGLES)
        return elements < 3 ? 0 : elements - 2;
    if (elements % 3 != 0)
        fail("%s: %zu elements are not whole triangles", where.c_str(), elements);
    return elements / 3;
}

/* Vertex v in world space. */
void read_vertex(float out[3], const accessor &positions, size_t v, const transform *world)
{
    double p[3];
    for (int axis = 0; axis < 3; axis++)
        p[axis] = positions.number(v, axis);
    for (int axis = 0; axis < 3; axis++) {
        const double *row = world ? world->m[axis] : nullptr;
        out[axis] = round_once(row ? row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3] : p[axis]);
    }
}

} // namespace

void check(base_status status, const base_error &error, const char *subject)
{
    if (status == BASE_ERR_NOMEM)
        throw std::bad_alloc();
    if (status != BASE_OK && subject && strncmp(error.what, subject, sizeof error.what - 1) == 0)
        fail("%s", error.why);
    if (status != BASE_OK)
        fail("%s: %s", error.what, error.why);
}

void mesh_reader::add_materials()
{
    uint32_t index;
    base_error error;
    for (const tinygltf::Material &source : doc_.model.materials) {
        scene_material material;
        for (size_t c = 0; c < 3; c++)
            material.base_color[c] = round_once(source.pbrMetallicRoughness.baseColorFactor[c]);
        check(scene_add_material(scene_, material, &index, &error), error);
    }
    check(scene_add_material(scene_, {{1, 1, 1}}, &index, &error), error);
}

const accessor &mesh_reader::get(int index)
{
    if (size_t(index) >= accessors_.size())
        fail("accessor %d does not exist (there are %zu)", index, accessors_.size());
    std::unique_ptr<accessor> &slot = accessors_[size_t(index)];
    if (!slot)
        slot = std::make_unique<accessor>(doc_, size_t(index));
    return *slot;
}

void mesh_reader::add(int mesh, size_t node, const transform &world)
{
    if (size_t(mesh) >= doc_.model.meshes.size())
        fail("node %zu: mesh %d does not exist (there are %zu)", node, mesh, doc_.model.meshes.size());
    size_t number = 0;
    for (const tinygltf::Primitive &source : doc_.model.meshes[size_t(mesh)].primitives)
        add_primitive(source, "mesh " + std::to_string(mesh) + " primitive " + std::to_string(number++), world);
}

void mesh_reader::add_primitive(const tinygltf::Primitive &source, const std::string &where, const transform &world)
{
    if (source.mode > TINYGLTF_MODE_TRIANGLE_FAN)
        fail("%s: mode %d does not exist", where.c_str(), source.mode);
    if (source.mode < TINYGLTF_MODE_TRIANGLES) /* points and lines */
        return;
    auto attribute = source.attributes.find("POSITION");
    if (attribute == source.attributes.end())
        fail("%s: has no POSITION", where.c_str());
    const accessor &positions = get(attribute->second);
    const accessor *indices = source.indices >= 0 ? &get(source.indices) : nullptr;
    if (!is_position(positions))
        fail("%s: POSITION: accessor %d is not a VEC3 of float, or of 8 or 16-bit integers", where.c_str(), attribute->second);
    if (indices && !is_index(*indices))
        fail("%s: indices: accessor %d is not a SCALAR of unsigned integers", where.c_str(), source.indices);
    size_t white = doc_.model.materials.size(), material = source.material >= 0 ? size_t(source.material) : white;
    if (material > white || (material == white && source.material >= 0))
        fail("%s: material %d does not exist (there are %zu)", where.c_str(), source.material, white);
    primitive p = {where,
                   positions,
                   indices,
                   world,
                   world.is_identity(),
                   world.determinant() < 0,
                   source.mode,
                   count_triangles(where, source.mode, indices ? indices->count() : positions.count()),
                   static_cast<uint32_t>(material)};
    if (p.triangle_count > SCENE_MAX_TRIANGLES - scene_->triangle_count)
        fail("%s: more than %zu triangles", where.c_str(), SCENE_MAX_TRIANGLES);
    add_triangles(p);
}

void mesh_reader::add_triangles(const primitive &p)
{
    std::vector<scene_triangle> batch;
    base_error error;
    const size_t batch_size = 4096;
    batch.reserve(std::min(batch_size, p.triangle_count));
    for (size_t t = 0; t < p.triangle_count; t++) {
        scene_triangle triangle;
        size_t element[3];
        triangle_elements(p.mode, t, element);
        if (p.flipped) /* mirrored: the other way round, so that the front stays the front */
            std::swap(element[1], element[2]);
        for (int corner = 0; corner < 3; corner++) {
            size_t v = p.indices ? p.indices->integer(element[corner]) : element[corner];
            if (v >= p.positions.count())
                fail("%s: index %zu is out of range (%zu vertices)", p.where.c_str(), v, p.positions.count());
            read_vertex(triangle.v[corner], p.positions, v, p.is_identity ? nullptr : &p.world);
        }
        batch.push_back(triangle);
        if (batch.size() == batch_size || t + 1 == p.triangle_count) {
            check(scene_add_triangles(scene_, batch.data(), batch.size(), p.material, &error), error);
            batch.clear();
        }
    }
}

} // namespace gltf
