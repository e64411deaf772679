#include "tests/kernels/twin.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/kernels/twin_unit.h"

/* ---- one ray and one triangle ---- */

float twin_dot(const float a[3], const float b[3])
{
    return fmaf(a[2], b[2], fmaf(a[1], b[1], a[0] * b[0]));
}

/* from x to, each component the difference of two products with their rounding errors put back. */
static void cross(const float from[3], const float to[3], float out[3])
{
    for (int axis = 0; axis < 3; axis++) {
        int i = (axis + 1) % 3, j = (axis + 2) % 3;
        float p = from[i] * to[j], q = to[i] * from[j];
        out[axis] = (p - q) + (fmaf(from[i], to[j], -p) - fmaf(to[i], from[j], -q));
    }
}

twin_hit twin_hit_none(void)
{
    return (twin_hit){.id = JOB_NO_HIT, .t = INFINITY};
}

/* N.v of the vertex that gives the least magnitude; 0 if the three differ in sign. */
static float plane_of(const twin_triangle *t)
{
    float least = INFINITY, most = -INFINITY;
    for (int v = 0; v < 3; v++) {
        float p = (t->normal[0] * t->corner[v][0] + t->normal[1] * t->corner[v][1]) + t->normal[2] * t->corner[v][2];
        least = fminf(least, p);
        most = fmaxf(most, p);
    }
    return least > 0.0f ? least : most < 0.0f ? most : 0.0f;
}

twin_triangle twin_triangle_of(const bvh_triangle *record, const float origin[3], float reach)
{
    twin_triangle t = {.id = record->id, .reach = reach};
    for (int axis = 0; axis < 3; axis++) {
        t.corner[0][axis] = record->v0[axis] - origin[axis];
        t.corner[1][axis] = record->v1[axis] - origin[axis];
        t.corner[2][axis] = record->v2[axis] - origin[axis];
        t.normal[axis] = record->normal[axis];
        t.lo[axis] = fminf(t.corner[0][axis], fminf(t.corner[1][axis], t.corner[2][axis]));
        t.hi[axis] = fmaxf(t.corner[0][axis], fmaxf(t.corner[1][axis], t.corner[2][axis]));
    }
    for (int i = 0; i < 3; i++)
        cross(t.corner[(i + 1) % 3], t.corner[(i + 2) % 3], t.edge[i]);
    t.plane = plane_of(&t);
    return t;
}

/* Whether the point at distance t lies in the triangle's bounds, or as good as. */
static int in_bounds(const twin_triangle *triangle, const float direction[3], float t)
{
    float reach = t * triangle->reach;
    for (int axis = 0; axis < 3; axis++)
        if (fmaf(direction[axis], t, reach) < triangle->lo[axis] || fmaf(direction[axis], t, -reach) > triangle->hi[axis])
            return 0;
    return 1;
}

int twin_intersect(const twin_triangle *triangle, int cull, const float direction[3], twin_hit *best)
{
    float w[3];
    if (cull && !(triangle->plane < 0.0f))
        return 0;
    for (int i = 0; i < 3; i++)
        w[i] = twin_dot(direction, triangle->edge[i]);
    int front = w[0] <= 0.0f && w[1] <= 0.0f && w[2] <= 0.0f;
    int back = !cull && w[0] >= 0.0f && w[1] >= 0.0f && w[2] >= 0.0f;
    float sum = (w[0] + w[1]) + w[2];
    if (!(front || back) || sum == 0.0f)
        return 0;
    float t = twin_reciprocal(twin_dot(direction, triangle->normal)) * triangle->plane;
    if (!(t > 0.0f) || !(t < best->t || (t == best->t && triangle->id < best->id)))
        return 0;
    if (!in_bounds(triangle, direction, t))
        return 0;
    float scale = twin_reciprocal(sum);
    *best = (twin_hit){.id = triangle->id, .t = t, .u = w[1] * scale, .v = w[2] * scale};
    return 1;
}

/* ---- pictures ---- */

static void twin_put(trace_picture *p, size_t pixel, const twin_hit *hit)
{
    p->id[pixel] = hit->id;
    p->t[pixel] = hit->t;
    p->u[pixel] = hit->u;
    p->v[pixel] = hit->v;
}

static kernel_job *twin_job(const bvh *tree, const scene_camera *camera, unsigned width, unsigned height, int cull)
{
    kernel_params params = {.cull_backface = (unsigned)cull};
    kernel_job *job = NULL;
    base_error err = {0};
    if (kernel_job_create(tree, camera, NULL, width, height, &params, &job, &err) != BASE_OK)
        fail_msg("%s: %s", err.what, err.why);
    return job;
}

