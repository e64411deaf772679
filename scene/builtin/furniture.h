/* Things that stand about in rooms, drawn with scene_mesh on the floor (y = 0) of the current frame, front +z. */
#ifndef SCENE_BUILTIN_FURNITURE_H
#define SCENE_BUILTIN_FURNITURE_H

#include "scene/builtin/mesh.h"

/** A table with four square legs, 44 triangles. */
void scene_table(scene_mesh *m, double width, double depth, double height);

/** A round table on a turned foot: 25 * sides triangles. */
void scene_round_table(scene_mesh *m, double radius, double height, unsigned sides);

/** A plain chair, its back towards -z: four legs, seat, a board between two posts; 56 triangles. */
void scene_chair(scene_mesh *m);

/** A chair of turned legs, 2 or more back sticks and a bent rail: sides * (56 + 6 * spindles) triangles. */
void scene_spindle_chair(scene_mesh *m, unsigned spindles, unsigned sides);

/** A bar stool: turned leg, foot ring and cushion; 29 * sides + 8 triangles. */
void scene_stool(scene_mesh *m, double height, unsigned sides);

/**
 * A row of books along x from 0 to `width` at most, standing against something, spines +z; 8 triangles a book.
 *
 * @param count   books at most; as many as find room stand there
 * @param shades  `shade_count` materials to choose from
 * Returns the number of books.
 */
unsigned scene_books(scene_mesh *m, double width, double height, double depth, unsigned count, const uint32_t *shades,
    unsigned shade_count);

/* Turned things, by the shape of their outline; the number is triangles per side. */
typedef enum scene_ware {
    SCENE_WARE_BOTTLE,  /* 16 */
    SCENE_WARE_FLASK,   /* 13: a round-bellied bottle */
    SCENE_WARE_GLASS,   /* 7: a tumbler, hollow */
    SCENE_WARE_GOBLET,  /* 15 */
    SCENE_WARE_VASE,    /* 18, hollow */
    SCENE_WARE_BARREL,  /* 26, with hoops */
    SCENE_WARE_POT,     /* 11, a flower pot with earth in it */
    SCENE_WARE_CANDLE,  /* 7 */
    SCENE_WARE_SHADE    /* 6, a lamp shade, seen from outside and inside */
} scene_ware;

/** One of them, its widest radius and its height given. */
void scene_ware_draw(scene_mesh *m, scene_ware ware, double radius, double height, unsigned sides);

/**
 * A bush or a crown: `count` leaves of 4 triangles each (flat closed tetrahedra) about the frame's origin, in an
 * ellipsoid of the given half width and half height, pointing outwards.
 */
void scene_leaves(scene_mesh *m, unsigned count, double half_width, double half_height, double leaf);

/**
 * Pebbles scattered on the floor of [x0, x1] x [z0, z1]: closed double pyramids of 6 to 12 triangles with exactly
 * `triangles` in all, an even number from 6 on. This is what makes a scene's count come out.
 */
void scene_pebbles(scene_mesh *m, size_t triangles, double x0, double z0, double x1, double z1, double size);

/* A hanging cloth, 4 mm thick, both sides drawn: from its upper edge at y = 0 down, facing +z. */
typedef struct scene_cloth {
    double width, drop;    /* [m] */
    double billow;         /* how far the folds stand out */
    double folds;          /* waves across the width */
    double swag;           /* how much the lower edge is drawn up in the middle */
    unsigned across, along; /* cells; 4 * across * along triangles */
} scene_cloth;

void scene_cloth_draw(scene_mesh *m, const scene_cloth *cloth);

/** A wheel lamp hung on a chain from y = 0: rim, `spokes` spokes and as many candles of that material. */
void scene_chandelier(scene_mesh *m, double drop, double radius, unsigned spokes, unsigned sides,
    uint32_t candles);

/** A picture in the plane z = 0: a bevelled frame and the canvas, 18 triangles. */
void scene_picture(scene_mesh *m, double width, double height, uint32_t frame, uint32_t canvas);

#endif
