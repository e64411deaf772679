#include "scene/builtin/office.h"

#include "scene/builtin/furniture.h"

#define COUNT_OF(a) (sizeof(a) / sizeof *(a))

scene_office_palette scene_office_paint(scene_mesh *m)
{
    scene_office_palette p;
    p.wall = scene_mesh_paint(m, 0.80, 0.77, 0.70);
    p.trim = scene_mesh_paint(m, 0.66, 0.64, 0.60);
    p.carpet[0] = scene_mesh_paint(m, 0.32, 0.36, 0.44);
    p.carpet[1] = scene_mesh_paint(m, 0.36, 0.40, 0.48);
    p.carpet[2] = scene_mesh_paint(m, 0.29, 0.33, 0.42);
    p.ceiling = scene_mesh_paint(m, 0.84, 0.84, 0.82);
    p.lamp = scene_mesh_paint(m, 0.95, 0.95, 0.90);
    p.wood[0] = scene_mesh_paint(m, 0.50, 0.30, 0.15);
    p.wood[1] = scene_mesh_paint(m, 0.66, 0.46, 0.26);
    p.cloth[0] = scene_mesh_paint(m, 0.16, 0.22, 0.38);
    p.cloth[1] = scene_mesh_paint(m, 0.48, 0.12, 0.12);
    p.cloth[2] = scene_mesh_paint(m, 0.22, 0.34, 0.26);
    p.steel = scene_mesh_paint(m, 0.56, 0.58, 0.60);
    p.black = scene_mesh_paint(m, 0.06, 0.06, 0.07);
    p.plastic = scene_mesh_paint(m, 0.72, 0.70, 0.64);
    p.screen = scene_mesh_paint(m, 0.16, 0.28, 0.36);
    p.paper[0] = scene_mesh_paint(m, 0.90, 0.90, 0.86);
    p.paper[1] = scene_mesh_paint(m, 0.88, 0.84, 0.56);
    p.paper[2] = scene_mesh_paint(m, 0.60, 0.74, 0.80);
    p.glass = scene_mesh_paint(m, 0.62, 0.74, 0.80);
    p.leaf[0] = scene_mesh_paint(m, 0.14, 0.36, 0.12);
    p.leaf[1] = scene_mesh_paint(m, 0.22, 0.44, 0.16);
    p.pot = scene_mesh_paint(m, 0.60, 0.32, 0.20);
    p.book[0] = scene_mesh_paint(m, 0.55, 0.14, 0.12);
    p.book[1] = scene_mesh_paint(m, 0.15, 0.27, 0.46);
    p.book[2] = scene_mesh_paint(m, 0.22, 0.40, 0.24);
    p.book[3] = scene_mesh_paint(m, 0.72, 0.60, 0.30);
    p.book[4] = scene_mesh_paint(m, 0.34, 0.30, 0.34);
    p.board = scene_mesh_paint(m, 0.60, 0.46, 0.30);
    p.pen = scene_mesh_paint(m, 0.10, 0.16, 0.50);
    return p;
}

/* A box about the line x = z = 0 on the floor. */
static void block(scene_mesh *m, double x, double y0, double z, double width, double height, double depth, unsigned faces)
{
    scene_mesh_box(m, scene_at(x - width / 2, y0, z - depth / 2), scene_at(x + width / 2, y0 + height, z + depth / 2), faces);
}

static scene_point cushion_place(const void *user, double u, double v)
{
    const scene_point *half = user;
    double c, s, ring, up;
    scene_direction(u < 1.0 ? u : 0.0, &c, &s);
    scene_direction(0.5 * v - 0.25, &ring, &up);
    if (v == 0.0 || v == 1.0)
        return scene_at(0, v == 0.0 ? -half->y : half->y, 0);
    /* the ball of the fourth-power norm: flat faces, round edges */
    double x = ring * s, z = ring * c, sum = x * x * x * x + up * up * up * up + z * z * z * z, f = 1.0 / sqrt(sqrt(sum));
    return scene_at(x * f * half->x, up * f * half->y, z * f * half->z);
}

