/* What is true of a pixel's 16 samples: are they of one smooth surface, or does a silhouette separate them?
 *
 * A surface goes on from a triangle to its neighbour across an edge if no other triangle has that edge, and if seen from the eye
 * the two lie to different sides of it. Samples are of one surface if their triangles are connected so by triangles that all
 * meet the pixel. In double: the judge of algorithms that mark pixels (docs/reports.md, mft-msaa), whose own means are others.
 */
#ifndef EXACT_PIXEL_EDGES_H
#define EXACT_PIXEL_EDGES_H

#include <stdbool.h>

#include "scene/scene.h"

#define PIXEL_EDGES_NO_HIT UINT32_C(0xffffffff)

typedef enum pixel_kind {
    PIXEL_SMOOTH,      /* all samples are of one surface, or of none */
    PIXEL_EDGE,        /* they are not, and a silhouette of one of the surfaces passes between them */
    PIXEL_INTERSECTION /* they are not, but there is none: surfaces that run through each other have no silhouette there */
} pixel_kind;

typedef struct pixel_edges pixel_edges;

/**
 * Prepare to judge the pixels of an image.
 *
 * @param s          owned by the caller; must outlive the result
 * @param one_sided  triangles are seen from their front only: two that run along their edge in the same direction do not go on
 * @param out        free with pixel_edges_destroy
 *
 * Takes some 100 bytes a triangle. Errors: BASE_ERR_NOMEM.
 */
base_status pixel_edges_create(const scene *s, const scene_camera *camera, unsigned width, unsigned height, bool one_sided,
                               pixel_edges **out, base_error *err);

/** Free it; sets the pointer to NULL. */
void pixel_edges_destroy(pixel_edges **e);

/**
 * Judge pixel (x, y).
 *
 * @param id  of the triangles that the samples hit, PIXEL_EDGES_NO_HIT for none; sample j is at x + (j%4 - 1.5)/4, y + (j/4 - 1.5)/4
 * @param t   their distances, as depths; +infinity for none
 *
 * Not for two threads at once.
 */
pixel_kind pixel_edges_judge(pixel_edges *e, unsigned x, unsigned y, const uint32_t id[16], const float t[16]);

#endif
