#include "tests/hard/bundle.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

bundle bundle_create(const char *kernel, const bvh *tree, int cull)
{
    static const double eye[3] = {0, 0, 0}, forward[3] = {0, 0, -1}, up[3] = {0, 1, 0};
    const kernel_info *info = kernel_find(kernel);
    bundle b = {.tree = tree, .cull = cull, .tile = info->tile[LRB_NATIVE]};
    kernel_params params = info->defaults;
    base_error err = {0};
    /* a quarter turn: the directions up to a tile beyond the image, for which margins are made, are up to 4.3 long */
    scene_camera camera = scene_camera_look_at("bundle", eye, forward, up, 1.57079632679489661923);
    params.cull_backface = (unsigned)cull;
    if (kernel_job_create(tree, &camera, NULL, 16, 16, &params, &b.job, &err) != BASE_OK ||
        lrb_ctx_create(NULL, NULL, &b.c, &err) != BASE_OK)
        fail_msg("%s: %s", err.what, err.why);
    return b;
}

void bundle_destroy(bundle *b)
{
    lrb_ctx_destroy(&b->c);
    kernel_job_destroy(&b->job);
}

static void set_origin(bundle *b, const float origin[3])
{
    job_constants *k = b->job->constants_host;
    for (int i = 0; i < 16; i++) {
        float x = (i & 3) < 3 ? origin[i & 3] : 0.0f;
        k->origin_box[i] = x;
        k->origin_triangle[i] = i < 12 ? x : 0.0f;
    }
}

static void set_masks(bundle *b, unsigned blocks, unsigned pixels)
{
    job_tile *t = b->job->tiles_host;
    t->blocks = blocks;
    for (unsigned f = 0; f < 16; f++)
        t->pixels[f] = (uint16_t)(blocks >> f & 1 ? pixels : 0);
}

static void assert_length(const float d[3])
{
    float square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    assert_true(!(square > 1.001f * BUNDLE_LONGEST * BUNDLE_LONGEST));
}

void bundle_rays(bundle *b, const float origin[3], float d[16][3], unsigned mask)
{
    job_constants *k = b->job->constants_host;
    set_origin(b, origin);
    set_masks(b, 1, mask);
    for (int axis = 0; axis < 3; axis++) {
        k->d00[axis] = k->dx[axis] = k->dy[axis] = 0.0f;
        for (int j = 0; j < 16; j++)
            k->delta[axis][j] = d[j][axis];
    }
    for (int j = 0; j < 16; j++)
        if (mask >> j & 1)
            assert_length(d[j]);
}

void bundle_grid(bundle *b, const float origin[3], const float first[3], const float right[3], const float down[3], unsigned mask)
{
    job_constants *k = b->job->constants_host;
    set_origin(b, origin);
    set_masks(b, mask, 0xffff);
    for (int axis = 0; axis < 3; axis++) {
        k->d00[axis] = first[axis];
        k->dx[axis] = right[axis];
        k->dy[axis] = down[axis];
        for (int j = 0; j < 16; j++) {
            float x = (float)(j & 3) * right[axis], y = (float)(j >> 2) * down[axis];
            k->delta[axis][j] = x + y;
        }
    }
    for (unsigned f = 0; f < 16; f++) {
        float d[3];
        bundle_direction(b, f, f == 0 ? 0 : f == 3 ? 3 : f == 12 ? 12 : 15, d);
        assert_length(d);
    }
}

kernel_counts bundle_trace(bundle *b)
{
    kernel_counts n = {{0}};
    lrb_ctx_begin(b->c);
    b->tile(b->c, b->job, 0, &n);
    lrb_ctx_end(b->c);
    return n;
}

void bundle_direction(const bundle *b, unsigned block, unsigned pixel, float out[3])
{
    kernel_job_direction(b->job, 4 * (block & 3) + (pixel & 3), 4 * (block >> 2) + (pixel >> 2), out);
}

twin_hit bundle_brute_force(const bundle *b, unsigned block, unsigned pixel)
{
    const job_constants *k = b->job->constants_host;
    twin_hit best = twin_hit_none();
    float d[3];
    bundle_direction(b, block, pixel, d);
    for (size_t i = 0; i < b->tree->record_count; i++) {
        twin_triangle t = twin_triangle_of(&b->tree->records[i], k->origin_box, 0.5f * k->slack);
        twin_intersect(&t, b->cull, d, &best);
    }
    return best;
}

