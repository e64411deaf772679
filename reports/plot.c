#include "reports/plot.h"

#include <errno.h>
#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "lrbni/base/output_file.h"
#include "reports/text.h"

enum { NO_GNUPLOT = 127, WORDS_BYTES = 400, COPY_BYTES = 65536, TAIL_BYTES = 8 };

/* Okabe and Ito's colours, distinct without colour vision; their yellow, hard to see on white, comes last. */
static const char head[] = "set terminal pngcairo size 960,640 noenhanced font 'sans,11' linewidth 1.5\n"
                           "set encoding utf8\n"
                           "set linetype 1 linecolor rgb '#0072b2' pointtype 7\n"
                           "set linetype 2 linecolor rgb '#d55e00' pointtype 5\n"
                           "set linetype 3 linecolor rgb '#009e73' pointtype 9\n"
                           "set linetype 4 linecolor rgb '#cc79a7' pointtype 11\n"
                           "set linetype 5 linecolor rgb '#000000' pointtype 13\n"
                           "set linetype 6 linecolor rgb '#56b4e9' pointtype 6\n"
                           "set linetype 7 linecolor rgb '#e69f00' pointtype 4\n"
                           "set linetype 8 linecolor rgb '#b8a800' pointtype 8\n"
                           "set linetype cycle 8\n"
                           "set grid linecolor rgb '#cccccc' linewidth 1\n"
                           "set key below left Left reverse height 0.6\n"
                           "set autoscale fix\n"
                           "set offsets graph 0.04, graph 0.08, graph 0.05, graph 0.03\n";

/* A string of gnuplot's: nothing but a quote is special between single quotes. False if there is no memory. */
static bool put_string(FILE *out, const char *text)
{
    char *clean = report_text_clean(text);
    if (!clean)
        return false;
    fputc('\'', out);
    for (const char *c = clean; *c; c++)
        fputs(*c == '\'' ? "''" : (const char[]){*c, '\0'}, out);
    fputc('\'', out);
    free(clean);
    return true;
}

static bool put_axis(FILE *out, char name, const report_axis *axis)
{
    fprintf(out, "set %clabel ", name);
    const bool whole = put_string(out, axis->label);
    fprintf(out, "\nset format %c '%%g'\n", name);
    if (axis->logarithmic)
        fprintf(out, "set logscale %c 10\n", name);
    return whole;
}

static bool is_visible(const report_axis *axis, double value) { return isfinite(value) && (!axis->logarithmic || value > 0); }

static bool has_point(const report_plot *plot, const report_series *s, size_t i)
{
    return is_visible(&plot->x, s->x[i]) && is_visible(&plot->y, s->y[i]);
}

static bool has_points(const report_plot *plot, const report_series *s)
{
    for (size_t i = 0; i < s->count; i++)
        if (has_point(plot, s, i))
            return true;
    return false;
}

/* The points as a data block, an empty line where one is left out; the texts beside them as labels. */
static bool put_data(const report_plot *plot, size_t number, FILE *out)
{
    const report_series *s = &plot->series[number];
    bool whole = true;
    fprintf(out, "$data%zu << EOD\n", number);
    for (size_t i = 0; i < s->count; i++)
        if (has_point(plot, s, i))
            fprintf(out, "%.17g %.17g\n", s->x[i], s->y[i]);
        else
            fputc('\n', out);
    fputs("EOD\n", out);
    for (size_t i = 0; s->labels && i < s->count; i++)
        if (s->labels[i] && has_point(plot, s, i)) {
            fputs("set label ", out);
            whole = put_string(out, s->labels[i]) && whole;
            fprintf(out, " at %.17g,%.17g left offset character 0.8,0.4 font ',9'\n", s->x[i], s->y[i]);
        }
    return whole;
}

static bool put_series(const report_plot *plot, FILE *out)
{
    bool whole = true, first = true;
    for (size_t i = 0; i < plot->series_count; i++) {
        const report_series *s = &plot->series[i];
        if (!has_points(plot, s))
            continue;
        fprintf(out, "%s$data%zu using 1:2 with %s linetype %zu title ", first ? "plot " : ", ", i, s->line ? "linespoints" : "points", i + 1);
        whole = put_string(out, s->name) && whole;
        first = false;
    }
    /* gnuplot refuses a plot without a point. */
    fputs(first ? "set xrange [1:10]\nset yrange [1:10]\nplot NaN notitle\n" : "\n", out);
    return whole;
}

