#include "tests/bench/embree_packets.h"

#include <embree3/rtcore.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/job_shadow.h"
#include "tests/bench/measure.h"

struct embree_packets {
    RTCDevice device;
    RTCScene scene;
    job_frame_tile results; /* of the tile traced last */
};

static base_status add_triangles(embree_packets *p, const scene *s, base_error *err)
{
    RTCGeometry geometry = rtcNewGeometry(p->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    float *vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                              3 * s->triangle_count);
    unsigned *indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned),
                                                s->triangle_count);
    if (!vertices || !indices) {
        rtcReleaseGeometry(geometry);
        return base_fail(err, BASE_ERR_NOMEM, "Embree", "no memory for the triangles");
    }
    for (size_t i = 0; i < s->triangle_count; i++)
        memcpy(vertices + 9 * i, s->triangles[i].v, 9 * sizeof *vertices);
    for (size_t i = 0; i < 3 * s->triangle_count; i++)
        indices[i] = (unsigned)i;
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(p->scene, geometry, 0);
    rtcReleaseGeometry(geometry);
    return BASE_OK;
}

static base_status build(embree_packets *p, const scene *s, int robust, base_error *err)
{
    base_status status = BASE_OK;
    p->device = rtcNewDevice("threads=1");
    if (!p->device)
        return base_fail(err, BASE_ERR_UNSUPPORTED, "Embree", "no device: error %d", (int)rtcGetDeviceError(NULL));
    p->scene = rtcNewScene(p->device);
    rtcSetSceneFlags(p->scene, robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    if (s->triangle_count > 0)
        status = add_triangles(p, s, err);
    if (status != BASE_OK)
        return status;
    rtcCommitScene(p->scene);
    enum RTCError error = rtcGetDeviceError(p->device);
    return error == RTC_ERROR_NONE ? BASE_OK : base_fail(err, BASE_ERR_UNSUPPORTED, "Embree", "the scene: error %d", (int)error);
}

base_status embree_packets_create(const scene *s, int robust, double *seconds, embree_packets **out, base_error *err)
{
    embree_packets *p = aligned_alloc(64, (sizeof *p + 63) / 64 * 64);
    *out = NULL;
    if (!p)
        return base_fail(err, BASE_ERR_NOMEM, "Embree", "out of memory");
    memset(p, 0, sizeof *p);
    double start = measure_seconds();
    base_status status = build(p, s, robust, err);
    *seconds = measure_seconds() - start;
    if (status != BASE_OK)
        embree_packets_destroy(&p);
    *out = p;
    return status;
}

void embree_packets_destroy(embree_packets **p)
{
    if (*p) {
        if ((*p)->scene)
            rtcReleaseScene((*p)->scene);
        if ((*p)->device)
            rtcReleaseDevice((*p)->device);
        free(*p);
    }
    *p = NULL;
}

int embree_packets_native16(const embree_packets *p)
{
    return rtcGetDeviceProperty(p->device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0;
}

/* The rays of a block, from the job's constants: the bits that the kernels trace. */
static void make_rays(struct RTCRayHit16 *q, const job_constants *k, const float corner[3])
{
    float *const direction[3] = {q->ray.dir_x, q->ray.dir_y, q->ray.dir_z};
    float *const origin[3] = {q->ray.org_x, q->ray.org_y, q->ray.org_z};
    for (int axis = 0; axis < 3; axis++)
        for (int j = 0; j < 16; j++) {
            direction[axis][j] = corner[axis] + k->delta[axis][j];
            origin[axis][j] = k->origin_box[axis];
        }
    for (int j = 0; j < 16; j++) {
        q->ray.tnear[j] = 0.0f;
        q->ray.tfar[j] = INFINITY;
        q->ray.time[j] = 0.0f;
        q->ray.mask[j] = UINT32_MAX;
        q->ray.flags[j] = 0;
        q->hit.geomID[j] = RTC_INVALID_GEOMETRY_ID;
        q->hit.primID[j] = RTC_INVALID_GEOMETRY_ID;
        q->hit.instID[0][j] = RTC_INVALID_GEOMETRY_ID;
    }
}

uint32_t embree_packets_trace(embree_packets *p, const kernel_job *job, uint32_t tile)
{
    struct RTCIntersectContext context;
    struct RTCRayHit16 q;
    uint32_t hits = 0;
    const unsigned x0 = tile % job->tiles_x * JOB_TILE_PIXELS, y0 = tile / job->tiles_x * JOB_TILE_PIXELS;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (unsigned block = 0; block < 16; block++) {
        _Alignas(64) int valid[16];
        float corner[3];
        const unsigned pixels = job->tiles_host[tile].pixels[block];
        if (!pixels)
            continue;
        for (int j = 0; j < 16; j++)
            valid[j] = pixels >> j & 1 ? -1 : 0;
        kernel_job_direction(job, x0 + block % 4 * 4, y0 + block / 4 * 4, corner);
        make_rays(&q, job->constants_host, corner);
        rtcIntersect16(valid, p->scene, &context, &q);
        memcpy(p->results.t[block], q.ray.tfar, sizeof q.ray.tfar);
        memcpy(p->results.u[block], q.hit.u, sizeof q.hit.u);
        memcpy(p->results.v[block], q.hit.v, sizeof q.hit.v);
        memcpy(p->results.id[block], q.hit.primID, sizeof q.hit.primID);
        for (int j = 0; j < 16; j++)
            hits += valid[j] && q.hit.geomID[j] != RTC_INVALID_GEOMETRY_ID;
    }
    return hits;
}

/* The rays of a pixel: one origin, and the directions of its set of samples. Returns whether any are traced. */
static bool make_shadow_rays(struct RTCRay16 *q, const kernel_job *job, unsigned x, unsigned y)
{
    const job_light *light = &job->constants_host->light;
    const job_sample_set *set = &job->samples_host[job_shadow_set(job, kernel_job_pixel(job, x, y).pixel, 0)];
    float *const direction[3] = {q->dir_x, q->dir_y, q->dir_z};
    float *const origin[3] = {q->org_x, q->org_y, q->org_z};
    job_shadow_ray first;
    if (!job_shadow_ray_of(job, x, y, 0, 0, &first))
        return false;
    for (int axis = 0; axis < 3; axis++) {
        const float corner = light->corner[axis] - first.org[axis];
        for (int j = 0; j < 16; j++) {
            direction[axis][j] = corner + set->delta[axis][j];
            origin[axis][j] = first.org[axis];
        }
    }
    for (int j = 0; j < 16; j++) {
        q->tnear[j] = light->nearest;
        q->tfar[j] = light->farthest;
        q->time[j] = 0.0f;
        q->mask[j] = UINT32_MAX;
        q->flags[j] = 0;
    }
    return true;
}

uint32_t embree_packets_shadows(embree_packets *p, const kernel_job *job, uint32_t tile)
{
    struct RTCIntersectContext context;
    struct RTCRay16 q;
    _Alignas(64) int valid[16];
    uint32_t blocked = 0;
    const unsigned x0 = tile % job->tiles_x * JOB_TILE_PIXELS, y0 = tile / job->tiles_x * JOB_TILE_PIXELS;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    memset(valid, 0xff, sizeof valid);
    for (unsigned y = y0; y < y0 + JOB_TILE_PIXELS && y < job->height; y++)
        for (unsigned x = x0; x < x0 + JOB_TILE_PIXELS && x < job->width; x++) {
            if (!make_shadow_rays(&q, job, x, y))
                continue;
            rtcOccluded16(valid, p->scene, &context, &q);
            for (int j = 0; j < 16; j++)
                blocked += q.tfar[j] < 0;
        }
    return blocked;
}
