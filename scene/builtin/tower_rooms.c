#include "scene/builtin/tower_rooms.h"

#include "scene/builtin/furniture.h"

#define W (SCENE_TOWER_ROOM_WIDTH / 2)
#define D SCENE_TOWER_ROOM_DEPTH
#define H SCENE_TOWER_ROOM_HEIGHT
#define SIDE (W - 0.06) /* the side walls: rooms do not share them */
#define TOP 0.741 /* of a desk */

enum { FINE = 1 };

static const scene_opening door = {-1.70, -0.80, 0, 2.10}, pane = {0.0, 1.6, 0.95, 2.10}, light = {-1.5, 1.5, 0.90, 2.60};

/* The wall with the door and an inner window, from both sides; the door leaf stands open into the room. */
static void inner_wall(scene_mesh *m, const scene_office_palette *p)
{
    unsigned around = SCENE_FACE_LEFT | SCENE_FACE_RIGHT | SCENE_FACE_TOP | SCENE_FACE_BOTTOM;
    scene_frame before = m->frame;
    m->material = p->wall;
    scene_wall(m, -W, 0, -0.4, H, door);
    scene_wall(m, -0.4, 0, W, H, pane);
    scene_mesh_enter(m, 0, 0, -SCENE_TOWER_WALL, 0.5); /* mirrored */
    scene_wall(m, 0.4, 0, W, H, (scene_opening){-door.x1, -door.x0, door.y0, door.y1});
    scene_wall(m, -W, 0, 0.4, H, (scene_opening){-pane.x1, -pane.x0, pane.y0, pane.y1});
    m->material = p->paper[2];
    scene_mesh_box(m, scene_at(0.45, 1.5, 0), scene_at(0.70, 1.6, 0.008), SCENE_FACES_NO_BACK);
    m->frame = before;
    m->material = p->trim;
    scene_reveal(m, door, SCENE_TOWER_WALL, around);
    scene_reveal(m, pane, SCENE_TOWER_WALL, around);
    scene_mesh_enter(m, 0, 0, -SCENE_TOWER_WALL / 2, 0);
    scene_window_bars(m, pane, 3, 2, 0.04);
    m->frame = before;
    double open = scene_mesh_random(m, 0.14, 0.30);
    scene_mesh_enter(m, door.x0 + 0.02, 0, 0.03, -open);
    m->material = p->wood[1];
    scene_mesh_box(m, scene_at(0, 0.01, -0.02), scene_at(0.86, 2.08, 0.02), SCENE_FACES_ALL);
    m->material = p->steel;
    for (int side = -1; side < 2; side += 2)
        scene_mesh_beam(m, scene_at(0.70, 1.05, 0.05 * side), scene_at(0.82, 1.05, 0.05 * side), 0.015, 0.015, 1);
    m->frame = before;
}

static void outer_wall(scene_mesh *m, const scene_office_palette *p)
{
    scene_frame before = scene_mesh_enter(m, 0, 0, D, 0.5), wall = m->frame;
    m->material = p->wall;
    scene_wall(m, -W, 0, W, H, light);
    m->material = p->trim;
    scene_reveal(m, light, 0.25, SCENE_FACE_LEFT | SCENE_FACE_RIGHT | SCENE_FACE_TOP | SCENE_FACE_BOTTOM);
    m->material = p->glass;
    scene_reveal(m, light, 0.25, SCENE_FACE_BACK);
    m->material = p->trim;
    scene_mesh_enter(m, 0, 0, -0.2, 0);
    scene_window_bars(m, light, 3, 2, 0.05);
    m->frame = wall;
    scene_mesh_enter(m, 0, 0, -0.1, 0);
    double drawn = scene_mesh_random(m, 0.0, 1.3);
    scene_blind(m, p, (scene_opening){light.x0, light.x1, light.y0 + drawn, light.y1}, 0.036);
    m->frame = wall;
    scene_mesh_enter(m, -0.8, 0, 0, 0);
    scene_radiator(m, p, 1.6, 20, 1);
    m->frame = before;
}

static void shell(scene_mesh *m, const scene_office_palette *p)
{
    m->material = p->wall;
    scene_mesh_room(m, scene_at(-SIDE, 0, 0), scene_at(SIDE, H, D), SCENE_FACE_LEFT | SCENE_FACE_RIGHT);
    m->material = p->ceiling;
    scene_mesh_ceiling(m, -W, 0, W, D, H);
    m->material = p->carpet[2];
    scene_mesh_floor(m, -W, 0, W, D, -0.012);
    scene_slabs(m, -W, 0, 8, 11, 0.5, p->carpet, 3);
    inner_wall(m, p);
    outer_wall(m, p);
    for (int i = 0; i < 2; i++) {
        scene_frame before = scene_mesh_enter(m, 0, H, 1.7 + 2.4 * i, 0.25);
        scene_ceiling_lamp(m, p, 1.2, 24, 1);
        m->frame = before;
    }
}

