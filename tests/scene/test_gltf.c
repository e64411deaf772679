/* What the glTF loader makes of files that are right. */
#include "tests/scene/gltf_check.h"

#include <math.h>
#include <stdio.h>

#include "tests/scene/near.h"

static const float quad_triangles[2][3][3] = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 0, 0}, {1, 1, 0}, {0, 1, 0}}};

/* Triangles of a sample by name; expected has count entries. */
static void assert_triangles(const char *name, const float (*expected)[3][3], size_t count)
{
    scene *s = load_sample(gltf_sample_find(name));
    assert_int_equal(s->triangle_count, count);
    for (size_t i = 0; i < count; i++)
        assert_triangle(s, i, expected[i]);
    scene_destroy(&s);
}

static void parse__each_sample__loads(void **state)
{
    (void)state;
    size_t count;
    const gltf_sample *samples = gltf_sample_list(&count);
    for (size_t i = 0; i < count; i++) {
        scene *s = load_sample(&samples[i]);
        assert_true(s->triangle_count > 0);
        scene_destroy(&s);
    }
}

static void parse__no_indices_and_stride__vertices_in_order(void **state)
{
    (void)state;
    const float expected[1][3][3] = {{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}};
    assert_triangles("triangle", expected, 1);
}

static void parse__indices_of_each_size__same_triangles(void **state)
{
    (void)state;
    assert_triangles("indices8", quad_triangles, 2);
    assert_triangles("indices16", quad_triangles, 2);
    assert_triangles("indices32", quad_triangles, 2);
}

static void parse__strip__degenerates_kept_and_windings_alternate(void **state)
{
    (void)state;
    /* elements 0 1 2 0 2 3 of the quad: (0 1 2) (1 0 2) (2 0 2) (0 3 2) by the specification's rule */
    const float expected[4][3][3] = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}},
                                     {{1, 0, 0}, {0, 0, 0}, {1, 1, 0}},
                                     {{1, 1, 0}, {0, 0, 0}, {1, 1, 0}},
                                     {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}}};
    assert_triangles("strip", expected, 4);
}

static void parse__fan__center_last(void **state)
{
    (void)state;
    const float expected[2][3][3] = {{{1, 0, 0}, {1, 1, 0}, {0, 0, 0}}, {{1, 1, 0}, {0, 1, 0}, {0, 0, 0}}};
    assert_triangles("fan", expected, 2);
}

static void parse__sparse__replaces_elements(void **state)
{
    (void)state;
    const float over_quad[2][3][3] = {{{0, 0, 0}, {5, 0, 0}, {1, 1, 0}}, {{0, 0, 0}, {1, 1, 0}, {0, 5, 0}}};
    const float over_zero[2][3][3] = {{{0, 0, 0}, {5, 0, 0}, {0, 0, 0}}, {{0, 0, 0}, {0, 0, 0}, {0, 5, 0}}};
    assert_triangles("sparse", over_quad, 2);
    assert_triangles("sparse_zeros", over_zero, 2);
}

static void parse__integer_positions__as_the_specification_scales_them(void **state)
{
    (void)state;
    const float int16[1][3][3] = {{{0, 0, 0}, {32767, 0, 0}, {0, -32768, 0}}};
    const float normal[1][3][3] = {{{0, 0, 0}, {1, 0, 0}, {0, -1, 0}}}; /* the lowest is clamped to -1 */
    const float uint16[1][3][3] = {{{0, 0, 0}, {1, 0, 0}, {0, 0.2f, 0}}};
    const float uint8[1][3][3] = {{{0, 0, 0}, {255, 0, 0}, {0, 51, 0}}};
    assert_triangles("int16", int16, 1);
    assert_triangles("int16_normalized", normal, 1);
    assert_triangles("int8_normalized", normal, 1);
    assert_triangles("uint16_normalized", uint16, 1);
    assert_triangles("uint8", uint8, 1);
}

static void parse__points_and_lines__left_out(void **state)
{
    (void)state;
    const float expected[1][3][3] = {{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}};
    assert_triangles("points_between", expected, 1);
}

static void parse__materials__base_colors_and_white(void **state)
{
    (void)state;
    scene *s = load_sample(gltf_sample_find("materials"));
    const uint32_t expected[3] = {1, 2, 0};
    for (int i = 0; i < 3; i++)
        assert_int_equal(s->triangle_material[i], expected[i]);
    assert_int_equal(s->material_count, 3);
    assert_true(s->materials[0].base_color[0] == 0.5f && s->materials[0].base_color[1] == 0.25f);
    for (int m = 1; m < 3; m++)
        for (int c = 0; c < 3; c++)
            assert_true(s->materials[m].base_color[c] == 1);
    scene_destroy(&s);
}

