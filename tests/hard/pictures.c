#include "tests/hard/pictures.h"

#include "tests/kernels/twin.h"

enum { KERNELS = 3 };

static const char *kernels[KERNELS] = {"packet16-primary", "mft-primary", "packet256-primary"};

void pictures_check(const scene *s, const scene_camera *camera, unsigned size, const char *what)
{
    bvh *deep = trace_tree(s, 2), *shallow = trace_tree(s, 8);
    for (unsigned cull = 0; cull < 2; cull++) {
        trace_picture all = twin_brute_force(deep, camera, size, size, (int)cull);
        for (int kernel = 0; kernel < KERNELS; kernel++) {
            trace_request request = {.kernel = kernels[kernel], .tree = kernel ? shallow : deep, .camera = camera, .width = size,
                                     .height = size, .cull = cull, .jobs = 1};
            trace_picture p = trace_run(&request);
            trace_assert_equal(&p, &all, what);
            trace_free(&p);
        }
        trace_free(&all);
    }
    bvh_destroy(&deep);
    bvh_destroy(&shallow);
}

scene_camera pictures_camera(base_random *r, shapes_place place)
{
    double eye[3], target[3], up[3];
    shapes_point(r, 1.5, eye);
    shapes_point(r, 0.7, target);
    shapes_direction(r, up);
    for (int k = 0; k < 3; k++) {
        eye[k] = place.scale * eye[k] + place.offset;
        target[k] = place.scale * target[k] + place.offset;
    }
    return scene_camera_look_at("random", eye, target, up, base_random_range(r, 0.3, 1.8));
}
