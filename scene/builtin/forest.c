/* A glade of 20 m in a forest: a round thatched cottage, old trees, toadstools, ferns and grass, a fence and a path. Large
 * triangles of ground and walls next to tiny ones of leaves. The cottage stands towards -z. */
#include "scene/builtin/architecture.h"
#include "scene/builtin/furniture.h"
#include "scene/builtin/noise.h"
#include "scene/builtin/plants.h"
#include "scene/builtin/scenes.h"
#include "scene/builtin/skin.h"

#define COUNT_OF(a) (sizeof(a) / sizeof *(a))

typedef struct palette {
    uint32_t bark[2], green[4], grass, fern, earth, meadow, stone[3], wall, timber, thatch, pane, door, stem, cap[3], lamp,
        fur[2], dark;
} palette;

static palette paint_palette(scene_mesh *m)
{
    palette p;
    p.bark[0] = scene_mesh_paint(m, 0.32, 0.23, 0.15);
    p.bark[1] = scene_mesh_paint(m, 0.26, 0.21, 0.16);
    p.green[0] = scene_mesh_paint(m, 0.18, 0.38, 0.10);
    p.green[1] = scene_mesh_paint(m, 0.26, 0.46, 0.12);
    p.green[2] = scene_mesh_paint(m, 0.13, 0.30, 0.11);
    p.green[3] = scene_mesh_paint(m, 0.34, 0.46, 0.14);
    p.grass = scene_mesh_paint(m, 0.30, 0.48, 0.14);
    p.fern = scene_mesh_paint(m, 0.20, 0.44, 0.14);
    p.earth = scene_mesh_paint(m, 0.40, 0.31, 0.20);
    p.meadow = scene_mesh_paint(m, 0.30, 0.38, 0.16);
    p.stone[0] = scene_mesh_paint(m, 0.50, 0.48, 0.44);
    p.stone[1] = scene_mesh_paint(m, 0.42, 0.41, 0.38);
    p.stone[2] = scene_mesh_paint(m, 0.56, 0.53, 0.46);
    p.wall = scene_mesh_paint(m, 0.80, 0.74, 0.60);
    p.timber = scene_mesh_paint(m, 0.30, 0.18, 0.09);
    p.thatch = scene_mesh_paint(m, 0.58, 0.46, 0.24);
    p.pane = scene_mesh_paint(m, 0.90, 0.78, 0.36);
    p.door = scene_mesh_paint(m, 0.22, 0.36, 0.30);
    p.stem = scene_mesh_paint(m, 0.86, 0.82, 0.72);
    p.cap[0] = scene_mesh_paint(m, 0.72, 0.10, 0.07);
    p.cap[1] = scene_mesh_paint(m, 0.62, 0.34, 0.14);
    p.cap[2] = scene_mesh_paint(m, 0.78, 0.22, 0.10);
    p.lamp = scene_mesh_paint(m, 0.94, 0.82, 0.44);
    p.fur[0] = scene_mesh_paint(m, 0.56, 0.30, 0.12);
    p.fur[1] = scene_mesh_paint(m, 0.78, 0.70, 0.58);
    p.dark = scene_mesh_paint(m, 0.06, 0.05, 0.04);
    return p;
}

static double ground_height(double x, double z)
{
    double out = x * x + z * z, flat = out < 40.0 ? out / 40.0 : 1.0;
    return flat * 0.16 * scene_noise_sum(scene_at(0.4 * x, 0.5, 0.4 * z), 3) + 0.0035 * out * flat;
}

static scene_point ground_place(const void *user, double u, double v)
{
    (void)user;
    double x = (u - 0.5) * 26.0, z = (0.5 - v) * 26.0;
    return scene_at(x, ground_height(x, z), z);
}

