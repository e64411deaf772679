/* Hard cases of kd-trees, and of entry points into them (C). */
#include <math.h>
#include <string.h>

#include "cli/suites/stability_cases.h"

/* Images of WIDE x 8 pixels are split: tiles of more than 32 pixels an edge search on in parts. */
enum { WIDE = 40 };

/* A rectangle across an axis, two triangles; u and v are the axes that follow it. */
static void add_rectangle(stability_scene *s, int axis, double at, const double low[2], const double high[2])
{
    double corner[4][3];
    for (int i = 0; i < 4; i++) {
        corner[i][axis] = at;
        corner[i][(axis + 1) % 3] = i & 1 ? high[0] : low[0];
        corner[i][(axis + 2) % 3] = i >> 1 ? high[1] : low[1];
    }
    stability_add(s, corner[0], corner[1], corner[2]);
    stability_add(s, corner[3], corner[2], corner[1]);
}

static void look_ahead(stability_scene *s, double x, double y, double z, double yfov, unsigned width, unsigned height)
{
    const double eye[3] = {x, y, z}, target[3] = {x, y, z - 1};
    stability_look(s, eye, target, yfov, width, height);
}

/* Cubes of edge 1/4 with corners on a lattice of quarters, in a cube of edge 2 `reach`; none holds the point in it. */
static void add_cubes(stability_scene *s, unsigned count, double reach, const double free[3])
{
    for (unsigned i = 0; i < count; i++) {
        double low[3], high[3];
        bool clear = false;
        for (int k = 0; k < 3; k++) {
            low[k] = floor(base_random_range(&s->random, -4 * reach, 4 * reach)) / 4;
            high[k] = low[k] + 0.25;
            clear |= free[k] < low[k] || free[k] > high[k];
        }
        if (clear)
            stability_box(s, low, high);
    }
}

/* A room whose walls are the scene's bounds; across it walls of half its section, and one in the plane of the camera. */
void stability_build_flat_leaves(stability_scene *s)
{
    static const double low[3] = {-2, -2, -2}, high[3] = {2, 2, 2}, all[2][2] = {{-2, -2}, {2, 2}}, half[2][2] = {{-2, -2}, {0, 2}};
    const double y = s->variant % 2 ? 0.5 : 0.25;
    look_ahead(s, 0.25, y, 1.5, base_random_range(&s->random, 0.5, 1.6), 17, 9);
    stability_box(s, low, high);
    add_rectangle(s, 2, -1, half[0], half[1]);
    add_rectangle(s, 1, 0.5, half[0], half[1]); /* of odd variants the camera's, seen edge-on */
    if (s->variant % 3)
        add_rectangle(s, 0, 1, all[0], half[1]);
    if (s->variant % 5 == 0) /* covers the whole section: nothing behind it is seen */
        add_rectangle(s, 2, -1.5, all[0], all[1]);
    stability_soup(s, 8, 0.4);
}

void stability_build_camera_on_planes(stability_scene *s)
{
    double eye[3], target[3];
    for (int k = 0; k < 3; k++) /* on one plane, two or three */
        eye[k] = k <= (int)(s->variant % 3) ? ((int)stability_random_below(s, 5) - 2) / 4.0 : base_random_range(&s->random, -0.5, 0.5);
    stability_random_direction(s, target);
    for (int k = 0; k < 3; k++)
        target[k] = s->variant % 4 ? eye[k] + target[k] : eye[k] - (k == 2); /* one in four along an axis */
    stability_look(s, eye, target, 1.4, 17, 9);
    add_cubes(s, 24, 1, eye);
}

void stability_build_along_axes(stability_scene *s)
{
    static const double low[3] = {-2, -2, -2}, high[3] = {2, 2, 2};
    double eye[3];
    stability_random_point(s, 0.4, eye);
    look_ahead(s, eye[0], eye[1], eye[2], 1.2, s->variant % 2 ? WIDE : WIDE + 1, 9);
    stability_box(s, low, high);
    add_cubes(s, 16, 1.5, eye);
}

/* Things on all sides, seen through a narrow lens: the planes of most lie behind the camera. */
void stability_build_planes_behind(stability_scene *s)
{
    double eye[3], target[3];
    stability_random_point(s, 0.5, eye);
    stability_random_direction(s, target);
    for (int k = 0; k < 3; k++)
        target[k] += eye[k];
    stability_look(s, eye, target, s->variant % 2 ? 0.7 : 0.1, WIDE, 8);
    add_cubes(s, 24, 2, eye);
    stability_soup(s, 24, 0.5);
}