void scene_cushion(scene_mesh *m, double width, double height, double depth, unsigned across, unsigned along)
{
    scene_point half = {width / 2, height / 2, depth / 2};
    scene_mesh_sheet(m, across, along, cushion_place, &half);
}

static void cushion_at(scene_mesh *m, scene_point at, scene_point size, double pitch, unsigned fine)
{
    scene_frame before = scene_mesh_enter(m, at.x, at.y, at.z, 0);
    scene_mesh_pitch(m, pitch);
    scene_cushion(m, size.x, size.y, size.z, 8 * fine, 4 * fine);
    m->frame = before;
}

/* Five feet with castors, a column. */
static void swivel_foot(scene_mesh *m, const scene_office_palette *p, unsigned fine)
{
    const scene_profile column[] = {{0, 0.07}, {0.05, 0.075}, {0.05, 0.13}, {0.028, 0.15}, {0.028, 0.30}, {0.02, 0.30},
        {0.02, 0.42},
        {0.09, 0.42}, {0.09, 0.44}, {0, 0.44}};
    m->material = p->steel;
    scene_mesh_lathe(m, column, COUNT_OF(column), 4 + 2 * fine);
    for (int i = 0; i < 5; i++) {
        scene_frame before = scene_mesh_enter(m, 0, 0, 0, i * 0.2);
        m->material = p->steel;
        scene_mesh_beam(m, scene_at(0, 0.11, 0.03), scene_at(0, 0.075, 0.30), 0.045, 0.03, 1);
        scene_mesh_enter(m, -0.015, 0.03, 0.29, 0);
        scene_mesh_roll(m, -0.25);
        m->material = p->black;
        const scene_profile castor[] = {{0, 0}, {0.030, 0.004}, {0.030, 0.026}, {0, 0.03}};
        scene_mesh_lathe(m, castor, COUNT_OF(castor), 4 + 2 * fine);
        m->frame = before;
    }
}

void scene_swivel_chair(scene_mesh *m, const scene_office_palette *p, unsigned cloth, int arms, unsigned fine)
{
    swivel_foot(m, p, fine);
    m->material = p->cloth[cloth % 3];
    cushion_at(m, scene_at(0, 0.475, 0.01), scene_at(0.48, 0.09, 0.47), 0, fine);
    cushion_at(m, scene_at(0, 0.80, -0.235), scene_at(0.44, 0.50, 0.085), -0.02, fine);
    m->material = p->black;
    scene_mesh_rope(m, scene_at(0, 0.44, -0.10), scene_at(0, 0.75, -0.28), 0.08, 0.022, 4 + fine, 4 + fine);
    for (int side = -1; arms && side < 2; side += 2) {
        scene_mesh_rope(m, scene_at(side * 0.22, 0.45, 0), scene_at(side * 0.27, 0.655, 0), 0.01, 0.016, 3 + fine, 4 + fine);
        cushion_at(m, scene_at(side * 0.27, 0.66, -0.02), scene_at(0.065, 0.035, 0.27), 0, fine);
    }
}

void scene_armchair(scene_mesh *m, const scene_office_palette *p, unsigned cloth, double width, unsigned fine)
{
    unsigned seats = width > 1.2 ? (unsigned)(width / 0.62) : 1;
    double inner = width - 0.36;
    m->material = p->black;
    for (int i = 0; i < 4; i++)
        block(m, (i & 1 ? 0.5 : -0.5) * (width - 0.14), 0, i & 2 ? 0.33 : -0.33, 0.05, 0.10, 0.05, SCENE_FACES_AROUND);
    m->material = p->cloth[cloth % 3];
    block(m, 0, 0.10, 0, inner + 0.1, 0.16, 0.76, SCENE_FACES_ALL);
    for (int side = -1; side < 2; side += 2)
        cushion_at(m, scene_at(side * (width - 0.18) / 2, 0.35, 0), scene_at(0.19, 0.52, 0.82), 0, fine);
    cushion_at(m, scene_at(0, 0.50, -0.36), scene_at(width - 0.2, 0.72, 0.20), -0.02, fine);
    for (unsigned i = 0; i < seats; i++)
        cushion_at(m, scene_at(inner * ((i + 0.5) / seats - 0.5), 0.34, 0.06), scene_at(inner / seats - 0.01, 0.18, 0.66), 0,
            fine);
}

