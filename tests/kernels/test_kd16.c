/* The kernels on the kd-tree: kd16-primary hits what packet16-primary hits through the BVH, bit for bit, and mlrta-primary
 * what kd16-primary does, whatever its parameters (oracle O3; packet16-primary is judged by Embree and exact arithmetic in
 * kernels/agreement). Hard cases C1 to C3, C6, C11, C12.
 *
 * usage: test_kd16 SIZE [FILES]: pictures are about SIZE x SIZE; FILES: also the files in $LANETRACE_SCENES
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
#include "tests/kernels/accel/soup.h"
#include "tests/kernels/trace.h"
#include "tests/kernels/views.h"

enum { JOBS = 2 };

static unsigned picture_size;
static int with_files;

/* A scene with both trees, and a request to fill in further. */
typedef struct stage {
    scene *s;
    bvh *tree;
    kdtree *kdtree;
} stage;

static stage stage_create(const char *spec)
{
    stage st = {0};
    base_error err = {0};
    if (scene_open(spec, &st.s, &err) != BASE_OK)
        fail_msg("%s: %s", err.what, err.why);
    st.tree = trace_tree(st.s, 2);
    st.kdtree = trace_kdtree(st.s, &st.s->cameras[0]);
    return st;
}

static void stage_destroy(stage *st)
{
    bvh_destroy(&st->tree);
    kdtree_destroy(&st->kdtree);
    scene_destroy(&st->s);
}

static trace_picture run(const stage *st, const char *kernel, const scene_camera *camera, unsigned cull, const kernel_params *params)
{
    trace_request request = {.kernel = kernel, .tree = st->tree, .kdtree = st->kdtree, .camera = camera, .width = picture_size,
                             .height = picture_size - picture_size / 7, .cull = cull, .params = params, .light = &st->s->light,
                             .level = LRB_NATIVE, .jobs = JOBS};
    return trace_run(&request);
}

static uint64_t of(const trace_picture *p, kernel_counter counter) { return p->counts.n[counter]; }

/* With a mailbox and without one: the tests that it saves are its hits. */
static void check_mailbox(const stage *st, const scene_camera *camera, const trace_picture *with, const char *what)
{
    kernel_params params = kernel_find("kd16-primary")->defaults;
    params.mailbox = 0;
    trace_picture without = run(st, "kd16-primary", camera, 0, &params);
    trace_assert_equal(with, &without, what);
    assert_int_equal(of(&without, KERNEL_mailbox_hits), 0);
    assert_int_equal(of(&without, KERNEL_tri_accesses), of(with, KERNEL_tri_accesses) + of(with, KERNEL_mailbox_hits));
    assert_int_equal(of(&without, KERNEL_traversed_cells), of(with, KERNEL_traversed_cells));
    trace_free(&without);
}

/* Entry points may save tests and cells of packets, never add them: what is more is the search. */
static void check_counts(const trace_picture *root, const trace_picture *entry, const char *what)
{
    uint64_t packets_cells = of(entry, KERNEL_traversed_cells) - of(entry, KERNEL_ep_cells);
    assert_int_equal(of(entry, KERNEL_rays), of(root, KERNEL_rays));
    assert_int_equal(of(entry, KERNEL_units_packets), of(root, KERNEL_units_packets));
    if (of(entry, KERNEL_isect_tests) > of(root, KERNEL_isect_tests) || packets_cells > of(root, KERNEL_traversed_cells))
        fail_msg("%s: %llu tests and %llu cells from entry points, %llu and %llu from the root", what,
                 (unsigned long long)of(entry, KERNEL_isect_tests), (unsigned long long)packets_cells,
                 (unsigned long long)of(root, KERNEL_isect_tests), (unsigned long long)of(root, KERNEL_traversed_cells));
}

/* Empty occluders end searches early, and no hit is lost. */
static void check_occluders(const stage *st, const scene_camera *camera, unsigned cull, const trace_picture *root, const char *what)
{
    kernel_params params = kernel_find("mlrta-primary")->defaults;
    params.empty_occluders = 1;
    trace_picture entry = run(st, "mlrta-primary", camera, cull, &params);
    trace_assert_equal(root, &entry, what);
    check_counts(root, &entry, what);
    trace_free(&entry);
}

