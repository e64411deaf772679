/* What lies across the edges of a tree's triangles: for finding silhouettes (Benthin and Wald 2009, 6.1; docs/kernels.md).
 *
 * Vertices are welded by position. An edge of exactly two triangles is a silhouette for an eye from which the vertices opposite
 * it lie to the same side of it; an edge of one triangle (a border) or of three or more always may be one.
 */
#ifndef KERNELS_ACCEL_BVH_EDGES_H
#define KERNELS_ACCEL_BVH_EDGES_H

#include <stdbool.h>

#include "kernels/accel/bvh.h"

/* 64 bytes, one line, of a triangle record: the groups are its edges v0 v1, v1 v2, v2 v0, as its edge planes stand in scratch
   (kernels/triangle16.h). Edge i is bit 4 i of the masks, the first word of its group. */
typedef struct bvh_edges {
    float opposite0[3]; /* of the neighbour across the edge: its vertex that is not on the edge; 0 if there is not exactly one */
    uint32_t always;    /* edges that may be silhouettes from everywhere */
    float opposite1[3];
    uint32_t zero1;
    float opposite2[3];
    uint32_t zero2;
    uint32_t zero[3];
    uint32_t own;       /* edges that are to be looked at from this triangle: the others are a neighbour's to look at */
} bvh_edges;

/**
 * Fill in the edges of all records.
 *
 * @param one_sided  triangles are seen from their front only: then each of an edge's triangles has to look at it, because the
 *                   others may not be seen, and an edge that two triangles run along in the same direction, so that one of
 *                   them shows its back where the other shows its front, always may be a silhouette. Otherwise an edge
 *                   belongs to the first of its triangles
 * @param out        tree->record_count of them, in the order of the records; the caller's
 *
 * Equal input gives equal bytes on every host. At work it takes 84 bytes for each record. Errors: BASE_ERR_NOMEM.
 */
base_status bvh_edges_fill(const bvh *tree, bool one_sided, bvh_edges *out, base_error *err);

#endif
