/* A two-legged reptile of 12 m on stony ground, walking towards +x. Its middle plane is z = 0, y = 0 the ground. */
#include "scene/builtin/furniture.h"
#include "scene/builtin/noise.h"
#include "scene/builtin/scenes.h"
#include "scene/builtin/skin.h"

#define COUNT_OF(a) (sizeof(a) / sizeof *(a))
#define CELL 0.0555 /* of the skin [m] */

typedef struct palette {
    uint32_t back, side, belly, mouth, tooth, claw, eye, pupil, earth, stone[3], grass[2];
} palette;

static palette paint_palette(scene_mesh *m)
{
    palette p;
    p.back = scene_mesh_paint(m, 0.22, 0.20, 0.10);
    p.side = scene_mesh_paint(m, 0.42, 0.36, 0.18);
    p.belly = scene_mesh_paint(m, 0.66, 0.58, 0.40);
    p.mouth = scene_mesh_paint(m, 0.52, 0.20, 0.18);
    p.tooth = scene_mesh_paint(m, 0.88, 0.84, 0.70);
    p.claw = scene_mesh_paint(m, 0.12, 0.10, 0.08);
    p.eye = scene_mesh_paint(m, 0.85, 0.62, 0.12);
    p.pupil = scene_mesh_paint(m, 0.03, 0.03, 0.03);
    p.earth = scene_mesh_paint(m, 0.46, 0.38, 0.27);
    p.stone[0] = scene_mesh_paint(m, 0.48, 0.45, 0.40);
    p.stone[1] = scene_mesh_paint(m, 0.40, 0.37, 0.33);
    p.stone[2] = scene_mesh_paint(m, 0.55, 0.50, 0.42);
    p.grass[0] = scene_mesh_paint(m, 0.30, 0.36, 0.12);
    p.grass[1] = scene_mesh_paint(m, 0.42, 0.40, 0.16);
    return p;
}

/* A ridge wherever `phase` is near a whole number, from 0 to 1. */
static double ridge(double phase)
{
    double c, s;
    scene_direction(phase, &c, &s);
    double half = 0.5 + 0.5 * c;
    return half * half;
}

static double hide(const scene_skin_place *p)
{
    return 0.012 * scene_noise(scene_point_scale(p->at, 5.0));
}

/* Folds across the trunk and its tail: deep on the belly and the throat, ribs on the flanks, knobs along the back. */
static double trunk_relief(const scene_skin_place *p)
{
    double below = p->out.y < 0.0 ? -p->out.y : 0.0, above = p->out.y > 0.8 ? (p->out.y - 0.8) * 5.0 : 0.0;
    double wander = 0.25 * scene_noise(scene_point_scale(p->at, 1.1));
    double fold = 0.045 * below * ridge(p->along / 0.34 + wander), rib = 0.030 * (1.0 - below) * ridge(p->along / 0.52 + wander);
    double knob = 0.10 * above * ridge(p->along / 0.40);
    double size = p->radius < 0.8 ? p->radius / 0.8 : 1.0;
    return size * (fold + rib + knob) + hide(p) * size;
}

static double neck_relief(const scene_skin_place *p)
{
    double below = 0.55 - 0.45 * p->out.y, above = p->out.y > 0.7 ? (p->out.y - 0.7) * 3.3 : 0.0;
    double wander = 0.3 * scene_noise(scene_point_scale(p->at, 1.7));
    return 0.055 * below * ridge(p->along / 0.26 + wander) + 0.07 * above * ridge(p->along / 0.3) + hide(p);
}

static double leg_relief(const scene_skin_place *p)
{
    double bend = ridge((p->share - 0.5) * 0.8), wander = 0.4 * scene_noise(scene_point_scale(p->at, 2.1));
    return 0.030 * bend * ridge(p->along / 0.17 + wander) + hide(p);
}

static double head_relief(const scene_skin_place *p)
{
    double above = p->out.y > 0.2 ? p->out.y : 0.0;
    return 0.030 * above * ridge(p->along / 0.21) + hide(p);
}

