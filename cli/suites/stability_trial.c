#include "cli/suites/stability_trial.h"

#include <stdlib.h>

#include <string.h>

#include "kernels/job_shadow.h"
#include "lrbni/base/parallel.h"

typedef struct trial_worker {
    trial_ray *ray, *shadow;
    float found[3]; /* direction of the shadow ray that was found out about last: most kernels trace the same ones; 0: none */
    base_status status; /* of the first ray that failed */
    base_error err;
} trial_worker;

typedef struct trial_state {
    const stability_input *input;
    run_result *runs; /* by kernel */
    trial_view *view, *light_view;
    trial_worker *workers;
    stability_ray_fn *take;
    stability_shadow_fn *take_shadow;
    void *user;
} trial_state;

/* The shadow ray of a pixel, if kernel k traces one. */
static base_status judge_shadow(trial_state *t, unsigned worker, size_t k, unsigned x, unsigned y)
{
    trial_worker *w = &t->workers[worker];
    const kernel_job *job = t->runs[k].job;
    const job_light *light = &job->constants_host->light;
    const job_pixel p = kernel_job_pixel(job, x, y);
    const trial_span span = {light->nearest, light->farthest};
    job_shadow_ray ray;
    if (!t->take_shadow || !job->params.hard_shadows || !job_hard_shadow_ray_of(job, x, y, &ray))
        return BASE_OK;
    base_status status = BASE_OK;
    if (memcmp(w->found, ray.dir, sizeof w->found) != 0)
        status = trial_ray_find(w->shadow, t->light_view, ray.dir, &w->err);
    memcpy(w->found, ray.dir, sizeof w->found);
    const trial_finding finding = trial_ray_answer_blocked(w->shadow, span, job->shadows_host[p.tile].visibility[p.block][p.pixel] == 0.0f);
    if (status == BASE_OK)
        t->take_shadow(t->user, k, worker, w->shadow, span, &finding);
    return status;
}

static void judge_row(void *user, size_t y, unsigned worker)
{
    trial_state *t = user;
    trial_worker *w = &t->workers[worker];
    for (unsigned x = 0; x < t->input->width && w->status == BASE_OK; x++) {
        float direction[3];
        kernel_job_direction(t->runs[0].job, x, (unsigned)y, direction);
        w->status = trial_ray_find(w->ray, t->view, direction, &w->err);
        for (size_t k = 0; w->status == BASE_OK && k < t->input->kernels->count; k++) {
            const trial_answer answer = stability_answer(&t->runs[k], x, (unsigned)y);
            const trial_finding finding = trial_ray_answer(w->ray, &answer);
            t->take(t->user, k, y * t->input->width + x, worker, w->ray, &finding);
            w->status = judge_shadow(t, worker, k, x, (unsigned)y);
        }
    }
}

static base_status run_kernels(trial_state *t, base_error *err)
{
    const stability_input *in = t->input;
    base_status status = BASE_OK;
    for (size_t k = 0; status == BASE_OK && k < in->kernels->count; k++) {
        run_options options = {.kernel = in->kernels->list[k], .params = in->kernels->list[k]->defaults, .width = in->width, .height = in->height,
                               .model = RUN_NATIVE, .jobs = in->jobs};
        options.params.cull_backface = in->cull;
        status = run_kernel(in->scene, in->machine, &options, &t->runs[k], err);
    }
    return status;
}

static base_status judge(trial_state *t, base_error *err)
{
    const stability_input *in = t->input;
    base_status status = trial_view_create(in->scene->triangles, in->scene->triangle_count, t->runs[0].job->constants_host->origin_box, in->cull,
                                           &t->view, err);
    if (status == BASE_OK && t->take_shadow)
        status = trial_view_create(in->scene->triangles, in->scene->triangle_count, t->runs[0].job->constants_host->light.point, in->cull,
                                   &t->light_view, err);
    for (unsigned i = 0; status == BASE_OK && i < in->jobs; i++) {
        status = trial_ray_create(&t->workers[i].ray, err);
        if (status == BASE_OK)
            status = trial_ray_create(&t->workers[i].shadow, err);
    }
    if (status == BASE_OK)
        base_parallel_for(in->jobs, in->height, judge_row, t);
    for (unsigned i = 0; status == BASE_OK && i < in->jobs; i++)
        if (t->workers[i].status != BASE_OK)
            status = base_fail(err, t->workers[i].status, t->workers[i].err.what, "%s", t->workers[i].err.why);
    return status;
}

base_status stability_try(const stability_input *input, stability_ray_fn *take, stability_shadow_fn *shadow, void *user, base_error *err)
{
    trial_state t = {.input = input, .take = take, .take_shadow = shadow, .user = user};
    t.runs = calloc(input->kernels->count, sizeof *t.runs);
    t.workers = calloc(input->jobs, sizeof *t.workers);
    base_status status = t.runs && t.workers ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, "stability", "out of memory");
    if (status == BASE_OK)
        status = run_kernels(&t, err);
    if (status == BASE_OK)
        status = judge(&t, err);
    for (size_t k = 0; t.runs && k < input->kernels->count; k++)
        run_result_destroy(&t.runs[k]);
    for (unsigned i = 0; t.workers && i < input->jobs; i++) {
        trial_ray_destroy(&t.workers[i].ray);
        trial_ray_destroy(&t.workers[i].shadow);
    }
    trial_view_destroy(&t.view);
    trial_view_destroy(&t.light_view);
    free(t.runs);
    free(t.workers);
    return status;
}