/* At right angles to an axis, but for an angle that becomes smaller than any rounding. */
void stability_build_vanishing_components(stability_scene *s)
{
    const double angle = s->variant % 32 < 30 ? ldexp(1, -(int)(s->variant % 32)) : 0, yfov = ldexp(1, -(int)(s->variant % 7));
    double eye[3], target[3];
    stability_random_point(s, 0.4, eye);
    stability_random_direction(s, target);
    for (int k = 0; k < 3; k++)
        target[k] = k == 0 ? eye[0] + angle : eye[k] + target[k];
    stability_look(s, eye, target, yfov, WIDE, 8);
    stability_soup(s, 50, 0.7);
}

void stability_build_between_corner_rays(stability_scene *s)
{
    stability_look_anywhere(s, WIDE, 8);
    stability_aim(s);
    for (int i = 0; i < 12; i++) {
        const double x = 1 + stability_random_below(s, WIDE - 2), y = 1 + stability_random_below(s, 6);
        stability_add_about(s, x, y, ldexp(1, -(int)stability_random_below(s, 5)), base_random_range(&s->random, 0.3, 4));
    }
}

/* A wall across a room: of rectangles that overlap, that leave a hole, that meet in T-junctions; things before and behind it. */
void stability_build_covered_planes(stability_scene *s)
{
    static const double low[3] = {-2, -2, -2}, high[3] = {2, 2, 2};
    static const double parts[3][4][2][2] = {
        {{{-2, -2}, {1, 1}}, {{-1, -1}, {2, 2}}, {{-2, 0}, {0, 2}}, {{0, -2}, {2, 0}}},
        {{{-2, -2}, {0.5, 2}}, {{1, -2}, {2, 2}}, {{0.5, -2}, {1, -0.5}}, {{0.5, 0.5}, {1, 2}}},
        {{{-2, -2}, {0, 2}}, {{0, -2}, {2, -0.5}}, {{0, -0.5}, {2, 0.75}}, {{0, 0.75}, {2, 2}}},
    };
    double eye[3];
    stability_random_point(s, 0.5, eye);
    look_ahead(s, eye[0], eye[1], eye[2] + 1, base_random_range(&s->random, 0.6, 1.6), WIDE, 8);
    stability_box(s, low, high);
    for (int i = 0; i < 4; i++)
        add_rectangle(s, 2, -1, parts[s->variant % 3][i][0], parts[s->variant % 3][i][1]);
    stability_soup(s, 12, 0.5);
    for (int i = 0; i < 2; i++) {
        const double a[3] = {-1 + i, -1, -1.25 - 0.5 * i}, b[3] = {0.75 + i, -1, -1.5}, c[3] = {0, 1.5, -1.75};
        stability_add(s, a, b, c);
    }
}

/* A wall, and things behind a gap of a tenth of the cell, exactly where floats allow it; two clusters far apart; everything in one plane. */
void stability_build_gaps(stability_scene *s)
{
    const unsigned kind = s->variant % 3;
    stability_look_anywhere(s, 16, 8);
    if (kind == 0) {
        static const double section[2][2] = {{-1, -1}, {1, 1}};
        const double low[3] = {-0.75, -1, -1}, high[3] = {1.5, 1, 1};
        add_rectangle(s, 0, -1, section[0], section[1]);
        stability_box(s, low, high);
    }
    for (int i = 0; i < 40; i++) {
        double v[3][3];
        for (int j = 0; j < 3; j++) {
            stability_random_point(s, kind == 1 ? 0.25 : 1, v[j]);
            v[j][0] = kind == 0 ? fmax(v[j][0], -0.75) : kind == 1 ? v[j][0] + (i % 2 ? 8 : -0.25) : -1;
        }
        stability_add(s, v[0], v[1], v[2]);
    }
}

/* A cube; `missing` of its triangles are left out, and one is turned if `turned`. */
static void add_shell(stability_scene *s, double centre, double reach, unsigned missing, bool turned)
{
    const double low[3] = {centre - reach, centre - reach, -reach}, high[3] = {centre + reach, centre + reach, reach};
    const size_t first = s->count;
    stability_box(s, low, high);
    if (s->status != BASE_OK)
        return;
    s->count -= missing;
    if (turned) {
        scene_triangle *t = &s->triangles[first];
        float v[3];
        memcpy(v, t->v[1], sizeof v);
        memcpy(t->v[1], t->v[2], sizeof v);
        memcpy(t->v[2], v, sizeof v);
    }
}

void stability_build_nearly_closed(stability_scene *s)
{
    const unsigned kind = s->variant % 4;
    stability_look_anywhere(s, 16, 8);
    add_shell(s, 0, 0.5, kind == 0, kind == 1);
    if (kind == 2) /* nested */
        add_shell(s, 0, 0.25, 0, false);
    if (kind == 3) /* crossing */
        add_shell(s, 0.4, 0.5, 0, false);
    stability_soup(s, 20, 0.5);
}

