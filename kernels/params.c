#include "kernels/params.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const net_names[] = {"hammersley", "larcher-pillichshammer"};
static const char *const assignment_names[] = {"permuted", "rank", "bits"};
static const char *const shrink_names[] = {"none", "corner-rays", "frusta", "ray-aabb"};
static const char *const its_names[] = {"16", "32", "64", "128", "256"};
static const char *const sf_names[] = {"4", "16"};
static const char *const mts_names[] = {"4", "8", "16", "32", "64", "128", "256"};
static const char *const culling_names[] = {"inverse", "direct", "corner-rays"};
static const char *const divergent_names[] = {"split", "xp"};
static const char *const packets_names[] = {"octants", "rays"};
static const char *const shadow_packets_names[] = {"whole", "normal", "triangle"};
static const char *const shader_names[] = {"none", "simple"};
static const char *const marking_names[] = {"pixel", "block"};

static const kernel_param_info param_table[KERNEL_PARAM_COUNT] = {
    [KERNEL_PARAM_CULL_BACKFACE] = {"cull_backface", 0, 1, "1: triangles are hit from their front side only", offsetof(kernel_params, cull_backface), NULL},
    [KERNEL_PARAM_MAX_LEAF] = {"max_leaf", 1, 64, "most triangles in a leaf of the BVH", offsetof(kernel_params, max_leaf), NULL},
    [KERNEL_PARAM_BINS] = {"bins", 2, 64, "bins per axis of the BVH builder", offsetof(kernel_params, bins), NULL},
    [KERNEL_PARAM_NET] = {"net", 0, 1, "the points on the light that the sets of 16 are taken from", offsetof(kernel_params, net), net_names},
    [KERNEL_PARAM_ASSIGNMENT] = {"assignment", 0, 2, "how the points are dealt out to the sets", offsetof(kernel_params, assignment), assignment_names},
    [KERNEL_PARAM_INTERLEAVED] = {"interleaved", 0, 1, "1: the 16 pixels of a 4x4 pattern use different sets", offsetof(kernel_params, interleaved), NULL},
    [KERNEL_PARAM_SHRINK] = {"shrink", 0, 3, "what is made smaller when some rays of a shadow frustum are blocked", offsetof(kernel_params, shrink), shrink_names},
    [KERNEL_PARAM_EMPTY_PERCENT] = {"empty_percent", 1, 100, "empty space of more than so much of a cell's length is cut off; 100: none", offsetof(kernel_params, empty_percent), NULL},
    [KERNEL_PARAM_COVERED_PLANES] = {"covered_planes", 0, 1, "1: cells are cut at planes that triangles cover", offsetof(kernel_params, covered_planes), NULL},
    [KERNEL_PARAM_MIN_AREA] = {"min_area", 0, 1000000000, "smallest surface of a cell made by cost, in billionths of the scene's", offsetof(kernel_params, min_area), NULL},
    [KERNEL_PARAM_PERFECT_SPLITS] = {"perfect_splits", 0, 1, "1: triangles are clipped to their cells, 0: only their boxes", offsetof(kernel_params, perfect_splits), NULL},
    [KERNEL_PARAM_EMPTY_OCCLUDERS] = {"empty_occluders", 0, 1, "1: empty cells inside closed objects are found and end a search", offsetof(kernel_params, empty_occluders), NULL},
    [KERNEL_PARAM_MAILBOX] = {"mailbox", 0, 1, "1: a packet remembers the triangles that it has tested", offsetof(kernel_params, mailbox), NULL},
    [KERNEL_PARAM_ITS] = {"its", 0, 4, "edge of the initial tile, in pixels", offsetof(kernel_params, its), its_names},
    [KERNEL_PARAM_SF] = {"sf", 0, 1, "parts that a tile is split into", offsetof(kernel_params, sf), sf_names},
    [KERNEL_PARAM_MTS] = {"mts", 0, 6, "a tile of this edge or less is not split", offsetof(kernel_params, mts), mts_names},
    [KERNEL_PARAM_CULLING] = {"culling", 0, 2, "how cells are tested against a tile's rays; corner-rays is unsound", offsetof(kernel_params, culling), culling_names},
    [KERNEL_PARAM_DIVERGENT] = {"divergent", 0, 1, "tiles whose rays differ in sign are split on, or traced at once", offsetof(kernel_params, divergent), divergent_names},
    [KERNEL_PARAM_DIVERGENT_PACKETS] = {"divergent_packets", 0, 1, "packets whose rays differ in sign are traced by octants, or ray by ray", offsetof(kernel_params, divergent_packets), packets_names},
    [KERNEL_PARAM_ENDS] = {"ends", 0, 1, "1: a triangle that all rays of a tile hit ends its search", offsetof(kernel_params, ends), NULL},
    [KERNEL_PARAM_SHADOW_PACKETS] = {"shadow_packets", 0, 2, "shadow rays of a block that go together: all, of surfaces that face alike, of one triangle", offsetof(kernel_params, shadow_packets), shadow_packets_names},
    [KERNEL_PARAM_EARLY_TERMINATION] = {"early_termination", 0, 1, "1: a shadow ray that is blocked is done with; 0: it goes on with its packet", offsetof(kernel_params, early_termination), NULL},
    [KERNEL_PARAM_FILTER] = {"filter", 0, 1, "1: a second pass takes means over 4x4 pixels of a surface", offsetof(kernel_params, filter), NULL},
    [KERNEL_PARAM_MARKING] = {"marking", 0, 1, "what is marked where a silhouette crosses: pixels, or blocks of 4x4", offsetof(kernel_params, marking), marking_names},
    [KERNEL_PARAM_RETRACE] = {"retrace", 0, 1, "1: 16 samples of each marked pixel are traced; 0: pixels are marked only", offsetof(kernel_params, retrace), NULL},
    [KERNEL_PARAM_SHADER] = {"shader", 0, 1, "what hits are shaded by: nothing, or Lambert's law with a light at the eye", offsetof(kernel_params, shader), shader_names},
};