static const scene_joint trunk[] = {{{-7.1, 3.75, 0.75}, 0.05}, {{-6.2, 3.45, 0.45}, 0.12}, {{-4.8, 3.15, 0.10}, 0.24},
    {{-3.3, 3.05, 0}, 0.40}, {{-1.8, 3.20, 0}, 0.66}, {{-0.5, 3.35, 0}, 0.95}, {{0.6, 3.22, 0}, 1.08}, {{1.6, 3.35, 0}, 0.98},
    {{2.4, 3.65, 0}, 0.72}};
static const scene_joint neck[] = {{{2.0, 3.55, 0}, 0.76}, {{2.7, 4.15, 0}, 0.54}, {{3.05, 4.75, 0.02}, 0.46},
    {{3.55, 5.15, 0.05}, 0.46}};
static const scene_joint skull[] = {{{3.45, 5.15, 0.05}, 0.46}, {{3.95, 5.24, 0.10}, 0.44}, {{4.45, 5.10, 0.16}, 0.32},
    {{4.95, 5.02, 0.22}, 0.26}, {{5.22, 4.98, 0.25}, 0.20}};
static const scene_joint jaw[] = {{{3.50, 4.90, 0.05}, 0.30}, {{3.95, 4.60, 0.09}, 0.22}, {{4.50, 4.40, 0.16}, 0.17},
    {{4.95, 4.36, 0.21}, 0.13}};
static const scene_joint gape[] = {{{3.85, 4.78, 0.09}, 0.05}, {{4.4, 4.70, 0.15}, 0.13}, {{5.3, 4.66, 0.25}, 0.20}};
static const scene_joint nostril[2][2] = {{{{5.16, 5.12, 0.37}, 0.035}, {{5.22, 5.12, 0.44}, 0.05}},
    {{{5.22, 5.12, 0.13}, 0.035}, {{5.28, 5.12, 0.08}, 0.05}}};
static const scene_joint brow[2][3] = {{{{3.82, 5.50, 0.38}, 0.07}, {{4.02, 5.55, 0.41}, 0.10}, {{4.24, 5.42, 0.36}, 0.06}},
    {{{3.90, 5.50, -0.18}, 0.07}, {{4.10, 5.55, -0.19}, 0.10}, {{4.32, 5.42, -0.10}, 0.06}}};
static const scene_joint leg[2][6] = {
    {{{-0.1, 3.25, 0.45}, 0.62}, {{0.55, 2.60, 0.66}, 0.60}, {{1.10, 1.95, 0.70}, 0.36}, {{0.78, 1.35, 0.68}, 0.27},
        {{0.50, 0.85, 0.66}, 0.19}, {{0.85, 0.22, 0.66}, 0.17}},
    {{{-0.1, 3.25, -0.45}, 0.62}, {{0.15, 2.50, -0.66}, 0.60}, {{0.10, 1.80, -0.70}, 0.36}, {{-0.70, 1.35, -0.68}, 0.27},
        {{-1.40, 1.00, -0.66}, 0.19}, {{-1.45, 0.24, -0.66}, 0.17}}};
static const scene_joint arm[2][4] = {
    {{{2.15, 3.15, 0.48}, 0.20}, {{2.20, 2.78, 0.66}, 0.15}, {{2.55, 2.55, 0.66}, 0.10}, {{2.80, 2.62, 0.60}, 0.08}},
    {{{2.15, 3.15, -0.48}, 0.20}, {{2.25, 2.80, -0.66}, 0.15}, {{2.62, 2.62, -0.66}, 0.10}, {{2.85, 2.74, -0.60}, 0.08}}};

/* The joints of a toe or finger: from a foot forwards, spread by dz, ending at height `tip`. */
static void digit(scene_joint out[3], scene_point from, double length, double dz, double thick, double tip)
{
    out[0] = (scene_joint){from, thick * 1.15};
    out[1] = (scene_joint){scene_at(from.x + 0.5 * length, (from.y + tip) / 2 + 0.35 * thick, from.z + 0.55 * dz), thick};
    out[2] = (scene_joint){scene_at(from.x + length, tip, from.z + dz), thick * 0.75};
}

enum { TOES = 6, FINGERS = 4, DIGITS = TOES + FINGERS };

static void digits(scene_joint out[DIGITS][3])
{
    for (int i = 0; i < TOES; i++) {
        const scene_joint *foot = &leg[i / 3][5];
        digit(out[i], foot->at, i % 3 == 1 ? 0.85 : 0.68, (i % 3 - 1) * 0.36, 0.13, 0.10);
    }
    for (int i = 0; i < FINGERS; i++) {
        const scene_joint *hand = &arm[i / 2][3];
        digit(out[TOES + i], hand->at, 0.20, (i % 2 ? 0.07 : -0.05), 0.052, hand->at.y - 0.16);
    }
}