/* The glade in cells of 65 cm, the land around it in a few huge triangles, and a path of flat stones to the door. */
static void ground(scene_mesh *m, const palette *p)
{
    m->material = p->meadow;
    scene_mesh_sheet(m, 40, 40, ground_place, NULL);
    scene_mesh_floor(m, -60, -60, 60, 60, -0.30);
    for (int i = 0; i < 15; i++) {
        double t = i / 14.0, dx = scene_mesh_random(m, -0.12, 0.12), size = scene_mesh_random(m, 0.20, 0.30);
        double c, s, shade = scene_mesh_random(m, 0, 3), turn = scene_mesh_random(m, 0, 1);
        scene_direction(0.35 * t, &c, &s);
        const scene_profile slab[] = {{size, -0.05}, {size, 0.03}, {0.88 * size, 0.05}, {0, 0.055}};
        double x = -2.2 + 3.6 * s + dx, z = -2.1 + 5.6 * t;
        scene_frame before = scene_mesh_enter(m, x, ground_height(x, z), z, turn);
        m->material = p->stone[(unsigned)shade];
        scene_mesh_lathe(m, slab, COUNT_OF(slab), 10);
        m->frame = before;
    }
}

/* The thatch: bundles in rows that overlap, the last one a knot on the top. */
static void thatch(scene_mesh *m, const palette *p)
{
    enum { ROWS = 13, SIDES = 40 };
    scene_profile outline[2 * ROWS + 2];
    for (int i = 0; i < ROWS; i++) {
        double t = (double)i / ROWS, out = 2.35 * (1.0 - t) + 0.10, up = 1.72 + 2.05 * t * (0.75 + 0.25 * t);
        outline[2 * i] = (scene_profile){out, up};
        outline[2 * i + 1] = (scene_profile){out - 0.02, up + 0.075};
    }
    outline[2 * ROWS] = (scene_profile){0.16, 3.78};
    outline[2 * ROWS + 1] = (scene_profile){0, 4.05};
    const scene_profile soffit[] = {{1.45, 2.05}, {2.45, 1.72}};
    m->material = p->thatch;
    scene_mesh_lathe(m, outline, COUNT_OF(outline), SIDES);
    m->material = p->timber;
    scene_mesh_lathe(m, soffit, COUNT_OF(soffit), SIDES);
}

static void window(scene_mesh *m, const palette *p, double turn)
{
    const scene_opening hole = {-0.27, 0.27, 0.95, 1.55};
    scene_frame before = scene_mesh_enter(m, 0, 0, 0, turn);
    scene_mesh_enter(m, 0, 0, 1.60, 0);
    m->material = p->timber;
    scene_mesh_box(m, scene_at(-0.34, 0.88, -0.25), scene_at(0.34, 0.95, 0.06), SCENE_FACES_ALL);
    scene_mesh_box(m, scene_at(-0.34, 1.55, -0.25), scene_at(0.34, 1.62, 0.02), SCENE_FACES_ALL);
    for (int side = -1; side < 2; side += 2)
        scene_mesh_box(m, scene_at(side * 0.305 - 0.035, 0.95, -0.25), scene_at(side * 0.305 + 0.035, 1.55, 0.02),
            SCENE_FACES_AROUND);
    scene_window_bars(m, hole, 3, 3, 0.025);
    m->material = p->pane;
    scene_mesh_quad(m, scene_at(-0.27, 0.95, -0.05), scene_at(0.27, 0.95, -0.05), scene_at(0.27, 1.55, -0.05),
        scene_at(-0.27, 1.55, -0.05));
    m->frame = before;
}

static void lantern(scene_mesh *m, const palette *p)
{
    const scene_profile glass[] = {{0, 0}, {0.05, 0.01}, {0.07, 0.08}, {0.05, 0.15}, {0, 0.16}};
    const scene_profile hood[] = {{0.09, 0.15}, {0.095, 0.16}, {0.03, 0.22}, {0, 0.25}};
    m->material = p->lamp;
    scene_mesh_lathe(m, glass, COUNT_OF(glass), 10);
    m->material = p->dark;
    scene_mesh_lathe(m, hood, COUNT_OF(hood), 10);
    const scene_profile under[] = {{0, 0.17}, {0.09, 0.15}};
    scene_mesh_lathe(m, under, COUNT_OF(under), 10);
    scene_mesh_beam(m, scene_at(0, 0.22, 0), scene_at(0, 0.45, 0), 0.012, 0.012, 0);
}

