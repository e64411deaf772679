/* What the glTF loader says of files that are wrong: each row is one mistake and the words for it. */
#include "tests/scene/gltf_check.h"

#include <stdio.h>

typedef struct row {
    gltf_sample sample;
    const char *why;
} row;

static void assert_rows(const row *rows, size_t count)
{
    for (size_t i = 0; i < count; i++)
        assert_sample_fails(&rows[i].sample, rows[i].why);
}

#define COUNT(a) (sizeof(a) / sizeof(a)[0])
#define PRIMITIVE(fields) "[{'primitives':[{'attributes':{'POSITION':0}," fields "}]}]"
#define ACCESSORS(first) "[" first ",{'bufferView':1,'componentType':5121,'count':6,'type':'SCALAR'}]"
#define ON_FIRST .meshes = "[{'primitives':[{'attributes':{'POSITION':0}}]}]"
#define SPARSE(indices, values) \
    ACCESSORS("{'bufferView':4,'componentType':5126,'count':3,'type':'VEC3','sparse':{" indices "," values "}}")

static void accessors__out_of_bounds__sizes_given(void **state)
{
    (void)state;
    const row rows[] = {
        {{.accessors = ACCESSORS("{'bufferView':0,'componentType':5126,'count':6,'type':'VEC3'}"), ON_FIRST},
         "accessor 0: needs 72 bytes of bufferView 0, which has 48"},
        {{.accessors = ACCESSORS("{'bufferView':0,'byteOffset':16,'componentType':5126,'count':3,'type':'VEC3'}"), ON_FIRST},
         "accessor 0: needs 52 bytes of bufferView 0, which has 48"},
        {{.accessors = ACCESSORS("{'bufferView':0,'componentType':5126,'count':2147483647,'type':'VEC3'}"), ON_FIRST},
         "accessor 0: needs 25769803764 bytes of bufferView 0, which has 48"},
        {{.accessors = ACCESSORS("{'bufferView':99,'componentType':5126,'count':3,'type':'VEC3'}"), ON_FIRST},
         "accessor 0: bufferView 99 does not exist (there are 15)"},
        {{.accessors = ACCESSORS("{'componentType':5126,'count':2147483646,'type':'VEC3'}"), ON_FIRST},
         "accessor 0: 2147483646 elements without a bufferView; at most 1048576 are read"},
        {{.accessors = ACCESSORS("{'bufferView':0,'componentType':5130,'count':1,'type':'VEC3'}"), ON_FIRST},
         "accessor 0: type or componentType 5130 cannot be read here"},
        {{.accessors = ACCESSORS("{'bufferView':0,'componentType':5126,'count':1,'type':'MAT4'}"), ON_FIRST},
         "accessor 0: type or componentType 5126 cannot be read here"},
        {{.accessors = ACCESSORS("{'bufferView':0,'componentType':5126,'count':3,'type':'VEC2'}"), ON_FIRST},
         "mesh 0 primitive 0: POSITION: accessor 0 is not a VEC3 of float, or of 8 or 16-bit integers"},
        {{.accessors = ACCESSORS("{'bufferView':0,'componentType':5125,'count':3,'type':'VEC3'}"), ON_FIRST},
         "mesh 0 primitive 0: POSITION: accessor 0 is not a VEC3 of float, or of 8 or 16-bit integers"},
        {{.accessors = "[]", ON_FIRST}, "accessor 0 does not exist (there are 0)"},
    };
    assert_rows(rows, COUNT(rows));
}

