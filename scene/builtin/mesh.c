#include "scene/builtin/mesh.h"

#include <math.h>

scene_mesh scene_mesh_begin(scene *target, uint64_t seed, base_error *err)
{
    scene_mesh m = {.target = target, .err = err, .status = BASE_OK, .random = {seed}};
    m.frame.x.x = m.frame.y.y = m.frame.z.z = 1.0;
    return m;
}

base_status scene_mesh_end(scene_mesh *m, size_t expected)
{
    if (m->status == BASE_OK && m->target->triangle_count != expected)
        m->status = base_fail(m->err, BASE_ERR_UNSUPPORTED, m->target->name, "built with %zu triangles instead of %zu",
            m->target->triangle_count, expected);
    return m->status;
}

uint32_t scene_mesh_paint(scene_mesh *m, double red, double green, double blue)
{
    uint32_t index = 0;
    scene_material material = {{(float)red, (float)green, (float)blue}};
    if (m->status == BASE_OK)
        m->status = scene_add_material(m->target, material, &index, m->err);
    m->material = index;
    return index;
}

double scene_mesh_random(scene_mesh *m, double low, double high)
{
    return base_random_range(&m->random, low, high);
}

void scene_direction(double turns, double *cosine, double *sine)
{
    double quarter = floor(turns * 4.0 + 0.5);
    double x = (turns - quarter * 0.25) * 6.283185307179586; /* within an eighth of a turn of 0 */
    double x2 = x * x;
    /* Taylor series; the first term left out is below 1e-17 */
    double s = x * (1 + x2 * (-1.0 / 6 + x2 * (1.0 / 120 + x2 * (-1.0 / 5040 + x2 * (1.0 / 362880
        + x2 * (-1.0 / 39916800 + x2 * (1.0 / 6227020800.0)))))));
    double c = 1 + x2 * (-1.0 / 2 + x2 * (1.0 / 24 + x2 * (-1.0 / 720 + x2 * (1.0 / 40320
        + x2 * (-1.0 / 3628800 + x2 * (1.0 / 479001600.0 + x2 * (-1.0 / 87178291200.0)))))));
    double rest = quarter - 4.0 * floor(quarter * 0.25);
    if (rest == 0.0) {
        *cosine = c, *sine = s;
    } else if (rest == 1.0) {
        *cosine = -s, *sine = c;
    } else if (rest == 2.0) {
        *cosine = -c, *sine = -s;
    } else {
        *cosine = s, *sine = -c;
    }
}

static scene_point frame_vector(const scene_frame *f, scene_point p)
{
    return scene_point_add(scene_point_mix(f->x, p.x, f->y, p.y), scene_point_scale(f->z, p.z));
}

scene_frame scene_mesh_enter(scene_mesh *m, double x, double y, double z, double turns)
{
    scene_frame before = m->frame;
    double c, s;
    scene_direction(turns, &c, &s);
    m->frame.origin = scene_point_add(before.origin, frame_vector(&before, scene_at(x, y, z)));
    m->frame.x = scene_point_mix(before.x, c, before.z, -s);
    m->frame.z = scene_point_mix(before.x, s, before.z, c);
    return before;
}

void scene_mesh_pitch(scene_mesh *m, double turns)
{
    scene_frame before = m->frame;
    double c, s;
    scene_direction(turns, &c, &s);
    m->frame.y = scene_point_mix(before.y, c, before.z, s);
    m->frame.z = scene_point_mix(before.y, -s, before.z, c);
}

void scene_mesh_roll(scene_mesh *m, double turns)
{
    scene_frame before = m->frame;
    double c, s;
    scene_direction(turns, &c, &s);
    m->frame.x = scene_point_mix(before.x, c, before.y, s);
    m->frame.y = scene_point_mix(before.x, -s, before.y, c);
}

