#include "scene/builtin/hall_bar.h"

#include "scene/builtin/furniture.h"

/* The counter: panelled front, thick top, brass foot rail on brackets. Its front faces +z. */
static void counter(scene_mesh *m, const scene_hall_palette *p)
{
    scene_frame before = scene_mesh_enter(m, 0.6, 0, -3.55, 0);
    m->material = p->bar;
    scene_mesh_box(m, scene_at(-3.8, 0, -0.25), scene_at(3.8, 0.98, 0.25), SCENE_FACES_AROUND);
    scene_mesh_box(m, scene_at(-3.84, 0, 0.25), scene_at(3.84, 0.16, 0.28), SCENE_FACES_STANDING & SCENE_FACES_NO_BACK);
    scene_mesh_box(m, scene_at(-3.84, 0.86, 0.25), scene_at(3.84, 0.98, 0.29),
        SCENE_FACES_HANGING & SCENE_FACES_NO_BACK);
    for (int i = 0; i < 10; i++) {
        double x = -3.42 + 0.76 * i;
        scene_mesh_box(m, scene_at(x - 0.28, 0.24, 0.25), scene_at(x + 0.28, 0.78, 0.27), SCENE_FACES_NO_BACK);
        scene_mesh_box(m, scene_at(x - 0.20, 0.32, 0.27), scene_at(x + 0.20, 0.70, 0.285), SCENE_FACES_NO_BACK);
    }
    m->material = p->table;
    scene_mesh_box(m, scene_at(-3.95, 0.98, -0.32), scene_at(3.95, 1.05, 0.38), SCENE_FACES_ALL);
    m->material = p->brass;
    scene_point rail[2] = {{-3.9, 0.18, 0.46}, {3.9, 0.18, 0.46}};
    scene_mesh_pipe(m, rail, 2, 0.022, 10);
    for (int i = 0; i < 9; i++)
        scene_mesh_beam(m, scene_at(-3.6 + 0.9 * i, 0.04, 0.281), scene_at(-3.6 + 0.9 * i, 0.165, 0.46), 0.02, 0.02, 0);
    for (int i = 0; i < 9; i++) {
        double x = scene_mesh_random(m, -3.6, 3.6), z = scene_mesh_random(m, -0.15, 0.25);
        scene_frame top = scene_mesh_enter(m, x, 1.051, z, 0);
        m->material = i % 3 ? p->glass : p->bottle[i % 5];
        if (i % 3)
            scene_ware_draw(m, i % 3 == 1 ? SCENE_WARE_GLASS : SCENE_WARE_GOBLET, 0.04, i % 3 == 1 ? 0.11 : 0.16, 8);
        else
            scene_ware_draw(m, SCENE_WARE_BOTTLE, 0.04, 0.30, 8);
        m->frame = top;
    }
    m->frame = before;
}

