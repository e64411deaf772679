#include "tests/kernels/trace.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/job_msaa.h"
#include "kernels/job_shadow.h"
#include "lrbni/base/hash.h"
#include "lrbni/base/parallel.h"

/* What a host thread gathers. */
typedef struct trace_worker {
    lrb_ctx *c;
    uint64_t ops[LRB_OP_COUNT], idle_lanes, events;
    uint64_t tile_hash; /* of the tile that is being traced */
} trace_worker;

typedef struct trace_run_state {
    const trace_request *request;
    const kernel_job *job;
    kernel_tile_fn *tile;
    trace_worker *workers;
    uint64_t *tile_hashes;
    kernel_counts *tile_counts;
    size_t pass; /* first tile of it */
} trace_run_state;

/* Hash of a stream in which an op stands as its name and form, not as its number: a new row of the table changes no hash. */
static uint64_t hash_events(uint64_t hash, const lrb_event *events, uint32_t count)
{
    static _Thread_local uint64_t names[LRB_OP_COUNT];
    for (int i = 0; names[LRB_OP_COUNT - 1] == 0 && i < LRB_OP_COUNT; i++)
        names[i] = base_hash(BASE_HASH_START, lrb_op_table[i].id, strlen(lrb_op_table[i].id));
    for (uint32_t i = 0; i < count; i++) {
        const uint64_t parts[] = {names[events[i].op & LRB_EVENT_ID] ^ (events[i].op & ~LRB_EVENT_ID),
                                  (uint64_t)events[i].mask << 32 | events[i].aux};
        hash = base_hash(hash, parts, sizeof parts);
        hash = base_hash(hash, events[i].src, sizeof events[i].src);
    }
    return hash;
}

static void take_events(void *user, const lrb_event *events, uint32_t count)
{
    trace_worker *w = user;
    for (uint32_t i = 0; i < count; i++) {
        lrb_op_id op = (lrb_op_id)(events[i].op & LRB_EVENT_ID);
        w->ops[op]++;
        if (lrb_op_kind_of(op) == LRB_KIND_VECTOR)
            w->idle_lanes += 16u - (unsigned)__builtin_popcount(events[i].mask);
    }
    w->events += count;
    w->tile_hash = hash_events(w->tile_hash, events, count);
}

static void trace_tile(void *user, size_t piece, unsigned worker)
{
    trace_run_state *r = user;
    trace_worker *w = &r->workers[worker];
    const size_t tile = r->pass + piece;
    w->tile_hash = BASE_HASH_START;
    lrb_ctx_begin(w->c);
    r->tile(w->c, r->job, (uint32_t)tile, &r->tile_counts[tile]);
    lrb_ctx_end(w->c);
    r->tile_hashes[tile] = w->tile_hash;
}

/* A hash of a pixel's samples; 0 for none. */
static uint32_t hash_samples(const kernel_job *job, unsigned x, unsigned y)
{
    unsigned row = 0;
    const job_frame_tile *samples = job_msaa_samples(job, x, y, &row);
    uint64_t hash = BASE_HASH_START;
    if (!samples)
        return 0;
    hash = base_hash(hash, samples->id[row], sizeof samples->id[row]);
    hash = base_hash(hash, samples->t[row], sizeof samples->t[row]);
    hash = base_hash(hash, samples->u[row], sizeof samples->u[row]);
    return (uint32_t)base_hash(hash, samples->v[row], sizeof samples->v[row]) | 1;
}

