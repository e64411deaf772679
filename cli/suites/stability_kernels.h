/* The kernels that the stability report tries: those there are, and variants that hard cases could break and that are off by default. */
#ifndef CLI_SUITES_STABILITY_KERNELS_H
#define CLI_SUITES_STABILITY_KERNELS_H

#include "cli/command.h"
#include "kernels/kernel.h"

enum { STABILITY_MAX_KERNELS = 64, STABILITY_VARIANTS = 2 };

typedef struct stability_kernels {
    const kernel_info *list[STABILITY_MAX_KERNELS]; /* NULL beyond `count` */
    size_t count;
    kernel_info variants[STABILITY_VARIANTS]; /* that the list refers to: not to be copied */
    size_t variant_count;
} stability_kernels;

/**
 * The kernels with these names.
 *
 * @param names     none: all
 * @param variants  kernels with entry points are followed by themselves with empty occluders
 * @param out       zero
 */
void stability_kernels_choose(const command_list *names, bool variants, stability_kernels *out);

#endif