static uint32_t hide_colour(const void *user, scene_point at)
{
    const palette *p = user;
    /* the middle line rises from the hips to the head */
    double height = at.y - 3.2 - (at.x > 2.0 ? (at.x - 2.0) * 0.75 : at.x < -3.0 ? (at.x + 3.0) * -0.05 : 0.0);
    double mottle = 0.5 * scene_noise_sum(scene_point_scale(at, 1.6), 2);
    if (at.x > 3.75 && at.y > 4.45 && at.y < 4.86 && at.z > -0.1 && at.z < 0.36)
        return p->mouth;
    if (at.x > -6.0 && at.x < 3.75 && at.y > 1.5 && fabs(at.z) < 0.5 && height < -0.55 + 0.3 * mottle)
        return p->belly;
    return height + 0.6 * mottle > 0.35 ? p->back : p->side;
}

static void body(scene_mesh *m, const palette *p)
{
    scene_joint toe[DIGITS][3];
    scene_limb limbs[32];
    size_t n = 0;
    digits(toe);
    limbs[n++] = (scene_limb){trunk, COUNT_OF(trunk), 0.74, 0.10, 0, trunk_relief, 0.20};
    limbs[n++] = (scene_limb){neck, COUNT_OF(neck), 0.78, 0.45, 0, neck_relief, 0.16};
    for (int i = 0; i < 2; i++)
        limbs[n++] = (scene_limb){leg[i], COUNT_OF(leg[i]), 0.80, 0.30, 0, leg_relief, 0.05};
    for (int i = 0; i < 2; i++)
        limbs[n++] = (scene_limb){arm[i], COUNT_OF(arm[i]), 1.0, 0.16, 0, hide, 0.012};
    for (int i = 0; i < DIGITS; i++)
        limbs[n++] = (scene_limb){toe[i], 3, 1.0, i < TOES ? 0.10 : 0.05, 0, NULL, 0};
    limbs[n++] = (scene_limb){skull, COUNT_OF(skull), 0.78, 0.25, 0, head_relief, 0.05};
    limbs[n++] = (scene_limb){jaw, COUNT_OF(jaw), 0.95, 0.12, 0, head_relief, 0.05};
    limbs[n++] = (scene_limb){gape, COUNT_OF(gape), 1.6, 0.06, 1, NULL, 0};
    for (int i = 0; i < 2; i++) {
        limbs[n++] = (scene_limb){brow[i], COUNT_OF(brow[i]), 1.0, 0.12, 0, NULL, 0};
        limbs[n++] = (scene_limb){nostril[i], COUNT_OF(nostril[i]), 1.0, 0.04, 1, NULL, 0};
    }
    scene_skin_draw(m, limbs, n, CELL, hide_colour, p);
}

/* A curved horn from a base towards -y of the current frame. */
static void fang(scene_mesh *m, scene_point at, double length, double radius, double lean)
{
    const scene_profile outline[] = {{0, -length}, {0.55 * radius, -0.6 * length}, {radius, 0.05 * length}, {0, 0.12 * length}};
    scene_frame before = scene_mesh_enter(m, at.x, at.y, at.z, 0);
    scene_mesh_roll(m, lean);
    scene_mesh_lathe(m, outline, COUNT_OF(outline), 7);
    m->frame = before;
}

static void teeth(scene_mesh *m, const palette *p)
{
    m->material = p->tooth;
    for (int i = 0; i < 26; i++) { /* along both sides of the upper jaw, then of the lower */
        double t = (i / 2) / 12.0, side = i % 2 ? 1.0 : -1.0, size = 0.7 + 0.6 * ridge(t * 2.2);
        double x = 4.10 + 1.10 * t, wide = 0.27 - 0.11 * t;
        fang(m, scene_at(x, 4.90 + 0.02 * t, 0.11 + 0.14 * t + side * wide), 0.17 * size, 0.036, 0);
        if (i < 22)
            fang(m, scene_at(4.06 + 0.92 * t, 4.60 - 0.10 * t, 0.10 + 0.12 * t + side * (wide - 0.06)), -0.12 * size, 0.030, 0);
    }
}

