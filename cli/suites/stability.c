/* Suite stability: kernels on the hard cases of float arithmetic, judged ray by ray in exact arithmetic (docs/accuracy.md). */
#include <stdio.h>
#include <stdlib.h>

#include "cli/suite.h"
#include "cli/suites/stability_curves.h"
#include "cli/suites/stability_hard.h"
#include "cli/suites/stability_scene.h"

typedef struct scenes {
    const stability_kernels *kernels;
    report_table *table;
} scenes;

/* Tallies by worker and kernel. */
typedef struct scene_count {
    size_t kernels;
    stability_tally *tallies;
} scene_count;

static void count_scene_ray(void *user, size_t kernel, size_t pixel, unsigned thread, const trial_ray *ray, const trial_finding *finding)
{
    const scene_count *c = user;
    (void)pixel;
    stability_tally_ray(&c->tallies[thread * c->kernels + kernel], ray, finding, 0);
}

static base_status try_whole_scene(suite *s, const suite_scene *on, void *user, base_error *err)
{
    const scenes *all = user;
    const size_t kernels = all->kernels->count;
    scene_count c = {kernels, calloc(s->jobs * kernels, sizeof *c.tallies)};
    if (!c.tallies)
        return base_fail(err, BASE_ERR_NOMEM, "stability", "out of memory");
    for (size_t i = 0; i < s->jobs * kernels; i++)
        c.tallies[i] = stability_tally_none();
    const stability_input input = {on->scene, on->scene->cameras, s->options->machine, all->kernels, s->width, s->height, false, s->jobs};
    base_status status = stability_try(&input, count_scene_ray, NULL, &c, err);
    report_table_begin_group(all->table, on->name);
    for (size_t k = 0; status == BASE_OK && k < kernels; k++) {
        for (unsigned i = 1; i < s->jobs; i++)
            stability_tally_add(&c.tallies[k], &c.tallies[i * kernels + k]);
        report_table_begin_row(all->table);
        report_table_add_text(all->table, all->kernels->list[k]->name);
        stability_add_tally(all->table, &c.tallies[k]);
    }
    free(c.tallies);
    return status;
}

static base_status try_whole_scenes(suite *s, const stability_kernels *kernels, report_table **table, base_error *err)
{
    static const report_column first[] = {{.name = "kernel"}};
    char caption[160];
    scenes all = {kernels, report_table_create("Whole scenes")};
    *table = all.table;
    snprintf(caption, sizeof caption, "%ux%u rays of each scene's camera, every triangle tried for every ray.", s->width, s->height);
    report_table_set_caption(all.table, caption);
    stability_add_columns(all.table, first, 1);
    return suite_each_scene(s, try_whole_scene, &all, err);
}

static base_status measure(suite *s, base_error *err)
{
    stability_kernels kernels = {0}, variants = {0};
    report_table *whole = NULL;
    stability_kernels_choose(&s->options->kernels, false, &kernels);
    stability_kernels_choose(&s->options->kernels, true, &variants);
    report_page_add_heading(s->page, 1, "Tables");
    base_status status = try_whole_scenes(s, &kernels, &whole, err);
    if (status == BASE_OK)
        status = stability_add_hard_cases(s, &variants, STABILITY_FRAMES, err);
    if (status == BASE_OK) {
        status = suite_add_table(s, "-scenes", whole, err);
        whole = NULL;
    }
    if (status == BASE_OK)
        status = stability_add_curves(s, &kernels, err);
    report_table_destroy(&whole);
    return status;
}

const suite_info suite_stability = {
    .name = "stability",
    .summary = "hits lost and wrong, and errors of distances, on numerically hard cases, judged in exact arithmetic",
    .title = "numerical stability",
    .about = "Every ray is also traced in rational arithmetic over all triangles, with the very floats that the kernels get. A hit is lost if a "
             "triangle is hit off its edges and the kernel found nothing, or only something behind it; wrong if the ray misses what it found. Off "
             "its edges: by more than 4 units of 2^-23 as an angle. docs/accuracy.md has the definitions.",
    .size = 32,
    .takes = SUITE_TAKES_KERNELS,
    .measure = measure,
};
