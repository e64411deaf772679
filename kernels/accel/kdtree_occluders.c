#include "kernels/accel/kdtree_occluders.h"

#include <stdlib.h>
#include <string.h>

#include "kernels/accel/kdtree_cell.h"
#include "kernels/accel/kdtree_components.h"
#include "kernels/accel/kdtree_inside.h"
#include "lrbni/base/parallel.h"

enum {
    PIECE = 1 << 12, /* empty leaves that one thread works on at a time */
    TRIES = 8        /* points of a leaf, before it is given up */
};

/* An empty leaf with volume. */
typedef struct empty_leaf {
    kdtree_cell cell;
    uint32_t node;
    uint32_t set; /* number among those of its piece, from 1; 0: in no component */
} empty_leaf;

/* Sets that a piece of work found, each once; a leaf refers to one by its number here. */
typedef struct local_sets {
    kdtree_set *sets;
    uint32_t *members;
    size_t set_count, set_room, member_count, member_room;
} local_sets;

typedef struct finder {
    kdtree *tree;
    kdtree_cell closed; /* the box around all closed components */
    empty_leaf *leaves;
    size_t leaf_count, leaf_room;
    local_sets *pieces;
    kdtree_inside *scratch; /* by thread */
    base_status *statuses;  /* by thread */
} finder;

static base_status out_of_memory(base_error *err)
{
    return base_fail(err, BASE_ERR_NOMEM, "kd-tree", "out of memory");
}

/* Room for one more element. */
static bool reserve(void **array, size_t *room, size_t wanted, size_t size)
{
    if (wanted <= *room)
        return true;
    wanted += wanted / 2 + 8;
    void *grown = realloc(*array, wanted * size);
    if (!grown)
        return false;
    *array = grown;
    *room = wanted;
    return true;
}

/* ---- components ---- */

/* Components by record; returns whether any is closed, and the box around those. */
static base_status find_components(const scene *s, kdtree *tree, kdtree_cell *closed, size_t *count, base_error *err)
{
    uint32_t *component = malloc((s->triangle_count + 1) * sizeof *component);
    if (!component)
        return out_of_memory(err);
    base_status status = kdtree_components_find(s, component, count, err);
    *closed = (kdtree_cell){{tree->max[0], tree->max[1], tree->max[2]}, {tree->min[0], tree->min[1], tree->min[2]}};
    for (size_t i = 0; status == BASE_OK && i < tree->record_count; i++) {
        const scene_triangle *t = &s->triangles[tree->records[i].id];
        tree->components[i] = component[tree->records[i].id];
        for (int k = 0; tree->components[i] != KDTREE_OPEN && k < 9; k++) {
            float value = t->v[k / 3][k % 3];
            closed->min[k % 3] = value < closed->min[k % 3] ? value : closed->min[k % 3];
            closed->max[k % 3] = value > closed->max[k % 3] ? value : closed->max[k % 3];
        }
    }
    free(component);
    return status;
}

/* ---- empty leaves ---- */

static bool may_be_inside(const kdtree_cell *cell, const kdtree_cell *closed)
{
    for (int axis = 0; axis < 3; axis++)
        if (!(cell->max[axis] > cell->min[axis]) || cell->min[axis] < closed->min[axis] || cell->max[axis] > closed->max[axis])
            return false;
    return true;
}

