#include "reports/views/mlrta_speeds.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "reports/paper.h"

static const char file[] = "mlrta_table1";
static const char null_shader[] = "framerate_null_shader", simple_shader[] = "framerate_simple_shader";

static void begin(report_table *t, const char *scene, const char *system, const char *basis)
{
    report_table_begin_row(t);
    report_table_add_text(t, scene);
    report_table_add_text(t, system);
    report_table_add_text(t, basis);
}

static void add_measured(report_table *t, const mlrta_speed *row)
{
    const double rays = row->pixels * row->clock_hz / row->cycles;
    begin(t, row->scene, row->kernel, "measured");
    report_table_add_real(t, rays / mlrta_paper_pixels);
    report_table_add_real(t, row->pixels * row->clock_hz / row->shaded / mlrta_paper_pixels);
    report_table_add_real(t, rays / 1e6);
    report_table_add_real(t, row->cycles / row->pixels);
    report_table_add_real(t, (row->shaded - row->cycles) / row->pixels);
    report_table_add_real(t, 100 * row->entry);
    report_table_add_real(t, 100 * row->memory);
    report_table_add_real(t, row->half_width > 0 ? 100 * row->half_width : (double)NAN);
}

/* The rows that the paper has of a scene, in its order. */
static void add_published(report_table *t, const char *scene)
{
    size_t count;
    const report_paper_value *v = report_paper_list(&count);
    for (size_t i = 0; i < count; i++) {
        if (strcmp(v[i].table, file) != 0 || strcmp(v[i].scene, scene) != 0 || strcmp(v[i].metric, null_shader) != 0)
            continue;
        begin(t, scene, v[i].algorithm, "published");
        report_table_add_real(t, v[i].value);
        report_table_add_real(t, report_paper_find(file, scene, v[i].algorithm, simple_shader));
        report_table_add_real(t, v[i].value * mlrta_paper_pixels / 1e6);
    }
}

static bool stands_in(const mlrta_speed *rows, size_t count, size_t scene)
{
    for (size_t i = 0; i < count; i++)
        if (mlrta_scene_of(rows[i].scene) == scene)
            return true;
    return false;
}

static void add_notes(report_table *t)
{
    report_table_add_note(t, "Frames of 1024x1024 pixels: where another size was measured, its cycles a pixel stand for theirs. One "
                             "core at the machine's clock; the tree is there. Null shader: the kernels find the nearest hit of "
                             "each primary ray. Simple shader (shader=simple): they shade it by Lambert's law as well, with a "
                             "light at the eye and the triangle's own normal; the paper does not say what its simple shader is.");
    report_table_add_note(t, "The published rates are of processors of 2005 with 4-wide vectors, and of code that also merged "
                             "axis-aligned triangles into quads, which no kernel here does. The paper has no frame rate of its "
                             "Asian Dragon.");
    report_table_add_note(t, "Entry points: cycles of the searches. Memory: cycles in which no thread issued, and the next one to "
                             "issue waited for a line from beyond the first level of cache.");
}

report_table *mlrta_speeds_table(const mlrta_speed *rows, size_t count, const char *caption)
{
    report_table *t = report_table_create("MLRTA Table 1: frames a second, measured, and published by Reshetov, Soupikov and Hurley 2005");
    report_table_set_caption(t, caption);
    report_table_add_column(t, &(report_column){.name = "scene"});
    report_table_add_column(t, &(report_column){.name = "system"});
    report_table_add_column(t, &(report_column){.name = "basis"});
    report_table_add_real_column(t, "null shader", "frames/s", 2);
    report_table_add_real_column(t, "simple shader", "frames/s", 2);
    report_table_add_real_column(t, "null shader, rays", "million/s", 1);
    report_table_add_real_column(t, "cycles per pixel, null shader", NULL, 1);
    report_table_add_real_column(t, "simple shader takes more", "cycles per pixel", 1);
    report_table_add_real_column(t, "entry points", "% of cycles", 1);
    report_table_add_real_column(t, "memory", "% of cycles", 1);
    report_table_add_real_column(t, "95% interval", "+-%", 2);
    for (size_t i = 0; i < count; i++) {
        const size_t scene = mlrta_scene_of(rows[i].scene);
        if (!i || strcmp(rows[i - 1].scene, rows[i].scene) != 0)
            report_table_begin_group(t, NULL);
        add_measured(t, &rows[i]);
        if (scene < MLRTA_SCENES && (i + 1 == count || strcmp(rows[i + 1].scene, rows[i].scene) != 0))
            add_published(t, mlrta_scenes[scene].name);
    }
    for (size_t scene = 0; scene < MLRTA_SCENES; scene++)
        if (!stands_in(rows, count, scene)) {
            report_table_begin_group(t, NULL);
            add_published(t, mlrta_scenes[scene].name);
        }
    add_notes(t);
    return t;
}
