/* Runs the samples in a session, checks their results in plain C and prints what they cost. */
#include <lanetrace/session.h>

#include <math.h>
#include <stdlib.h>

void nbody(const float *x, const float *y, const float *z, const float *mass, float *fx, int n);
int select_records(const int *key, const float *weight, int *kept, int low, int high, int n, float *total);

enum { N = 128 };
static _Alignas(64) float x[N + 64], y[N + 64], z[N + 64], mass[N + 64], fx[N];
static _Alignas(64) int key[N], kept[N + 32];
static _Alignas(64) float weight[1024];

static int check_nbody(void)
{
    for (int i = 0; i < N; i++) {
        double sum = 0;
        for (int j = 0; j < N; j++) {
            double dx = (double)x[j] - x[i], dy = (double)y[j] - y[i], dz = (double)z[j] - z[i];
            sum += mass[j] * dx / pow(dx * dx + dy * dy + dz * dz + 1e-3, 1.5);
        }
        if (fabs(sum - (double)fx[i]) > 1e-3 * (1 + fabs(sum)))
            return 0;
    }
    return 1;
}

static int check_select(int count, float total)
{
    int n = 0;
    double sum = 0;
    for (int i = 0; i < N; i++)
        if (key[i] >= 100 && key[i] < 700 && key[i] % 2 == 0) {
            if (n >= count || kept[n++] != i)
                return 0;
            sum += (double)weight[key[i]];
        }
    return n == count && fabs(sum - (double)total) < 1e-3;
}

int main(void)
{
    base_error err;
    lanetrace_session *s;
    float total;
    unsigned seed = 1;
    for (int i = 0; i < N; i++) {
        float *const to[] = {&x[i], &y[i], &z[i], &mass[i]};
        for (int k = 0; k < 4; k++) {
            seed = seed * 1103515245 + 12345;
            *to[k] = (float)(seed >> 16) / 65536;
        }
        key[i] = (int)(seed >> 8) % 1000;
    }
    for (int i = 0; i < 1024; i++)
        weight[i] = (float)i / 1024;
    if (lanetrace_open(&(lanetrace_options){.name = "samples"}, &s, &err) != BASE_OK || lanetrace_begin(s, NULL, &err) != BASE_OK)
        return 2;
    nbody(x, y, z, mass, fx, N);
    int count = select_records(key, weight, kept, 100, 700, N, &total);
    if (lanetrace_end(s, &err) != BASE_OK || lanetrace_write_json(s, stdout, &err) != BASE_OK)
        return 2;
    lanetrace_close(&s);
    return check_nbody() && check_select(count, total) ? 0 : 1;
}
