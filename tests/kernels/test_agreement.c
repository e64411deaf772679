/* The tracing kernels on the built-in scenes and on files: packets, small and large, and frusta agree bit for bit (oracle O3), and hits are
 * those of Embree, with exact arithmetic as the judge (O1, O2).
 *
 * usage: test_agreement SIZE OF-OTHER-VIEWS [SCENE...]: pictures are SIZE x SIZE from the scene's own camera and smaller
 * from the others; scenes are names of built-in ones and of files in $LANETRACE_SCENES; if none is named, the usual built-in
 * ones and all files.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/builtin.h"
#include "tests/kernels/trace.h"
#include "tests/kernels/views.h"
#include "tests/oracles/embree_oracle.h"
#include "exact/predicates.h"
#include "tests/oracles/hit_judge.h"

enum { JOBS = 2, MOST_SCENES = 64, SAMPLE = 499 };

typedef struct subject {
    char spec[4096]; /* what scene_open takes; empty: not there */
    char name[256];  /* of the test case */
    int named_only;  /* run only if its name is given */
    unsigned size, other_size;
} subject;

/* A scene made ready: trees of both kernels, and Embree with and without culling. */
typedef struct stage {
    scene *s;
    bvh *deep, *shallow;
    embree_oracle *embree[2];
    views views;
} stage;

static stage stage_create(const char *spec)
{
    stage st = {0};
    base_error err = {0};
    if (scene_open(spec, &st.s, &err) != BASE_OK)
        fail_msg("%s: %s", err.what, err.why);
    st.deep = trace_tree(st.s, kernel_find("packet16-primary")->defaults.max_leaf);
    st.shallow = trace_tree(st.s, kernel_find("mft-primary")->defaults.max_leaf);
    for (int cull = 0; cull < 2; cull++)
        if (embree_oracle_create(st.s->triangles, st.s->triangle_count, cull, JOBS, &st.embree[cull], &err) != BASE_OK)
            fail_msg("%s: %s", err.what, err.why);
    st.views = views_of(st.s, st.s->triangle_count);
    return st;
}

static void stage_destroy(stage *st)
{
    embree_oracle_destroy(&st->embree[0]);
    embree_oracle_destroy(&st->embree[1]);
    bvh_destroy(&st->deep);
    bvh_destroy(&st->shallow);
    scene_destroy(&st->s);
}

/* The bound on u and v: an edge's volume is off by some units of |edge| |direction|, seen against the triangle's volume. */
static double weight_tolerance(const oracle_ray *ray, const scene_triangle *t)
{
    double a[3][3], e = 0, volume = 0, d = 0, size = 0;
    for (int v = 0; v < 3; v++)
        for (int k = 0; k < 3; k++) {
            a[v][k] = (double)t->v[v][k] - (double)ray->org[k];
            size = fmax(size, fabs((double)t->v[v][k]) + fabs((double)ray->org[k]));
            d = fmax(d, fabs((double)ray->dir[k]));
        }
    for (int v = 0; v < 3; v++) {
        const double *p = a[v], *q = a[(v + 1) % 3];
        double sum = 0, reach = 0;
        for (int k = 0; k < 3; k++) {
            int i = (k + 1) % 3, j = (k + 2) % 3;
            double component = p[i] * q[j] - p[j] * q[i];
            sum += fabs(component);
            volume += component * (double)ray->dir[k];
            reach += fabs(p[k]) + fabs(q[k]);
        }
        e = fmax(e, sum + reach * size); /* vertices move by rounding when they are brought to the origin */
    }
    return 1e-6 + 64 * 0x1p-24 * e * d / fabs(volume);
}

/* t, u and v of a sample of the hits against the exact ones. */
static void check_sample(const stage *st, const trace_picture *p, const oracle_ray *rays, const char *what)
{
    exact_hit exact;
    exact_hit_init(&exact);
    for (size_t i = SAMPLE / 2; i < p->pixels; i += SAMPLE) {
        if (p->id[i] == JOB_NO_HIT)
            continue;
        const scene_triangle *t = &st->s->triangles[p->id[i]];
        exact_ray_triangle(rays[i].org, rays[i].dir, t->v[0], t->v[1], t->v[2], &exact);
        double tolerance = weight_tolerance(&rays[i], t);
        if (exact.facing == 0 || tolerance > 0.25)
            continue; /* edge-on, or so nearly that no digit is left */
        if (!(fabs(exact.t_double - (double)p->t[i]) <= tolerance * exact.t_double &&
              fabs(exact.u - (double)p->u[i]) <= tolerance && fabs(exact.v - (double)p->v[i]) <= tolerance))
            fail_msg("%s, ray %zu, triangle %u: t %.9g u %.9g v %.9g, exactly %.9g %.9g %.9g (tolerance %g)", what, i, p->id[i],
                     (double)p->t[i], (double)p->u[i], (double)p->v[i], exact.t_double, exact.u, exact.v, tolerance);
    }
    exact_hit_clear(&exact);
}

static void judge_picture(const stage *st, const trace_picture *p, const oracle_ray *rays, unsigned cull, judge_summary *total,
                          const char *what)
{
    judge_options options = judge_options_default();
    base_error err = {0};
    oracle_hit *ours = calloc(p->pixels, sizeof *ours), *theirs = calloc(p->pixels, sizeof *theirs);
    assert_true(ours && theirs);
    options.cull_backface = (int)cull;
    for (size_t i = 0; i < p->pixels; i++)
        ours[i] = trace_hit(p, i);
    if (embree_oracle_closest(st->embree[cull], rays, p->pixels, theirs, &err) != BASE_OK)
        fail_msg("%s: %s", err.what, err.why);
    judge_summary s =
        hit_judge_rays(&options, st->s->triangles, st->s->triangle_count, rays, ours, theirs, p->pixels, JOBS, NULL);
    for (int v = 0; v < JUDGE_VERDICTS; v++)
        total->count[v] += s.count[v];
    if (s.count[JUDGE_OURS_WRONG])
        fail_msg("%s: %llu rays wrong, first (%zu,%zu): ours %u at %.9g, Embree's %u at %.9g", what,
                 (unsigned long long)s.count[JUDGE_OURS_WRONG], s.first_wrong % p->width, s.first_wrong / p->width,
                 ours[s.first_wrong].id, ours[s.first_wrong].t, theirs[s.first_wrong].id, theirs[s.first_wrong].t);
    free(ours);
    free(theirs);
}

