#include "tests/kernels/twin_soft.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/job_shadow.h"
#include "tests/kernels/twin_unit.h"

/* A pixel: where its shadow rays start, the light's corners from there, the rays of this pass. */
typedef struct soft_point {
    float origin[3], corner[4][3], direction[16][3];
    float slack, reach, guard; /* for rays from here */
    unsigned blocked;          /* samples; those not taken among them */
} soft_point;

typedef struct soft_state {
    const kernel_job *job;
    bool frusta;
    int cull;
    kernel_counts *n;
    soft_point point[16]; /* of the block */
    unsigned seeing;      /* pixels of the block that may see the light */
    unsigned pixel;       /* of a packet */
    twin_unit unit;       /* lanes: rays of a packet, or frusta of the block's pixels */
    unsigned alive;       /* lanes that still look for a hit */
} soft_state;

static const soft_point *lane_point(const soft_state *s, unsigned lane) { return &s->point[s->frusta ? lane : s->pixel]; }

static void point_corners(const job_light *light, soft_point *p)
{
    float length = 0;
    for (int axis = 0; axis < 3; axis++) {
        const float first = light->corner[axis] - p->origin[axis];
        const float corner[4] = {first, first + light->u[axis], first + light->uv[axis], first + light->v[axis]};
        float lo = INFINITY, hi = -INFINITY;
        for (int k = 0; k < 4; k++) {
            p->corner[k][axis] = corner[k];
            lo = fminf(lo, corner[k]);
            hi = fmaxf(hi, corner[k]);
        }
        length += fmaxf(hi, 0.0f - lo);
    }
    p->slack = length * light->slack;
    p->reach = length * light->reach;
    p->guard = length * light->guard;
}

/* The points of a block, for one pass; x, y: of its first pixel. */
static void block_points(soft_state *s, unsigned x, unsigned y, unsigned pass)
{
    const kernel_job *job = s->job;
    s->seeing = 0;
    for (unsigned j = 0; j < 16 * 16; j++) {
        const unsigned px = x + j / 16 % 4, py = y + j / 64, sample = j % 16;
        job_shadow_ray ray;
        if (px >= job->width || py >= job->height || !job_shadow_ray_of(job, px, py, pass, sample, &ray))
            continue;
        const unsigned pixel = kernel_job_pixel(job, px, py).pixel;
        soft_point *p = &s->point[pixel];
        s->seeing |= 1u << pixel;
        memcpy(p->origin, ray.org, sizeof p->origin);
        memcpy(p->direction[sample], ray.dir, sizeof ray.dir);
        point_corners(&job->constants_host->light, p);
        p->blocked = ~job->sample_mask & 0xffff;
    }
}

static void unit_start(soft_state *s, unsigned active)
{
    twin_unit *u = &s->unit;
    u->active = s->alive = active;
    for (unsigned i = 0; i < 16; i++) {
        const soft_point *p = lane_point(s, i);
        for (int axis = 0; axis < 3; axis++) {
            float lo = INFINITY, hi = -INFINITY;
            for (int k = 0; k < (s->frusta ? 4 : 1); k++) {
                const float d = s->frusta ? p->corner[k][axis] : p->direction[i][axis];
                lo = fminf(lo, d);
                hi = fmaxf(hi, d);
            }
            u->lane[i].lo[axis] = lo - p->slack;
            u->lane[i].hi[axis] = hi + p->slack;
        }
    }
    u->some_zero = twin_signs_lacking(u);
    twin_unit_reciprocals(u);
    for (unsigned i = 0; i < 16; i++)
        u->lane[i].limit = s->job->constants_host->light.farthest;
    twin_count_path(s->n, u->some_zero, twin_signs_mixed(u));
}

/* Whether a triangle blocks a ray, wherever between its ends. */
static bool blocks(const soft_state *s, const twin_triangle *triangle, const float direction[3])
{
    const job_light *light = &s->job->constants_host->light;
    twin_hit hit = twin_hit_none();
    return twin_intersect(triangle, s->cull, direction, &hit) && hit.t > light->nearest && hit.t < light->farthest;
}