trace_picture twin_brute_force(const bvh *tree, const scene_camera *camera, unsigned width, unsigned height, int cull)
{
    trace_picture p = trace_picture_create(width, height);
    kernel_job *job = twin_job(tree, camera, width, height, cull);
    twin_hit *best = calloc(p.pixels, sizeof *best);
    float(*directions)[3] = calloc(p.pixels, sizeof *directions);
    assert_true(best && directions);
    for (size_t i = 0; i < p.pixels; i++) {
        kernel_job_direction(job, (unsigned)(i % width), (unsigned)(i / width), directions[i]);
        best[i] = twin_hit_none();
    }
    for (size_t k = 0; k < tree->record_count; k++) {
        twin_triangle triangle = twin_triangle_of(&tree->records[k], job->constants_host->origin_box, 0.5f * job->constants_host->slack);
        for (size_t i = 0; i < p.pixels; i++)
            twin_intersect(&triangle, cull, directions[i], &best[i]);
    }
    for (size_t i = 0; i < p.pixels; i++)
        twin_put(&p, i, &best[i]);
    free(best);
    free(directions);
    kernel_job_destroy(&job);
    return p;
}

/* ---- traversal: a unit is a packet of 16 rays, or a group of 16 frusta or of 16 packets ---- */

typedef struct twin_state {
    twin_kind kind;
    const kernel_job *job;
    int cull;
    kernel_counts *n;
    twin_unit unit;
    twin_unit packet[16];      /* of a group of packets */
    uint32_t tile;
    unsigned block;            /* of a packet */
    float first_ray[16][3];    /* of the blocks */
    twin_hit hit[16][16];      /* by block and pixel */
} twin_state;

static void first_rays(const kernel_job *job, uint32_t tile, float out[16][3])
{
    const job_constants *k = job->constants_host;
    const job_tile *t = &job->tiles_host[tile];
    for (int f = 0; f < 16; f++)
        for (int axis = 0; axis < 3; axis++)
            out[f][axis] = fmaf(t->y + k->block_y[f], k->dy[axis], fmaf(t->x + k->block_x[f], k->dx[axis], k->d00[axis]));
}

/* The intervals of a unit's lanes: of the four extreme rays of each block, or of the rays of one. */
static void unit_intervals(const twin_state *s, twin_unit *u, int frusta, unsigned packet)
{
    static const int corners[4] = {0, 3, 15, 12};
    const job_constants *k = s->job->constants_host;
    for (unsigned i = 0; i < 16; i++)
        for (int axis = 0; axis < 3; axis++) {
            float lo = INFINITY, hi = -INFINITY;
            for (int corner = 0; corner < (frusta ? 4 : 1); corner++) {
                unsigned block = frusta ? i : packet;
                int pixel = frusta ? corners[corner] : (int)i;
                float d = s->first_ray[block][axis] + k->delta[axis][pixel];
                lo = fminf(lo, d);
                hi = fmaxf(hi, d);
            }
            u->lane[i].lo[axis] = lo - k->slack;
            u->lane[i].hi[axis] = hi + k->slack;
        }
}

static void unit_start(twin_state *s, unsigned active)
{
    twin_unit *u = &s->unit;
    unit_intervals(s, u, s->kind == TWIN_FRUSTA, s->block);
    u->active = active;
    u->some_zero = twin_signs_lacking(u);
    twin_unit_reciprocals(u);
    twin_count_path(s->n, u->some_zero, twin_signs_mixed(u));
}

/* The limits of a group's rays: their nearest hits, and none for what is no pixel. */
static void group_limits(twin_state *s)
{
    for (unsigned f = 0; f < 16; f++)
        for (unsigned j = 0; j < 16; j++)
            s->packet[f].lane[j].limit = s->job->tiles_host[s->tile].pixels[f] >> j & 1 ? s->hit[f][j].t : -INFINITY;
}

/* A group's signs are alike if its frusta's are; else it is the rays that have signs or lack them. */
static void group_start(twin_state *s, unsigned active)
{
    twin_unit *u = &s->unit;
    int some_zero = 0;
    unit_intervals(s, u, 1, 0);
    u->active = active;
    const int mixed = twin_signs_lacking(u) || twin_signs_mixed(u);
    for (unsigned f = 0; f < 16; f++) {
        unit_intervals(s, &s->packet[f], 0, f);
        s->packet[f].active = active >> f & 1 ? 0xffff : 0;
        some_zero |= mixed && twin_signs_lacking(&s->packet[f]);
    }
    for (unsigned f = 0; f < 16; f++) {
        s->packet[f].some_zero = some_zero;
        twin_unit_reciprocals(&s->packet[f]);
    }
    group_limits(s);
    twin_count_path(s->n, some_zero, mixed);
}

