#include "scene/builtin/furniture.h"

#include <math.h>

#define COUNT_OF(a) (sizeof(a) / sizeof *(a))

/* Square legs at the four corners of a rectangle about the origin, seen on four sides. */
static void legs(scene_mesh *m, double half_x, double half_z, double thick, double height)
{
    for (int i = 0; i < 4; i++) {
        double x = i & 1 ? half_x - thick : -half_x, z = i & 2 ? half_z - thick : -half_z;
        scene_mesh_box(m, scene_at(x, 0, z), scene_at(x + thick, height, z + thick), SCENE_FACES_AROUND);
    }
}

void scene_table(scene_mesh *m, double width, double depth, double height)
{
    legs(m, width / 2 - 0.05, depth / 2 - 0.05, 0.06, height - 0.04);
    scene_mesh_box(m, scene_at(-width / 2, height - 0.04, -depth / 2), scene_at(width / 2, height, depth / 2),
        SCENE_FACES_ALL);
}

void scene_round_table(scene_mesh *m, double radius, double height, unsigned sides)
{
    const scene_profile outline[] = {{0.30, 0}, {0.30, 0.03}, {0.12, 0.07}, {0.06, 0.14}, {0.05, 0.28}, {0.08, 0.36},
        {0.05, 0.44}, {0.05, height - 0.10}, {0.14, height - 0.05}, {radius - 0.03, height - 0.045},
        {radius, height - 0.03}, {radius, height - 0.008}, {radius - 0.01, height}, {0, height}};
    scene_mesh_lathe(m, outline, COUNT_OF(outline), sides);
}

void scene_chair(scene_mesh *m)
{
    for (int i = 0; i < 4; i++) { /* the hind legs go on as posts of the back */
        double x = i & 1 ? 0.17 : -0.21, z = i & 2 ? 0.17 : -0.21;
        scene_mesh_box(m, scene_at(x, 0, z), scene_at(x + 0.04, i & 2 ? 0.44 : 0.95, z + (i & 2 ? 0.04 : 0.03)),
            i & 2 ? SCENE_FACES_AROUND : SCENE_FACES_STANDING);
    }
    scene_mesh_box(m, scene_at(-0.22, 0.44, -0.19), scene_at(0.22, 0.47, 0.22), SCENE_FACES_ALL);
    scene_mesh_box(m, scene_at(-0.17, 0.70, -0.20), scene_at(0.17, 0.90, -0.185),
        SCENE_FACES_ALL & ~(unsigned)(SCENE_FACE_LEFT | SCENE_FACE_RIGHT));
}

/* A turned stick from a to b, thicker in its middle: 6 * sides. */
static void stick(scene_mesh *m, scene_point a, scene_point b, double radius, unsigned sides)
{
    double dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z;
    double length = sqrt(dx * dx + dy * dy + dz * dz);
    const scene_profile outline[] = {{0.7 * radius, 0}, {radius, 0.35 * length}, {0.8 * radius, 0.7 * length},
        {0.6 * radius, length}};
    /* a shear instead of a turn: sticks stand nearly upright, and their ends stay level with seat and floor */
    scene_frame before = m->frame;
    scene_frame *f = &m->frame;
    f->origin = scene_at(f->origin.x + f->x.x * a.x + f->y.x * a.y + f->z.x * a.z,
        f->origin.y + f->x.y * a.x + f->y.y * a.y + f->z.y * a.z,
        f->origin.z + f->x.z * a.x + f->y.z * a.y + f->z.z * a.z);
    f->y = scene_at((before.x.x * dx + before.y.x * dy + before.z.x * dz) / length,
        (before.x.y * dx + before.y.y * dy + before.z.y * dz) / length,
        (before.x.z * dx + before.y.z * dy + before.z.z * dz) / length);
    scene_mesh_lathe(m, outline, COUNT_OF(outline), sides);
    m->frame = before;
}

