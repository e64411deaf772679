/* Files of kd-trees: what is written is read back, and nothing else is. */
#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "kernels/accel/kdtree_file.h"
#include "lrbni/base/hash.h"
#include "lrbni/base/random.h"
#include "tests/base/files.h"
#include "tests/kernels/accel/kdtree_check.h"
#include "tests/kernels/accel/soup.h"

static char *folder, *path;

static int set_up(void **state)
{
    (void)state;
    folder = files_make_directory();
    path = files_path(folder, "tree");
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    free(path);
    files_remove_directory(folder);
    return 0;
}

static void write_bytes(const char *name, const void *bytes, size_t size)
{
    FILE *file = fopen(name, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

/* Random triangles, and a closed tetrahedron around some empty space. */
static scene sample(void)
{
    static const scene_triangle faces[4] = {{{{5, 5, 5}, {7, 5, 5}, {5, 7, 5}}},
                                            {{{5, 5, 5}, {5, 7, 5}, {5, 5, 7}}},
                                            {{{5, 5, 5}, {5, 5, 7}, {7, 5, 5}}},
                                            {{{7, 5, 5}, {5, 5, 7}, {5, 7, 5}}}};
    scene s = soup_degenerate(3, 300, 20);
    memcpy(s.triangles, faces, sizeof faces);
    s.hash = 0x123456789abcdef;
    return s;
}

static kdtree *build(const scene *s, const kdtree_options *options)
{
    kdtree *tree = NULL;
    assert_int_equal(kdtree_build(s, options, &tree, NULL), BASE_OK);
    return tree;
}

static void file__written_and_read__same_bytes(void **state)
{
    scene scenes[] = {sample(), soup_random(1, 1, 0.1), soup_degenerate(1, 10, 1), soup_coplanar(2, 100)};
    (void)state;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        kdtree_options options = kdtree_options_default();
        options.min_area = 0;
        kdtree *tree = build(&scenes[i], &options), *again = NULL;
        base_error err = {0};
        uint64_t hash = kdtree_check_hash(tree);
        assert_int_equal(kdtree_mark_occluders(tree, NULL, 0, false, NULL), BASE_OK);
        assert_int_equal(kdtree_write(tree, &scenes[i], &options, path, &err), BASE_OK);
        options.jobs = 3;
        if (kdtree_read(path, &scenes[i], &options, &again, &err) != BASE_OK)
            fail_msg("%s: %s", err.what, err.why);
        kdtree_check(&scenes[i], again, &options);
        assert_true(kdtree_check_hash(again) == hash);
        kdtree_destroy(&tree);
        kdtree_destroy(&again);
        soup_free(&scenes[i]);
    }
}

static void file__other_scene_or_options__refused(void **state)
{
    scene s = sample();
    kdtree_options options = kdtree_options_default();
    kdtree *tree = build(&s, &options), *again = NULL;
    (void)state;
    assert_int_equal(kdtree_write(tree, &s, &options, path, NULL), BASE_OK);
    for (int i = 0; i < 8; i++) {
        kdtree_options other = options;
        base_error err = {0};
        unsigned *fields[] = {&other.empty_percent,  &other.covered_planes,  &other.min_area,
                              &other.perfect_splits, &other.empty_occluders, &other.max_depth};
        if (i < 6)
            *fields[i] ^= 1;
        other.traversal_cost += i == 6 ? 0.5f : 0.0f;
        s.hash += i == 7;
        assert_int_equal(kdtree_read(path, &s, &other, &again, &err), BASE_ERR_INPUT);
        assert_string_equal(err.what, path);
        assert_non_null(strstr(err.why, "another"));
        assert_null(again);
    }
    kdtree_destroy(&tree);
    soup_free(&s);
}

/* A tree's file in memory. */
static unsigned char *file_of(const scene *s, const kdtree_options *options, size_t *size)
{
    kdtree *tree = build(s, options);
    assert_int_equal(kdtree_write(tree, s, options, path, NULL), BASE_OK);
    kdtree_destroy(&tree);
    return (unsigned char *)files_read(path, size);
}

static void file__any_byte_changed__refused(void **state)
{
    scene s = sample();
    kdtree_options options = kdtree_options_default();
    size_t size;
    unsigned char *bytes = file_of(&s, &options, &size);
    (void)state;
    for (size_t i = 0; i < size; i += i < 100 ? 1 : 97) {
        kdtree *tree = NULL;
        bytes[i] ^= 0x10;
        write_bytes(path, bytes, size);
        assert_int_equal(kdtree_read(path, &s, &options, &tree, NULL), BASE_ERR_INPUT);
        assert_null(tree);
        bytes[i] ^= 0x10;
    }
    free(bytes);
    soup_free(&s);
}

static void file__cut_off_or_longer__refused(void **state)
{
    scene s = sample();
    kdtree_options options = kdtree_options_default();
    size_t size;
    unsigned char *bytes = file_of(&s, &options, &size);
    kdtree *tree = NULL;
    (void)state;
    for (size_t length = 0; length < size; length += length < 100 ? 1 : 307) {
        write_bytes(path, bytes, length);
        assert_int_equal(kdtree_read(path, &s, &options, &tree, NULL), BASE_ERR_INPUT);
    }
    unsigned char *longer = calloc(size + 1, 1);
    assert_non_null(longer);
    memcpy(longer, bytes, size);
    write_bytes(path, longer, size + 1);
    assert_int_equal(kdtree_read(path, &s, &options, &tree, NULL), BASE_ERR_INPUT);
    assert_int_equal(kdtree_read("no such file", &s, &options, &tree, NULL), BASE_ERR_INPUT);
    assert_int_equal(kdtree_read("/dev/null", &s, &options, &tree, NULL), BASE_ERR_INPUT);
    free(longer);
    free(bytes);
    soup_free(&s);
}

/* With a right checksum: refused, or a tree that can be walked. */
static void file__forged__refused_or_sound(void **state)
{
    scene s = sample();
    kdtree_options options = kdtree_options_default();
    size_t size, refused = 0;
    unsigned char *bytes = file_of(&s, &options, &size);
    base_random random = {11};
    (void)state;
    for (int i = 0; i < 800; i++) {
        size_t at = 40 + base_random_bits(&random) % (size - 48);
        unsigned char was = bytes[at];
        kdtree *tree = NULL;
        bytes[at] ^= (unsigned char)(1 + base_random_bits(&random) % 255);
        uint64_t hash = base_hash(BASE_HASH_START, bytes, size - 8);
        memcpy(bytes + size - 8, &hash, sizeof hash);
        write_bytes(path, bytes, size);
        if (kdtree_read(path, &s, &options, &tree, NULL) == BASE_OK) {
            static const float origin[][3] = {{0.1f, 0.2f, 0.3f}};
            kdtree_check(&s, tree, &options);
            assert_int_equal(kdtree_mark_occluders(tree, origin, 1, false, NULL), BASE_OK);
        } else
            refused++;
        kdtree_destroy(&tree);
        bytes[at] = was;
    }
    assert_true(refused > 400);
    free(bytes);
    soup_free(&s);
}

static void open__no_folder__built(void **state)
{
    scene s = sample();
    kdtree_options options = kdtree_options_default();
    kdtree *tree = NULL;
    base_error note, err;
    (void)state;
    assert_int_equal(kdtree_open(&s, &options, NULL, &tree, &note, &err), BASE_OK);
    assert_int_equal(note.status, BASE_OK);
    kdtree_destroy(&tree);
    soup_free(&s);
}

/* The only file of a folder, for free(). */
static char *only_file(const char *where)
{
    char *name = NULL;
    assert_int_equal(files_count(where), 1);
    DIR *directory = opendir(where);
    assert_non_null(directory);
    for (struct dirent *entry; (entry = readdir(directory)) != NULL;)
        if (entry->d_name[0] != '.')
            name = files_path(where, entry->d_name);
    closedir(directory);
    assert_non_null(name);
    return name;
}

static void open__twice__read_the_second_time_and_mended_if_bad(void **state)
{
    scene s = sample();
    kdtree_options options = kdtree_options_default();
    char *cache = files_make_directory();
    struct stat first, now;
    kdtree *tree = NULL;
    base_error note, err;
    (void)state;
    assert_int_equal(rmdir(cache), 0); /* it is made again */
    assert_int_equal(kdtree_open(&s, &options, cache, &tree, &note, &err), BASE_OK);
    assert_int_equal(note.status, BASE_OK);
    uint64_t hash = kdtree_check_hash(tree);
    kdtree_destroy(&tree);
    char *name = only_file(cache);
    assert_int_equal(stat(name, &first), 0);
    assert_int_equal(kdtree_open(&s, &options, cache, &tree, &note, &err), BASE_OK);
    assert_int_equal(note.status, BASE_OK);
    assert_true(kdtree_check_hash(tree) == hash);
    kdtree_destroy(&tree);
    assert_int_equal(stat(name, &now), 0);
    assert_int_equal(now.st_ino, first.st_ino); /* not written again */
    write_bytes(name, "nonsense", 8);
    assert_int_equal(kdtree_open(&s, &options, cache, &tree, &note, &err), BASE_OK);
    assert_int_equal(note.status, BASE_ERR_INPUT);
    assert_string_equal(note.what, name);
    assert_true(kdtree_check_hash(tree) == hash);
    kdtree_destroy(&tree);
    assert_int_equal(kdtree_open(&s, &options, cache, &tree, &note, &err), BASE_OK);
    assert_int_equal(note.status, BASE_OK);
    kdtree_destroy(&tree);
    free(name);
    files_remove_directory(cache);
    soup_free(&s);
}

static void open__folder_cannot_be_made__built_with_a_note(void **state)
{
    scene s = sample();
    kdtree_options options = kdtree_options_default();
    kdtree *tree = NULL;
    base_error note, err;
    (void)state;
    assert_int_equal(kdtree_open(&s, &options, "no/such/folder", &tree, &note, &err), BASE_OK);
    assert_int_equal(note.status, BASE_ERR_INPUT);
    assert_non_null(tree);
    kdtree_destroy(&tree);
    soup_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(file__written_and_read__same_bytes),
        cmocka_unit_test(file__other_scene_or_options__refused),
        cmocka_unit_test(file__any_byte_changed__refused),
        cmocka_unit_test(file__cut_off_or_longer__refused),
        cmocka_unit_test(file__forged__refused_or_sound),
        cmocka_unit_test(open__no_folder__built),
        cmocka_unit_test(open__twice__read_the_second_time_and_mended_if_bad),
        cmocka_unit_test(open__folder_cannot_be_made__built_with_a_note),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
