/* Parameters of the kernels, set with --param, and what the options of a run say to them. */
#ifndef KERNELS_PARAMS_H
#define KERNELS_PARAMS_H

#include <stddef.h>
#include <stdint.h>

#include "lrbni/base/status.h"

/* Which 16-point sets a light is sampled with (kernels/light_samples.h). */
typedef enum kernel_net { KERNEL_NET_HAMMERSLEY, KERNEL_NET_LARCHER } kernel_net;
typedef enum kernel_assignment { KERNEL_ASSIGN_PERMUTED, KERNEL_ASSIGN_RANK, KERNEL_ASSIGN_BITS } kernel_assignment;

/* How frusta of shadow rays shrink when some of their rays are blocked (Benthin and Wald 2009, 5.3). */
typedef enum kernel_shrink { KERNEL_SHRINK_NONE, KERNEL_SHRINK_CORNERS, KERNEL_SHRINK_FRUSTA, KERNEL_SHRINK_RAYS } kernel_shrink;

typedef struct kernel_params {
    unsigned cull_backface; /* 1: triangles are hit from their front only */
    unsigned max_leaf;      /* triangles in a leaf of the BVH, at most */
    unsigned bins;          /* of the BVH builder, per axis */
    unsigned net;           /* kernel_net */
    unsigned assignment;    /* kernel_assignment */
    unsigned interleaved;   /* 1: neighbouring pixels use different sets */
    unsigned shrink;        /* kernel_shrink */
    unsigned samples;       /* option --samples: shadow rays a pixel; 0: the kernel traces none */
    double light_scale;     /* option --light-scale: of the light's edges, about its centre */
} kernel_params;

/* The rows of the table; a kernel's descriptor says which it takes: bit i is row i. */
typedef enum kernel_param {
    KERNEL_PARAM_CULL_BACKFACE,
    KERNEL_PARAM_MAX_LEAF,
    KERNEL_PARAM_BINS,
    KERNEL_PARAM_NET,
    KERNEL_PARAM_ASSIGNMENT,
    KERNEL_PARAM_INTERLEAVED,
    KERNEL_PARAM_SHRINK,
    KERNEL_PARAM_COUNT
} kernel_param;

/* One row of the table of parameters. */
typedef struct kernel_param_info {
    const char *name;
    unsigned min, max;
    const char *sentence;
    size_t offset;             /* of the field in kernel_params */
    const char *const *values; /* names of the values min..max, or NULL: numbers */
} kernel_param_info;

/** The parameters that kernels take; *count rows, in the order of kernel_param. */
const kernel_param_info *kernel_param_list(size_t *count);

/** The value of one parameter. */
static inline unsigned kernel_param_get(const kernel_params *params, const kernel_param_info *info)
{
    return *(const unsigned *)((const char *)params + info->offset);
}

/**
 * Set one parameter from `KEY=VALUE`.
 *
 * @param takes  the rows that may be set: bit i is row i
 *
 * Errors: BASE_ERR_USAGE naming the parameter (unknown, not a number or name of a value, range).
 */
base_status kernel_params_set(kernel_params *params, uint64_t takes, const char *assignment, base_error *err);

/** Whether so many shadow rays a pixel can be traced: 4, 16, 64, 256, 1024 or 4096. Errors: BASE_ERR_USAGE naming --samples. */
base_status kernel_params_check_samples(unsigned long samples, base_error *err);

#endif
