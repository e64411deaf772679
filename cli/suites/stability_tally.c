#include "cli/suites/stability_tally.h"

#include <math.h>

stability_tally stability_tally_none(void) { return (stability_tally){.first_bad = UINT64_MAX}; }

static void add_one(stability_tally *tally, const trial_ray *ray, bool hit, const trial_finding *finding, uint64_t number)
{
    stability_tally one = {.tries = 1, .hits = hit, .at_edge = trial_ray_at_edge(ray), .leaks = finding->leak,
                           .t_ulp = finding->t_ulp, .plane_ulp = finding->plane_ulp, .point_ulp = finding->point_ulp, .first_bad = UINT64_MAX};
    one.verdicts[finding->verdict] = 1;
    if (finding->verdict == TRIAL_LOST || finding->verdict == TRIAL_WRONG)
        one.first_bad = number;
    stability_tally_add(tally, &one);
}

void stability_tally_ray(stability_tally *tally, const trial_ray *ray, const trial_finding *finding, uint64_t number)
{
    add_one(tally, ray, trial_ray_nearest(ray) != TRIAL_NO_HIT, finding, number);
}

void stability_tally_shadow(stability_tally *tally, const trial_ray *ray, trial_span span, const trial_finding *finding, uint64_t number)
{
    add_one(tally, ray, trial_ray_blocked(ray, span), finding, number);
}

void stability_tally_add(stability_tally *tally, const stability_tally *other)
{
    tally->tries += other->tries;
    tally->hits += other->hits;
    tally->at_edge += other->at_edge;
    tally->leaks += other->leaks;
    for (int i = 0; i < TRIAL_VERDICTS; i++)
        tally->verdicts[i] += other->verdicts[i];
    tally->t_ulp = fmax(tally->t_ulp, other->t_ulp);
    tally->plane_ulp = fmax(tally->plane_ulp, other->plane_ulp);
    tally->point_ulp = fmax(tally->point_ulp, other->point_ulp);
    if (other->first_bad < tally->first_bad)
        tally->first_bad = other->first_bad;
}

trial_answer stability_answer(const run_result *run, unsigned x, unsigned y)
{
    const job_pixel p = kernel_job_pixel(run->job, x, y);
    const job_frame_tile *tile = &run->job->frame_host[p.tile];
    return (trial_answer){.id = tile->id[p.block][p.pixel], .t = tile->t[p.block][p.pixel], .u = tile->u[p.block][p.pixel],
                          .v = tile->v[p.block][p.pixel]};
}

static void add_columns(report_table *t, const report_column *columns, size_t count)
{
    for (size_t i = 0; i < count; i++)
        report_table_add_column(t, &columns[i]);
}

void stability_add_columns(report_table *t, const report_column *first, size_t count)
{
    static const report_column columns[] = {
        {.name = "tries", .unit = "rays", .kind = REPORT_INTEGER},
        {.name = "hits", .unit = "rays", .kind = REPORT_INTEGER},
        {.name = "lost", .unit = "rays", .kind = REPORT_INTEGER},
        {.name = "wrong", .unit = "rays", .kind = REPORT_INTEGER},
        {.name = "ties", .unit = "rays", .kind = REPORT_INTEGER},
        {.name = "at an edge", .unit = "rays", .kind = REPORT_INTEGER},
        {.name = "decided otherwise", .unit = "rays", .kind = REPORT_INTEGER},
        {.name = "leaks", .unit = "rays", .kind = REPORT_INTEGER},
        {.name = "worst t", .unit = "ulp", .kind = REPORT_REAL, .decimals = 1},
        {.name = "worst plane", .unit = "2^-24", .kind = REPORT_REAL, .decimals = 2},
        {.name = "worst point", .unit = "2^-24", .kind = REPORT_REAL, .decimals = 2},
    };
    add_columns(t, first, count);
    add_columns(t, columns, sizeof columns / sizeof *columns);
}

void stability_add_tally(report_table *t, const stability_tally *tally)
{
    const uint64_t integers[] = {tally->tries, tally->hits, tally->verdicts[TRIAL_LOST], tally->verdicts[TRIAL_WRONG], tally->verdicts[TRIAL_TIE],
                                 tally->at_edge, tally->verdicts[TRIAL_EDGE], tally->leaks};
    for (size_t i = 0; i < sizeof integers / sizeof *integers; i++)
        report_table_add_integer(t, (int64_t)integers[i]);
    report_table_add_real(t, tally->t_ulp);
    report_table_add_real(t, tally->plane_ulp);
    report_table_add_real(t, tally->point_ulp);
}

void stability_add_shadow_columns(report_table *t, const report_column *first, size_t count)
{
    static const report_column columns[] = {
        {.name = "tries", .unit = "rays", .kind = REPORT_INTEGER},
        {.name = "blocked", .unit = "rays", .kind = REPORT_INTEGER},
        {.name = "lost", .unit = "rays", .kind = REPORT_INTEGER},
        {.name = "wrong", .unit = "rays", .kind = REPORT_INTEGER},
        {.name = "at an edge", .unit = "rays", .kind = REPORT_INTEGER},
        {.name = "decided otherwise", .unit = "rays", .kind = REPORT_INTEGER},
        {.name = "leaks", .unit = "rays", .kind = REPORT_INTEGER},
    };
    add_columns(t, first, count);
    add_columns(t, columns, sizeof columns / sizeof *columns);
}

void stability_add_shadow_tally(report_table *t, const stability_tally *tally)
{
    const uint64_t integers[] = {tally->tries, tally->hits, tally->verdicts[TRIAL_LOST], tally->verdicts[TRIAL_WRONG], tally->at_edge,
                                 tally->verdicts[TRIAL_EDGE], tally->leaks};
    for (size_t i = 0; i < sizeof integers / sizeof *integers; i++)
        report_table_add_integer(t, (int64_t)integers[i]);
}
