/* A saloon of 14 by 10 m, two storeys high: gallery along the back and the right, bar under it at the back, stairs
 * along the left wall. x runs along the back wall, z towards the front door, y = 0 is the top of the boards. */
#include "scene/builtin/architecture.h"
#include "scene/builtin/furniture.h"
#include "scene/builtin/hall_bar.h"
#include "scene/builtin/scenes.h"

#define HALF_X 7.0
#define HALF_Z 5.0
#define HEIGHT 7.6
#define GALLERY 3.5      /* height of its floor */
#define EDGE_Z (-3.1)    /* of the back gallery */
#define EDGE_X 5.2       /* of the right gallery */

static scene_hall_palette paint_palette(scene_mesh *m)
{
    scene_hall_palette p;
    p.wall = scene_mesh_paint(m, 0.62, 0.52, 0.36);
    p.wainscot = scene_mesh_paint(m, 0.34, 0.20, 0.11);
    p.beam = scene_mesh_paint(m, 0.25, 0.15, 0.08);
    p.ceiling = scene_mesh_paint(m, 0.55, 0.45, 0.32);
    p.plank[0] = scene_mesh_paint(m, 0.46, 0.30, 0.17);
    p.plank[1] = scene_mesh_paint(m, 0.40, 0.26, 0.15);
    p.plank[2] = scene_mesh_paint(m, 0.51, 0.35, 0.20);
    p.plank[3] = scene_mesh_paint(m, 0.43, 0.29, 0.18);
    p.gap = scene_mesh_paint(m, 0.07, 0.05, 0.03);
    p.rail = scene_mesh_paint(m, 0.45, 0.22, 0.10);
    p.baluster = scene_mesh_paint(m, 0.72, 0.64, 0.50);
    p.bar = scene_mesh_paint(m, 0.30, 0.13, 0.07);
    p.brass = scene_mesh_paint(m, 0.75, 0.55, 0.20);
    p.mirror = scene_mesh_paint(m, 0.55, 0.62, 0.64);
    p.bottle[0] = scene_mesh_paint(m, 0.10, 0.32, 0.14);
    p.bottle[1] = scene_mesh_paint(m, 0.45, 0.22, 0.06);
    p.bottle[2] = scene_mesh_paint(m, 0.62, 0.68, 0.66);
    p.bottle[3] = scene_mesh_paint(m, 0.52, 0.10, 0.08);
    p.bottle[4] = scene_mesh_paint(m, 0.12, 0.22, 0.42);
    p.glass = scene_mesh_paint(m, 0.75, 0.80, 0.80);
    p.chair = scene_mesh_paint(m, 0.50, 0.27, 0.12);
    p.table = scene_mesh_paint(m, 0.38, 0.19, 0.09);
    p.cushion = scene_mesh_paint(m, 0.55, 0.09, 0.08);
    p.iron = scene_mesh_paint(m, 0.09, 0.09, 0.10);
    p.candle = scene_mesh_paint(m, 0.90, 0.86, 0.70);
    p.barrel = scene_mesh_paint(m, 0.44, 0.28, 0.15);
    p.curtain = scene_mesh_paint(m, 0.50, 0.08, 0.10);
    p.pane = scene_mesh_paint(m, 0.60, 0.70, 0.74);
    p.picture[0] = scene_mesh_paint(m, 0.30, 0.42, 0.36);
    p.picture[1] = scene_mesh_paint(m, 0.62, 0.48, 0.28);
    p.picture[2] = scene_mesh_paint(m, 0.36, 0.40, 0.52);
    p.key = scene_mesh_paint(m, 0.88, 0.86, 0.80);
    p.card = scene_mesh_paint(m, 0.86, 0.84, 0.76);
    return p;
}

