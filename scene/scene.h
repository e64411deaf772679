/* A scene: triangles with a base colour each, cameras and one light, as plain arrays.
 *
 * Space is glTF's: right-handed, y up, in the file's own units. A triangle's front is the side from which its
 * vertices run counter-clockwise, the side that (v1-v0) x (v2-v0) points to.
 */
#ifndef SCENE_SCENE_H
#define SCENE_SCENE_H

#include <stddef.h>
#include <stdint.h>

#include "lrbni/base/status.h"
#include "scene/camera.h"
#include "scene/light.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Triangle ids are 32-bit and 0xffffffff means 'none'; simulated memory holds 4 GiB (lrbni/base/arena.h). */
#define SCENE_MAX_TRIANGLES ((size_t)1 << 25)

/* Largest absolute coordinate of a vertex: the squared length of a float normal, at most 192 times its fourth power,
   stays finite. Cameras and lights may lie ten times as far out. */
#define SCENE_MAX_COORDINATE 1e9

typedef struct scene_triangle {
    float v[3][3]; /* vertex, axis */
} scene_triangle;

typedef struct scene_material {
    float base_color[3]; /* linear RGB in [0,1] */
} scene_material;

typedef struct scene {
    char name[128];
    size_t triangle_count;
    scene_triangle *triangles;   /* triangle_count, in file order: the index is the triangle's id */
    uint32_t *triangle_material; /* triangle_count, each below material_count */
    size_t material_count;       /* at least 1 */
    scene_material *materials;
    size_t camera_count; /* at least 1 after scene_finish */
    scene_camera *cameras;
    scene_light light;
    double bounds_min[3], bounds_max[3]; /* of the triangles; set by scene_finish */
    uint64_t hash;                       /* of all of the above but the name; set by scene_finish */
} scene;

/** An empty scene of that name, owned by the caller: free it with scene_destroy. Errors: BASE_ERR_NOMEM. */
base_status scene_create(const char *name, scene **out, base_error *err);

/** Free a scene and everything in it; sets the pointer to NULL. NULL contents are fine. */
void scene_destroy(scene **s);

/**
 * Append `count` triangles of one material.
 *
 * @param triangles  copied
 * @param material   index returned by scene_add_material
 *
 * Errors: BASE_ERR_INPUT beyond SCENE_MAX_TRIANGLES, BASE_ERR_NOMEM; the scene is unchanged then.
 */
base_status scene_add_triangles(scene *s, const scene_triangle *triangles, size_t count, uint32_t material, base_error *err);

/** Append a material and return its index in *index. Errors: BASE_ERR_NOMEM. */
base_status scene_add_material(scene *s, scene_material material, uint32_t *index, base_error *err);

/** Append a camera; it must pass scene_camera_check. Errors: those of the check, BASE_ERR_NOMEM. */
base_status scene_add_camera(scene *s, scene_camera camera, base_error *err);

/**
 * Check the whole scene and complete it: bounds, hash, a camera framing the bounds if there is none, the default
 * light if there is none (a square above the centre, docs/interface.md).
 *
 * Errors: BASE_ERR_INPUT for no triangles, a vertex that is NaN or infinite, bounds so large that float
 * arithmetic on them would overflow. The text names the triangle.
 */
base_status scene_finish(scene *s, base_error *err);

/**
 * Open a scene by the name that --scene takes: `builtin:NAME` or the path of a .glb or .gltf file.
 *
 * Errors: BASE_ERR_USAGE for an unknown built-in scene, otherwise those of scene_gltf_load and scene_finish.
 */
base_status scene_open(const char *spec, scene **out, base_error *err);

/** Camera by index ("0") or by name; NULL chooses the first. Errors: BASE_ERR_USAGE, naming those there are. */
base_status scene_find_camera(const scene *s, const char *name, const scene_camera **out, base_error *err);

#ifdef __cplusplus
}
#endif
#endif
