#include "tests/bench/measure.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

double measure_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

int measure_picture_parse(int argc, char **argv, unsigned most_size, measure_picture *out)
{
    int i = 1;
    for (; i < argc && argv[i][0] == '-'; i += 2) {
        char *end = NULL;
        const long value = i + 1 < argc ? strtol(argv[i + 1], &end, 10) : 0;
        const bool number = end && end != argv[i + 1] && !*end;
        if (number && strcmp(argv[i], "--size") == 0 && value >= 1 && value <= (long)most_size)
            out->size = (unsigned)value;
        else if (number && strcmp(argv[i], "--repeat") == 0 && value >= 1 && value <= MEASURE_MAX_RUNS)
            out->repeat = (int)value;
        else
            return 0;
    }
    return i;
}

static int compare_doubles(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double measure_median(const double *numbers, int count)
{
    double sorted[MEASURE_MAX_RUNS];
    memcpy(sorted, numbers, (size_t)count * sizeof *sorted);
    qsort(sorted, (size_t)count, sizeof *sorted, compare_doubles);
    return 0.5 * (sorted[(count - 1) / 2] + sorted[count / 2]);
}

void measure_print_head(void)
{
    char line[512], *name = NULL;
    FILE *file = fopen("/proc/cpuinfo", "r");
    printf("# compiler: %s %s, back end %s\n", BENCH_COMPILER, BENCH_FLAGS, BENCH_BACKEND);
    while (file && !name && fgets(line, sizeof line, file))
        if (strncmp(line, "model name", 10) == 0)
            name = strchr(line, ':');
    if (name)
        printf("# cpu%s", name);
    else
        printf("# cpu: unknown\n");
    if (file)
        fclose(file);
}

base_status measure_bvh_build(const scene *s, const bvh_options *options, int repeat, double *best, bvh **out, base_error *err)
{
    *out = NULL;
    for (int i = 0; i < repeat; i++) {
        bvh_destroy(out);
        double start = measure_seconds();
        base_status status = bvh_build(s, options, out, err);
        double seconds = measure_seconds() - start;
        if (status != BASE_OK)
            return status;
        if (i == 0 || seconds < *best)
            *best = seconds;
    }
    return BASE_OK;
}