/* The cabinet at the wall: drawers below, three shelves of bottles on both sides of a mirror. */
static void back_bar(scene_mesh *m, const scene_hall_palette *p)
{
    scene_frame before = scene_mesh_enter(m, 0.6, 0, -5.0, 0);
    m->material = p->bar;
    scene_mesh_box(m, scene_at(-3.4, 0, 0), scene_at(3.4, 0.92, 0.42), SCENE_FACES_STANDING & SCENE_FACES_NO_BACK);
    scene_mesh_box(m, scene_at(-3.45, 2.75, 0), scene_at(3.45, 2.88, 0.40), SCENE_FACES_NO_BACK);
    for (int i = 0; i < 6; i++) {
        double x = -3.4 + 6.8 / 5 * i;
        scene_mesh_box(m, scene_at(x - 0.04, 0.92, 0), scene_at(x + 0.04, 2.75, 0.36),
            SCENE_FACES_AROUND & SCENE_FACES_NO_BACK);
    }
    m->material = p->mirror;
    scene_mesh_quad(m, scene_at(-0.64, 0.95, 0.01), scene_at(0.64, 0.95, 0.01), scene_at(0.64, 2.72, 0.01),
        scene_at(-0.64, 2.72, 0.01));
    for (int i = 0; i < 5; i++)
        for (int shelf = 0; shelf < 4; shelf++) {
            if (i == 2 && shelf > 0)
                continue;
            double x = -2.72 + 1.36 * i, y = 0.92 + 0.47 * shelf;
            m->material = p->bar;
            if (shelf > 0)
                scene_mesh_box(m, scene_at(x - 0.64, y - 0.025, 0), scene_at(x + 0.64, y, 0.30),
                    SCENE_FACE_TOP | SCENE_FACE_BOTTOM | SCENE_FACE_FRONT);
            for (int k = 0; k < 6; k++) {
                double shift = scene_mesh_random(m, -0.03, 0.03), deep = scene_mesh_random(m, 0.12, 0.23);
                double tall = scene_mesh_random(m, 0.24, 0.34), tint = scene_mesh_random(m, 0, 4.999);
                double shape = scene_mesh_random(m, 0, 1);
                scene_frame at = scene_mesh_enter(m, x - 0.5 + 0.2 * k + shift, y + 0.001, deep, 0);
                m->material = p->bottle[(unsigned)tint];
                scene_ware_draw(m, shape < 0.75 ? SCENE_WARE_BOTTLE : SCENE_WARE_FLASK, shape < 0.75 ? 0.042 : 0.06,
                    tall,
                    shape < 0.75 ? 7 : 8);
                m->frame = at;
            }
        }
    m->frame = before;
}

/* A round table with chairs, and on it bottle, glasses and playing cards. */
static void table_group(scene_mesh *m, const scene_hall_palette *p, double x, double z, double turn, int chairs)
{
    scene_frame world = scene_mesh_enter(m, x, 0, z, turn);
    m->material = p->table;
    scene_round_table(m, 0.55, 0.76, 16);
    for (int i = 0; i < chairs; i++) {
        double away = scene_mesh_random(m, 0.62, 0.85), twist = scene_mesh_random(m, -0.06, 0.06);
        scene_frame at = scene_mesh_enter(m, 0, 0, 0, (double)i / chairs + twist / 2);
        scene_mesh_enter(m, 0, 0, away, 0.5 + twist);
        m->material = p->chair;
        scene_spindle_chair(m, 4, 5);
        m->frame = at;
    }
    for (int i = 0; i < 4; i++) {
        double angle = scene_mesh_random(m, 0, 0.12), out = scene_mesh_random(m, 0.18, 0.42),
            tint = scene_mesh_random(m, 0, 4.999);
        scene_frame at = scene_mesh_enter(m, 0, 0.762, 0, 0.25 * i + angle);
        scene_mesh_enter(m, 0, 0, out, 0);
        if (i == 0) {
            m->material = p->bottle[(unsigned)tint];
            scene_ware_draw(m, SCENE_WARE_BOTTLE, 0.042, 0.29, 8);
        } else {
            m->material = p->glass;
            scene_ware_draw(m, i == 3 ? SCENE_WARE_GOBLET : SCENE_WARE_GLASS, 0.035, i == 3 ? 0.14 : 0.10, 8);
        }
        m->frame = at;
    }
    for (int i = 0; i < 6; i++) { /* cards, each lying on its own level */
        double angle = scene_mesh_random(m, 0, 1), out = scene_mesh_random(m, 0.05, 0.40),
            twist = scene_mesh_random(m, 0, 1);
        scene_frame at = scene_mesh_enter(m, 0, 0.762 + 0.0012 * i, 0, angle);
        scene_mesh_enter(m, 0, 0, out, twist);
        m->material = p->card;
        scene_mesh_box(m, scene_at(-0.03, 0, -0.045), scene_at(0.03, 0.0007, 0.045), SCENE_FACES_ALL);
        m->frame = at;
    }
    m->frame = world;
}

