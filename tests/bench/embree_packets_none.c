/* Stands in for embree_packets.c where Embree is not there. */
#include "tests/bench/embree_packets.h"

base_status embree_packets_create(const scene *s, int robust, double *seconds, embree_packets **out, base_error *err)
{
    (void)s, (void)robust;
    *seconds = 0.0;
    *out = NULL;
    return base_fail(err, BASE_ERR_UNSUPPORTED, "Embree", "this build has none");
}

void embree_packets_destroy(embree_packets **p) { *p = NULL; }

uint32_t embree_packets_trace(embree_packets *p, const kernel_job *job, uint32_t tile)
{
    (void)p, (void)job, (void)tile;
    return 0;
}

uint32_t embree_packets_shadows(embree_packets *p, const kernel_job *job, uint32_t tile)
{
    (void)p, (void)job, (void)tile;
    return 0;
}

int embree_packets_native16(const embree_packets *p)
{
    (void)p;
    return 0;
}