static void gather_pixels(const kernel_job *job, trace_picture *picture)
{
    picture->soft = job->rows_host != NULL;
    for (unsigned y = 0; y < picture->height; y++)
        for (unsigned x = 0; x < picture->width; x++) {
            size_t i = (size_t)y * picture->width + x;
            job_pixel p = kernel_job_pixel(job, x, y);
            const job_frame_tile *tile = &job->frame_host[p.tile];
            picture->id[i] = tile->id[p.block][p.pixel];
            picture->t[i] = tile->t[p.block][p.pixel];
            picture->u[i] = tile->u[p.block][p.pixel];
            picture->v[i] = tile->v[p.block][p.pixel];
            if (job->params.msaa)
                picture->occlusion[i] = hash_samples(job, x, y);
            if (job->shades_host)
                picture->lit[i] = job->shades_host[p.tile].shade[p.block][p.pixel];
            if (!job->shadows_host)
                continue;
            picture->occlusion[i] = job->shadows_host[p.tile].occlusion[p.block][p.pixel];
            picture->visibility[i] = job->shadows_host[p.tile].visibility[p.block][p.pixel];
            if (!picture->soft)
                continue;
            picture->filtered[i] = kernel_job_row(job, x, y)->filtered[x % 16];
            picture->lit[i] = kernel_job_row(job, x, y)->lit[x % 16];
        }
}

static void gather_worker(trace_picture *picture, const trace_worker *w, int level)
{
    for (int i = 0; i < LRB_OP_COUNT; i++)
        picture->ops[i] += level == LRB_RECORD ? w->ops[i] : w->c->ops[i];
    picture->idle_lanes += level == LRB_RECORD ? w->idle_lanes : w->c->idle_lanes;
    picture->events += w->events;
}

static void gather_tile(trace_picture *picture, const kernel_counts *tile)
{
    for (int i = 0; i < KERNEL_COUNTER_COUNT; i++)
        picture->counts.n[i] += tile->n[i];
}

trace_picture trace_picture_create(unsigned width, unsigned height)
{
    trace_picture p = {.width = width, .height = height, .pixels = (size_t)width * height};
    p.id = calloc(p.pixels, sizeof *p.id);
    p.t = calloc(p.pixels, sizeof *p.t);
    p.u = calloc(p.pixels, sizeof *p.u);
    p.v = calloc(p.pixels, sizeof *p.v);
    p.occlusion = calloc(p.pixels, sizeof *p.occlusion);
    p.visibility = calloc(p.pixels, sizeof *p.visibility);
    p.filtered = calloc(p.pixels, sizeof *p.filtered);
    p.lit = calloc(p.pixels, sizeof *p.lit);
    assert_true(p.id && p.t && p.u && p.v && p.occlusion && p.visibility && p.filtered && p.lit);
    return p;
}

kernel_job *trace_job(const trace_request *request)
{
    const kernel_info *kernel = kernel_find(request->kernel);
    base_error err = {0};
    kernel_job *job = NULL;
    assert_non_null(kernel);
    kernel_params params = request->params ? *request->params : kernel->defaults;
    params.cull_backface = request->cull;
    base_status status =
        kernel->accel == KERNEL_ACCEL_KDTREE
            ? kernel_job_create_kdtree(request->kdtree, request->camera, request->light, request->width, request->height, &params, &job, &err)
            : kernel_job_create(request->tree, request->camera, request->light, request->width, request->height, &params, &job, &err);
    if (status != BASE_OK)
        fail_msg("%s: %s", err.what, err.why);
    return job;
}