/* The samples of m that a triangle blocks. */
static unsigned point_blocked(soft_state *s, const twin_triangle *triangle, const soft_point *p, unsigned m)
{
    unsigned blocked = 0;
    s->n->n[KERNEL_isect_tests]++;
    for (unsigned i = 0; i < 16; i++)
        if (m >> i & 1)
            blocked |= (unsigned)blocks(s, triangle, p->direction[i]) << i;
    return blocked;
}

static void packet_leaf(soft_state *s, const bvh_triangle *records, uint32_t count, unsigned m)
{
    const soft_point *p = &s->point[s->pixel];
    for (uint32_t k = 0; k < count && m; k++) {
        const twin_triangle triangle = twin_triangle_of(&records[k], p->origin, p->reach);
        s->n->n[KERNEL_tri_accesses]++;
        if (s->cull && !(triangle.plane < 0.0f))
            continue;
        s->n->n[KERNEL_tri_after_culling]++;
        const unsigned blocked = point_blocked(s, &triangle, p, m);
        s->alive &= ~blocked;
        m &= ~blocked;
    }
}

/* Whether the four corners of the light, seen from a point, do not all lie beyond one edge of the triangle. */
static bool survives(const twin_triangle *triangle, const soft_point *p, int cull)
{
    bool front = !cull || triangle->plane < 0.0f, back = !cull;
    for (int edge = 0; edge < 3; edge++) {
        const float *e = triangle->edge[edge];
        const float guard = ((fabsf(e[0]) + fabsf(e[1])) + fabsf(e[2])) * p->guard;
        float smallest = INFINITY, largest = -INFINITY;
        for (int k = 0; k < 4; k++) {
            smallest = fminf(smallest, twin_dot(e, p->corner[k]));
            largest = fmaxf(largest, twin_dot(e, p->corner[k]));
        }
        front &= smallest <= guard;
        back &= largest >= -guard;
    }
    return front || back;
}

static void frusta_leaf(soft_state *s, const bvh_triangle *records, uint32_t count, unsigned m)
{
    for (uint32_t k = 0; k < count && m; k++) {
        bool any = false;
        s->n->n[KERNEL_tri_accesses]++;
        for (unsigned f = 0; f < 16; f++) {
            soft_point *p = &s->point[f];
            const twin_triangle triangle = twin_triangle_of(&records[k], p->origin, p->reach);
            if (!(m >> f & 1) || !survives(&triangle, p, s->cull))
                continue;
            any = true;
            p->blocked |= point_blocked(s, &triangle, p, ~p->blocked & 0xffff);
            if (p->blocked == 0xffff)
                s->alive &= ~(1u << f);
        }
        s->n->n[KERNEL_tri_after_culling] += any;
        m &= s->alive;
    }
}

/* The lanes of m that meet each of a pair's boxes; whether one in both enters the first before the second. */
static bool first_nearer(soft_state *s, const bvh_node *pair, unsigned m, unsigned met[2])
{
    float entry[2][16];
    bool nearer = false;
    for (int box = 0; box < 2; box++) {
        s->n->n[KERNEL_aabb_tests]++;
        met[box] = 0;
        for (unsigned i = 0; i < 16; i++)
            if (m >> i & 1)
                met[box] |= (unsigned)twin_lane_meets(&s->unit.lane[i], s->unit.some_zero, &pair[box], lane_point(s, i)->origin, &entry[box][i]) << i;
    }
    for (unsigned i = 0; i < 16; i++)
        nearer |= (met[0] & met[1]) >> i & 1 && entry[0][i] < entry[1][i];
    return nearer;
}

