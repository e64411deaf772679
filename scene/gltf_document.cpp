/* tinygltf takes a field of the wrong type for a missing one and shortens large integers to 32 bits; its loading of
   GLB chunks and buffers trusts some sizes. So the JSON is parsed here first, every field that a scene needs is
   checked by name, and tinygltf gets a document of exactly those fields. */
#include "scene/gltf_document.hpp"

#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <nlohmann/json.hpp>

#include "scene/gltf_buffer.hpp"
#include "scene/gltf_failure.hpp"

namespace gltf {

namespace {

using nlohmann::json;

enum class kind { index, boolean, text, number, numbers3, numbers4, numbers16, indices };

struct field {
    const char *key;
    kind type;
    bool required;
};

bool is_index(const json &value)
{
    return value.is_number_unsigned() && value.get<uint64_t>() <= INT32_MAX;
}

bool is_list(const json &value, size_t size, bool (*is_element)(const json &))
{
    if (!value.is_array() || (size && value.size() != size))
        return false;
    for (const json &element : value)
        if (!is_element(element))
            return false;
    return true;
}

bool is_number(const json &value)
{
    return value.is_number();
}

/* NULL, or what the value should have been. */
const char *complaint(const json &value, kind type)
{
    switch (type) {
    case kind::index:
        return is_index(value) ? nullptr : "not an integer in [0, 2147483647]";
    case kind::boolean:
        return value.is_boolean() ? nullptr : "not true or false";
    case kind::text:
        return value.is_string() ? nullptr : "not a string";
    case kind::number:
        return value.is_number() ? nullptr : "not a number";
    case kind::numbers3:
        return is_list(value, 3, is_number) ? nullptr : "not an array of 3 numbers";
    case kind::numbers4:
        return is_list(value, 4, is_number) ? nullptr : "not an array of 4 numbers";
    case kind::numbers16:
        return is_list(value, 16, is_number) ? nullptr : "not an array of 16 numbers";
    case kind::indices:
        return is_list(value, 0, is_index) ? nullptr : "not an array of integers in [0, 2147483647]";
    }
    return "of no known type";
}

/* The named fields of an object, checked; `where` names it in errors. */
json pick(const std::string &where, const json &object, std::initializer_list<field> fields)
{
    json picked = json::object();
    if (!object.is_object())
        fail("%s is not an object", where.c_str());
    for (const field &f : fields) {
        auto found = object.find(f.key);
        if (found == object.end()) {
            if (f.required)
                fail("%s: %s is missing", where.c_str(), f.key);
            continue;
        }
        if (const char *why = complaint(*found, f.type))
            fail("%s: %s is %s", where.c_str(), f.key, why);
        picked[f.key] = *found;
    }
    return picked;
}

/* A member that must be an object if it is there; NULL if it is not. */
const json *object_member(const std::string &where, const json &object, const char *key)
{
    auto found = object.find(key);
    if (found == object.end())
        return nullptr;
    if (!found->is_object())
        fail("%s: %s is not an object", where.c_str(), key);
    return &*found;
}

using pick_one = json (*)(const std::string &where, const json &object, const json &root);

/* An array of the root, or of a part of it, with each element picked by `one`. */
json pick_each(const std::string &noun, const json &owner, const char *key, pick_one one, const json &root)
{
    json picked = json::array();
    auto found = owner.find(key);
    if (found == owner.end())
        return picked;
    if (!found->is_array())
        fail("%s is not an array", key);
    size_t i = 0;
    for (const json &element : *found)
        picked.push_back(one(noun + " " + std::to_string(i++), element, root));
    return picked;
}

json pick_scene(const std::string &where, const json &object, const json &)
{
    return pick(where, object, {{"nodes", kind::indices, false}});
}

json pick_area_light(const std::string &where, const json &light)
{
    json picked = pick(where + ": extras.light", light,
                       {{"corner", kind::numbers3, true}, {"u", kind::numbers3, true}, {"v", kind::numbers3, true}});
    for (json &vector : picked)
        for (json &number : vector)
            number = number.get<double>(); /* tinygltf would keep integers of extras as 32 bits */
    return picked;
}

json pick_node(const std::string &where, const json &object, const json &)
{
    json node = pick(where, object,
                     {{"name", kind::text, false}, {"children", kind::indices, false}, {"mesh", kind::index, false},
                      {"camera", kind::index, false}, {"matrix", kind::numbers16, false}, {"translation", kind::numbers3, false},
                      {"rotation", kind::numbers4, false}, {"scale", kind::numbers3, false}});
    if (node.contains("matrix") && (node.contains("translation") || node.contains("rotation") || node.contains("scale")))
        fail("%s: has both a matrix and translation, rotation or scale", where.c_str());
    auto extras = object.find("extras"); /* anybody's: what is not a light as we write it is left alone */
    if (extras != object.end() && extras->is_object()) {
        auto light = extras->find("light");
        if (light != extras->end() && light->is_object() && light->contains("corner"))
            node["extras"]["light"] = pick_area_light(where, *light);
    }
    if (const json *extensions = object_member(where, object, "extensions"))
        if (const json *punctual = object_member(where, *extensions, "KHR_lights_punctual"))
            node["extensions"]["KHR_lights_punctual"] =
                pick(where + ": KHR_lights_punctual", *punctual, {{"light", kind::index, true}});
    return node;
}

/* tinygltf wants the indices to have a bufferView; without one they would all be 0. */
void check_indices(const std::string &where, size_t index, const json &root)
{
    auto accessors = root.find("accessors");
    size_t count = accessors != root.end() && accessors->is_array() ? accessors->size() : 0;
    if (index >= count)
        fail("%s: indices: accessor %zu does not exist (there are %zu)", where.c_str(), index, count);
    const json &accessor = (*accessors)[index];
    if (!accessor.is_object() || !accessor.contains("bufferView"))
        fail("%s: indices: accessor %zu has no bufferView", where.c_str(), index);
    const json &view = accessor["bufferView"];
    auto views = root.find("bufferViews");
    count = views != root.end() && views->is_array() ? views->size() : 0;
    if (!is_index(view) || view.get<size_t>() >= count)
        fail("accessor %zu: bufferView %s does not exist (there are %zu)", index, view.dump().substr(0, 40).c_str(), count);
}

json pick_primitive(const std::string &where, const json &object, const json &root)
{
    json primitive = pick(where, object,
                          {{"indices", kind::index, false}, {"material", kind::index, false}, {"mode", kind::index, false}});
    const json *attributes = object_member(where, object, "attributes");
    if (!attributes)
        fail("%s: attributes is missing", where.c_str());
    primitive["attributes"] = pick(where + ": attributes", *attributes, {{"POSITION", kind::index, false}});
    if (primitive.contains("indices"))
        check_indices(where, primitive["indices"].get<size_t>(), root);
    return primitive;
}

json pick_mesh(const std::string &where, const json &object, const json &root)
{
    json mesh = pick(where, object, {});
    if (!object.contains("primitives"))
        fail("%s: primitives is missing", where.c_str());
    mesh["primitives"] = pick_each(where + " primitive", object, "primitives", pick_primitive, root);
    return mesh;
}

json pick_accessor(const std::string &where, const json &object, const json &)
{
    json accessor = pick(where, object,
                         {{"bufferView", kind::index, false}, {"byteOffset", kind::index, false},
                          {"componentType", kind::index, true}, {"count", kind::index, true}, {"type", kind::text, true}, {"normalized", kind::boolean, false}});
    if (const json *sparse = object_member(where, object, "sparse")) {
        std::string inside = where + ": sparse";
        json &picked = accessor["sparse"] = pick(inside, *sparse, {{"count", kind::index, true}});
        const json *indices = object_member(inside, *sparse, "indices"), *values = object_member(inside, *sparse, "values");
        if (!indices || !values)
            fail("%s: %s is missing", inside.c_str(), indices ? "values" : "indices");
        picked["indices"] = pick(inside + ".indices", *indices,
                                 {{"bufferView", kind::index, true}, {"byteOffset", kind::index, false},
                                  {"componentType", kind::index, true}});
        picked["values"] = pick(inside + ".values", *values,
                                {{"bufferView", kind::index, true}, {"byteOffset", kind::index, false}});
    }
    return accessor;
}

json pick_view(const std::string &where, const json &object, const json &)
{
    return pick(where, object,
                {{"buffer", kind::index, true}, {"byteOffset", kind::index, false}, {"byteLength", kind::index, true},
                 {"byteStride", kind::index, false}});
}

json pick_material(const std::string &where, const json &object, const json &)
{
    json material = pick(where, object, {});
    if (const json *pbr = object_member(where, object, "pbrMetallicRoughness"))
        material["pbrMetallicRoughness"] =
            pick(where + ": pbrMetallicRoughness", *pbr, {{"baseColorFactor", kind::numbers4, false}});
    return material;
}

json pick_camera(const std::string &where, const json &object, const json &)
{
    json camera = pick(where, object, {{"type", kind::text, true}, {"name", kind::text, false}});
    if (camera["type"] == "perspective") {
        const json *perspective = object_member(where, object, "perspective");
        if (!perspective)
            fail("%s: perspective is missing", where.c_str());
        camera["perspective"] = pick(where + ": perspective", *perspective, {{"yfov", kind::number, true}});
        camera["perspective"]["znear"] = 1; /* tinygltf insists; rays have no near plane */
    } else if (camera["type"] == "orthographic") {
        camera["orthographic"] = {{"xmag", 1}, {"ymag", 1}, {"zfar", 1}, {"znear", 1}}; /* left out later */
    } else {
        fail("%s: type is neither perspective nor orthographic", where.c_str());
    }
    return camera;
}

json pick_light(const std::string &where, const json &object, const json &)
{
    json light = pick(where, object, {{"type", kind::text, true}});
    if (light["type"] != "point")
        light["type"] = "directional"; /* spots are no use either, and tinygltf wants their cones */
    return light;
}

json pick_buffer(const std::string &where, const json &object, const json &)
{
    return pick(where, object, {{"byteLength", kind::index, true}, {"uri", kind::text, false}});
}

bool starts_with(const std::string &text, const char *prefix)
{
    return text.compare(0, strlen(prefix), prefix) == 0;
}

/* Extensions of materials, textures and lights leave the triangles as they are, and so may be required. */
void check_required_extensions(const json &root)
{
    auto required = root.find("extensionsRequired");
    if (required == root.end())
        return;
    if (!required->is_array())
        fail("extensionsRequired is not an array");
    for (const json &element : *required) {
        if (!element.is_string())
            fail("extensionsRequired: holds something else than strings");
        std::string name = element.get<std::string>();
        if (name != "KHR_lights_punctual" && name != "KHR_mesh_quantization" && !starts_with(name, "KHR_materials_") &&
            !starts_with(name, "KHR_texture_") && !starts_with(name, "EXT_texture_"))
            fail("extensionsRequired: %s is not supported", name.c_str());
    }
}

void check_asset(const json &root)
{
    const json *asset = object_member("root", root, "asset");
    if (!asset)
        fail("asset is missing");
    json picked = pick("asset", *asset, {{"version", kind::text, true}, {"minVersion", kind::text, false}});
    std::string version = picked["version"].get<std::string>();
    if (!starts_with(version, "2."))
        fail("asset: version %s instead of 2.0", version.c_str());
    if (picked.contains("minVersion") && picked["minVersion"] != "2.0")
        fail("asset: minVersion %s is beyond 2.0", picked["minVersion"].get<std::string>().c_str());
}

/* All that a scene needs of the root object, but for the buffers. */
json reduce(const json &root)
{
    check_asset(root);
    check_required_extensions(root);
    json reduced = pick("root", root, {{"scene", kind::index, false}});
    reduced["asset"] = {{"version", "2.0"}};
    reduced["scenes"] = pick_each("scene", root, "scenes", pick_scene, root);
    reduced["nodes"] = pick_each("node", root, "nodes", pick_node, root);
    reduced["meshes"] = pick_each("mesh", root, "meshes", pick_mesh, root);
    reduced["accessors"] = pick_each("accessor", root, "accessors", pick_accessor, root);
    reduced["bufferViews"] = pick_each("bufferView", root, "bufferViews", pick_view, root);
    reduced["materials"] = pick_each("material", root, "materials", pick_material, root);
    reduced["cameras"] = pick_each("camera", root, "cameras", pick_camera, root);
    if (const json *extensions = object_member("root", root, "extensions"))
        if (const json *punctual = object_member("extensions", *extensions, "KHR_lights_punctual"))
            reduced["extensions"]["KHR_lights_punctual"]["lights"] =
                pick_each("KHR_lights_punctual light", *punctual, "lights", pick_light, root);
    return reduced;
}

json parse(span text)
{
    try {
        json root = json::parse(text.data, text.data + text.size);
        if (!root.is_object())
            fail("the JSON is not an object");
        return root;
    } catch (const json::exception &e) { /* its text begins with a tag: [json.exception.parse_error.101] */
        const char *tag_end = strstr(e.what(), "] ");
        fail("not glTF: %s", tag_end ? tag_end + 2 : e.what());
    }
}

tinygltf::Model build_model(const json &reduced)
{
    tinygltf::TinyGLTF reader;
    tinygltf::Model model;
    std::string error, warning, text = reduced.dump();
    if (text.size() > max_file_bytes)
        fail("more than 2 GiB of JSON");
    if (!reader.LoadASCIIFromString(&model, &error, &warning, text.data(), static_cast<unsigned>(text.size()), ""))
        fail("tinygltf: %s", error.empty() ? "refuses the file" : error.substr(0, error.find_last_not_of("\n ") + 1).c_str());
    return model;
}

} // namespace

document read_document(span file, const std::string *folder)
{
    document result;
    container parts = split(file);
    json reduced, buffers;
    {
        json root = parse(parts.json);
        buffers = pick_each("buffer", root, "buffers", pick_buffer, root);
        reduced = reduce(root);
    }
    result.model = build_model(reduced);
    size_t left = max_file_bytes;
    for (size_t i = 0; i < buffers.size(); i++) {
        const json &buffer = buffers[i];
        const std::string *uri = buffer.contains("uri") ? buffer["uri"].get_ptr<const json::string_t *>() : nullptr;
        size_t size = buffer["byteLength"].get<size_t>();
        if (size > left)
            fail("buffer %zu: more than 2 GiB of buffers", i);
        left -= size;
        buffer_place place = {i, size, uri, parts.is_glb && i == 0 ? &parts.binary : nullptr, folder};
        result.buffers.push_back(read_buffer(place, &result.owned));
    }
    return result;
}

} // namespace gltf
