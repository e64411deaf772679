/* The oracles against each other: brute force in double and Embree, with exact arithmetic as the judge. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/gltf_loader.h"
#include "tests/oracles/brute_force.h"
#include "tests/oracles/embree_oracle.h"
#include "tests/oracles/hit_judge.h"
#include "tests/oracles/soup.h"

enum { JOBS = 2, SOUP_TRIANGLES = 1500, SOUP_RAYS = 8000 };

typedef struct comparison {
    const scene_triangle *triangles;
    size_t triangle_count;
    oracle_ray *rays;
    size_t ray_count;
    oracle_hit *ours, *embree;
} comparison;

static comparison comparison_create(const scene_triangle *triangles, size_t triangle_count, size_t ray_count)
{
    comparison c = {.triangles = triangles, .triangle_count = triangle_count, .ray_count = ray_count};
    c.rays = calloc(ray_count, sizeof *c.rays);
    c.ours = calloc(ray_count, sizeof *c.ours);
    c.embree = calloc(ray_count, sizeof *c.embree);
    assert_true(c.rays && c.ours && c.embree);
    return c;
}

static void comparison_destroy(comparison *c)
{
    free(c->rays);
    free(c->ours);
    free(c->embree);
}

static void ask_embree(comparison *c, int cull_backface)
{
    embree_oracle *oracle;
    base_error err;
    if (embree_oracle_create(c->triangles, c->triangle_count, cull_backface, JOBS, &oracle, &err) != BASE_OK ||
        embree_oracle_closest(oracle, c->rays, c->ray_count, c->embree, &err) != BASE_OK)
        fail_msg("%s: %s", err.what, err.why);
    embree_oracle_destroy(&oracle);
}

static judge_summary judge(const comparison *c, int cull_backface, const char *what)
{
    judge_options options = judge_options_default();
    options.cull_backface = cull_backface;
    judge_summary s = hit_judge_rays(&options, c->triangles, c->triangle_count, c->rays, c->ours, c->embree,
                                     c->ray_count, JOBS, NULL);
    print_message("# %s, culling %d:", what, cull_backface);
    for (int v = 0; v < JUDGE_VERDICTS; v++)
        print_message(" %s %llu%s", judge_verdict_name((judge_verdict)v), (unsigned long long)s.count[v],
                      v + 1 < JUDGE_VERDICTS ? "," : "\n");
    if (s.first_wrong != SIZE_MAX) {
        const oracle_ray *r = &c->rays[s.first_wrong];
        fail_msg("%s: ray %zu (%a %a %a)+t(%a %a %a): ours %u at %.9g, Embree %u at %.9g", what, s.first_wrong,
                 (double)r->org[0], (double)r->org[1], (double)r->org[2], (double)r->dir[0], (double)r->dir[1],
                 (double)r->dir[2], c->ours[s.first_wrong].id, c->ours[s.first_wrong].t, c->embree[s.first_wrong].id,
                 c->embree[s.first_wrong].t);
    }
    return s;
}

static unsigned count_hits(const comparison *c)
{
    unsigned hits = 0;
    for (size_t i = 0; i < c->ray_count; i++)
        hits += c->embree[i].id != ORACLE_NO_HIT;
    return hits;
}

/* Brute force against Embree, with and without culling: nothing may be left unexplained. */
static void compare_brute_force(comparison *c, const char *what)
{
    for (int cull = 0; cull < 2; cull++) {
        brute_force_closest(c->triangles, c->triangle_count, c->rays, c->ray_count, cull, JOBS, c->ours);
        ask_embree(c, cull);
        judge_summary s = judge(c, cull, what);
        assert_int_equal(s.count[JUDGE_OURS_WRONG], 0);
        assert_true(count_hits(c) > c->ray_count / 50);
    }
}

static void soups__all_sizes__explained(void **state)
{
    static const double sizes[] = {1.0, 0.2, 0.03};
    base_random random = {11};
    scene_triangle *triangles = calloc(SOUP_TRIANGLES, sizeof *triangles);
    (void)state;
    assert_non_null(triangles);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        char what[64];
        soup_triangles(&random, sizes[i], triangles, SOUP_TRIANGLES);
        comparison c = comparison_create(triangles, SOUP_TRIANGLES, SOUP_RAYS);
        soup_rays(&random, c.rays, SOUP_RAYS);
        snprintf(what, sizeof what, "soup of size %g", sizes[i]);
        compare_brute_force(&c, what);
        comparison_destroy(&c);
    }
    free(triangles);
}

/* Sine and cosine of an angle in [0, 7]: Taylor series, so that the floats made from them are equal everywhere. */
static double sine(double angle)
{
    double term = angle, sum = angle;
    for (int n = 1; n < 24; n++) {
        term *= -angle * angle / (2.0 * n * (2.0 * n + 1.0));
        sum += term;
    }
    return sum;
}