void scene_spindle_chair(scene_mesh *m, unsigned spindles, unsigned sides)
{
    static const double foot[4][2] = {{-0.21, -0.22}, {0.21, -0.22}, {-0.20, 0.20}, {0.20, 0.20}};
    static const scene_profile seat[] = {{0, 0.43}, {0.19, 0.435}, {0.225, 0.45}, {0.225, 0.465}, {0.20, 0.475}, {0,
        0.465}};
    for (int i = 0; i < 4; i++)
        stick(m, scene_at(foot[i][0], 0, foot[i][1]), scene_at(foot[i][0] * 0.7, 0.44, foot[i][1] * 0.7), 0.018, sides);
    scene_mesh_lathe(m, seat, COUNT_OF(seat), 2 * sides);
    scene_point rail[9];
    for (int i = 0; i < 9; i++) {
        double c, s;
        scene_direction(0.5 + (i + 0.5) / 9.0 * 0.5, &c, &s);
        rail[i] = scene_at(0.21 * c, 0.90, 0.21 * s - 0.03);
    }
    for (unsigned i = 0; i < spindles; i++) {
        double c, s;
        scene_direction(0.53 + 0.44 * i / (spindles - 1), &c, &s);
        stick(m, scene_at(0.185 * c, 0.465, 0.185 * s), scene_at(0.21 * c, 0.90, 0.21 * s - 0.03), 0.011, sides);
    }
    scene_mesh_pipe(m, rail, COUNT_OF(rail), 0.018, sides);
}

void scene_stool(scene_mesh *m, double height, unsigned sides)
{
    const scene_profile outline[] = {{0.20, 0}, {0.20, 0.02}, {0.07, 0.05}, {0.03, 0.10}, {0.025, 0.28}, {0.035, 0.30},
        {0.025, 0.32}, {0.03, height - 0.12}, {0.10, height - 0.08}, {0.17, height - 0.07}, {0.18, height - 0.04},
        {0.16, height}, {0, height + 0.01}};
    scene_mesh_lathe(m, outline, COUNT_OF(outline), sides);
    scene_frame before = scene_mesh_enter(m, 0, 0.30, 0, 0);
    scene_mesh_torus(m, 0.15, 0.010, sides, 3);
    m->frame = before;
    scene_mesh_beam(m, scene_at(-0.15, 0.30, 0), scene_at(0.15, 0.30, 0), 0.012, 0.012, 0);
}

unsigned scene_books(scene_mesh *m, double width, double height, double depth, unsigned count, const uint32_t *shades,
    unsigned shade_count)
{
    double x = 0;
    unsigned placed = 0;
    for (unsigned i = 0; i < count; i++) {
        double thick = scene_mesh_random(m, 0.018, 0.055), tall = scene_mesh_random(m, 0.68, 0.97) * height;
        double deep = scene_mesh_random(m, 0.75, 1.0) * depth, shade = scene_mesh_random(m, 0, shade_count);
        if (x + thick > width)
            break;
        m->material = shades[(unsigned)shade];
        scene_mesh_box(m, scene_at(x, 0, -depth), scene_at(x + thick, tall, deep - depth),
            SCENE_FACES_STANDING & SCENE_FACES_NO_BACK);
        x += thick + 0.001;
        placed++;
    }
    return placed;
}

/* Outlines in shares of the widest radius and the height, upwards on the outside, then down on the inside. */
static const scene_profile bottle[] = {{0, 0}, {0.94, 0}, {1, 0.03}, {1, 0.56}, {0.82, 0.66}, {0.36, 0.78}, {0.34,
    0.93},
    {0.42, 0.94}, {0.40, 1}, {0, 1}};
static const scene_profile flask[] = {{0.6, 0}, {0.9, 0.10}, {1, 0.28}, {0.8, 0.50}, {0.3, 0.66}, {0.26, 0.92},
    {0.36, 1}, {0, 1.0}};
static const scene_profile glass[] = {{0.80, 0}, {1, 1}, {0.94, 1}, {0.76, 0.08}, {0, 0.08}};
static const scene_profile goblet[] = {{0.8, 0}, {0.75, 0.04}, {0.14, 0.10}, {0.12, 0.45}, {0.6, 0.55}, {1, 0.75},
    {0.9, 1},
    {0.84, 1}, {0, 0.6}};
static const scene_profile vase[] = {{0.5, 0}, {0.55, 0.04}, {0.85, 0.22}, {1, 0.42}, {0.8, 0.66}, {0.45, 0.82},
    {0.5, 0.92},
    {0.7, 1}, {0.64, 1}, {0.36, 0.82}};
