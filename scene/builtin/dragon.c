/* A sculpted dragon of Asian kind, 5 m long, on a base of rock: a body in coils, four legs, mane, horns, whiskers, and all of its
 * skin in scales. The figure is one closed surface of some seven million triangles. It faces +x; y = 0 is the ground. */
#include "scene/builtin/furniture.h"
#include "scene/builtin/noise.h"
#include "scene/builtin/scenes.h"
#include "scene/builtin/skin.h"

#define COUNT_OF(a) (sizeof(a) / sizeof *(a))
#define CELL 0.002422 /* of the figure's skin [m] */

/* The height of overlapping scales, 0 to 1, in a lattice of unit cells; u runs from a scale's root to its tip. */
static double scale_pattern(double u, double v)
{
    double best = 0;
    for (int row = 0; row < 2; row++) {
        double up = u - floor(u / 2.0) * 2.0 - row - 0.5, side = v + 0.5 * row - floor(v + 0.5 * row) - 0.5;
        up -= up > 1.0 ? 2.0 : up < -1.0 ? -2.0 : 0.0;
        /* rising to the tip, then a step down onto the next one */
        double inside = 1.0 - (4.0 * side * side + (up < 0.0 ? 0.6 : 1.0) * up * up);
        double height = inside > 0.0 ? (0.45 + 0.4 * up) * (inside < 0.25 ? 4.0 * inside : 1.0) : 0.0;
        best = fmax(best, height);
    }
    return best;
}

/* Scales on back and flanks, broad plates across the belly. */
static double body_relief(const scene_skin_place *p)
{
    double around = scene_skin_around(p->out), size = p->radius / 0.26;
    double below = p->out.y < -0.45 ? fmin((-0.45 - p->out.y) * 8.0, 1.0) : 0.0, c, s;
    double scales = 0.0085 * size * scale_pattern(p->along / 0.030, around * 9.0);
    scene_direction(p->along / 0.055, &c, &s);
    double plates = 0.007 * size * (0.5 + 0.5 * c);
    return scales * (1.0 - below) + plates * below - 0.0035;
}

static double limb_relief(const scene_skin_place *p)
{
    return 0.05 * p->radius * (scale_pattern(p->along / 0.022, scene_skin_around(p->out) * 5.0) - 0.42);
}

/* Strands that run along a lock of hair, a fin, a flame. */
static double hair_relief(const scene_skin_place *p)
{
    double c, s;
    scene_direction(scene_skin_around(p->out) * 1.5 + 0.8 * p->share, &c, &s);
    return p->radius * 0.12 * c;
}

static double horn_relief(const scene_skin_place *p)
{
    double c, s;
    scene_direction(p->along / 0.016, &c, &s);
    return p->radius * 0.07 * c * (1.0 - p->share);
}

static double face_relief(const scene_skin_place *p)
{
    return 0.0035 * scene_noise_sum(scene_point_scale(p->at, 28.0), 3);
}

static double rock_relief(const scene_skin_place *p)
{
    double n = scene_noise_sum(scene_point_scale(p->at, 5.0), 6), ledge = n - floor(n * 4.0) / 4.0;
    return 0.05 * n - 0.03 * ledge;
}

static const scene_joint body[] = {{{-2.45, 1.30, -0.30}, 0.02}, {{-2.25, 1.05, -0.10}, 0.055}, {{-1.90, 0.72, 0.18}, 0.09},
    {{-1.50, 0.75, 0.32}, 0.13}, {{-1.15, 1.05, 0.18}, 0.16}, {{-0.85, 1.22, -0.15}, 0.19}, {{-0.50, 1.00, -0.36}, 0.215},
    {{-0.10, 0.72, -0.25}, 0.24}, {{0.30, 0.78, 0.10}, 0.255}, {{0.62, 1.10, 0.26}, 0.245}, {{0.85, 1.45, 0.12}, 0.21},
    {{1.05, 1.72, -0.06}, 0.175}, {{1.32, 1.86, -0.06}, 0.155}, {{1.58, 1.84, 0.02}, 0.15}};
