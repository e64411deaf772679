/* Adaptive anti-aliasing: mft-msaa hits what mft-primary hits, its samples are the pixels of a picture four times as large, bit for
 * bit, and it marks the pixels whose samples a silhouette separates, as exact/pixel_edges.h judges them. Hard case B17.
 *
 * usage: test_msaa SIZE: pictures of built-in scenes are SIZE x SIZE
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

#include "exact/pixel_edges.h"
#include "kernels/accel/bvh_edges.h"
#include "kernels/job_msaa.h"
#include "scene/builtin.h"
#include "tests/kernels/accel/soup.h"
#include "tests/kernels/trace.h"
#include "tests/kernels/views.h"

static unsigned picture_size;

/* One edge pixel in so many may be missed, in small pictures none: surfaces end behind gaps thinner than a pixel (docs/kernels.md). */
enum { MOST_MISSED = 5000 };

/* A job of a kernel, traced. */
typedef struct traced {
    kernel_job *job;
    kernel_counts counts;
} traced;

static traced trace(const char *kernel, const bvh *tree, const scene_camera *camera, unsigned width, unsigned height, unsigned cull,
                    const kernel_params *params)
{
    traced r = {.job = trace_job(&(trace_request){.kernel = kernel, .tree = tree, .camera = camera, .width = width, .height = height,
                                                  .cull = cull, .params = params})};
    lrb_ctx *c = NULL;
    assert_int_equal(lrb_ctx_create(NULL, NULL, &c, NULL), BASE_OK);
    for (uint32_t tile = 0; tile < kernel_job_tiles(r.job); tile++)
        kernel_find(kernel)->tile[LRB_NATIVE](c, r.job, tile, &r.counts);
    lrb_ctx_destroy(&c);
    return r;
}

/* What was found in a picture. */
typedef struct found {
    size_t marked, edges, missed, intersections, precise;
} found;

static void read_pixel(const kernel_job *job, unsigned x, unsigned y, uint32_t out[4])
{
    const job_pixel p = kernel_job_pixel(job, x, y);
    const job_frame_tile *tile = &job->frame_host[p.tile];
    out[0] = tile->id[p.block][p.pixel];
    memcpy(&out[1], &tile->t[p.block][p.pixel], 4);
    memcpy(&out[2], &tile->u[p.block][p.pixel], 4);
    memcpy(&out[3], &tile->v[p.block][p.pixel], 4);
}

/* The samples of a pixel against the block of the large picture that they are. */
static void check_samples(const kernel_job *job, const kernel_job *large, unsigned x, unsigned y, const char *what)
{
    unsigned row = 0;
    const job_frame_tile *samples = job_msaa_samples(job, x, y, &row);
    for (unsigned j = 0; samples && j < 16; j++) {
        uint32_t expected[4];
        float direction[3], theirs[3];
        read_pixel(large, 4 * x + j % 4, 4 * y + j / 4, expected);
        if (samples->id[row][j] != expected[0] || memcmp(&samples->t[row][j], &expected[1], 4) != 0 ||
            memcmp(&samples->u[row][j], &expected[2], 4) != 0 || memcmp(&samples->v[row][j], &expected[3], 4) != 0)
            fail_msg("%s, pixel %u %u, sample %u: triangle %u at %g, in the large picture %u", what, x, y, j, samples->id[row][j],
                     (double)samples->t[row][j], expected[0]);
        job_msaa_direction(job, x, y, j, direction);
        kernel_job_direction(large, 4 * x + j % 4, 4 * y + j / 4, theirs);
        assert_memory_equal(direction, theirs, sizeof theirs);
    }
}

static void judge_pixel(pixel_edges *edges, const kernel_job *job, const kernel_job *large, unsigned x, unsigned y, found *n)
{
    uint32_t id[16], pixel[4];
    float t[16];
    for (unsigned j = 0; j < 16; j++) {
        read_pixel(large, 4 * x + j % 4, 4 * y + j / 4, pixel);
        id[j] = pixel[0];
        memcpy(&t[j], &pixel[1], 4);
    }
    const pixel_kind kind = pixel_edges_judge(edges, x, y, id, t);
    const bool marked = job_msaa_marked(job, x, y);
    n->marked += marked;
    n->edges += kind == PIXEL_EDGE;
    n->missed += kind == PIXEL_EDGE && !marked;
    n->intersections += kind == PIXEL_INTERSECTION;
    n->precise += kind != PIXEL_SMOOTH && marked;
}

