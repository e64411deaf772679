#include "scene/gltf_loader.h"

#include <cmath>
#include <cstring>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "scene/gltf_mesh.hpp"

namespace {

using gltf::fail;

/* At most `size` - 1 bytes, cut between characters of UTF-8. */
void copy_name(char *to, size_t size, const std::string &name)
{
    size_t n = name.size();
    if (n > size - 1) {
        n = size - 1;
        while (n > 0 && (static_cast<unsigned char>(name[n]) & 0xc0) == 0x80)
            n--;
    }
    memcpy(to, name.data(), n);
    to[n] = '\0';
}

/* conference of models/conference.glb */
std::string base_name(const std::string &path)
{
    size_t slash = path.rfind('/');
    std::string name = slash == path.npos ? path : path.substr(slash + 1);
    size_t dot = name.rfind('.');
    return dot == name.npos || dot == 0 ? name : name.substr(0, dot);
}

/* Fills a scene from a document, node by node. */
class walk {
public:
    walk(const gltf::document &doc, scene *s) : doc_(doc), meshes_(doc, s), scene_(s), reached_(doc.model.nodes.size()) {}

    void run();

private:
    /* A node that is to be visited, and its parent's transform. */
    struct pending {
        size_t node;
        gltf::transform parent;
    };

    void reach(int node, const gltf::transform &parent);
    std::vector<int> roots() const;
    void visit(const pending &p);
    void add_camera(const tinygltf::Node &node, size_t index, const gltf::transform &world);
    void take_area_light(const tinygltf::Node &node);
    void take_point_light(const tinygltf::Node &node, size_t index, const gltf::transform &world);

