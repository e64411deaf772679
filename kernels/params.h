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

/* How multi-level ray tracing culls cells, what it does with tiles whose rays differ in sign, and with such packets
   (docs/kernels-mlrta.md). */
typedef enum kernel_culling { KERNEL_CULL_INVERSE, KERNEL_CULL_DIRECT, KERNEL_CULL_CORNER_RAYS } kernel_culling;
typedef enum kernel_divergent { KERNEL_DIVERGENT_SPLIT, KERNEL_DIVERGENT_XP } kernel_divergent;
typedef enum kernel_packets { KERNEL_PACKETS_OCTANTS, KERNEL_PACKETS_RAYS } kernel_packets;
/* Which shadow rays of a block are traced together: all, those from surfaces that face alike, or those from one triangle. */
typedef enum kernel_shadow_packets { KERNEL_SHADOW_WHOLE, KERNEL_SHADOW_NORMAL, KERNEL_SHADOW_TRIANGLE } kernel_shadow_packets;

/* What is marked where a silhouette crosses: the pixels that it crosses, or the blocks of 4x4. */
typedef enum kernel_marking { KERNEL_MARKING_PIXEL, KERNEL_MARKING_BLOCK } kernel_marking;

/* What primary rays shade: nothing, or their hits by a light at the eye (kernels/shade16.h). */
typedef enum kernel_shader { KERNEL_SHADER_NONE, KERNEL_SHADER_SIMPLE } kernel_shader;

typedef struct kernel_params {
    unsigned cull_backface; /* 1: triangles are hit from their front only */
    unsigned max_leaf;      /* triangles in a leaf of the BVH, at most */
    unsigned bins;          /* of the BVH builder, per axis */
    unsigned net;           /* kernel_net */
    unsigned assignment;    /* kernel_assignment */
    unsigned interleaved;   /* 1: neighbouring pixels use different sets */
    unsigned shrink;        /* kernel_shrink */
    unsigned filter;        /* 1: a second pass filters soft shadows (kernels/visibility_filter.c) */
    unsigned empty_percent, covered_planes, min_area, perfect_splits, empty_occluders; /* of the kd-tree (kernels/accel/kdtree.h) */
    unsigned mailbox;       /* 1: a packet remembers which triangles it has tested */
    unsigned its, mts;      /* edge of the initial tile, 16 << its pixels; tiles of 4 << mts pixels or fewer are not split */
    unsigned sf;            /* a tile is split into 4 << 2 sf */
    unsigned culling;       /* kernel_culling */
    unsigned divergent;     /* kernel_divergent */
    unsigned divergent_packets; /* kernel_packets */
    unsigned shadow_packets; /* kernel_shadow_packets */
    unsigned early_termination; /* 1: a hard shadow ray that is blocked is done with; 0: it goes on with its packet */
    unsigned hard_shadows;  /* no parameter: 1: the kernel traces a ray to the light's point from each hit */
    unsigned msaa;          /* no parameter: 1: the kernel marks pixels that silhouettes cross */
    unsigned marking;       /* kernel_marking */
    unsigned retrace;       /* 1: 16 samples of marked pixels are traced */
    unsigned ends;          /* 1: a triangle that all rays of a tile hit ends the search for its entry point */
    unsigned shader;        /* kernel_shader */
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
    KERNEL_PARAM_EMPTY_PERCENT,
    KERNEL_PARAM_COVERED_PLANES,
    KERNEL_PARAM_MIN_AREA,
    KERNEL_PARAM_PERFECT_SPLITS,
    KERNEL_PARAM_EMPTY_OCCLUDERS,
    KERNEL_PARAM_MAILBOX,
    KERNEL_PARAM_ITS,
    KERNEL_PARAM_SF,
    KERNEL_PARAM_MTS,
    KERNEL_PARAM_CULLING,
    KERNEL_PARAM_DIVERGENT,
    KERNEL_PARAM_DIVERGENT_PACKETS,
    KERNEL_PARAM_ENDS,
    KERNEL_PARAM_SHADOW_PACKETS,
    KERNEL_PARAM_EARLY_TERMINATION,
    KERNEL_PARAM_FILTER,
    KERNEL_PARAM_MARKING,
    KERNEL_PARAM_RETRACE,
    KERNEL_PARAM_SHADER,
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