void scene_desk(scene_mesh *m, const scene_office_palette *p, double width, double depth)
{
    double w = width / 2, d = depth / 2;
    m->material = p->wood[1];
    block(m, 0, 0.71, 0, width, 0.03, depth, SCENE_FACES_ALL);
    block(m, -w + 0.03, 0, 0, 0.03, 0.71, depth - 0.06, SCENE_FACES_AROUND);
    block(m, 0, 0.25, -d + 0.08, width - 0.10, 0.46, 0.02, SCENE_FACES_AROUND | SCENE_FACE_BOTTOM);
    scene_mesh_box(m, scene_at(w - 0.46, 0.05, -d + 0.10), scene_at(w - 0.03, 0.71, d - 0.05),
        SCENE_FACES_ALL & ~(unsigned)SCENE_FACE_TOP);
    for (int i = 0; i < 3; i++) {
        double y = 0.08 + 0.21 * i;
        m->material = p->wood[0];
        scene_mesh_box(m, scene_at(w - 0.45, y, d - 0.05), scene_at(w - 0.04, y + 0.19, d - 0.03), SCENE_FACES_NO_BACK);
        m->material = p->steel;
        scene_mesh_beam(m, scene_at(w - 0.31, y + 0.10, d - 0.015), scene_at(w - 0.18, y + 0.10, d - 0.015), 0.012, 0.012, 1);
    }
}

static void keyboard(scene_mesh *m, const scene_office_palette *p)
{
    m->material = p->plastic;
    block(m, 0, 0, 0.20, 0.44, 0.018, 0.15, SCENE_FACES_STANDING);
    m->material = p->paper[0];
    for (int row = 0; row < 6; row++)
        for (int key = 0; key < 14; key++) {
            double x = -0.205 + 0.029 * key + 0.004 * (row % 3), z = 0.142 + 0.023 * row;
            scene_mesh_box(m, scene_at(x, 0.018, z), scene_at(x + 0.024, 0.026, z + 0.018), SCENE_FACES_STANDING);
        }
}

void scene_computer(scene_mesh *m, const scene_office_palette *p, unsigned fine)
{
    const scene_profile foot[] = {{0.12, 0}, {0.12, 0.012}, {0.03, 0.022}, {0.025, 0.12}, {0, 0.12}};
    m->material = p->plastic;
    scene_mesh_lathe(m, foot, COUNT_OF(foot), 6 + 2 * fine);
    scene_frame before = scene_mesh_enter(m, 0, 0.29, 0.02, 0);
    scene_mesh_pitch(m, -0.015);
    block(m, 0, -0.18, 0, 0.46, 0.36, 0.04, SCENE_FACES_ALL);
    block(m, 0, -0.12, -0.05, 0.30, 0.24, 0.06, SCENE_FACES_ALL);
    scene_mesh_enter(m, 0, 0, 0.021, 0);
    scene_picture(m, 0.44, 0.34, p->black, p->screen);
    m->frame = before;
    keyboard(m, p);
    m->material = p->plastic;
    scene_mesh_enter(m, 0.30, 0.014, 0.20, 0);
    scene_cushion(m, 0.06, 0.03, 0.10, 4 + 2 * fine, 2 + 2 * fine);
    m->frame = before;
}

