/* libFuzzer target for files of kd-trees. The checksum is put right in every input, or none would get past it. What is accepted
 * must be a tree that can be walked and marked. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "kernels/accel/kdtree_file.h"
#include "lrbni/base/hash.h"
#include "tests/fuzz/kdtree_scene.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static scene fuzz_scene;

/* Follow lines through the tree, by way of the marks: every link, list and set is read. */
static void use(kdtree *tree)
{
    static const float origins[][3] = {{0.1f, 0.2f, 0.3f}, {1.5f, -1.25f, 1.1f}, {3.5f, 3.0f, -3.25f}};
    size_t entries = 0, leaves = 0;
    if (kdtree_mark_occluders(tree, origins, 3, true, NULL) != BASE_OK || kdtree_mark_occluders(tree, NULL, 0, false, NULL) != BASE_OK)
        abort();
    for (size_t i = 0; i < tree->node_count; i++)
        if (i != 1 && kdtree_is_leaf(&tree->nodes[i])) {
            leaves++;
            for (size_t k = 0; k < kdtree_leaf_count(&tree->nodes[i]); k++, entries++)
                if (kdtree_leaf_list(tree, &tree->nodes[i])[k] >= tree->record_count * sizeof(bvh_triangle))
                    abort();
        }
    if (leaves != tree->leaf_count || entries != tree->list_count)
        abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (!fuzz_scene.triangles)
        fuzz_scene = kdtree_scene_create();
    kdtree_options options = kdtree_scene_options();
    kdtree *tree = NULL;
    char path[64];
    int file = memfd_create("fuzz", 0);
    uint8_t *bytes = malloc(size + 1);
    if (file < 0 || !bytes)
        abort();
    memcpy(bytes, data, size);
    if (size >= 8) {
        uint64_t hash = base_hash(BASE_HASH_START, bytes, size - 8);
        memcpy(bytes + size - 8, &hash, sizeof hash);
    }
    if (write(file, bytes, size) != (ssize_t)size)
        abort();
    snprintf(path, sizeof path, "/proc/self/fd/%d", file);
    if (kdtree_read(path, &fuzz_scene, &options, &tree, NULL) == BASE_OK)
        use(tree);
    kdtree_destroy(&tree);
    free(bytes);
    close(file);
    return 0;
}