static unsigned unit_meets(twin_state *s, const twin_unit *u, const bvh_node *box, unsigned m, float entry[16])
{
    unsigned hit = 0;
    s->n->n[KERNEL_aabb_tests]++;
    for (unsigned i = 0; i < 16; i++)
        if (m >> i & 1)
            hit |= (unsigned)twin_lane_meets(&u->lane[i], u->some_zero, box, s->job->constants_host->origin_box, &entry[i]) << i;
    return hit;
}

/* Whether some lane that meets both boxes of a pair enters the first before the second. */
static int unit_first_nearer(twin_state *s, const twin_unit *u, const bvh_node *pair, unsigned m, unsigned hit[2])
{
    float entry[2][16];
    int nearer = 0;
    for (int box = 0; box < 2; box++)
        hit[box] = unit_meets(s, u, &pair[box], m, entry[box]);
    for (unsigned i = 0; i < 16; i++)
        nearer |= (hit[0] & hit[1] & m) >> i & 1 && entry[0][i] < entry[1][i];
    return nearer;
}

/* The same for a group of packets: `hit` is by packet, and it is rays that meet boxes. */
static int group_first_nearer(twin_state *s, const bvh_node *pair, unsigned m, unsigned hit[2])
{
    int nearer = 0;
    s->n->n[KERNEL_aabb_group_tests] += 2;
    hit[0] = hit[1] = 0;
    for (unsigned f = 0; f < 16; f++) {
        unsigned rays[2];
        if (!(m >> f & 1))
            continue;
        nearer |= unit_first_nearer(s, &s->packet[f], pair, 0xffff, rays);
        hit[0] |= (unsigned)(rays[0] != 0) << f;
        hit[1] |= (unsigned)(rays[1] != 0) << f;
    }
    return nearer;
}

/* Lanes (frusta) whose four corner rays do not all lie beyond one edge of the triangle. */
static unsigned survivors(const twin_state *s, const twin_triangle *triangle, unsigned m)
{
    static const int corners[4] = {0, 3, 15, 12};
    const job_constants *k = s->job->constants_host;
    unsigned kept = 0;
    for (unsigned f = 0; f < 16; f++) {
        int front = 1, back = !s->cull;
        for (int edge = 0; edge < 3 && m >> f & 1; edge++) {
            const float *e = triangle->edge[edge];
            /* the order of additions of two swapped pairs: z x, then y */
            float guard = ((fabsf(e[2]) + fabsf(e[0])) + fabsf(e[1])) * k->guard;
            float smallest = INFINITY, largest = -INFINITY;
            for (int corner = 0; corner < 4; corner++) {
                float d[3];
                for (int axis = 0; axis < 3; axis++)
                    d[axis] = s->first_ray[f][axis] + k->delta[axis][corners[corner]];
                smallest = fminf(smallest, twin_dot(d, e));
                largest = fmaxf(largest, twin_dot(d, e));
            }
            front &= smallest <= guard;
            back &= largest >= -guard;
        }
        kept |= (unsigned)((m >> f & 1) && (front || back)) << f;
    }
    return kept;
}

static int block_intersect(twin_state *s, const twin_triangle *triangle, unsigned block, unsigned m)
{
    const job_constants *k = s->job->constants_host;
    int any = 0;
    s->n->n[KERNEL_isect_tests]++;
    for (unsigned j = 0; j < 16; j++) {
        float d[3];
        for (int axis = 0; axis < 3; axis++)
            d[axis] = s->first_ray[block][axis] + k->delta[axis][j];
        if (m >> j & 1)
            any |= twin_intersect(triangle, s->cull, d, &s->hit[block][j]);
    }
    return any;
}

static twin_triangle unit_triangle(const twin_state *s, const bvh_triangle *record)
{
    return twin_triangle_of(record, s->job->constants_host->origin_box, 0.5f * s->job->constants_host->slack);
}

static void packet_leaf(twin_state *s, const bvh_triangle *records, uint32_t count, unsigned m)
{
    for (uint32_t k = 0; k < count; k++) {
        twin_triangle triangle = unit_triangle(s, &records[k]);
        s->n->n[KERNEL_tri_accesses]++;
        if (s->cull && !(triangle.plane < 0.0f))
            continue;
        s->n->n[KERNEL_tri_after_culling]++;
        block_intersect(s, &triangle, s->block, m);
    }
    for (unsigned i = 0; i < 16; i++)
        s->unit.lane[i].limit = s->hit[s->block][i].t;
}

