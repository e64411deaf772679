#include "scene/builtin/architecture.h"

#include <math.h>

void scene_wall(scene_mesh *m, double x0, double y0, double x1, double y1, scene_opening hole)
{
    scene_mesh_quad(m, scene_at(x0, y0, 0), scene_at(hole.x0, y0, 0), scene_at(hole.x0, y1, 0), scene_at(x0, y1, 0));
    scene_mesh_quad(m, scene_at(hole.x1, y0, 0), scene_at(x1, y0, 0), scene_at(x1, y1, 0), scene_at(hole.x1, y1, 0));
    scene_mesh_quad(m, scene_at(hole.x0, hole.y1, 0), scene_at(hole.x1, hole.y1, 0), scene_at(hole.x1, y1, 0),
        scene_at(hole.x0, y1, 0));
    scene_mesh_quad(m, scene_at(hole.x0, y0, 0), scene_at(hole.x1, y0, 0), scene_at(hole.x1, hole.y0, 0),
        scene_at(hole.x0, hole.y0, 0));
}

void scene_reveal(scene_mesh *m, scene_opening hole, double depth, unsigned faces)
{
    scene_mesh_room(m, scene_at(hole.x0, hole.y0, -depth), scene_at(hole.x1, hole.y1, 0), faces);
}

/* The point of an elliptic curve from right to left, t in [0, 1]. */
static scene_point curve_point(double span, double rise, double spring, double t, double z)
{
    double c, s;
    scene_direction(t * 0.5, &c, &s);
    return scene_at(span * c, spring + rise * s, z);
}

void scene_arch_soffit(scene_mesh *m, const scene_arch *a)
{
    for (unsigned i = 0; i < a->steps; i++) {
        double t0 = (double)i / a->steps, t1 = (double)(i + 1) / a->steps;
        scene_mesh_quad(m, curve_point(a->span, a->rise, a->spring, t1, -a->half),
            curve_point(a->span, a->rise, a->spring, t0, -a->half),
            curve_point(a->span, a->rise, a->spring, t0, a->half),
            curve_point(a->span, a->rise, a->spring, t1, a->half));
    }
}

/* A quad of a wall given in x and y, once on each side of the plane z = 0. */
static void both_sides(scene_mesh *m, scene_point a, scene_point b, scene_point c, scene_point d, double half)
{
    a.z = b.z = c.z = d.z = half;
    scene_mesh_quad(m, a, b, c, d);
    a.z = b.z = c.z = d.z = -half;
    scene_mesh_quad(m, a, d, c, b);
}

void scene_arch_spandrel(scene_mesh *m, const scene_arch *a, double reach, double top)
{
    for (unsigned i = 0; i < a->steps; i++) {
        scene_point p = curve_point(a->span, a->rise, a->spring, (double)i / a->steps, 0);
        scene_point q = curve_point(a->span, a->rise, a->spring, (double)(i + 1) / a->steps, 0);
        both_sides(m, p, scene_at(p.x, top, 0), scene_at(q.x, top, 0), q, a->half);
    }
    both_sides(m, scene_at(a->span, a->spring, 0), scene_at(reach, a->spring, 0), scene_at(reach, top, 0),
        scene_at(a->span, top, 0), a->half);
    both_sides(m, scene_at(-reach, a->spring, 0), scene_at(-a->span, a->spring, 0), scene_at(-a->span, top, 0),
        scene_at(-reach, top, 0), a->half);
}

void scene_arch_band(scene_mesh *m, const scene_arch *a, double width, double proud)
{
    double z = a->half + proud;
    for (unsigned i = 0; i < a->steps; i++) {
        double t0 = (double)i / a->steps, t1 = (double)(i + 1) / a->steps;
        scene_point outer0 = curve_point(a->span + width, a->rise + width, a->spring, t0, z);
        scene_point outer1 = curve_point(a->span + width, a->rise + width, a->spring, t1, z);
        scene_mesh_quad(m, curve_point(a->span, a->rise, a->spring, t0, z), outer0, outer1,
            curve_point(a->span, a->rise, a->spring, t1, z));
        scene_mesh_quad(m, outer0, scene_at(outer0.x, outer0.y, a->half), scene_at(outer1.x, outer1.y, a->half),
            outer1);
    }
}

