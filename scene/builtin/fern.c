/* A fern on a forest floor: fifteen fronds of thousands of leaflets about the origin, young ones rolled up in their midst. */
#include "scene/builtin/furniture.h"
#include "scene/builtin/noise.h"
#include "scene/builtin/plants.h"
#include "scene/builtin/scenes.h"
#include "scene/builtin/skin.h"

#define COUNT_OF(a) (sizeof(a) / sizeof *(a))

typedef struct palette {
    uint32_t green[4], young, stem, earth, moss, stone, litter[3];
} palette;

static palette paint_palette(scene_mesh *m)
{
    palette p;
    p.green[0] = scene_mesh_paint(m, 0.16, 0.40, 0.10);
    p.green[1] = scene_mesh_paint(m, 0.22, 0.46, 0.12);
    p.green[2] = scene_mesh_paint(m, 0.13, 0.34, 0.11);
    p.green[3] = scene_mesh_paint(m, 0.30, 0.48, 0.14);
    p.young = scene_mesh_paint(m, 0.46, 0.54, 0.20);
    p.stem = scene_mesh_paint(m, 0.24, 0.16, 0.09);
    p.earth = scene_mesh_paint(m, 0.34, 0.26, 0.18);
    p.moss = scene_mesh_paint(m, 0.28, 0.36, 0.14);
    p.stone = scene_mesh_paint(m, 0.46, 0.45, 0.42);
    p.litter[0] = scene_mesh_paint(m, 0.46, 0.28, 0.12);
    p.litter[1] = scene_mesh_paint(m, 0.38, 0.22, 0.11);
    p.litter[2] = scene_mesh_paint(m, 0.54, 0.38, 0.18);
    return p;
}

static void fronds(scene_mesh *m, const palette *p)
{
    enum { FRONDS = 15 };
    for (int i = 0; i < FRONDS; i++) {
        double turn = i * 0.381966 + scene_mesh_random(m, -0.02, 0.02); /* the golden section, as leaves do */
        double length = scene_mesh_random(m, 0.95, 1.25) * (i < 5 ? 0.82 : 1.0);
        double rise = (i < 5 ? 1.05 : 0.72) + scene_mesh_random(m, 0, 0.14);
        double shade = scene_mesh_random(m, 0, 4), c, s;
        scene_frond f = {length, rise, 31, 15, 0.27, 1};
        scene_direction(turn, &c, &s);
        scene_frame before = scene_mesh_enter(m, 0.05 * s, 0.03, 0.05 * c, turn);
        m->material = p->green[(unsigned)shade];
        scene_frond_draw(m, &f);
        m->frame = before;
    }
}

static void crown(scene_mesh *m, const palette *p)
{
    static const scene_joint stock[] = {{{0, -0.08, 0}, 0.10}, {{0, 0.0, 0}, 0.06}};
    static const scene_limb limb = {stock, COUNT_OF(stock), 1.0, 0.02, 0, NULL, 0};
    m->material = p->stem;
    scene_skin_draw(m, &limb, 1, 0.011, NULL, NULL);
    m->material = p->young;
    for (int i = 0; i < 5; i++) {
        double height = scene_mesh_random(m, 0.20, 0.34), turn = i * 0.2 + scene_mesh_random(m, 0, 0.1), c, s;
        scene_direction(turn, &c, &s);
        scene_frame before = scene_mesh_enter(m, 0.045 * s, 0.02, 0.045 * c, turn);
        scene_fiddlehead(m, height, 8);
        m->frame = before;
    }
}

static scene_point ground_place(const void *user, double u, double v)
{
    (void)user;
    double x = (u - 0.5) * 9.0, z = (0.5 - v) * 9.0, out = x * x + z * z;
    double rough = 0.035 * scene_noise_sum(scene_at(2.2 * x, 0.7, 2.2 * z), 4);
    return scene_at(x, -0.015 + rough * (out < 1.0 ? out : 1.0) + 0.003 * out, z);
}

