#include "reports/paper.h"

#include <math.h>
#include <string.h>

static double scale_of(const char *unit)
{
    return strcmp(unit, "thousand") == 0 ? 1e3 : strcmp(unit, "million") == 0 ? 1e6 : 1;
}

const report_paper_value *report_paper_entry(const char *table, const char *scene, const char *algorithm, const char *metric)
{
    size_t count;
    const report_paper_value *v = report_paper_list(&count);
    for (size_t i = 0; i < count; i++)
        if (strcmp(v[i].table, table) == 0 && strcmp(v[i].scene, scene) == 0 && strcmp(v[i].algorithm, algorithm) == 0 &&
            strcmp(v[i].metric, metric) == 0)
            return &v[i];
    return NULL;
}

double report_paper_find(const char *table, const char *scene, const char *algorithm, const char *metric)
{
    const report_paper_value *v = report_paper_entry(table, scene, algorithm, metric);
    return v ? v->value * scale_of(v->unit) : (double)NAN;
}

size_t report_paper_scene_of(const report_paper_scene *scenes, size_t count, const char *builtin)
{
    size_t i = 0;
    while (i < count && strcmp(scenes[i].builtin, builtin) != 0)
        i++;
    return i;
}
