/* Soft shadows: packets, groups of them, frusta and all ways to shrink them block the same rays (hard case B14), and those that Embree and exact
 * arithmetic say are blocked.
 *
 * usage: test_soft SIZE [SCENE...]: pictures of the small built-in scenes, and of these, are SIZE x SIZE.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/job_shadow.h"
#include "lrbni/base/random.h"
#include "scene/builtin.h"
#include "tests/kernels/accel/soup.h"
#include "tests/kernels/trace.h"
#include "tests/oracles/embree_oracle.h"
#include "exact/predicates.h"

enum { JOBS = 2, WAYS = 6 };

static unsigned picture_size;

/* packet16-soft, packet256-soft, then mft-soft with each way to shrink. */
static const char *way_name(int way) { return way > 1 ? "mft-soft" : way ? "packet256-soft" : "packet16-soft"; }

static trace_picture trace_way(int way, const bvh *const tree[2], const scene *s, const scene_camera *camera, const kernel_params *change,
                               unsigned width, unsigned height)
{
    kernel_params params = kernel_find(way_name(way))->defaults;
    params.samples = change->samples;
    params.light_scale = change->light_scale;
    params.net = change->net;
    params.shrink = way > 1 ? (unsigned)way - 2 : 0;
    trace_request request = {.kernel = way_name(way), .tree = tree[way > 0], .camera = camera, .width = width, .height = height,
                             .cull = change->cull_backface, .params = &params, .light = &s->light, .level = LRB_NATIVE, .jobs = JOBS};
    return trace_run(&request);
}

/* All ways; the picture of the packets is returned. */
static trace_picture trace_all_ways(const scene *s, const scene_camera *camera, const kernel_params *change, unsigned width, unsigned height,
                                    const char *what)
{
    bvh *deep = trace_tree(s, 2), *shallow = trace_tree(s, 8);
    const bvh *tree[2] = {deep, shallow};
    trace_picture packets = trace_way(0, tree, s, camera, change, width, height);
    for (int way = 1; way < WAYS; way++) {
        char text[256];
        trace_picture frusta = trace_way(way, tree, s, camera, change, width, height);
        snprintf(text, sizeof text, "%s, %s, shrink %d, cull_backface %u, light x %g", what, way_name(way), way > 1 ? way - 2 : 0,
                 change->cull_backface, change->light_scale);
        trace_assert_equal(&packets, &frusta, text);
        assert_int_equal(packets.counts.n[KERNEL_rays_shadow], frusta.counts.n[KERNEL_rays_shadow]);
        assert_int_equal(packets.counts.n[KERNEL_units_shadow_packets], frusta.counts.n[way > 1 ? KERNEL_units_shadow_frusta : KERNEL_units_shadow_packets]);
        trace_free(&frusta);
    }
    bvh_destroy(&deep);
    bvh_destroy(&shallow);
    return packets;
}

/* ---- who is right ---- */

typedef struct judgement {
    size_t rays, blocked, differ, excused;
} judgement;

/* How a triangle stands to a ray, by exact arithmetic: it blocks it, it does not, or rounding may say either. */
typedef enum standing { CLEAR, DOUBTFUL, BLOCKS } standing;

static standing stands(const oracle_ray *ray, const scene_triangle *t, unsigned cull, exact_hit *hit)
{
    const double edge_ulp = 4, t_relative = 1e-5;
    double margin[3];
    exact_ray_triangle(ray->org, ray->dir, t->v[0], t->v[1], t->v[2], hit);
    if (hit->facing == 0 || (cull && hit->facing < 0))
        return CLEAR;
    exact_edge_margins_ulp(ray->org, ray->dir, t->v[0], t->v[1], t->v[2], margin);
    double least = fmin(margin[0], fmin(margin[1], margin[2]));
    double from_ends = fmin(hit->t_double - (double)ray->tmin, (double)ray->tmax - hit->t_double);
    double end_tolerance = t_relative * fmax(fabs(hit->t_double), 1e-3);
    if (least < -edge_ulp || from_ends < -end_tolerance)
        return CLEAR;
    return least > edge_ulp && from_ends > end_tolerance ? BLOCKS : DOUBTFUL;
}

