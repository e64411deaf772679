#include "kernels/kernel.h"

#include <string.h>

const char *const kernel_phase_names[KERNEL_PHASE_COUNT] = {"setup", "traversal", "culling", "intersection", "shading", "entry search", "filter", "silhouettes"};

/* KERNEL_TILES(mft_primary): declares mft_primary_native, mft_primary_count, mft_primary_record, mft_primary_touch and mft_primary_annotated */
#define KERNEL_TILES(name) extern kernel_tile_fn name##_native, name##_count, name##_record, name##_touch, name##_annotated
KERNEL_TILES(packet16_primary);
KERNEL_TILES(packet256_primary);
KERNEL_TILES(mft_primary);
KERNEL_TILES(packet16_soft);
KERNEL_TILES(packet256_soft);
KERNEL_TILES(mft_soft);
KERNEL_TILES(mft_msaa);
KERNEL_TILES(kd16_primary);
KERNEL_TILES(kd16_shadow);
KERNEL_TILES(mlrta_primary);
KERNEL_TILES(mlrta_shadow);
#undef KERNEL_TILES

#define BIT(counter) (UINT64_C(1) << KERNEL_##counter)
#define PARAM(row) (UINT64_C(1) << KERNEL_PARAM_##row)

static const uint64_t tracing_params = PARAM(CULL_BACKFACE) | PARAM(MAX_LEAF) | PARAM(BINS);
static const uint64_t tracing_phases = UINT64_C(1) << KERNEL_PHASE_SETUP | UINT64_C(1) << KERNEL_PHASE_TRAVERSAL |
                                       UINT64_C(1) << KERNEL_PHASE_CULLING | UINT64_C(1) << KERNEL_PHASE_INTERSECTION;

static const uint64_t tracing_counters = BIT(rays) | BIT(rays_primary) | BIT(tri_accesses) | BIT(tri_after_culling) |
                                         BIT(aabb_tests) | BIT(isect_tests) | BIT(traversed_cells) | BIT(traversed_inner) |
                                         BIT(units_common) | BIT(units_blend) | BIT(units_zero);

static const uint64_t soft_params = PARAM(NET) | PARAM(ASSIGNMENT) | PARAM(INTERLEAVED) | PARAM(FILTER);
static const uint64_t soft_phases = UINT64_C(1) << KERNEL_PHASE_SHADING | UINT64_C(1) << KERNEL_PHASE_FILTER;

static const uint64_t kdtree_params = PARAM(CULL_BACKFACE) | PARAM(EMPTY_PERCENT) | PARAM(COVERED_PLANES) | PARAM(MIN_AREA) |
                                      PARAM(PERFECT_SPLITS) | PARAM(MAILBOX) | PARAM(DIVERGENT_PACKETS);

static const uint64_t kdtree_counters = BIT(rays) | BIT(rays_primary) | BIT(tri_accesses) | BIT(tri_after_culling) | BIT(isect_tests) |
                                        BIT(isect_hits) | BIT(mailbox_hits) | BIT(traversed_cells) | BIT(traversed_inner) |
                                        BIT(units_packets) | BIT(units_divergent) | BIT(units_common) | BIT(units_blend) | BIT(units_zero);

static const uint64_t entry_params = PARAM(EMPTY_OCCLUDERS) | PARAM(ITS) | PARAM(SF) | PARAM(MTS) | PARAM(CULLING) | PARAM(DIVERGENT) | PARAM(ENDS);

static const uint64_t entry_counters = BIT(ep_cells) | BIT(ep_inner) | BIT(end_tests) | BIT(end_hits) | BIT(units_tiles) |
                                       BIT(units_empty_tiles) | BIT(units_divergent_tiles);

static const uint64_t hard_shadow_params = PARAM(SHADOW_PACKETS) | PARAM(EARLY_TERMINATION);

/* The parameters that all kernels on the kd-tree have; those with hard shadows. */
#define KDTREE_DEFAULTS .empty_percent = 10, .covered_planes = 1, .min_area = 100, .perfect_splits = 1, .mailbox = 1, .light_scale = 1
#define HARD_SHADOW_DEFAULTS .shadow_packets = KERNEL_SHADOW_TRIANGLE, .early_termination = 1, .hard_shadows = 1

