/* Embree's rtcIntersect16 on the primary rays of a job's tiles, 4x4 rays a packet, and rtcOccluded16 on the shadow rays of their hits, a
 * packet for each: a scale for the kernels' speed.
 *
 * Where Embree is not there, embree_packets_none.c says so instead.
 */
#ifndef TESTS_BENCH_EMBREE_PACKETS_H
#define TESTS_BENCH_EMBREE_PACKETS_H

#include <stdint.h>

#include "kernels/job.h"
#include "lrbni/base/status.h"
#include "scene/scene.h"

typedef struct embree_packets embree_packets;

/**
 * Build Embree's tree over a scene, with its default quality and one thread.
 *
 * @param robust   1: with RTC_SCENE_FLAG_ROBUST
 * @param seconds  out: time of the build
 * @param out      free with embree_packets_destroy; NULL on failure
 *
 * Errors: BASE_ERR_NOMEM, BASE_ERR_UNSUPPORTED if Embree fails or is not there.
 */
base_status embree_packets_create(const scene *s, int robust, double *seconds, embree_packets **out, base_error *err);

/** Free; sets the pointer to NULL. NULL contents are fine. */
void embree_packets_destroy(embree_packets **p);

/** Trace the 16 packets of a tile: rays made, traced, and their t, u, v and id kept, as the kernels do. Returns the number of hits. */
uint32_t embree_packets_trace(embree_packets *p, const kernel_job *job, uint32_t tile);

/**
 * Trace the packets of shadow rays of a tile, the bits that kernels trace: 16 rays from each hit of the job's frame that may see the light.
 *
 * @param job  of a kernel with soft shadows and 16 samples, its tiles traced by the kernel
 *
 * Returns the number of blocked rays.
 */
uint32_t embree_packets_shadows(embree_packets *p, const kernel_job *job, uint32_t tile);

/** Whether Embree has code of its own for packets of 16 on this CPU, and does not split them. */
int embree_packets_native16(const embree_packets *p);

#endif