static int same_vertex(const float a[3], const float b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

void scene_mesh_triangle(scene_mesh *m, scene_point a, scene_point b, scene_point c)
{
    if (m->status != BASE_OK)
        return;
    scene_point corner[3] = {a, b, c};
    scene_triangle t;
    for (int i = 0; i < 3; i++) {
        scene_point p = scene_point_add(m->frame.origin, frame_vector(&m->frame, corner[i]));
        t.v[i][0] = (float)p.x;
        t.v[i][1] = (float)p.y;
        t.v[i][2] = (float)p.z;
    }
    if (same_vertex(t.v[0], t.v[1]) || same_vertex(t.v[1], t.v[2]) || same_vertex(t.v[2], t.v[0]))
        return;
    m->status = scene_add_triangles(m->target, &t, 1, m->material, m->err);
}

void scene_mesh_quad(scene_mesh *m, scene_point a, scene_point b, scene_point c, scene_point d)
{
    scene_mesh_triangle(m, a, b, c);
    scene_mesh_triangle(m, a, c, d);
}

void scene_mesh_floor(scene_mesh *m, double x0, double z0, double x1, double z1, double y)
{
    scene_mesh_quad(m, scene_at(x0, y, z1), scene_at(x1, y, z1), scene_at(x1, y, z0), scene_at(x0, y, z0));
}

void scene_mesh_ceiling(scene_mesh *m, double x0, double z0, double x1, double z1, double y)
{
    scene_mesh_quad(m, scene_at(x0, y, z0), scene_at(x1, y, z0), scene_at(x1, y, z1), scene_at(x0, y, z1));
}

/* The corner of a box whose bits 0, 1, 2 choose the high x, y, z. */
static scene_point box_corner(scene_point low, scene_point high, unsigned bits)
{
    return scene_at(bits & 1 ? high.x : low.x, bits & 2 ? high.y : low.y, bits & 4 ? high.z : low.z);
}

static void box_faces(scene_mesh *m, scene_point low, scene_point high, unsigned faces, int inward)
{
    /* corners of each face, counter-clockwise from outside, in the order of the SCENE_FACE_ bits */
    static const unsigned char corner[6][4] = {
        {0, 4, 6, 2}, {5, 1, 3, 7}, {0, 1, 5, 4}, {6, 7, 3, 2}, {1, 0, 2, 3}, {4, 5, 7, 6}};
    for (unsigned f = 0; f < 6; f++) {
        if (!(faces >> f & 1))
            continue;
        scene_point p[4];
        for (unsigned i = 0; i < 4; i++)
            p[i] = box_corner(low, high, corner[f][inward ? 3 - i : i]);
        scene_mesh_quad(m, p[0], p[1], p[2], p[3]);
    }
}

void scene_mesh_box(scene_mesh *m, scene_point low, scene_point high, unsigned faces)
{
    box_faces(m, low, high, faces, 0);
}

void scene_mesh_room(scene_mesh *m, scene_point low, scene_point high, unsigned faces)
{
    box_faces(m, low, high, faces, 1);
}

/* Two unit vectors that with the unit vector d make a right-handed triple (side, over, d). */
static void across_axes(scene_point d, scene_point *side, scene_point *over)
{
    scene_point up = fabs(d.y) < 0.9 ? scene_at(0, 1, 0) : scene_at(1, 0, 0);
    *side = scene_point_unit(scene_point_cross(up, d));
    *over = scene_point_cross(d, *side);
}

void scene_mesh_beam(scene_mesh *m, scene_point a, scene_point b, double width, double depth, int with_ends)
{
    scene_point along = scene_point_sub(b, a), side, over;
    double length = scene_point_length(along);
    across_axes(scene_point_unit(along), &side, &over);
    scene_frame before = m->frame;
    m->frame.origin = scene_point_add(before.origin, frame_vector(&before, a));
    m->frame.x = frame_vector(&before, side);
    m->frame.y = frame_vector(&before, over);
    m->frame.z = frame_vector(&before, scene_point_unit(along));
    unsigned faces = SCENE_FACE_LEFT | SCENE_FACE_RIGHT | SCENE_FACE_BOTTOM | SCENE_FACE_TOP;
    scene_mesh_box(m, scene_at(-width / 2, -depth / 2, 0), scene_at(width / 2, depth / 2, length),
        with_ends ? SCENE_FACES_ALL : faces);
    m->frame = before;
}

void scene_mesh_lathe(scene_mesh *m, const scene_profile *profile, size_t count, unsigned sides)
{
    for (size_t i = 0; i + 1 < count; i++) {
        scene_profile p = profile[i], q = profile[i + 1];
        for (unsigned k = 0; k < sides; k++) {
            double c0, s0, c1, s1;
            scene_direction((double)k / sides, &c0, &s0);
            scene_direction((double)((k + 1) % sides) / sides, &c1, &s1);
            scene_mesh_quad(m, scene_at(p.out * s0, p.up, p.out * c0), scene_at(p.out * s1, p.up, p.out * c1),
                scene_at(q.out * s1, q.up, q.out * c1), scene_at(q.out * s0, q.up, q.out * c0));
        }
    }
}

void scene_mesh_moulding(scene_mesh *m, const scene_profile *profile, size_t count, double x0, double x1,
    double mitre0, double mitre1)
{
    for (size_t i = 0; i + 1 < count; i++) {
        scene_profile p = profile[i], q = profile[i + 1];
        scene_mesh_quad(m, scene_at(x0 + mitre0 * p.out, p.up, p.out), scene_at(x1 + mitre1 * p.out, p.up, p.out),
            scene_at(x1 + mitre1 * q.out, q.up, q.out), scene_at(x0 + mitre0 * q.out, q.up, q.out));
    }
}

/* The point of a pipe's ring at angle k/sides. */
static scene_point ring_point(scene_point centre, scene_point side, scene_point over, double radius, unsigned k,
    unsigned sides)
{
    double c, s;
    scene_direction((double)(k % sides) / sides, &c, &s);
    return scene_point_add(centre, scene_point_mix(side, c * radius, over, s * radius));
}

void scene_mesh_pipe(scene_mesh *m, const scene_point *path, size_t count, double radius, unsigned sides)
{
    scene_point side = {0, 0, 0}, over = {0, 0, 0};
    for (size_t i = 0; i < count; i++) {
        scene_point along = scene_point_unit(scene_point_sub(path[i + 1 < count ? i + 1 : i], path[i > 0 ? i - 1 : i]));
        scene_point last_side = side, last_over = over;
        if (i == 0) {
            across_axes(along, &side, &over);
            continue;
        }
        /* carry the ring along with the least twist: over = along x side, side again perpendicular to both */
        over = scene_point_unit(scene_point_cross(along, side));
        side = scene_point_cross(over, along);
        for (unsigned k = 0; k < sides; k++)
            scene_mesh_quad(m, ring_point(path[i - 1], last_side, last_over, radius, k, sides),
                ring_point(path[i - 1], last_side, last_over, radius, k + 1, sides),
                ring_point(path[i], side, over, radius, k + 1, sides), ring_point(path[i], side, over, radius, k,
                sides));
    }
}

void scene_mesh_rope(scene_mesh *m, scene_point a, scene_point b, double sag, double radius, unsigned steps,
    unsigned sides)
{
    scene_point path[65];
    if (steps > 64)
        steps = 64;
    for (unsigned i = 0; i <= steps; i++) {
        double t = (double)i / steps;
        path[i] = scene_point_mix(a, 1.0 - t, b, t);
        path[i].y -= 4.0 * sag * t * (1.0 - t);
    }
    scene_mesh_pipe(m, path, (size_t)steps + 1, radius, sides);
}

typedef struct torus {
    double major, minor;
} torus;

static scene_point torus_place(const void *user, double u, double v)
{
    const torus *t = user;
    double c, s, cv, sv;
    scene_direction(u < 1.0 ? u : 0.0, &c, &s);
    scene_direction(v < 1.0 ? v : 0.0, &cv, &sv);
    double r = t->major + t->minor * cv;
    return scene_at(r * s, t->minor * sv, r * c);
}

void scene_mesh_torus(scene_mesh *m, double major, double minor, unsigned rings, unsigned sides)
{
    torus t = {major, minor};
    scene_mesh_sheet(m, rings, sides, torus_place, &t);
}

/* Front faces of a sheet, or with `reversed` those of its other side along the same diagonals. */
static void sheet_side(scene_mesh *m, unsigned across, unsigned along,
    scene_point (*place)(const void *user, double u, double v), const void *user, int reversed)
{
    for (unsigned j = 0; j < along; j++) {
        double v0 = (double)j / along, v1 = (double)(j + 1) / along;
        for (unsigned i = 0; i < across; i++) {
            double u0 = (double)i / across, u1 = (double)(i + 1) / across;
            scene_point a = place(user, u0, v0), b = place(user, u1, v0), c = place(user, u1, v1), d = place(user,
                u0, v1);
            scene_mesh_quad(m, a, reversed ? d : b, c, reversed ? b : d);
        }
    }
}

void scene_mesh_sheet(scene_mesh *m, unsigned across, unsigned along,
    scene_point (*place)(const void *user, double u, double v), const void *user)
{
    sheet_side(m, across, along, place, user, 0);
}

void scene_mesh_fabric(scene_mesh *m, unsigned across, unsigned along,
    scene_point (*place)(const void *user, double u, double v), const void *user, scene_point half)
{
    scene_frame before = scene_mesh_enter(m, half.x, half.y, half.z, 0);
    sheet_side(m, across, along, place, user, 0);
    m->frame = before;
    scene_mesh_enter(m, -half.x, -half.y, -half.z, 0);
    sheet_side(m, across, along, place, user, 1);
    m->frame = before;
}