/* List the empty leaves with volume within the box of the closed components. */
static base_status list_leaves(finder *f, base_error *err)
{
    const kdtree *tree = f->tree;
    empty_leaf stack[KDTREE_MAX_DEPTH + 2];
    size_t used = 0;
    stack[used++] = (empty_leaf){{{tree->min[0], tree->min[1], tree->min[2]}, {tree->max[0], tree->max[1], tree->max[2]}}, 0, 0};
    while (used > 0) {
        empty_leaf now = stack[--used];
        const kdtree_node *node = &tree->nodes[now.node];
        if (!kdtree_is_leaf(node)) {
            uint32_t child = (uint32_t)(kdtree_children(tree, node) - tree->nodes);
            int axis = (int)(node->link & KDTREE_KIND);
            for (uint32_t side = 2; side-- > 0;)
                stack[used++] = (empty_leaf){kdtree_cell_half(&now.cell, axis, node->split, (int)side), child + side, 0};
        } else if (kdtree_leaf_count(node) == 0 && may_be_inside(&now.cell, &f->closed)) {
            if (!reserve((void **)&f->leaves, &f->leaf_room, f->leaf_count + 1, sizeof *f->leaves))
                return out_of_memory(err);
            f->leaves[f->leaf_count++] = now;
        }
    }
    return BASE_OK;
}

/* A point of a cell: its centre at first, later ones all over it. */
static void point_of(const kdtree_cell *cell, int try, double point[3])
{
    static const double step[3] = {0.6180339887, 0.7548776662, 0.5698402910}; /* irrational enough */
    for (int axis = 0; axis < 3; axis++) {
        double share = 0.5 + (double)try * step[axis];
        share -= (double)(long)share;
        point[axis] = (double)cell->min[axis] + (0.1 + 0.8 * share) * kdtree_cell_length(cell, axis);
    }
}

/* The axis and direction in which the box of the closed components ends first, in lengths of it. */
static void shortest_way(const kdtree_cell *closed, const double point[3], int *axis, int *up)
{
    double shortest = 2.0;
    for (int k = 0; k < 3; k++) {
        double share = (point[k] - (double)closed->min[k]) / kdtree_cell_length(closed, k);
        double way = share < 0.5 ? share : 1.0 - share;
        if (way < shortest) {
            shortest = way;
            *axis = k;
            *up = share >= 0.5;
        }
    }
}

/* ---- sets ---- */

static int compare_members(const uint32_t *a, size_t a_count, const uint32_t *b, size_t b_count)
{
    for (size_t i = 0; i < a_count && i < b_count; i++)
        if (a[i] != b[i])
            return a[i] < b[i] ? -1 : 1;
    return a_count < b_count ? -1 : a_count > b_count;
}

/* Number of a set among those of a piece; SIZE_MAX: out of memory. The latest is looked at first: leaves have neighbours. */
static size_t local_number(local_sets *l, const uint32_t *members, size_t count)
{
    for (size_t i = l->set_count; i-- > 0;)
        if (compare_members(l->members + l->sets[i].first, l->sets[i].count, members, count) == 0)
            return i;
    if (!reserve((void **)&l->sets, &l->set_room, l->set_count + 1, sizeof *l->sets) ||
        !reserve((void **)&l->members, &l->member_room, l->member_count + count, sizeof *l->members))
        return SIZE_MAX;
    l->sets[l->set_count] = (kdtree_set){(uint32_t)l->member_count, (uint32_t)count};
    memcpy(l->members + l->member_count, members, count * sizeof *members);
    l->member_count += count;
    return l->set_count++;
}

/* Find the set of one leaf. */
static base_status find_set(const finder *f, empty_leaf *leaf, local_sets *sets, kdtree_inside *inside)
{
    base_status status = BASE_OK;
    for (int try = 0; status == BASE_OK && try < TRIES; try++) {
        double point[3];
        int axis = 0, up = 0;
        point_of(&leaf->cell, try, point);
        shortest_way(&f->closed, point, &axis, &up);
        status = kdtree_inside_find(f->tree, point, axis, up, inside, NULL);
        if (status != BASE_OK || inside->unsure_count > 0)
            continue;
        if (inside->inside_count == 0)
            return BASE_OK;
        size_t number = local_number(sets, inside->inside, inside->inside_count);
        if (number == SIZE_MAX)
            return BASE_ERR_NOMEM;
        leaf->set = (uint32_t)number + 1;
        return BASE_OK;
    }
    return status;
}