static const scene_joint skull[] = {{{1.50, 1.86, 0.02}, 0.165}, {{1.70, 1.90, 0.05}, 0.165}, {{1.90, 1.84, 0.08}, 0.125},
    {{2.10, 1.80, 0.11}, 0.105}, {{2.22, 1.80, 0.125}, 0.095}};
static const scene_joint jaw[] = {{{1.58, 1.76, 0.03}, 0.11}, {{1.78, 1.63, 0.06}, 0.08}, {{2.00, 1.58, 0.09}, 0.065},
    {{2.14, 1.58, 0.11}, 0.05}};
static const scene_joint gape[] = {{{1.74, 1.71, 0.05}, 0.02}, {{1.95, 1.69, 0.08}, 0.045}, {{2.30, 1.68, 0.13}, 0.075}};
static const scene_joint tongue[] = {{{1.72, 1.68, 0.05}, 0.03}, {{1.95, 1.655, 0.085}, 0.03}, {{2.14, 1.69, 0.12}, 0.018},
    {{2.22, 1.74, 0.135}, 0.008}};

/* A limb mirrored about the head's middle plane, which leans a little to +z. */
static scene_joint mirrored(scene_joint j)
{
    double middle = 0.03 + 0.16 * (j.at.x - 1.55);
    j.at.z = 2.0 * middle - j.at.z;
    return j;
}

enum { PAIRS = 5, PAIR_JOINTS = 4, SPINES = 64, MANE = 26, LEGS = 4, TOES = 4, FLAMES = 9 };

/* Of the side of +z: horn, brow, ear, whisker, cheek. */
static const scene_joint face[PAIRS][PAIR_JOINTS] = {
    {{{1.62, 2.02, 0.11}, 0.040}, {{1.50, 2.16, 0.17}, 0.034}, {{1.32, 2.24, 0.22}, 0.024}, {{1.14, 2.36, 0.24}, 0.007}},
    {{{1.66, 2.03, 0.11}, 0.035}, {{1.78, 2.05, 0.16}, 0.042}, {{1.87, 1.98, 0.17}, 0.030}, {{1.92, 1.92, 0.165}, 0.014}},
    {{{1.52, 1.93, 0.16}, 0.040}, {{1.44, 1.98, 0.26}, 0.045}, {{1.34, 2.00, 0.34}, 0.030}, {{1.24, 1.98, 0.40}, 0.008}},
    {{{2.16, 1.78, 0.20}, 0.020}, {{2.26, 1.66, 0.36}, 0.015}, {{2.14, 1.50, 0.50}, 0.012}, {{2.28, 1.30, 0.60}, 0.005}},
    {{{1.62, 1.76, 0.15}, 0.055}, {{1.74, 1.72, 0.17}, 0.045}, {{1.90, 1.77, 0.17}, 0.030}, {{2.06, 1.77, 0.18}, 0.015}}};
static const scene_joint leg[LEGS][4] = {
    {{{0.48, 0.92, 0.34}, 0.15}, {{0.30, 0.78, 0.62}, 0.11}, {{0.60, 0.62, 0.74}, 0.075}, {{0.72, 0.42, 0.72}, 0.06}},
    {{{0.66, 1.10, 0.08}, 0.15}, {{0.86, 0.92, -0.22}, 0.11}, {{1.12, 1.02, -0.30}, 0.075}, {{1.32, 1.16, -0.28}, 0.055}},
    {{{-1.02, 1.10, 0.22}, 0.14}, {{-0.86, 0.92, 0.50}, 0.11}, {{-0.66, 0.66, 0.56}, 0.075}, {{-0.54, 0.40, 0.60}, 0.055}},
    {{{-1.05, 1.10, -0.05}, 0.14}, {{-1.22, 0.80, -0.36}, 0.11}, {{-0.98, 0.56, -0.52}, 0.075}, {{-0.92, 0.34, -0.56}, 0.055}}};

