#include "reports/views/mlrta_tiles.h"

#include <stdio.h>

static void add_count(report_table *t, const char *name)
{
    report_table_add_column(t, &(report_column){.name = name, .kind = REPORT_INTEGER});
}

static void begin(report_table *t, const char *scene, const char *tiles, const mlrta_tile_counts *n)
{
    report_table_begin_row(t);
    report_table_add_text(t, scene);
    report_table_add_text(t, tiles);
    report_table_add_integer(t, (int64_t)n->searched);
    report_table_add_integer(t, (int64_t)n->divergent);
}

static void add_scene(report_table *t, const mlrta_tiles_row *row)
{
    mlrta_tile_counts all = {0};
    char name[16];
    for (int i = MLRTA_EDGES - 1; i >= 0; i--) {
        const mlrta_tile_counts *n = &row->by_edge[i];
        if (!n->searched && !n->divergent)
            continue;
        snprintf(name, sizeof name, "%ux%u", 4u << i, 4u << i);
        begin(t, row->scene, name, n);
        report_table_add_integer(t, (int64_t)n->traced);
        all.searched += n->searched;
        all.divergent += n->divergent;
        all.traced += n->traced;
    }
    begin(t, row->scene, "all, as drawn", &all);
    report_table_add_integer(t, (int64_t)all.traced);
    begin(t, row->scene, "all, as the kernel counted", &row->counted);
}

report_table *mlrta_tiles_table(const mlrta_tiles_row *rows, size_t count, const char *caption)
{
    report_table *t = report_table_create("Tiles by size");
    report_table_set_caption(t, caption);
    report_table_add_column(t, &(report_column){.name = "scene"});
    report_table_add_column(t, &(report_column){.name = "tiles"});
    add_count(t, "searched");
    add_count(t, "divergent");
    add_count(t, "traced from there");
    for (size_t i = 0; i < count; i++) {
        report_table_begin_group(t, NULL);
        add_scene(t, &rows[i]);
    }
    report_table_add_note(t, "The corner rays of a divergent tile differ in sign on some axis: it has no entry point and is split, down to "
                             "4x4. Which tiles those are follows from their rays; whether an initial tile was split otherwise, from the "
                             "kernel's counters of that tile. The last two rows of a scene are equal if the picture is right.");
    return t;
}