base_status report_plot_write_script(const report_plot *plot, FILE *out, base_error *err)
{
    locale_t c = newlocale(LC_NUMERIC_MASK, "C", (locale_t)0);
    if (!c)
        return base_fail(err, BASE_ERR_NOMEM, "plot", "out of memory");
    locale_t callers = uselocale(c);
    fprintf(out, "%sset title ", head);
    bool whole = put_string(out, plot->title);
    fputc('\n', out);
    whole = put_axis(out, 'x', &plot->x) && put_axis(out, 'y', &plot->y) && whole;
    for (size_t i = 0; i < plot->series_count; i++)
        whole = put_data(plot, i, out) && whole;
    whole = put_series(plot, out) && whole;
    uselocale(callers);
    freelocale(c);
    return whole ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, "plot", "out of memory");
}

/* The three streams of a run of gnuplot. All are unnamed files: a pipe's reader may die, and its writer of it. */
typedef struct gnuplot_run {
    FILE *script, *picture, *words;
} gnuplot_run;

/* The first line of what gnuplot said that is neither empty nor only marks the place of a fault. */
static void first_words(FILE *from, char words[WORDS_BYTES])
{
    rewind(from);
    while (fgets(words, WORDS_BYTES, from)) {
        char *start = words + strspn(words, " \t^");
        start[strcspn(start, "\n")] = '\0';
        if (*start && strncmp(start, "gnuplot>", 8) != 0) {
            memmove(words, start, strlen(start) + 1);
            return;
        }
    }
    strcpy(words, "it does not say why");
}

static base_status run_gnuplot(const char *path, const gnuplot_run *run, base_error *err)
{
    int ended;
    pid_t child = fork();
    if (child == 0) {
        if (dup2(fileno(run->script), 0) >= 0 && dup2(fileno(run->picture), 1) >= 0 && dup2(fileno(run->words), 2) >= 0)
            execlp("gnuplot", "gnuplot", "-d", "-", (char *)NULL);
        _exit(NO_GNUPLOT);
    }
    if (child < 0)
        return base_fail(err, BASE_ERR_IO, path, "gnuplot cannot be started: %s", strerror(errno));
    while (waitpid(child, &ended, 0) < 0)
        if (errno != EINTR)
            return base_fail(err, BASE_ERR_IO, path, "gnuplot cannot be waited for: %s", strerror(errno));
    if (WIFEXITED(ended) && WEXITSTATUS(ended) == NO_GNUPLOT)
        return base_fail(err, BASE_ERR_UNSUPPORTED, path, "there is no gnuplot (Debian package gnuplot-nox)");
    if (!WIFEXITED(ended) || WEXITSTATUS(ended) != 0) {
        char words[WORDS_BYTES];
        first_words(run->words, words);
        return base_fail(err, BASE_ERR_IO, path, "gnuplot failed: %s", words);
    }
    return BASE_OK;
}

/* Bring the picture to its file, if it is whole: gnuplot does not notice a full disk. */
static base_status save(const char *path, FILE *picture, base_error *err)
{
    static const unsigned char tail[TAIL_BYTES] = {'I', 'E', 'N', 'D', 0xae, 0x42, 0x60, 0x82};
    unsigned char bytes[COPY_BYTES];
    base_output out;
    size_t count;
    if (fseek(picture, -TAIL_BYTES, SEEK_END) != 0 || fread(bytes, 1, TAIL_BYTES, picture) != TAIL_BYTES || memcmp(bytes, tail, TAIL_BYTES) != 0)
        return base_fail(err, BASE_ERR_IO, path, "gnuplot's picture is not whole (is the disk full?)");
    base_status status = base_output_begin(path, false, &out, err);
    if (status != BASE_OK)
        return status;
    rewind(picture);
    while ((count = fread(bytes, 1, sizeof bytes, picture)) > 0)
        fwrite(bytes, 1, count, out.stream);
    return base_output_commit(&out, err);
}

base_status report_plot_write(const char *path, const report_plot *plot, base_error *err)
{
    gnuplot_run run = {tmpfile(), tmpfile(), tmpfile()};
    base_status status = BASE_OK;
    if (!run.script || !run.picture || !run.words)
        status = base_fail(err, BASE_ERR_IO, path, "no file for gnuplot's work: %s", strerror(errno));
    if (status == BASE_OK)
        status = report_plot_write_script(plot, run.script, err);
    if (status == BASE_OK && fflush(run.script) != 0)
        status = base_fail(err, BASE_ERR_IO, path, "gnuplot's commands cannot be written: %s", strerror(errno));
    if (status == BASE_OK) {
        rewind(run.script);
        status = run_gnuplot(path, &run, err);
    }
    if (status == BASE_OK)
        status = save(path, run.picture, err);
    FILE *files[] = {run.script, run.picture, run.words};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        if (files[i])
            fclose(files[i]);
    return status;
}