static double cosine(double angle)
{
    double term = 1.0, sum = 1.0;
    for (int n = 1; n < 24; n++) {
        term *= -angle * angle / (2.0 * n * (2.0 * n - 1.0));
        sum += term;
    }
    return sum;
}

/* A unit sphere as a grid of quads, two triangles each: closed, with shared edges and vertices of high valence. */
static size_t sphere(scene_triangle *out, int rings, int sectors, float offset)
{
    size_t count = 0;
    for (int i = 0; i < rings; i++)
        for (int j = 0; j < sectors; j++) {
            float corner[4][3];
            for (int n = 0; n < 4; n++) {
                int ring = i + (n == 1 || n == 2);
                double polar = 3.14159265358979 * ring / rings, radius = ring < rings ? sine(polar) : 0.0;
                double around = 6.28318530717959 * ((j + (n >= 2)) % sectors) / sectors;
                corner[n][0] = offset + (float)(radius * cosine(around));
                corner[n][1] = offset + (float)(radius * sine(around));
                corner[n][2] = offset + (float)cosine(polar);
            }
            for (int half = 0; half < 2; half++) {
                if ((half == 1 && i == 0) || (half == 0 && i == rings - 1))
                    continue; /* at the poles one of the two has no area */
                memcpy(out[count].v[0], corner[0], sizeof corner[0]);
                memcpy(out[count].v[1], corner[half ? 2 : 1], sizeof corner[0]);
                memcpy(out[count].v[2], corner[half ? 3 : 2], sizeof corner[0]);
                count++;
            }
        }
    return count;
}

/* Rays aimed at points of edges and at vertices, as well as floats can: where float tests go either way. */
static void aim_at_edges(base_random *random, comparison *c, float offset)
{
    for (size_t i = 0; i < c->ray_count; i++) {
        const scene_triangle *triangle = &c->triangles[base_random_bits(random) % c->triangle_count];
        double share = i % 3 ? base_random_unit(random) : 0.0;
        soup_point(random, i % 4 ? 0.5 : 3.0, c->rays[i].org); /* mostly inside, so that with culling some hit too */
        for (int k = 0; k < 3; k++) {
            double a = (double)triangle->v[i % 2][k], b = (double)triangle->v[2][k];
            c->rays[i].org[k] += offset;
            c->rays[i].dir[k] = (float)(a + share * (b - a) - (double)c->rays[i].org[k]);
        }
        c->rays[i].tmax = INFINITY;
    }
}

static void closed_sphere__rays_at_edges__explained(void **state)
{
    enum { RINGS = 20, SECTORS = 30 };
    static const float offsets[] = {0.0f, 1000.0f};
    base_random random = {12};
    scene_triangle *triangles = calloc(2 * RINGS * SECTORS, sizeof *triangles);
    (void)state;
    assert_non_null(triangles);
    for (size_t i = 0; i < sizeof offsets / sizeof *offsets; i++) {
        char what[64];
        comparison c = comparison_create(triangles, sphere(triangles, RINGS, SECTORS, offsets[i]), 20000);
        aim_at_edges(&random, &c, offsets[i]);
        snprintf(what, sizeof what, "sphere at %g, rays at its edges", (double)offsets[i]);
        compare_brute_force(&c, what);
        comparison_destroy(&c);
    }
    free(triangles);
}

/* The usual single-precision test of the kernels; what its rounding does at edges is what the judge must excuse. */
static int float_intersect(const scene_triangle *triangle, const oracle_ray *ray, float *t)
{
    float e1[3], e2[3], s[3], p[3], q[3], det = 0.0f, u = 0.0f, v = 0.0f, distance = 0.0f;
    for (int k = 0; k < 3; k++) {
        e1[k] = triangle->v[1][k] - triangle->v[0][k];
        e2[k] = triangle->v[2][k] - triangle->v[0][k];
        s[k] = ray->org[k] - triangle->v[0][k];
    }
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        p[k] = ray->dir[i] * e2[j] - ray->dir[j] * e2[i];
        q[k] = s[i] * e1[j] - s[j] * e1[i];
    }
    for (int k = 0; k < 3; k++) {
        det += e1[k] * p[k];
        u += s[k] * p[k];
        v += ray->dir[k] * q[k];
        distance += e2[k] * q[k];
    }
    *t = distance / det;
    return det != 0.0f && u / det >= 0.0f && v / det >= 0.0f && u / det + v / det <= 1.0f && *t > 0.0f;
}

static void float_closest(comparison *c)
{
    for (size_t i = 0; i < c->ray_count; i++) {
        float t, best = INFINITY;
        c->ours[i] = (oracle_hit){.id = ORACLE_NO_HIT, .t = (double)INFINITY};
        for (size_t k = 0; k < c->triangle_count; k++)
            if (float_intersect(&c->triangles[k], &c->rays[i], &t) && t < best) {
                best = t;
                c->ours[i] = (oracle_hit){.id = (uint32_t)k, .t = (double)t};
            }
    }
}