const kernel_param_info *kernel_param_list(size_t *count)
{
    *count = KERNEL_PARAM_COUNT;
    return param_table;
}

static void append(char *text, size_t size, const char *item)
{
    size_t length = strlen(text);
    snprintf(text + length, size - length, "%s%s", length ? ", " : "", item);
}

static base_status set_named(const kernel_param_info *info, unsigned *field, const char *value, base_error *err)
{
    char names[160] = "";
    for (unsigned i = info->min; i <= info->max; i++) {
        if (strcmp(info->values[i], value) == 0) {
            *field = i;
            return BASE_OK;
        }
        append(names, sizeof names, info->values[i]);
    }
    return base_fail(err, BASE_ERR_USAGE, "--param", "%s: no value '%s' (there are %s)", info->name, value, names);
}

static base_status set_number(const kernel_param_info *info, unsigned *field, const char *text, base_error *err)
{
    char *end;
    errno = 0;
    unsigned long value = strtoul(text, &end, 10);
    if (*text < '0' || *text > '9' || *end || errno || value < info->min || value > info->max)
        return base_fail(err, BASE_ERR_USAGE, "--param", "%s: '%s' is not a whole number in %u..%u", info->name, text, info->min,
                         info->max);
    *field = (unsigned)value;
    return BASE_OK;
}

base_status kernel_params_set(kernel_params *params, uint64_t takes, const char *assignment, base_error *err)
{
    char names[320] = "";
    size_t length = strcspn(assignment, "=");
    if (assignment[length] != '=')
        return base_fail(err, BASE_ERR_USAGE, "--param", "'%s' is not KEY=VALUE", assignment);
    for (size_t i = 0; i < KERNEL_PARAM_COUNT; i++) {
        const kernel_param_info *info = &param_table[i];
        if (!(takes >> i & 1))
            continue;
        append(names, sizeof names, info->name);
        if (strlen(info->name) != length || strncmp(info->name, assignment, length) != 0)
            continue;
        unsigned *field = (unsigned *)((char *)params + info->offset);
        return info->values ? set_named(info, field, assignment + length + 1, err)
                            : set_number(info, field, assignment + length + 1, err);
    }
    return base_fail(err, BASE_ERR_USAGE, "--param", "no parameter '%.*s' (there are %s)", (int)length, assignment, names);
}

base_status kernel_params_check_samples(unsigned long samples, base_error *err)
{
    for (unsigned long n = 4; n <= 4096; n *= 4)
        if (n == samples)
            return BASE_OK;
    return base_fail(err, BASE_ERR_USAGE, "--samples", "%lu is not 4, 16, 64, 256, 1024 or 4096", samples);
}