typedef struct figure {
    scene_joint mirror[PAIRS][PAIR_JOINTS], spine[SPINES][2], mane[MANE][4], toe[LEGS][TOES][3], claw[LEGS][TOES][2],
        flame[FLAMES][3];
    scene_limb limbs[16 + 2 * PAIRS + SPINES + MANE + 2 * LEGS * TOES + LEGS + FLAMES];
    size_t count;
} figure;

static void add(figure *f, const scene_joint *joints, size_t count, double width, double blend,
    double (*relief)(const scene_skin_place *), double relief_most)
{
    f->limbs[f->count++] = (scene_limb){joints, count, width, blend, 0, relief, relief_most};
}

/* Spines along the back, leaning to the tail. */
static void add_spines(figure *f)
{
    const scene_limb line = {body, COUNT_OF(body), 1.0, 0.05, 0, NULL, 0};
    for (int i = 0; i < SPINES; i++) {
        double at = 1.2 + (COUNT_OF(body) - 2.6) * i / (SPINES - 1);
        scene_joint here = scene_limb_point(&line, at);
        scene_point along = scene_point_unit(scene_point_sub(scene_limb_point(&line, at + 0.01).at, here.at));
        scene_point up = scene_point_unit(scene_point_mix(scene_at(0, 1, 0), 1, along, -along.y));
        scene_point tip = scene_point_add(here.at, scene_point_mix(up, 1.32 * here.radius, along, -0.22 * here.radius));
        f->spine[i][0] = (scene_joint){scene_point_mix(here.at, 1, up, 0.94 * here.radius), 0.17 * here.radius};
        f->spine[i][1] = (scene_joint){tip, 0.004};
        add(f, f->spine[i], 2, 1.0, 0.02, NULL, 0);
    }
}

/* Locks of hair from the back of the head down the neck, blown backwards. */
static void add_mane(figure *f, scene_mesh *m)
{
    for (int i = 0; i < MANE; i++) {
        double t = (i / 2) / 12.0, side = i % 2 ? 1.0 : -1.0, c, s;
        double spread = scene_mesh_random(m, 0.10, 0.34), length = scene_mesh_random(m, 0.30, 0.52),
            lift = scene_mesh_random(m, 0.0, 0.25);
        scene_direction(spread, &c, &s);
        double x = 1.56 - 0.55 * t, y = 1.86 - 0.22 * t * t + 0.12 * c, z = 0.03 - 0.07 * t + side * 0.13 * s;
        scene_joint *lock = f->mane[i];
        lock[0] = (scene_joint){scene_at(x, y, z), 0.050};
        lock[1] = (scene_joint){scene_at(x - 0.35 * length, y + 0.06 + 0.2 * lift, z + side * 0.10 * s), 0.044};
        lock[2] = (scene_joint){scene_at(x - 0.75 * length, y + 0.02 + 0.4 * lift, z + side * 0.22 * s), 0.030};
        lock[3] = (scene_joint){scene_at(x - length, y + 0.10 + 0.6 * lift, z + side * 0.20 * s), 0.005};
        add(f, lock, 4, 1.0, 0.02, hair_relief, 0.006);
    }
}