static void views__out_of_bounds__sizes_given(void **state)
{
    (void)state;
    const char accessor[] = "[{'bufferView':0,'componentType':5126,'count':3,'type':'VEC3'}]";
    const row rows[] = {
        {{.accessors = accessor, .views = "[{'buffer':0,'byteOffset':8,'byteLength':36}]", ON_FIRST, .buffers = "[{'byteLength':40}]"},
         "bufferView 0: needs 44 bytes of buffer 0, which has 40"},
        {{.accessors = accessor, .views = "[{'buffer':0,'byteOffset':2147483647,'byteLength':2147483647}]", ON_FIRST},
         "bufferView 0: needs 4294967294 bytes of buffer 0, which has 372"},
        {{.accessors = accessor, .views = "[{'buffer':2,'byteLength':36}]", ON_FIRST},
         "bufferView 0: buffer 2 does not exist (there are 1)"},
        {{.accessors = accessor, .views = "[{'buffer':0,'byteLength':36,'byteStride':8}]", ON_FIRST},
         "bufferView 0: byteStride 8 is less than the 12 bytes of an element of accessor 0"},
        {{.accessors = accessor, .views = "[{'buffer':0,'byteLength':36,'byteStride':13}]", ON_FIRST},
         "tinygltf: Invalid `byteStride' value. `byteStride' must be the multiple of 4 : 13"},
        {{.accessors = accessor, .views = "[{'buffer':0,'byteLength':100,'byteStride':252}]", ON_FIRST},
         "accessor 0: needs 516 bytes of bufferView 0, which has 100"},
    };
    assert_rows(rows, COUNT(rows));
}

static void sparse__bad_parts__field_named(void **state)
{
    (void)state;
    const row rows[] = {
        {{.accessors = SPARSE("'count':4,'indices':{'bufferView':5,'componentType':5123}", "'values':{'bufferView':6}"), ON_FIRST},
         "accessor 0: sparse.count 4 is more than count 3"},
        {{.accessors = SPARSE("'count':2,'indices':{'bufferView':5,'componentType':5123}", "'values':{'bufferView':6}"), ON_FIRST},
         "accessor 0: sparse index 3 is out of range (3 elements)"},
        {{.accessors = SPARSE("'count':2,'indices':{'bufferView':1,'byteOffset':2,'componentType':5121}", "'values':{'bufferView':6}"),
          ON_FIRST},
         "accessor 0: sparse.indices are not in rising order"},
        {{.accessors = SPARSE("'count':3,'indices':{'bufferView':5,'componentType':5123}", "'values':{'bufferView':6}"), ON_FIRST},
         "accessor 0: needs 6 bytes of bufferView 5, which has 4"},
        {{.accessors = SPARSE("'count':3,'indices':{'bufferView':1,'componentType':5121}", "'values':{'bufferView':6}"), ON_FIRST},
         "accessor 0: needs 36 bytes of bufferView 6, which has 24"},
        {{.accessors = SPARSE("'count':2,'indices':{'bufferView':5,'componentType':5126}", "'values':{'bufferView':6}"), ON_FIRST},
         "accessor 0: sparse.indices: componentType 5126 is not an unsigned integer"},
        {{.accessors = SPARSE("'count':2,'indices':{'componentType':5123}", "'values':{'bufferView':6}"), ON_FIRST},
         "accessor 0: sparse.indices: bufferView is missing"},
        {{.accessors = SPARSE("'count':2", "'values':{'bufferView':6}"), ON_FIRST}, "accessor 0: sparse: indices is missing"},
        {{.accessors = SPARSE("'count':2,'indices':3", "'values':{'bufferView':6}"), ON_FIRST},
         "accessor 0: sparse: indices is not an object"},
    };
    assert_rows(rows, COUNT(rows));
}

