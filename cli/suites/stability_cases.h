/* The hard cases of suite stability: for each, what it is and how its scenes are made. */
#ifndef CLI_SUITES_STABILITY_CASES_H
#define CLI_SUITES_STABILITY_CASES_H

#include "cli/suites/stability_scene.h"

typedef struct stability_case {
    const char *id;   /* X: all kernels, A: packets, B: frusta */
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

#endif
