#include "scene/builtin/plants.h"

#include "scene/builtin/furniture.h"
#include "scene/builtin/noise.h"
#include "scene/builtin/skin.h"

#define COUNT_OF(a) (sizeof(a) / sizeof *(a))

void scene_leaf_draw(scene_mesh *m, const scene_leaf *leaf, int ribbed)
{
    double l = leaf->length, w = leaf->width / 2;
    scene_point side = scene_point_cross(leaf->along, leaf->up), up = leaf->up;
    scene_point middle = scene_point_mix(leaf->at, 1, leaf->along, 0.45 * l);
    scene_point tip = scene_point_add(leaf->at, scene_point_mix(leaf->along, l, up, -leaf->droop * l));
    /* the edges lie above the line from stalk to tip, or with a rib below it */
    scene_point level = scene_point_mix(middle, 1, up, ribbed ? -0.05 * l : (0.05 - 0.45 * leaf->droop) * l);
    scene_point left = scene_point_mix(level, 1, side, -w), right = scene_point_mix(level, 1, side, w);
    if (!ribbed) {
        scene_mesh_triangle(m, leaf->at, right, left);
        scene_mesh_triangle(m, right, tip, left);
        scene_mesh_triangle(m, leaf->at, left, tip);
        scene_mesh_triangle(m, leaf->at, tip, right);
        return;
    }
    scene_point edge[5] = {leaf->at, right, tip, left, leaf->at};
    scene_point over = scene_point_mix(middle, 1, up, 0.06 * l), under = scene_point_mix(middle, 1, up, -0.08 * l);
    for (int i = 0; i < 4; i++) {
        scene_mesh_triangle(m, edge[i], edge[i + 1], over);
        scene_mesh_triangle(m, edge[i + 1], edge[i], under);
    }
}

/* A point of a frond's stem, t from 0 to 1: up, then over. */
static scene_point stem_point(const scene_frond *f, double t)
{
    double over = t * t;
    return scene_at(0, f->length * (f->rise * (t - 0.42 * over) * 1.5 - 0.28 * over * t), f->length * (0.18 * t + 0.62 * over));
}

static double stem_radius(const scene_frond *f)
{
    return 0.0045 * f->length;
}

/* One stalk with its leaflets; `forward` runs along the stem, `out` to the side. */
static void stalk(scene_mesh *m, const scene_frond *f, scene_point at, scene_point forward, scene_point out, double length)
{
    double lean = scene_mesh_random(m, 0.22, 0.34), droop = scene_mesh_random(m, 0.10, 0.28);
    scene_point along = scene_point_unit(scene_point_mix(out, 1, forward, lean));
    scene_point up = scene_point_unit(scene_point_cross(forward, out)), path[4];
    if (up.y < 0)
        up = scene_point_scale(up, -1);
    for (int i = 0; i < 4; i++) {
        double t = i / 3.0;
        path[i] = scene_point_add(at, scene_point_mix(along, length * t, up, -length * droop * t * t));
    }
    scene_mesh_pipe(m, path, 4, 0.35 * stem_radius(f), 3);
    unsigned pairs = 2 + (unsigned)((f->leaflets - 2) * length / (f->breadth * f->length));
    for (unsigned i = 0; i < pairs; i++)
        for (int side = 0; side < 2; side++) {
            double t = (i + 0.6 + 0.25 * side) / (pairs + 0.4), size = (1.0 - 0.78 * t * t) * scene_mesh_random(m, 0.88, 1.08);
            double turn = side ? 1.0 : -1.0, sink = scene_mesh_random(m, -0.12, 0.20);
            scene_point from = scene_point_add(at, scene_point_mix(along, length * t, up, -length * droop * t * t));
            scene_point across = scene_point_scale(scene_point_cross(along, up), turn);
            scene_point way = scene_point_add(scene_point_mix(across, 1, along, 0.55), scene_point_scale(up, -sink));
            way = scene_point_unit(way);
            scene_point face = scene_point_unit(scene_point_cross(scene_point_cross(way, up), way));
            double reach = size * 0.25 * (0.35 * f->breadth * f->length + 0.65 * length);
            scene_leaf leaf = {from, way, face, reach, 0.62 * (length / pairs + 0.2 * reach), 0.12};
            scene_leaf_draw(m, &leaf, f->ribbed);
        }
}