/* An upright piano, keys towards +z. */
static void piano(scene_mesh *m, const scene_hall_palette *p)
{
    m->material = p->bar;
    scene_mesh_box(m, scene_at(-0.75, 0, -0.30), scene_at(0.75, 1.25, 0.05), SCENE_FACES_AROUND);
    scene_mesh_box(m, scene_at(-0.78, 1.25, -0.33), scene_at(0.78, 1.29, 0.09), SCENE_FACES_ALL);
    scene_mesh_box(m, scene_at(-0.75, 0.58, 0.05), scene_at(0.75, 0.66, 0.32), SCENE_FACES_NO_BACK);
    scene_mesh_box(m, scene_at(-0.75, 0.66, 0.05), scene_at(-0.66, 0.76, 0.32),
        SCENE_FACES_STANDING & SCENE_FACES_NO_BACK);
    scene_mesh_box(m, scene_at(0.66, 0.66, 0.05), scene_at(0.75, 0.76, 0.32),
        SCENE_FACES_STANDING & SCENE_FACES_NO_BACK);
    for (int i = 0; i < 2; i++)
        scene_mesh_box(m, scene_at(i ? 0.64 : -0.72, 0, 0.22), scene_at(i ? 0.72 : -0.64, 0.58, 0.30),
        SCENE_FACES_AROUND);
    for (int i = 0; i < 52; i++) {
        double x = -0.65 + 0.025 * i;
        m->material = p->key;
        scene_mesh_box(m, scene_at(x, 0.66, 0.12), scene_at(x + 0.0235, 0.685, 0.28), SCENE_FACES_STANDING);
        if (i % 7 == 2 || i % 7 == 6 || i == 51)
            continue;
        m->material = p->iron;
        scene_mesh_box(m, scene_at(x + 0.017, 0.685, 0.125), scene_at(x + 0.031, 0.697, 0.22), SCENE_FACES_STANDING);
    }
}

/* A pot-bellied stove with its pipe up to the ceiling. */
static void stove(scene_mesh *m, const scene_hall_palette *p)
{
    static const scene_profile body[] = {{0.22, 0.18}, {0.26, 0.22}, {0.26, 0.30}, {0.24, 0.32}, {0.34, 0.55}, {0.36,
        0.72},
        {0.30, 0.92}, {0.24, 1.00}, {0.28, 1.02}, {0.28, 1.06}, {0.12, 1.12}, {0, 1.13}};
    m->material = p->iron;
    scene_mesh_lathe(m, body, sizeof body / sizeof *body, 20);
    for (int i = 0; i < 4; i++) {
        scene_frame before = scene_mesh_enter(m, 0, 0, 0, 0.25 * i + 0.125);
        scene_mesh_beam(m, scene_at(0, 0, 0.30), scene_at(0, 0.24, 0.20), 0.05, 0.05, 0);
        m->frame = before;
    }
    scene_point pipe[5] = {{0, 1.10, 0}, {0, 3.2, 0}, {0.02, 3.9, 0}, {0.02, 6.2, 0}, {0.02, 7.58, 0}};
    scene_mesh_pipe(m, pipe, 5, 0.085, 16);
    for (int i = 0; i < 3; i++) {
        scene_frame before = scene_mesh_enter(m, i ? 0.02 : 0, 2.0 + 2.2 * i, 0, 0);
        scene_mesh_torus(m, 0.09, 0.012, 16, 4);
        m->frame = before;
    }
}

static void barrels(scene_mesh *m, const scene_hall_palette *p)
{
    static const double place[6][3] = {{-4.3, 0, -4.5}, {-5.1, 0, -4.4}, {-4.7, 0.86, -4.45}, {6.4, 0, -2.2}, {6.3,
        0, -1.4}, {6.5, 0, 4.4}};
    for (int i = 0; i < 6; i++) {
        scene_frame before = scene_mesh_enter(m, place[i][0], place[i][1], place[i][2], 0.13 * i);
        m->material = p->barrel;
        scene_ware_draw(m, SCENE_WARE_BARREL, 0.32, 0.84, 14);
        static const scene_profile lid[] = {{0.25, 0.81}, {0, 0.81}};
        scene_mesh_lathe(m, lid, 2, 14);
        m->frame = before;
    }
}