static void check_view(stage *st, const scene_camera *camera, unsigned cull)
{
    char what[256];
    const scene_primary_rays rays = scene_camera_rays(camera, 1, 1);
    assert_int_equal(kdtree_mark_occluders(st->kdtree, &rays.origin, 1, cull, NULL), BASE_OK);
    snprintf(what, sizeof what, "%.60s, %s, cull_backface %u", st->s->name, camera->name, cull);
    trace_picture packets = run(st, "packet16-primary", camera, cull, NULL), root = run(st, "kd16-primary", camera, cull, NULL);
    trace_picture entry = run(st, "mlrta-primary", camera, cull, NULL);
    trace_assert_equal(&packets, &root, what);
    trace_assert_equal(&root, &entry, what);
    check_counts(&root, &entry, what);
    check_occluders(st, camera, cull, &root, what);
    if (!cull)
        check_mailbox(st, camera, &root, what);
    trace_free(&packets);
    trace_free(&root);
    trace_free(&entry);
}

static void check_scene(const char *spec)
{
    stage st = stage_create(spec);
    views v = views_of(st.s, st.s->triangle_count);
    for (size_t i = 0; i < v.count; i++)
        check_view(&st, &v.camera[i], (unsigned)(i % 2));
    stage_destroy(&st);
}

static void check_files(void)
{
    const char *folder = getenv("LANETRACE_SCENES");
    DIR *d = folder ? opendir(folder) : NULL;
    struct dirent *e;
    if (!d) {
        print_message("# skipped: real scenes: LANETRACE_SCENES is no folder\n"); /* cmocka's skip() would print "not ok" */
        return;
    }
    while ((e = readdir(d)) != NULL) {
        char spec[4096];
        size_t length = strlen(e->d_name);
        if (length < 4 || strcmp(e->d_name + length - 4, ".glb") != 0)
            continue;
        snprintf(spec, sizeof spec, "%s/%s", folder, e->d_name);
        check_scene(spec);
    }
    closedir(d);
}

static void kd16__scenes_hard_views__same_hits_through_all_trees(void **state)
{
    size_t scenes;
    const char *const *spec = scene_builtin_usual(&scenes);
    (void)state;
    for (size_t i = 0; i < scenes; i++)
        check_scene(spec[i]);
    if (with_files)
        check_files();
}

/* A camera on a plane of the tree, on a line where two meet, on a point where three do (C2), looking along an axis or not (C3). */
static void kd16__camera_on_planes__same_hits(void **state)
{
    static const double up[3] = {0.1, 1, 0.2};
    stage st = stage_create("builtin:rooms-804");
    const kdtree_node *node = st.kdtree->nodes;
    double position[3];
    (void)state;
    memcpy(position, st.s->cameras[0].position, sizeof position);
    for (int step = 0; step < 12 && !kdtree_is_leaf(node); step++) {
        const unsigned axis = node->link & KDTREE_KIND;
        position[axis] = (double)node->split;
        for (int along = 0; along < 6; along++) {
            double target[3] = {position[0], position[1], position[2]};
            target[along % 3] += 1;
            if (along >= 3)
                target[(along + 1) % 3] -= 0.7;
            scene_camera camera = scene_camera_look_at("on planes", position, target, up, 1.2);
            check_view(&st, &camera, 0);
        }
        node = kdtree_children(st.kdtree, node) + step % 2;
    }
    stage_destroy(&st);
}

/* Sizes that are no multiple of a tile's or a packet's, every size of tile and way of splitting, culling and ending (C11, C12). */
static void mlrta__every_parameter__hits_from_the_root(void **state)
{
    stage st = stage_create("builtin:rooms-804");
    const scene_camera *camera = &st.s->cameras[0];
    trace_picture root = run(&st, "kd16-primary", camera, 0, NULL);
    const kernel_info *kernel = kernel_find("mlrta-primary");
    (void)state;
    for (unsigned i = 0; i < 5 * 2 * 7 * 16; i++) {
        kernel_params p = kernel->defaults;
        char what[128];
        unsigned rest = i;
        p.its = rest % 5, rest /= 5;
        p.sf = rest % 2, rest /= 2;
        p.mts = rest % 7, rest /= 7;
        p.culling = rest & 1 ? KERNEL_CULL_DIRECT : KERNEL_CULL_INVERSE;
        p.divergent = rest >> 1 & 1;
        p.divergent_packets = rest >> 2 & 1;
        p.ends = rest >> 3 & 1;
        if (p.mts > p.its + 2 || i % 3)
            continue;
        snprintf(what, sizeof what, "its %u sf %u mts %u culling %u divergent %u packets %u ends %u", 16u << p.its, 4u << 2 * p.sf, 4u << p.mts,
                 p.culling, p.divergent, p.divergent_packets, p.ends);
        trace_picture entry = run(&st, "mlrta-primary", camera, 0, &p);
        trace_assert_equal(&root, &entry, what);
        if (p.divergent_packets == KERNEL_PACKETS_OCTANTS)
            check_counts(&root, &entry, what);
        trace_free(&entry);
    }
    trace_free(&root);
    stage_destroy(&st);
}