void scene_arch_ring(scene_mesh *m, const scene_arch *a, double span, double rise)
{
    for (unsigned i = 0; i < a->steps; i++) {
        double t0 = (double)i / a->steps, t1 = (double)(i + 1) / a->steps;
        both_sides(m, curve_point(a->span, a->rise, a->spring, t0, 0), curve_point(span, rise, a->spring, t0, 0),
            curve_point(span, rise, a->spring, t1, 0), curve_point(a->span, a->rise, a->spring, t1, 0), a->half);
    }
}

/* A quarter of a groin vault: the tunnel along z between its two creases, on the side of +z. */
typedef struct groin {
    double half_x, half_z, rise;
} groin;

static scene_point groin_place(const void *user, double u, double v)
{
    const groin *g = user;
    double c, s;
    scene_direction(u * 0.5, &c, &s);
    /* at the height that this tunnel has here, the crossing one has the same share of its own width */
    double crease = fabs(c) * g->half_z;
    return scene_at(-c * g->half_x, g->rise * s, g->half_z + (crease - g->half_z) * v);
}

void scene_groin_vault(scene_mesh *m, double half_x, double half_z, double rise, unsigned steps, unsigned rows)
{
    for (unsigned quarter = 0; quarter < 4; quarter++) {
        groin g = {quarter % 2 ? half_z : half_x, quarter % 2 ? half_x : half_z, rise};
        scene_frame before = scene_mesh_enter(m, 0, 0, 0, quarter * 0.25);
        /* rows run from the edge inwards, columns from +x to -x, so that the front looks down */
        for (unsigned j = 0; j < rows; j++)
            for (unsigned i = 0; i < steps; i++) {
                double u0 = (double)i / steps, u1 = (double)(i + 1) / steps;
                double v0 = (double)j / rows, v1 = (double)(j + 1) / rows;
                scene_mesh_quad(m, groin_place(&g, u1, v0), groin_place(&g, u0, v0), groin_place(&g, u0, v1),
                    groin_place(&g, u1, v1));
            }
        m->frame = before;
    }
}

void scene_barrel_vault(scene_mesh *m, double half_x, double rise, double z0, double z1, unsigned steps, unsigned rows)
{
    for (unsigned j = 0; j < rows; j++) {
        scene_arch piece = {half_x, rise, 0, (z1 - z0) / rows / 2, steps};
        scene_frame before = scene_mesh_enter(m, 0, 0, z0 + (z1 - z0) * (j + 0.5) / rows, 0);
        scene_arch_soffit(m, &piece);
        m->frame = before;
    }
}