    const gltf::document &doc_;
    gltf::mesh_reader meshes_;
    scene *scene_;
    std::vector<bool> reached_;
    std::vector<pending> stack_; /* and not recursion: a file may nest nodes as deeply as it likes */
};

/* Put a node on the stack. Each comes there once, so the walk ends whatever the file says. */
void walk::reach(int node, const gltf::transform &parent)
{
    if (node < 0 || size_t(node) >= reached_.size())
        fail("node %d does not exist (there are %zu)", node, reached_.size());
    if (reached_[size_t(node)])
        fail("node %d is reached twice: nodes must form a tree", node);
    reached_[size_t(node)] = true;
    stack_.push_back({size_t(node), parent});
}

/* The nodes of the default scene; of a file without scenes, those that are nobody's child. */
std::vector<int> walk::roots() const
{
    const tinygltf::Model &model = doc_.model;
    if (model.defaultScene >= 0 && size_t(model.defaultScene) >= model.scenes.size())
        fail("scene %d does not exist (there are %zu)", model.defaultScene, model.scenes.size());
    if (!model.scenes.empty())
        return model.scenes[model.defaultScene >= 0 ? size_t(model.defaultScene) : 0].nodes;
    std::vector<bool> is_child(model.nodes.size());
    std::vector<int> nodes;
    for (const tinygltf::Node &node : model.nodes)
        for (int child : node.children)
            if (child >= 0 && size_t(child) < is_child.size())
                is_child[size_t(child)] = true;
    for (size_t i = 0; i < is_child.size(); i++)
        if (!is_child[i])
            nodes.push_back(static_cast<int>(i));
    return nodes;
}

void walk::run()
{
    meshes_.add_materials();
    std::vector<int> first = roots();
    for (size_t i = first.size(); i-- > 0;)
        reach(first[i], gltf::transform());
    while (!stack_.empty()) {
        pending next = stack_.back();
        stack_.pop_back();
        visit(next);
    }
}

void walk::visit(const pending &p)
{
    const tinygltf::Node &node = doc_.model.nodes[p.node];
    gltf::transform world = p.parent.times(gltf::node_transform(node, p.node));
    if (node.mesh >= 0)
        meshes_.add(node.mesh, p.node, world);
    if (node.camera >= 0)
        add_camera(node, p.node, world);
    take_area_light(node);
    take_point_light(node, p.node, world);
    for (size_t i = node.children.size(); i-- > 0;)
        reach(node.children[i], world);
}

/* Along -Z of the node, +Y up. */
void walk::add_camera(const tinygltf::Node &node, size_t index, const gltf::transform &world)
{
    static const double origin[3] = {0, 0, 0};
    if (size_t(node.camera) >= doc_.model.cameras.size())
        fail("node %zu: camera %d does not exist (there are %zu)", index, node.camera, doc_.model.cameras.size());
    const tinygltf::Camera &source = doc_.model.cameras[size_t(node.camera)];
    if (source.type != "perspective")
        return;
    double ahead[3], up[3];
    for (int axis = 0; axis < 3; axis++) {
        ahead[axis] = -world.m[axis][2];
        up[axis] = world.m[axis][1];
    }
    char name[sizeof scene_->cameras->name];
    copy_name(name, sizeof name, !node.name.empty() ? node.name : source.name);
    scene_camera camera = scene_camera_look_at(name, origin, ahead, up, source.perspective.yfov);
    for (int axis = 0; axis < 3; axis++) {
        camera.position[axis] = world.m[axis][3];
        if (!std::isfinite(ahead[axis]) || (ahead[0] == 0 && ahead[1] == 0 && ahead[2] == 0))
            fail("node %zu: its camera looks nowhere: the node's z axis is zero or not finite", index);
    }
    base_error error;
    gltf::check(scene_add_camera(scene_, camera, &error), error);
}

void walk::take_area_light(const tinygltf::Node &node)
{
    if (scene_->light.has_area || !node.extras.Has("light"))
        return;
    const struct {
        const char *key;
        double *to;
    } parts[] = {{"corner", scene_->light.corner}, {"u", scene_->light.u}, {"v", scene_->light.v}};
    const tinygltf::Value &light = node.extras.Get("light");
    for (const auto &part : parts) {
        const tinygltf::Value &value = light.Get(part.key);
        for (size_t axis = 0; axis < 3; axis++)
            part.to[axis] = value.Get(axis).GetNumberAsDouble();
    }
    scene_->light.has_area = 1;
}

void walk::take_point_light(const tinygltf::Node &node, size_t index, const gltf::transform &world)
{
    auto found = node.extensions.find("KHR_lights_punctual");
    if (found == node.extensions.end())
        return;
    int light = found->second.Get("light").GetNumberAsInt();
    if (light < 0 || size_t(light) >= doc_.model.lights.size())
        fail("node %zu: KHR_lights_punctual light %d does not exist (there are %zu)", index, light, doc_.model.lights.size());
    if (scene_->light.has_point || doc_.model.lights[size_t(light)].type != "point")
        return;
    for (int axis = 0; axis < 3; axis++)
        scene_->light.point[axis] = world.m[axis][3];
    scene_->light.has_point = 1;
}

struct destroy_scene {
    void operator()(scene *s) const { scene_destroy(&s); }
};

/* The whole of the loading, behind the border that no exception crosses. */
template <typename get_bytes>
base_status load(const char *name, const std::string *folder, get_bytes bytes, scene **out, base_error *err)
{
    *out = nullptr;
    try {
        scene *created;
        base_error error;
        auto owner = bytes();
        gltf::document doc = gltf::read_document({owner.data, owner.size}, folder);
        char scene_name[sizeof(scene::name)];
        copy_name(scene_name, sizeof scene_name, base_name(name));
        gltf::check(scene_create(scene_name, &created, &error), error);
        std::unique_ptr<scene, destroy_scene> s(created);
        walk(doc, s.get()).run();
        gltf::check(scene_finish(s.get(), &error), error, s->name);
        *out = s.release();
        return BASE_OK;
    } catch (const std::bad_alloc &) {
        return base_fail(err, BASE_ERR_NOMEM, name, "out of memory");
    } catch (const std::exception &e) {
        return base_fail(err, BASE_ERR_INPUT, name, "%s", e.what());
    } catch (...) {
        return base_fail(err, BASE_ERR_INPUT, name, "unknown exception");
    }
}

} // namespace

extern "C" base_status scene_gltf_load(const char *path, scene **out, base_error *err)
{
    std::string text = path;
    size_t slash = text.rfind('/');
    std::string folder = slash == text.npos ? "" : text.substr(0, slash + 1);
    struct owned_bytes {
        std::vector<uint8_t> bytes;
        const uint8_t *data;
        size_t size;
    };
    auto read = [&] {
        owned_bytes owner = {gltf::read_file(text), nullptr, 0};
        owner.data = owner.bytes.data();
        owner.size = owner.bytes.size();
        return owner;
    };
    return load(path, &folder, read, out, err);
}

extern "C" base_status scene_gltf_parse(const char *name, const unsigned char *data, size_t size, scene **out, base_error *err)
{
    return load(name, nullptr, [&] { return gltf::span{data, size}; }, out, err);
}