/* Corner rays alone tell nothing of the rays between them (C6): the same test has to find that. */
static void mlrta__corner_rays_only__hits_are_lost(void **state)
{
    stage st = stage_create("builtin:rooms-804");
    kernel_params p = kernel_find("mlrta-primary")->defaults;
    (void)state;
    p.culling = KERNEL_CULL_CORNER_RAYS;
    trace_picture root = run(&st, "kd16-primary", &st.s->cameras[0], 0, NULL);
    trace_picture entry = run(&st, "mlrta-primary", &st.s->cameras[0], 0, &p);
    assert_true(trace_compare(&root, &entry).count > 0);
    trace_free(&root);
    trace_free(&entry);
    stage_destroy(&st);
}

/* What blocks the way from the light to a lifted hit point, in double: 1 for sure, 0 for sure not, -1: too close to call. */
static int blocked(const scene *s, const double light[3], const double d[3])
{
    int answer = 0;
    for (size_t i = 0; i < s->triangle_count; i++) {
        double a[3][3], volume[3], sum = 0, n[3], na = 0, least = HUGE_VAL, most = -HUGE_VAL, size = 0;
        for (int v = 0; v < 3; v++)
            for (int k = 0; k < 3; k++)
                a[v][k] = (double)s->triangles[i].v[v][k] - light[k];
        for (int v = 0; v < 3; v++) {
            const double *p = a[(v + 1) % 3], *q = a[(v + 2) % 3];
            volume[v] = 0;
            for (int k = 0; k < 3; k++) {
                double cross = p[(k + 1) % 3] * q[(k + 2) % 3] - p[(k + 2) % 3] * q[(k + 1) % 3];
                volume[v] += cross * d[k];
                size = fmax(size, fabs(cross * d[k]));
            }
            sum += volume[v];
            least = fmin(least, volume[v]);
            most = fmax(most, volume[v]);
        }
        if (least < -1e-6 * size && most > 1e-6 * size)
            continue; /* outside an edge */
        for (int k = 0; k < 3; k++) {
            int u = (k + 1) % 3, v = (k + 2) % 3;
            n[k] = (a[1][u] - a[0][u]) * (a[2][v] - a[0][v]) - (a[1][v] - a[0][v]) * (a[2][u] - a[0][u]);
            na += n[k] * a[0][k];
        }
        double t = na / (n[0] * d[0] + n[1] * d[1] + n[2] * d[2]);
        if (fabs(sum) > 1e-5 * size && (t < 0 || t > 1.00001))
            continue;
        if (fabs(sum) > 1e-5 * size && fmin(fabs(least), fabs(most)) > 1e-6 * size && t > 1e-3 && t < 0.999)
            return 1;
        answer = -1;
    }
    return answer;
}

/* How far hit points are lifted off their surfaces: a ten-thousandth of the scene's diagonal (docs/kernels-mlrta.md). */
static double lift_of(const kdtree *tree)
{
    double sum = 0;
    for (int axis = 0; axis < 3; axis++)
        sum += ((double)tree->max[axis] - (double)tree->min[axis]) * ((double)tree->max[axis] - (double)tree->min[axis]);
    return 1e-4 * sqrt(sum);
}