static void cottage(scene_mesh *m, const palette *p)
{
    static const scene_profile wall[] = {{1.66, -0.1}, {1.62, 0.32}, {1.52, 0.34}, {1.50, 1.2}, {1.46, 2.06}};
    scene_frame before = scene_mesh_enter(m, -2.2, 0.02, -4.2, 0.06);
    m->material = p->stone[1];
    scene_mesh_lathe(m, wall, 3, 24);
    m->material = p->wall;
    scene_mesh_lathe(m, wall + 2, 3, 24);
    thatch(m, p);
    window(m, p, 0.135);
    window(m, p, -0.135);
    window(m, p, 0.30);
    m->material = p->timber;
    for (int i = 0; i < 12; i++) {
        double c, s;
        scene_direction((i + 0.5) / 12.0, &c, &s);
        scene_mesh_beam(m, scene_at(1.54 * s, 0.30, 1.54 * c), scene_at(1.47 * s, 2.04, 1.47 * c), 0.09, 0.09, 0);
    }
    scene_frame house = scene_mesh_enter(m, 0, 0, 1.50, 0);
    m->material = p->door;
    scene_panel_door(m, 0.80, 1.62);
    m->material = p->timber;
    for (int side = -1; side < 2; side += 2)
        scene_mesh_box(m, scene_at(side * 0.45 - 0.05, 0, -0.2), scene_at(side * 0.45 + 0.05, 1.66, 0.16), SCENE_FACES_STANDING);
    scene_mesh_box(m, scene_at(-0.55, 1.66, -0.2), scene_at(0.55, 1.76, 0.18), SCENE_FACES_ALL);
    m->material = p->stone[2];
    scene_mesh_box(m, scene_at(-0.55, -0.2, 0), scene_at(0.55, 0.06, 0.42), SCENE_FACES_STANDING);
    scene_mesh_enter(m, 0.75, 1.25, 0.42, 0);
    lantern(m, p);
    m->frame = house;
    m->material = p->stone[0];
    scene_mesh_box(m, scene_at(0.75, 2.0, -0.9), scene_at(1.2, 3.7, -0.45), SCENE_FACES_STANDING);
    scene_mesh_box(m, scene_at(0.70, 3.7, -0.95), scene_at(1.25, 3.85, -0.40), SCENE_FACES_ALL);
    m->frame = before;
}

static void tree(scene_mesh *m, const palette *p, double x, double z, double height, double radius, int near_by)
{
    double turn = scene_mesh_random(m, 0, 1), kind = scene_mesh_random(m, 0, 2);
    unsigned k = (unsigned)kind;
    scene_tree t = {height, radius, near_by ? 6 : 4, near_by ? 0.12 : 0.24, near_by ? 300 : 120, near_by ? 0.26 : 0.52,
        p->bark[k], {p->green[2 * k], p->green[2 * k + 1]}};
    scene_frame before = scene_mesh_enter(m, x, ground_height(x, z), z, turn);
    scene_tree_draw(m, &t);
    m->frame = before;
}

static void trees(scene_mesh *m, const palette *p)
{
    static const double old[4][4] = {
        {3.4, -2.6, 3.6, 0.52}, {-5.6, -1.2, 4.0, 0.46}, {1.2, -7.4, 4.4, 0.50}, {5.9, 1.4, 3.8, 0.40}};
    for (size_t i = 0; i < COUNT_OF(old); i++)
        tree(m, p, old[i][0], old[i][1], old[i][2], old[i][3], 1);
    for (int i = 0; i < 17; i++) { /* a wood around the back of the glade */
        double c, s, out = scene_mesh_random(m, 8.6, 12.4), jitter = scene_mesh_random(m, -0.012, 0.012);
        scene_direction(0.46 + 0.58 * i / 16.0 + jitter, &c, &s);
        tree(m, p, out * s, out * c, scene_mesh_random(m, 3.8, 5.2), 0.34, 0);
    }
}