void scene_column_draw(scene_mesh *m, const scene_column *c)
{
    /* outlines in radii: torus, scotia and torus below, necking, bell and echinus above */
    static const scene_profile base[] = {{1.34, 0.30}, {1.42, 0.36}, {1.42, 0.46}, {1.34, 0.52}, {1.20, 0.56},
        {1.14, 0.66}, {1.24, 0.72}, {1.24, 0.80}, {1.10, 0.86}, {1.00, 0.98}};
    static const scene_profile capital[] = {{0.86, -1.05}, {0.98, -0.98}, {0.98, -0.90}, {0.88, -0.84}, {0.92, -0.62},
        {1.16, -0.40}, {1.40, -0.30}};
    enum { BASE = sizeof base / sizeof *base, CAPITAL = sizeof capital / sizeof *capital, MOST = 24 };
    scene_profile outline[BASE + MOST + CAPITAL];
    double r = c->radius;
    size_t count = 0;
    for (size_t i = 0; i < BASE; i++)
        outline[count++] = (scene_profile){base[i].out * r, base[i].up * r};
    unsigned steps = c->shaft_steps < MOST ? c->shaft_steps : MOST;
    for (unsigned i = 1; i < steps; i++) {
        double t = (double)i / steps;
        double swell = 1.0 - 0.14 * t * t;
        outline[count++] = (scene_profile){swell * r, (0.98 * r) * (1 - t) + (c->height - 1.05 * r) * t};
    }
    for (size_t i = 0; i < CAPITAL; i++)
        outline[count++] = (scene_profile){capital[i].out * r, c->height + capital[i].up * r};
    scene_mesh_lathe(m, outline, count, c->sides);
    double w = 1.45 * r;
    scene_mesh_box(m, scene_at(-w, 0, -w), scene_at(w, 0.30 * r, w), SCENE_FACES_STANDING);
    scene_mesh_box(m, scene_at(-w, c->height - 0.30 * r, -w), scene_at(w, c->height, w),
        SCENE_FACES_AROUND | SCENE_FACE_BOTTOM);
}

void scene_balustrade(scene_mesh *m, double x0, double x1, double height, unsigned count, unsigned sides)
{
    static const scene_profile turned[] = {{0.62, 0}, {0.50, 0.10}, {1.00, 0.30}, {0.70, 0.48}, {0.38, 0.66},
        {0.52, 0.82}, {0.40, 0.90}, {0.62, 1}};
    enum { POINTS = sizeof turned / sizeof *turned };
    double foot = 0.08, head = height - 0.09;
    scene_mesh_box(m, scene_at(x0, 0, -0.09), scene_at(x1, foot, 0.09), SCENE_FACES_STANDING);
    scene_mesh_box(m, scene_at(x0, head, -0.10), scene_at(x1, height - 0.03, 0.10), SCENE_FACES_AROUND
        | SCENE_FACE_BOTTOM);
    scene_mesh_box(m, scene_at(x0, height - 0.03, -0.12), scene_at(x1, height, 0.12),
        SCENE_FACE_TOP | SCENE_FACE_BOTTOM | SCENE_FACE_FRONT | SCENE_FACE_BACK);
    for (unsigned i = 0; i < count; i++) {
        scene_profile outline[POINTS];
        for (size_t k = 0; k < POINTS; k++)
            outline[k] = (scene_profile){turned[k].out * 0.06, foot + turned[k].up * (head - foot)};
        scene_frame before = scene_mesh_enter(m, x0 + (x1 - x0) * (i + 0.5) / count, 0, 0, 0);
        scene_mesh_lathe(m, outline, POINTS, sides);
        m->frame = before;
    }
}

void scene_stairs(scene_mesh *m, double width, double rise, double tread, unsigned steps)
{
    for (unsigned i = 0; i < steps; i++) {
        double z = -tread * i, y = rise * i, nose = 0.025;
        double w = width / 2;
        /* riser, nosing, and the block below seen from both sides down to the floor */
        scene_mesh_box(m, scene_at(-w, i == 0 ? 0.0 : y, z - tread), scene_at(w, y + rise - 0.04, z),
            SCENE_FACE_FRONT | SCENE_FACE_LEFT | SCENE_FACE_RIGHT);
        if (i > 0)
            scene_mesh_box(m, scene_at(-w, 0, z - tread), scene_at(w, y, z), SCENE_FACE_LEFT | SCENE_FACE_RIGHT);
        scene_mesh_box(m, scene_at(-w - nose, y + rise - 0.04, z - tread), scene_at(w + nose, y + rise, z + nose),
            SCENE_FACES_NO_BACK);
    }
}

