/* Ids and meanings of the counters in counters.def. Counting is measurement: it costs the simulated machine nothing. */
#ifndef KERNELS_COUNTERS_H
#define KERNELS_COUNTERS_H

#include <stdint.h>

typedef enum kernel_counter {
#define COUNTER(id, unit, where, sentence) KERNEL_##id, /* KERNEL_rays, */
#include "kernels/counters.def"
    KERNEL_COUNTER_COUNT
} kernel_counter;

typedef struct kernel_counts {
    uint64_t n[KERNEL_COUNTER_COUNT];
} kernel_counts;

typedef struct kernel_counter_info {
    const char *name, *unit, *where, *sentence;
} kernel_counter_info;

static const kernel_counter_info kernel_counter_table[KERNEL_COUNTER_COUNT] = {
#define COUNTER(id, unit, where, sentence) {#id, unit, where, sentence}, /* {"rays", "rays", "MFT Table 1", "..."}, */
#include "kernels/counters.def"
};

#endif
