#include "cli/suites/stability_cases.h"

#include <math.h>
#include <string.h>

const stability_place stability_places[STABILITY_PLACES] = {{0, 1e-4}, {0, 1}, {0, 1e4}, {1e3, 1e-4}, {1e3, 1}, {1e3, 1e4}, {1e6, 1e-4},
                                                            {1e6, 1}, {1e6, 1e4}};

static const double ahead[3] = {0, 0, -1};

/* A corner of a lattice of halves. */
static void lattice_point(stability_scene *s, double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = ((int)stability_random_below(s, 9) - 4) / 2.0;
}

static void lattice(stability_scene *s, unsigned count)
{
    for (unsigned i = 0; i < count; i++) {
        double v[3][3];
        for (int k = 0; k < 3; k++)
            lattice_point(s, v[k]);
        stability_add(s, v[0], v[1], v[2]);
    }
}

/* Boxes along the axes whose faces, edges and corners meet at 0. */
static void boxes_about_zero(stability_scene *s)
{
    for (int i = 0; i < 8; i++) {
        double low[3], high[3];
        for (int k = 0; k < 3; k++) {
            low[k] = i >> k & 1 ? 0 : -1;
            high[k] = low[k] + 1;
        }
        if (i != (int)(s->variant % 8))
            stability_box(s, low, high);
    }
}

/* X1: looking along an axis, the middle row and column have a component of exactly 0. */
static void build_zero_components(stability_scene *s)
{
    const double eye[3] = {0.25, -0.5, 2}, target[3] = {0.25, -0.5, 0};
    stability_look(s, eye, target, 0.9, 17, 9);
    stability_soup(s, 24, 0.8);
    lattice(s, 8);
}

/* X2: such rays, within the faces of boxes. */
static void build_origin_on_face_plane(stability_scene *s)
{
    const double eye[3] = {0, s->variant % 2 ? 0.5 : 0, 3}, target[3] = {0, eye[1], 0};
    stability_look(s, eye, target, 0.7, 17, 9);
    boxes_about_zero(s);
}

/* X3: the camera inside boxes, on their edges and corners; boxes without thickness. */
static void build_origin_in_boxes(stability_scene *s)
{
    double eye[3], target[3];
    for (int k = 0; k < 3; k++)
        eye[k] = (s->variant / (k == 0 ? 1 : k == 1 ? 3 : 9) % 3) / 2.0 - 0.5;
    stability_random_direction(s, target);
    for (int k = 0; k < 3; k++)
        target[k] += eye[k];
    stability_look(s, eye, target, 1.6, 16, 8);
    boxes_about_zero(s);
    for (int axis = 0; axis < 3; axis++)
        for (int side = -1; side <= 1; side += 2) { /* flat */
            double v[3][3] = {{-2, -2, -2}, {2, -2, -2}, {0, 2, 2}};
            for (int i = 0; i < 3; i++)
                v[i][axis] = 1.25 * side;
            stability_add(s, v[0], v[1], v[2]);
        }
}

/* X4: directions with denormal components, and very long ones. */
static void build_extreme_directions(stability_scene *s)
{
    static const double angles[] = {1e-42, 1e-38, 1e-30, 1e-20, 1e-8, 3.1, 3.14159, 3.141592653};
    double eye[3], target[3] = {0, 0, 0};
    stability_random_direction(s, eye);
    for (int k = 0; k < 3; k++)
        eye[k] = s->variant / 8 % 2 ? (k == 2) * 1.5 : 1.5 * eye[k];
    stability_look(s, eye, target, angles[s->variant % 8], 16, 8);
    stability_soup(s, 30, 1.2);
}

/* Triangles between points on pixel rays, (2 x + shift, 2 y) at the corners, wider than an image of 17 x 9; distances vary by `depth`. */
static void mesh_on_rays(stability_scene *s, double shift, double nearest, double depth)
{
    enum { CELLS_X = 10, CELLS_Y = 6 };
    double vertex[CELLS_Y + 1][CELLS_X + 1][3];
    for (int y = 0; y <= CELLS_Y; y++)
        for (int x = 0; x <= CELLS_X; x++)
            stability_along(s, 2 * x - 2 + shift, 2 * y - 2, nearest + depth * base_random_unit(&s->random), vertex[y][x]);
    for (int y = 0; y < CELLS_Y; y++)
        for (int x = 0; x < CELLS_X; x++) {
            double v[2][3][3];
            memcpy(v[0][0], vertex[y][x], sizeof v[0][0]);
            memcpy(v[0][1], vertex[y][x + 1], sizeof v[0][1]);
            memcpy(v[0][2], vertex[y + 1][x + 1], sizeof v[0][2]);
            memcpy(v[1][0], vertex[y + 1][x + 1], sizeof v[1][0]);
            memcpy(v[1][1], vertex[y + 1][x], sizeof v[1][1]);
            memcpy(v[1][2], vertex[y][x], sizeof v[1][2]);
            stability_add_placed(s, v[0]);
            stability_add_placed(s, v[1]);
        }
}

