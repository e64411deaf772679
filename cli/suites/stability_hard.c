#include "cli/suites/stability_hard.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/progress.h"
#include "cli/suites/stability_cases.h"
#include "lrbni/base/parallel.h"

/* Tallies of one host thread: by kernel and case, and by kernel and place; shadows by kernel and case. */
typedef struct worker {
    stability_tally *cases, *places, *shadows;
    base_status status; /* of the first scene that failed */
    base_error err;
} worker;

typedef struct measured {
    suite *suite;
    const stability_kernels *kernels;
    unsigned frames; /* that each case is tried in at each place */
    size_t case_count;
    worker *workers;
    progress bar;
} measured;

/* A scene at trial, and where its rays are counted. */
typedef struct counted {
    const measured *m;
    worker *w;
    size_t which, place;
    uint64_t number;
} counted;

static void count_ray(void *user, size_t kernel, size_t pixel, unsigned thread, const trial_ray *ray, const trial_finding *finding)
{
    const counted *c = user;
    (void)pixel;
    (void)thread;
    stability_tally_ray(&c->w->cases[kernel * c->m->case_count + c->which], ray, finding, c->number);
    stability_tally_ray(&c->w->places[kernel * STABILITY_PLACES + c->place], ray, finding, c->number);
}

static void count_shadow(void *user, size_t kernel, unsigned thread, const trial_ray *ray, trial_span span, const trial_finding *finding)
{
    const counted *c = user;
    (void)thread;
    stability_tally_shadow(&c->w->shadows[kernel * c->m->case_count + c->which], ray, span, finding, c->number);
}

/* A light about the scene, for cases that ask for none in particular; the case's random numbers are its own. */
static void light_anywhere(stability_scene *s)
{
    base_random random = {~s->random.state};
    double point[3];
    for (int k = 0; k < 3; k++)
        point[k] = base_random_range(&random, -1.5, 1.5);
    stability_light(s, point);
}

/* Scene number `piece`: a case, a place, a frame. Back faces are culled in every other order of axes. */
static void try_scene(void *user, size_t piece, unsigned index)
{
    measured *m = user;
    worker *w = &m->workers[index];
    const size_t which = piece / m->frames / STABILITY_PLACES, place = piece / m->frames % STABILITY_PLACES;
    const size_t frame = piece % m->frames * (STABILITY_FRAMES / m->frames), variant = place * STABILITY_FRAMES + frame;
    size_t count;
    counted c = {m, w, which, place, variant};
    stability_scene s = {.machine = m->suite->options->machine, .place = stability_places[place], .frame = stability_frame_of((unsigned)frame),
                         .random = {which * STABILITY_PLACES * STABILITY_FRAMES + variant}, .variant = (unsigned)variant, .err = &w->err};
    if (w->status == BASE_OK) {
        light_anywhere(&s);
        stability_case_list(&count)[which].build(&s);
        w->status = s.status;
    }
    if (w->status == BASE_OK) {
        scene made = {.triangle_count = s.count, .triangles = s.triangles, .camera_count = 1, .cameras = &s.camera};
        memcpy(made.light.point, s.light, sizeof s.light);
        const stability_input input = {&made, &s.camera, m->suite->options->machine, m->kernels, s.width, s.height, (frame / 8 + place) % 2, 1};
        w->status = stability_try(&input, count_ray, count_shadow, &c, &w->err);
    }
    stability_scene_clear(&s);
    progress_step(&m->bar, index);
}

/* Tallies of nothing; NULL if out of memory. */
static stability_tally *create_tallies(size_t count)
{
    stability_tally *tallies = calloc(count, sizeof *tallies);
    for (size_t i = 0; tallies && i < count; i++)
        tallies[i] = stability_tally_none();
    return tallies;
}

static base_status create_workers(measured *m, base_error *err)
{
    const size_t cases = m->kernels->count * m->case_count, places = m->kernels->count * STABILITY_PLACES;
    m->workers = calloc(m->suite->jobs, sizeof *m->workers);
    for (unsigned i = 0; m->workers && i < m->suite->jobs; i++) {
        worker *w = &m->workers[i];
        w->cases = create_tallies(cases);
        w->places = create_tallies(places);
        w->shadows = create_tallies(cases);
        if (!w->cases || !w->places || !w->shadows)
            return base_fail(err, BASE_ERR_NOMEM, "stability", "out of memory");
    }
    return m->workers ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, "stability", "out of memory");
}

/* Add all that a worker has counted to the first. */
static void collect(measured *m, const worker *w)
{
    const worker *all = &m->workers[0];
    for (size_t i = 0; i < m->kernels->count * m->case_count; i++) {
        stability_tally_add(&all->cases[i], &w->cases[i]);
        stability_tally_add(&all->shadows[i], &w->shadows[i]);
    }
    for (size_t i = 0; i < m->kernels->count * STABILITY_PLACES; i++)
        stability_tally_add(&all->places[i], &w->places[i]);
}

static base_status try_cases(measured *m, base_error *err)
{
    const size_t scenes = m->case_count * STABILITY_PLACES * m->frames;
    base_status status = create_workers(m, err);
    if (status != BASE_OK)
        return status;
    m->bar = progress_begin("stability", scenes, true);
    base_parallel_for(m->suite->jobs, scenes, try_scene, m);
    progress_end(&m->bar);
    for (unsigned i = 0; status == BASE_OK && i < m->suite->jobs; i++) {
        const worker *w = &m->workers[i];
        if (w->status != BASE_OK)
            status = base_fail(err, w->status, w->err.what, "%s", w->err.why);
        if (i > 0)
            collect(m, w);
    }
    return status;
}