static void closed_sphere__float_kernel_at_edges__excused(void **state)
{
    enum { RINGS = 20, SECTORS = 30 };
    base_random random = {14};
    scene_triangle *triangles = calloc(2 * RINGS * SECTORS, sizeof *triangles);
    (void)state;
    assert_non_null(triangles);
    comparison c = comparison_create(triangles, sphere(triangles, RINGS, SECTORS, 0.0f), 20000);
    aim_at_edges(&random, &c, 0.0f);
    float_closest(&c);
    ask_embree(&c, 0);
    judge_summary s = judge(&c, 0, "sphere, in float");
    assert_int_equal(s.count[JUDGE_OURS_WRONG], 0);
    assert_true(s.count[JUDGE_NEAR_EDGE] > 0);
    comparison_destroy(&c);
    free(triangles);
}

/* The judge must not explain everything away: answers spoilt on purpose are found, every one. */
static void soup__spoilt_answers__all_found(void **state)
{
    base_random random = {13};
    judge_options options = judge_options_default();
    scene_triangle *triangles = calloc(SOUP_TRIANGLES, sizeof *triangles);
    unsigned spoilt = 0;
    (void)state;
    assert_non_null(triangles);
    soup_triangles(&random, 0.2, triangles, SOUP_TRIANGLES);
    comparison c = comparison_create(triangles, SOUP_TRIANGLES, SOUP_RAYS);
    soup_rays(&random, c.rays, SOUP_RAYS);
    ask_embree(&c, 0);
    for (size_t i = 0; i < c.ray_count; i++) {
        c.ours[i] = c.embree[i];
        if (c.embree[i].id == ORACLE_NO_HIT)
            c.ours[i] = (oracle_hit){.id = 0, .t = 1.0};
        else if (i % 3 == 0)
            c.ours[i] = (oracle_hit){.id = ORACLE_NO_HIT, .t = (double)INFINITY};
        else if (i % 3 == 1)
            c.ours[i].id = (c.embree[i].id + 1) % SOUP_TRIANGLES;
        else
            c.ours[i].t *= 1.1;
        spoilt++;
    }
    judge_summary s = hit_judge_rays(&options, triangles, SOUP_TRIANGLES, c.rays, c.ours, c.embree, c.ray_count, JOBS,
                                     NULL);
    assert_int_equal(s.count[JUDGE_OURS_WRONG], spoilt);
    comparison_destroy(&c);
    free(triangles);
}

/* Primary rays of the scene's first camera. */
static void primary_rays(const scene *s, unsigned width, unsigned height, oracle_ray *rays)
{
    scene_primary_rays p = scene_camera_rays(&s->cameras[0], width, height);
    for (unsigned y = 0; y < height; y++)
        for (unsigned x = 0; x < width; x++) {
            oracle_ray *ray = &rays[(size_t)y * width + x];
            for (int k = 0; k < 3; k++) {
                ray->org[k] = p.origin[k];
                ray->dir[k] = p.d00[k] + (float)x * p.dx[k] + (float)y * p.dy[k];
            }
            ray->tmin = 0.0f;
            ray->tmax = INFINITY;
        }
}

static void compare_scene(const char *file, unsigned width, unsigned height)
{
    const char *folder = getenv("LANETRACE_SCENES");
    char path[4096];
    scene *s = NULL;
    base_error err = {0};
    snprintf(path, sizeof path, "%s/%s", folder ? folder : "", file);
    FILE *probe = folder ? fopen(path, "rb") : NULL;
    if (!probe) {
        print_message("# skipped: %s is not there\n", file); /* cmocka's skip() would print "not ok" */
        return;
    }
    fclose(probe);
    if (scene_gltf_load(path, &s, &err) != BASE_OK)
        fail_msg("%s: %s", err.what, err.why);
    comparison c = comparison_create(s->triangles, s->triangle_count, (size_t)width * height);
    primary_rays(s, width, height, c.rays);
    compare_brute_force(&c, file);
    comparison_destroy(&c);
    scene_destroy(&s);
}

static void room__primary_rays__explained(void **state)
{
    (void)state;
    compare_scene("room_804.glb", 160, 160);
}

static void plant__primary_rays__explained(void **state)
{
    (void)state;
    compare_scene("plant_4k.glb", 128, 128);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(soups__all_sizes__explained),
        cmocka_unit_test(closed_sphere__rays_at_edges__explained),
        cmocka_unit_test(closed_sphere__float_kernel_at_edges__excused),
        cmocka_unit_test(soup__spoilt_answers__all_found),
        cmocka_unit_test(room__primary_rays__explained),
        cmocka_unit_test(plant__primary_rays__explained),
    };
    return cmocka_run_group_tests_name("oracles/agreement", tests, NULL, NULL);
}