/* Trace a view; compare it with mft-primary and with packet16-primary on 16 times the pixels; judge what is marked. */
static found check(const scene *s, const bvh *tree, const scene_camera *camera, unsigned width, unsigned height, unsigned cull)
{
    char what[256];
    found n = {0};
    pixel_edges *edges = NULL;
    snprintf(what, sizeof what, "%.60s, %s, cull_backface %u", s->name, camera->name, cull);
    traced msaa = trace("mft-msaa", tree, camera, width, height, cull, NULL);
    traced primary = trace("mft-primary", tree, camera, width, height, cull, NULL);
    traced large = trace("packet16-primary", tree, camera, 4 * width, 4 * height, cull, NULL);
    assert_int_equal(pixel_edges_create(s, camera, width, height, cull, &edges, NULL), BASE_OK);
    for (unsigned y = 0; y < height; y++)
        for (unsigned x = 0; x < width; x++) {
            uint32_t a[4], b[4];
            read_pixel(msaa.job, x, y, a);
            read_pixel(primary.job, x, y, b);
            if (memcmp(a, b, sizeof a) != 0)
                fail_msg("%s, pixel %u %u: triangle %u, by mft-primary %u", what, x, y, a[0], b[0]);
            check_samples(msaa.job, large.job, x, y, what);
            judge_pixel(edges, msaa.job, large.job, x, y, &n);
        }
    assert_int_equal(msaa.counts.n[KERNEL_pixels_marked], n.marked);
    assert_int_equal(msaa.counts.n[KERNEL_units_msaa_frusta], n.marked);
    assert_int_equal(msaa.counts.n[KERNEL_rays_msaa], 16 * n.marked);
    assert_int_equal(msaa.counts.n[KERNEL_rays], (size_t)width * height + 16 * n.marked);
    pixel_edges_destroy(&edges);
    kernel_job_destroy(&msaa.job);
    kernel_job_destroy(&primary.job);
    kernel_job_destroy(&large.job);
    return n;
}

static scene *open_scene(const char *spec)
{
    scene *s = NULL;
    assert_int_equal(scene_open(spec, &s, NULL), BASE_OK);
    return s;
}

static void samples__hard_views__those_of_a_larger_picture(void **state)
{
    scene *s = open_scene("builtin:rooms-804");
    bvh *tree = trace_tree(s, 8);
    views v = views_of(s, 5);
    (void)state;
    for (size_t i = 0; i < v.count; i++)
        for (unsigned cull = 0; cull < 2; cull++)
            check(s, tree, &v.camera[i], 40, 35, cull);
    bvh_destroy(&tree);
    scene_destroy(&s);
}