static void find_sets(void *user, size_t piece, unsigned worker)
{
    finder *f = user;
    size_t end = (piece + 1) * PIECE < f->leaf_count ? (piece + 1) * PIECE : f->leaf_count;
    for (size_t i = piece * PIECE; i < end && f->statuses[worker] == BASE_OK; i++)
        f->statuses[worker] = find_set(f, &f->leaves[i], &f->pieces[piece], &f->scratch[worker]);
}

/* A set of a piece, to be sorted. */
typedef struct found_set {
    const uint32_t *members;
    size_t count, number;
} found_set;

static int compare_found(const void *a, const void *b)
{
    const found_set *x = a, *y = b;
    return compare_members(x->members, x->count, y->members, y->count);
}

/* Give equal sets of all pieces one number, in the order of their members, and put those into the leaves. */
static base_status join_sets(finder *f, size_t pieces, base_error *err)
{
    kdtree *tree = f->tree;
    size_t found_count = 0, members = 0;
    for (size_t p = 0; p < pieces; p++) {
        found_count += f->pieces[p].set_count;
        members += f->pieces[p].member_count;
    }
    found_set *found = malloc((found_count + 1) * sizeof *found);
    uint32_t *numbers = malloc((found_count + 1) * sizeof *numbers); /* by piece and local number */
    kdtree_set *sets = realloc(tree->sets, (found_count + 1) * sizeof *sets);
    tree->sets = sets ? sets : tree->sets;
    tree->members = malloc((members + 1) * sizeof *tree->members);
    if (!found || !numbers || !sets || !tree->members) {
        free(found);
        free(numbers);
        return out_of_memory(err);
    }
    found_count = 0;
    for (size_t p = 0; p < pieces; p++)
        for (size_t i = 0; i < f->pieces[p].set_count; i++, found_count++) {
            const kdtree_set *set = &f->pieces[p].sets[i];
            found[found_count] = (found_set){f->pieces[p].members + set->first, set->count, found_count};
        }
    qsort(found, found_count, sizeof *found, compare_found);
    for (size_t i = 0; i < found_count; i++) {
        if (i == 0 || compare_found(&found[i - 1], &found[i]) != 0) {
            sets[tree->set_count++] = (kdtree_set){(uint32_t)tree->member_count, (uint32_t)found[i].count};
            memcpy(tree->members + tree->member_count, found[i].members, found[i].count * sizeof *found[i].members);
            tree->member_count += found[i].count;
        }
        numbers[found[i].number] = (uint32_t)(tree->set_count - 1);
    }
    for (size_t i = 0, first = 0; i < f->leaf_count; i++) {
        const empty_leaf *leaf = &f->leaves[i];
        if (i > 0 && i % PIECE == 0)
            first += f->pieces[i / PIECE - 1].set_count;
        if (leaf->set == 0)
            continue;
        tree->nodes[leaf->node].link = 4 * numbers[first + leaf->set - 1] | KDTREE_LEAF;
    }
    free(found);
    free(numbers);
    return BASE_OK;
}

static base_status find_in_leaves(finder *f, unsigned jobs, base_error *err)
{
    size_t pieces = (f->leaf_count + PIECE - 1) / PIECE;
    base_status status = BASE_OK;
    f->pieces = calloc(pieces + 1, sizeof *f->pieces);
    f->scratch = calloc(jobs, sizeof *f->scratch);
    f->statuses = calloc(jobs, sizeof *f->statuses);
    if (!f->pieces || !f->scratch || !f->statuses)
        return out_of_memory(err);
    base_parallel_for(jobs, pieces, find_sets, f);
    for (unsigned worker = 0; worker < jobs; worker++) {
        kdtree_inside_free(&f->scratch[worker]);
        status = f->statuses[worker] != BASE_OK ? f->statuses[worker] : status;
    }
    status = status == BASE_OK ? join_sets(f, pieces, err) : out_of_memory(err);
    for (size_t p = 0; p < pieces; p++) {
        free(f->pieces[p].sets);
        free(f->pieces[p].members);
    }
    return status;
}

