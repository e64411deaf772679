/* Touches memory in ways that caches tell apart: small and large strides, a working set that fits and one that does not,
 * and random words. Run under valgrind by cache_valgrind.py. */
#include <stdint.h>
#include <stdio.h>

enum { WORDS = 128 * 1024 };
static volatile uint32_t words[WORDS];

int main(void)
{
    uint32_t sum = 0, state = 1;
    for (unsigned stride = 1; stride <= 4096; stride *= 8)
        for (unsigned i = 0; i < 16000; i++)
            sum += words[i * stride % WORDS];
    for (unsigned pass = 0; pass < 8; pass++)
        for (unsigned i = 0; i < 4096; i++)
            words[i] += pass;
    for (unsigned i = 0; i < 60000; i++) {
        state = state * 1664525u + 1013904223u;
        words[(state >> 8) % WORDS] = sum;
    }
    printf("%u\n", (unsigned)sum);
    return 0;
}
