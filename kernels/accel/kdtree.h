/* A kd-tree as multi-level ray tracing needs it: cells without overlap, empty cells cut off early, walls in flat cells
 * of their own, and empty cells inside closed objects marked as opaque (Reshetov, Soupikov and Hurley 2005, section
 * 3.1; MLRTA). Built on the host, exact surface area heuristic with perfect splits (Wald and Havran 2006), not charged to
 * the simulated machine. docs/kd-tree.md.
 *
 * A node does not store its cell: the root's is `min`, `max`, and each step replaces one plane. All cells are closed. A
 * cell may be flat (min = max along an axis): a 2D cell, which a ray enters and leaves at the same distance, so
 * comparisons must be closed as well. A ray that hits a triangle at a point hits it in the list of at least one leaf
 * whose closed cell contains that point, not of all: where the point lies on a plane, both sides have to be visited.
 * Coordinates are those of the scene. Zeros are +0.
 */
#ifndef KERNELS_ACCEL_KDTREE_H
#define KERNELS_ACCEL_KDTREE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "kernels/accel/bvh.h"
#include "lrbni/base/status.h"
#include "scene/scene.h"

/* 8 bytes; two siblings fill 16. Links are byte offsets with the kind of node in their lowest two bits.
 *
 *            link, bits 0-1     link, the rest                                  word
 *   inner    axis 0, 1, 2       offset in `nodes` of the children, * 16         the split plane, a float
 *   leaf     KDTREE_LEAF        offset in `lists` of the first entry, * 4       bits 0-1 flags, the rest 4 * triangles
 *   empty    KDTREE_LEAF        4 * number of its set of occluders (kdtree_set) flags
 *
 * The first child is the one below the plane, the second 8 bytes behind it the one above.
 */
typedef struct kdtree_node {
    uint32_t link;
    union {
        float split;     /* inner */
        uint32_t extent; /* leaf: length of its list in bytes, plus flags */
    };
} kdtree_node;

enum {
    KDTREE_LEAF = 3, /* bits 0-1 of a leaf's link */
    KDTREE_KIND = 3, /* mask of the kind in a link and of the flags in an extent */
    /* flags of leaves */
    KDTREE_OCCLUDER = 1, /* empty, with volume, inside a closed object: nothing behind it is seen from outside */
    KDTREE_COVERED = 2,  /* flat, and its triangles in that plane cover the cell's whole rectangle (to 1e-6 of its area): every
                            ray that crosses it hits one of them */
    KDTREE_MAX_DEPTH = 96 /* edges from the root to the deepest leaf: bounds the stacks of the kernels */
};

#define KDTREE_OPEN UINT32_MAX

/* Components of the mesh have numbers from 0 on; bit 0 of what stands for one tells more of it. */
enum {
    KDTREE_ORIENTED = 1, /* by record: along every edge as many of the component's triangles run one way as the other */
    KDTREE_OUTWARD = 1   /* of a member: oriented, and more of its layers around the leaf face outwards than inwards: whoever
                            looks from where none is around passes through a front first */
};

/* Components of the mesh that an empty leaf lies in; set 0 is the empty one. */
typedef struct kdtree_set {
    uint32_t first, count; /* in `members` */
} kdtree_set;

typedef struct kdtree {
    float min[3], max[3]; /* the root's cell: the smallest box around all triangles that are kept; +inf, -inf if none */
    kdtree_node *nodes;   /* 64-byte aligned; nodes[0] is the root, nodes[1] its unused neighbour (zero), then pairs */
    size_t node_count;    /* entries of nodes, always even */
    uint32_t *lists;      /* 64-byte aligned; the leaves' lists one after the other; an entry is a byte offset in `records` */
    size_t list_count;    /* entries of lists */
    bvh_triangle *records; /* 64-byte aligned, as in the BVH; each triangle once, in the order of the first leaf that lists it */
    size_t record_count;
    uint32_t *sizes; /* by node: itself and the nodes below it, 1 for a leaf (nodes[1]: 0); the complexity measure of section 4.2 */
    uint32_t *components; /* by record: 2 * number of its closed component + KDTREE_ORIENTED; KDTREE_OPEN: in none, or none were sought */
    kdtree_set *sets;
    size_t set_count; /* at least 1 */
    uint32_t *members; /* 2 * numbers of components, ascending within a set, + KDTREE_OUTWARD */
    size_t member_count;
    size_t inner_count, leaf_count;
    size_t empty_count;      /* leaves without triangles */
    size_t flat_count;       /* leaves whose cell has no volume */
    size_t covered_count;    /* of those, marked KDTREE_COVERED */
    size_t enclosed_count;   /* empty leaves inside closed components: marked by kdtree_mark_occluders, save for its exceptions */
    size_t degenerate_count; /* triangles left out: normal zero or not finite, computed in double */
    unsigned depth;          /* edges from the root to the deepest leaf */
    double sah_cost;         /* expected cost of a random ray that meets the root's cell, in triangle tests */
} kdtree;

