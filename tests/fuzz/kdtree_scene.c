#include "tests/fuzz/kdtree_scene.h"

#include <string.h>

#include "tests/kernels/accel/soup.h"

enum { LOOSE = 20, BOXES = 3 };

/* Two triangles of the face across `axis` at +-size. */
static void put_face(scene_triangle t[2], int axis, float at, float size)
{
    for (int half = 0; half < 2; half++)
        for (int corner = 0; corner < 3; corner++) {
            int u = half == 0 ? corner > 0 : corner == 1, v = half == 0 ? corner > 1 : corner > 0;
            t[half].v[corner][axis] = at;
            t[half].v[corner][(axis + 1) % 3] = u ? size : -size;
            t[half].v[corner][(axis + 2) % 3] = v ? size : -size;
        }
}

scene kdtree_scene_create(void)
{
    scene loose = soup_random(1, LOOSE, 0.5), s = soup_create("fuzz", LOOSE + 12 * BOXES);
    memcpy(s.triangles, loose.triangles, LOOSE * sizeof *s.triangles);
    for (int box = 0; box < BOXES; box++)
        for (int face = 0; face < 6; face++) {
            float size = (float)(1 << box);
            put_face(&s.triangles[LOOSE + 12 * box + 2 * face], face / 2, face % 2 ? size : -size, size);
        }
    soup_free(&loose);
    return s;
}

kdtree_options kdtree_scene_options(void)
{
    kdtree_options options = kdtree_options_default();
    options.min_area = 0;
    return options;
}
