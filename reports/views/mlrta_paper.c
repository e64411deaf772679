#include "reports/views/mlrta_paper.h"

#include <stdio.h>
#include <string.h>

const report_paper_scene mlrta_scenes[MLRTA_SCENES] = {
    {"Erw6 (804 tri)", "rooms-804"},
    {"Conference (274K tri)", "conference-282k"},
    {"Soda Hall (2195K tri)", "tower-2195k"},
    {"Asian Dragon (7M tri)", "dragon-7m"},
};
const double mlrta_paper_pixels = 1024.0 * 1024.0;

size_t mlrta_scene_of(const char *builtin) { return report_paper_scene_of(mlrta_scenes, MLRTA_SCENES, builtin); }

double mlrta_paper_count(unsigned table, size_t scene, mlrta_algorithm algorithm, const char *metric)
{
    char file[20];
    snprintf(file, sizeof file, "mlrta_table%u", table);
    return report_paper_find(file, mlrta_scenes[scene].name, algorithm == MLRTA_WITH ? "MLRT" : "no MLRT", metric);
}

double mlrta_paper_text(const char *scene, const char *algorithm, const char *metric)
{
    return report_paper_find("mlrta_text", scene, algorithm, metric);
}