static void eyes_and_claws(scene_mesh *m, const palette *p)
{
    static const scene_profile ball[] = {{0, -1}, {0.7, -0.7}, {1, 0}, {0.7, 0.7}, {0, 1}};
    scene_profile eye[COUNT_OF(ball)], pupil[COUNT_OF(ball)];
    scene_joint toe[DIGITS][3];
    for (size_t i = 0; i < COUNT_OF(ball); i++) {
        eye[i] = (scene_profile){0.085 * ball[i].out, 0.085 * ball[i].up};
        pupil[i] = (scene_profile){0.028 * ball[i].out, 0.05 * ball[i].up};
    }
    for (int i = 0; i < 2; i++) {
        scene_frame before = scene_mesh_enter(m, 4.05, 5.42, i ? -0.20 : 0.42, 0);
        m->material = p->eye;
        scene_mesh_lathe(m, eye, COUNT_OF(eye), 16);
        scene_mesh_enter(m, 0.025, 0, i ? -0.066 : 0.066, 0);
        m->material = p->pupil;
        scene_mesh_lathe(m, pupil, COUNT_OF(pupil), 8);
        m->frame = before;
    }
    digits(toe);
    m->material = p->claw;
    for (int i = 0; i < DIGITS; i++)
        fang(m, toe[i][2].at, i < TOES ? 0.26 : 0.12, i < TOES ? 0.07 : 0.03, i < TOES ? 0.19 : 0.1);
}

static scene_point ground_place(const void *user, double u, double v)
{
    (void)user;
    double x = (u - 0.5) * 44.0, z = (0.5 - v) * 44.0;
    double far = (x * x + z * z) / 300.0, under = x * x + z * z < 30.0 ? 0.0 : 1.0;
    double hill = 0.10 * scene_noise_sum(scene_at(x * 0.35, 0.3, z * 0.35), 3);
    /* flat under the feet, rising outwards */
    return scene_at(x, -0.02 + under * hill * (1.0 - 30.0 / (x * x + z * z + 1.0)) + 0.22 * far, z);
}

static void ground(scene_mesh *m, const palette *p)
{
    m->material = p->earth;
    scene_mesh_sheet(m, 44, 44, ground_place, NULL);
    for (int i = 0; i < 60; i++) {
        double x = scene_mesh_random(m, -9, 9), z = scene_mesh_random(m, -9, 9), shade = scene_mesh_random(m, 0, 3);
        m->material = p->stone[(unsigned)shade];
        double size = scene_mesh_random(m, 0.08, 0.30);
        scene_frame before = scene_mesh_enter(m, x, 0, z, 0);
        scene_pebbles(m, 24, -0.2, -0.2, 0.2, 0.2, size);
        scene_mesh_enter(m, 0.3, 0.05, 0.2, 0);
        m->material = p->grass[i % 2];
        if (x * x + z * z > 6.0)
            scene_leaves(m, 9, 0.06, 0.10, 0.30);
        m->frame = before;
    }
    m->material = p->stone[1];
    if (m->target->triangle_count < SCENE_CREATURE_TRIANGLES)
        scene_pebbles(m, SCENE_CREATURE_TRIANGLES - m->target->triangle_count, -8, -8, 8, 8, 0.07);
}

base_status scene_build_creature(scene *s, base_error *err)
{
    scene_mesh m = scene_mesh_begin(s, 69, err);
    palette p = paint_palette(&m);
    body(&m, &p);
    teeth(&m, &p);
    eyes_and_claws(&m, &p);
    ground(&m, &p);
    base_status status = scene_mesh_end(&m, SCENE_CREATURE_TRIANGLES);
    const double eye[3] = {7.6, 5.0, 10.0}, target[3] = {0.3, 2.4, 0}, up[3] = {0, 1, 0};
    /* About three degrees wide from below: the MFT paper names no size, and its counts call for narrow lights (docs/reports.md). */
    s->light = (scene_light){.has_area = 1, .corner = {4.15, 13, 4.15}, .u = {0.7, 0, 0}, .v = {0, 0, 0.7}};
    return status != BASE_OK ? status : scene_add_camera(s, scene_camera_look_at("main", eye, target, up, 0.92), err);
}