/* Whether `blocked` is a possible answer: some triangle that may block the ray, or none that must. */
static int possible(const scene *s, const oracle_ray *ray, unsigned cull, int blocked)
{
    exact_hit hit;
    int may = 0, must = 0;
    exact_hit_init(&hit);
    for (size_t i = 0; i < s->triangle_count; i++) {
        standing answer = stands(ray, &s->triangles[i], cull, &hit);
        may |= answer != CLEAR;
        must |= answer == BLOCKS;
    }
    exact_hit_clear(&hit);
    return blocked ? may : !must;
}

static void judge(const scene *s, const trace_picture *p, const trace_request *request, judgement *total, const char *what)
{
    base_error err = {0};
    embree_oracle *embree = NULL;
    oracle_ray *rays = calloc(16 * p->pixels, sizeof *rays);
    uint32_t *taken = calloc(p->pixels, sizeof *taken);
    unsigned char *blocked = calloc(16 * p->pixels, 1);
    assert_true(rays && taken && blocked);
    trace_shadow_rays(request, p, 0, rays, taken);
    if (embree_oracle_create(s->triangles, s->triangle_count, (int)request->cull, JOBS, &embree, &err) != BASE_OK ||
        embree_oracle_occluded(embree, rays, 16 * p->pixels, blocked, &err) != BASE_OK)
        fail_msg("%s: %s", err.what, err.why);
    for (size_t i = 0; i < 16 * p->pixels; i++) {
        if (!(taken[i / 16] >> (i % 16) & 1))
            continue;
        int ours = p->occlusion[i / 16] >> (i % 16) & 1;
        total->rays++;
        total->blocked += (size_t)ours;
        if (ours == blocked[i])
            continue;
        total->differ++;
        if (!possible(s, &rays[i], request->cull, ours))
            fail_msg("%s, pixel (%zu,%zu), sample %zu: %s, which is wrong", what, i / 16 % p->width, i / 16 / p->width, i % 16,
                     ours ? "blocked" : "not blocked");
        total->excused += !possible(s, &rays[i], request->cull, !ours) ? 0 : 1;
    }
    embree_oracle_destroy(&embree);
    free(rays);
    free(taken);
    free(blocked);
}

static void judge_packets(const scene *s, const scene_camera *camera, const kernel_params *params, const trace_picture *p, judgement *total,
                          const char *what)
{
    bvh *tree = trace_tree(s, 2);
    kernel_params all = kernel_find("packet16-soft")->defaults;
    all.samples = params->samples;
    all.light_scale = params->light_scale;
    all.net = params->net;
    trace_request request = {.kernel = "packet16-soft", .tree = tree, .camera = camera, .width = p->width, .height = p->height,
                             .cull = params->cull_backface, .params = &all, .light = &s->light, .level = LRB_NATIVE, .jobs = JOBS};
    judge(s, p, &request, total, what);
    bvh_destroy(&tree);
}

static void report(const char *what, const judgement *j)
{
    print_message("# %s: %zu shadow rays, %zu blocked, Embree says otherwise of %zu, of which %zu could be either\n", what, j->rays,
                  j->blocked, j->differ, j->excused);
    assert_true(j->rays > 1000 && j->blocked > j->rays / 50 && j->blocked < j->rays);
}

/* ---- scenes ---- */

static char **more_scenes; /* besides the usual ones */
static int more_count;

static void check_builtin(const char *spec)
{
    static const double scales[] = {1, 0.125, 4};
    scene *s = NULL;
    judgement total = {0};
    assert_int_equal(scene_open(spec, &s, NULL), BASE_OK);
    for (unsigned i = 0; i < 3; i++) {
        kernel_params params = {.cull_backface = i & 1, .samples = 16, .light_scale = scales[i], .net = i & 1};
        trace_picture p = trace_all_ways(s, &s->cameras[0], &params, picture_size, picture_size, spec);
        judge_packets(s, &s->cameras[0], &params, &p, &total, spec);
        trace_free(&p);
    }
    report(spec, &total);
    scene_destroy(&s);
}