/* Four toes on a foot, each with a claw; the free forefoot grasps a ball of rock. */
static void add_foot(figure *f, int n)
{
    scene_point foot = leg[n][3].at;
    for (int k = 0; k < TOES; k++) {
        double c, s, reach = k == 3 ? 0.10 : 0.15, drop = n == 1 ? -0.04 : 0.09;
        scene_direction(k == 3 ? 0.5 : (k - 1) * 0.12, &c, &s);
        scene_point knuckle = {foot.x + 0.5 * reach * c, foot.y - 0.3 * drop + 0.02, foot.z + 0.5 * reach * s};
        scene_point tip = {foot.x + reach * c, foot.y - drop, foot.z + reach * s};
        f->toe[n][k][0] = (scene_joint){foot, 0.045};
        f->toe[n][k][1] = (scene_joint){knuckle, 0.036};
        f->toe[n][k][2] = (scene_joint){tip, 0.026};
        f->claw[n][k][0] = (scene_joint){tip, 0.020};
        f->claw[n][k][1] = (scene_joint){scene_at(tip.x + 0.07 * c, tip.y - 0.05, tip.z + 0.07 * s), 0.003};
        add(f, f->toe[n][k], 3, 1.0, 0.03, limb_relief, 0.0035);
        add(f, f->claw[n][k], 2, 1.0, 0.012, NULL, 0);
    }
}

/* Flames behind elbows and knees and at the tail's end. */
static void add_flames(figure *f, scene_mesh *m)
{
    for (int i = 0; i < FLAMES; i++) {
        scene_point at = i < 8 ? leg[i / 2][1].at : body[0].at;
        double rise = scene_mesh_random(m, 0.05, 0.30), sweep = scene_mesh_random(m, -0.10, 0.10);
        f->flame[i][0] = (scene_joint){at, 0.05};
        f->flame[i][1] = (scene_joint){scene_at(at.x - 0.16, at.y + 0.5 * rise, at.z + sweep), 0.042};
        f->flame[i][2] = (scene_joint){scene_at(at.x - 0.34, at.y + rise + 0.06, at.z + 0.5 * sweep), 0.004};
        add(f, f->flame[i], 3, 0.6, 0.02, hair_relief, 0.006);
    }
}

static void assemble(figure *f, scene_mesh *m)
{
    add(f, body, COUNT_OF(body), 1.0, 0.02, body_relief, 0.004);
    add(f, skull, COUNT_OF(skull), 0.95, 0.035, face_relief, 0.0062);
    add(f, jaw, COUNT_OF(jaw), 1.15, 0.03, face_relief, 0.0062);
    add(f, gape, COUNT_OF(gape), 1.7, 0.02, NULL, 0);
    f->limbs[f->count - 1].carved = 1;
    add(f, tongue, COUNT_OF(tongue), 1.4, 0.02, face_relief, 0.0062);
    for (int i = 0; i < PAIRS; i++) {
        for (int k = 0; k < PAIR_JOINTS; k++)
            f->mirror[i][k] = mirrored(face[i][k]);
        for (int side = 0; side < 2; side++)
            add(f, side ? f->mirror[i] : face[i], PAIR_JOINTS, 1.0, i == 0 || i == 3 ? 0.02 : 0.03, i == 0 ? horn_relief
                : face_relief,
                0.0062);
    }
    for (int i = 0; i < LEGS; i++) {
        add(f, leg[i], 4, 1.0, 0.035, limb_relief, 0.0035);
        add_foot(f, i);
    }
    add_spines(f);
    add_mane(f, m);
    add_flames(f, m);
}

static void teeth_and_eyes(scene_mesh *m, uint32_t ivory)
{
    static const scene_profile ball[] = {{0, -0.038}, {0.019, -0.033}, {0.033, -0.019}, {0.038, 0}, {0.033, 0.019}, {0.019,
        0.033}, {0, 0.038}};
    m->material = ivory;
    for (int i = 0; i < 2; i++) {
        scene_joint eye = {{1.80, 1.955, 0.165}, 0};
        eye = i ? mirrored(eye) : eye;
        scene_frame before = scene_mesh_enter(m, eye.at.x, eye.at.y, eye.at.z, 0);
        scene_mesh_lathe(m, ball, COUNT_OF(ball), 24);
        m->frame = before;
    }
    for (int i = 0; i < 32; i++) { /* above, then below, on either side in turn */
        double t = (i / 4) / 7.0, down = i & 1 ? -1.0 : 1.0, size = t > 0.8 ? 0.085 : 0.035 + 0.015 * ((i / 4) % 2),
            lip = 0.105 - 0.035 * t;
        scene_joint root = {{1.84 + 0.32 * t, i & 1 ? 1.63 : 1.75, 0.03 + 0.16 * (0.29 + 0.32 * t) + lip * (i & 1 ? 0.72
            : 0.92)}, 0};
        root = i & 2 ? mirrored(root) : root;
        const scene_profile tooth[] = {{0, -size * down}, {0.011, -0.3 * size * down}, {0.013, 0.3 * size * down}, {0,
            0.45 * size * down}};
        const scene_profile turned[] = {tooth[3], tooth[2], tooth[1], tooth[0]};
        scene_frame before = scene_mesh_enter(m, root.at.x, root.at.y, root.at.z, 0);
        scene_mesh_lathe(m, down > 0 ? tooth : turned, COUNT_OF(tooth), 12);
        m->frame = before;
    }
}

