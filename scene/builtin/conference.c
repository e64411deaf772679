/* A conference room of 12 by 9 m: an oval table with twenty chairs, armchairs along the walls, blinds, louvred lamps and all that
 * lies about. The room's middle is the origin, its windows lie in the wall z = -4.5, its door in x = 6. */
#include "scene/builtin/furniture.h"
#include "scene/builtin/office.h"
#include "scene/builtin/scenes.h"

#define COUNT_OF(a) (sizeof(a) / sizeof *(a))
#define HALF_X 6.0
#define HALF_Z 4.5
#define HEIGHT 3.0
#define TABLE_X 3.5 /* half the table's length */
#define TABLE_Z 1.05
#define TOP 0.745

static const scene_opening windows[3] = {{-4.9, -2.3, 0.85, 2.55}, {-1.3, 1.3, 0.85, 2.55}, {2.3, 4.9, 0.85, 2.55}};

/* A wall of the current frame with wooden panels up to a rail, between `gap0` and `gap1` none. */
static void panels(scene_mesh *m, const scene_office_palette *p, double half, double gap0, double gap1)
{
    static const scene_profile rail[] = {{0, 0.92}, {0.025, 0.93}, {0.035, 0.96}, {0.035, 0.985}, {0, 1.0}};
    static const scene_profile skirting[] = {{0.022, 0}, {0.022, 0.09}, {0.012, 0.11}, {0, 0.115}};
    unsigned count = (unsigned)(2 * half / 0.6);
    for (unsigned i = 0; i < count; i++) {
        double x0 = -half + 2 * half * i / count, x1 = -half + 2 * half * (i + 1) / count;
        if (x1 > gap0 && x0 < gap1)
            continue;
        m->material = p->wood[i % 2];
        scene_mesh_box(m, scene_at(x0 + 0.01, 0.115, 0), scene_at(x1 - 0.01, 0.92, 0.012), SCENE_FACES_NO_BACK);
        scene_mesh_box(m, scene_at(x0 + 0.08, 0.20, 0.012), scene_at(x1 - 0.08, 0.84, 0.022), SCENE_FACES_NO_BACK);
    }
    m->material = p->wood[0];
    for (int side = 0; side < 2; side++) {
        double x0 = side ? gap1 : -half, x1 = side ? half : gap0;
        if (x1 - x0 > 0.1) {
            scene_mesh_moulding(m, rail, COUNT_OF(rail), x0, x1, 0, 0);
            scene_mesh_moulding(m, skirting, COUNT_OF(skirting), x0, x1, 0, 0);
        }
    }
}

static void window_wall(scene_mesh *m, const scene_office_palette *p)
{
    static const double edge[4] = {-HALF_X, -1.8, 1.8, HALF_X};
    for (int i = 0; i < 3; i++) {
        scene_opening w = windows[i];
        m->material = p->wall;
        scene_wall(m, edge[i], 0, edge[i + 1], HEIGHT, w);
        m->material = p->trim;
        scene_reveal(m, w, 0.25, SCENE_FACE_LEFT | SCENE_FACE_RIGHT | SCENE_FACE_TOP | SCENE_FACE_BOTTOM);
        scene_mesh_box(m, scene_at(w.x0 - 0.05, w.y0 - 0.04, -0.02), scene_at(w.x1 + 0.05, w.y0, 0.14), SCENE_FACES_NO_BACK);
        scene_frame before = scene_mesh_enter(m, 0, 0, -0.20, 0);
        scene_window_bars(m, w, 3, 2, 0.05);
        m->frame = before;
        m->material = p->glass;
        scene_reveal(m, w, 0.25, SCENE_FACE_BACK);
        scene_mesh_enter(m, 0, 0, -0.08, 0);
        scene_blind(m, p, w, 0.030);
        m->frame = before;
        scene_mesh_enter(m, w.x0 + 0.25, 0, 0, 0);
        scene_radiator(m, p, 2.1, 30, 5);
        m->frame = before;
    }
}

