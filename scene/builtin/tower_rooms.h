/* The furnished rooms of the tower. */
#ifndef SCENE_BUILTIN_TOWER_ROOMS_H
#define SCENE_BUILTIN_TOWER_ROOMS_H

#include "scene/builtin/office.h"

#define SCENE_TOWER_ROOM_WIDTH 4.0
#define SCENE_TOWER_ROOM_DEPTH 5.8
#define SCENE_TOWER_ROOM_HEIGHT 3.0
#define SCENE_TOWER_WALL 0.2 /* between a room and the gallery before it */

/**
 * A room in the current frame: its door's wall is the plane z = 0, its window's z = SCENE_TOWER_ROOM_DEPTH, x = 0 its
 * middle; with the gallery's side of the wall. `kind` chooses how it is furnished.
 */
void scene_tower_room(scene_mesh *m, const scene_office_palette *p, unsigned kind);

#endif