/* The shadows of a picture against double arithmetic; returns how many pixels were decided. */
static size_t check_shadows(const stage *st, const trace_picture *p, const scene_camera *camera)
{
    oracle_ray *rays = calloc(p->pixels, sizeof *rays);
    const double lift = lift_of(st->kdtree);
    size_t decided = 0;
    assert_non_null(rays);
    trace_rays(st->tree, camera, p->width, p->height, rays);
    for (size_t i = 0; i < p->pixels; i++) {
        double d[3], n[3], height = 0, facing = 0, length = 0, light[3];
        if (p->id[i] == JOB_NO_HIT) {
            assert_true(p->visibility[i] == 1.0f);
            continue;
        }
        const scene_triangle *t = &st->s->triangles[p->id[i]];
        for (int k = 0; k < 3; k++) {
            int u = (k + 1) % 3, v = (k + 2) % 3;
            light[k] = (double)(float)st->s->light.point[k];
            n[k] = ((double)t->v[1][u] - (double)t->v[0][u]) * ((double)t->v[2][v] - (double)t->v[0][v]) -
                   ((double)t->v[1][v] - (double)t->v[0][v]) * ((double)t->v[2][u] - (double)t->v[0][u]);
            length += n[k] * n[k];
            facing += n[k] * (double)rays[i].dir[k];
        }
        for (int k = 0; k < 3; k++) {
            n[k] *= (facing > 0 ? -1 : 1) / sqrt(length);
            d[k] = (double)rays[i].org[k] + (double)p->t[i] * (double)rays[i].dir[k] + lift * n[k] - light[k];
            height += n[k] * d[k];
        }
        int dark = height > -1e-3 ? (height > 1e-3 ? 1 : -1) : blocked(st->s, light, d);
        if (dark < 0)
            continue;
        if ((p->visibility[i] == 0.0f) != dark)
            fail_msg("pixel (%zu,%zu): visibility %g, but %s", i % p->width, i / p->width, (double)p->visibility[i],
                     dark ? "something is in the way" : "nothing is in the way");
        decided++;
    }
    free(rays);
    return decided;
}

/* A kernel's picture in tiles of 16x16 pixels, with no shadow ray done with early. */
static trace_picture run_tiles(const stage *st, const char *kernel, const scene_camera *camera, unsigned packets)
{
    kernel_params p = kernel_find(kernel)->defaults;
    p.its = 0;
    p.early_termination = 0;
    p.shadow_packets = packets;
    return run(st, kernel, camera, 0, &p);
}

/* Tests of the shadow rays alone of one tile. */
static uint64_t shadow_tests(const trace_picture *shadow, const trace_picture *primary, size_t tile)
{
    return shadow->tile_counts[tile].n[KERNEL_isect_tests] - primary->tile_counts[tile].n[KERNEL_isect_tests];
}

/* Shadow rays that all go on to their ends are blocked as those that are done with early, `expected`; and what a packet tests from its
   entry point it tests from the root, tile by tile. Returns the tests from the root, of primary rays too. */
static uint64_t check_shadow_tests(const stage *st, const scene_camera *camera, unsigned packets, const trace_picture *expected)
{
    trace_picture primary[2] = {run_tiles(st, "kd16-primary", camera, packets), run_tiles(st, "mlrta-primary", camera, packets)};
    trace_picture shadow[2] = {run_tiles(st, "kd16-shadow", camera, packets), run_tiles(st, "mlrta-shadow", camera, packets)};
    assert_int_equal(shadow[0].tiles, shadow[1].tiles);
    for (size_t tile = 0; tile < shadow[0].tiles; tile++) {
        const uint64_t root = shadow_tests(&shadow[0], &primary[0], tile), entry = shadow_tests(&shadow[1], &primary[1], tile);
        if (entry > root)
            fail_msg("%s, %s, packets %u, tile %zu: %llu tests of shadow rays from the entry point, %llu from the root", st->s->name,
                     camera->name, packets, tile, (unsigned long long)entry, (unsigned long long)root);
    }
    const uint64_t tests = of(&shadow[0], KERNEL_isect_tests);
    for (int way = 0; way < 2; way++) {
        trace_assert_equal(expected, &shadow[way], "shadow rays that go on");
        trace_free(&primary[way]);
        trace_free(&shadow[way]);
    }
    return tests;
}

