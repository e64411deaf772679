#include "tests/oracles/embree_oracle.h"

#include <embree3/rtcore.h>

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lrbni/base/parallel.h"

enum { RAYS_PER_PIECE = 1024 };

struct embree_oracle {
    RTCDevice device;
    RTCScene scene;
    scene_triangle *triangles; /* only with back-face culling: what the filter looks at */
    unsigned jobs;
};

typedef struct ray_batch {
    const embree_oracle *oracle;
    const oracle_ray *rays;
    size_t ray_count;
    oracle_hit *hits;
    unsigned char *occluded; /* filled in instead of hits if it is there */
} ray_batch;

/* Embree keeps the last error of the thread and of the device; turn it into ours. */
static base_status check_device(RTCDevice device, const char *what, base_error *err)
{
    switch (rtcGetDeviceError(device)) {
    case RTC_ERROR_NONE:
        return BASE_OK;
    case RTC_ERROR_OUT_OF_MEMORY:
        return base_fail(err, BASE_ERR_NOMEM, what, "Embree ran out of memory");
    case RTC_ERROR_INVALID_ARGUMENT:
        return base_fail(err, BASE_ERR_UNSUPPORTED, what, "Embree reports an invalid argument");
    case RTC_ERROR_INVALID_OPERATION:
        return base_fail(err, BASE_ERR_UNSUPPORTED, what, "Embree reports an invalid operation");
    case RTC_ERROR_UNSUPPORTED_CPU:
        return base_fail(err, BASE_ERR_UNSUPPORTED, what, "Embree does not support this processor");
    case RTC_ERROR_CANCELLED:
        return base_fail(err, BASE_ERR_UNSUPPORTED, what, "Embree was cancelled");
    case RTC_ERROR_UNKNOWN:
        break;
    }
    return base_fail(err, BASE_ERR_UNSUPPORTED, what, "Embree reports an unknown error");
}

/* N.dir in double, from the float vertices. */
static double normal_dot_dir(const scene_triangle *triangle, const double dir[3])
{
    double e1[3], e2[3], sum = 0.0;
    for (int k = 0; k < 3; k++) {
        e1[k] = (double)triangle->v[1][k] - (double)triangle->v[0][k];
        e2[k] = (double)triangle->v[2][k] - (double)triangle->v[0][k];
    }
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        sum += dir[k] * (e1[i] * e2[j] - e1[j] * e2[i]);
    }
    return sum;
}

/* Called for one ray at a time, as rays are cast by rtcIntersect1 and rtcOccluded1: the N-wide structures are then the plain ones. */
static void reject_backfaces(const struct RTCFilterFunctionNArguments *args)
{
    const scene_triangle *triangles = args->geometryUserPtr;
    const struct RTCRay *ray = (const struct RTCRay *)args->ray;
    const struct RTCHit *hit = (const struct RTCHit *)args->hit;
    const double dir[3] = {(double)ray->dir_x, (double)ray->dir_y, (double)ray->dir_z};
    assert(args->N == 1);
    if (args->valid[0] == -1 && !(normal_dot_dir(&triangles[hit->primID], dir) < 0.0))
        args->valid[0] = 0;
}

/* Fill in and commit the one geometry of the scene. */
static base_status add_triangles(embree_oracle *oracle, const scene_triangle *triangles, size_t count,
                                 base_error *err)
{
    RTCGeometry geometry = rtcNewGeometry(oracle->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    float *vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                              3 * sizeof(float), 3 * count);
    unsigned *indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                3 * sizeof(unsigned), count);
    base_status status = check_device(oracle->device, "triangles", err);
    if (status == BASE_OK && (!vertices || !indices))
        status = base_fail(err, BASE_ERR_NOMEM, "triangles", "Embree ran out of memory");
    if (status == BASE_OK) {
        for (size_t i = 0; i < count; i++)
            memcpy(vertices + 9 * i, triangles[i].v, sizeof triangles[i].v);
        for (size_t i = 0; i < 3 * count; i++)
            indices[i] = (unsigned)i;
        rtcSetGeometryUserData(geometry, oracle->triangles);
        if (oracle->triangles) {
            rtcSetGeometryIntersectFilterFunction(geometry, reject_backfaces);
            rtcSetGeometryOccludedFilterFunction(geometry, reject_backfaces);
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(oracle->scene, geometry, 0);
        status = check_device(oracle->device, "triangles", err);
    }
    rtcReleaseGeometry(geometry);
    return status;
}

static base_status build(embree_oracle *oracle, const scene_triangle *triangles, size_t count, base_error *err)
{
    char config[64];
    base_status status;
    snprintf(config, sizeof config, "threads=%u", oracle->jobs);
    oracle->device = rtcNewDevice(config);
    if (!oracle->device)
        return check_device(NULL, "device", err);
    oracle->scene = rtcNewScene(oracle->device);
    rtcSetSceneFlags(oracle->scene, RTC_SCENE_FLAG_ROBUST);
    status = check_device(oracle->device, "scene", err);
    if (status == BASE_OK && count > 0)
        status = add_triangles(oracle, triangles, count, err);
    if (status == BASE_OK) {
        rtcCommitScene(oracle->scene);
        status = check_device(oracle->device, "scene", err);
    }
    return status;
}

