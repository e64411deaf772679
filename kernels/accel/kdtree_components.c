#include "kernels/accel/kdtree_components.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/accel/kdtree.h"
#include "lrbni/base/hash.h"

#define NONE UINT32_MAX

/* An edge in the list of the lower of its two vertices; its triangle runs along it to the other one, or back. */
typedef struct edge {
    uint32_t other, triangle : 31, back : 1;
} edge;
_Static_assert(SCENE_MAX_TRIANGLES <= INT32_MAX, "31 bits hold a triangle's number");

/* What keeps a component from being closed or oriented. */
enum { ODD = 1 /* an edge used an odd number of times */, UNEVEN = 2 /* an edge used more often one way than the other */ };

typedef struct mesh {
    const scene *scene;
    size_t corners;    /* three a triangle */
    uint32_t *vertex;  /* by corner: the first corner at the same position; NONE: of a triangle that joins nothing */
    uint32_t *table;   /* hash table of such first corners */
    size_t table_size; /* a power of two */
    uint32_t *first;   /* by vertex: its first edge; one more at the end */
    edge *edges;
    uint32_t *parent; /* by triangle: union-find, towards lower numbers */
    uint8_t *flaws;   /* by triangle: of its edges */
} mesh;

static const float *position(const mesh *m, size_t corner)
{
    return m->scene->triangles[corner / 3].v[corner % 3];
}

static bool same_place(const float a[3], const float b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

static uint32_t weld(mesh *m, size_t corner)
{
    const float *p = position(m, corner);
    float place[3] = {p[0] + 0.0f, p[1] + 0.0f, p[2] + 0.0f};
    uint64_t hash = base_hash(BASE_HASH_START, place, sizeof place);
    for (size_t slot = (hash ^ hash >> 32) & (m->table_size - 1);; slot = (slot + 1) & (m->table_size - 1)) {
        if (m->table[slot] == NONE)
            m->table[slot] = (uint32_t)corner;
        if (same_place(position(m, m->table[slot]), p))
            return m->table[slot];
    }
}

/* Give every corner its vertex; NONE for all three of a triangle that joins nothing. */
static void weld_all(mesh *m)
{
    memset(m->table, 0xff, m->table_size * sizeof *m->table);
    for (size_t corner = 0; corner < m->corners; corner += 3) {
        bool joins = true;
        for (size_t i = 0; i < 3; i++) {
            const float *p = position(m, corner + i);
            joins &= isfinite(p[0]) && isfinite(p[1]) && isfinite(p[2]);
        }
        for (size_t i = 0; i < 3; i++)
            m->vertex[corner + i] = joins ? weld(m, corner + i) : NONE;
        uint32_t *v = m->vertex + corner;
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0])
            v[0] = v[1] = v[2] = NONE;
    }
}

/* The corners of the edge that starts at a corner, in the order of their vertices. */
static void edge_vertices(const mesh *m, size_t corner, uint32_t *low, uint32_t *high)
{
    uint32_t a = m->vertex[corner], b = m->vertex[corner % 3 == 2 ? corner - 2 : corner + 1];
    *low = a < b ? a : b;
    *high = a < b ? b : a;
}

/* List the edges by their lower vertices. */
static void list_edges(mesh *m)
{
    uint32_t low, high, sum = 0;
    memset(m->first, 0, (m->corners + 1) * sizeof *m->first);
    for (size_t corner = 0; corner < m->corners; corner++)
        if (m->vertex[corner] != NONE) {
            edge_vertices(m, corner, &low, &high);
            m->first[low]++;
        }
    for (size_t vertex = 0; vertex <= m->corners; vertex++) {
        uint32_t n = m->first[vertex];
        m->first[vertex] = sum;
        sum += n;
    }
    for (size_t corner = m->corners; corner-- > 0;)
        if (m->vertex[corner] != NONE) {
            edge_vertices(m, corner, &low, &high);
            m->edges[m->first[low]++] = (edge){high, (uint32_t)(corner / 3), m->vertex[corner] == high};
        }
    for (size_t vertex = m->corners; vertex > 0; vertex--) /* the places have moved on by one list */
        m->first[vertex] = m->first[vertex - 1];
    m->first[0] = 0;
}

