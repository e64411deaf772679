/* The closed skin of a body made of limbs that melt into each other: smooth unions of tubes about curves [Bloomenthal
 * and Wyvill 1990, "Interactive techniques for implicit modeling"], covered in quads by surface nets [Gibson 1998,
 * "Constrained elastic surface nets"]. */
#ifndef SCENE_BUILTIN_SKIN_H
#define SCENE_BUILTIN_SKIN_H

#include <stddef.h>
#include <stdint.h>

#include "scene/builtin/mesh.h"

/* A point of a limb's centre line and how far the skin lies from it; the line bends smoothly through its joints. */
typedef struct scene_joint {
    scene_point at;
    double radius;
} scene_joint;

/* A place near a limb, for its relief. */
typedef struct scene_skin_place {
    scene_point at;
    double along;  /* distance along the centre line from its first joint [m] */
    double share;  /* the same from 0 to 1 */
    double radius; /* of the limb here */
    scene_point out; /* unit vector away from the centre line */
} scene_skin_place;

typedef struct scene_limb {
    const scene_joint *joints; /* borrowed */
    size_t count;              /* at least 2 */
    double width;              /* of a section along z, over its height; 1 is round */
    double blend;              /* over what distance it melts into the limbs before it, above 0 [m] */
    int carved;                /* taken away instead of added */
    double (*relief)(const scene_skin_place *place); /* how far the skin stands out here, or NULL [m] */
    double relief_most;        /* the largest that it returns, either sign; 0 without one */
} scene_limb;

/**
 * Draw the skin of `count` limbs in quads about `cell` wide, seen from outside.
 *
 * @param shade  the material at a point of the skin, `user` passed through; NULL keeps the mesh's current one
 *
 * What is drawn is closed and has no triangle thinner than a few hundredths of a cell. Memory: a block of cells at a time.
 */
void scene_skin_draw(scene_mesh *m, const scene_limb *limbs, size_t count, double cell,
    uint32_t (*shade)(const void *user, scene_point at), const void *user);

/** A point of a limb's centre line and its radius there; `at` counts joints from 0 to count - 1. */
scene_joint scene_limb_point(const scene_limb *limb, double at);

/** A pseudo-angle of a direction about x in [0, 4): 0 towards +y, 1 towards +z; equal on every host. */
double scene_skin_around(scene_point out);

#endif