static void walls(scene_mesh *m, const scene_office_palette *p)
{
    scene_frame world = scene_mesh_enter(m, 0, 0, -HALF_Z, 0);
    window_wall(m, p);
    m->frame = world;
    scene_mesh_enter(m, 0, 0, HALF_Z, 0.5);
    m->material = p->wall;
    scene_mesh_quad(m, scene_at(-HALF_X, 0, 0), scene_at(HALF_X, 0, 0), scene_at(HALF_X, HEIGHT, 0), scene_at(-HALF_X,
        HEIGHT, 0));
    panels(m, p, HALF_X, HALF_X, HALF_X);
    m->frame = world;
    scene_mesh_enter(m, -HALF_X, 0, 0, 0.25);
    m->material = p->wall;
    scene_mesh_quad(m, scene_at(-HALF_Z, 0, 0), scene_at(HALF_Z, 0, 0), scene_at(HALF_Z, HEIGHT, 0), scene_at(-HALF_Z,
        HEIGHT, 0));
    panels(m, p, HALF_Z, HALF_Z, HALF_Z);
    m->frame = world;
    const scene_opening door = {1.6, 2.6, 0, 2.1};
    scene_mesh_enter(m, HALF_X, 0, 0, 0.75);
    m->material = p->wall;
    scene_wall(m, -HALF_Z, 0, HALF_Z, HEIGHT, door);
    panels(m, p, HALF_Z, 1.5, 2.7);
    m->material = p->wood[0];
    scene_reveal(m, door, 0.15, SCENE_FACE_LEFT | SCENE_FACE_RIGHT | SCENE_FACE_TOP);
    scene_mesh_enter(m, 2.1, 0, -0.15, 0);
    scene_panel_door(m, 1.0, 2.1);
    m->frame = world;
}

/* Carpet tiles; a ceiling of tiles in a grid of bars; lamps in rows. */
static void floor_and_ceiling(scene_mesh *m, const scene_office_palette *p)
{
    scene_slabs(m, -HALF_X, -HALF_Z, 24, 18, 0.5, p->carpet, 3);
    m->material = p->carpet[2];
    scene_mesh_floor(m, -HALF_X, -HALF_Z, HALF_X, HALF_Z, -0.012);
    m->material = p->ceiling;
    scene_mesh_ceiling(m, -HALF_X, -HALF_Z, HALF_X, HALF_Z, HEIGHT);
    m->material = p->trim;
    for (int i = 1; i < 20; i++) {
        double x = -HALF_X + 0.6 * i;
        scene_mesh_box(m, scene_at(x - 0.012, HEIGHT - 0.015, -HALF_Z), scene_at(x + 0.012, HEIGHT, HALF_Z), SCENE_FACES_HANGING);
    }
    for (int i = 1; i < 15; i++) {
        double z = -HALF_Z + 0.6 * i;
        scene_mesh_box(m, scene_at(-HALF_X, HEIGHT - 0.013, z - 0.012), scene_at(HALF_X, HEIGHT, z + 0.012), SCENE_FACES_HANGING);
    }
    for (int i = 0; i < 20; i++) {
        scene_frame before = scene_mesh_enter(m, -4.5 + 2.25 * (i % 5), HEIGHT - 0.016, -3.0 + 2.0 * (i / 5), 0);
        scene_ceiling_lamp(m, p, 1.18, 30, 5);
        m->frame = before;
    }
}

static void table(scene_mesh *m, const scene_office_palette *p)
{
    /* an oval: what is turned is stretched along x */
    static const scene_profile top[] = {{0, TOP - 0.045}, {0.95, TOP - 0.045}, {0.985, TOP - 0.035}, {1.0, TOP - 0.018},
        {0.992, TOP - 0.005}, {0.975, TOP}, {0.70, TOP}, {0, TOP}};
    static const scene_profile foot[] = {{0.34, 0}, {0.34, 0.05}, {0.30, 0.08}, {0.22, 0.35}, {0.26, TOP - 0.045}};
    scene_frame before = m->frame;
    m->frame.x = scene_point_scale(before.x, TABLE_X);
    m->frame.z = scene_point_scale(before.z, TABLE_Z);
    m->material = p->wood[0];
    scene_mesh_lathe(m, top, COUNT_OF(top), 160);
    for (int i = -1; i < 2; i++) {
        m->frame = before;
        scene_mesh_enter(m, 2.0 * i, 0, 0, 0);
        m->material = p->wood[1];
        scene_mesh_lathe(m, foot, COUNT_OF(foot), 48);
    }
    m->frame = before;
}