void scene_frond_draw(scene_mesh *m, const scene_frond *f)
{
    scene_point path[17];
    for (int i = 0; i <= 16; i++)
        path[i] = stem_point(f, i / 16.0);
    scene_mesh_pipe(m, path, 17, stem_radius(f), 5);
    for (unsigned i = 0; i < f->pairs; i++) {
        double t = 0.16 + 0.83 * (i + 0.5) / f->pairs, along = (t - 0.16) / 0.84;
        /* broadest at a third of the blade, narrow at its foot, tapering to the tip */
        double share = along < 0.3 ? 0.55 + 1.5 * along : 1.0 - 0.93 * (along - 0.3) / 0.7;
        scene_point at = stem_point(f, t), forward = scene_point_unit(scene_point_sub(stem_point(f, t + 0.01), at));
        for (int side = 0; side < 2; side++)
            stalk(m, f, at, forward, scene_at(side ? 1 : -1, 0, 0), share * f->breadth * f->length);
    }
}

void scene_fiddlehead(scene_mesh *m, double height, unsigned sides)
{
    enum { STEM = 14, ROLL = 26, STEPS = STEM + ROLL };
    scene_point path[STEPS + 1];
    double coil = 0.16 * height;
    for (int i = 0; i <= STEM; i++)
        path[i] = scene_at(0.02 * height * i / STEM, (height - coil) * i / STEM, 0);
    for (int i = 1; i <= ROLL; i++) { /* one and a half turns inwards */
        double c, s, r = coil * (1.0 - 0.8 * i / ROLL);
        scene_direction(0.5 - 1.5 * i / ROLL, &c, &s);
        path[STEM + i] = scene_at(0.02 * height + coil + r * c, height - coil + r * s, 0.0);
    }
    scene_mesh_pipe(m, path, STEPS + 1, 0.03 * height, sides);
    const scene_profile knob[] = {{0, -0.05 * height}, {0.045 * height, 0}, {0, 0.05 * height}};
    scene_frame before = scene_mesh_enter(m, path[STEPS].x, path[STEPS].y, 0, 0);
    scene_mesh_lathe(m, knob, COUNT_OF(knob), 2 * sides);
    m->frame = before;
}

/* Furrows along a trunk. */
static double bark(const scene_skin_place *p)
{
    double c, s, around = scene_skin_around(scene_at(0, p->out.x, p->out.z));
    double wander = 0.6 * scene_noise(scene_at(p->at.x * 2.0, p->at.y * 1.2, p->at.z * 2.0));
    scene_direction(around * 2.75 + wander, &c, &s);
    return p->radius * (0.07 * c + 0.06 * scene_noise(scene_at(p->at.x * 6.0, p->at.y * 2.0, p->at.z * 6.0)));
}

enum { MOST_BRANCHES = 7 };

typedef struct wood {
    scene_joint trunk[5], branch[MOST_BRANCHES][4], root[MOST_BRANCHES][3];
} wood;

static wood grow(scene_mesh *m, const scene_tree *tree)
{
    wood w;
    double h = tree->height, r = tree->radius;
    for (int i = 0; i < 5; i++) {
        double dx = scene_mesh_random(m, -0.5, 0.5), dz = scene_mesh_random(m, -0.5, 0.5);
        w.trunk[i] = (scene_joint){scene_at(i * dx * r, -0.3 + (h + 0.3) * i / 4, i * dz * r), r * (1.15 - 0.15 * i)};
    }
    scene_point fork = w.trunk[4].at;
    for (unsigned i = 0; i < tree->branches; i++) {
        double c, s, jitter = scene_mesh_random(m, -0.05, 0.05), reach = scene_mesh_random(m, 0.35, 0.6) * h;
        double rise = scene_mesh_random(m, 0.25, 0.55) * h, low = scene_mesh_random(m, 0.0, 0.25) * h;
        scene_direction((double)i / tree->branches + jitter, &c, &s);
        w.branch[i][0] = (scene_joint){scene_at(fork.x, fork.y - low, fork.z), 0.45 * r};
        w.branch[i][1] = (scene_joint){scene_at(fork.x + 0.35 * reach * c, fork.y - low + 0.35 * rise, fork.z + 0.35 * reach * s),
            0.32 * r};
        w.branch[i][2] = (scene_joint){scene_at(fork.x + 0.75 * reach * c, fork.y - low + 0.55 * rise, fork.z + 0.75 * reach * s),
            0.22 * r};
        w.branch[i][3] = (scene_joint){scene_at(fork.x + reach * c, fork.y - low + rise, fork.z + reach * s), 0.12 * r};
        scene_direction((i + 0.4) / tree->branches - jitter, &c, &s);
        double spread = r * scene_mesh_random(m, 2.6, 4.0);
        w.root[i][0] = (scene_joint){scene_at(0.3 * r * c, 0.55 * r, 0.3 * r * s), 0.55 * r};
        w.root[i][1] = (scene_joint){scene_at(1.5 * r * c, 0.12 * r, 1.5 * r * s), 0.30 * r};
        w.root[i][2] = (scene_joint){scene_at(spread * c, -0.35 * r, spread * s), 0.14 * r};
    }
    return w;
}

