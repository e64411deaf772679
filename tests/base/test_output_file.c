/* Output files: whole, or not there. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "lrbni/base/output_file.h"
#include "tests/base/files.h"

static int set_up(void **state)
{
    *state = files_make_directory();
    return 0;
}

static int tear_down(void **state)
{
    files_remove_directory(*state);
    return 0;
}

static void assert_contents(const char *path, const char *expected)
{
    char *text = files_read(path, NULL);
    assert_non_null(text);
    assert_string_equal(text, expected);
    free(text);
}

static void commit__new_file__appears_whole_and_only_then(void **state)
{
    char *path = files_path(*state, "a.csv");
    base_output out;
    assert_int_equal(base_output_begin(path, false, &out, NULL), BASE_OK);
    fputs("x,y\n", out.stream);
    assert_int_equal(access(path, F_OK), -1);
    assert_int_equal(base_output_commit(&out, NULL), BASE_OK);
    assert_contents(path, "x,y\n");
    assert_int_equal(files_count(*state), 1);
    assert_null(out.stream);
    free(path);
}

static void begin__temporary_file__is_hidden_beside_and_keeps_the_extension(void **state)
{
    char *path = files_path(*state, "a.tar.png");
    base_output out;
    assert_int_equal(base_output_begin(path, false, &out, NULL), BASE_OK);
    size_t directory = strlen(*state);
    assert_memory_equal(out.temp_path, *state, directory);
    assert_memory_equal(out.temp_path + directory, "/.a.tar.", 8);
    assert_string_equal(strrchr(out.temp_path, '.'), ".png");
    base_output_abort(&out);
    free(path);
}

static void begin__same_name_twice__both_have_files_of_their_own(void **state)
{
    char *path = files_path(*state, "a.txt");
    base_output first, second;
    assert_int_equal(base_output_begin(path, false, &first, NULL), BASE_OK);
    assert_int_equal(base_output_begin(path, false, &second, NULL), BASE_OK);
    assert_string_not_equal(first.temp_path, second.temp_path);
    fputs("first", first.stream);
    fputs("second", second.stream);
    assert_int_equal(base_output_commit(&first, NULL), BASE_OK);
    assert_int_equal(base_output_commit(&second, NULL), BASE_OK);
    assert_contents(path, "second");
    assert_int_equal(files_count(*state), 1);
    free(path);
}

static void abort__after_writing__leaves_nothing_and_the_old_file(void **state)
{
    char *path = files_path(*state, "a.csv");
    char *other = files_path(*state, "b.csv");
    base_output out;
    files_write(path, "old");
    assert_int_equal(base_output_begin(path, false, &out, NULL), BASE_OK);
    fputs("new", out.stream);
    base_output_abort(&out);
    assert_int_equal(base_output_begin(other, false, &out, NULL), BASE_OK);
    fputs("new", out.stream);
    base_output_abort(&out);
    base_output_abort(&out); /* zeroed: nothing happens */
    assert_contents(path, "old");
    assert_int_equal(files_count(*state), 1);
    free(path);
    free(other);
}

static void commit__old_file__is_replaced_with_its_permissions(void **state)
{
    char *path = files_path(*state, "a.csv");
    base_output out;
    struct stat info;
    files_write(path, "old and longer");
    assert_int_equal(chmod(path, 0640), 0);
    assert_int_equal(base_output_begin(path, false, &out, NULL), BASE_OK);
    fputs("new", out.stream);
    assert_int_equal(base_output_commit(&out, NULL), BASE_OK);
    assert_contents(path, "new");
    assert_int_equal(stat(path, &info), 0);
    assert_int_equal(info.st_mode & 07777, 0640);
    free(path);
}

static void commit__new_file__obeys_the_umask(void **state)
{
    char *path = files_path(*state, "a.csv");
    base_output out;
    struct stat info;
    mode_t old = umask(027);
    assert_int_equal(base_output_begin(path, false, &out, NULL), BASE_OK);
    assert_int_equal(base_output_commit(&out, NULL), BASE_OK);
    umask(old);
    assert_int_equal(stat(path, &info), 0);
    assert_int_equal(info.st_mode & 07777, 0640);
    free(path);
}