/* Where a reader can look: the first scene of each row that has a hit lost or wrong. */
static void note_bad(report_table *t, const char *kernel, const char *what, const stability_tally *tally)
{
    char note[200];
    if (tally->first_bad == UINT64_MAX)
        return;
    snprintf(note, sizeof note, "%s, %s: the first hit lost or wrong is in scene %llu (offset %g, size %g, frame %llu).", kernel, what,
             (unsigned long long)tally->first_bad, stability_places[tally->first_bad / STABILITY_FRAMES].offset,
             stability_places[tally->first_bad / STABILITY_FRAMES].scale, (unsigned long long)(tally->first_bad % STABILITY_FRAMES));
    report_table_add_note(t, note);
}

static report_table *case_table(const measured *m)
{
    static const report_column first[] = {{.name = "case"}, {.name = "what it is"}};
    size_t count;
    const stability_case *cases = stability_case_list(&count);
    char caption[600];
    report_table *t = report_table_create("Hard cases");
    snprintf(caption, sizeof caption, "Each case in %u of 48 frames (the orders of the axes, mirrored or not) at 9 places (offsets 0, 1e3, 1e6, sizes 1e-4, "
             "1, 1e4). Lost, wrong, ties and 'decided otherwise' are rays whose answer is not the exact one; the last are at an edge within "
             "rounding, or start within rounding of a surface. Leaks are rays that hit something and found nothing. Worst errors are of hits "
             "that are right or ties.", m->frames);
    report_table_set_caption(t, caption);
    stability_add_columns(t, first, 2);
    for (size_t k = 0; k < m->kernels->count; k++) {
        stability_tally sum = stability_tally_none();
        report_table_begin_group(t, m->kernels->list[k]->name);
        for (size_t i = 0; i < count; i++) {
            const stability_tally *tally = &m->workers[0].cases[k * count + i];
            report_table_begin_row(t);
            report_table_add_text(t, cases[i].id);
            report_table_add_text(t, cases[i].name);
            stability_add_tally(t, tally);
            note_bad(t, m->kernels->list[k]->name, cases[i].id, tally);
            stability_tally_add(&sum, tally);
        }
        report_table_begin_row(t);
        report_table_add_text(t, "all");
        report_table_add_text(t, "");
        stability_add_tally(t, &sum);
    }
    return t;
}

static report_table *place_table(const measured *m)
{
    static const report_column first[] = {{.name = "offset", .kind = REPORT_REAL, .digits = REPORT_DIGITS_PLAIN},
                                          {.name = "size", .kind = REPORT_REAL, .decimals = 4, .digits = REPORT_DIGITS_PLAIN}};
    report_table *t = report_table_create("The same rays by place");
    report_table_set_caption(t, "Where offset is 2^24 times the size or more, floats leave nothing of the scene's shape.");
    stability_add_columns(t, first, 2);
    for (size_t k = 0; k < m->kernels->count; k++) {
        report_table_begin_group(t, m->kernels->list[k]->name);
        for (size_t i = 0; i < STABILITY_PLACES; i++) {
            report_table_begin_row(t);
            report_table_add_real(t, stability_places[i].offset);
            report_table_add_real(t, stability_places[i].scale);
            stability_add_tally(t, &m->workers[0].places[k * STABILITY_PLACES + i]);
        }
    }
    return t;
}

/* Shadow rays by kernel and case, of the kernels that have hard shadows; NULL without one. */
static report_table *shadow_table(const measured *m)
{
    static const report_column first[] = {{.name = "case"}, {.name = "what it is"}};
    size_t count;
    const stability_case *cases = stability_case_list(&count);
    report_table *t = NULL;
    for (size_t k = 0; k < m->kernels->count; k++) {
        stability_tally sum = stability_tally_none();
        if (!m->kernels->list[k]->defaults.hard_shadows)
            continue;
        if (!t) {
            t = report_table_create("Hard shadows of the same cases");
            report_table_set_caption(t, "Rays from a point light to the hits of the primary rays. Lost: a triangle is in the way, off its edges, and "
                                        "the kernel let the ray pass; wrong: nothing is in the way, and it was stopped.");
            stability_add_shadow_columns(t, first, 2);
        }
        report_table_begin_group(t, m->kernels->list[k]->name);
        for (size_t i = 0; i <= count; i++) {
            const stability_tally *tally = i < count ? &m->workers[0].shadows[k * count + i] : &sum;
            report_table_begin_row(t);
            report_table_add_text(t, i < count ? cases[i].id : "all");
            report_table_add_text(t, i < count ? cases[i].name : "");
            stability_add_shadow_tally(t, tally);
            if (i < count) {
                note_bad(t, m->kernels->list[k]->name, cases[i].id, tally);
                stability_tally_add(&sum, tally);
            }
        }
    }
    return t;
}

static void destroy(measured *m)
{
    for (unsigned i = 0; m->workers && i < m->suite->jobs; i++) {
        free(m->workers[i].cases);
        free(m->workers[i].places);
        free(m->workers[i].shadows);
    }
    free(m->workers);
}

base_status stability_add_hard_cases(suite *s, const stability_kernels *kernels, unsigned frames, base_error *err)
{
    measured m = {.suite = s, .kernels = kernels, .frames = frames};
    (void)stability_case_list(&m.case_count);
    base_status status = try_cases(&m, err);
    if (status == BASE_OK)
        status = suite_add_table(s, "", case_table(&m), err);
    if (status == BASE_OK)
        status = suite_add_table(s, "-places", place_table(&m), err);
    report_table *shadows = status == BASE_OK ? shadow_table(&m) : NULL;
    if (shadows)
        status = suite_add_table(s, "-shadows", shadows, err);
    destroy(&m);
    return status;
}