void scene_tree_draw(scene_mesh *m, const scene_tree *tree)
{
    wood w = grow(m, tree);
    scene_limb limbs[1 + 2 * MOST_BRANCHES];
    size_t n = 0;
    limbs[n++] = (scene_limb){w.trunk, 5, 1.0, 0.05, 0, bark, 0.16 * tree->radius};
    for (unsigned i = 0; i < tree->branches; i++) {
        limbs[n++] = (scene_limb){w.root[i], 3, 1.0, 0.6 * tree->radius, 0, bark, 0.08 * tree->radius};
        limbs[n++] = (scene_limb){w.branch[i], 4, 1.0, 0.4 * tree->radius, 0, bark, 0.08 * tree->radius};
    }
    m->material = tree->bark;
    scene_skin_draw(m, limbs, n, tree->cell, NULL, NULL);
    for (unsigned i = 0; i < tree->branches; i++)
        for (int k = 2; k < 4; k++) {
            scene_point at = w.branch[i][k].at;
            scene_frame before = scene_mesh_enter(m, at.x, at.y + 0.1 * tree->height, at.z, 0);
            m->material = tree->green[k % 2];
            scene_leaves(m, tree->leaves / 2, 0.30 * tree->height, 0.22 * tree->height, tree->leaf);
            m->frame = before;
        }
}

void scene_toadstool(scene_mesh *m, double height, double radius, unsigned sides, uint32_t stem, uint32_t cap)
{
    double h = height, r = radius, foot = 0.26 * r, rim = h - 0.55 * r;
    const scene_profile stalk_outline[] = {{1.35 * foot, -0.02 * h}, {1.2 * foot, 0.10 * h}, {0.85 * foot, 0.45 * h},
        {0.8 * foot, 0.58 * h}, {1.5 * foot, 0.56 * h}, {0.8 * foot, 0.62 * h}, {0.75 * foot, rim + 0.1 * r}};
    const scene_profile cap_outline[] = {{0.75 * foot, rim + 0.1 * r}, {0.92 * r, rim - 0.03 * r}, {r, rim},
        {0.97 * r, rim + 0.12 * r}, {0.80 * r, rim + 0.32 * r}, {0.50 * r, rim + 0.47 * r}, {0.22 * r, rim + 0.54 * r}, {0, h}};
    static const double spot[8][2] = {{0.08, 0.1}, {0.45, 0.0}, {0.5, 0.28}, {0.42, 0.55}, {0.5, 0.8}, {0.74, 0.13}, {0.78, 0.46},
        {0.72, 0.72}};
    m->material = stem;
    scene_mesh_lathe(m, stalk_outline, COUNT_OF(stalk_outline), sides);
    for (int i = 0; i < 8; i++) {
        double c, s, out = spot[i][0] * r, size = 0.10 * r;
        scene_direction(spot[i][1], &c, &s);
        const scene_profile wart[] = {{0, -0.6 * size}, {size, -0.2 * size}, {0.7 * size, 0.45 * size}, {0, 0.6 * size}};
        /* the cap's height there, near enough for a wart sunk into it */
        scene_frame before = scene_mesh_enter(m, out * s, h - 0.52 * out * out / r, out * c, spot[i][1]);
        scene_mesh_pitch(m, 0.13 * spot[i][0]);
        scene_mesh_lathe(m, wart, COUNT_OF(wart), 5);
        m->frame = before;
    }
    m->material = cap;
    scene_mesh_lathe(m, cap_outline, COUNT_OF(cap_outline), sides);
}

void scene_grass(scene_mesh *m, unsigned count, double x0, double z0, double x1, double z1, double height)
{
    for (unsigned i = 0; i < count; i++) {
        double x = scene_mesh_random(m, x0, x1), z = scene_mesh_random(m, z0, z1), turn = scene_mesh_random(m, 0, 1);
        double tall = scene_mesh_random(m, 0.5, 1.2) * height, lean = scene_mesh_random(m, 0.1, 0.6), c, s;
        scene_direction(turn, &c, &s);
        scene_point along = scene_point_unit(scene_at(lean * c, 1, lean * s));
        scene_point up = scene_point_unit(scene_point_cross(scene_point_cross(along, scene_at(c, 0, s)), along));
        scene_leaf blade = {scene_at(x, -0.02, z), along, up, tall, 0.045 * tall + 0.006, -0.25};
        scene_leaf_draw(m, &blade, 0);
    }
}