static void parse__tree_of_nodes__chosen_scene_depth_first_transformed(void **state)
{
    (void)state;
    scene *s = load_sample(gltf_sample_find("tree"));
    const float moved[3][3] = {{0, 0, -7}, {1, 0, -7}, {1, 1, -7}};
    assert_int_equal(s->triangle_count, 3);
    assert_triangle(s, 0, moved);
    /* node 1: scaled by 2, turned by a quarter about z, then moved by its parent: (2,0,0) -> (10,4,0) */
    assert_near((double)s->triangles[2].v[1][0], 10, 1e-6);
    assert_near((double)s->triangles[2].v[1][1], 4, 1e-6);
    assert_near((double)s->triangles[2].v[2][0], 6, 1e-6);
    assert_near((double)s->triangles[2].v[2][1], 0, 1e-6);
    scene_destroy(&s);
}

static void parse__mirrored_node__front_stays_front(void **state)
{
    (void)state;
    const float expected[1][3][3] = {{{0, 0, 0}, {0, 2, 0}, {-2, 0, 0}}}; /* v1 and v2 change places */
    assert_triangles("mirror", expected, 1);
    scene *s = load_sample(gltf_sample_find("mirror"));
    const scene_triangle t = s->triangles[0];
    assert_true(t.v[1][0] * t.v[2][1] - t.v[1][1] * t.v[2][0] > 0); /* still towards +z */
    scene_destroy(&s);
}

static void parse__mirrored_twice__order_kept(void **state)
{
    (void)state;
    const gltf_sample sample = {.nodes = "[{'scale':[1,-1,1],'children':[1]},{'mesh':0,'scale':[-1,1,1]}]"};
    const float expected[3][3] = {{0, 0, 0}, {-2, 0, 0}, {0, -2, 0}};
    scene *s = load_sample(&sample);
    assert_triangle(s, 0, expected);
    scene_destroy(&s);
}

static void parse__identity_transform__float_bits_untouched(void **state)
{
    (void)state;
    /* -0, a subnormal and a value that is odd in its last bit, under every way of writing the identity */
    const unsigned char vertices[36] = {0, 0, 0, 0x80, 1, 0, 0, 0, 1, 0, 0x80, 0x3f, 0, 0, 0, 0x40, 0, 0, 0, 0, 0, 0, 0, 0x80,
                                        0, 0, 0, 0,    0, 0, 0, 0x40};
    const char *const nodes[] = {"{\"mesh\":0}", "{\"mesh\":0,\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}",
                                 "{\"mesh\":0,\"translation\":[0,0,0],\"rotation\":[0,0,0,1],\"scale\":[1,1,1]}"};
    for (int i = 0; i < 3; i++) {
        char json[1024];
        size_t size;
        scene *s;
        snprintf(json, sizeof json,
                 "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[%s],\"scenes\":[{\"nodes\":[0]}],"
                 "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{\"bufferView\":0,"
                 "\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
                 "\"buffers\":[{\"byteLength\":36}]}",
                 nodes[i]);
        unsigned char *glb = gltf_sample_pack(json, vertices, sizeof vertices, &size);
        assert_int_equal(scene_gltf_parse("bits", glb, size, &s, NULL), BASE_OK);
        const uint32_t expected[3] = {0x80000000u, 1, 0x3f800001u};
        assert_memory_equal(s->triangles[0].v[0], expected, sizeof expected);
        scene_destroy(&s);
        free(glb);
    }
}

static void parse__transform__rounded_once(void **state)
{
    (void)state;
    /* 2 * 0.1 + 0.2 where both factors exist in double only: float arithmetic would give another last bit */
    const gltf_sample sample = {.nodes = "[{'mesh':0,'matrix':[0.1,0,0,0, 0,0.7,0,0, 0,0,1,0, 0.2,0.3,0.123456789,1]}]"};
    scene *s = load_sample(&sample);
    assert_true(s->triangles[0].v[1][0] == (float)(0.1 * 2 + 0.2));
    assert_true(s->triangles[0].v[2][1] == (float)(0.7 * 2 + 0.3));
    assert_true(s->triangles[0].v[0][2] == (float)0.123456789);
    scene_destroy(&s);
}

static void parse__cameras__perspective_ones_in_node_order(void **state)
{
    (void)state;
    scene *s = load_sample(gltf_sample_find("cameras"));
    const double west[3] = {-1, 0, 0}; /* -z turned by a quarter about y */
    assert_int_equal(s->camera_count, 2);
    assert_string_equal(s->cameras[0].name, "side");
    assert_string_equal(s->cameras[1].name, "lens");
    for (int axis = 0; axis < 3; axis++) {
        assert_true(s->cameras[0].position[axis] == axis + 1.0);
        assert_near(s->cameras[0].forward[axis], west[axis], 1e-15);
        assert_true(s->cameras[1].forward[axis] == (axis == 2 ? -1.0 : 0.0));
        assert_true(s->cameras[1].up[axis] == (axis == 1 ? 1.0 : 0.0));
    }
    assert_true(s->cameras[0].yfov == 0.75);
    scene_destroy(&s);
}