/* The rock it stands on, the floor, and chips of stone that make the count come out. */
static void base(scene_mesh *m, uint32_t rock, uint32_t floor)
{
    static const scene_joint block[] = {{{-1.6, -0.02, 0.05}, 0.30}, {{-0.8, 0.05, 0.05}, 0.38}, {{0.1, 0.10, 0.1}, 0.40},
        {{0.8, 0.02, 0.25}, 0.36}};
    static const scene_joint ball[] = {{{1.42, 1.12, -0.30}, 0.085}, {{1.421, 1.12, -0.30}, 0.085}};
    static const scene_joint post[] = {{{-0.10, 0.2, -0.2}, 0.26}, {{-0.05, 0.52, -0.2}, 0.20}};
    const scene_limb limbs[] = {{block, COUNT_OF(block), 2.0, 0.1, 0, rock_relief, 0.11}, {post, 2, 1.2, 0.1, 0,
        rock_relief, 0.11}};
    const scene_limb pearl = {ball, 2, 1.0, 0.01, 0, NULL, 0};
    m->material = rock;
    scene_skin_draw(m, limbs, COUNT_OF(limbs), 4.4 * CELL, NULL, NULL);
    scene_skin_draw(m, &pearl, 1, 1.5 * CELL, NULL, NULL);
    m->material = floor;
    scene_mesh_floor(m, -12, -12, 12, 12, 0);
    m->material = rock;
    if (m->target->triangle_count < SCENE_DRAGON_TRIANGLES)
        scene_pebbles(m, SCENE_DRAGON_TRIANGLES - m->target->triangle_count, -2.6, -1.6, 2.6, 1.8, 0.012);
}

base_status scene_build_dragon(scene *s, base_error *err)
{
    scene_mesh m = scene_mesh_begin(s, 7218906, err);
    uint32_t bronze = scene_mesh_paint(&m, 0.36, 0.42, 0.30), ivory = scene_mesh_paint(&m, 0.84, 0.80, 0.66);
    uint32_t rock = scene_mesh_paint(&m, 0.42, 0.39, 0.36), floor = scene_mesh_paint(&m, 0.62, 0.58, 0.52);
    figure f = {.count = 0};
    assemble(&f, &m);
    m.material = bronze;
    scene_skin_draw(&m, f.limbs, f.count, CELL, NULL, NULL);
    teeth_and_eyes(&m, ivory);
    base(&m, rock, floor);
    base_status status = scene_mesh_end(&m, SCENE_DRAGON_TRIANGLES);
    const double eye[3] = {2.6, 2.2, 4.4}, target[3] = {0.22, 1.08, 0}, up[3] = {0, 1, 0};
    s->light = (scene_light){.has_area = 1, .corner = {0.4, 4.2, 0.6}, .u = {1.0, 0, 0}, .v = {0, 0, 1.0}};
    return status != BASE_OK ? status : scene_add_camera(s, scene_camera_look_at("main", eye, target, up, 0.88), err);
}
