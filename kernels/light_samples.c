#include "kernels/light_samples.h"

#include <assert.h>

#include "lrbni/base/random.h"

enum { CELLS = 16, MOST_SETS = 256 };

static const uint64_t permutation_seed = 16;

/* Radical inverse in base 2 with the direction numbers 0.1, 0.01, 0.001... (Hammersley) or 0.1, 0.11, 0.111... */
static float second_coordinate(kernel_net net, unsigned i)
{
    uint32_t bits = 0, direction = UINT32_C(1) << 31;
    for (; i; i >>= 1) {
        if (i & 1)
            bits ^= direction;
        direction = net == KERNEL_NET_HAMMERSLEY ? direction >> 1 : direction >> 1 | UINT32_C(1) << 31;
    }
    return (float)bits * 0x1p-32f;
}

/* Fisher and Yates. */
static void permute(base_random *random, unsigned count, unsigned order[MOST_SETS])
{
    for (unsigned i = 0; i < count; i++)
        order[i] = i;
    for (unsigned i = count - 1; i > 0; i--) {
        unsigned j = (unsigned)(base_random_bits(random) % (i + 1)), swapped = order[i];
        order[i] = order[j];
        order[j] = swapped;
    }
}

void light_samples_fill(kernel_net net, kernel_assignment assignment, unsigned count, light_samples *sets)
{
    unsigned order[CELLS][MOST_SETS], seen[CELLS] = {0};
    base_random random = {permutation_seed};
    assert(count == 16 || count == 64 || count == MOST_SETS);
    for (unsigned cell = 0; cell < CELLS; cell++)
        permute(&random, count, order[cell]);
    for (unsigned i = 0; i < count * CELLS; i++) {
        float a = (float)i / (float)(count * CELLS), b = second_coordinate(net, i);
        unsigned cell = (unsigned)(4 * b) * 4 + (unsigned)(4 * a), rank = seen[cell]++;
        unsigned set = assignment == KERNEL_ASSIGN_PERMUTED ? order[cell][rank]
                       : assignment == KERNEL_ASSIGN_RANK   ? rank
                                                            : i >> 2 & (count - 1);
        sets[set].a[cell] = a;
        sets[set].b[cell] = b;
    }
}