trace_picture trace_run(const trace_request *request)
{
    trace_picture picture = trace_picture_create(request->width, request->height);
    kernel_job *job = trace_job(request);
    trace_run_state r = {.request = request, .job = job, .tile = kernel_find(request->kernel)->tile[request->level]};
    picture.tiles = kernel_job_tiles(job);
    r.workers = calloc(request->jobs, sizeof *r.workers);
    r.tile_hashes = calloc(picture.tiles, sizeof *r.tile_hashes);
    r.tile_counts = picture.tile_counts = calloc(picture.tiles, sizeof *r.tile_counts);
    assert_true(r.workers && r.tile_hashes && r.tile_counts);
    for (unsigned i = 0; i < request->jobs; i++)
        assert_int_equal(lrb_ctx_create(take_events, &r.workers[i], &r.workers[i].c, NULL), BASE_OK);
    base_parallel_for(request->jobs, kernel_job_first_pass(job), trace_tile, &r);
    r.pass = kernel_job_first_pass(job);
    base_parallel_for(request->jobs, picture.tiles - r.pass, trace_tile, &r);
    picture.events_hash = base_hash(BASE_HASH_START, r.tile_hashes, picture.tiles * sizeof *r.tile_hashes);
    for (size_t i = 0; i < picture.tiles; i++)
        gather_tile(&picture, &picture.tile_counts[i]);
    for (unsigned i = 0; i < request->jobs; i++) {
        gather_worker(&picture, &r.workers[i], request->level);
        lrb_ctx_destroy(&r.workers[i].c);
    }
    gather_pixels(job, &picture);
    free(r.workers);
    free(r.tile_hashes);
    kernel_job_destroy(&job);
    return picture;
}

void trace_free(trace_picture *picture)
{
    free(picture->id);
    free(picture->t);
    free(picture->u);
    free(picture->v);
    free(picture->occlusion);
    free(picture->visibility);
    free(picture->filtered);
    free(picture->lit);
    free(picture->tile_counts);
    *picture = (trace_picture){0};
}

bvh *trace_tree(const scene *s, unsigned max_leaf)
{
    bvh_options options = bvh_options_default();
    base_error err = {0};
    bvh *tree = NULL;
    options.max_leaf = max_leaf;
    options.jobs = 2;
    if (bvh_build(s, &options, &tree, &err) != BASE_OK)
        fail_msg("%s: %s", err.what, err.why);
    return tree;
}

kdtree *trace_kdtree(const scene *s, const scene_camera *camera)
{
    kdtree_options options = kdtree_options_default();
    const scene_primary_rays rays = scene_camera_rays(camera, 1, 1);
    base_error err = {0};
    kdtree *tree = NULL;
    options.jobs = 2;
    if (kdtree_build(s, &options, &tree, &err) != BASE_OK)
        fail_msg("%s: %s", err.what, err.why);
    assert_int_equal(kdtree_mark_occluders(tree, &rays.origin, 1, true, NULL), BASE_OK);
    return tree;
}

trace_trees trace_trees_of(const kernel_info *kernel, const scene *s, const scene_camera *camera)
{
    trace_trees t = {0};
    if (kernel->accel == KERNEL_ACCEL_KDTREE)
        t.kdtree = trace_kdtree(s, camera);
    else
        t.tree = trace_tree(s, kernel->defaults.max_leaf);
    return t;
}

void trace_trees_destroy(trace_trees *t)
{
    bvh_destroy(&t->tree);
    kdtree_destroy(&t->kdtree);
}

void trace_rays(const bvh *tree, const scene_camera *camera, unsigned width, unsigned height, oracle_ray *rays)
{
    trace_request request = {.kernel = "packet16-primary", .tree = tree, .camera = camera, .width = width, .height = height};
    kernel_job *job = trace_job(&request);
    for (unsigned y = 0; y < height; y++)
        for (unsigned x = 0; x < width; x++) {
            oracle_ray *ray = &rays[(size_t)y * width + x];
            memcpy(ray->org, job->constants_host->origin_box, sizeof ray->org);
            kernel_job_direction(job, x, y, ray->dir);
            ray->tmin = 0.0f;
            ray->tmax = INFINITY;
        }
    kernel_job_destroy(&job);
}