static int compare_edges(const void *a, const void *b)
{
    const edge *x = a, *y = b;
    if (x->other != y->other)
        return x->other < y->other ? -1 : 1;
    return x->triangle < y->triangle ? -1 : x->triangle > y->triangle;
}

static uint32_t root_of(uint32_t *parent, uint32_t i)
{
    while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
    return i;
}

static void join(uint32_t *parent, uint32_t a, uint32_t b)
{
    a = root_of(parent, a);
    b = root_of(parent, b);
    if (a < b)
        parent[b] = a;
    else
        parent[a] = b;
}

/* Join the triangles of every edge, and note the flaws of edges. */
static void join_edges(mesh *m)
{
    for (size_t vertex = 0; vertex < m->corners; vertex++) {
        edge *list = m->edges + m->first[vertex];
        size_t count = m->first[vertex + 1] - m->first[vertex], end;
        if (count > 1)
            qsort(list, count, sizeof *list, compare_edges);
        for (size_t i = 0; i < count; i = end) {
            size_t back = list[i].back;
            for (end = i + 1; end < count && list[end].other == list[i].other; end++) {
                join(m->parent, list[i].triangle, list[end].triangle);
                back += list[end].back;
            }
            m->flaws[list[i].triangle] |= ((end - i) % 2 != 0 ? ODD : 0) | (2 * back != end - i ? UNEVEN : 0);
        }
    }
}

static void number_components(mesh *m, uint32_t *component, size_t *count)
{
    size_t triangles = m->scene->triangle_count;
    *count = 0;
    for (size_t i = 0; i < triangles; i++) {
        uint32_t root = root_of(m->parent, (uint32_t)i);
        m->flaws[root] |= m->flaws[i] | (m->vertex[3 * i] == NONE ? ODD : 0);
    }
    for (size_t i = 0; i < triangles; i++) { /* a component's root is its first triangle */
        uint32_t root = root_of(m->parent, (uint32_t)i);
        if (root != i)
            component[i] = component[root];
        else if (m->flaws[i] & ODD)
            component[i] = KDTREE_OPEN;
        else
            component[i] = (uint32_t)(*count)++ << 1 | (m->flaws[i] & UNEVEN ? 0 : KDTREE_ORIENTED);
    }
}

base_status kdtree_components_find(const scene *s, uint32_t *component, size_t *count, base_error *err)
{
    mesh m = {.scene = s, .corners = 3 * s->triangle_count, .table_size = 16};
    while (m.table_size < m.corners + m.corners / 2)
        m.table_size *= 2;
    m.vertex = malloc((m.corners + 1) * sizeof *m.vertex);
    m.table = malloc(m.table_size * sizeof *m.table);
    m.first = malloc((m.corners + 2) * sizeof *m.first);
    m.edges = malloc((m.corners + 1) * sizeof *m.edges);
    m.parent = malloc((s->triangle_count + 1) * sizeof *m.parent);
    m.flaws = calloc(s->triangle_count + 1, sizeof *m.flaws);
    bool enough = m.vertex && m.table && m.first && m.edges && m.parent && m.flaws;
    if (enough) {
        for (size_t i = 0; i < s->triangle_count; i++)
            m.parent[i] = (uint32_t)i;
        weld_all(&m);
        list_edges(&m);
        join_edges(&m);
        number_components(&m, component, count);
    }
    free(m.vertex);
    free(m.table);
    free(m.first);
    free(m.edges);
    free(m.parent);
    free(m.flaws);
    return enough ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, "kd-tree", "out of memory");
}