/* The camera in a cube, the light in another; or both in one that a third encloses. */
void stability_build_inside_objects(stability_scene *s)
{
    double eye[3], target[3], light[3];
    stability_random_point(s, 0.4, eye);
    stability_random_point(s, 0.4, light);
    stability_random_direction(s, target);
    for (int k = 0; k < 3; k++)
        target[k] += eye[k];
    if (s->variant % 2)
        light[0] = light[1] = 1.25;
    stability_light(s, light);
    stability_look(s, eye, target, 1.4, 17, 9);
    add_shell(s, 0, 0.5, 0, false);
    add_shell(s, 1.25, 0.375, 0, false);
    if (s->variant % 3 == 0)
        add_shell(s, 0.5, 2, 0, false);
    stability_soup(s, 16, 0.5);
}

/* Next to nothing in a corner; a triangle before all else; slivers that no ray hits before one that all do. */
void stability_build_searches_that_end(stability_scene *s)
{
    const unsigned kind = s->variant % 3;
    stability_look_anywhere(s, WIDE, 8);
    stability_aim(s);
    if (kind == 0) {
        for (int i = 0; i < 6; i++)
            stability_add_about(s, stability_random_below(s, 6), stability_random_below(s, 6), 1.5, 1 + base_random_unit(&s->random));
        return;
    }
    for (int i = 0; i < 40; i++) {
        const double x = stability_random_below(s, WIDE - 1) + 0.5, y = stability_random_below(s, 7) + 0.5;
        stability_add_about(s, x, y, kind == 1 ? 2 : 0.2, (kind == 1 ? 2 : 0.5) + base_random_unit(&s->random));
    }
    stability_add_about(s, WIDE / 2, 4, 100, 1.75);
}

/* Long triangles, and copies of them, through the cells of many small ones. */
void stability_build_in_many_leaves(stability_scene *s)
{
    stability_look_anywhere(s, 16, 8);
    stability_soup(s, 60, 0.2);
    for (int i = 0; i < 4; i++) {
        double v[3][3];
        for (int j = 0; j < 3; j++)
            stability_random_point(s, 2, v[j]);
        for (unsigned copy = 0; copy <= stability_random_below(s, 3); copy++)
            stability_add(s, v[0], v[1], v[2]);
    }
}

/* All there is lies before a few of a tile's rays. */
void stability_build_beside_entry_points(stability_scene *s)
{
    stability_look_anywhere(s, WIDE, 8);
    stability_aim(s);
    const double x = 2 + stability_random_below(s, WIDE - 6), y = 2 + stability_random_below(s, 4);
    for (int i = 0; i < 30; i++)
        stability_add_about(s, x + base_random_range(&s->random, -1.5, 1.5), y + base_random_range(&s->random, -1.5, 1.5), 0.7,
                            base_random_range(&s->random, 1, 1.2));
}

/* A floor of many triangles and steps on it, the light in the floor's plane, in the steps' planes, at a corner, or above. */
void stability_build_shadow_ends(stability_scene *s)
{
    static const double lights[6][3] = {{3, -0.5, 0}, {0.5, 2, 0.5}, {0, 2, 0}, {0.5, 0.25, 0.5}, {1.5, 1, -1}, {0.25, -0.5, 0.25}};
    const double eye[3] = {base_random_range(&s->random, -1, 1), 1.5, 2.5}, target[3] = {0.2, -0.5, 0};
    stability_look(s, eye, target, 0.9, WIDE, 9);
    stability_light(s, lights[s->variant % 6]);
    for (int z = -2; z < 2; z++)
        for (int x = -2; x < 2; x++) {
            const double low[2] = {z, x}, high[2] = {z + 1, x + 1};
            add_rectangle(s, 1, -0.5, low, high);
        }
    for (int i = 0; i < 4; i++) { /* steps: their faces and the floor's make concave pairs */
        const double low[3] = {-1 + 0.5 * i, -0.5, -1 + 0.5 * i}, high[3] = {-0.5 + 0.5 * i, -0.25 + 0.25 * (i % 3), 0.5};
        stability_box(s, low, high);
    }
}

/* Identical triangles; others whose bounds close in on a point from one side. */
void stability_build_deep_trees(stability_scene *s)
{
    double v[3][3] = {{-0.6, -0.6, 0}, {0.7, -0.5, 0.1}, {0.1, 0.8, -0.1}};
    stability_look_anywhere(s, 16, 8);
    for (unsigned i = 0; i < 40; i++)
        stability_add(s, v[0], v[1], v[2]);
    for (unsigned i = 0; i < 60; i++) {
        double w[3][3];
        for (int k = 0; k < 9; k++)
            w[k / 3][k % 3] = 0.5 + ldexp(v[k / 3][k % 3], -(int)(i % 20)) + (s->variant % 2 ? ldexp(1, -(int)i) : 0);
        stability_add(s, w[0], w[1], w[2]);
    }
}
