/* Loading samples and comparing what comes out; used by the tests of the glTF loader. */
#ifndef TESTS_SCENE_GLTF_CHECK_H
#define TESTS_SCENE_GLTF_CHECK_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "scene/gltf_loader.h"
#include "tests/scene/gltf_sample.h"

/* The scene of a sample, loaded as .glb and as .gltf with equal results. */
static inline scene *load_sample(const gltf_sample *sample)
{
    scene *from_glb = NULL, *from_text = NULL;
    base_error err = {0};
    size_t glb_size, text_size;
    unsigned char *glb = gltf_sample_glb(sample, &glb_size), *text = gltf_sample_text(sample, &text_size);
    base_status status = scene_gltf_parse("sample", glb, glb_size, &from_glb, &err);
    if (status == BASE_OK)
        status = scene_gltf_parse("sample", text, text_size, &from_text, &err);
    free(glb);
    free(text);
    if (status != BASE_OK)
        fail_msg("%s: %s: %s", sample->name ? sample->name : "sample", err.what, err.why);
    assert_true(from_glb->hash == from_text->hash);
    scene_destroy(&from_text);
    return from_glb;
}

static inline void assert_triangle(const scene *s, size_t index, const float (*expected)[3])
{
    assert_true(index < s->triangle_count);
    for (int corner = 0; corner < 3; corner++)
        for (int axis = 0; axis < 3; axis++)
            if (s->triangles[index].v[corner][axis] != expected[corner][axis])
                fail_msg("triangle %zu vertex %d axis %d: %g instead of %g", index, corner, axis,
                         (double)s->triangles[index].v[corner][axis], (double)expected[corner][axis]);
}

/* Bytes that are not a scene, and the reason that is given. */
static inline void assert_bytes_fail(const void *data, size_t size, const char *why)
{
    scene *s = (scene *)(uintptr_t)1;
    base_error err = {0};
    base_status status = scene_gltf_parse("folder/bad.glb", data, size, &s, &err);
    if (status == BASE_OK)
        fail_msg("loaded instead of: %s", why);
    assert_int_equal(status, BASE_ERR_INPUT);
    assert_null(s);
    assert_string_equal(err.what, "folder/bad.glb");
    assert_string_equal(err.why, why);
}

static inline void assert_sample_fails(const gltf_sample *sample, const char *why)
{
    size_t size;
    unsigned char *glb = gltf_sample_glb(sample, &size);
    assert_bytes_fail(glb, size, why);
    free(glb);
}

#endif