static void commit__symbolic_link__stays_and_its_target_is_replaced(void **state)
{
    char *target = files_path(*state, "target.csv");
    char *link = files_path(*state, "link.csv");
    base_output out;
    struct stat info;
    files_write(target, "old");
    assert_int_equal(symlink("target.csv", link), 0);
    assert_int_equal(base_output_begin(link, false, &out, NULL), BASE_OK);
    fputs("new", out.stream);
    assert_int_equal(base_output_commit(&out, NULL), BASE_OK);
    assert_int_equal(lstat(link, &info), 0);
    assert_true(S_ISLNK(info.st_mode));
    assert_contents(target, "new");
    assert_int_equal(files_count(*state), 2);
    free(target);
    free(link);
}

static void commit__very_long_name__works(void **state)
{
    char name[256];
    memset(name, 'n', 251);
    strcpy(name + 251, ".csv");
    char *path = files_path(*state, name);
    base_output out;
    assert_int_equal(base_output_begin(path, false, &out, NULL), BASE_OK);
    assert_int_equal(base_output_commit(&out, NULL), BASE_OK);
    assert_contents(path, "");
    free(path);
}

/* What cannot be begun: input error, the file named, nothing left behind. */
static void assert_refused(const char *path, const char *why)
{
    base_output out;
    base_error err;
    assert_int_equal(base_output_begin(path, true, &out, &err), BASE_ERR_INPUT);
    assert_int_equal(base_exit_code(err.status), 2);
    assert_string_equal(err.what, path);
    assert_non_null(strstr(err.why, why));
    assert_null(out.stream);
    assert_null(out.path);
}

static void begin__impossible_names__are_input_errors_naming_the_file(void **state)
{
    char *file = files_path(*state, "file");
    char *below_file = files_path(*state, "file/a.csv");
    char *no_directory = files_path(*state, "none/a.csv");
    char *slash = files_path(*state, "new/");
    char *dangling = files_path(*state, "dangling");
    base_error err;
    base_output out;
    files_write(file, "");
    assert_int_equal(symlink("nowhere", dangling), 0);
    assert_refused(no_directory, "No such file or directory");
    assert_refused(below_file, "Not a directory");
    assert_refused(*state, "is a directory");
    assert_refused(slash, "cannot be created");
    assert_refused(dangling, "symbolic link");
    assert_int_equal(base_output_begin("", true, &out, &err), BASE_ERR_INPUT);
    assert_int_equal(files_count(*state), 2);
    free(file);
    free(below_file);
    free(no_directory);
    free(slash);
    free(dangling);
}

static void begin__no_permission__is_an_input_error(void **state)
{
    char *path = files_path(*state, "a.csv");
    char *old = files_path(*state, "old.csv");
    files_write(old, "old");
    assert_int_equal(chmod(old, 0444), 0);
    assert_int_equal(chmod(*state, 0555), 0);
    bool root = geteuid() == 0; /* who may write everywhere, so somebody else tries */
    if (root)
        assert_int_equal(seteuid(65534), 0);
    assert_refused(path, "Permission denied");
    assert_refused(old, "Permission denied");
    if (root)
        assert_int_equal(seteuid(0), 0);
    assert_int_equal(chmod(*state, 0755), 0);
    assert_contents(old, "old");
    assert_int_equal(files_count(*state), 1);
    free(path);
    free(old);
}

static void commit__full_device__is_an_io_error(void **state)
{
    (void)state;
    base_output out;
    base_error err;
    assert_int_equal(base_output_begin("/dev/full", false, &out, NULL), BASE_OK);
    assert_null(out.temp_path);
    fputs("some", out.stream);
    assert_int_equal(base_output_commit(&out, &err), BASE_ERR_IO);
    assert_int_equal(base_exit_code(err.status), 3);
    assert_string_equal(err.what, "/dev/full");
    assert_non_null(strstr(err.why, "No space left on device"));
}

static void commit__failed_write_long_before__is_still_found(void **state)
{
    (void)state;
    base_output out;
    base_error err;
    assert_int_equal(base_output_begin("/dev/full", false, &out, NULL), BASE_OK);
    fputs("some", out.stream);
    assert_int_equal(fflush(out.stream), EOF);
    assert_int_equal(base_output_commit(&out, &err), BASE_ERR_IO);
}