/* X5: every second row of rays is aimed at edges, clear of vertices. */
static void build_edges(stability_scene *s)
{
    stability_look_anywhere(s, 16, 9);
    stability_aim(s);
    mesh_on_rays(s, 0.5, 1, 1);
}

/* A closed fan of `valence` triangles about the point of a pixel's ray. */
static void fan(stability_scene *s, unsigned x, unsigned y, unsigned valence)
{
    double centre[3], rim[64][3], right[3], down[3];
    stability_along(s, x, y, 1.5, centre);
    stability_along(s, x + 1, y, 1.5, right);
    stability_along(s, x, y + 1, 1.5, down);
    for (unsigned i = 0; i < valence; i++) {
        /* corners of a square with `valence` points along its sides: no sine, which libraries round differently */
        const double along = 4.0 * i / valence, side = floor(along), part = 2 * (along - side) - 1;
        const double a = side == 0 ? part : side == 1 ? 1 : side == 2 ? -part : -1, b = side == 0 ? -1 : side == 1 ? part : side == 2 ? 1 : -part;
        const double reach = base_random_range(&s->random, 1, 1.8);
        for (int k = 0; k < 3; k++)
            rim[i][k] = centre[k] + reach * (a * (right[k] - centre[k]) + b * (down[k] - centre[k]));
    }
    for (unsigned i = 0; i < valence; i++) {
        double v[3][3];
        memcpy(v[0], centre, sizeof centre);
        memcpy(v[1], rim[i], sizeof v[1]);
        memcpy(v[2], rim[(i + 1) % valence], sizeof v[2]);
        stability_add_placed(s, v);
    }
}

/* X5: rays at vertices, of valence 6, or 3 to 64. */
static void build_vertices(stability_scene *s)
{
    stability_look_anywhere(s, 17, 9);
    stability_aim(s);
    if (s->variant % 2)
        mesh_on_rays(s, 0, 1, 1);
    else
        for (unsigned i = 0; i < 6; i++)
            fan(s, 2 + 5 * (i % 3), 2 + 5 * (i / 3), i == 0 ? 64 : 3 + stability_random_below(s, 20));
}

/* X6: needles along rows of pixel rays: slanting, facing the camera, and walls seen edge-on. */
static void build_needles(stability_scene *s)
{
    static const double widths[] = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6};
    stability_look_anywhere(s, 16, 8);
    stability_aim(s);
    for (int i = 0; i < 40; i++) {
        const double width = widths[stability_random_below(s, 5)] * s->place.scale, y = stability_random_below(s, s->height);
        const double x[2] = {stability_random_below(s, 16), stability_random_below(s, 16)};
        const double t[2] = {base_random_range(&s->random, 0.5, 3), base_random_range(&s->random, 0.5, 3)};
        double v[3][3];
        stability_along(s, x[0], y, t[0], v[0]);
        stability_along(s, i % 3 == 2 ? x[0] : x[1], y, i % 3 == 1 ? t[0] : t[1], v[1]);
        memcpy(v[2], v[1], sizeof v[2]);
        for (int k = 0; k < 3; k++) {
            v[1][k] -= 0.5 * width * s->camera.up[k];
            v[2][k] += (i % 3 == 2 ? 0.2 * s->place.scale : 0.5 * width) * s->camera.up[k];
        }
        stability_add_placed(s, v);
    }
}