/* A window or door in a wall's frame, its surround, and the wall piece from x0 to x1 about it. */
static void wall_piece(scene_mesh *m, const scene_hall_palette *p, double x0, double x1, scene_opening hole,
    int is_door)
{
    m->material = p->wall;
    scene_wall(m, x0, 0, x1, HEIGHT, hole);
    m->material = p->wainscot;
    scene_reveal(m, hole, 0.2, SCENE_FACE_LEFT | SCENE_FACE_RIGHT | SCENE_FACE_TOP | SCENE_FACE_BOTTOM);
    for (int side = 0; side < 2; side++) {
        double x = side ? hole.x1 : hole.x0 - 0.09;
        scene_mesh_box(m, scene_at(x, hole.y0, 0), scene_at(x + 0.09, hole.y1, 0.035),
            SCENE_FACES_AROUND & SCENE_FACES_NO_BACK);
    }
    scene_mesh_box(m, scene_at(hole.x0 - 0.12, hole.y1, 0), scene_at(hole.x1 + 0.12, hole.y1 + 0.12, 0.05),
        SCENE_FACES_NO_BACK);
    scene_frame before = scene_mesh_enter(m, (hole.x0 + hole.x1) / 2, hole.y0, -0.18, 0);
    if (is_door) {
        scene_panel_door(m, hole.x1 - hole.x0, hole.y1 - hole.y0);
    } else {
        double w = (hole.x1 - hole.x0) / 2, h = hole.y1 - hole.y0;
        m->material = p->pane;
        scene_mesh_quad(m, scene_at(-w, 0, 0), scene_at(w, 0, 0), scene_at(w, h, 0), scene_at(-w, h, 0));
        m->material = p->card;
        scene_mesh_enter(m, 0, 0, 0.04, 0);
        scene_window_bars(m, (scene_opening){-w, w, 0, h}, 3, 5, 0.035);
        m->material = p->wainscot;
        scene_mesh_enter(m, 0, 0, 0.14, 0);
        scene_mesh_box(m, scene_at(-w - 0.13, -0.06, 0), scene_at(w + 0.13, 0, 0.12), SCENE_FACES_NO_BACK);
    }
    m->frame = before;
}

/* Upright boards and a rail to breast height, left out between gap0 and gap1. */
static void wainscot(scene_mesh *m, const scene_hall_palette *p, double half, double gap0, double gap1)
{
    m->material = p->wainscot;
    unsigned boards = (unsigned)(2 * half / 0.20);
    for (unsigned i = 0; i < boards; i++) {
        double x = -half + (i + 0.5) * 2 * half / boards;
        if (x + 0.1 > gap0 && x - 0.1 < gap1)
            continue;
        scene_mesh_box(m, scene_at(x - 0.09, 0, 0), scene_at(x + 0.09, 1.02, 0.018),
            SCENE_FACE_LEFT | SCENE_FACE_RIGHT | SCENE_FACE_FRONT);
    }
    static const scene_profile rail[] = {{0, 0.98}, {0.03, 1.00}, {0.05, 1.05}, {0.05, 1.08}, {0, 1.10}};
    if (gap0 > -half)
        scene_mesh_moulding(m, rail, 5, -half, gap0, 0, 0);
    if (gap1 < half)
        scene_mesh_moulding(m, rail, 5, gap1, half, 0, 0);
}

