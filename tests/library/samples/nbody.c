/* Forces between bodies, sixteen at a time, in the style of code for Knights Corner: reciprocal square roots, fused multiply-adds,
 * broadcasts by extload. Knows nothing of lanetrace. */
#include <immintrin.h>

void nbody(const float *x, const float *y, const float *z, const float *mass, float *fx, int n);

void nbody(const float *x, const float *y, const float *z, const float *mass, float *fx, int n)
{
    const __m512 softening = _mm512_set1_ps(1e-3f);
    for (int i = 0; i < n; i++) {
        __m512 xi = _mm512_extload_ps(x + i, _MM_UPCONV_PS_NONE, _MM_BROADCAST_1X16, _MM_HINT_NONE);
        __m512 yi = _mm512_extload_ps(y + i, _MM_UPCONV_PS_NONE, _MM_BROADCAST_1X16, _MM_HINT_NONE);
        __m512 zi = _mm512_extload_ps(z + i, _MM_UPCONV_PS_NONE, _MM_BROADCAST_1X16, _MM_HINT_NONE);
        __m512 sum = _mm512_setzero_ps();
        for (int j = 0; j < n; j += 16) {
            _mm_prefetch((const char *)(x + j + 64), _MM_HINT_T0);
            __m512 dx = _mm512_sub_ps(_mm512_load_ps(x + j), xi), dy = _mm512_sub_ps(_mm512_load_ps(y + j), yi);
            __m512 dz = _mm512_sub_ps(_mm512_load_ps(z + j), zi);
            __m512 rr = _mm512_fmadd_ps(dz, dz, _mm512_fmadd_ps(dy, dy, _mm512_fmadd_ps(dx, dx, softening)));
            __m512 r = _mm512_rsqrt23_ps(rr);
            __m512 rrr = _mm512_mul_ps(_mm512_mul_ps(r, r), r);
            sum = _mm512_fmadd_ps(_mm512_mul_ps(_mm512_load_ps(mass + j), rrr), dx, sum);
        }
        fx[i] = _mm512_reduce_add_ps(sum);
    }
}