/* X6: tiny triangles, vertices that are equal, vertices on a line. */
static void build_slivers(stability_scene *s)
{
    stability_look_anywhere(s, 16, 8);
    stability_aim(s);
    for (unsigned i = 0; i < 64; i++) {
        double v[3][3], along[3], other[3];
        const double size = (i % 2 ? 1e-10 : 1e-3) * s->place.scale;
        stability_along(s, i % 16, i / 16 * 2, base_random_range(&s->random, 0.5, 3), v[0]);
        stability_random_direction(s, along);
        stability_random_direction(s, other);
        for (int k = 0; k < 3; k++) {
            v[1][k] = i % 8 == 7 ? v[0][k] : v[0][k] + size * along[k];
            v[2][k] = i % 8 == 6 ? v[0][k] + 2 * (v[1][k] - v[0][k]) : v[0][k] + size * other[k];
        }
        stability_add_placed(s, v);
    }
    stability_soup(s, 4, 1);
}

/* X7: copies of triangles, opposites among them; triangles that overlap in a plane. */
static void build_coplanar(stability_scene *s)
{
    stability_look_anywhere(s, 16, 8);
    for (int i = 0; i < 6; i++) {
        double v[3][3];
        for (int k = 0; k < 3; k++)
            stability_random_point(s, 1, v[k]);
        for (int copy = 0; copy < 5; copy++) {
            const int opposite = (int)stability_random_below(s, 2);
            stability_add(s, v[0], v[1 + opposite], v[2 - opposite]);
        }
    }
    for (int i = 0; i < 12; i++) {
        double v[3][3];
        for (int k = 0; k < 3; k++) {
            lattice_point(s, v[k]);
            v[k][2] = -1;
        }
        stability_add(s, v[0], v[1], v[2]);
    }
}

/* X8: rays within triangles' planes; the camera in a plane, on an edge's line, on a vertex. */
static void build_camera_in_planes(stability_scene *s)
{
    double eye[3], target[3];
    for (int k = 0; k < 3; k++) {
        eye[k] = ((int)(s->variant / (k == 0 ? 1 : k == 1 ? 5 : 25) % 5) - 2) / 2.0;
        target[k] = eye[k] + ahead[k];
    }
    stability_look(s, eye, target, 1.2, 17, 9);
    lattice(s, 24);
    for (int i = 0; i < 12; i++) { /* in the planes of the middle row and column; a vertex at the camera */
        double v[3][3];
        for (int k = 0; k < 3; k++) {
            lattice_point(s, v[k]);
            v[k][i % 2] = eye[i % 2];
        }
        stability_add(s, i % 3 ? v[0] : eye, v[1], v[2]);
    }
}

/* X9: a surface through the camera, or less in front of it the higher the variant. */
static void build_surface_at_camera(stability_scene *s)
{
    const double height = s->variant % 3 == 0 ? 0 : ldexp(1, -1 - (int)(s->variant % 23));
    double eye[3], normal[3], at[3], v[3][3];
    stability_random_point(s, 0.5, eye);
    stability_random_direction(s, normal);
    for (int k = 0; k < 3; k++) {
        if (s->variant % 2)
            normal[k] = ahead[k];
        at[k] = eye[k] + normal[k];
    }
    stability_look(s, eye, at, 1.5, 16, 8);
    stability_soup(s, 12, 0.8);
    for (int i = 0; i < 3; i++) {
        double p[3], along = 0;
        stability_random_point(s, 3, p);
        for (int k = 0; k < 3; k++)
            along += (p[k] - eye[k]) * normal[k];
        for (int k = 0; k < 3; k++)
            v[i][k] = p[k] + (height - along) * normal[k];
    }
    stability_add(s, v[0], v[1], v[2]);
}

/* X10: nothing special but the places themselves. */
static void build_far_from_origin(stability_scene *s)
{
    stability_look_anywhere(s, 16, 8);
    stability_soup(s, 80, 0.6);
}

/* X11: vertices that are not finite. */
static void build_not_finite(stability_scene *s)
{
    static const float bad[] = {NAN, INFINITY, -INFINITY};
    stability_look_anywhere(s, 16, 8);
    stability_soup(s, 48, 0.6);
    for (size_t i = 0; i < s->count; i += 3)
        s->triangles[i].v[stability_random_below(s, 3)][stability_random_below(s, 3)] = bad[s->variant % 3];
}

/* X13: rays along the faces of boxes that are just large enough: what a reciprocal that is too short would lose. */
static void build_on_box_faces(stability_scene *s)
{
    static const double eye[3] = {0, 0, 0};
    stability_look(s, eye, ahead, base_random_range(&s->random, 0.4, 1.4), 17, 9);
    stability_aim(s);
    mesh_on_rays(s, s->variant % 2 ? 0.5 : 0, 1, 0);
}

