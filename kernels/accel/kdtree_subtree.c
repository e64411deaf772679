/* The cells that wait lie on a stack with their references, the current one on top. A divided cell's references make
 * room for those of its upper half, which waits, and of its lower half, which is next.
 */
#include "kernels/accel/kdtree_subtree.h"

#include <stdlib.h>
#include <string.h>

#define MOST_PAIRS ((size_t)1 << 28) /* 4 GiB */
#define MOST_IDS ((size_t)1 << 30)   /* 4 GiB */
#define MOST_REFS (SIZE_MAX / 64)    /* no limit but the memory's */

/* A cell and where its node goes. */
typedef struct pending {
    kdtree_cell cell;
    size_t begin, count; /* in the worker's stack */
    unsigned depth;
    size_t node; /* in `pairs`; ROOT */
} pending;

#define ROOT SIZE_MAX

typedef struct build {
    const kdtree_rules *rules;
    unsigned max_depth;
    kdtree_worker *worker;
    kdtree_subtree *out;
    pending waiting[KDTREE_MAX_DEPTH + 1];
    unsigned waiting_count;
} build;

void kdtree_worker_free(kdtree_worker *worker)
{
    kdtree_bounds_free(&worker->bounds);
    free(worker->stack);
    free(worker->halves[0]);
    free(worker->halves[1]);
    memset(worker, 0, sizeof *worker);
}

/* Room for `wanted` elements, at most `most`, in a growing array. */
static base_status reserve(void **array, size_t *room, size_t wanted, size_t size, size_t most, base_error *err)
{
    if (wanted <= *room)
        return BASE_OK;
    if (wanted > most)
        return base_fail(err, BASE_ERR_INPUT, "kd-tree", "the tree is larger than 4 GiB");
    wanted += wanted / 2 + 16;
    void *grown = realloc(*array, wanted * size);
    if (!grown)
        return base_fail(err, BASE_ERR_NOMEM, "kd-tree", "out of memory");
    *array = grown;
    *room = wanted;
    return BASE_OK;
}

static base_status reserve_halves(kdtree_worker *w, size_t count, base_error *err)
{
    if (count <= w->half_room)
        return BASE_OK;
    for (int side = 0; side < 2; side++) {
        free(w->halves[side]);
        w->halves[side] = malloc(count * sizeof(kdtree_ref));
    }
    w->half_room = w->halves[0] && w->halves[1] ? count : 0;
    return w->half_room ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, "kd-tree", "out of memory");
}

base_status kdtree_span_split(const kdtree_rules *rules, unsigned max_depth, const kdtree_span *span, kdtree_bounds *bounds,
                              kdtree_split *out, base_error *err)
{
    kdtree_split axes[3];
    *out = (kdtree_split){.axis = -1};
    if (span->count == 0 || span->depth >= max_depth)
        return BASE_OK;
    kdtree_cell around = kdtree_refs_around(span->refs, span->count);
    *out = kdtree_split_empty(rules, &span->cell, &around);
    if (out->axis >= 0)
        return BASE_OK;
    base_status status = kdtree_split_covered(rules, &span->cell, span->refs, span->count, bounds, out, err);
    if (status != BASE_OK || out->axis >= 0)
        return status;
    status = kdtree_bounds_reserve(bounds, span->count, err);
    for (int axis = 0; status == BASE_OK && axis < 3; axis++) {
        for (int side = 0; side < 2; side++)
            kdtree_bounds_sort(bounds, side, span->refs, span->count, axis);
        axes[axis] = kdtree_split_cheapest(rules, &span->cell, bounds, span->count, axis);
    }
    if (status == BASE_OK)
        *out = kdtree_split_best(rules, &span->cell, axes, span->count);
    return status;
}

static kdtree_node *node_of(build *b, const pending *p)
{
    return p->node == ROOT ? &b->out->root : &b->out->pairs[p->node];
}