static void samples__soups__those_of_a_larger_picture(void **state)
{
    static const double eye[3] = {0.3, 0.4, 4}, target[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    const scene_camera camera = scene_camera_look_at("from before", eye, target, up, 0.7);
    scene soups[] = {soup_random(1, 300, 0.5), soup_clustered(2, 500), soup_identical(40), soup_coplanar(3, 60), soup_needles(4, 60)};
    (void)state;
    for (size_t i = 0; i < sizeof soups / sizeof *soups; i++) {
        bvh *tree = trace_tree(&soups[i], 8);
        check(&soups[i], tree, &camera, 37, 33, i % 2);
        bvh_destroy(&tree);
        soup_free(&soups[i]);
    }
}

static void marks__builtin_scenes__every_edge_pixel(void **state)
{
    static const char *const specs[] = {"builtin:rooms-804", "builtin:hall-60k", "builtin:atrium-76k", "builtin:creature-69k"};
    (void)state;
    for (size_t i = 0; i < sizeof specs / sizeof *specs; i++) {
        scene *s = open_scene(specs[i]);
        bvh *tree = trace_tree(s, 8);
        for (unsigned cull = 0; cull < 2; cull++) {
            const found n = check(s, tree, &s->cameras[0], picture_size, picture_size, cull);
            print_message("# %s, cull_backface %u: %zu marked, %zu edge pixels, %zu missed, %zu intersections, precision %.3f\n", s->name,
                          cull, n.marked, n.edges, n.missed, n.intersections, (double)n.precise / (double)n.marked);
            assert_true(n.edges > 100);
            assert_true(MOST_MISSED * n.missed <= n.edges);
            assert_true(n.precise > n.marked / 2);
        }
        bvh_destroy(&tree);
        scene_destroy(&s);
    }
}

/* A scene of triangles over a list of vertices, seen by a camera at (x, y, 5) that looks at the middle. */
typedef struct mesh {
    const char *what;
    double x, y;
    float vertex[8][3];
    unsigned count;
    unsigned triangle[12][3];
    unsigned marked[2], unmarked[2]; /* a pixel of 64 x 64 that has to be marked, and one that must not */
} mesh;

#define BOX {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}

static const mesh meshes[] = {
    {"closed box seen from before", 0, 0, BOX, 12,
     {{4, 5, 6}, {4, 6, 7}, {1, 0, 3}, {1, 3, 2}, {5, 1, 2}, {5, 2, 6}, {0, 4, 7}, {0, 7, 3}, {7, 6, 2}, {7, 2, 3}, {0, 1, 5}, {0, 5, 4}},
     {6, 32}, {32, 31}},
    {"the same, some triangles turned over", 0, 0, BOX, 12,
     {{4, 6, 5}, {4, 6, 7}, {1, 3, 0}, {1, 3, 2}, {5, 1, 2}, {5, 6, 2}, {0, 4, 7}, {0, 7, 3}, {7, 6, 2}, {7, 2, 3}, {0, 1, 5}, {0, 5, 4}},
     {6, 32}, {32, 31}},
    {"border", 0, 0, {{-1, -1, 1}, {1, -1, 1}, {0, 1, 1}}, 1, {{0, 1, 2}}, {32, 57}, {32, 32}},
    {"edge of three triangles", 0, 0, {{0.03125f, -1, 1}, {0.03125f, 1, 1}, {-1, 0, 1}, {1, 0, 1}, {0.5f, 0, -1}}, 3,
     {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}, {32, 32}, {20, 32}},
    {"edge of a triangle seen edge-on", 0, 0, {{0.03125f, -1, 1}, {0.03125f, 1, 1}, {-1, 0, 1}, {0.0625f, 0, -3}}, 2,
     {{0, 1, 2}, {1, 0, 3}}, {32, 32}, {25, 32}},
    {"fold that both sides of are seen", 0.5, 0, {{0, -1, 1}, {0, 1, 1}, {-1, 0, 0.5f}, {1, 0, 0.5f}}, 2, {{0, 1, 2}, {1, 0, 3}}, {0, 0}, {29, 32}},
};

static scene scene_of(const mesh *m, float scale, float offset)
{
    scene s = soup_create(m->what, m->count);
    for (unsigned i = 0; i < m->count; i++)
        for (unsigned k = 0; k < 9; k++)
            s.triangles[i].v[k / 3][k % 3] = scale * m->vertex[m->triangle[i][k / 3]][k % 3] + offset;
    return s;
}

/* One mesh, scaled and then moved on all axes: where floats are exact, as at rest. */
static void check_mesh(const mesh *m, float scale, float offset)
{
    static const double up[3] = {0, 1, 0};
    const double s = (double)scale, o = (double)offset, eye[3] = {s * m->x + o, s * m->y + o, 5 * s + o}, target[3] = {o, o, o};
    const scene_camera camera = scene_camera_look_at(m->what, eye, target, up, 0.6);
    scene moved = scene_of(m, scale, offset);
    bvh *tree = trace_tree(&moved, 8);
    const found n = check(&moved, tree, &camera, 64, 64, 0);
    traced msaa = trace("mft-msaa", tree, &camera, 64, 64, 0, NULL);
    print_message("# %s, scale %g, offset %g: %zu marked, %zu edge pixels, %zu missed\n", m->what, s, o, n.marked, n.edges, n.missed);
    assert_int_equal(n.missed, 0);
    assert_true(n.edges > 20);
    if (m->marked[0] && !job_msaa_marked(msaa.job, m->marked[0], m->marked[1]))
        fail_msg("%s: pixel %u %u is not marked", m->what, m->marked[0], m->marked[1]);
    if (job_msaa_marked(msaa.job, m->unmarked[0], m->unmarked[1]))
        fail_msg("%s: pixel %u %u is marked", m->what, m->unmarked[0], m->unmarked[1]);
    kernel_job_destroy(&msaa.job);
    bvh_destroy(&tree);
    soup_free(&moved);
}

static void marks__meshes_b17__borders_non_manifold_and_edge_on(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof meshes / sizeof *meshes; i++) {
        check_mesh(&meshes[i], 1, 0);
        check_mesh(&meshes[i], 0x1p-13f, 0);
        check_mesh(&meshes[i], 0x1p13f, 0);
        check_mesh(&meshes[i], 1, 1024);
    }
}