/* One of the twenty places about the table: chair, papers, cup, glass, some with a telephone or a lamp. */
static void seat(scene_mesh *m, const scene_office_palette *p, int i)
{
    double c, s, jitter = scene_mesh_random(m, -0.02, 0.02), back = scene_mesh_random(m, 0.30, 0.42);
    double along = (i % 10 - 4.5) / 5.0; /* nine tenths of each long side */
    int far = i / 10;
    scene_direction(0.25 - 0.25 * along, &c, &s);
    double x = 3.3 * along, edge = TABLE_Z * sqrt(1.0 - (x / TABLE_X) * (x / TABLE_X)), lean = 0.06 * along * along * along;
    scene_frame before = scene_mesh_enter(m, x, 0, far ? -edge : edge, (far ? 0.0 : 0.5) + (far ? -lean : lean));
    scene_frame here = scene_mesh_enter(m, 0, 0, -back, jitter);
    scene_swivel_chair(m, p, far ? 0 : 1, 1, 5);
    m->frame = here;
    scene_mesh_enter(m, 0.0, TOP + 0.001, 0.24, 0);
    scene_papers(m, p, 6 + (unsigned)(i % 4) * 4);
    m->frame = here;
    scene_mesh_enter(m, 0.19, TOP + 0.001, 0.22, jitter * 5);
    scene_cup(m, p, 5);
    m->frame = here;
    scene_mesh_enter(m, -0.18, TOP + 0.001, 0.26, 0);
    m->material = p->glass;
    scene_ware_draw(m, SCENE_WARE_GLASS, 0.032, 0.11, 24);
    m->frame = before;
}

static void table_middle(scene_mesh *m, const scene_office_palette *p)
{
    scene_frame world = m->frame;
    for (int i = 0; i < 7; i++) {
        scene_mesh_enter(m, -2.4 + 0.8 * i, TOP + 0.001, 0.05 * (i % 2), 0.3 * i);
        if (i == 3) {
            scene_telephone(m, p, 5);
        } else {
            m->material = i % 2 ? p->leaf[0] : p->glass;
            scene_ware_draw(m, SCENE_WARE_BOTTLE, 0.036, 0.27, 28);
            scene_mesh_enter(m, 0.10, 0, 0.03, 0);
            m->material = i % 2 ? p->glass : p->leaf[1];
            scene_ware_draw(m, SCENE_WARE_FLASK, 0.045, 0.24, 28);
        }
        m->frame = world;
    }
}

/* A round table with four chairs by the shelves. */
static void corner_table(scene_mesh *m, const scene_office_palette *p)
{
    scene_frame world = scene_mesh_enter(m, 0.9, 0, 2.75, 0.05);
    scene_frame here = m->frame;
    m->material = p->wood[1];
    scene_round_table(m, 0.55, 0.72, 64);
    for (int i = 0; i < 4; i++) {
        double jitter = scene_mesh_random(m, -0.05, 0.05);
        scene_mesh_enter(m, 0, 0, 0, 0.25 * i + jitter);
        scene_mesh_enter(m, 0, 0, -0.75, 0);
        scene_swivel_chair(m, p, 2, 1, 5);
        scene_mesh_enter(m, 0, 0.722, 0.40, jitter);
        scene_cup(m, p, 5);
        m->frame = here;
    }
    m->frame = world;
}