base_status embree_oracle_create(const scene_triangle *triangles, size_t triangle_count, int cull_backface,
                                 unsigned jobs, embree_oracle **out, base_error *err)
{
    embree_oracle *oracle;
    base_status status;
    *out = NULL;
    if (triangle_count > SCENE_MAX_TRIANGLES)
        return base_fail(err, BASE_ERR_USAGE, "triangles", "%zu are more than %zu", triangle_count,
                         SCENE_MAX_TRIANGLES);
    oracle = calloc(1, sizeof *oracle);
    if (!oracle)
        return base_fail(err, BASE_ERR_NOMEM, "Embree oracle", "out of memory");
    oracle->jobs = jobs > 0 ? jobs : 1;
    if (cull_backface && triangle_count > 0) {
        oracle->triangles = malloc(triangle_count * sizeof *triangles);
        if (!oracle->triangles) {
            embree_oracle_destroy(&oracle);
            return base_fail(err, BASE_ERR_NOMEM, "Embree oracle", "out of memory");
        }
        memcpy(oracle->triangles, triangles, triangle_count * sizeof *triangles);
    }
    status = build(oracle, triangles, triangle_count, err);
    if (status != BASE_OK)
        embree_oracle_destroy(&oracle);
    *out = oracle;
    return status;
}

void embree_oracle_destroy(embree_oracle **oracle)
{
    if (!*oracle)
        return;
    if ((*oracle)->scene)
        rtcReleaseScene((*oracle)->scene);
    if ((*oracle)->device)
        rtcReleaseDevice((*oracle)->device);
    free((*oracle)->triangles);
    free(*oracle);
    *oracle = NULL;
}

static oracle_hit closest(RTCScene tree, const oracle_ray *ray)
{
    struct RTCIntersectContext context;
    struct RTCRayHit query = {
        .ray = {.org_x = ray->org[0], .org_y = ray->org[1], .org_z = ray->org[2], .tnear = ray->tmin,
                .dir_x = ray->dir[0], .dir_y = ray->dir[1], .dir_z = ray->dir[2], .tfar = ray->tmax,
                .mask = 0xffffffffu},
        .hit = {.primID = RTC_INVALID_GEOMETRY_ID, .geomID = RTC_INVALID_GEOMETRY_ID,
                .instID = {RTC_INVALID_GEOMETRY_ID}}};
    rtcInitIntersectContext(&context);
    rtcIntersect1(tree, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return (oracle_hit){.id = ORACLE_NO_HIT, .t = (double)INFINITY};
    return (oracle_hit){query.hit.primID, (double)query.ray.tfar, (double)query.hit.u, (double)query.hit.v};
}

static unsigned char occluded(RTCScene tree, const oracle_ray *ray)
{
    struct RTCIntersectContext context;
    struct RTCRay query = {.org_x = ray->org[0], .org_y = ray->org[1], .org_z = ray->org[2], .tnear = ray->tmin,
                           .dir_x = ray->dir[0], .dir_y = ray->dir[1], .dir_z = ray->dir[2], .tfar = ray->tmax,
                           .mask = 0xffffffffu};
    rtcInitIntersectContext(&context);
    rtcOccluded1(tree, &context, &query);
    return query.tfar < 0.0f; /* Embree's sign for it: -infinity */
}

static void trace_piece(void *user, size_t piece, unsigned worker)
{
    const ray_batch *q = user;
    size_t end = (piece + 1) * RAYS_PER_PIECE;
    (void)worker;
    if (end > q->ray_count)
        end = q->ray_count;
    for (size_t i = piece * RAYS_PER_PIECE; i < end; i++)
        if (q->occluded)
            q->occluded[i] = occluded(q->oracle->scene, &q->rays[i]);
        else
            q->hits[i] = closest(q->oracle->scene, &q->rays[i]);
}

base_status embree_oracle_closest(const embree_oracle *oracle, const oracle_ray *rays, size_t ray_count,
                                  oracle_hit *hits, base_error *err)
{
    ray_batch q = {.oracle = oracle, .rays = rays, .ray_count = ray_count, .hits = hits};
    base_parallel_for(oracle->jobs, (ray_count + RAYS_PER_PIECE - 1) / RAYS_PER_PIECE, trace_piece, &q);
    return check_device(oracle->device, "rays", err);
}

base_status embree_oracle_occluded(const embree_oracle *oracle, const oracle_ray *rays, size_t ray_count, unsigned char *occluded,
                                   base_error *err)
{
    ray_batch q = {.oracle = oracle, .rays = rays, .ray_count = ray_count, .occluded = occluded};
    base_parallel_for(oracle->jobs, (ray_count + RAYS_PER_PIECE - 1) / RAYS_PER_PIECE, trace_piece, &q);
    return check_device(oracle->device, "rays", err);
}