base_status kdtree_occluders_find(const scene *s, bool seek, unsigned jobs, kdtree *tree, base_error *err)
{
    finder f = {.tree = tree};
    size_t count = 0;
    tree->components = malloc((tree->record_count + 1) * sizeof *tree->components);
    tree->sets = calloc(1, sizeof *tree->sets);
    if (!tree->components || !tree->sets)
        return out_of_memory(err);
    tree->set_count = 1;
    memset(tree->components, 0xff, tree->record_count * sizeof *tree->components);
    if (!seek || tree->record_count == 0)
        return BASE_OK;
    base_status status = find_components(s, tree, &f.closed, &count, err);
    if (status != BASE_OK || count == 0)
        return status;
    status = list_leaves(&f, err);
    if (status == BASE_OK)
        status = find_in_leaves(&f, jobs, err);
    free(f.leaves);
    free(f.pieces);
    free(f.scratch);
    free(f.statuses);
    return status;
}

/* ---- marks ---- */

/* Note the components that contain an origin, or whose surface it is too close to. */
static base_status exclude(const kdtree *tree, const float origin[3], kdtree_inside *inside, bool *excluded, base_error *err)
{
    double point[3] = {(double)origin[0], (double)origin[1], (double)origin[2]};
    for (int axis = 0; axis < 3; axis++)
        if (!(origin[axis] >= tree->min[axis] && origin[axis] <= tree->max[axis]))
            return BASE_OK;
    for (int way = 0; way < 6; way++) {
        base_status status = kdtree_inside_find(tree, point, way / 2, way % 2, inside, err);
        if (status != BASE_OK)
            return status;
        if (inside->unsure_count == 0)
            break;
    }
    for (size_t i = 0; i < inside->inside_count; i++)
        excluded[inside->inside[i] >> 1] = true;
    for (size_t i = 0; i < inside->unsure_count; i++)
        excluded[inside->unsure[i]] = true;
    return BASE_OK;
}

/* Set the flag of the empty leaves of sets with a component that is not excluded and, if back faces are culled, shows fronts. */
static void mark_leaves(kdtree *tree, const bool *excluded, bool cull)
{
    for (size_t i = 0; i < tree->node_count; i++) {
        kdtree_node *node = &tree->nodes[i];
        if (i == 1 || !kdtree_is_leaf(node) || kdtree_leaf_count(node) > 0)
            continue;
        const kdtree_set *set = &tree->sets[node->link / 4];
        bool occludes = false;
        for (uint32_t k = 0; k < set->count; k++) {
            const uint32_t member = tree->members[set->first + k];
            occludes |= !excluded[member >> 1] && (!cull || (member & KDTREE_OUTWARD));
        }
        node->extent = occludes ? KDTREE_OCCLUDER : 0;
    }
}

base_status kdtree_mark_occluders(kdtree *tree, const float (*origins)[3], size_t count, bool cull, base_error *err)
{
    size_t components = 0;
    kdtree_inside inside = {0};
    base_status status = BASE_OK;
    for (size_t i = 0; i < tree->record_count; i++)
        if (tree->components[i] != KDTREE_OPEN && tree->components[i] >> 1 >= components)
            components = (size_t)(tree->components[i] >> 1) + 1;
    bool *excluded = calloc(components + 1, sizeof *excluded);
    if (!excluded)
        return out_of_memory(err);
    for (size_t i = 0; status == BASE_OK && components > 0 && i < count; i++)
        status = exclude(tree, origins[i], &inside, excluded, err);
    if (status == BASE_OK)
        mark_leaves(tree, excluded, cull);
    kdtree_inside_free(&inside);
    free(excluded);
    return status;
}
