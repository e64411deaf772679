/* Hard cases of packets (A) and of frusta (B). */
#include <math.h>
#include <string.h>

#include "cli/suites/stability_cases.h"

/* A camera at a random point that looks along an axis. */
static void look_along_axis(stability_scene *s, double yfov, unsigned width, unsigned height)
{
    double eye[3], target[3];
    stability_random_point(s, 0.4, eye);
    memcpy(target, eye, sizeof target);
    target[2] -= 1;
    stability_look(s, eye, target, yfov, width, height);
}

void stability_build_signs_differ(stability_scene *s)
{
    static const unsigned widths[] = {18, 22, 14}; /* the middle lies within blocks */
    look_along_axis(s, 1.1, widths[s->variant % 3], 10);
    stability_soup(s, 50, 0.7);
}

void stability_build_odd_sizes(stability_scene *s)
{
    const unsigned width = 1 + stability_random_below(s, 21), height = 1 + stability_random_below(s, 21);
    stability_look_anywhere(s, width, height);
    stability_soup(s, 60, 0.7);
}

void stability_build_equal_rays(stability_scene *s)
{
    double eye[3], target[3] = {0, 0, 0};
    stability_random_direction(s, eye);
    stability_look(s, eye, target, 1e-12, 16, 8);
    stability_soup(s, 60, 0.9);
}

/* Looking at right angles to an axis: that component holds 0 in the middle frusta, or is 0 along a side of them. */
void stability_build_intervals_with_zero(stability_scene *s)
{
    static const unsigned widths[] = {17, 18, 25, 23}; /* 17, 25: the middle is the first pixel of a block, 23: its last */
    double eye[3], target[3];
    stability_random_point(s, 0.4, eye);
    stability_random_direction(s, target);
    for (int k = 0; k < 3; k++)
        target[k] = k == 0 ? eye[0] : eye[k] + target[k];
    stability_look(s, eye, target, 1.2, widths[s->variant % 4], 8);
    stability_soup(s, 50, 0.7);
}

void stability_build_intervals_without_zero(stability_scene *s)
{
    look_along_axis(s, 1.2, 16, 8); /* the middle lies between blocks */
    stability_soup(s, 50, 0.7);
}

void stability_build_faces_through_origin(stability_scene *s)
{
    static const double low[3] = {-1, -1, -1};
    const double eye[3] = {0, s->variant % 2 ? 0 : 0.25, 0}, target[3] = {0, eye[1], -1};
    stability_look(s, eye, target, 1.5, s->variant % 4 < 2 ? 17 : 16, s->variant % 4 < 2 ? 9 : 8);
    for (int i = 0; i < 4; i++) {
        const double high[3] = {i & 1 ? 0 : 1, i & 2 ? 0 : 1, i == 3 ? 0 : 1};
        stability_box(s, low, high);
    }
}

void stability_build_culling(stability_scene *s)
{
    stability_look_anywhere(s, 16, 16);
    stability_aim(s);
    for (int i = 0; i < 8; i++) {
        const double x = stability_random_below(s, 14), y = stability_random_below(s, 14);
        double v[3][3];
        stability_add_about(s, x, y, 2, -1 - base_random_unit(&s->random));             /* behind */
        stability_add_about(s, x + 0.5, y + 0.5, 0.2, 1 + base_random_unit(&s->random)); /* between rays */
        stability_add_about(s, x, y, 3, 1.5 + base_random_unit(&s->random));
        stability_along(s, x, y, 2 + base_random_unit(&s->random), v[0]); /* across the plane of the camera */
        stability_along(s, x + 1, y, -1, v[1]);
        stability_along(s, x, y + 1, -1.5, v[2]);
        stability_add_placed(s, v);
    }
    stability_add_about(s, 7, 7, 100, 4); /* around the whole group */
}

/* The pixels of a block that are corner rays, by number. */
static void corner_pixel(unsigned block, unsigned corner, double *x, double *y)
{
    *x = 4 * (block & 3) + (corner & 1 ? 3 : 0);
    *y = 4 * (block >> 2) + (corner & 2 ? 3 : 0);
}

void stability_build_edges_on_corner_rays(stability_scene *s)
{
    stability_look_anywhere(s, 16, 16);
    stability_aim(s);
    for (unsigned block = 0; block < 16; block++) {
        double v[3][3], x[3], y[3];
        for (unsigned i = 0; i < 3; i++) {
            corner_pixel(block, (i + s->variant) % 4, &x[i], &y[i]);
            stability_along(s, x[i], y[i], 1 + base_random_unit(&s->random), v[i]);
        }
        if (block % 4 == 3) /* an edge whose line passes through the camera */
            stability_along(s, x[0], y[0], 3, v[1]);
        stability_add_placed(s, v);
    }
    stability_add_about(s, 7, 7, 100, 4);
}

void stability_build_around_corner_rays(stability_scene *s)
{
    stability_look_anywhere(s, 16, 16);
    stability_aim(s);
    for (unsigned block = 0; block < 16; block++)
        for (unsigned corner = 0; corner < 4; corner++) {
            double x, y;
            corner_pixel(block, corner, &x, &y);
            stability_add_about(s, x, y, ldexp(1, -1 - (int)stability_random_below(s, 18)), 1 + base_random_unit(&s->random));
        }
}

void stability_build_partly_covered(stability_scene *s)
{
    stability_look_anywhere(s, 16, 16);
    stability_aim(s);
    for (unsigned block = 0; block < 16; block++) {
        const unsigned rays = 1 + stability_random_below(s, 15);
        for (unsigned i = 0; i < rays; i++)
            stability_add_about(s, 4 * (block & 3) + (i & 3), 4 * (block >> 2) + (i >> 2), 0.4, 1 + base_random_unit(&s->random));
    }
    for (int i = 0; i < 4; i++)
        stability_add_about(s, 7, 7, 100, 2 + 0.5 * i);
}