static void toadstools(scene_mesh *m, const palette *p)
{
    static const double ring[3][3] = {{1.5, 1.3, 0.9}, {3.0, -1.3, 0.8}, {-3.6, 0.6, 0.9}};
    for (int i = 0; i < 27; i++) {
        double x = scene_mesh_random(m, -1, 1), z = scene_mesh_random(m, -1, 1), size = scene_mesh_random(m, 0.10, 0.42);
        double shade = scene_mesh_random(m, 0, 3), turn = scene_mesh_random(m, 0, 1), tilt = scene_mesh_random(m, -0.02, 0.02);
        const double *at = ring[i % 3];
        x = at[0] + x * at[2];
        z = at[1] + z * at[2];
        scene_frame before = scene_mesh_enter(m, x, ground_height(x, z), z, turn);
        scene_mesh_roll(m, tilt);
        scene_toadstool(m, size, 0.52 * size, 20, p->stem, p->cap[(unsigned)shade]);
        m->frame = before;
    }
}

static void undergrowth(scene_mesh *m, const palette *p)
{
    static const double place[4][2] = {{2.5, -0.4}, {-4.4, -0.3}, {0.6, -5.4}, {-1.0, 2.6}};
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 5; k++) {
            double turn = k / 5.0 + scene_mesh_random(m, 0, 0.1), length = scene_mesh_random(m, 0.7, 1.0);
            scene_frond f = {length, 0.85, 11, 6, 0.26, 0};
            scene_frame before = scene_mesh_enter(m, place[i][0], ground_height(place[i][0], place[i][1]), place[i][1], turn);
            m->material = p->fern;
            scene_frond_draw(m, &f);
            m->frame = before;
        }
    m->material = p->grass;
    for (int i = 0; i < 200; i++) { /* tufts, none on the path or in the cottage */
        double x = scene_mesh_random(m, -6.5, 6.5), z = scene_mesh_random(m, -6.0, 5.0);
        double tall = scene_mesh_random(m, 0.14, 0.34), hx = x + 2.2, hz = z + 4.2;
        scene_frame before = scene_mesh_enter(m, x, ground_height(x, z), z, 0);
        if (hx * hx + hz * hz > 4.5)
            scene_grass(m, 22, -0.16, -0.16, 0.16, 0.16, tall);
        m->frame = before;
    }
}

static void fence(scene_mesh *m, const palette *p)
{
    for (int i = 0; i < 12; i++) {
        double c0, s0, c1, s1, sag = scene_mesh_random(m, -0.05, 0.05);
        scene_direction(0.55 + 0.026 * i, &c0, &s0);
        scene_direction(0.55 + 0.026 * (i + 1), &c1, &s1);
        scene_point a = {6.6 * s0, 0, 1.0 + 6.6 * c0}, b = {6.6 * s1, 0, 1.0 + 6.6 * c1};
        a.y = ground_height(a.x, a.z);
        b.y = ground_height(b.x, b.z);
        m->material = p->timber;
        scene_mesh_beam(m, scene_at(a.x, a.y - 0.2, a.z), scene_at(a.x, a.y + 0.85 + sag, a.z), 0.10, 0.10, 1);
        for (int k = 0; k < 2; k++)
            scene_mesh_beam(m, scene_at(a.x, a.y + 0.35 + 0.32 * k + sag, a.z), scene_at(b.x, b.y + 0.35 + 0.32 * k, b.z), 0.05,
                0.08, 1);
    }
}