/* How to build: every rule of section 3.1 can be changed or switched off. */
typedef struct kdtree_options {
    float traversal_cost;     /* of an inner node, in triangle tests; finite, at least 0 */
    unsigned empty_percent;   /* rule 1: cut off empty space of more than so much of a cell's length; 1..100, 100: never */
    unsigned covered_planes;  /* rule 2: 1: cut at planes that triangles cover */
    unsigned min_area;        /* rule 3: no split by cost makes a cell of a surface smaller than so many billionths of the root's;
                                 0: no limit; at most 10^9 */
    unsigned perfect_splits;  /* 1: triangles are clipped to their cells; 0: only their boxes are */
    unsigned empty_occluders; /* 1: find the empty leaves inside closed components */
    unsigned max_depth;       /* 0..KDTREE_MAX_DEPTH */
    unsigned jobs;            /* host threads, at least 1; the tree does not depend on it */
} kdtree_options;

/** Defaults: traversal cost 1, 10 percent, min_area 100 (1e-7), all rules on, KDTREE_MAX_DEPTH, one job. */
kdtree_options kdtree_options_default(void);

/**
 * Build the tree of a scene.
 *
 * Pairs lie in depth-first order, a pair, then all below its first node, then all below its second, and so do the lists;
 * within a list ids ascend. Triangles whose normal is zero are left out and counted (kernels/accel/box.h). A triangle is
 * in the list of every leaf whose open cell its inside meets; one that lies in the plane of a split is on the side that the rules
 * choose. No leaf is marked KDTREE_OCCLUDER yet. Equal input gives equal bytes on every host, with any number of jobs.
 *
 * @param out  owned by the caller: free with kdtree_destroy; a scene of degenerate triangles alone gives an empty
 *             leaf as root
 *
 * Errors: BASE_ERR_USAGE naming the option that is out of range, BASE_ERR_INPUT naming a scene of more than
 * SCENE_MAX_TRIANGLES triangles or a tree beyond 4 GiB, BASE_ERR_NOMEM.
 */
base_status kdtree_build(const scene *s, const kdtree_options *options, kdtree **out, base_error *err);

/**
 * Mark the empty leaves that occlude for rays from these origins: those inside a closed component that contains none of
 * them. Earlier marks are removed; no origins: none is contained. Origins on a surface, or so close
 * that rounding decides, count as inside its component.
 *
 * @param origins  cameras and point lights
 * @param cull     rays do not see back faces: a component counts around those leaves alone that it winds around outwards
 *
 * Errors: BASE_ERR_NOMEM; the marks are as they were then.
 */
base_status kdtree_mark_occluders(kdtree *tree, const float (*origins)[3], size_t count, bool cull, base_error *err);

/** Free a tree; sets the pointer to NULL. */
void kdtree_destroy(kdtree **tree);

/** The first of two children, and a leaf's list: its first entry and its length. */
static inline const kdtree_node *kdtree_children(const kdtree *tree, const kdtree_node *node)
{
    return tree->nodes + node->link / sizeof *node;
}

static inline bool kdtree_is_leaf(const kdtree_node *node)
{
    return (node->link & KDTREE_KIND) == KDTREE_LEAF;
}

static inline size_t kdtree_leaf_count(const kdtree_node *leaf)
{
    return leaf->extent / 4;
}

static inline const uint32_t *kdtree_leaf_list(const kdtree *tree, const kdtree_node *leaf)
{
    return tree->lists + leaf->link / 4;
}

#endif