static void meshes__bad_primitive__named(void **state)
{
    (void)state;
    const row rows[] = {
        {{.meshes = "[{'primitives':[{'attributes':{'POSITION':4}},{'attributes':{'POSITION':4},'indices':2}]}]"},
         "mesh 0 primitive 1: index 3 is out of range (3 vertices)"},
        {{.meshes = PRIMITIVE("'mode':4")}, "mesh 0 primitive 0: 4 elements are not whole triangles"},
        {{.meshes = PRIMITIVE("'mode':7")}, "mesh 0 primitive 0: mode 7 does not exist"},
        {{.meshes = PRIMITIVE("'mode':-1")}, "mesh 0 primitive 0: mode is not an integer in [0, 2147483647]"},
        {{.meshes = PRIMITIVE("'indices':4")}, "mesh 0 primitive 0: indices: accessor 4 is not a SCALAR of unsigned integers"},
        {{.meshes = PRIMITIVE("'indices':6")}, "mesh 0 primitive 0: indices: accessor 6 has no bufferView"},
        {{.meshes = PRIMITIVE("'indices':15")}, "mesh 0 primitive 0: indices: accessor 15 does not exist (there are 15)"},
        {{.meshes = PRIMITIVE("'indices':4294967297")}, "mesh 0 primitive 0: indices is not an integer in [0, 2147483647]"},
        {{.meshes = PRIMITIVE("'indices':1,'material':0")}, "mesh 0 primitive 0: material 0 does not exist (there are 0)"},
        {{.meshes = "[{'primitives':[{'attributes':{'NORMAL':0}}]}]"}, "mesh 0 primitive 0: has no POSITION"},
        {{.meshes = "[{'primitives':[{'indices':0}]}]"}, "mesh 0 primitive 0: attributes is missing"},
        {{.meshes = "[{'primitives':{}}]"}, "primitives is not an array"},
        {{.meshes = "[{'primitives':[3]}]"}, "mesh 0 primitive 0 is not an object"},
        {{.meshes = "[{}]"}, "mesh 0: primitives is missing"},
        {{.meshes = "[{'primitives':[]}]"}, "no triangles"},
        {{.meshes = "[]"}, "node 0: mesh 0 does not exist (there are 0)"},
        {{.meshes = "{}"}, "meshes is not an array"},
        {{.meshes = "[{'primitives':[{'attributes':{'POSITION':12}}]}]"}, "triangle 0: vertex is NaN"},
        {{.meshes = "[{'primitives':[{'attributes':{'POSITION':13}}]}]"}, "triangle 0: vertex is infinite"},
        {{.meshes = "[{'primitives':[{'attributes':{'POSITION':14}}]}]"}, "triangle 0: coordinate 2e+09 is beyond 1e+09"},
        {{.more = "'materials':[{'pbrMetallicRoughness':{'baseColorFactor':[2,0,0,1]}}],"},
         "material 0: base colour 2 is not between 0 and 1"},
        {{.more = "'materials':[{'pbrMetallicRoughness':{'baseColorFactor':[1,0,0]}}],"},
         "material 0: pbrMetallicRoughness: baseColorFactor is not an array of 4 numbers"},
    };
    assert_rows(rows, COUNT(rows));
}

static void nodes__bad_graph_or_transform__node_named(void **state)
{
    (void)state;
    const row rows[] = {
        {{.nodes = "[{'mesh':0,'children':[1]},{'children':[0]}]"}, "node 0 is reached twice: nodes must form a tree"},
        {{.nodes = "[{'mesh':0,'children':[0]}]"}, "node 0 is reached twice: nodes must form a tree"},
        {{.nodes = "[{'children':[1,2]},{'children':[2]},{'mesh':0}]"}, "node 2 is reached twice: nodes must form a tree"},
        {{.scenes = "[{'nodes':[0,0]}]"}, "node 0 is reached twice: nodes must form a tree"},
        {{.scenes = "[{'nodes':[1]}]"}, "node 1 does not exist (there are 1)"},
        {{.nodes = "[{'mesh':0,'children':[5]}]"}, "node 5 does not exist (there are 1)"},
        {{.nodes = "[{'mesh':1}]"}, "node 0: mesh 1 does not exist (there are 1)"},
        {{.nodes = "[{'mesh':'0'}]"}, "node 0: mesh is not an integer in [0, 2147483647]"},
        {{.scenes = "[]", .nodes = "[{'children':[0],'mesh':0}]"}, "no triangles"},
        {{.more = "'scene':1,"}, "scene 1 does not exist (there are 1)"},
        {{.more = "'scene':-1,"}, "root: scene is not an integer in [0, 2147483647]"},
        {{.nodes = "[{'mesh':0,'matrix':[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],'scale':[1,1,1]}]"},
         "node 0: has both a matrix and translation, rotation or scale"},
        {{.nodes = "[{'mesh':0,'matrix':[1,0,0,0.5,0,1,0,0,0,0,1,0,0,0,0,1]}]"}, "node 0: the last row of its matrix is not 0 0 0 1"},
        {{.nodes = "[{'mesh':0,'matrix':[1,0,0]}]"}, "node 0: matrix is not an array of 16 numbers"},
        {{.nodes = "[{'mesh':0,'rotation':[0,0,0,0]}]"}, "node 0: rotation is zero"},
        {{.nodes = "[{'mesh':0,'scale':[1,1,null]}]"}, "node 0: scale is not an array of 3 numbers"},
        {{.nodes = "[{'mesh':0,'scale':[1e300,1,1]}]"}, "triangle 0: vertex is infinite"},
        {{.nodes = "[{'scale':[1e300,1,1],'children':[1]},{'mesh':0,'scale':[1e300,1,1]}]"}, "triangle 0: vertex is NaN"},
        {{.nodes = "[7]"}, "node 0 is not an object"},
    };
    assert_rows(rows, COUNT(rows));
}