void scene_planks(scene_mesh *m, double x0, double z0, double x1, double z1, double breadth, double mean_length,
    const uint32_t *shades, unsigned shade_count)
{
    for (double z = z0; z < z1 - 0.02; z += breadth) {
        double end = z + breadth < z1 ? z + breadth : z1;
        double x = x0;
        while (x < x1) {
            double length = scene_mesh_random(m, 0.6, 1.4) * mean_length;
            double shade = scene_mesh_random(m, 0, shade_count), settle = scene_mesh_random(m, 0, 0.002);
            double stop = x + length > x1 - 0.4 * mean_length ? x1 : x + length;
            m->material = shades[(unsigned)shade];
            scene_mesh_box(m, scene_at(x + 0.001, -0.02, z + 0.002), scene_at(stop - 0.001, -settle, end - 0.002),
                SCENE_FACES_STANDING);
            x = stop;
        }
    }
}

void scene_slabs(scene_mesh *m, double x0, double z0, unsigned across, unsigned along, double size,
    const uint32_t *shades, unsigned shade_count)
{
    for (unsigned j = 0; j < along; j++)
        for (unsigned i = 0; i < across; i++) {
            double shade = scene_mesh_random(m, 0, shade_count), settle = scene_mesh_random(m, 0, 0.006);
            double x = x0 + i * size, z = z0 + j * size;
            m->material = shades[(unsigned)shade];
            scene_mesh_box(m, scene_at(x + 0.006, -0.03, z + 0.006), scene_at(x + size - 0.006, -settle,
                z + size - 0.006),
                SCENE_FACES_STANDING);
        }
}

void scene_roof_tiles(scene_mesh *m, double radius, double length, unsigned count, unsigned sides)
{
    for (unsigned i = 0; i < count; i++) {
        /* each tile lies a little higher on the one before it, at its upper end it is narrower */
        double z0 = length * i, z1 = length * (i + 1) + 0.04, lift = 0.03;
        scene_point low[17], high[17];
        unsigned n = sides < 16 ? sides : 16;
        for (unsigned k = 0; k <= n; k++) {
            low[k] = curve_point(radius, radius, lift, (double)k / n, z1);
            high[k] = curve_point(radius * 0.82, radius * 0.82, 0, (double)k / n, z0);
        }
        for (unsigned k = 0; k < n; k++)
            scene_mesh_quad(m, low[k], high[k], high[k + 1], low[k + 1]);
        for (unsigned k = 1; k < n; k++)
            scene_mesh_triangle(m, low[0], low[k], low[k + 1]);
    }
}

void scene_panel_door(scene_mesh *m, double width, double height)
{
    double w = width / 2, edge = 0.12;
    scene_mesh_quad(m, scene_at(-w, 0, 0.04), scene_at(w, 0, 0.04), scene_at(w, height, 0.04), scene_at(-w, height,
        0.04));
    for (unsigned i = 0; i < 2; i++) {
        double y0 = i == 0 ? edge : height * 0.45 + edge / 2, y1 = i == 0 ? height * 0.45 - edge / 2 : height - edge;
        scene_mesh_box(m, scene_at(-w + edge, y0, 0.04), scene_at(w - edge, y1, 0.055),
            SCENE_FACES_NO_BACK);
    }
}

void scene_window_bars(scene_mesh *m, scene_opening hole, unsigned across, unsigned along, double bar)
{
    double b = bar / 2;
    unsigned upright = SCENE_FACES_AROUND;
    unsigned level = SCENE_FACE_TOP | SCENE_FACE_BOTTOM | SCENE_FACE_FRONT | SCENE_FACE_BACK;
    for (unsigned i = 1; i < across; i++) {
        double x = hole.x0 + (hole.x1 - hole.x0) * i / across;
        scene_mesh_box(m, scene_at(x - b, hole.y0, -b), scene_at(x + b, hole.y1, b), upright);
    }
    for (unsigned j = 1; j < along; j++) {
        /* a little thinner than the uprights, so that no two faces share a plane where they cross */
        double y = hole.y0 + (hole.y1 - hole.y0) * j / along;
        scene_mesh_box(m, scene_at(hole.x0, y - b, -b * 0.8), scene_at(hole.x1, y + b, b * 0.8), level);
    }
}