static void walls(scene_mesh *m, const scene_hall_palette *p)
{
    scene_frame world = scene_mesh_enter(m, 0, 0, -HALF_Z, 0);
    wall_piece(m, p, -7, -2.2, (scene_opening){-4.4, -3.4, 4.5, 6.5}, 0);
    wall_piece(m, p, -2.2, 2.4, (scene_opening){-0.5, 0.5, GALLERY, 5.7}, 1);
    wall_piece(m, p, 2.4, 7, (scene_opening){3.6, 4.6, 4.5, 6.5}, 0);
    m->frame = world;
    scene_mesh_enter(m, -HALF_X, 0, 0, 0.25);
    wall_piece(m, p, -5, 1.0, (scene_opening){-2.5, -1.4, 4.4, 6.6}, 0);
    wall_piece(m, p, 1.0, 5, (scene_opening){1.8, 2.9, 4.4, 6.6}, 0);
    m->frame = world;
    scene_mesh_enter(m, 0, 0, HALF_Z, 0.5);
    wall_piece(m, p, -7, -2.0, (scene_opening){-4.8, -3.4, 1.3, 3.1}, 0);
    wall_piece(m, p, -2.0, 2.0, (scene_opening){-0.9, 0.9, 0, 2.5}, 1);
    wall_piece(m, p, 2.0, 7, (scene_opening){3.4, 4.8, 1.3, 3.1}, 0);
    wainscot(m, p, HALF_X, -1.1, 1.1);
    m->frame = world;
    scene_mesh_enter(m, HALF_X, 0, 0, 0.75);
    wall_piece(m, p, -5, 0.5, (scene_opening){-2.6, -1.7, GALLERY, 5.6}, 1);
    wall_piece(m, p, 0.5, 5, (scene_opening){1.9, 2.8, GALLERY, 5.6}, 1);
    wainscot(m, p, HALF_Z, HALF_Z, HALF_Z);
    m->frame = world;
    scene_mesh_enter(m, -HALF_X, 0, 0, 0.25);
    wainscot(m, p, HALF_Z, -2.35, 3.2);
    m->frame = world;
}

static void floor_and_ceiling(scene_mesh *m, const scene_hall_palette *p)
{
    m->material = p->gap;
    scene_mesh_floor(m, -HALF_X, -HALF_Z, HALF_X, HALF_Z, -0.012);
    scene_planks(m, -HALF_X, -HALF_Z, HALF_X, HALF_Z, 0.18, 2.4, p->plank, 4);
    m->material = p->ceiling;
    scene_mesh_ceiling(m, -HALF_X, -HALF_Z, HALF_X, HALF_Z, HEIGHT);
    m->material = p->beam;
    for (int i = 0; i < 5; i++) { /* main beams with braces to the walls */
        double x = -5.2 + 2.6 * i;
        scene_mesh_box(m, scene_at(x - 0.14, HEIGHT - 0.42, -HALF_Z), scene_at(x + 0.14, HEIGHT - 0.12, HALF_Z),
            SCENE_FACE_LEFT | SCENE_FACE_RIGHT | SCENE_FACE_BOTTOM | SCENE_FACE_TOP);
        scene_mesh_beam(m, scene_at(x, HEIGHT - 1.5, -HALF_Z + 0.05), scene_at(x, HEIGHT - 0.4, -HALF_Z + 1.0), 0.14,
            0.16, 0);
        scene_mesh_beam(m, scene_at(x, HEIGHT - 1.5, HALF_Z - 0.05), scene_at(x, HEIGHT - 0.4, HALF_Z - 1.0), 0.14,
            0.16, 0);
        scene_mesh_box(m, scene_at(x - 0.09, HEIGHT - 1.7, -HALF_Z), scene_at(x + 0.09, HEIGHT - 0.42, -HALF_Z + 0.11),
            SCENE_FACE_LEFT | SCENE_FACE_RIGHT | SCENE_FACE_BOTTOM | SCENE_FACE_FRONT);
    }
    for (int i = 0; i < 20; i++) {
        double z = -HALF_Z + 0.25 + 0.5 * i;
        scene_mesh_box(m, scene_at(-HALF_X, HEIGHT - 0.121, z - 0.04), scene_at(HALF_X, HEIGHT, z + 0.04),
            SCENE_FACE_FRONT | SCENE_FACE_BACK | SCENE_FACE_BOTTOM);
    }
}