static void cameras_and_lights__bad_ones__named(void **state)
{
    (void)state;
    const char camera_nodes[] = "[{'mesh':0,'camera':0,'name':'eye'}]";
    const row rows[] = {
        {{.nodes = camera_nodes}, "node 0: camera 0 does not exist (there are 0)"},
        {{.nodes = camera_nodes, .more = "'cameras':[{'type':'perspective','perspective':{'yfov':4,'znear':1}}],"},
         "camera 'eye': yfov 4 is not between 0 and pi"},
        {{.nodes = camera_nodes, .more = "'cameras':[{'type':'perspective','perspective':{'znear':1}}],"},
         "camera 0: perspective: yfov is missing"},
        {{.nodes = camera_nodes, .more = "'cameras':[{'type':'perspective'}],"}, "camera 0: perspective is missing"},
        {{.nodes = camera_nodes, .more = "'cameras':[{'type':'fisheye'}],"}, "camera 0: type is neither perspective nor orthographic"},
        {{.nodes = "[{'mesh':0,'camera':0,'scale':[1,1,0]}]", .more = "'cameras':[{'type':'perspective','perspective':{'yfov':1}}],"},
         "node 0: its camera looks nowhere: the node's z axis is zero or not finite"},
        {{.nodes = "[{'mesh':0,'extras':{'light':{'corner':[0,0],'u':[1,0,0],'v':[0,1,0]}}}]"},
         "node 0: extras.light: corner is not an array of 3 numbers"},
        {{.nodes = "[{'mesh':0,'extras':{'light':{'corner':[0,0,0],'u':[1,0,0]}}}]"}, "node 0: extras.light: v is missing"},
        {{.nodes = "[{'mesh':0,'extras':{'light':{'corner':[0,0,0],'u':[1,0,0],'v':[2,0,0]}}}]"},
         "light: u and v are parallel or zero, so the light has no area"},
        {{.nodes = "[{'mesh':0,'extensions':{'KHR_lights_punctual':{'light':1}}}]",
          .more = "'extensions':{'KHR_lights_punctual':{'lights':[{'type':'point'}]}},"},
         "node 0: KHR_lights_punctual light 1 does not exist (there are 1)"},
        {{.nodes = "[{'mesh':0,'extensions':{'KHR_lights_punctual':{}}}]"}, "node 0: KHR_lights_punctual: light is missing"},
        {{.more = "'extensions':{'KHR_lights_punctual':{'lights':[{}]}},"}, "KHR_lights_punctual light 0: type is missing"},
    };
    assert_rows(rows, COUNT(rows));
}

static void root__wrong_version_or_extension__named(void **state)
{
    (void)state;
    const row rows[] = {
        {{.more = "'extensionsRequired':['KHR_draco_mesh_compression'],"},
         "extensionsRequired: KHR_draco_mesh_compression is not supported"},
        {{.more = "'extensionsRequired':['KHR_texture_transform','EXT_meshopt_compression'],"},
         "extensionsRequired: EXT_meshopt_compression is not supported"},
        {{.more = "'extensionsRequired':['X_unknown'],"}, "extensionsRequired: X_unknown is not supported"},
        {{.more = "'extensionsRequired':'KHR_texture_transform',"}, "extensionsRequired is not an array"},
        {{.more = "'extensionsRequired':[1],"}, "extensionsRequired: holds something else than strings"},
        {{.asset = "{'version':'1.0'}"}, "asset: version 1.0 instead of 2.0"},
        {{.asset = "{'version':2.0}"}, "asset: version is not a string"},
        {{.asset = "{}"}, "asset: version is missing"},
        {{.asset = "[]"}, "root: asset is not an object"},
        {{.asset = "{'version':'2.1','minVersion':'2.1'}"}, "asset: minVersion 2.1 is beyond 2.0"},
    };
    assert_rows(rows, COUNT(rows));
    assert_bytes_fail("{\"scenes\":[]}", 13, "asset is missing");
    assert_bytes_fail("[1,2]", 5, "the JSON is not an object");
    assert_bytes_fail("", 0, "empty file");
    assert_bytes_fail("{\"asset\":{\"version\":\"2.0\"}}", 27, "no triangles");
}

