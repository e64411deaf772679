/* Whole pictures of hard scenes. */
#ifndef TESTS_HARD_PICTURES_H
#define TESTS_HARD_PICTURES_H

#include "tests/hard/shapes.h"

/** Fail the running test, with `what`, unless all kernels give, with and without culling, exactly the size x size picture
    that trying all triangles with the same float operations gives. */
void pictures_check(const scene *s, const scene_camera *camera, unsigned size, const char *what);

/** A camera somewhere about a shape at a place. */
scene_camera pictures_camera(base_random *r, shapes_place place);

#endif