static void post(scene_mesh *m, const scene_hall_palette *p, double x, double z)
{
    static const scene_profile lower[] = {{0.11, 0.9}, {0.085, 0.95}, {0.10, 1.02}, {0.075, 1.10}, {0.10, 1.9},
        {0.07, 2.55},
        {0.10, 2.62}, {0.11, 2.70}};
    static const scene_profile upper[] = {{0.09, 4.55}, {0.06, 4.62}, {0.08, 4.70}, {0.06, 4.80}, {0.08, 5.8},
        {0.055, 6.70},
        {0.09, 6.80}, {0.10, 6.90}};
    scene_frame before = scene_mesh_enter(m, x, 0, z, 0);
    m->material = p->rail;
    scene_mesh_box(m, scene_at(-0.11, 0, -0.11), scene_at(0.11, 0.9, 0.11), SCENE_FACES_STANDING);
    scene_mesh_lathe(m, lower, 8, 12);
    scene_mesh_box(m, scene_at(-0.11, 2.7, -0.11), scene_at(0.11, GALLERY - 0.3, 0.11), SCENE_FACES_HANGING);
    scene_mesh_box(m, scene_at(-0.09, GALLERY, -0.09), scene_at(0.09, 4.55, 0.09), SCENE_FACES_STANDING);
    scene_mesh_lathe(m, upper, 8, 10);
    scene_mesh_box(m, scene_at(-0.10, 6.90, -0.10), scene_at(0.10, HEIGHT - 0.13, 0.10), SCENE_FACES_HANGING);
    m->frame = before;
}

static void gallery(scene_mesh *m, const scene_hall_palette *p)
{
    scene_frame world = scene_mesh_enter(m, 0, GALLERY, 0, 0);
    m->material = p->gap;
    scene_mesh_floor(m, -HALF_X, -HALF_Z, HALF_X, EDGE_Z - 0.06, -0.012);
    scene_mesh_floor(m, EDGE_X + 0.06, EDGE_Z - 0.06, HALF_X, HALF_Z, -0.012);
    scene_planks(m, -HALF_X, -HALF_Z, HALF_X, EDGE_Z - 0.06, 0.18, 2.8, p->plank, 4);
    scene_mesh_enter(m, HALF_X, 0, HALF_Z, 0.25);
    scene_planks(m, 0, EDGE_X + 0.06 - HALF_X, HALF_Z - EDGE_Z + 0.06, 0, 0.18, 2.8, p->plank, 4);
    m->frame = world;
    m->material = p->ceiling;
    scene_mesh_ceiling(m, -HALF_X, -HALF_Z, HALF_X, EDGE_Z - 0.06, GALLERY - 0.12);
    scene_mesh_ceiling(m, EDGE_X + 0.06, EDGE_Z - 0.06, HALF_X, HALF_Z, GALLERY - 0.12);
    m->material = p->rail;
    scene_mesh_box(m, scene_at(-HALF_X, GALLERY - 0.3, EDGE_Z - 0.06), scene_at(EDGE_X - 0.06, GALLERY + 0.001,
        EDGE_Z + 0.06),
        SCENE_FACES_ALL & ~(unsigned)(SCENE_FACE_LEFT | SCENE_FACE_RIGHT));
    scene_mesh_box(m, scene_at(EDGE_X - 0.06, GALLERY - 0.3, EDGE_Z - 0.06), scene_at(EDGE_X + 0.06, GALLERY + 0.001,
        HALF_Z),
        SCENE_FACES_ALL & ~(unsigned)SCENE_FACE_FRONT);
    m->material = p->beam;
    for (int i = 0; i < 28; i++) {
        double x = -HALF_X + 0.25 + 0.5 * i;
        scene_mesh_box(m, scene_at(x - 0.04, GALLERY - 0.26, -HALF_Z), scene_at(x + 0.04, GALLERY - 0.12,
            EDGE_Z - 0.06),
            SCENE_FACE_LEFT | SCENE_FACE_RIGHT | SCENE_FACE_BOTTOM);
    }
    for (int i = 0; i < 16; i++) {
        double z = EDGE_Z + 0.3 + 0.5 * i;
        scene_mesh_box(m, scene_at(EDGE_X + 0.06, GALLERY - 0.26, z - 0.04), scene_at(HALF_X, GALLERY - 0.12, z + 0.04),
            SCENE_FACE_FRONT | SCENE_FACE_BACK | SCENE_FACE_BOTTOM);
    }
    for (int i = 0; i < 5; i++)
        post(m, p, -5.2 + 2.6 * i, EDGE_Z);
    for (int i = 0; i < 3; i++)
        post(m, p, EDGE_X, EDGE_Z + 2.6 * (i + 1));
    for (int i = 0; i < 4; i++) {
        scene_mesh_enter(m, -3.9 + 2.6 * i, GALLERY + 0.001, EDGE_Z, 0);
        m->material = p->baluster;
        scene_balustrade(m, -1.22, 1.22, 0.95, 11, 6);
        m->frame = world;
    }
    for (int i = 0; i < 3; i++) {
        scene_mesh_enter(m, EDGE_X, GALLERY + 0.001, EDGE_Z + 1.3 + 2.6 * i, 0.25);
        m->material = p->baluster;
        scene_balustrade(m, -1.22, 1.22, 0.95, 11, 6);
        m->frame = world;
    }
}

