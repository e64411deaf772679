/* Plots: what is told to gnuplot, the picture that it draws, and gnuplot missing or failing. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "reports/plot.h"
#include "tests/base/files.h"

static const double speeds[] = {1, 20.5, 300}, errors[] = {0.5, 0, 0.125};
static const char *const texts[] = {"it's `here` $HOME", "unseen", NULL};
static const report_series both[] = {
    {.name = "points", .x = speeds, .y = errors, .labels = texts, .count = 3},
    {.name = "line", .x = speeds, .y = speeds, .count = 3, .line = REPORT_LINE_POINTS},
};
static const report_plot example = {.title = "Speed\nagainst 'error'", .x = {"speed", true}, .y = {"error (%)", true}, .series = both, .series_count = 2};

static __attribute__((noinline)) char *script_of(const report_plot *plot)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    assert_int_equal(report_plot_write_script(plot, out, NULL), BASE_OK);
    fclose(out);
    return text;
}

static void script__texts_and_axes__taken_literally(void **state)
{
    (void)state;
    char *script = script_of(&example);
    assert_non_null(strstr(script, "set title 'Speed against ''error'''\n"));
    assert_non_null(strstr(script, "set label 'it''s `here` $HOME' at 1,0.5 "));
    assert_non_null(strstr(script, "set logscale x 10\n"));
    assert_non_null(strstr(script, "plot $data0 using 1:2 with points linetype 1 title 'points', $data1 using 1:2 with linespoints linetype 2 title 'line'\n"));
    free(script);
}

static void script__zero_on_a_logarithmic_axis__left_out(void **state)
{
    (void)state;
    report_plot linear = example;
    char *script = script_of(&example);
    assert_non_null(strstr(script, "$data0 << EOD\n1 0.5\n\n300 0.125\nEOD\n"));
    assert_null(strstr(script, "unseen"));
    free(script);
    linear.y.logarithmic = false;
    script = script_of(&linear);
    assert_non_null(strstr(script, "$data0 << EOD\n1 0.5\n20.5 0\n300 0.125\nEOD\n"));
    assert_non_null(strstr(script, "unseen"));
    free(script);
}

static void script__logarithmic_axis_of_few_decades__more_marks(void **state)
{
    (void)state;
    const double near[] = {30, 40}, far[] = {30, 40000};
    report_series series = {.name = "s", .x = near, .y = far, .count = 2, .line = REPORT_LINE_ALONE};
    const report_plot plot = {.title = "t", .x = {"x", true}, .y = {"y", true}, .series = &series, .series_count = 1};
    char *script = script_of(&plot);
    assert_non_null(strstr(script, "set xtics (1e0,2e0,5e0,1e1,2e1,5e1,1e2,2e2,5e2,1e3,2e3,5e3)\n"));
    assert_null(strstr(script, "set ytics"));
    assert_non_null(strstr(script, " with lines linetype 1 "));
    free(script);
}

static void script__comma_locale__points(void **state)
{
    (void)state;
    char *script = script_of(&example);
    if (setlocale(LC_NUMERIC, "de_DE.UTF-8")) {
        char *again = script_of(&example);
        assert_string_equal(script, again);
        free(again);
    } else {
        print_message("# skipped: the locale de_DE.UTF-8 is not there\n");
    }
    setlocale(LC_NUMERIC, "C");
    free(script);
}

static void assert_is_picture(const char *path)
{
    static const unsigned char head[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n', 0, 0, 0, 13, 'I', 'H', 'D', 'R', 0, 0, 3, 0xc0, 0, 0, 2, 0x80};
    size_t size = 0;
    char *bytes = files_read(path, &size);
    assert_non_null(bytes);
    assert_true(size > 3000);
    assert_memory_equal(bytes, head, sizeof head);
    free(bytes);
}

/* False, with a remark, where there is no gnuplot. */
static bool drawn(const char *path, const report_plot *plot)
{
    base_error err = {0};
    base_status status = report_plot_write(path, plot, &err);
    if (status == BASE_ERR_UNSUPPORTED) {
        print_message("# skipped: %s\n", err.why);
        return false;
    }
    assert_int_equal(status, BASE_OK);
    assert_is_picture(path);
    return true;
}