static const scene_profile barrel[] = {{0.80, 0}, {0.85, 0.08}, {0.88, 0.08}, {0.90, 0.14}, {0.87, 0.14}, {0.98, 0.36},
    {1.0, 0.36}, {1.01, 0.42}, {0.99, 0.42}, {0.99, 0.58}, {0.90, 0.86}, {0.92, 0.86}, {0.80, 1}, {0.76, 0.97}};
static const scene_profile pot[] = {{0.66, 0}, {0.92, 0.80}, {1, 0.80}, {1, 1}, {0.90, 1}, {0.88, 0.90}, {0, 0.94}};
static const scene_profile candle[] = {{1, 0}, {1, 0.85}, {0.25, 0.86}, {0.45, 0.91}, {0, 1}};
static const scene_profile shade[] = {{1, 0}, {0.6, 1}, {0.58, 1}, {0.97, 0}};

void scene_ware_draw(scene_mesh *m, scene_ware ware, double radius, double height, unsigned sides)
{
    static const struct {
        const scene_profile *points;
        size_t count;
    } outline[] = {
        [SCENE_WARE_BOTTLE] = {bottle, COUNT_OF(bottle)},
        [SCENE_WARE_FLASK] = {flask, COUNT_OF(flask)},
        [SCENE_WARE_GLASS] = {glass, COUNT_OF(glass)},
        [SCENE_WARE_GOBLET] = {goblet, COUNT_OF(goblet)},
        [SCENE_WARE_VASE] = {vase, COUNT_OF(vase)},
        [SCENE_WARE_BARREL] = {barrel, COUNT_OF(barrel)},
        [SCENE_WARE_POT] = {pot, COUNT_OF(pot)},
        [SCENE_WARE_CANDLE] = {candle, COUNT_OF(candle)},
        [SCENE_WARE_SHADE] = {shade, COUNT_OF(shade)},
    };
    scene_profile scaled[16];
    size_t count = outline[ware].count;
    for (size_t i = 0; i < count; i++)
        scaled[i] = (scene_profile){outline[ware].points[i].out * radius, outline[ware].points[i].up * height};
    scene_mesh_lathe(m, scaled, count, sides);
}

void scene_leaves(scene_mesh *m, unsigned count, double half_width, double half_height, double leaf)
{
    for (unsigned i = 0; i < count; i++) {
        double around = scene_mesh_random(m, 0, 1), up = scene_mesh_random(m, -1, 1);
        double out = scene_mesh_random(m, 0.45, 1.0), size = scene_mesh_random(m, 0.7, 1.2) * leaf;
        double tilt = scene_mesh_random(m, -0.08, 0.16), twist = scene_mesh_random(m, -0.08, 0.08);
        double ring = sqrt(1.0 - up * up) * out, c, s;
        scene_direction(around, &c, &s);
        scene_frame before = scene_mesh_enter(m, ring * s * half_width, up * out * half_height, ring * c * half_width,
            around);
        scene_mesh_pitch(m, tilt);
        scene_mesh_roll(m, twist);
        /* stalk, tip, and the edge's two ends, a little higher than the midrib: a thin closed shape */
        scene_point stalk = {0, 0, 0}, tip = {0, -0.10 * size, size};
        scene_point left = {-0.26 * size, 0.06 * size, 0.42 * size}, right = {0.26 * size, 0.06 * size, 0.45 * size};
        scene_mesh_triangle(m, stalk, left, right);
        scene_mesh_triangle(m, left, tip, right);
        scene_mesh_triangle(m, stalk, tip, left);
        scene_mesh_triangle(m, stalk, right, tip);
        m->frame = before;
    }
}

void scene_pebbles(scene_mesh *m, size_t triangles, double x0, double z0, double x1, double z1, double size)
{
    while (triangles >= 6 && m->status == BASE_OK) {
        /* six, four or three sides; the last ones so that nothing is left over */
        double pick = scene_mesh_random(m, 4, 6.999);
        unsigned sides = (unsigned)pick;
        if (triangles < 24)
            sides = triangles > 12 ? 3 : (unsigned)(triangles / 2);
        double x = scene_mesh_random(m, x0, x1), z = scene_mesh_random(m, z0, z1);
        double big = scene_mesh_random(m, 0.5, 1.3) * size, flat = scene_mesh_random(m, 0.5, 0.9);
        double turn = scene_mesh_random(m, 0, 1);
        const scene_profile outline[] = {{0, -0.2 * flat * big}, {big, 0.3 * flat * big}, {0, flat * big}};
        scene_frame before = scene_mesh_enter(m, x, 0, z, turn);
        scene_mesh_lathe(m, outline, COUNT_OF(outline), sides);
        m->frame = before;
        triangles -= 2 * (size_t)sides;
    }
}