static void check_view(const stage *st, const scene_camera *camera, unsigned size, unsigned cull, judge_summary *total)
{
    char what[256];
    trace_request request = {.kernel = "packet16-primary", .tree = st->deep, .camera = camera, .width = size, .height = size,
                             .cull = cull, .level = LRB_NATIVE, .jobs = JOBS};
    trace_picture packets = trace_run(&request);
    request.kernel = "mft-primary";
    request.tree = st->shallow;
    trace_picture frusta = trace_run(&request);
    request.kernel = "packet256-primary";
    trace_picture groups = trace_run(&request);
    snprintf(what, sizeof what, "%.60s, %s, cull_backface %u", st->s->name, camera->name, cull);
    trace_assert_equal(&packets, &frusta, what);
    trace_assert_equal(&packets, &groups, what);
    oracle_ray *rays = calloc(packets.pixels, sizeof *rays);
    assert_non_null(rays);
    trace_rays(st->deep, camera, size, size, rays);
    check_sample(st, &packets, rays, what);
    judge_picture(st, &packets, rays, cull, total, what);
    free(rays);
    trace_free(&packets);
    trace_free(&frusta);
    trace_free(&groups);
}

static void pictures__packets_and_frusta__agree_and_are_right(void **state)
{
    const subject *sub = *state;
    judge_summary total = {0};
    if (!*sub->spec) {
        print_message("# skipped: %s is not there\n", sub->name);
        return;
    }
    stage st = stage_create(sub->spec);
    for (size_t i = 0; i < st.views.count; i++)
        for (unsigned cull = 0; cull < 2; cull++)
            check_view(&st, &st.views.camera[i], i == 0 ? sub->size : sub->other_size, cull, &total);
    print_message("# %s:", sub->name);
    for (int v = 0; v < JUDGE_VERDICTS; v++)
        print_message(" %llu %s%s", (unsigned long long)total.count[v], judge_verdict_name((judge_verdict)v),
                      v + 1 < JUDGE_VERDICTS ? "," : "\n");
    stage_destroy(&st);
}

/* ---- which scenes ---- */

static int by_name(const void *a, const void *b)
{
    return strcmp(((const subject *)a)->name, ((const subject *)b)->name);
}

static size_t add_files(subject *subjects, size_t count)
{
    const char *folder = getenv("LANETRACE_SCENES");
    DIR *d = folder ? opendir(folder) : NULL;
    size_t first = count;
    for (struct dirent *entry; d && (entry = readdir(d));) {
        size_t length = strlen(entry->d_name);
        if (count == MOST_SCENES || length < 4 || length > 200 || strcmp(entry->d_name + length - 4, ".glb") != 0)
            continue;
        snprintf(subjects[count].spec, sizeof subjects->spec, "%s/%s", folder, entry->d_name);
        snprintf(subjects[count].name, sizeof subjects->name, "%.*s", (int)length - 4, entry->d_name);
        count++;
    }
    if (d)
        closedir(d);
    else
        snprintf(subjects[count++].name, sizeof subjects->name, "the folder of scene files");
    qsort(subjects + first, count - first, sizeof *subjects, by_name);
    return count;
}

static size_t all_subjects(subject *subjects)
{
    size_t builtins, usuals, count = 0;
    const scene_builtin *list = scene_builtin_list(&builtins);
    const char *const *usual = scene_builtin_usual(&usuals);
    for (; count < builtins; count++) {
        snprintf(subjects[count].spec, sizeof subjects->spec, "builtin:%s", list[count].name);
        snprintf(subjects[count].name, sizeof subjects->name, "%s", list[count].name);
        subjects[count].named_only = 1;
        for (size_t i = 0; i < usuals; i++)
            subjects[count].named_only &= strcmp(usual[i], subjects[count].spec) != 0;
    }
    return add_files(subjects, count);
}

static int wanted(const subject *sub, int argc, char **argv)
{
    for (int i = 3; i < argc; i++)
        if (strcmp(argv[i], sub->name) == 0)
            return 1;
    return argc <= 3 && !sub->named_only;
}

int main(int argc, char **argv)
{
    static subject subjects[MOST_SCENES + 1];
    static char names[MOST_SCENES + 1][320];
    struct CMUnitTest tests[MOST_SCENES + 1];
    size_t count = all_subjects(subjects), chosen = 0;
    if (argc < 3)
        return 2;
    for (size_t i = 0; i < count; i++) {
        if (!wanted(&subjects[i], argc, argv))
            continue;
        subjects[i].size = (unsigned)atoi(argv[1]);
        subjects[i].other_size = (unsigned)atoi(argv[2]);
        snprintf(names[chosen], sizeof names[chosen], "%s__packets_and_frusta__agree_and_are_right", subjects[i].name);
        tests[chosen] = (struct CMUnitTest){
            .name = names[chosen], .test_func = pictures__packets_and_frusta__agree_and_are_right, .initial_state = &subjects[i]};
        chosen++;
    }
    return _cmocka_run_group_tests("agreement", tests, chosen, NULL, NULL);
}
