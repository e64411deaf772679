#include "scene/builtin/skin_field.h"

#include <stdlib.h>

/* Straight pieces of the centre line between two joints: where there are only two, it is straight. */
static size_t pieces_of(const scene_limb *limb)
{
    return limb->count == 2 ? 1 : 6;
}

#define FAR 1e9

/* Catmull and Rom's curve through b and c, t from 0 to 1. */
static double curve(double a, double b, double c, double d, double t)
{
    return 0.5 * (2 * b + t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a))));
}

/* The curve through a limb's joints, between joint `i` and the next. */
static scene_joint between_joints(const scene_limb *limb, size_t i, double t)
{
    const scene_joint *b = &limb->joints[i], *c = b + 1;
    const scene_joint *a = i > 0 ? b - 1 : b, *d = i + 2 < limb->count ? c + 1 : c;
    scene_joint p = {{curve(a->at.x, b->at.x, c->at.x, d->at.x, t), curve(a->at.y, b->at.y, c->at.y, d->at.y, t),
        curve(a->at.z, b->at.z, c->at.z, d->at.z, t)}, curve(a->radius, b->radius, c->radius, d->radius, t)};
    return p;
}

/* The same in the limb's own space. */
static scene_joint centre_line(const scene_limb *limb, size_t i, double t)
{
    scene_joint p = between_joints(limb, i, t);
    p.at.z /= limb->width;
    return p;
}

scene_joint scene_limb_point(const scene_limb *limb, double at)
{
    size_t last = limb->count - 2, i = at > 0.0 ? (size_t)at : 0;
    i = i < last ? i : last;
    return between_joints(limb, i, at - (double)i);
}

static void extend(double *low, double *high, double at, double by)
{
    *low = fmin(*low, at - by);
    *high = fmax(*high, at + by);
}

static void add_bone(skin_field *f, const scene_limb *limb, scene_joint p, scene_joint q, double along)
{
    skin_bone *bone = &f->bones[f->count++];
    scene_point step = scene_point_sub(q.at, p.at);
    double length2 = scene_point_dot(step, step), growth = q.radius - p.radius;
    *bone = (skin_bone){limb, p.at, step, 1.0 / length2, p.radius, growth, along, sqrt(length2), 0};
    f->slope = fmax(f->slope, sqrt(1.0 + growth * growth / length2));
    if (limb->carved)
        return;
    double by = (fmax(p.radius, q.radius) + limb->relief_most) * fmax(1.0, limb->width) + limb->blend;
    for (int end = 0; end < 2; end++) {
        scene_point at = end ? q.at : p.at;
        extend(&f->low.x, &f->high.x, at.x, by);
        extend(&f->low.y, &f->high.y, at.y, by);
        extend(&f->low.z, &f->high.z, at.z * limb->width, by);
    }
}

int skin_field_begin(skin_field *f, const scene_limb *limbs, size_t count)
{
    size_t bones = 0;
    for (size_t i = 0; i < count; i++)
        bones += (limbs[i].count - 1) * pieces_of(&limbs[i]);
    *f = (skin_field){.slope = 1.0, .low = {FAR, FAR, FAR}, .high = {-FAR, -FAR, -FAR}};
    f->bones = malloc(bones * sizeof *f->bones);
    f->nearest = malloc(count * sizeof *f->nearest);
    if (!f->bones || !f->nearest)
        return 0;
    for (size_t i = 0; i < count; i++) {
        double along = 0;
        size_t first = f->count;
        f->relief = fmax(f->relief, limbs[i].relief_most);
        size_t n = pieces_of(&limbs[i]);
        for (size_t k = 0; k < (limbs[i].count - 1) * n; k++) {
            double t0 = (double)(k % n) / (double)n, t1 = (double)(k % n + 1) / (double)n;
            add_bone(f, &limbs[i], centre_line(&limbs[i], k / n, t0), centre_line(&limbs[i], k / n, t1), along);
            along += f->bones[f->count - 1].length;
        }
        for (size_t k = first; k < f->count; k++)
            f->bones[k].limb_length = along;
    }
    return 1;
}

void skin_field_end(skin_field *f)
{
    free(f->bones);
    free(f->nearest);
    f->bones = NULL;
    f->nearest = NULL;
}

/* Distance from the skin about one bone, in the limb's own space; *t says where along the bone. FAR if it is plain without a
 * root that the distance is above `best`. */