static void visit(soft_state *s, const bvh_node *node, unsigned m)
{
    const bvh *tree = s->job->tree;
    s->n->n[KERNEL_traversed_cells]++;
    if (node->count) {
        const bvh_triangle *records = tree->records + node->link / sizeof *records;
        (s->frusta ? frusta_leaf : packet_leaf)(s, records, node->count, m);
        return;
    }
    const bvh_node *pair = tree->nodes + node->link / sizeof *pair;
    unsigned met[2];
    s->n->n[KERNEL_traversed_inner]++;
    const bool nearer = first_nearer(s, pair, m, met);
    const int first = met[0] && (nearer || !met[1]) ? 0 : 1;
    for (int turn = 0; turn < 2; turn++)
        if (met[first ^ turn] & s->alive)
            visit(s, &pair[first ^ turn], met[first ^ turn] & s->alive);
}

static void trace_unit(soft_state *s, unsigned active, unsigned rays)
{
    s->n->n[KERNEL_rays] += rays;
    s->n->n[KERNEL_rays_shadow] += rays;
    unit_start(s, active);
    if (s->job->record_count)
        visit(s, &s->job->tree->nodes[0], active);
}

static void trace_block(soft_state *s)
{
    const unsigned samples = (unsigned)__builtin_popcount(s->job->sample_mask), pixels = (unsigned)__builtin_popcount(s->seeing);
    if (s->frusta && s->seeing) {
        s->n->n[KERNEL_units_shadow_groups]++;
        s->n->n[KERNEL_units_shadow_frusta] += pixels;
        trace_unit(s, s->seeing, pixels * samples);
    }
    for (s->pixel = 0; !s->frusta && s->pixel < 16; s->pixel++) {
        if (!(s->seeing >> s->pixel & 1))
            continue;
        s->n->n[KERNEL_units_shadow_packets]++;
        trace_unit(s, s->job->sample_mask, samples);
        s->point[s->pixel].blocked = ~s->alive & 0xffff;
    }
}

/* What the block's pixels see in this pass, and in the last what is blocked. */
static void put_block(const soft_state *s, unsigned x, unsigned y, trace_picture *p)
{
    for (unsigned j = 0; j < 16; j++) {
        const unsigned px = x + j % 4, py = y + j / 4;
        if (px >= p->width || py >= p->height)
            continue;
        const unsigned pixel = kernel_job_pixel(s->job, px, py).pixel;
        const size_t i = (size_t)py * p->width + px;
        p->occlusion[i] = s->seeing >> pixel & 1 ? s->point[pixel].blocked : 0xffff;
        p->visibility[i] += (float)__builtin_popcount(~p->occlusion[i] & 0xffff);
    }
}

trace_picture twin_soft_trace(const trace_request *request)
{
    const bool frusta = strcmp(request->kernel, "mft-soft") == 0;
    trace_picture p = twin_trace(frusta ? TWIN_FRUSTA : TWIN_PACKETS, request->tree, request->camera, request->width, request->height, (int)request->cull);
    kernel_job *job = trace_job(request);
    soft_state *s = calloc(1, sizeof *s);
    assert_non_null(s);
    *s = (soft_state){.job = job, .frusta = frusta, .cull = (int)request->cull, .n = &p.counts};
    for (size_t i = 0; i < p.pixels; i++) {
        const job_pixel at = kernel_job_pixel(job, (unsigned)(i % p.width), (unsigned)(i / p.width));
        job->frame_host[at.tile].id[at.block][at.pixel] = p.id[i];
        job->frame_host[at.tile].t[at.block][at.pixel] = p.t[i];
    }
    for (unsigned y = 0; y < p.height; y += 4)
        for (unsigned x = 0; x < p.width; x += 4)
            for (unsigned pass = 0; pass < job->sample_passes; pass++) {
                block_points(s, x, y, pass);
                trace_block(s);
                put_block(s, x, y, &p);
            }
    for (size_t i = 0; i < p.pixels; i++)
        p.visibility[i] = p.id[i] == JOB_NO_HIT ? 1 : p.visibility[i] * job->constants_host->light.share;
    free(s);
    kernel_job_destroy(&job);
    return p;
}