/* A desk against the wall behind it, with its chair and what lies on it. */
static void work_place(scene_mesh *m, const scene_office_palette *p, double x, double z, double turns)
{
    double jitter = scene_mesh_random(m, -0.12, 0.12), back = scene_mesh_random(m, 0.55, 0.8), cloth = scene_mesh_random(m, 0, 3);
    double sheets = scene_mesh_random(m, 2, 12);
    scene_frame before = scene_mesh_enter(m, x, 0, z, turns), desk = m->frame;
    scene_desk(m, p, 1.5, 0.75);
    scene_mesh_enter(m, 0.05 + 0.5 * jitter, TOP, -0.15, 0.2 * jitter);
    scene_computer(m, p, FINE);
    m->frame = desk;
    scene_mesh_enter(m, -0.58, TOP, -0.20, jitter);
    scene_desk_lamp(m, p, FINE);
    m->frame = desk;
    scene_mesh_enter(m, 0.60, TOP, -0.10, jitter);
    scene_telephone(m, p, FINE);
    m->frame = desk;
    scene_mesh_enter(m, -0.45, TOP, 0.16, 0.5 * jitter);
    scene_papers(m, p, (unsigned)sheets);
    m->frame = desk;
    scene_mesh_enter(m, 0.52, TOP, 0.22, jitter);
    scene_cup(m, p, FINE);
    m->frame = desk;
    scene_mesh_enter(m, jitter, 0, back, 0.5 + jitter);
    scene_swivel_chair(m, p, (unsigned)cloth, jitter > 0, FINE);
    m->frame = before;
}

static void shelf_at(scene_mesh *m, const scene_office_palette *p, double x, double z, double turns)
{
    scene_frame before = scene_mesh_enter(m, x, 0, z, turns);
    scene_book_shelf(m, p, 1.2, 6, 34);
    m->frame = before;
}

static void basket_and_plant(scene_mesh *m, const scene_office_palette *p, double x, double z)
{
    double height = scene_mesh_random(m, 0.8, 1.5);
    scene_frame before = scene_mesh_enter(m, x, 0, z, 0);
    scene_pot_plant(m, p, height, 60, FINE);
    scene_mesh_enter(m, 0, 0, -0.45, 0);
    scene_waste_basket(m, p, FINE);
    m->frame = before;
}

static void board_on_right(scene_mesh *m, const scene_office_palette *p, double z, unsigned papers)
{
    scene_frame before = scene_mesh_enter(m, SIDE, 1.6, z, 0.75);
    scene_pin_board(m, p, 1.6, 1.0, papers);
    m->frame = before;
}

static void office(scene_mesh *m, const scene_office_palette *p)
{
    work_place(m, p, -SIDE + 0.40, 3.9, 0.25);
    work_place(m, p, SIDE - 0.40, 3.9, 0.75);
    shelf_at(m, p, SIDE - 0.002, 0.9, 0.75);
    shelf_at(m, p, SIDE - 0.002, 2.2, 0.75);
    scene_frame before = scene_mesh_enter(m, -SIDE + 0.002, 0, 2.6, 0.25);
    scene_file_cabinet(m, p);
    m->frame = before;
    basket_and_plant(m, p, -SIDE + 0.3, 5.4);
}

static void laboratory(scene_mesh *m, const scene_office_palette *p)
{
    for (int i = 0; i < 2; i++) {
        work_place(m, p, -SIDE + 0.40, 2.6 + 1.7 * i, 0.25);
        work_place(m, p, SIDE - 0.40, 1.6 + 1.7 * i, 0.75);
    }
    board_on_right(m, p, 2.4, 9);
    basket_and_plant(m, p, SIDE - 0.3, 5.4);
}

static void meeting_room(scene_mesh *m, const scene_office_palette *p)
{
    scene_frame before = scene_mesh_enter(m, 0.1, 0, 3.2, 0);
    m->material = p->wood[1];
    scene_table(m, 1.3, 2.8, 0.74);
    for (int i = 0; i < 8; i++) {
        double z = -1.05 + 0.7 * (i / 2), jitter = scene_mesh_random(m, -0.03, 0.03);
        scene_frame table = scene_mesh_enter(m, i & 1 ? 0.95 : -0.95, 0, z, (i & 1 ? 0.75 : 0.25) + jitter);
        scene_swivel_chair(m, p, 1, 1, FINE);
        scene_mesh_enter(m, 0, TOP, 0.55, jitter);
        scene_papers(m, p, 4);
        scene_mesh_enter(m, 0.2, 0, 0, jitter);
        scene_cup(m, p, FINE);
        m->frame = table;
    }
    m->frame = before;
    board_on_right(m, p, 3.0, 14);
    shelf_at(m, p, -SIDE + 0.002, 3.4, 0.25);
    basket_and_plant(m, p, -SIDE + 0.35, 5.4);
}

static void library(scene_mesh *m, const scene_office_palette *p)
{
    for (int i = 0; i < 3; i++) {
        shelf_at(m, p, SIDE - 0.002, 1.0 + 1.3 * i, 0.75);
        shelf_at(m, p, -SIDE + 0.002, 2.2 + 1.25 * i, 0.25);
    }
    scene_frame before = scene_mesh_enter(m, 0, 0, 3.2, 0);
    m->material = p->wood[0];
    scene_round_table(m, 0.5, 0.72, 16);
    for (int i = 0; i < 3; i++) {
        scene_frame table = scene_mesh_enter(m, 0, 0, 0, i / 3.0 + 0.05);
        scene_mesh_enter(m, 0, 0, -0.95, 0);
        scene_armchair(m, p, 2, 0.80, FINE);
        m->frame = table;
    }
    m->frame = before;
    basket_and_plant(m, p, SIDE - 0.4, 5.3);
}

void scene_tower_room(scene_mesh *m, const scene_office_palette *p, unsigned kind)
{
    static void (*const furnish[])(scene_mesh *, const scene_office_palette *) = {office, laboratory, meeting_room, library,
        office};
    shell(m, p);
    furnish[kind % 5](m, p);
}
