/* Things that grow, drawn with scene_mesh on the ground (y = 0) of the current frame; every leaf is a closed shape. */
#ifndef SCENE_BUILTIN_PLANTS_H
#define SCENE_BUILTIN_PLANTS_H

#include "scene/builtin/mesh.h"

/* A leaf: where it grows, which way it points and which way its upper side faces (both unit, at right angles). */
typedef struct scene_leaf {
    scene_point at, along, up;
    double length, width, droop; /* its tip hangs that share of its length below the plane */
} scene_leaf;

/** A flat leaf of 4 triangles, or with `ribbed` one of 8 with a thick middle. */
void scene_leaf_draw(scene_mesh *m, const scene_leaf *leaf, int ribbed);

/* A frond of a fern: it rises from the origin and arches over towards +z, leaflets in pairs on stalks in pairs. */
typedef struct scene_frond {
    double length, rise;     /* of the stem, and its share that goes up before it hangs over, 0.5 to 1.2 */
    unsigned pairs;          /* of side stalks, at least 3 */
    unsigned leaflets;       /* pairs on the longest stalk; shorter ones carry fewer */
    double breadth;          /* length of the longest stalk, as a share of `length` */
    int ribbed;
} scene_frond;

void scene_frond_draw(scene_mesh *m, const scene_frond *f);

/** A young frond rolled up: a closed snail of a pipe, 2 * sides * 40 triangles and its two ends. */
void scene_fiddlehead(scene_mesh *m, double height, unsigned sides);

/* A broad-leaved tree: trunk, roots and branches are one closed skin, leaves stand in crowns at the branches' ends. */
typedef struct scene_tree {
    double height, radius; /* of the trunk up to the branches, and of its foot */
    unsigned branches;     /* at most 7; as many roots */
    double cell;           /* of the skin */
    unsigned leaves;       /* in each crown */
    double leaf;           /* length of a leaf */
    uint32_t bark, green[2];
} scene_tree;

void scene_tree_draw(scene_mesh *m, const scene_tree *tree);

/** A toadstool with gills' edge, ring and spots: sides * 25 + 160 triangles. */
void scene_toadstool(scene_mesh *m, double height, double radius, unsigned sides, uint32_t stem, uint32_t cap);

/** Blades of grass, 4 triangles each, scattered over [x0, x1] x [z0, z1]. */
void scene_grass(scene_mesh *m, unsigned count, double x0, double z0, double x1, double z1, double height);

#endif