/* Hard shadows: what is in the way according to double arithmetic, whatever goes together in a packet and wherever it starts (C14). */
static void shadows__of_a_room__as_by_brute_force(void **state)
{
    stage st = stage_create("builtin:rooms-804");
    const scene_camera *camera = &st.s->cameras[0];
    kernel_params p = kernel_find("kd16-shadow")->defaults;
    trace_picture root = run(&st, "kd16-shadow", camera, 0, &p);
    (void)state;
    assert_true(check_shadows(&st, &root, camera) > root.pixels / 2);
    assert_true(of(&root, KERNEL_rays_shadow) > 0);
    for (unsigned packets = 0; packets < 3; packets++) {
        p.shadow_packets = packets;
        trace_picture other = run(&st, "kd16-shadow", camera, 0, &p);
        trace_assert_equal(&root, &other, "packets of shadow rays");
        kernel_params m = kernel_find("mlrta-shadow")->defaults;
        m.shadow_packets = packets;
        trace_picture entry = run(&st, "mlrta-shadow", camera, 0, &m);
        trace_assert_equal(&root, &entry, "entry points of shadow rays");
        assert_true(of(&entry, KERNEL_isect_tests) <= of(&other, KERNEL_isect_tests));
        assert_int_equal(of(&entry, KERNEL_rays), of(&root, KERNEL_rays));
        assert_true(check_shadow_tests(&st, camera, packets, &other) > of(&other, KERNEL_isect_tests));
        trace_free(&other);
        trace_free(&entry);
    }
    trace_free(&root);
    stage_destroy(&st);
}

/* Over scenes and hard views: entry points change no shadow, and add no test. */
static void shadows__usual_scenes_hard_views__same_from_entry_points(void **state)
{
    size_t scenes;
    const char *const *spec = scene_builtin_usual(&scenes);
    (void)state;
    for (size_t i = 0; i < scenes; i++) {
        stage st = stage_create(spec[i]);
        views v = views_of(st.s, 1);
        for (size_t k = 0; k < v.count; k += 3) {
            float origins[2][3];
            const scene_primary_rays rays = scene_camera_rays(&v.camera[k], 1, 1);
            for (int axis = 0; axis < 3; axis++) {
                origins[0][axis] = rays.origin[axis];
                origins[1][axis] = (float)st.s->light.point[axis];
            }
            assert_int_equal(kdtree_mark_occluders(st.kdtree, (const float(*)[3])origins, 2, false, NULL), BASE_OK);
            trace_picture root = run(&st, "kd16-shadow", &v.camera[k], 0, NULL), entry = run(&st, "mlrta-shadow", &v.camera[k], 0, NULL);
            trace_assert_equal(&root, &entry, v.camera[k].name);
            check_shadow_tests(&st, &v.camera[k], (unsigned)(k / 3 % 3), &root);
            trace_free(&root);
            trace_free(&entry);
        }
        stage_destroy(&st);
    }
}

/* The job of mlrta-primary on a scene, with its whole picture traced. */
static kernel_job *traced_job(const kdtree *tree, const scene_camera *camera, unsigned its)
{
    kernel_params p = kernel_find("mlrta-primary")->defaults;
    lrb_ctx *c;
    p.its = its;
    kernel_job *job = trace_job(&(trace_request){.kernel = "mlrta-primary", .kdtree = tree, .camera = camera, .width = picture_size,
                                                 .height = picture_size, .params = &p});
    assert_int_equal(lrb_ctx_create(NULL, NULL, &c, NULL), BASE_OK);
    for (uint32_t tile = 0; tile < kernel_job_tiles(job); tile++) {
        kernel_counts n = {{0}};
        kernel_find("mlrta-primary")->tile[LRB_NATIVE](c, job, tile, &n);
    }
    lrb_ctx_destroy(&c);
    return job;
}

/* A room: what a packet sees is no more complex than the tree, and something where it has hit anything. */
static void complexity__of_a_room__at_most_the_tree(void **state)
{
    stage st = stage_create("builtin:rooms-804");
    kernel_job *job = traced_job(st.kdtree, &st.s->cameras[0], 3);
    unsigned smaller = 0;
    (void)state;
    for (unsigned i = 0; i < picture_size * picture_size; i++) {
        const uint32_t nodes = kernel_job_complexity(job, i % picture_size, i / picture_size);
        const job_pixel p = kernel_job_pixel(job, i % picture_size, i / picture_size);
        assert_true(nodes <= st.kdtree->sizes[0]);
        assert_true(nodes > 0 || job->frame_host[p.tile].id[p.block][p.pixel] == JOB_NO_HIT);
        smaller += nodes < st.kdtree->sizes[0];
    }
    assert_true(smaller > picture_size * picture_size / 4);
    kernel_job_destroy(&job);
    stage_destroy(&st);
}

/* A wall that all rays hit, much behind it: a leaf is all that is seen, but of a tile that meets the wall in several cells. Without the
   wall there are tiles that see more; away from all nothing is seen. */