/* X15: one triangle, all triangles identical, all centroids equal, a chain that no plane splits evenly. */
static void build_degenerate_trees(stability_scene *s)
{
    const unsigned kind = s->variant % 4, count = kind == 0 ? 1 : 30;
    double v[3][3] = {{-1, -0.6, 0.3}, {1.1, -0.5, -0.2}, {-0.1, 1.1, -0.1}};
    stability_look_anywhere(s, 16, 8);
    for (unsigned i = 0; i < count; i++) {
        double w[3][3];
        const double size = kind == 2 ? 1 + i / 10.0 : 1, shift = kind == 3 ? ldexp(1, -(int)i) : 0;
        for (int k = 0; k < 9; k++)
            w[k / 3][k % 3] = size * v[k / 3][k % 3] + shift;
        stability_add(s, w[0], w[1], w[2]);
    }
}

const stability_case *stability_case_list(size_t *count)
{
    static const stability_case cases[] = {
        {"X1", "direction components of exactly 0", build_zero_components},
        {"X2", "rays within the faces of boxes", build_origin_on_face_plane},
        {"X3", "camera in, on the edges and corners of boxes", build_origin_in_boxes},
        {"X4", "denormal components and very long directions", build_extreme_directions},
        {"X5e", "rays at the edges of a surface", build_edges},
        {"X5v", "rays at vertices of valence 3 to 64", build_vertices},
        {"X6n", "needles, walls seen edge-on", build_needles},
        {"X6s", "slivers and triangles without area", build_slivers},
        {"X7", "duplicates, opposites, coplanar triangles", build_coplanar},
        {"X8", "camera in planes, on edges, on vertices", build_camera_in_planes},
        {"X9", "a surface at or just before the camera", build_surface_at_camera},
        {"X10", "random triangles at all places", build_far_from_origin},
        {"X11", "vertices that are not finite", build_not_finite},
        {"X13", "rays along the faces of tight boxes", build_on_box_faces},
        {"X15", "one triangle, identical ones, equal centroids", build_degenerate_trees},
        {"A1", "packets across an axis plane", stability_build_signs_differ},
        {"A2", "images of odd sizes (X12: idle lanes)", stability_build_odd_sizes},
        {"A3", "all rays of a packet identical", stability_build_equal_rays},
        {"B1", "intervals that hold 0 or end at it", stability_build_intervals_with_zero},
        {"B2", "frusta of different signs, none holding 0", stability_build_intervals_without_zero},
        {"B3", "camera in boxes, their faces through it", stability_build_faces_through_origin},
        {"B5", "triangles behind, across, around, between rays", stability_build_culling},
        {"B6", "edges through corner rays and the camera", stability_build_edges_on_corner_rays},
        {"B7", "triangles about the corner rays alone", stability_build_around_corner_rays},
        {"B8", "frusta with 1 to 15 of 16 rays hit", stability_build_partly_covered},
        {"C1", "walls in flat cells, crossed and seen edge-on", stability_build_flat_leaves},
        {"C2", "camera on planes, edges, corners of cells", stability_build_camera_on_planes},
        {"C3", "tiles across two planes of the axes", stability_build_along_axes},
        {"C4", "planes behind the camera", stability_build_planes_behind},
        {"C5", "a component that vanishes within a tile", stability_build_vanishing_components},
        {"C6", "cells between the corner rays of a tile", stability_build_between_corner_rays},
        {"C7", "covered planes: overlaps, holes, T-junctions", stability_build_covered_planes},
        {"C8", "gaps of 10%, empty halves, all in one plane", stability_build_gaps},
        {"C9", "objects that are nearly closed, nested, crossing", stability_build_nearly_closed},
        {"C10", "camera, or light, inside closed objects", stability_build_inside_objects},
        {"C11", "tiles of nothing, of one triangle, of leaves in vain", stability_build_searches_that_end},
        {"C12", "triangles in many leaves, and duplicates", stability_build_in_many_leaves},
        {"C13", "rays beside the entry point's cell", stability_build_beside_entry_points},
        {"C14", "light at edges, coplanar neighbours, concave pairs", stability_build_shadow_ends},
        {"C15", "coincident triangles, planes without end", stability_build_deep_trees},
    };
    *count = sizeof cases / sizeof *cases;
    return cases;
}