const kernel_info *kernel_list(size_t *count)
{
    /* Leaf limits: deep for packets, shallow for frusta (docs/kernels.md). */
    static const kernel_info kernels[] = {
        {
            .name = "packet16-primary",
            .summary = "primary rays in 4x4 packets through a deep BVH: the MFT paper's reference",
            .paper = "Benthin and Wald 2009, 5: P-Packet",
            .defaults = {.cull_backface = 0, .max_leaf = 2, .bins = 16, .light_scale = 1},
            .counters = tracing_counters | BIT(units_packets),
            .params = tracing_params | PARAM(SHADER),
            .phases = tracing_phases,
            .tile = {packet16_primary_native, packet16_primary_count, packet16_primary_record, packet16_primary_touch},
            .annotated = packet16_primary_annotated,
        },
        {
            .name = "packet256-primary",
            .summary = "primary rays in groups of 16 packets of 4x4 through the shallow BVH of mft-primary: the MFT paper's other reference",
            .paper = "Benthin and Wald 2009, 5.2",
            .defaults = {.cull_backface = 0, .max_leaf = 8, .bins = 16, .light_scale = 1},
            .counters = tracing_counters | BIT(aabb_group_tests) | BIT(units_groups) | BIT(units_packets),
            .params = tracing_params | PARAM(SHADER),
            .phases = tracing_phases,
            .tile = {packet256_primary_native, packet256_primary_count, packet256_primary_record, packet256_primary_touch},
            .annotated = packet256_primary_annotated,
        },
        {
            .name = "mft-primary",
            .summary = "primary rays in groups of 16 frusta of 4x4 through a shallow BVH: multi-frusta tracing",
            .paper = "Benthin and Wald 2009, 4 and appendix A: P-Frusta",
            .defaults = {.cull_backface = 0, .max_leaf = 8, .bins = 16, .light_scale = 1},
            .counters = tracing_counters | BIT(units_groups) | BIT(units_frusta),
            .params = tracing_params | PARAM(SHADER),
            .phases = tracing_phases,
            .tile = {mft_primary_native, mft_primary_count, mft_primary_record, mft_primary_touch},
            .annotated = mft_primary_annotated,
        },
        {
            .name = "packet16-soft",
            .summary = "soft shadows, the 16 samples of a hit point a packet, through a deep BVH: the MFT paper's reference",
            .paper = "Benthin and Wald 2009, 5: S-Packet",
            .defaults = {.cull_backface = 0, .max_leaf = 2, .bins = 16, .interleaved = 1, .filter = 1, .samples = 16, .light_scale = 1},
            .counters = tracing_counters | BIT(rays_shadow) | BIT(units_packets) | BIT(units_shadow_packets),
            .params = tracing_params | soft_params,
            .phases = tracing_phases | soft_phases,
            .tile = {packet16_soft_native, packet16_soft_count, packet16_soft_record, packet16_soft_touch},
            .annotated = packet16_soft_annotated,
        },
        {
            .name = "packet256-soft",
            .summary = "soft shadows in groups of 16 hit points with a packet of 16 rays each, through the shallow BVH of mft-soft: the MFT paper's other reference",
            .paper = "Benthin and Wald 2009, 5.2",
            .defaults = {.cull_backface = 0, .max_leaf = 8, .bins = 16, .interleaved = 1, .filter = 1, .samples = 16, .light_scale = 1},
            .counters = tracing_counters | BIT(aabb_group_tests) | BIT(rays_shadow) | BIT(units_groups) | BIT(units_packets) |
                        BIT(units_shadow_groups) | BIT(units_shadow_packets),
            .params = tracing_params | soft_params,
            .phases = tracing_phases | soft_phases,
            .tile = {packet256_soft_native, packet256_soft_count, packet256_soft_record, packet256_soft_touch},
            .annotated = packet256_soft_annotated,
        },
        {
            .name = "mft-soft",
            .summary = "soft shadows, groups of 16 hit points with a frustum of 16 rays each, through a shallow BVH: multi-frusta tracing",
            .paper = "Benthin and Wald 2009, 4 and appendix A: S-Frusta",
            .defaults = {.cull_backface = 0, .max_leaf = 8, .bins = 16, .interleaved = 1, .filter = 1, .samples = 16, .light_scale = 1},
            .counters = tracing_counters | BIT(rays_shadow) | BIT(additional_tests) | BIT(additional_tests16) | BIT(units_groups) |
                        BIT(units_frusta) | BIT(units_shadow_groups) | BIT(units_shadow_frusta),
            .params = tracing_params | soft_params | PARAM(SHRINK),
            .phases = tracing_phases | soft_phases,
            .tile = {mft_soft_native, mft_soft_count, mft_soft_record, mft_soft_touch},
            .annotated = mft_soft_annotated,
        },
        {
            .name = "mft-msaa",
            .summary = "primary rays as mft-primary, then 16 samples of each pixel that a silhouette crosses: adaptive anti-aliasing",
            .paper = "Benthin and Wald 2009, 6.1 and Figure 7",
            .defaults = {.cull_backface = 0, .max_leaf = 8, .bins = 16, .msaa = 1, .marking = KERNEL_MARKING_PIXEL, .retrace = 1, .light_scale = 1},
            .counters = tracing_counters | BIT(rays_msaa) | BIT(silhouettes) | BIT(edge_tests) | BIT(pixels_marked) | BIT(units_groups) |
                        BIT(units_frusta) | BIT(units_msaa_groups) | BIT(units_msaa_frusta),
            .params = tracing_params | PARAM(MARKING) | PARAM(RETRACE),
            .phases = tracing_phases | UINT64_C(1) << KERNEL_PHASE_SILHOUETTES,
            .tile = {mft_msaa_native, mft_msaa_count, mft_msaa_record, mft_msaa_touch},
            .annotated = mft_msaa_annotated,
        },
        {
            .name = "kd16-primary",
            .summary = "primary rays in 4x4 packets through the kd-tree from its root: the rows 'no MLRT' of the MLRTA paper",
            .paper = "Reshetov, Soupikov and Hurley 2005, 4.3",
            .defaults = {KDTREE_DEFAULTS},
            .accel = KERNEL_ACCEL_KDTREE,
            .counters = kdtree_counters,
            .params = kdtree_params | PARAM(SHADER),
            .phases = tracing_phases,
            .tile = {kd16_primary_native, kd16_primary_count, kd16_primary_record, kd16_primary_touch},
            .annotated = kd16_primary_annotated,
        },
        {
            .name = "kd16-shadow",
            .summary = "the same, then hard shadows in packets from a point light",
            .paper = "Reshetov, Soupikov and Hurley 2005, 5",
            .defaults = {KDTREE_DEFAULTS, HARD_SHADOW_DEFAULTS},
            .accel = KERNEL_ACCEL_KDTREE,
            .counters = kdtree_counters | BIT(rays_shadow) | BIT(units_hard_packets),
            .params = kdtree_params | hard_shadow_params,
            .phases = tracing_phases | UINT64_C(1) << KERNEL_PHASE_SHADING,
            .tile = {kd16_shadow_native, kd16_shadow_count, kd16_shadow_record, kd16_shadow_touch},
            .annotated = kd16_shadow_annotated,
        },
        {
            .name = "mlrta-primary",
            .summary = "primary rays in tiles that search their entry point into the kd-tree, then in 4x4 packets: multi-level ray tracing",
            .paper = "Reshetov, Soupikov and Hurley 2005, 3.3 to 4.3",
            .defaults = {KDTREE_DEFAULTS, .its = 3, .sf = 1, .mts = 3, .ends = 1},
            .accel = KERNEL_ACCEL_KDTREE,
            .counters = kdtree_counters | entry_counters,
            .params = kdtree_params | entry_params | PARAM(SHADER),
            .phases = tracing_phases | UINT64_C(1) << KERNEL_PHASE_ENTRY,
            .tile = {mlrta_primary_native, mlrta_primary_count, mlrta_primary_record, mlrta_primary_touch},
            .annotated = mlrta_primary_annotated,
        },
        {
            .name = "mlrta-shadow",
            .summary = "the same, then hard shadows of a point light from entry points of 16x16 tiles of hits",
            .paper = "Reshetov, Soupikov and Hurley 2005, 5",
            .defaults = {KDTREE_DEFAULTS, .its = 3, .sf = 1, .mts = 3, .ends = 1, HARD_SHADOW_DEFAULTS},
            .accel = KERNEL_ACCEL_KDTREE,
            .counters = kdtree_counters | entry_counters | BIT(rays_shadow) | BIT(units_hard_packets),
            .params = kdtree_params | entry_params | hard_shadow_params,
            .phases = tracing_phases | UINT64_C(1) << KERNEL_PHASE_ENTRY | UINT64_C(1) << KERNEL_PHASE_SHADING,
            .tile = {mlrta_shadow_native, mlrta_shadow_count, mlrta_shadow_record, mlrta_shadow_touch},
            .annotated = mlrta_shadow_annotated,
        },
    };
    *count = sizeof kernels / sizeof *kernels;
    return kernels;
}

const kernel_info *kernel_find(const char *name)
{
    size_t count;
    const kernel_info *kernels = kernel_list(&count);
    for (size_t i = 0; i < count; i++)
        if (strcmp(kernels[i].name, name) == 0)
            return &kernels[i];
    return NULL;
}