static scene_point cloth_place(const void *user, double u, double v)
{
    const scene_cloth *c = user;
    double wave, other, cosine;
    scene_direction(u * c->folds, &cosine, &wave);
    scene_direction(u * c->folds * 0.37 + 0.2 * v, &cosine, &other);
    /* v runs from the lower edge up: folds open out downwards, the middle is drawn up */
    double down = (1.0 - v) * (c->drop - c->swag * 4.0 * u * (1.0 - u));
    double z = c->billow * (0.35 + 0.65 * (1.0 - v)) * (0.7 * wave + 0.3 * other);
    return scene_at((u - 0.5) * c->width, -down, z);
}

void scene_cloth_draw(scene_mesh *m, const scene_cloth *cloth)
{
    scene_mesh_fabric(m, cloth->across, cloth->along, cloth_place, cloth, scene_at(0, 0, 0.002));
}

void scene_chandelier(scene_mesh *m, double drop, double radius, unsigned spokes, unsigned sides,
    uint32_t candles)
{
    uint32_t metal = m->material;
    const scene_profile hub[] = {{0, -0.08}, {0.06, -0.05}, {0.09, 0}, {0.06, 0.05}, {0.03, 0.12}, {0.05, 0.16},
        {0.012, 0.20}};
    scene_frame before = scene_mesh_enter(m, 0, -drop, 0, 0);
    scene_mesh_lathe(m, hub, COUNT_OF(hub), sides);
    scene_mesh_torus(m, radius, 0.035, 4 * sides, 6);
    scene_mesh_torus(m, radius * 0.45, 0.018, 3 * sides, 4);
    scene_point chain[2] = {{0, 0.19, 0}, {0, drop, 0}};
    scene_mesh_pipe(m, chain, 2, 0.012, 5);
    for (unsigned i = 0; i < spokes; i++) {
        scene_frame wheel = scene_mesh_enter(m, 0, 0, 0, (double)i / spokes);
        scene_mesh_beam(m, scene_at(0, 0, 0.07), scene_at(0, 0, radius - 0.02), 0.03, 0.02, 0);
        scene_mesh_rope(m, scene_at(0, 0.45, 0.012), scene_at(0, 0.03, radius), 0.08, 0.006, 5, 3);
        scene_mesh_enter(m, 0, 0.03, radius, 0);
        const scene_profile dish[] = {{0, 0}, {0.03, 0.005}, {0.055, 0.025}, {0.05, 0.026}, {0.025, 0.01}};
        scene_mesh_lathe(m, dish, COUNT_OF(dish), sides);
        scene_mesh_enter(m, 0, 0.008, 0, 0);
        m->material = candles;
        scene_ware_draw(m, SCENE_WARE_CANDLE, 0.018, 0.14, 6);
        m->material = metal;
        m->frame = wheel;
    }
    m->frame = before;
}

void scene_picture(scene_mesh *m, double width, double height, uint32_t frame, uint32_t canvas)
{
    double w = width / 2, h = height / 2, edge = 0.06;
    /* three rectangles, counter-clockwise: on the wall, the frame's outer edge, the canvas */
    const double inset[3] = {0, 0, edge}, proud[3] = {0, 0.035, 0.015};
    scene_point corner[3][5];
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 5; i++) {
            int right = i % 4 == 1 || i % 4 == 2, top = i % 4 >= 2;
            corner[k][i] = scene_at(right ? w - inset[k] : inset[k] - w, top ? h - inset[k] : inset[k] - h, proud[k]);
        }
    m->material = frame;
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 4; i++)
            scene_mesh_quad(m, corner[k][i], corner[k][i + 1], corner[k + 1][i + 1], corner[k + 1][i]);
    m->material = canvas;
    scene_mesh_quad(m, corner[2][0], corner[2][1], corner[2][2], corner[2][3]);
}