static void soft__builtin_scenes__same_bits_and_right(void **state)
{
    size_t count;
    (void)state;
    const char *const *usual = scene_builtin_usual(&count);
    for (size_t i = 0; i < count; i++)
        check_builtin(usual[i]);
    for (int i = 0; i < more_count; i++)
        check_builtin(more_scenes[i]);
}

/* Looks at some triangle from some way off; so does a light, of any size. */
static scene_camera random_view(base_random *r, scene *s)
{
    const scene_triangle *t = &s->triangles[base_random_bits(r) % s->triangle_count];
    double eye[3], target[3], up[3], extent = 0;
    for (int k = 0; k < 3; k++) {
        target[k] = ((double)t->v[0][k] + (double)t->v[1][k] + (double)t->v[2][k]) / 3;
        extent = fmax(extent, fmax(fabs((double)t->v[1][k] - (double)t->v[0][k]), fabs((double)t->v[2][k] - (double)t->v[0][k])));
    }
    const double away = extent * base_random_range(r, 1, 6), width = extent * base_random_range(r, 0.1, 4);
    for (int k = 0; k < 3; k++) {
        eye[k] = target[k] + base_random_range(r, -1, 1) * away;
        up[k] = base_random_range(r, -1, 1);
        s->light.corner[k] = target[k] + base_random_range(r, -1, 1) * away;
        s->light.u[k] = base_random_range(r, -1, 1) * width;
        s->light.v[k] = base_random_range(r, -1, 1) * width;
    }
    return scene_camera_look_at("random", eye, target, up, base_random_range(r, 0.5, 1.5));
}

static void check_soup(scene s, uint64_t seed, int pictures)
{
    base_random r = {seed};
    judgement total = {0};
    for (int i = 0; i < pictures; i++) {
        char what[128];
        kernel_params params = {.cull_backface = (unsigned)i & 1, .samples = 16, .light_scale = 1, .net = (unsigned)i >> 1 & 1};
        scene_camera camera = random_view(&r, &s);
        snprintf(what, sizeof what, "%.40s, picture %d", s.name, i);
        trace_picture p = trace_all_ways(&s, &camera, &params, 48, 40, what);
        judge_packets(&s, &camera, &params, &p, &total, what);
        trace_free(&p);
    }
    report(s.name, &total);
    soup_free(&s);
}

static void soft__soups__same_bits_and_right(void **state)
{
    (void)state;
    check_soup(soup_random(31, 400, 0.3), 1, 16);
    check_soup(soup_coplanar(34, 200), 4, 8);
    check_soup(soup_placed(35, 400, 1e-2f, 1e3f), 5, 8); /* far from the origin: 16 ulp of it are a thousandth of a triangle */
}

/* Triangles a hundredth to a thousandth as high as long: rays pass near their long edges all the time. */
static scene slivers(uint64_t seed, size_t count)
{
    base_random r = {seed};
    scene s = soup_random(seed, count, 0.5);
    for (size_t i = 0; i < count; i++) {
        float(*v)[3] = s.triangles[i].v;
        float along = (float)base_random_unit(&r), height = (float)base_random_range(&r, 1e-3, 1e-2);
        for (int k = 0; k < 3; k++)
            v[2][k] = v[0][k] + along * (v[1][k] - v[0][k]) + height * (v[2][k] - v[0][k]);
    }
    return s;
}

static void soft__slivers__same_bits_and_right(void **state)
{
    (void)state;
    check_soup(slivers(36, 3000), 6, 8);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(soft__soups__same_bits_and_right),
        cmocka_unit_test(soft__slivers__same_bits_and_right),
        cmocka_unit_test(soft__builtin_scenes__same_bits_and_right),
    };
    if (argc < 2)
        return 2;
    picture_size = (unsigned)atoi(argv[1]);
    more_scenes = argv + 2;
    more_count = argc - 2;
    return cmocka_run_group_tests_name("soft", tests, NULL, NULL);
}