void trace_shadow_rays(const trace_request *request, const trace_picture *picture, unsigned pass, oracle_ray *rays, uint32_t *taken)
{
    kernel_job *job = trace_job(request);
    const job_light *light = &job->constants_host->light;
    memset(rays, 0, 16 * picture->pixels * sizeof *rays);
    for (size_t i = 0; i < picture->pixels; i++) {
        unsigned x = (unsigned)(i % picture->width), y = (unsigned)(i / picture->width);
        job_pixel p = kernel_job_pixel(job, x, y);
        job->frame_host[p.tile].id[p.block][p.pixel] = picture->id[i];
        job->frame_host[p.tile].t[p.block][p.pixel] = picture->t[i];
        taken[i] = job->sample_mask;
        for (unsigned sample = 0; sample < 16; sample++) {
            job_shadow_ray ray;
            if (!job_shadow_ray_of(job, x, y, pass, sample, &ray)) {
                taken[i] = 0;
                break;
            }
            oracle_ray *out = &rays[16 * i + sample];
            memcpy(out->org, ray.org, sizeof out->org);
            memcpy(out->dir, ray.dir, sizeof out->dir);
            out->tmin = light->nearest;
            out->tmax = light->farthest;
        }
    }
    kernel_job_destroy(&job);
}

oracle_hit trace_hit(const trace_picture *picture, size_t pixel)
{
    return (oracle_hit){
        .id = picture->id[pixel],
        .t = (double)picture->t[pixel],
        .u = (double)picture->u[pixel],
        .v = (double)picture->v[pixel],
    };
}

static int pixel_equal(const trace_picture *a, const trace_picture *b, size_t i)
{
    return a->id[i] == b->id[i] && memcmp(&a->t[i], &b->t[i], 4) == 0 && memcmp(&a->u[i], &b->u[i], 4) == 0 &&
           memcmp(&a->v[i], &b->v[i], 4) == 0 && a->occlusion[i] == b->occlusion[i] &&
           memcmp(&a->visibility[i], &b->visibility[i], 4) == 0 && memcmp(&a->filtered[i], &b->filtered[i], 4) == 0 &&
           memcmp(&a->lit[i], &b->lit[i], 4) == 0;
}

trace_difference trace_compare(const trace_picture *a, const trace_picture *b)
{
    trace_difference d = {.first = SIZE_MAX};
    assert_true(a->width == b->width && a->height == b->height);
    for (size_t i = 0; i < a->pixels; i++)
        if (!pixel_equal(a, b, i)) {
            if (d.count++ == 0)
                d.first = i;
        }
    return d;
}

void trace_assert_equal(const trace_picture *a, const trace_picture *b, const char *what)
{
    trace_difference d = trace_compare(a, b);
    size_t i = d.first;
    if (d.count)
        fail_msg("%s: %zu of %zu pixels differ, first (%zu,%zu): id %u t %a u %a v %a blocked %x against id %u t %a u %a v %a blocked %x",
                 what, d.count, a->pixels, i % a->width, i / a->width, a->id[i], (double)a->t[i], (double)a->u[i], (double)a->v[i],
                 a->occlusion[i], b->id[i], (double)b->t[i], (double)b->u[i], (double)b->v[i], b->occlusion[i]);
}

uint64_t trace_hash(const trace_picture *picture)
{
    uint64_t hash = base_hash(BASE_HASH_START, picture->id, picture->pixels * sizeof *picture->id);
    hash = base_hash(hash, picture->t, picture->pixels * sizeof *picture->t);
    hash = base_hash(hash, picture->u, picture->pixels * sizeof *picture->u);
    hash = base_hash(hash, picture->v, picture->pixels * sizeof *picture->v);
    if (!picture->counts.n[KERNEL_rays_shadow] && !picture->counts.n[KERNEL_rays_msaa])
        return hash;
    hash = base_hash(hash, picture->occlusion, picture->pixels * sizeof *picture->occlusion);
    hash = base_hash(hash, picture->visibility, picture->pixels * sizeof *picture->visibility);
    if (!picture->soft)
        return hash;
    hash = base_hash(hash, picture->filtered, picture->pixels * sizeof *picture->filtered);
    return base_hash(hash, picture->lit, picture->pixels * sizeof *picture->lit);
}