static void group_leaf(twin_state *s, const bvh_triangle *records, uint32_t count, unsigned m)
{
    unsigned updated = 0;
    for (uint32_t k = 0; k < count; k++) {
        twin_triangle triangle = unit_triangle(s, &records[k]);
        s->n->n[KERNEL_tri_accesses]++;
        if (s->cull && !(triangle.plane < 0.0f))
            continue;
        unsigned kept = survivors(s, &triangle, m);
        s->n->n[KERNEL_tri_after_culling] += kept != 0;
        for (unsigned f = 0; f < 16; f++)
            if (kept >> f & 1)
                updated |= (unsigned)block_intersect(s, &triangle, f, s->job->tiles_host[s->tile].pixels[f]) << f;
    }
    if (s->kind == TWIN_GROUPS) {
        group_limits(s);
        return;
    }
    for (unsigned f = 0; f < 16; f++) {
        float farthest = -INFINITY;
        for (unsigned j = 0; j < 16; j++)
            if (s->job->tiles_host[s->tile].pixels[f] >> j & 1)
                farthest = fmaxf(farthest, s->hit[f][j].t);
        if (updated >> f & 1)
            s->unit.lane[f].limit = farthest;
    }
}

static void visit(twin_state *s, const bvh_node *node, unsigned m)
{
    const bvh *tree = s->job->tree;
    s->n->n[KERNEL_traversed_cells]++;
    if (node->count) {
        const bvh_triangle *records = tree->records + node->link / sizeof *records;
        if (s->kind == TWIN_PACKETS)
            packet_leaf(s, records, node->count, m);
        else
            group_leaf(s, records, node->count, m);
        return;
    }
    const bvh_node *pair = tree->nodes + node->link / sizeof *pair;
    unsigned met[2];
    s->n->n[KERNEL_traversed_inner]++;
    const int nearer = s->kind == TWIN_GROUPS ? group_first_nearer(s, pair, m, met) : unit_first_nearer(s, &s->unit, pair, m, met);
    const int first = met[0] && (nearer || !met[1]) ? 0 : 1;
    for (int turn = 0; turn < 2; turn++)
        if (met[first ^ turn])
            visit(s, &pair[first ^ turn], met[first ^ turn]);
}

static void trace_unit(twin_state *s, unsigned active)
{
    if (s->kind == TWIN_GROUPS)
        group_start(s, active);
    else
        unit_start(s, active);
    if (s->job->record_count)
        visit(s, &s->job->tree->nodes[0], active);
}

static void trace_tile(twin_state *s)
{
    const job_tile *tile = &s->job->tiles_host[s->tile];
    first_rays(s->job, s->tile, s->first_ray);
    for (unsigned i = 0; i < 256; i++)
        s->hit[i / 16][i % 16] = twin_hit_none();
    if (s->kind != TWIN_PACKETS) {
        s->n->n[KERNEL_units_groups]++;
        s->n->n[s->kind == TWIN_FRUSTA ? KERNEL_units_frusta : KERNEL_units_packets] += (unsigned)__builtin_popcount(tile->blocks);
        trace_unit(s, tile->blocks);
        return;
    }
    for (s->block = 0; s->block < 16; s->block++)
        if (tile->pixels[s->block]) {
            s->n->n[KERNEL_units_packets]++;
            trace_unit(s, tile->pixels[s->block]);
        }
}

trace_picture twin_trace(twin_kind kind, const bvh *tree, const scene_camera *camera, unsigned width, unsigned height, int cull)
{
    trace_picture p = trace_picture_create(width, height);
    kernel_job *job = twin_job(tree, camera, width, height, cull);
    twin_state *s = calloc(1, sizeof *s);
    assert_non_null(s);
    *s = (twin_state){.kind = kind, .job = job, .cull = cull, .n = &p.counts};
    for (s->tile = 0; s->tile < kernel_job_tiles(job); s->tile++) {
        trace_tile(s);
        for (size_t i = 0; i < p.pixels; i++) {
            job_pixel where = kernel_job_pixel(job, (unsigned)(i % width), (unsigned)(i / width));
            if (where.tile == s->tile)
                twin_put(&p, i, &s->hit[where.block][where.pixel]);
        }
    }
    p.counts.n[KERNEL_rays] = p.counts.n[KERNEL_rays_primary] = p.pixels;
    free(s);
    kernel_job_destroy(&job);
    return p;
}
