/* The larger things of scene/builtin/office.h: what stands along walls, hangs from ceilings and before windows. */
#include "scene/builtin/furniture.h"
#include "scene/builtin/office.h"

#define COUNT_OF(a) (sizeof(a) / sizeof *(a))

void scene_book_shelf(scene_mesh *m, const scene_office_palette *p, double width, unsigned rows, unsigned books)
{
    double height = 0.36 * rows + 0.06, w = width / 2;
    m->material = p->wood[1];
    scene_mesh_box(m, scene_at(-w, 0, 0), scene_at(-w + 0.025, height, 0.30), SCENE_FACES_STANDING & SCENE_FACES_NO_BACK);
    scene_mesh_box(m, scene_at(w - 0.025, 0, 0), scene_at(w, height, 0.30), SCENE_FACES_STANDING & SCENE_FACES_NO_BACK);
    scene_mesh_box(m, scene_at(-w + 0.025, 0.05, 0), scene_at(w - 0.025, height - 0.02, 0.015), SCENE_FACE_FRONT);
    for (unsigned i = 0; i <= rows; i++) {
        double y = 0.05 + 0.36 * i - (i == rows ? 0.02 : 0.0);
        m->material = p->wood[1];
        scene_mesh_box(m, scene_at(-w + 0.025, y - 0.02, 0.01), scene_at(w - 0.025, y, 0.295),
            SCENE_FACE_TOP | SCENE_FACE_BOTTOM | SCENE_FACE_FRONT);
        if (i == rows)
            break;
        scene_frame before = scene_mesh_enter(m, -w + 0.04, y, 0.26, 0);
        double full = scene_mesh_random(m, 0.6, 1.0);
        scene_books(m, (width - 0.08) * full, 0.32, 0.23, books, p->book, 5);
        m->frame = before;
    }
}

void scene_file_cabinet(scene_mesh *m, const scene_office_palette *p)
{
    m->material = p->trim;
    scene_mesh_box(m, scene_at(-0.23, 0, 0), scene_at(0.23, 1.32, 0.55), SCENE_FACES_STANDING);
    for (int i = 0; i < 4; i++) {
        double y = 0.04 + 0.32 * i;
        m->material = p->plastic;
        scene_mesh_box(m, scene_at(-0.215, y, 0.55), scene_at(0.215, y + 0.30, 0.57), SCENE_FACES_NO_BACK);
        m->material = p->steel;
        scene_mesh_beam(m, scene_at(-0.06, y + 0.20, 0.585), scene_at(0.06, y + 0.20, 0.585), 0.014, 0.014, 1);
        m->material = p->paper[0];
        scene_mesh_box(m, scene_at(-0.05, y + 0.23, 0.57), scene_at(0.05, y + 0.27, 0.574), SCENE_FACES_NO_BACK);
    }
}

void scene_waste_basket(scene_mesh *m, const scene_office_palette *p, unsigned fine)
{
    unsigned bars = 12 + 6 * fine;
    m->material = p->black;
    for (int i = 0; i < 4; i++) {
        scene_frame before = scene_mesh_enter(m, 0, 0.01 + 0.10 * i, 0, 0);
        scene_mesh_torus(m, 0.105 + 0.013 * i, 0.005, 8 + 4 * fine, 3);
        m->frame = before;
    }
    for (unsigned i = 0; i < bars; i++) {
        double c, s;
        scene_direction((double)i / bars, &c, &s);
        scene_mesh_beam(m, scene_at(0.105 * s, 0.01, 0.105 * c), scene_at(0.144 * s, 0.31, 0.144 * c), 0.003, 0.003, 0);
    }
    const scene_profile bottom[] = {{0.105, 0.004}, {0.104, 0.008}, {0, 0.008}};
    scene_mesh_lathe(m, bottom, COUNT_OF(bottom), 8 + 2 * fine);
}

void scene_pot_plant(scene_mesh *m, const scene_office_palette *p, double height, unsigned leaves, unsigned fine)
{
    double r = 0.14 * height + 0.03;
    m->material = p->pot;
    scene_ware_draw(m, SCENE_WARE_POT, r, 1.4 * r, 8 + 2 * fine);
    m->material = p->wood[0];
    scene_mesh_rope(m, scene_at(0, 1.2 * r, 0), scene_at(0.1 * r, 0.75 * height, 0.1 * r), 0.02, 0.012 + 0.01 * height, 6,
        4 + fine);
    for (int i = 0; i < 2; i++) {
        scene_frame before = scene_mesh_enter(m, 0.05 * i, 0.72 * height + 0.1 * i * height, 0, 0.3 * i);
        m->material = p->leaf[i];
        scene_leaves(m, leaves / 2, 0.22 * height, 0.28 * height, 0.17 * height);
        m->frame = before;
    }
}

