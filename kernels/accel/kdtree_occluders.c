#include "kernels/accel/kdtree_occluders.h"

#include <stdlib.h>
#include <string.h>

base_status kdtree_occluders_none(kdtree *tree, base_error *err)
{
    tree->components = malloc((tree->record_count + 1) * sizeof *tree->components);
    tree->sets = calloc(1, sizeof *tree->sets);
    tree->set_count = 1;
    if (!tree->components || !tree->sets)
        return base_fail(err, BASE_ERR_NOMEM, "kd-tree", "out of memory");
    memset(tree->components, 0xff, tree->record_count * sizeof *tree->components);
    return BASE_OK;
}

void kdtree_mark_occluders(kdtree *tree, const float (*origins)[3], size_t count)
{
    (void)origins, (void)count;
    for (size_t i = 0; i < tree->node_count; i++)
        if (i != 1 && kdtree_is_leaf(&tree->nodes[i]))
            tree->nodes[i].extent &= ~(uint32_t)KDTREE_OCCLUDER;
}