static void stairs(scene_mesh *m, const scene_hall_palette *p)
{
    static const scene_profile turned[] = {{0.03, 0}, {0.022, 0.12}, {0.036, 0.30}, {0.018, 0.55}, {0.026, 0.74},
        {0.024, 0.86}};
    static const scene_profile newel[] = {{0.08, 1.05}, {0.05, 1.08}, {0.08, 1.14}, {0.10, 1.21}, {0.08, 1.28}, {0,
        1.32}};
    enum { STEPS = 19 };
    double rise = GALLERY / (STEPS + 1), start = 2.3, tread = (start - (EDGE_Z + 0.06)) / STEPS;
    scene_frame before = scene_mesh_enter(m, -HALF_X + 0.64, 0, start, 0);
    m->material = p->plank[1];
    scene_stairs(m, 1.22, rise, tread, STEPS);
    m->material = p->baluster;
    for (int i = 0; i < STEPS; i++)
        for (int k = 0; k < 2; k++) {
            scene_frame step = scene_mesh_enter(m, 0.54, rise * (i + 1), -tread * (i + (k ? 0.75 : 0.25)), 0);
            scene_mesh_lathe(m, turned, 6, 6);
            m->frame = step;
        }
    m->material = p->rail;
    scene_mesh_beam(m, scene_at(0.54, rise * 0.75 + 0.90, 0.02), scene_at(0.54, rise * (STEPS + 0.5) + 0.88,
        -tread * STEPS - 0.05), 0.07,
        0.06, 1);
    scene_mesh_box(m, scene_at(0.45, 0, 0.03), scene_at(0.61, 1.05, 0.19), SCENE_FACES_STANDING);
    scene_mesh_enter(m, 0.53, 0, 0.11, 0);
    scene_mesh_lathe(m, newel, 6, 10);
    m->frame = before;
}

base_status scene_build_hall(scene *s, base_error *err)
{
    scene_mesh m = scene_mesh_begin(s, 1881, err);
    scene_hall_palette p = paint_palette(&m);
    walls(&m, &p);
    floor_and_ceiling(&m, &p);
    gallery(&m, &p);
    stairs(&m, &p);
    scene_hall_furnish(&m, &p);
    m.material = p.barrel; /* nutshells on the floor before the bar */
    if (s->triangle_count < SCENE_HALL_TRIANGLES)
        scene_pebbles(&m, SCENE_HALL_TRIANGLES - s->triangle_count, -4.0, -2.4, 4.4, 1.5, 0.016);
    base_status status = scene_mesh_end(&m, SCENE_HALL_TRIANGLES);
    const double eye[3] = {4.9, 2.5, 4.7}, target[3] = {-1.9, 1.95, -2.0}, up[3] = {0, 1, 0};
    /* About three degrees wide from below: the MFT paper names no size, and its counts call for narrow lights (docs/reports.md). */
    s->light = (scene_light){.has_area = 1, .corner = {-0.8, 7.0, -0.25}, .u = {0.4, 0, 0}, .v = {0, 0, 0.3}};
    return status != BASE_OK ? status : scene_add_camera(s, scene_camera_look_at("main", eye, target, up, 1.12), err);
}