/* The file behind the stream is exchanged for a full one, as when the disk fills up in the middle. */
static void commit__write_error_in_a_real_file__keeps_the_old_one(void **state)
{
    char *path = files_path(*state, "a.csv");
    base_output out;
    base_error err;
    files_write(path, "old");
    assert_int_equal(base_output_begin(path, false, &out, NULL), BASE_OK);
    int full = open("/dev/full", O_WRONLY);
    assert_true(full >= 0);
    assert_true(dup2(full, fileno(out.stream)) >= 0);
    close(full);
    fputs("new", out.stream);
    assert_int_equal(base_output_commit(&out, &err), BASE_ERR_IO);
    assert_string_equal(err.what, path);
    assert_contents(path, "old");
    assert_int_equal(files_count(*state), 1);
    free(path);
}

static void commit__rename_refused__leaves_no_temporary_file(void **state)
{
    char *path = files_path(*state, "a.csv");
    base_output out;
    base_error err;
    assert_int_equal(base_output_begin(path, false, &out, NULL), BASE_OK);
    assert_int_equal(mkdir(path, 0755), 0); /* somebody else was faster */
    assert_int_equal(base_output_commit(&out, &err), BASE_ERR_INPUT);
    assert_string_equal(err.what, path);
    assert_int_equal(rmdir(path), 0);
    assert_int_equal(files_count(*state), 0);
    free(path);
}

static void commit__null_device__is_written_not_replaced(void **state)
{
    (void)state;
    base_output out;
    struct stat info;
    assert_int_equal(base_output_begin("/dev/null", false, &out, NULL), BASE_OK);
    fputs("gone", out.stream);
    assert_int_equal(base_output_commit(&out, NULL), BASE_OK);
    assert_int_equal(stat("/dev/null", &info), 0);
    assert_true(S_ISCHR(info.st_mode));
}

static void begin__dash__is_stdout_only_where_allowed(void **state)
{
    base_output out;
    char here[4096];
    assert_int_equal(base_output_begin("-", true, &out, NULL), BASE_OK);
    assert_ptr_equal(out.stream, stdout);
    assert_int_equal(base_output_commit(&out, NULL), BASE_OK);
    assert_true(fprintf(stdout, "# stdout is still open\n") > 0);
    assert_non_null(getcwd(here, sizeof here));
    assert_int_equal(chdir(*state), 0);
    assert_int_equal(base_output_begin("-", false, &out, NULL), BASE_OK);
    assert_int_equal(base_output_commit(&out, NULL), BASE_OK);
    assert_int_equal(chdir(here), 0);
    char *path = files_path(*state, "-");
    assert_contents(path, "");
    free(path);
}

static void commit__stdout_on_full_device__is_an_io_error(void **state)
{
    (void)state;
    base_output out;
    base_error err;
    fflush(stdout);
    int saved = dup(STDOUT_FILENO);
    int full = open("/dev/full", O_WRONLY);
    assert_int_equal(dup2(full, STDOUT_FILENO), STDOUT_FILENO);
    base_status begun = base_output_begin("-", true, &out, NULL);
    fputs("some", out.stream);
    base_status status = base_output_commit(&out, &err);
    dup2(saved, STDOUT_FILENO);
    close(saved);
    close(full);
    assert_int_equal(begun, BASE_OK);
    assert_int_equal(status, BASE_ERR_IO);
    assert_string_equal(err.what, "standard output");
}

#define CASE(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)

int main(void)
{
    const struct CMUnitTest tests[] = {
        CASE(commit__new_file__appears_whole_and_only_then),
        CASE(begin__temporary_file__is_hidden_beside_and_keeps_the_extension),
        CASE(begin__same_name_twice__both_have_files_of_their_own),
        CASE(abort__after_writing__leaves_nothing_and_the_old_file),
        CASE(commit__old_file__is_replaced_with_its_permissions),
        CASE(commit__new_file__obeys_the_umask),
        CASE(commit__symbolic_link__stays_and_its_target_is_replaced),
        CASE(commit__very_long_name__works),
        CASE(begin__impossible_names__are_input_errors_naming_the_file),
        CASE(begin__no_permission__is_an_input_error),
        CASE(commit__full_device__is_an_io_error),
        CASE(commit__failed_write_long_before__is_still_found),
        CASE(commit__write_error_in_a_real_file__keeps_the_old_one),
        CASE(commit__rename_refused__leaves_no_temporary_file),
        CASE(commit__null_device__is_written_not_replaced),
        CASE(begin__dash__is_stdout_only_where_allowed),
        CASE(commit__stdout_on_full_device__is_an_io_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
