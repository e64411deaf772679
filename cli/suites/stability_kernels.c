#include "cli/suites/stability_kernels.h"

#include <string.h>

/* What a variant is called; kernels without an entry have none. */
static const struct variant {
    const char *kernel, *name;
} occluders[STABILITY_VARIANTS] = {
    {"mlrta-primary", "mlrta-primary, empty_occluders=1"},
    {"mlrta-shadow", "mlrta-shadow, empty_occluders=1"},
};

static bool is_wanted(const command_list *names, const char *name)
{
    bool wanted = names->count == 0;
    for (size_t i = 0; i < names->count; i++)
        wanted |= strcmp(names->items[i], name) == 0;
    return wanted;
}

static void append_variants(const kernel_info *kernel, stability_kernels *out)
{
    for (size_t k = 0; k < sizeof occluders / sizeof *occluders; k++) {
        if (strcmp(occluders[k].kernel, kernel->name) != 0)
            continue;
        kernel_info *variant = &out->variants[out->variant_count++];
        *variant = *kernel;
        variant->name = occluders[k].name;
        variant->defaults.empty_occluders = 1;
        out->list[out->count++] = variant;
    }
}

void stability_kernels_choose(const command_list *names, bool variants, stability_kernels *out)
{
    size_t count;
    const kernel_info *all = kernel_list(&count);
    for (size_t i = 0; i < count && out->count + STABILITY_VARIANTS < STABILITY_MAX_KERNELS; i++) {
        if (!is_wanted(names, all[i].name))
            continue;
        out->list[out->count++] = &all[i];
        if (variants)
            append_variants(&all[i], out);
    }
}
