/* The scene whose kd-tree is fuzzed: loose triangles and closed boxes, one within another. */
#ifndef TESTS_FUZZ_KDTREE_SCENE_H
#define TESTS_FUZZ_KDTREE_SCENE_H

#include "kernels/accel/kdtree.h"

/** The scene; free it with soup_free. */
scene kdtree_scene_create(void);

/** What its trees are built with. */
kdtree_options kdtree_scene_options(void);

#endif
