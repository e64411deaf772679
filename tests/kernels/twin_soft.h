/* Plain scalar twins of packet16-soft and of mft-soft that does not shrink its frusta: shadow rays one by one, no lanes, no ops, and counts by the
 * definitions of algorithms A.3. Rays come from job_shadow_ray_of. */
#ifndef TESTS_KERNELS_TWIN_SOFT_H
#define TESTS_KERNELS_TWIN_SOFT_H

#include "tests/kernels/twin.h"

/**
 * The picture and counts of request->kernel, primary rays first; free with trace_free. Its `filtered` and `lit` stay 0.
 *
 * @param request  of packet16-soft or mft-soft, with params and a light
 */
trace_picture twin_soft_trace(const trace_request *request);

#endif
