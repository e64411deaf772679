/* Parts of buildings, drawn with scene_mesh: walls with openings, arches, vaults, columns, stairs, floors.
 * Each is drawn in the mesh's current frame with its current material unless it takes materials. */
#ifndef SCENE_BUILTIN_ARCHITECTURE_H
#define SCENE_BUILTIN_ARCHITECTURE_H

#include "scene/builtin/mesh.h"

/* A rectangular hole in a wall, in the wall's x and y. */
typedef struct scene_opening {
    double x0, x1, y0, y1;
} scene_opening;

/**
 * A wall in the plane z = 0, front towards +z, from (x0, y0) to (x1, y1), around one opening. A side of the opening
 * on the wall's own edge costs nothing: a door without a sill has 6 triangles, a window 8.
 */
void scene_wall(scene_mesh *m, double x0, double y0, double x1, double y1, scene_opening hole);

/** The inside of an opening, from z = 0 back to z = -depth; 2 triangles for each of `faces` (SCENE_FACE_...). */
void scene_reveal(scene_mesh *m, scene_opening hole, double depth, unsigned faces);

/* An arch in a wall of thickness 2 * half about the plane z = 0, opening towards z. */
typedef struct scene_arch {
    double span;   /* half the opening's width */
    double rise;   /* height of the crown above the springing; equal to span for a round arch */
    double spring; /* height of the springing */
    double half;   /* half the wall's thickness */
    unsigned steps; /* pieces of the curve */
} scene_arch;

/** The arch's curved underside: 2 * steps. */
void scene_arch_soffit(scene_mesh *m, const scene_arch *a);

/** Front and back of the wall above the opening up to height `top`, as wide as `reach` to each side: 4 * steps + 8. */
void scene_arch_spandrel(scene_mesh *m, const scene_arch *a, double reach, double top);

/**
 * A raised band around the opening on the side z = half (of that wall's front only): face, outer edge; 4 * steps.
 *
 * @param width, proud  its width, and by how much it stands out of the wall; its inner edge is the soffit's, drawn that
 *                      much wider
 */
void scene_arch_band(scene_mesh *m, const scene_arch *a, double width, double proud);

/** Front and back between the opening and a wider arch of half-width `span` and rise `rise`: 4 * steps. */
void scene_arch_ring(scene_mesh *m, const scene_arch *a, double span, double rise);

/**
 * Two crossing tunnels over the rectangle [-half_x, half_x] x [-half_z, half_z], seen from below, springing at y = 0.
 * 4 * (2 * steps * rows - 2 * rows) triangles: the creases are edges of the mesh.
 */
void scene_groin_vault(scene_mesh *m, double half_x, double half_z, double rise, unsigned steps, unsigned rows);

/** A tunnel along z from z0 to z1, seen from below: 2 * steps * rows. */
void scene_barrel_vault(scene_mesh *m, double half_x, double rise, double z0, double z1, unsigned steps, unsigned rows);

/* A column with an attic base, a swelling shaft and a leafless capital between a square plinth and an abacus. */
typedef struct scene_column {
    double height; /* from the floor to the top of the abacus */
    double radius; /* of the shaft's foot */
    unsigned sides;
    unsigned shaft_steps; /* pieces of the shaft's length, for the swelling */
} scene_column;

/** A column on the floor of the current frame: 20 + 2 * sides * (15 + shaft_steps). */
void scene_column_draw(scene_mesh *m, const scene_column *c);

/**
 * A balustrade along x from x0 to x1 on the floor: turned balusters between a kerb and a hand rail, no end posts.
 *
 * @param height    top of the rail
 * @param count     balusters, evenly spread
 * @param sides     of each baluster, which has 14 * sides triangles; kerb and rail have 28 together
 */
void scene_balustrade(scene_mesh *m, double x0, double x1, double height, unsigned count, unsigned sides);

/** Straight stairs rising towards -z from z = 0: solid steps with a 25 mm nosing, 20 triangles each, 16 the first. */
void scene_stairs(scene_mesh *m, double width, double rise, double tread, unsigned steps);

/**
 * A floor of boards along x, whose tops lie at y = 0, 2 to 4 mm apart, cut to random lengths; 10 triangles a board.
 *
 * @param breadth  of a board; the last row is cut to fit
 * @param shades   `shade_count` materials to choose from
 */
void scene_planks(scene_mesh *m, double x0, double z0, double x1, double z1, double breadth, double mean_length,
    const uint32_t *shades, unsigned shade_count);

/** Square slabs with open joints, tops near y = 0: 10 triangles each. Colours as for scene_planks. */
void scene_slabs(scene_mesh *m, double x0, double z0, unsigned across, unsigned along, double size,
    const uint32_t *shades, unsigned shade_count);

/** One row of half-round roof tiles running down +z and -y: `count` tiles of 2 * sides + (sides - 1) triangles. */
void scene_roof_tiles(scene_mesh *m, double radius, double length, unsigned count, unsigned sides);

/** The visible side of a door leaf in its frame, front +z at z = 0.04: two raised panels on it, 22 triangles. */
void scene_panel_door(scene_mesh *m, double width, double height);

/** Window bars: a frame and `across` x `along` panes' glazing bars in the plane z = 0; no glass. 8 a bar. */
void scene_window_bars(scene_mesh *m, scene_opening hole, unsigned across, unsigned along, double bar);

#endif
