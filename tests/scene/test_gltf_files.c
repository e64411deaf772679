/* The glTF loader on files: external buffers, files that are not there, and the real scenes where they are. */
#include "tests/scene/gltf_check.h"

#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include "scene/scene.h"
#include "tests/scene/near.h"

static void write_file(const char *path, const void *data, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

/* Tests run in a folder of their own, which they leave empty. */
static int enter_folder(void **state)
{
    const char *base = getenv("TMPDIR");
    char *folder = malloc(4096);
    if (!folder)
        return -1;
    snprintf(folder, 4096, "%s/gltf_files_XXXXXX", base && *base ? base : P_tmpdir);
    *state = folder;
    return mkdtemp(folder) && chdir(folder) == 0 && mkdir("scene", 0700) == 0 && mkdir("scene/data", 0700) == 0 ? 0 : -1;
}

static int leave_folder(void **state)
{
    char *folder = *state;
    int ok = rmdir("scene/data") == 0 && rmdir("scene") == 0 && chdir("/") == 0 && rmdir(folder) == 0;
    free(folder);
    return ok ? 0 : -1;
}

static void load__external_buffer__found_beside_the_file(void **state)
{
    (void)state;
    size_t size, buffer_size;
    unsigned char *buffer = gltf_sample_buffer(&buffer_size);
    const gltf_sample sample = {.buffers = "[{'byteLength':372,'uri':'data/the%20pool.bin'}]"};
    unsigned char *text = gltf_sample_text(&sample, &size);
    scene *s, *plain = load_sample(gltf_sample_find("triangle"));
    base_error err;
    write_file("scene/external.gltf", text, size);
    assert_int_equal(scene_gltf_load("scene/external.gltf", &s, &err), BASE_ERR_INPUT);
    assert_string_equal(err.what, "scene/external.gltf");
    assert_string_equal(err.why, "buffer 0: uri 'data/the pool.bin': cannot open: No such file or directory");
    write_file("scene/data/the pool.bin", buffer, buffer_size);
    assert_int_equal(scene_open("scene/external.gltf", &s, &err), BASE_OK);
    assert_string_equal(s->name, "external");
    assert_true(s->hash == plain->hash);
    scene_destroy(&s);
    write_file("scene/data/the pool.bin", buffer, 300);
    assert_int_equal(scene_gltf_load("scene/external.gltf", &s, &err), BASE_ERR_INPUT);
    assert_string_equal(err.why, "buffer 0: byteLength is 372, but there are 300 bytes");
    assert_int_equal(unlink("scene/data/the pool.bin") | unlink("scene/external.gltf"), 0);
    scene_destroy(&plain);
    free(buffer);
    free(text);
}

static void load__missing_folder_unreadable__reason_given(void **state)
{
    (void)state;
    scene *s;
    base_error err;
    assert_int_equal(scene_gltf_load("scene/none.glb", &s, &err), BASE_ERR_INPUT);
    assert_string_equal(err.what, "scene/none.glb");
    assert_string_equal(err.why, "cannot open: No such file or directory");
    assert_int_equal(scene_gltf_load("scene", &s, &err), BASE_ERR_INPUT);
    assert_string_equal(err.why, "not a regular file");
    write_file("scene/empty.glb", "", 0);
    assert_int_equal(scene_gltf_load("scene/empty.glb", &s, &err), BASE_ERR_INPUT);
    assert_string_equal(err.why, "empty file");
    assert_int_equal(truncate("scene/empty.glb", ((off_t)1 << 31) + 1), 0); /* sparse: takes no room */
    assert_int_equal(scene_gltf_load("scene/empty.glb", &s, &err), BASE_ERR_INPUT);
    assert_string_equal(err.why, "larger than 2 GiB");
    assert_int_equal(unlink("scene/empty.glb"), 0);
}

static void open__unknown_builtin__names_listed(void **state)
{
    (void)state;
    scene *s;
    base_error err;
    assert_int_equal(scene_open("builtin:nowhere", &s, &err), BASE_ERR_USAGE);
    assert_string_equal(err.what, "builtin:nowhere");
    assert_non_null(strstr(err.why, "rooms-804"));
    assert_null(s);
}

/* Triangles as counted by another reader (see the scenes' own list), and what else is known of each file. */
static void load__real_scenes__triangles_camera_light(void **state)
{
    (void)state;
    const struct {
        const char *name;
        size_t triangles;
    } rows[] = {{"conference", 277552},       {"sponza_dabrovic", 66454},  {"room_804", 804},           {"armadillo_100k", 99978},
                {"plant_4k", 4450},           {"asian_dragon_28k", 28200}, {"country_kitchen_1443k", 1443509}, {"trex_25k", 25046},
                {"fern_patch_213k", 213506},  {"saloon_street_60k", 59523}, {"forest_camp_174k", 174212}, {"bart_kitchen", 110561},
                {"bart_robots", 71708},       {"bart_museum_10k", 10476},  {"bart_museum_26k", 26796},  {"bart_museum_76k", 75948},
                {"teapot", 6322},             {"bunny", 69453},            {"sponza_crytek", 262205},   {"coffee_maker", 235265}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char path[4096];
        scene *s;
        base_error err = {0};
        snprintf(path, sizeof path, "%s/%s.glb", SCENES_FOLDER, rows[i].name);
        if (access(path, R_OK) != 0) { /* said of each file; cmocka's skip() would print "not ok" */
            print_message("# skipped: %s.glb is not there\n", rows[i].name);
            continue;
        }
        if (scene_gltf_load(path, &s, &err) != BASE_OK)
            fail_msg("%s: %s", err.what, err.why);
        assert_string_equal(s->name, rows[i].name);
        assert_int_equal(s->triangle_count, rows[i].triangles);
        assert_int_equal(s->camera_count, 1);
        assert_string_equal(s->cameras[0].name, "camera");
        assert_true(s->light.has_area);
        scene_destroy(&s);
    }
}

/* Numbers of room_804 from the scenes' own list. */
static void load__room__numbers_of_its_list(void **state)
{
    (void)state;
    scene *s;
    const double high[3] = {6, 2.8, 5}, eye[3] = {5.6, 1.9, 4.6}, ahead[3] = {-0.751, -0.275, -0.601};
    const double corner[3] = {2.45, 2.71, 2.35}, u[3] = {1.1, 0, 0}, v[3] = {0, 0, 0.3};
    if (access(SCENES_FOLDER "/room_804.glb", R_OK) != 0) {
        print_message("# skipped: room_804.glb is not there\n");
        return;
    }
    assert_int_equal(scene_gltf_load(SCENES_FOLDER "/room_804.glb", &s, NULL), BASE_OK);
    for (int axis = 0; axis < 3; axis++) {
        assert_near(s->bounds_min[axis], 0, 1e-6);
        assert_near(s->bounds_max[axis], high[axis], 1e-6);
        assert_near(s->cameras[0].position[axis], eye[axis], 1e-6);
        assert_near(s->cameras[0].forward[axis], ahead[axis], 1e-3);
        assert_near(s->light.corner[axis], corner[axis], 1e-6);
        assert_near(s->light.u[axis], u[axis], 1e-6);
        assert_near(s->light.v[axis], v[axis], 1e-6);
    }
    assert_near(s->cameras[0].yfov, 60 * 3.14159265358979 / 180, 1e-6);
    scene_destroy(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(load__external_buffer__found_beside_the_file, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(load__missing_folder_unreadable__reason_given, enter_folder, leave_folder),
        cmocka_unit_test(open__unknown_builtin__names_listed),
        cmocka_unit_test(load__real_scenes__triangles_camera_light),
        cmocka_unit_test(load__room__numbers_of_its_list),
    };
    return cmocka_run_group_tests_name("scene/gltf_files", tests, NULL, NULL);
}