static double bone_distance(const skin_bone *bone, scene_point p, double best, double *t)
{
    scene_point to = scene_point_sub(p, bone->from);
    double at = scene_point_dot(to, bone->step) * bone->per_length2;
    at = at < 0.0 ? 0.0 : at > 1.0 ? 1.0 : at;
    *t = at;
    scene_point out = scene_point_sub(to, scene_point_scale(bone->step, at));
    double radius = bone->radius + at * bone->growth, most = best + radius;
    if (scene_point_dot(out, out) > 1.000001 * (most * most) && most > 0.0)
        return FAR;
    return scene_point_length(out) - radius;
}

static scene_point limb_space(const scene_limb *limb, scene_point p)
{
    return limb->width == 1.0 ? p : scene_at(p.x, p.y, p.z / limb->width); /* most are round, and a division takes its time */
}

/* From a distance in the limb's space to one that no point in space falls short of. */
static double limb_scale(const scene_limb *limb)
{
    return limb->width < 1.0 ? limb->width : 1.0;
}

static double relief_at(const skin_bone *bone, double t, scene_point at, scene_point p)
{
    scene_point out = scene_point_sub(p, scene_point_mix(bone->from, 1.0, bone->step, t));
    double length = scene_point_length(out), along = bone->along + t * bone->length;
    scene_skin_place place = {at, along, along / bone->limb_length, bone->radius + t * bone->growth,
        length > 0.0 ? scene_point_scale(out, 1.0 / length) : scene_at(0, 1, 0)};
    return bone->limb->relief(&place);
}

/* The smaller of two, rounded off where they differ by less than `blend`. */
static double smooth_min(double a, double b, double blend)
{
    double h = blend - fabs(a - b);
    return fmin(a, b) - (h > 0.0 ? h * h / (4.0 * blend) : 0.0);
}

/* The nearest bone of each limb, into f->nearest; the number of limbs. */
static size_t find_nearest(const skin_field *f, const skin_bone *const *list, size_t count, scene_point p)
{
    size_t limbs = 0;
    for (size_t i = 0; i < count;) {
        const scene_limb *limb = list[i]->limb;
        scene_point q = limb_space(limb, p);
        skin_nearest best = {list[i], 0, FAR};
        for (; i < count && list[i]->limb == limb; i++) {
            double t, d = bone_distance(list[i], q, best.distance, &t);
            if (d < best.distance)
                best = (skin_nearest){list[i], t, d};
        }
        best.distance *= limb_scale(limb);
        f->nearest[limbs++] = best;
    }
    return limbs;
}

/* The limbs in f->nearest put together. */
static double melt(const skin_field *f, size_t limbs)
{
    double field = FAR;
    for (size_t i = 0; i < limbs; i++) {
        const scene_limb *limb = f->nearest[i].bone->limb;
        double d = f->nearest[i].distance;
        field = limb->carved ? -smooth_min(-field, d, limb->blend) : smooth_min(field, d, limb->blend);
    }
    return field;
}

double skin_field_rough(const skin_field *f, const skin_bone *const *list, size_t count, scene_point p)
{
    return melt(f, find_nearest(f, list, count, p));
}

double skin_field_at(const skin_field *f, const skin_bone *const *list, size_t count, scene_point p, double band, double relief)
{
    size_t limbs = find_nearest(f, list, count, p);
    double rough = melt(f, limbs);
    if (fabs(rough) > band + relief)
        return rough;
    for (size_t i = 0; i < limbs; i++) {
        skin_nearest *n = &f->nearest[i];
        if (n->bone->limb->relief)
            n->distance -= relief_at(n->bone, n->t, p, limb_space(n->bone->limb, p));
    }
    return melt(f, limbs);
}

double skin_field_relief(const skin_bone *const *list, size_t count)
{
    double most = 0;
    for (size_t i = 0; i < count; i++)
        most = fmax(most, list[i]->limb->relief_most);
    return most;
}

size_t skin_field_near(const skin_field *f, const skin_bone *const *from, size_t count, scene_point p, double rough,
    double reach, const skin_bone **list)
{
    /* Within reach the field and a limb's distance each change by reach * slope + relief. Far limbs melt to at most one blend
     * below the nearest of them, and stop mattering one blend above a near one, itself at most one above the field. */
    double relief = skin_field_relief(from, count), blend = 0;
    for (size_t i = 0; i < count; i++)
        blend = from[i]->limb->blend > blend ? from[i]->limb->blend : blend;
    double margin = fabs(rough) + 2.0 * (reach * f->slope + relief) + 3.0 * blend;
    size_t kept = 0;
    for (size_t i = 0; i < count; i++) {
        double t, d = bone_distance(from[i], limb_space(from[i]->limb, p), FAR, &t) * limb_scale(from[i]->limb);
        if (d <= margin)
            list[kept++] = from[i];
    }
    return kept;
}