void scene_desk_lamp(scene_mesh *m, const scene_office_palette *p, unsigned fine)
{
    const scene_profile foot[] = {{0.09, 0}, {0.09, 0.02}, {0.02, 0.03}, {0, 0.035}};
    const scene_profile hood[] = {{0.085, 0}, {0.075, 0.05}, {0.03, 0.10}, {0.02, 0.14}, {0, 0.145}};
    const scene_profile inside[] = {{0, 0.08}, {0.03, 0.07}, {0.085, 0}};
    unsigned sides = 6 + 3 * fine;
    m->material = p->steel;
    scene_mesh_lathe(m, foot, COUNT_OF(foot), sides);
    for (int i = -1; i < 2; i += 2) {
        scene_mesh_beam(m, scene_at(0.012 * i, 0.03, 0), scene_at(0.012 * i, 0.30, -0.12), 0.008, 0.008, 1);
        scene_mesh_beam(m, scene_at(0.012 * i, 0.30, -0.12), scene_at(0.012 * i, 0.46, 0.10), 0.008, 0.008, 1);
    }
    scene_frame before = scene_mesh_enter(m, 0, 0.37, 0.13, 0);
    scene_mesh_pitch(m, -0.05);
    m->material = p->cloth[1];
    scene_mesh_lathe(m, hood, COUNT_OF(hood), sides);
    m->material = p->lamp;
    scene_mesh_lathe(m, inside, COUNT_OF(inside), sides);
    m->frame = before;
}

void scene_telephone(scene_mesh *m, const scene_office_palette *p, unsigned fine)
{
    m->material = p->black;
    block(m, 0, 0, 0, 0.20, 0.035, 0.20, SCENE_FACES_STANDING);
    m->material = p->paper[0];
    for (int k = 0; k < 12; k++)
        block(m, 0.01 + 0.026 * (k % 3), 0.035, -0.05 + 0.026 * (k / 3), 0.018, 0.008, 0.018, SCENE_FACES_STANDING);
    m->material = p->black;
    scene_point arc[13];
    for (int i = 0; i < 13; i++) {
        double t = i / 6.0 - 1.0;
        arc[i] = scene_at(-0.065, 0.075 - 0.025 * t * t, 0.10 * t);
    }
    scene_mesh_pipe(m, arc, 13, 0.014, 4 + fine);
    cushion_at(m, scene_at(-0.065, 0.045, 0.09), scene_at(0.05, 0.035, 0.055), 0, fine);
    cushion_at(m, scene_at(-0.065, 0.045, -0.09), scene_at(0.05, 0.035, 0.055), 0, fine);
}

void scene_papers(scene_mesh *m, const scene_office_palette *p, unsigned sheets)
{
    for (unsigned i = 0; i < sheets; i++) {
        double x = scene_mesh_random(m, -0.015, 0.015), z = scene_mesh_random(m, -0.015, 0.015), turn = scene_mesh_random(m,
            -0.015, 0.015);
        scene_frame before = scene_mesh_enter(m, x, 0.002 * i, z, turn);
        m->material = p->paper[i % 8 == 7 ? 1 : 0];
        block(m, 0, 0, 0, 0.21, 0.0015, 0.297, SCENE_FACES_STANDING);
        m->frame = before;
    }
    m->material = p->pen;
    scene_mesh_beam(m, scene_at(-0.05, 0.002 * sheets + 0.005, -0.06), scene_at(0.04, 0.002 * sheets + 0.005, 0.05), 0.008,
        0.008, 1);
}

void scene_cup(scene_mesh *m, const scene_office_palette *p, unsigned fine)
{
    static const scene_profile saucer[] = {{0, 0}, {0.04, 0}, {0.075, 0.015}, {0.073, 0.018}, {0.035, 0.005}, {0, 0.005}};
    static const scene_profile cup[] = {{0.022, 0.006}, {0.030, 0.02}, {0.038, 0.065}, {0.036, 0.065}, {0.032, 0.05}, {0, 0.05}};
    unsigned sides = 6 + 4 * fine;
    m->material = p->paper[0];
    scene_mesh_lathe(m, saucer, COUNT_OF(saucer), sides);
    scene_mesh_lathe(m, cup, 5, sides);
    m->material = p->wood[0];
    scene_mesh_lathe(m, cup + 4, 2, sides);
    m->material = p->paper[0];
    scene_point handle[9];
    for (int i = 0; i < 9; i++) {
        double c, s;
        scene_direction(-0.25 + i / 16.0, &c, &s);
        handle[i] = scene_at(0.033 + 0.022 * c, 0.038 + 0.018 * s, 0);
    }
    scene_mesh_pipe(m, handle, 9, 0.004, 3 + fine);
}