static void complexity__wall_no_wall_nothing__mostly_leaves_more_none(void **state)
{
    static const double up[3] = {0, 1, 0}, eye[3] = {0.1, 0.2, 4}, ahead[3] = {1, 2, 0}, away[3] = {1, 2, 8};
    scene s = soup_random(7, 60, 0.5), wall = soup_random(7, 61, 0.5);
    const scene_camera to = scene_camera_look_at("to", eye, ahead, up, 0.3), from = scene_camera_look_at("from", eye, away, up, 0.3);
    const float corners[3][3] = {{-90, -60, 2}, {90, -60, 2}, {0, 90, 2}};
    const struct {
        const scene *s;
        const scene_camera *camera;
        unsigned least;
    } cases[3] = {{&wall, &to, 1}, {&s, &to, 0}, {&s, &from, 0}};
    unsigned leaves[3] = {0, 0, 0}, larger[3] = {0, 0, 0};
    (void)state;
    memcpy(wall.triangles[60].v, corners, sizeof corners);
    for (int i = 0; i < 3; i++) {
        kdtree *tree = trace_kdtree(cases[i].s, cases[i].camera);
        kernel_job *job = traced_job(tree, cases[i].camera, 0);
        for (unsigned k = 0; k < picture_size * picture_size; k++) {
            const uint32_t nodes = kernel_job_complexity(job, k % picture_size, k / picture_size);
            assert_in_range(nodes, cases[i].least, UINT32_MAX);
            leaves[i] += nodes == 1;
            larger[i] += nodes > 1;
        }
        kernel_job_destroy(&job);
        kdtree_destroy(&tree);
    }
    assert_true(leaves[0] > picture_size * picture_size / 2 && larger[1] > 0 && larger[2] + leaves[2] == 0);
    soup_free(&s);
    soup_free(&wall);
}

/* The levels and any number of host threads agree, counts and events too; each unit of work is on its own. */
static void mlrta__levels_and_threads__same_results(void **state)
{
    static const char *names[4] = {"kd16-primary", "mlrta-primary", "kd16-shadow", "mlrta-shadow"};
    stage st = stage_create("builtin:rooms-804");
    (void)state;
    for (int k = 0; k < 4; k++) {
        kernel_params p = kernel_find(names[k])->defaults;
        p.its = k % 2; /* 32 */
        p.early_termination = k < 3;
        trace_picture got[5];
        for (int i = 0; i < 5; i++) {
            static const int levels[5] = {LRB_NATIVE, LRB_COUNT, LRB_RECORD, LRB_RECORD, LRB_TOUCH};
            trace_request request = {.kernel = names[k], .kdtree = st.kdtree, .camera = &st.s->cameras[0], .width = 75, .height = 70,
                                     .params = &p, .light = &st.s->light, .level = levels[i], .jobs = i == 3 ? 3 : 1};
            got[i] = trace_run(&request);
            trace_assert_equal(&got[0], &got[i], names[k]);
            assert_memory_equal(&got[0].counts, &got[i].counts, sizeof got[0].counts);
        }
        for (int op = 0; op < LRB_OP_COUNT; op++) /* markers are recorded, not counted */
            assert_true(got[1].ops[op] == got[2].ops[op] || lrb_op_kind_of((lrb_op_id)op) == LRB_KIND_MARKER);
        assert_int_equal(got[1].idle_lanes, got[2].idle_lanes);
        assert_int_equal(got[2].events_hash, got[3].events_hash);
        for (int i = 0; i < 5; i++)
            trace_free(&got[i]);
    }
    stage_destroy(&st);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kd16__scenes_hard_views__same_hits_through_all_trees),
        cmocka_unit_test(kd16__camera_on_planes__same_hits),
        cmocka_unit_test(mlrta__every_parameter__hits_from_the_root),
        cmocka_unit_test(mlrta__corner_rays_only__hits_are_lost),
        cmocka_unit_test(shadows__of_a_room__as_by_brute_force),
        cmocka_unit_test(shadows__usual_scenes_hard_views__same_from_entry_points),
        cmocka_unit_test(complexity__of_a_room__at_most_the_tree),
        cmocka_unit_test(complexity__wall_no_wall_nothing__mostly_leaves_more_none),
        cmocka_unit_test(mlrta__levels_and_threads__same_results),
    };
    picture_size = argc > 1 ? (unsigned)strtoul(argv[1], NULL, 10) : 100;
    with_files = argc > 2;
    return cmocka_run_group_tests_name("kernels/kd16", tests, NULL, NULL);
}