/* A hare sitting up among the toadstools, a hand high. */
static void hare(scene_mesh *m, const palette *p)
{
    static const scene_joint trunk[] = {{{-0.10, 0.09, 0}, 0.085}, {{-0.04, 0.13, 0}, 0.10}, {{0.05, 0.21, 0}, 0.072}};
    static const scene_joint head[] = {{{0.06, 0.30, 0}, 0.052}, {{0.11, 0.30, 0}, 0.045}, {{0.15, 0.285, 0}, 0.028}};
    static const scene_joint ear[2][3] = {{{{0.05, 0.34, 0.02}, 0.02}, {{0.02, 0.42, 0.035}, 0.021}, {{0.0, 0.49, 0.04}, 0.010}},
        {{{0.05, 0.34, -0.02}, 0.02}, {{0.03, 0.42, -0.04}, 0.021}, {{0.03, 0.49, -0.06}, 0.010}}};
    static const scene_joint hind[2][3] = {{{{-0.08, 0.09, 0.07}, 0.06}, {{0.0, 0.05, 0.09}, 0.035}, {{0.08, 0.02, 0.09}, 0.022}},
        {{{-0.08, 0.09, -0.07}, 0.06}, {{0.0, 0.05, -0.09}, 0.035}, {{0.08, 0.02, -0.09}, 0.022}}};
    static const scene_joint fore[2][2] = {{{{0.06, 0.17, 0.045}, 0.03}, {{0.09, 0.02, 0.045}, 0.018}},
        {{{0.06, 0.17, -0.045}, 0.03}, {{0.09, 0.02, -0.045}, 0.018}}};
    scene_limb limbs[9] = {{trunk, 3, 0.85, 0.02, 0, NULL, 0}, {head, 3, 0.9, 0.04, 0, NULL, 0}};
    static const scene_profile ball[] = {{0, -0.03}, {0.025, -0.015}, {0.03, 0}, {0.025, 0.015}, {0, 0.03}};
    size_t n = 2;
    for (int i = 0; i < 2; i++) {
        limbs[n++] = (scene_limb){ear[i], 3, 1, 0.02, 0, NULL, 0};
        limbs[n++] = (scene_limb){hind[i], 3, 1, 0.03, 0, NULL, 0};
        limbs[n++] = (scene_limb){fore[i], 2, 1, 0.03, 0, NULL, 0};
    }
    scene_frame before = scene_mesh_enter(m, 0.75, ground_height(0.75, 1.2), 1.2, -0.10);
    m->material = p->fur[0];
    scene_skin_draw(m, limbs, n, 0.0115, NULL, NULL);
    scene_mesh_enter(m, -0.19, 0.09, 0, 0);
    m->material = p->fur[1];
    scene_mesh_lathe(m, ball, COUNT_OF(ball), 9);
    m->frame = before;
}

base_status scene_build_forest(scene *s, base_error *err)
{
    scene_mesh m = scene_mesh_begin(s, 174, err);
    palette p = paint_palette(&m);
    ground(&m, &p);
    cottage(&m, &p);
    trees(&m, &p);
    toadstools(&m, &p);
    undergrowth(&m, &p);
    fence(&m, &p);
    hare(&m, &p);
    m.material = p.stone[1];
    if (s->triangle_count < SCENE_FOREST_TRIANGLES)
        scene_pebbles(&m, SCENE_FOREST_TRIANGLES - s->triangle_count, -2.5, -1.5, 2.5, 4.0, 0.035);
    base_status status = scene_mesh_end(&m, SCENE_FOREST_TRIANGLES);
    const double eye[3] = {1.8, 1.75, 5.4}, target[3] = {-0.2, 1.15, -2.0}, up[3] = {0, 1, 0};
    /* About three degrees wide from below: the MFT paper names no size, and its counts call for narrow lights (docs/reports.md). */
    s->light = (scene_light){.has_area = 1, .corner = {0.95, 9.5, 0.25}, .u = {0.5, 0, 0}, .v = {0, 0, 0.5}};
    return status != BASE_OK ? status : scene_add_camera(s, scene_camera_look_at("main", eye, target, up, 1.0), err);
}
