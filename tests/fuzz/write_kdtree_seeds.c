/* Writes files of kd-trees for the fuzz target: `write_kdtree_seeds FOLDER`. They are as the builder makes them with each rule
 * on and off, and all bear the key that the target asks for. */
#include <stdio.h>

#include "kernels/accel/kdtree_file.h"
#include "tests/fuzz/kdtree_scene.h"
#include "tests/kernels/accel/soup.h"

int main(int argc, char **argv)
{
    scene s = kdtree_scene_create();
    int bad = argc != 2;
    for (int i = 0; !bad && i < 4; i++) {
        char path[4096];
        kdtree *tree = NULL;
        kdtree_options options = kdtree_scene_options(), key = options;
        options.covered_planes = i != 1;
        options.empty_percent = i == 2 ? 100 : 10;
        options.empty_occluders = i != 3;
        snprintf(path, sizeof path, "%s/tree-%d", argv[1], i);
        bad = kdtree_build(&s, &options, &tree, NULL) != BASE_OK || kdtree_write(tree, &s, &key, path, NULL) != BASE_OK;
        kdtree_destroy(&tree);
    }
    soup_free(&s);
    return bad;
}
