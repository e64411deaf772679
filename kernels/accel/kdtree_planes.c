/* Rule 2: planes that triangles cover. */
#include <math.h>
#include <stdlib.h>

#include "kernels/accel/kdtree_cover.h"
#include "kernels/accel/kdtree_split.h"

/* Triangles in one plane, sorted by plane and id. */
typedef struct flat_ref {
    float plane;
    uint32_t index; /* in the references */
} flat_ref;

static int compare_flat(const void *a, const void *b)
{
    const flat_ref *x = a, *y = b;
    if (x->plane != y->plane)
        return x->plane < y->plane ? -1 : 1;
    return x->index < y->index ? -1 : x->index > y->index;
}

static bool lies_in_plane(const scene_triangle *t, int axis, float plane)
{
    return t->v[0][axis] == plane && t->v[1][axis] == plane && t->v[2][axis] == plane;
}

/* Whether the triangles of `flat` that lie in their plane cover the cell's section there. */
static base_status section_covered(const scene_triangle *all, const kdtree_cell *cell, int axis, const kdtree_ref *refs,
                                   const flat_ref *flat, size_t count, bool *covered, base_error *err)
{
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    kdtree_rectangle section = {{(double)cell->min[u], (double)cell->min[v]}, {(double)cell->max[u], (double)cell->max[v]}};
    double area = kdtree_cell_length(cell, u) * kdtree_cell_length(cell, v), boxes = 0.0;
    *covered = false;
    for (size_t i = 0; i < count; i++) {
        const kdtree_cell *box = &refs[flat[i].index].box;
        boxes += kdtree_cell_length(box, u) * kdtree_cell_length(box, v);
    }
    if (!(area > 0.0) || boxes < area * (1.0 - 1e-6)) /* the usual case: far too little */
        return BASE_OK;
    kdtree_flat_triangle *triangles = malloc(count * sizeof *triangles);
    size_t kept = 0;
    if (!triangles)
        return base_fail(err, BASE_ERR_NOMEM, "kd-tree", "out of memory");
    for (size_t i = 0; i < count; i++) {
        const scene_triangle *t = &all[refs[flat[i].index].id];
        if (!lies_in_plane(t, axis, flat[i].plane))
            continue;
        for (int corner = 0; corner < 3; corner++) {
            triangles[kept].v[corner][0] = (double)t->v[corner][u];
            triangles[kept].v[corner][1] = (double)t->v[corner][v];
        }
        kept++;
    }
    base_status status = kdtree_cover(&section, triangles, kept, covered, err);
    free(triangles);
    return status;
}

/* The triangles across an axis, sorted; *flat is owned by the caller, NULL if there are none. */
static base_status collect_flat(const kdtree_ref *refs, size_t count, int axis, flat_ref **flat, size_t *flat_count,
                                base_error *err)
{
    size_t found = 0;
    *flat = NULL;
    for (size_t i = 0; i < count; i++)
        found += refs[i].box.min[axis] == refs[i].box.max[axis];
    *flat_count = found;
    if (found == 0)
        return BASE_OK;
    *flat = malloc(found * sizeof **flat);
    if (!*flat)
        return base_fail(err, BASE_ERR_NOMEM, "kd-tree", "out of memory");
    found = 0;
    for (size_t i = 0; i < count; i++)
        if (refs[i].box.min[axis] == refs[i].box.max[axis])
            (*flat)[found++] = (flat_ref){refs[i].box.min[axis], (uint32_t)i};
    qsort(*flat, found, sizeof **flat, compare_flat);
    return BASE_OK;
}

static base_status sort_bounds(kdtree_bounds *bounds, const kdtree_ref *refs, size_t count, int axis, base_error *err)
{
    base_status status = kdtree_bounds_reserve(bounds, count, err);
    for (int side = 0; status == BASE_OK && side < 2; side++)
        kdtree_bounds_sort(bounds, side, refs, count, axis);
    return status;
}

/* The best covered plane across one axis, if it is better than *best. */
static base_status covered_on_axis(const kdtree_rules *rules, const kdtree_cell *cell, const kdtree_ref *refs, size_t count,
                                   int axis, kdtree_bounds *bounds, kdtree_split *best, base_error *err)
{
    flat_ref *flat;
    size_t flat_count;
    bool sorted = false;
    base_status status = collect_flat(refs, count, axis, &flat, &flat_count, err);
    for (size_t first = 0, end; status == BASE_OK && first < flat_count; first = end) {
        bool covered;
        for (end = first + 1; end < flat_count && flat[end].plane == flat[first].plane; end++)
            ;
        status = section_covered(rules->triangles, cell, axis, refs, flat + first, end - first, &covered, err);
        if (status == BASE_OK && covered && !sorted)
            status = sort_bounds(bounds, refs, count, axis, err);
        sorted |= covered;
        if (status != BASE_OK || !covered)
            continue;
        kdtree_split split = kdtree_split_at_plane(cell, bounds, count, axis, flat[first].plane);
        if (best->axis < 0 || split.cost < best->cost)
            *best = split;
    }
    free(flat);
    return status;
}

base_status kdtree_split_covered(const kdtree_rules *rules, const kdtree_cell *cell, const kdtree_ref *refs, size_t count,
                                 kdtree_bounds *bounds, kdtree_split *out, base_error *err)
{
    base_status status = BASE_OK;
    *out = (kdtree_split){.axis = -1};
    for (int axis = 0; rules->covered_planes && status == BASE_OK && axis < 3; axis++)
        if (kdtree_cell_length(cell, axis) > 0.0)
            status = covered_on_axis(rules, cell, refs, count, axis, bounds, out, err);
    return status;
}

base_status kdtree_cell_covered(const scene_triangle *triangles, const kdtree_cell *cell, const kdtree_ref *refs, size_t count,
                                bool *covered, base_error *err)
{
    int flat_axis = -1, flat_axes = 0;
    flat_ref *flat;
    size_t flat_count;
    *covered = false;
    for (int axis = 0; axis < 3; axis++)
        if (cell->min[axis] == cell->max[axis]) {
            flat_axis = axis;
            flat_axes++;
        }
    if (flat_axes != 1 || count == 0)
        return BASE_OK;
    base_status status = collect_flat(refs, count, flat_axis, &flat, &flat_count, err);
    if (status == BASE_OK)
        status = section_covered(triangles, cell, flat_axis, refs, flat, flat_count, covered, err);
    free(flat);
    return status;
}
