/* The build functions of the built-in scenes, one file each; scene/builtin.h lists them. */
#ifndef SCENE_BUILTIN_SCENES_H
#define SCENE_BUILTIN_SCENES_H

#include "lrbni/base/status.h"
#include "scene/scene.h"

/**
 * Add materials, triangles, the camera `main` and an area light to an empty scene. Errors: those of the scene_add_
 * functions; BASE_ERR_UNSUPPORTED if the triangle count is not the promised one.
 */
base_status scene_build_rooms(scene *s, base_error *err);
base_status scene_build_hall(scene *s, base_error *err);
base_status scene_build_creature(scene *s, base_error *err);
base_status scene_build_atrium(scene *s, base_error *err);
base_status scene_build_forest(scene *s, base_error *err);
base_status scene_build_fern(scene *s, base_error *err);
base_status scene_build_conference(scene *s, base_error *err);
base_status scene_build_tower(scene *s, base_error *err);
base_status scene_build_dragon(scene *s, base_error *err);

enum {
    SCENE_ROOMS_TRIANGLES = 804,
    SCENE_HALL_TRIANGLES = 60000,
    SCENE_CREATURE_TRIANGLES = 69000,
    SCENE_ATRIUM_TRIANGLES = 76000,
    SCENE_FOREST_TRIANGLES = 174000,
    SCENE_FERN_TRIANGLES = 212000,
    SCENE_CONFERENCE_TRIANGLES = 282000,
    SCENE_TOWER_TRIANGLES = 2195000,
    SCENE_DRAGON_TRIANGLES = 7218906
};

#endif