static void picture__example_and_its_edges__drawn(void **state)
{
    (void)state;
    char *directory = files_make_directory(), *path = files_path(directory, "a.png"), *other = files_path(directory, "b.png");
    const double nothing[] = {(double)NAN, (double)INFINITY, -1};
    const report_series unseen = {.name = "unseen", .x = nothing, .y = nothing, .count = 3}, one = {.name = "one", .x = speeds, .y = speeds, .count = 1};
    report_plot plot = example;
    if (drawn(path, &example)) {
        size_t size = 0, other_size = 0;
        char *bytes = files_read(path, &size), *others;
        plot.title = "another";
        assert_true(drawn(other, &plot));
        others = files_read(other, &other_size);
        assert_false(size == other_size && memcmp(bytes, others, size) == 0);
        free(bytes);
        free(others);
        plot.series_count = 0;
        assert_true(drawn(path, &plot));
        plot.series_count = 1;
        plot.series = &unseen;
        assert_true(drawn(path, &plot));
        plot.series = &one;
        assert_true(drawn(path, &plot));
        assert_int_equal(files_count(directory), 2);
    }
    files_remove_directory(directory);
    free(path);
    free(other);
}

/* Put a gnuplot of one shell command, NULL for none, first in the search path and draw with it; an old file must stay as it was. */
static base_status draw_with(const char *command, base_error *err)
{
    char *directory = files_make_directory(), *program = files_path(directory, "gnuplot"), *path = files_path(directory, "a.png");
    char *before = strdup(getenv("PATH") ? getenv("PATH") : ""), text[200], *kept;
    files_write(path, "old");
    if (command) {
        snprintf(text, sizeof text, "#!/bin/sh\n%s\n", command);
        files_write(program, text);
        assert_int_equal(chmod(program, 0755), 0);
    }
    setenv("PATH", directory, 1);
    base_status status = report_plot_write(path, &example, err);
    setenv("PATH", before, 1);
    kept = files_read(path, NULL);
    assert_string_equal(kept, "old");
    assert_int_equal(files_count(directory), command ? 2 : 1);
    files_remove_directory(directory);
    free(kept);
    free(program);
    free(path);
    free(before);
    return status;
}

static void gnuplot__missing_or_failing__said_and_the_old_file_kept(void **state)
{
    (void)state;
    base_error err = {0};
    assert_int_equal(draw_with(NULL, &err), BASE_ERR_UNSUPPORTED);
    assert_non_null(strstr(err.why, "gnuplot-nox"));
    assert_int_equal(draw_with("echo >&2; echo '   ^' >&2; echo 'line 3: no such colour' >&2; exit 1", &err), BASE_ERR_IO);
    assert_string_equal(err.why, "gnuplot failed: line 3: no such colour");
    assert_int_equal(draw_with("exit 0", &err), BASE_ERR_IO);
    assert_non_null(strstr(err.why, "not whole"));
    assert_int_equal(draw_with("echo 'no picture at all'", &err), BASE_ERR_IO);
    assert_non_null(strstr(err.why, "not whole"));
}

static void picture__no_such_folder__named(void **state)
{
    (void)state;
    base_error err = {0};
    base_status status = report_plot_write("/no/such/folder/a.png", &example, &err);
    if (status != BASE_ERR_UNSUPPORTED) {
        assert_int_equal(status, BASE_ERR_INPUT);
        assert_string_equal(err.what, "/no/such/folder/a.png");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(script__texts_and_axes__taken_literally),
        cmocka_unit_test(script__zero_on_a_logarithmic_axis__left_out),
        cmocka_unit_test(script__logarithmic_axis_of_few_decades__more_marks),
        cmocka_unit_test(script__comma_locale__points),
        cmocka_unit_test(picture__example_and_its_edges__drawn),
        cmocka_unit_test(gnuplot__missing_or_failing__said_and_the_old_file_kept),
        cmocka_unit_test(picture__no_such_folder__named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