static void on_the_walls(scene_mesh *m, const scene_hall_palette *p)
{
    for (int i = 0; i < 7; i++) {
        scene_frame before = m->frame;
        if (i < 3)
            scene_mesh_enter(m, -7.0, i == 1 ? 3.1 : 1.9, i == 0 ? 3.0 : i == 1 ? 0.6 : 4.2, 0.25);
        else if (i < 5)
            scene_mesh_enter(m, i == 3 ? -5.9 : -1.9, i == 3 ? 1.9 : 5.1, -5.0, 0);
        else
            scene_mesh_enter(m, 7.0, 1.9, i == 5 ? 0.4 : 2.6, 0.75);
        scene_picture(m, i % 2 ? 0.8 : 0.6, i % 2 ? 0.6 : 0.8, p->brass, p->picture[i % 3]);
        m->frame = before;
    }
    for (int i = 0; i < 2; i++) { /* curtains of the upper door in the back wall */
        scene_frame before = scene_mesh_enter(m, i ? 0.85 : -0.85, 5.85, -4.88, 0);
        m->material = p->curtain;
        scene_cloth cloth = {0.55, 2.3, 0.05, 3.5, 0.0, 14, 8};
        scene_cloth_draw(m, &cloth);
        m->frame = before;
    }
    m->material = p->brass;
    scene_mesh_beam(m, scene_at(-1.25, 5.87, -4.88), scene_at(1.25, 5.87, -4.88), 0.03, 0.03, 1);
    m->material = p->candle; /* bunting from gallery to gallery */
    scene_mesh_rope(m, scene_at(-5.2, 4.6, -3.0), scene_at(5.1, 4.6, 2.0), 0.7, 0.007, 40, 4);
    scene_mesh_rope(m, scene_at(-6.98, 5.4, 4.2), scene_at(5.1, 4.6, -0.6), 0.8, 0.007, 40, 4);
}

void scene_hall_furnish(scene_mesh *m, const scene_hall_palette *p)
{
    static const double table[7][3] = {{-3.4, 1.2, 0.05}, {-0.4, 0.2, 0.12}, {2.3, -0.5, 0.02}, {-1.6, 3.1, 0.09},
        {1.7, 2.0, 0.17},
        {-4.3, 3.7, 0.2}, {3.6, 3.3, 0.0}};
    scene_frame world = m->frame;
    counter(m, p);
    back_bar(m, p);
    for (int i = 0; i < 7; i++)
        table_group(m, p, table[i][0], table[i][1], table[i][2], i == 6 ? 2 : i == 5 ? 3 : 4);
    for (int i = 0; i < 7; i++) {
        scene_mesh_enter(m, -2.6 + 1.02 * i, 0, -2.75 + 0.08 * (i % 3), 0.03 * i);
        m->material = p->cushion;
        scene_stool(m, 0.74, 8);
        m->frame = world;
    }
    for (int i = 0; i < 3; i++) {
        scene_mesh_enter(m, i == 0 ? -3.6 : i == 1 ? 0.2 : 2.9, 7.18, i == 1 ? 2.3 : -0.9, 0.02 * i);
        m->material = i == 1 ? p->iron : p->brass;
        scene_chandelier(m, 2.1, 0.75, 8, 8, p->candle);
        m->frame = world;
    }
    scene_mesh_enter(m, -5.35, 0, -0.6, 0.25);
    piano(m, p);
    m->frame = world;
    scene_mesh_enter(m, 4.4, 0, -1.7, 0);
    stove(m, p);
    m->frame = world;
    barrels(m, p);
    on_the_walls(m, p);
}