static void parse__no_camera_no_light__defaults(void **state)
{
    (void)state;
    scene *s = load_sample(gltf_sample_find("triangle"));
    assert_int_equal(s->camera_count, 1);
    assert_string_equal(s->cameras[0].name, "default");
    assert_int_equal(s->light.has_area, 0);
    assert_near(s->light.point[1], 1 + sqrt(8.0) / 4, 1e-15);
    scene_destroy(&s);
}

static void parse__lights__first_area_untransformed_first_point_placed(void **state)
{
    (void)state;
    scene *s = load_sample(gltf_sample_find("lights"));
    const double corner[3] = {1, 5, 2}, u[3] = {3, 0, 0}, v[3] = {0, 0, 4}, point[3] = {1, 2, 3};
    assert_true(s->light.has_area && s->light.has_point);
    for (int axis = 0; axis < 3; axis++) {
        assert_true(s->light.corner[axis] == corner[axis]);
        assert_near(s->light.u[axis], u[axis], 1e-15);
        assert_true(s->light.v[axis] == v[axis]);
        assert_true(s->light.point[axis] == point[axis]);
    }
    scene_destroy(&s);
}

static void parse__large_integers_in_light__not_cut_to_32_bits(void **state)
{
    (void)state;
    const gltf_sample sample = {.nodes = "[{'mesh':0,'extras':{'light':{'corner':[3000000000,0,-5000000000],'u':[1,0,0],'v':[0,0,1]}}}]"};
    scene *s = load_sample(&sample);
    assert_true(s->light.corner[0] == 3e9 && s->light.corner[2] == -5e9);
    scene_destroy(&s);
}

static void parse__deep_node_chain__no_recursion(void **state)
{
    (void)state;
    const size_t depth = 50000;
    char *nodes = malloc(depth * 40);
    size_t used = 0;
    assert_non_null(nodes);
    for (size_t i = 0; i + 1 < depth; i++)
        used += (size_t)sprintf(nodes + used, "%s{'children':[%zu]}", i ? "," : "[", i + 1);
    sprintf(nodes + used, ",{'mesh':0}]");
    const gltf_sample sample = {.nodes = nodes};
    scene *s = load_sample(&sample);
    assert_int_equal(s->triangle_count, 1);
    scene_destroy(&s);
    free(nodes);
}

static void parse__names__of_the_file_and_cut_between_characters(void **state)
{
    (void)state;
    char name[400] = "models.v2/a", camera[300];
    scene *s;
    size_t size;
    for (int i = 0; i < 100; i++) {
        strcat(name, "\xc3\xa9");
        memcpy(camera + 2 * i, "\xc3\xa9", 2);
    }
    strcat(name, ".glb");
    camera[200] = '\0';
    char nodes[400];
    snprintf(nodes, sizeof nodes, "[{'mesh':0,'camera':0,'name':'%s'}]", camera);
    const gltf_sample sample = {
        .nodes = nodes, .more = "'cameras':[{'type':'perspective','perspective':{'yfov':1,'znear':1}}],"};
    unsigned char *glb = gltf_sample_glb(&sample, &size);
    assert_int_equal(scene_gltf_parse(name, glb, size, &s, NULL), BASE_OK);
    assert_int_equal(strlen(s->name), 127);
    assert_memory_equal(s->name, "a\xc3\xa9", 3);
    assert_int_equal(strlen(s->cameras[0].name), 62);
    scene_destroy(&s);
    free(glb);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parse__each_sample__loads),
        cmocka_unit_test(parse__no_indices_and_stride__vertices_in_order),
        cmocka_unit_test(parse__indices_of_each_size__same_triangles),
        cmocka_unit_test(parse__strip__degenerates_kept_and_windings_alternate),
        cmocka_unit_test(parse__fan__center_last),
        cmocka_unit_test(parse__sparse__replaces_elements),
        cmocka_unit_test(parse__integer_positions__as_the_specification_scales_them),
        cmocka_unit_test(parse__points_and_lines__left_out),
        cmocka_unit_test(parse__materials__base_colors_and_white),
        cmocka_unit_test(parse__tree_of_nodes__chosen_scene_depth_first_transformed),
        cmocka_unit_test(parse__mirrored_node__front_stays_front),
        cmocka_unit_test(parse__mirrored_twice__order_kept),
        cmocka_unit_test(parse__identity_transform__float_bits_untouched),
        cmocka_unit_test(parse__transform__rounded_once),
        cmocka_unit_test(parse__cameras__perspective_ones_in_node_order),
        cmocka_unit_test(parse__no_camera_no_light__defaults),
        cmocka_unit_test(parse__lights__first_area_untransformed_first_point_placed),
        cmocka_unit_test(parse__large_integers_in_light__not_cut_to_32_bits),
        cmocka_unit_test(parse__deep_node_chain__no_recursion),
        cmocka_unit_test(parse__names__of_the_file_and_cut_between_characters),
    };
    return cmocka_run_group_tests_name("scene/gltf", tests, NULL, NULL);
}
