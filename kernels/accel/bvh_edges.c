#include "kernels/accel/bvh_edges.h"

#include <stdlib.h>
#include <string.h>

/* An edge as one of its triangles has it. */
typedef struct half_edge {
    float end[2][3]; /* the smaller first, so that all triangles of an edge agree; no -0 */
    uint32_t number; /* 3 * record + edge, with the top bit set if the triangle runs from the larger end to the smaller */
} half_edge;

static const uint32_t reversed = UINT32_C(1) << 31;
_Static_assert(3 * SCENE_MAX_TRIANGLES < UINT32_C(1) << 31, "half edges are numbered in 31 bits");

static const float *vertex_of(const bvh_triangle *t, unsigned vertex)
{
    return vertex == 0 ? t->v0 : vertex == 1 ? t->v1 : t->v2;
}

static int compare_places(const float a[3], const float b[3])
{
    for (int axis = 0; axis < 3; axis++)
        if (a[axis] < b[axis] || a[axis] > b[axis])
            return a[axis] < b[axis] ? -1 : 1;
    return 0;
}

static int compare_ends(const half_edge *a, const half_edge *b)
{
    const int first = compare_places(a->end[0], b->end[0]);
    return first ? first : compare_places(a->end[1], b->end[1]);
}

static int compare_half_edges(const void *a, const void *b)
{
    const half_edge *x = a, *y = b;
    const int ends = compare_ends(x, y);
    const uint32_t m = x->number & ~reversed, n = y->number & ~reversed;
    return ends ? ends : (m > n) - (m < n);
}

static half_edge half_edge_of(const bvh_triangle *t, uint32_t record, unsigned edge)
{
    const float *from = vertex_of(t, edge), *to = vertex_of(t, (edge + 1) % 3);
    half_edge h = {.number = 3 * record + edge};
    if (compare_places(from, to) > 0) {
        const float *other = from;
        from = to;
        to = other;
        h.number |= reversed;
    }
    for (int axis = 0; axis < 3; axis++) {
        h.end[0][axis] = from[axis] + 0.0f;
        h.end[1][axis] = to[axis] + 0.0f;
    }
    return h;
}

/* Tell half edge `at` that its only neighbour is `other`. */
static void join(const bvh *tree, uint32_t at, uint32_t other, bvh_edges *out)
{
    bvh_edges *e = &out[(at & ~reversed) / 3];
    const unsigned edge = (at & ~reversed) % 3;
    float *place = edge == 0 ? e->opposite0 : edge == 1 ? e->opposite1 : e->opposite2;
    memcpy(place, vertex_of(&tree->records[(other & ~reversed) / 3], ((other & ~reversed) % 3 + 2) % 3), 3 * sizeof *place);
}

/* The triangles of one edge. */
static void fill_edge(const bvh *tree, bool one_sided, const half_edge *h, size_t count, bvh_edges *out)
{
    const bool alike = count == 2 && ((h[0].number ^ h[1].number) & reversed) == 0;
    const bool joined = count == 2 && !(one_sided && alike);
    for (size_t i = 0; i < count; i++) {
        bvh_edges *e = &out[(h[i].number & ~reversed) / 3];
        const uint32_t bit = UINT32_C(1) << (4 * ((h[i].number & ~reversed) % 3));
        if (i == 0 || one_sided)
            e->own |= bit;
        if (joined)
            join(tree, h[i].number, h[1 - i].number, out);
        else
            e->always |= bit;
    }
}

base_status bvh_edges_fill(const bvh *tree, bool one_sided, bvh_edges *out, base_error *err)
{
    const size_t count = 3 * tree->record_count;
    half_edge *h = calloc(count ? count : 1, sizeof *h);
    if (!h)
        return base_fail(err, BASE_ERR_NOMEM, "edges", "out of memory for %zu triangles", tree->record_count);
    for (size_t i = 0; i < count; i++)
        h[i] = half_edge_of(&tree->records[i / 3], (uint32_t)(i / 3), (unsigned)(i % 3));
    qsort(h, count, sizeof *h, compare_half_edges);
    memset(out, 0, tree->record_count * sizeof *out);
    for (size_t i = 0, next; i < count; i = next) {
        for (next = i + 1; next < count && compare_ends(&h[i], &h[next]) == 0;)
            next++;
        fill_edge(tree, one_sided, h + i, next - i, out);
    }
    free(h);
    return BASE_OK;
}