static void json__syntax_errors__position_given(void **state)
{
    (void)state;
    scene *s;
    base_error err;
    const char *const texts[] = {"{\"asset\":", "{\"asset\" 1}", "{\"a\":\"\xff\"}", "{\"a\":1e999}", "PK\3\4", "\"", "\"\\", "{\"a\":\"\\"};
    for (size_t i = 0; i < COUNT(texts); i++) {
        assert_int_equal(scene_gltf_parse("bad.gltf", (const unsigned char *)texts[i], strlen(texts[i]), &s, &err), BASE_ERR_INPUT);
        assert_ptr_equal(strstr(err.why, "not glTF: "), err.why);
        assert_null(strstr(err.why, "exception"));
    }
}

static void json__nesting__refused_beyond_256(void **state)
{
    (void)state;
    const size_t depth = 1000000;
    char *text = malloc(depth);
    assert_non_null(text);
    memset(text, '[', depth);
    assert_bytes_fail(text, depth, "JSON is nested more than 256 deep");
    for (size_t i = 0; i + 6 <= depth; i += 5)
        memcpy(text + i, "{\"a\":", 5);
    assert_bytes_fail(text, depth, "JSON is nested more than 256 deep");
    free(text);
    /* brackets in a string are no nesting; 250 arrays are few enough */
    char more[1200] = "'name':'[[[[{{{{\\\"[[[[',", *end = more + strlen(more);
    for (int i = 0; i < 300; i++)
        memcpy(end + i, "[", 1);
    memcpy(end + 300, "',", 3);
    memmove(end + 11, end, strlen(end) + 1);
    memcpy(end, "'comment':'", 11);
    const gltf_sample in_string = {.more = more};
    scene *s = load_sample(&in_string);
    scene_destroy(&s);
    char *p = more + sprintf(more, "'extras':");
    memset(p, '[', 250);
    memset(p + 250, ']', 250);
    memcpy(p + 500, ",", 2);
    s = load_sample(&in_string);
    scene_destroy(&s);
}

/* A good .glb with four bytes at `offset` replaced; `why` begins the reason. */
static void assert_patched_fails(size_t offset, uint32_t value, const char *why)
{
    const gltf_sample sample = {0};
    scene *s;
    base_error err;
    size_t size;
    unsigned char *glb = gltf_sample_glb(&sample, &size);
    assert_true(offset + 4 <= size);
    for (int i = 0; i < 4; i++)
        glb[offset + (size_t)i] = (unsigned char)(value >> 8 * i);
    assert_int_equal(scene_gltf_parse("patched.glb", glb, size, &s, &err), BASE_ERR_INPUT);
    if (strstr(err.why, why) != err.why)
        fail_msg("%s instead of %s", err.why, why);
    free(glb);
}

static void glb__wrong_header__named(void **state)
{
    (void)state;
    assert_patched_fails(4, 1, "GLB version 1 instead of 2");
    assert_patched_fails(8, 100, "GLB header says 100 bytes, but the file has ");
    assert_patched_fails(8, UINT32_MAX, "GLB header says 4294967295 bytes, but the file has ");
    assert_patched_fails(16, 0x004e4942, "first GLB chunk is not JSON");
    assert_patched_fails(12, UINT32_MAX, "GLB chunk at byte 12: has 4294967295 bytes, but the file only ");
    assert_patched_fails(12, 0, "GLB chunk at byte 20: has "); /* the JSON text, taken for a header */
}

