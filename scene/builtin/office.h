/* What stands and hangs about in offices, drawn with scene_mesh on the floor (y = 0) of the current frame, front +z. `fine`
 * scales the number of triangles of everything round: 1 is coarse, 4 smooth. */
#ifndef SCENE_BUILTIN_OFFICE_H
#define SCENE_BUILTIN_OFFICE_H

#include "scene/builtin/architecture.h"
#include "scene/builtin/mesh.h"

typedef struct scene_office_palette {
    uint32_t wall, trim, carpet[3], ceiling, lamp, wood[2], cloth[3], steel, black, plastic, screen, paper[3], glass,
        leaf[2], pot,
        book[5], board, pen;
} scene_office_palette;

scene_office_palette scene_office_paint(scene_mesh *m);

/** A cushion: a box with all edges rounded, closed, about the origin; 2 * across * (along - 1) triangles. */
void scene_cushion(scene_mesh *m, double width, double height, double depth, unsigned across, unsigned along);

/** A swivel chair on five castors, with arm rests or without. */
void scene_swivel_chair(scene_mesh *m, const scene_office_palette *p, unsigned cloth, int arms, unsigned fine);

/** An upholstered armchair, or with a larger `width` a sofa. */
void scene_armchair(scene_mesh *m, const scene_office_palette *p, unsigned cloth, double width, unsigned fine);

/** A desk of 0.74 m with drawers on its right; the chair's side is +z. */
void scene_desk(scene_mesh *m, const scene_office_palette *p, double width, double depth);

/** On a desk top: a screen with its foot, a keyboard of 84 keys, a mouse; facing +z. */
void scene_computer(scene_mesh *m, const scene_office_palette *p, unsigned fine);

/** On a desk top: a lamp with a jointed arm. */
void scene_desk_lamp(scene_mesh *m, const scene_office_palette *p, unsigned fine);

/** On a desk top: a telephone with its keys and receiver. */
void scene_telephone(scene_mesh *m, const scene_office_palette *p, unsigned fine);

/** On a table top: a sheaf of `sheets` papers, not quite aligned, with a pen on it. */
void scene_papers(scene_mesh *m, const scene_office_palette *p, unsigned sheets);

/** On a table top: a cup with its handle on a saucer. */
void scene_cup(scene_mesh *m, const scene_office_palette *p, unsigned fine);

/** A shelf of `rows` boards full of books, its back at z = 0. */
void scene_book_shelf(scene_mesh *m, const scene_office_palette *p, double width, unsigned rows, unsigned books);

/** A cabinet of four drawers. */
void scene_file_cabinet(scene_mesh *m, const scene_office_palette *p);

/** A waste basket of wire hoops and bars. */
void scene_waste_basket(scene_mesh *m, const scene_office_palette *p, unsigned fine);

/** A plant with `leaves` leaves in a pot. */
void scene_pot_plant(scene_mesh *m, const scene_office_palette *p, double height, unsigned leaves, unsigned fine);

/** Hanging from y = 0: a lamp of two tubes under a white box with `louvres` cross blades. */
void scene_ceiling_lamp(scene_mesh *m, const scene_office_palette *p, double length, unsigned louvres, unsigned fine);

/** Hanging before an opening in the plane z = 0: slats, half closed, 12 triangles each, and their cords. */
void scene_blind(scene_mesh *m, const scene_office_palette *p, scene_opening hole, double pitch);

/** A radiator of upright ribs along x from 0 to `width`. */
void scene_radiator(scene_mesh *m, const scene_office_palette *p, double width, unsigned ribs, unsigned fine);

/** A board on a wall (z = 0) with papers pinned on. */
void scene_pin_board(scene_mesh *m, const scene_office_palette *p, double width, double height, unsigned papers);

#endif
