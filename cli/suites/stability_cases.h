/* The hard cases of suite stability: for each, what it is and how its scenes are made. */
#ifndef CLI_SUITES_STABILITY_CASES_H
#define CLI_SUITES_STABILITY_CASES_H

#include "cli/suites/stability_scene.h"

typedef struct stability_case {
    const char *id;   /* X: all kernels, A: packets, B: frusta, C: kd-trees */
    const char *name; /* a line */
    void (*build)(stability_scene *s); /* camera and triangles; place, frame, variant and random numbers are set */
} stability_case;

/** All of them; *count entries. */
const stability_case *stability_case_list(size_t *count);

/* Offsets and sizes that every case is run at. */
enum { STABILITY_PLACES = 9 };
extern const stability_place stability_places[STABILITY_PLACES];

/* Cases of packets and frusta, stability_frusta.c. */
void stability_build_signs_differ(stability_scene *s);
void stability_build_odd_sizes(stability_scene *s);
void stability_build_equal_rays(stability_scene *s);
void stability_build_intervals_with_zero(stability_scene *s);
void stability_build_intervals_without_zero(stability_scene *s);
void stability_build_faces_through_origin(stability_scene *s);
void stability_build_culling(stability_scene *s);
void stability_build_edges_on_corner_rays(stability_scene *s);
void stability_build_around_corner_rays(stability_scene *s);
void stability_build_partly_covered(stability_scene *s);

/* Cases of kd-trees and of entry points into them, stability_kdtree.c. */
void stability_build_flat_leaves(stability_scene *s);
void stability_build_camera_on_planes(stability_scene *s);
void stability_build_along_axes(stability_scene *s);
void stability_build_planes_behind(stability_scene *s);
void stability_build_vanishing_components(stability_scene *s);
void stability_build_between_corner_rays(stability_scene *s);
void stability_build_covered_planes(stability_scene *s);
void stability_build_gaps(stability_scene *s);
void stability_build_nearly_closed(stability_scene *s);
void stability_build_inside_objects(stability_scene *s);
void stability_build_searches_that_end(stability_scene *s);
void stability_build_in_many_leaves(stability_scene *s);
void stability_build_beside_entry_points(stability_scene *s);
void stability_build_shadow_ends(stability_scene *s);
void stability_build_deep_trees(stability_scene *s);

#endif