static void glb__cut_anywhere__refused(void **state)
{
    (void)state;
    const gltf_sample sample = {0};
    size_t size;
    unsigned char *glb = gltf_sample_glb(&sample, &size);
    for (size_t cut = 0; cut < size; cut++) { /* a copy of its own, so that the sanitizer sees any read beyond it */
        unsigned char *part = malloc(cut + 1);
        scene *s;
        assert_non_null(part);
        memcpy(part, glb, cut);
        if (cut >= 12) /* make the header agree, so that the chunks are looked at */
            for (int i = 0; i < 4; i++)
                part[8 + i] = (unsigned char)(cut >> 8 * i);
        unsigned char *exact = realloc(part, cut ? cut : 1);
        assert_non_null(exact);
        assert_int_equal(scene_gltf_parse("cut.glb", exact, cut, &s, NULL), BASE_ERR_INPUT);
        free(exact);
    }
    assert_bytes_fail(glb, 7, "GLB header is cut off: 7 bytes instead of 12");
    free(glb);
}

static void buffers__bad_place_or_size__named(void **state)
{
    (void)state;
    const row rows[] = {
        {{.buffers = "[{'byteLength':1000}]"}, "buffer 0: byteLength is 1000, but there are 372 bytes"},
        {{.buffers = "[{'byteLength':'348'}]"}, "buffer 0: byteLength is not an integer in [0, 2147483647]"},
        {{.buffers = "[{'byteLength':372},{'byteLength':4}]"}, "buffer 1: has no uri"},
        {{.buffers = "[{'byteLength':372},{'byteLength':2147483647,'uri':'data:;base64,AAAA'}]"}, "buffer 1: more than 2 GiB of buffers"},
        {{.buffers = "[{'byteLength':4,'uri':'data:;base64,AAAA'}]"}, "buffer 0: byteLength is 4, but there are 3 bytes"},
        {{.buffers = "[{'byteLength':3,'uri':'data:;base64,AA*A'}]"}, "buffer 0: uri: character 2 of the data is not base64"},
        {{.buffers = "[{'byteLength':3,'uri':'data:;base64,AAAAA'}]"}, "buffer 0: uri: the base64 data are cut off"},
        {{.buffers = "[{'byteLength':3,'uri':'data:,AAAA'}]"}, "buffer 0: uri: data that are not base64"},
        {{.buffers = "[{'byteLength':3,'uri':'pool.bin'}]"},
         "buffer 0: uri 'pool.bin' names another file, but this scene is in memory"},
    };
    assert_rows(rows, COUNT(rows));
    const char *const outside[] = {"/etc/passwd", "../pool.bin", "a/../../pool.bin", "a/..", "%2e%2e/pool.bin", "%2Fetc",
                                   "http://host/pool.bin", "C:pool.bin", "a%5Cb", ""};
    for (size_t i = 0; i < COUNT(outside); i++) {
        char buffers[100];
        scene *s;
        base_error err;
        size_t size;
        snprintf(buffers, sizeof buffers, "[{'byteLength':3,'uri':'%s'}]", outside[i]);
        const gltf_sample sample = {.buffers = buffers};
        unsigned char *glb = gltf_sample_glb(&sample, &size);
        assert_int_equal(scene_gltf_parse("outside", glb, size, &s, &err), BASE_ERR_INPUT);
        assert_non_null(strstr(err.why, "is not a path inside the file's folder"));
        free(glb);
    }
}

static void errors__no_place_for_words__status_alone(void **state)
{
    (void)state;
    scene *s;
    assert_int_equal(scene_gltf_parse("x", (const unsigned char *)"{}", 2, &s, NULL), BASE_ERR_INPUT);
    assert_int_equal(scene_gltf_load("missing.glb", &s, NULL), BASE_ERR_INPUT);
    assert_null(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(accessors__out_of_bounds__sizes_given),
        cmocka_unit_test(views__out_of_bounds__sizes_given),
        cmocka_unit_test(sparse__bad_parts__field_named),
        cmocka_unit_test(meshes__bad_primitive__named),
        cmocka_unit_test(nodes__bad_graph_or_transform__node_named),
        cmocka_unit_test(cameras_and_lights__bad_ones__named),
        cmocka_unit_test(root__wrong_version_or_extension__named),
        cmocka_unit_test(json__syntax_errors__position_given),
        cmocka_unit_test(json__nesting__refused_beyond_256),
        cmocka_unit_test(glb__wrong_header__named),
        cmocka_unit_test(glb__cut_anywhere__refused),
        cmocka_unit_test(buffers__bad_place_or_size__named),
        cmocka_unit_test(errors__no_place_for_words__status_alone),
    };
    return cmocka_run_group_tests_name("scene/gltf_errors", tests, NULL, NULL);
}