void bundle_assert_brute_force(const bundle *b, const char *what)
{
    const job_frame_tile *frame = b->job->frame_host;
    const job_tile *tile = b->job->tiles_host;
    for (unsigned f = 0; f < 16; f++)
        for (unsigned j = 0; j < 16; j++) {
            if (!(tile->pixels[f] >> j & 1))
                continue;
            twin_hit best = bundle_brute_force(b, f, j);
            if (best.id != frame->id[f][j] || memcmp(&best.t, &frame->t[f][j], 4) != 0 ||
                memcmp(&best.u, &frame->u[f][j], 4) != 0 || memcmp(&best.v, &frame->v[f][j], 4) != 0) {
                float d[3];
                bundle_direction(b, f, j, d);
                fail_msg("%s: block %u ray %u (%a %a %a): %u at %a, all triangles tried: %u at %a", what, f, j, (double)d[0],
                         (double)d[1], (double)d[2], frame->id[f][j], (double)frame->t[f][j], best.id, (double)best.t);
            }
        }
}

/* ---- trees by hand ---- */

static bvh *tree_alloc(size_t nodes, size_t records)
{
    bvh *tree = calloc(1, sizeof *tree);
    assert_non_null(tree);
    tree->node_count = nodes;
    tree->record_count = records;
    tree->nodes = aligned_alloc(64, (nodes * sizeof *tree->nodes + 63) / 64 * 64);
    tree->records = aligned_alloc(64, records * sizeof *tree->records);
    assert_true(tree->nodes && tree->records);
    memset(tree->nodes, 0, nodes * sizeof *tree->nodes);
    memset(tree->records, 0, records * sizeof *tree->records);
    return tree;
}

static void set_record(bvh *tree, uint32_t i, const scene_triangle *t)
{
    bvh_triangle *r = &tree->records[i];
    double e[3], f[3], n[3], largest = 0;
    for (int k = 0; k < 3; k++) {
        e[k] = (double)t->v[1][k] - (double)t->v[0][k];
        f[k] = (double)t->v[2][k] - (double)t->v[0][k];
    }
    for (int k = 0; k < 3; k++) {
        n[k] = e[(k + 1) % 3] * f[(k + 2) % 3] - e[(k + 2) % 3] * f[(k + 1) % 3];
        largest = fmax(largest, fabs(n[k]));
    }
    memcpy(r->v0, t->v[0], sizeof r->v0);
    memcpy(r->v1, t->v[1], sizeof r->v1);
    memcpy(r->v2, t->v[2], sizeof r->v2);
    r->id = i;
    for (int k = 0; k < 3; k++)
        r->normal[k] = (float)(n[k] / largest);
}

static void set_leaf(bvh *tree, size_t node, const float low[3], const float high[3], uint32_t first, uint32_t count)
{
    bvh_node *n = &tree->nodes[node];
    memcpy(n->min, low, sizeof n->min);
    memcpy(n->max, high, sizeof n->max);
    n->link = first * (uint32_t)sizeof(bvh_triangle);
    n->count = count;
}

bvh *bundle_leaf(const scene_triangle *triangles, uint32_t count)
{
    static const float low[3] = {-1e9f, -1e9f, -1e9f}, high[3] = {1e9f, 1e9f, 1e9f};
    bvh *tree = tree_alloc(2, count);
    for (uint32_t i = 0; i < count; i++)
        set_record(tree, i, &triangles[i]);
    set_leaf(tree, 0, low, high, 0, count);
    return tree;
}

bvh *bundle_pair(const scene_triangle triangles[2], float box[2][2][3])
{
    bvh *tree = tree_alloc(4, 2);
    tree->nodes[0].link = 2 * sizeof(bvh_node);
    for (uint32_t i = 0; i < 2; i++) {
        set_record(tree, i, &triangles[i]);
        set_leaf(tree, 2 + i, box[i][0], box[i][1], i, 1);
    }
    return tree;
}

bvh *bundle_chain(const scene_triangle *triangles, uint32_t depth, float low, float high)
{
    const float lows[3] = {low, low, low}, highs[3] = {high, high, high};
    bvh *tree = tree_alloc(2 + 2 * (size_t)depth, depth + 1);
    for (uint32_t i = 0; i <= depth; i++)
        set_record(tree, i, &triangles[i]);
    for (uint32_t level = 0; level < depth; level++) {
        size_t pair = 2 + 2 * (size_t)level, parent = level == 0 ? 0 : pair - 1;
        set_leaf(tree, parent, lows, highs, 0, 0);
        tree->nodes[parent].link = (uint32_t)(pair * sizeof(bvh_node));
        set_leaf(tree, pair, lows, highs, level, 1);
        set_leaf(tree, pair + 1, lows, highs, level + 1, 1);
    }
    tree->depth = depth;
    return tree;
}

void bundle_swap_children(bvh *tree)
{
    for (size_t i = 2; i + 1 < tree->node_count; i += 2) {
        bvh_node first = tree->nodes[i];
        tree->nodes[i] = tree->nodes[i + 1];
        tree->nodes[i + 1] = first;
    }
}
