/* Keep the records that pass a test, side by side, and add up what a table has for them: compare, pack store in two halves, gather,
 * masks by C's operators and by intrinsics. In the style of code for Knights Corner; knows nothing of lanetrace. */
#include <immintrin.h>

int select_records(const int *key, const float *weight, int *kept, int low, int high, int n, float *total);

int select_records(const int *key, const float *weight, int *kept, int low, int high, int n, float *total)
{
    const __m512i lows = _mm512_set1_epi32(low), highs = _mm512_set1_epi32(high);
    const __m512i steps = _mm512_set_epi32(15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0);
    __m512 sum = _mm512_setzero_ps();
    int count = 0;
    for (int i = 0; i < n; i += 16) {
        __m512i keys = _mm512_load_epi32(key + i);
        __mmask16 inside = _mm512_kand(_mm512_cmpge_epi32_mask(keys, lows), _mm512_cmplt_epi32_mask(keys, highs));
        __mmask16 odd = _mm512_test_epi32_mask(keys, _mm512_set1_epi32(1));
        inside &= (__mmask16)~odd;
        if (_mm512_kortestz(inside, inside))
            continue;
        __m512i index = _mm512_add_epi32(steps, _mm512_set1_epi32(i));
        _mm512_mask_packstorelo_epi32(kept + count, inside, index);
        _mm512_mask_packstorehi_epi32(kept + count + 16, inside, index);
        __m512 weights = _mm512_mask_i32gather_ps(_mm512_setzero_ps(), inside, keys, weight, 4);
        sum = _mm512_mask_add_ps(sum, inside, sum, weights);
        count += (int)_mm_countbits_32(inside);
    }
    *total = _mm512_reduce_add_ps(sum);
    return count;
}