static base_status write_leaf(build *b, const pending *p, base_error *err)
{
    kdtree_subtree *out = b->out;
    const kdtree_ref *refs = b->worker->stack + p->begin;
    bool covered = false;
    base_status status = reserve((void **)&out->ids, &out->id_room, out->id_count + p->count, sizeof *out->ids, MOST_IDS, err);
    if (status == BASE_OK)
        status = kdtree_cell_covered(b->rules->triangles, &p->cell, refs, p->count, &covered, err);
    if (status != BASE_OK)
        return status;
    *node_of(b, p) = (kdtree_node){
        .link = (p->count ? (uint32_t)(4 * out->id_count) : 0) | KDTREE_LEAF,
        .extent = (uint32_t)(4 * p->count) | (covered ? KDTREE_COVERED : 0),
    };
    for (size_t i = 0; i < p->count; i++)
        out->ids[out->id_count++] = refs[i].id;
    return BASE_OK;
}

/* Make the two halves of a cell: the upper one waits, the lower one becomes *now. */
static base_status divide(build *b, const kdtree_split *split, pending *now, base_error *err)
{
    kdtree_worker *w = b->worker;
    kdtree_subtree *out = b->out;
    size_t counts[2], pair = 2 * out->pair_count;
    base_status status =
        reserve((void **)&out->pairs, &out->pair_room, out->pair_count + 1, 2 * sizeof *out->pairs, MOST_PAIRS, err);
    if (status == BASE_OK)
        status = reserve_halves(w, now->count, err);
    if (status != BASE_OK)
        return status;
    kdtree_refs_divide(b->rules, &now->cell, split, w->stack + now->begin, now->count, w->halves[0], w->halves[1], counts);
    status = reserve((void **)&w->stack, &w->stack_room, now->begin + counts[0] + counts[1], sizeof *w->stack, MOST_REFS, err);
    if (status != BASE_OK)
        return status;
    if (counts[1])
        memcpy(w->stack + now->begin, w->halves[1], counts[1] * sizeof *w->stack);
    if (counts[0])
        memcpy(w->stack + now->begin + counts[1], w->halves[0], counts[0] * sizeof *w->stack);
    *node_of(b, now) = (kdtree_node){.link = (uint32_t)(8 * pair) | (uint32_t)split->axis, .split = split->plane};
    out->pair_count++;
    const kdtree_cell below = kdtree_cell_half(&now->cell, split->axis, split->plane, 0);
    const kdtree_cell above = kdtree_cell_half(&now->cell, split->axis, split->plane, 1);
    b->waiting[b->waiting_count++] = (pending){above, now->begin, counts[1], now->depth + 1, pair + 1};
    *now = (pending){below, now->begin + counts[1], counts[0], now->depth + 1, pair};
    return BASE_OK;
}

base_status kdtree_subtree_build(const kdtree_rules *rules, unsigned max_depth, const kdtree_span *span, kdtree_worker *worker,
                                 kdtree_subtree *out, base_error *err)
{
    build b = {.rules = rules, .max_depth = max_depth, .worker = worker, .out = out};
    pending now = {span->cell, 0, span->count, span->depth, ROOT};
    base_status status =
        reserve((void **)&worker->stack, &worker->stack_room, span->count, sizeof *worker->stack, MOST_REFS, err);
    if (status == BASE_OK && span->count)
        memcpy(worker->stack, span->refs, span->count * sizeof *worker->stack);
    while (status == BASE_OK) {
        kdtree_split split;
        kdtree_span here = {worker->stack + now.begin, now.count, now.cell, now.depth};
        status = kdtree_span_split(rules, max_depth, &here, &worker->bounds, &split, err);
        if (status == BASE_OK && split.axis >= 0) {
            status = divide(&b, &split, &now, err);
            continue;
        }
        if (status == BASE_OK)
            status = write_leaf(&b, &now, err);
        if (b.waiting_count == 0)
            break;
        now = b.waiting[--b.waiting_count];
    }
    return status;
}