/* The screen on the left wall, a lectern with a computer, shelves, a pin board, armchairs, plants. */
static void along_the_walls(scene_mesh *m, const scene_office_palette *p)
{
    scene_frame world = scene_mesh_enter(m, -HALF_X + 0.03, 1.75, 0, 0.25);
    scene_picture(m, 3.4, 1.9, p->steel, p->paper[0]);
    m->frame = world;
    scene_mesh_enter(m, -5.0, 0, 2.9, 0.20);
    scene_desk(m, p, 1.5, 0.8);
    scene_mesh_enter(m, 0, 0.74, -0.12, 0);
    scene_computer(m, p, 5);
    scene_mesh_enter(m, -0.55, 0, 0.05, 0.1);
    scene_desk_lamp(m, p, 6);
    m->frame = world;
    for (int i = 0; i < 3; i++) {
        scene_mesh_enter(m, 1.4 + 1.25 * i, 0, HALF_Z - 0.04, 0.5);
        scene_book_shelf(m, p, 1.2, 6, 40);
        m->frame = world;
    }
    scene_mesh_enter(m, -2.6, 1.75, HALF_Z - 0.02, 0.5);
    scene_pin_board(m, p, 2.6, 1.2, 18);
    m->frame = world;
    for (int i = 0; i < 5; i++) {
        int right = i >= 3;
        scene_mesh_enter(m, right ? HALF_X - 0.6 : -3.6 + 1.0 * i, 0, right ? i - 3.2 : HALF_Z - 0.55, right ? 0.75 : 0.5);
        scene_armchair(m, p, 2, 0.86, 5);
        m->frame = world;
    }
    for (int i = 0; i < 4; i++) {
        scene_mesh_enter(m, i & 1 ? 5.45 : -5.4, 0, i & 2 ? 4.0 : -3.9, 0.2 * i);
        scene_pot_plant(m, p, 1.5, 150, 6);
        m->frame = world;
    }
    for (int i = 0; i < 2; i++) {
        scene_mesh_enter(m, i ? 5.6 : -5.5, 0, i ? 2.9 : 1.6, 0);
        scene_waste_basket(m, p, 5);
        m->frame = world;
    }
    scene_mesh_enter(m, HALF_X - 0.03, 1.85, 0.1, 0.75);
    scene_picture(m, 1.8, 1.1, p->wood[0], p->paper[2]);
    m->frame = world;
}

/* A trough of plants on clay pebbles before the middle window: takes what the count leaves over. */
static void trough(scene_mesh *m, const scene_office_palette *p)
{
    scene_frame world = scene_mesh_enter(m, 0, 0, -HALF_Z + 0.42, 0);
    m->material = p->pot;
    scene_mesh_box(m, scene_at(-1.5, 0, -0.17), scene_at(1.5, 0.48, 0.17), SCENE_FACES_AROUND);
    scene_mesh_room(m, scene_at(-1.47, 0.40, -0.14), scene_at(1.47, 0.48, 0.14), SCENE_FACES_AROUND | SCENE_FACE_BOTTOM);
    for (int side = -1; side < 2; side += 2) {
        scene_mesh_box(m, scene_at(-1.5, 0.478, side * 0.155 - 0.015), scene_at(1.5, 0.482, side * 0.155 + 0.015),
            SCENE_FACES_ALL);
        scene_mesh_box(m, scene_at(side * 1.485 - 0.015, 0.478, -0.14), scene_at(side * 1.485 + 0.015, 0.482, 0.14),
            SCENE_FACES_ALL);
    }
    for (int i = 0; i < 8; i++) {
        scene_frame here = scene_mesh_enter(m, -1.3 + 0.37 * i, 0.62, 0, 0.1 * i);
        m->material = p->leaf[i % 2];
        scene_leaves(m, 60, 0.20, 0.22, 0.20);
        m->frame = here;
    }
    scene_mesh_enter(m, 0, 0.405, 0, 0);
    m->material = p->pot;
    if (m->target->triangle_count < SCENE_CONFERENCE_TRIANGLES)
        scene_pebbles(m, SCENE_CONFERENCE_TRIANGLES - m->target->triangle_count, -1.45, -0.12, 1.45, 0.12, 0.016);
    m->frame = world;
}

base_status scene_build_conference(scene *s, base_error *err)
{
    scene_mesh m = scene_mesh_begin(s, 282, err);
    scene_office_palette p = scene_office_paint(&m);
    walls(&m, &p);
    floor_and_ceiling(&m, &p);
    table(&m, &p);
    for (int i = 0; i < 20; i++)
        seat(&m, &p, i);
    table_middle(&m, &p);
    corner_table(&m, &p);
    along_the_walls(&m, &p);
    trough(&m, &p);
    base_status status = scene_mesh_end(&m, SCENE_CONFERENCE_TRIANGLES);
    const double eye[3] = {5.3, 2.25, 3.9}, target[3] = {-0.9, 0.75, -0.6}, up[3] = {0, 1, 0};
    s->light = (scene_light){.has_area = 1, .corner = {-1.0, 2.85, -1.0}, .u = {2.0, 0, 0}, .v = {0, 0, 2.0}};
    return status != BASE_OK ? status : scene_add_camera(s, scene_camera_look_at("main", eye, target, up, 1.13), err);
}
