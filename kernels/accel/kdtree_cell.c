#include "kernels/accel/kdtree_cell.h"

#include <math.h>

/* A corner of the clipped triangle. */
typedef struct corner {
    double p[3];
    double margin; /* 0: a vertex of the triangle */
} corner;

enum { MOST_CORNERS = 9 }; /* three, and one more for each cut */

double kdtree_cell_margin(const kdtree_cell *scene_cell)
{
    double largest = 0.0;
    for (int axis = 0; axis < 3; axis++)
        largest = fmax(largest, fmax(fabs((double)scene_cell->min[axis]), fabs((double)scene_cell->max[axis])));
    return largest * 0x1p-44;
}

/* Keep what lies above (sign 1) or below (sign -1) a plane; returns the number of corners left. */
static int cut(const corner *in, int count, int axis, double plane, double sign, double margin, corner *out)
{
    int kept = 0;
    for (int i = 0; i < count; i++) {
        const corner *a = &in[i], *b = &in[i + 1 < count ? i + 1 : 0];
        double da = sign * (a->p[axis] - plane), db = sign * (b->p[axis] - plane);
        if (da >= 0.0)
            out[kept++] = *a;
        if ((da < 0.0) != (db < 0.0)) {
            double t = da / (da - db);
            corner *made = &out[kept++];
            for (int k = 0; k < 3; k++)
                made->p[k] = a->p[k] + t * (b->p[k] - a->p[k]);
            made->p[axis] = plane;
            made->margin = margin;
        }
    }
    return kept;
}

static float round_down(double x)
{
    float f = (float)x;
    return ((double)f > x ? nextafterf(f, -INFINITY) : f) + 0.0f;
}

static float round_up(double x)
{
    float f = (float)x;
    return ((double)f < x ? nextafterf(f, INFINITY) : f) + 0.0f;
}

/* The box of the corners, cut with the reference's own; false if nothing is left. */
static bool shrink(const corner *corners, int count, kdtree_ref *ref)
{
    for (int axis = 0; axis < 3; axis++) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (int i = 0; i < count; i++) {
            double below = corners[i].p[axis] - corners[i].margin, above = corners[i].p[axis] + corners[i].margin;
            low = below < low ? below : low;
            high = above > high ? above : high;
        }
        float min = round_down(low), max = round_up(high);
        if (min > ref->box.min[axis])
            ref->box.min[axis] = min;
        if (max < ref->box.max[axis])
            ref->box.max[axis] = max;
        if (ref->box.min[axis] > ref->box.max[axis])
            return false;
    }
    return true;
}

bool kdtree_cell_clip(const kdtree_cell *cell, const scene_triangle *triangle, double margin, kdtree_ref *ref)
{
    corner buffers[2][MOST_CORNERS];
    int count = 3, from = 0;
    for (int i = 0; i < 3; i++)
        buffers[0][i] = (corner){{(double)triangle->v[i][0], (double)triangle->v[i][1], (double)triangle->v[i][2]}, 0.0};
    for (int axis = 0; axis < 3; axis++) {
        float a = triangle->v[0][axis], b = triangle->v[1][axis], c = triangle->v[2][axis];
        if (a < cell->min[axis] || b < cell->min[axis] || c < cell->min[axis]) {
            count = cut(buffers[from], count, axis, (double)cell->min[axis] - margin, 1.0, margin, buffers[from ^ 1]);
            from ^= 1;
        }
        if (a > cell->max[axis] || b > cell->max[axis] || c > cell->max[axis]) {
            count = cut(buffers[from], count, axis, (double)cell->max[axis] + margin, -1.0, margin, buffers[from ^ 1]);
            from ^= 1;
        }
    }
    return count > 0 && shrink(buffers[from], count, ref);
}