static void params__marking_and_retrace__the_same_pixels_or_their_blocks(void **state)
{
    scene *s = open_scene("builtin:rooms-804");
    bvh *tree = trace_tree(s, 8);
    kernel_params params = kernel_find("mft-msaa")->defaults;
    (void)state;
    traced pixels = trace("mft-msaa", tree, &s->cameras[0], 70, 50, 0, &params);
    params.retrace = 0;
    traced only = trace("mft-msaa", tree, &s->cameras[0], 70, 50, 0, &params);
    params.marking = KERNEL_MARKING_BLOCK;
    traced blocks = trace("mft-msaa", tree, &s->cameras[0], 70, 50, 0, &params);
    for (unsigned y = 0; y < 50; y++)
        for (unsigned x = 0; x < 70; x++) {
            assert_int_equal(job_msaa_marked(pixels.job, x, y), job_msaa_marked(only.job, x, y));
            assert_true(job_msaa_marked(blocks.job, x, y) || !job_msaa_marked(pixels.job, x, y));
            assert_int_equal(job_msaa_marked(blocks.job, x, y), job_msaa_marked(blocks.job, x & ~3u, y & ~3u));
        }
    assert_int_equal(only.counts.n[KERNEL_rays_msaa], 0);
    assert_true(blocks.counts.n[KERNEL_pixels_marked] > pixels.counts.n[KERNEL_pixels_marked]);
    assert_true(pixels.counts.n[KERNEL_pixels_marked] > 0);
    kernel_job_destroy(&pixels.job);
    kernel_job_destroy(&only.job);
    kernel_job_destroy(&blocks.job);
    bvh_destroy(&tree);
    scene_destroy(&s);
}

static const float *vertex(const bvh_triangle *t, unsigned i)
{
    const float *v[3] = {t->v0, t->v1, t->v2};
    return v[i % 3];
}

static int alike(const float a[3], const float b[3]) { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; }

/* One edge, by trying all others. */
static void check_edge(const bvh *tree, const bvh_edges *edges, size_t i, unsigned edge, int one_sided)
{
    const bvh_edges *e = &edges[i];
    const float *a = vertex(&tree->records[i], edge), *b = vertex(&tree->records[i], edge + 1), *opposite = NULL;
    const float *stored[3] = {e->opposite0, e->opposite1, e->opposite2};
    size_t others = 0, first = i;
    int turned = 0;
    for (size_t k = 0; k < tree->record_count; k++)
        for (unsigned other = 0; other < 3; other++) {
            const float *from = vertex(&tree->records[k], other), *to = vertex(&tree->records[k], other + 1);
            const int same = alike(a, from) && alike(b, to), reverse = alike(a, to) && alike(b, from);
            if ((!same && !reverse) || (k == i && other == edge))
                continue;
            others++;
            first = k < first ? k : first;
            turned = same;
            opposite = vertex(&tree->records[k], other + 2);
        }
    const int joined = others == 1 && !(one_sided && turned);
    assert_int_equal(e->always >> (4 * edge) & 1, !joined);
    assert_int_equal(e->own >> (4 * edge) & 1, one_sided || first == i);
    if (joined)
        assert_true(alike(stored[edge], opposite));
    assert_int_equal((e->always | e->own) & ~0x111u, 0);
}

static void edges__of_a_scene__as_by_trying_all(void **state)
{
    scene *s = open_scene("builtin:rooms-804");
    (void)state;
    s->triangles[10] = s->triangles[11]; /* twice the same: edges of three */
    bvh *tree = trace_tree(s, 4);
    bvh_edges *edges = calloc(tree->record_count, sizeof *edges);
    assert_non_null(edges);
    for (int one_sided = 0; one_sided < 2; one_sided++) {
        assert_int_equal(bvh_edges_fill(tree, one_sided, edges, NULL), BASE_OK);
        for (size_t i = 0; i < tree->record_count; i++)
            for (unsigned edge = 0; edge < 3; edge++)
                check_edge(tree, edges, i, edge, one_sided);
    }
    free(edges);
    bvh_destroy(&tree);
    scene_destroy(&s);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edges__of_a_scene__as_by_trying_all),
        cmocka_unit_test(samples__hard_views__those_of_a_larger_picture),
        cmocka_unit_test(samples__soups__those_of_a_larger_picture),
        cmocka_unit_test(marks__meshes_b17__borders_non_manifold_and_edge_on),
        cmocka_unit_test(params__marking_and_retrace__the_same_pixels_or_their_blocks),
        cmocka_unit_test(marks__builtin_scenes__every_edge_pixel),
    };
    picture_size = argc > 1 ? (unsigned)atoi(argv[1]) : 128;
    return cmocka_run_group_tests_name("msaa", tests, NULL, NULL);
}