static double stone_relief(const scene_skin_place *p)
{
    return 0.02 * scene_noise(scene_point_scale(p->at, 9.0));
}

/* Fallen leaves, two mossy stones, a fallen branch. */
static void floor_things(scene_mesh *m, const palette *p)
{
    static const scene_joint big[] = {{{0.85, -0.03, -0.75}, 0.20}, {{1.05, 0.02, -0.65}, 0.17}, {{1.2, -0.04, -0.55}, 0.12}};
    static const scene_joint small[] = {{{-0.95, -0.04, 0.30}, 0.12}, {{-0.80, -0.02, 0.42}, 0.10}};
    static const scene_joint branch[] = {{{-1.5, 0.02, -0.8}, 0.035}, {{-0.8, 0.06, -1.0}, 0.03}, {{0.1, 0.03, -1.05}, 0.022},
        {{0.6, 0.05, -1.3}, 0.012}};
    const scene_limb stones[] = {{big, COUNT_OF(big), 1.0, 0.05, 0, stone_relief, 0.02}, {small, COUNT_OF(small), 1.0, 0.05, 0,
        stone_relief, 0.02}};
    const scene_limb wood = {branch, COUNT_OF(branch), 1.0, 0.02, 0, NULL, 0};
    m->material = p->stone;
    scene_skin_draw(m, stones, 2, 0.02, NULL, NULL);
    m->material = p->stem;
    scene_skin_draw(m, &wood, 1, 0.013, NULL, NULL);
    for (int i = 0; i < 900; i++) {
        double x = scene_mesh_random(m, -2.6, 2.6), z = scene_mesh_random(m, -2.6, 2.6), turn = scene_mesh_random(m, 0, 1);
        double tilt = scene_mesh_random(m, -0.2, 0.2), size = scene_mesh_random(m, 0.04, 0.09);
        double shade = scene_mesh_random(m, 0, 3), c, s;
        scene_direction(turn, &c, &s);
        scene_point along = scene_point_unit(scene_at(c, tilt, s));
        scene_leaf leaf = {scene_at(x, 0.03 + 0.003 * (x * x + z * z), z), along,
            scene_point_unit(scene_point_cross(scene_point_cross(along, scene_at(0, 1, 0)), along)), size, 0.6 * size, 0.15};
        m->material = p->litter[(unsigned)shade];
        scene_leaf_draw(m, &leaf, 1);
    }
    m->material = p->moss;
    scene_grass(m, 1800, -2.6, -2.6, 2.6, 2.6, 0.06);
}

base_status scene_build_fern(scene *s, base_error *err)
{
    scene_mesh m = scene_mesh_begin(s, 212, err);
    palette p = paint_palette(&m);
    fronds(&m, &p);
    crown(&m, &p);
    m.material = p.earth;
    scene_mesh_sheet(&m, 60, 60, ground_place, NULL);
    floor_things(&m, &p);
    m.material = p.earth;
    if (s->triangle_count < SCENE_FERN_TRIANGLES) /* crumbs of earth */
        scene_pebbles(&m, SCENE_FERN_TRIANGLES - s->triangle_count, -1.8, -1.8, 1.8, 1.8, 0.012);
    base_status status = scene_mesh_end(&m, SCENE_FERN_TRIANGLES);
    const double eye[3] = {1.05, 1.45, 1.65}, target[3] = {0.02, 0.24, 0}, up[3] = {0, 1, 0};
    /* About three degrees wide from below: the MFT paper names no size, and its counts call for narrow lights (docs/reports.md). */
    s->light = (scene_light){.has_area = 1, .corner = {0.53, 2.6, 0.33}, .u = {0.14, 0, 0}, .v = {0, 0, 0.14}};
    return status != BASE_OK ? status : scene_add_camera(s, scene_camera_look_at("main", eye, target, up, 0.76), err);
}
