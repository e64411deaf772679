/* Emulated ops per second, an op and a back end a row; operands from the host's first cache, results into it.
 *
 *   bench_ops [OP...]
 *
 * The back ends take turns; a number is the median of seven runs of about a fifth of a millisecond. Rows of CSV on stdout:
 * million ops a second, and as a multiple of the portable back end's number.
 */
#include <stdio.h>
#include <string.h>

#include "tests/bench/measure.h"
#include "tests/bench/op_loops.h"

enum { RUNS = 7 };

static const op_loops *const backends[] = {
    &op_loops_portable,
#ifdef BENCH_AVX2
    &op_loops_avx2,
#endif
#ifdef BENCH_AVX512
    &op_loops_avx512,
#endif
};
enum { BACKENDS = sizeof backends / sizeof backends[0] };

static double seconds_of(const op_loop *loop, lrb_ctx *c, uint64_t count)
{
    double start = measure_seconds();
    loop->run(c, count);
    return measure_seconds() - start;
}

/* So many that a run takes long enough for the clock. */
static uint64_t count_for(const op_loop *loop, lrb_ctx *c)
{
    uint64_t count = 1024;
    while (seconds_of(loop, c, count) < 2e-4)
        count *= 2;
    return count;
}

static void measure_op(lrb_ctx *c, int row)
{
    double seconds[BACKENDS][RUNS];
    uint64_t counts[BACKENDS];
    double portable = 0;
    for (int b = 0; b < BACKENDS; b++) {
        backends[b]->fill();
        counts[b] = count_for(&backends[b]->loops[row], c);
    }
    for (int run = 0; run < RUNS; run++)
        for (int b = 0; b < BACKENDS; b++) {
            backends[b]->fill();
            seconds[b][run] = seconds_of(&backends[b]->loops[row], c, counts[b]);
        }
    for (int b = 0; b < BACKENDS; b++) {
        double millions = 1e-6 * (double)counts[b] / measure_median(seconds[b], RUNS);
        portable = b == 0 ? millions : portable;
        printf("ops/%s,%s,%.1f,%.2f\n", lrb_op_table[backends[b]->loops[row].op].id, backends[b]->backend, millions,
               millions / portable);
    }
}

static int wanted(const char *id, int argc, char **argv)
{
    for (int i = 1; i < argc; i++)
        if (strcmp(argv[i], id) == 0)
            return 1;
    return argc < 2;
}

int main(int argc, char **argv)
{
    lrb_ctx *c = NULL;
    base_error err;
    if (lrb_ctx_create(NULL, NULL, &c, &err) != BASE_OK) {
        fprintf(stderr, "bench_ops: error: %s: %s\n", err.what, err.why);
        return 1;
    }
    int measured = 0;
    measure_print_head();
    printf("row,backend,million_ops_per_second,times_portable\n");
    for (int row = 0; row < backends[0]->count; row++)
        if (wanted(lrb_op_table[backends[0]->loops[row].op].id, argc, argv)) {
            measure_op(c, row);
            measured++;
        }
    lrb_ctx_destroy(&c);
    if (!measured)
        fprintf(stderr, "bench_ops: error: none of the ops named is measured here\n");
    return measured ? 0 : 2;
}