void scene_ceiling_lamp(scene_mesh *m, const scene_office_palette *p, double length, unsigned louvres, unsigned fine)
{
    double l = length / 2;
    m->material = p->trim;
    scene_mesh_box(m, scene_at(-l, -0.09, -0.16), scene_at(l, 0, -0.15), SCENE_FACES_AROUND | SCENE_FACE_BOTTOM);
    scene_mesh_box(m, scene_at(-l, -0.09, 0.15), scene_at(l, 0, 0.16), SCENE_FACES_AROUND | SCENE_FACE_BOTTOM);
    scene_mesh_ceiling(m, -l, -0.15, l, 0.15, -0.005);
    for (unsigned i = 0; i <= louvres; i++) {
        double x = -l + length * i / louvres;
        scene_mesh_box(m, scene_at(x - 0.003, -0.088, -0.15), scene_at(x + 0.003, -0.03, 0.15),
            SCENE_FACE_LEFT | SCENE_FACE_RIGHT | SCENE_FACE_BOTTOM | SCENE_FACE_TOP);
    }
    m->material = p->lamp;
    for (int side = -1; side < 2; side += 2) {
        scene_point tube[2] = {{-l + 0.02, -0.045, 0.075 * side}, {l - 0.02, -0.045, 0.075 * side}};
        scene_mesh_pipe(m, tube, 2, 0.013, 4 + 2 * fine);
    }
}

void scene_blind(scene_mesh *m, const scene_office_palette *p, scene_opening hole, double pitch)
{
    unsigned slats = (unsigned)((hole.y1 - hole.y0 - 0.06) / pitch);
    m->material = p->plastic;
    scene_mesh_box(m, scene_at(hole.x0, hole.y1 - 0.05, -0.03), scene_at(hole.x1, hole.y1, 0.03), SCENE_FACES_ALL);
    for (unsigned i = 0; i < slats; i++) {
        scene_frame before = scene_mesh_enter(m, 0, hole.y1 - 0.07 - pitch * i, 0, 0);
        scene_mesh_pitch(m, 0.07);
        scene_mesh_box(m, scene_at(hole.x0 + 0.005, -0.0006, -0.45 * pitch), scene_at(hole.x1 - 0.005, 0.0006, 0.45 * pitch),
            SCENE_FACES_ALL);
        m->frame = before;
    }
    for (int side = 0; side < 2; side++) {
        double x = hole.x0 + (hole.x1 - hole.x0) * (side ? 0.85 : 0.15);
        scene_mesh_beam(m, scene_at(x, hole.y1 - 0.05, 0.4 * pitch), scene_at(x, hole.y1 - 0.07 - pitch * slats,
            0.4 * pitch), 0.003,
            0.003, 1);
    }
}

void scene_radiator(scene_mesh *m, const scene_office_palette *p, double width, unsigned ribs, unsigned fine)
{
    double step = width / ribs;
    const scene_profile rib[] = {{0, 0}, {0.35 * step, 0.012}, {0.42 * step, 0.05}, {0.42 * step, 0.50}, {0.35 * step, 0.538},
        {0, 0.55}};
    m->material = p->plastic;
    for (unsigned i = 0; i < ribs; i++) {
        scene_frame before = scene_mesh_enter(m, step * (i + 0.5), 0.10, 0.07, 0);
        scene_mesh_lathe(m, rib, COUNT_OF(rib), 5 + fine);
        m->frame = before;
    }
    for (int i = 0; i < 2; i++) {
        scene_point pipe[2] = {{-0.05, 0.16 + 0.42 * i, 0.07}, {width + 0.05, 0.16 + 0.42 * i, 0.07}};
        scene_mesh_pipe(m, pipe, 2, 0.013, 5 + fine);
    }
}

void scene_pin_board(scene_mesh *m, const scene_office_palette *p, double width, double height, unsigned papers)
{
    scene_picture(m, width, height, p->wood[0], p->board);
    for (unsigned i = 0; i < papers; i++) {
        double x = scene_mesh_random(m, -0.5, 0.5) * (width - 0.4), y = scene_mesh_random(m, -0.5, 0.5) * (height - 0.45);
        double roll = scene_mesh_random(m, -0.015, 0.015), shade = scene_mesh_random(m, 0, 3);
        scene_frame before = scene_mesh_enter(m, x, y, 0.017 + 0.002 * i, 0);
        scene_mesh_roll(m, roll);
        m->material = p->paper[(unsigned)shade];
        scene_mesh_box(m, scene_at(-0.105, -0.148, 0), scene_at(0.105, 0.148, 0.001), SCENE_FACES_NO_BACK);
        m->material = p->cloth[i % 3];
        scene_mesh_box(m, scene_at(-0.006, 0.120, 0), scene_at(0.006, 0.132, 0.012), SCENE_FACES_NO_BACK);
        m->frame = before;
    }
}
