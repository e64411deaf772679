/* A build without tinygltf says so. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "scene/gltf_loader.h"

static void load__without_tinygltf__unsupported(void **state)
{
    (void)state;
    base_error err;
    scene *s = (scene *)(uintptr_t)1;
    assert_int_equal(scene_gltf_load("a.glb", &s, &err), BASE_ERR_UNSUPPORTED);
    assert_null(s);
    assert_string_equal(err.what, "a.glb");
    assert_non_null(strstr(err.why, "gltf"));
    s = (scene *)(uintptr_t)1;
    assert_int_equal(scene_gltf_parse("b.glb", (const unsigned char *)"{}", 2, &s, &err), BASE_ERR_UNSUPPORTED);
    assert_null(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(load__without_tinygltf__unsupported)};
    return cmocka_run_group_tests_name("scene/gltf_none", tests, NULL, NULL);
}
