/* Vectors of LANES numbers, in GCC's portable vector extension: one register with AVX-512, two with AVX2, four with NEON.
 * REAL (double or float) is given on the compiler's command line. */
#pragma once

#include <math.h>
#include <stdint.h>
#ifdef __AVX512F__
#include <immintrin.h>
#endif

#define VECTOR_BYTES 64
#define LANES ((int)(VECTOR_BYTES / sizeof(REAL)))
#define ALIGNED __attribute__((aligned(VECTOR_BYTES)))
#define UNROLL _Pragma("GCC unroll 64")
#define INLINE static inline __attribute__((always_inline))

typedef REAL vector __attribute__((vector_size(VECTOR_BYTES), may_alias));
typedef __typeof__(__builtin_choose_expr(sizeof(REAL) == 8, (int64_t)0, (int32_t)0)) lane_integer;
typedef lane_integer lanes __attribute__((vector_size(VECTOR_BYTES)));

INLINE const vector *vectors(const REAL *values) { return (const vector *)values; }

INLINE lanes lane_numbers(void)
{
    lanes number;
    for (int l = 0; l < LANES; l++)
        number[l] = l;
    return number;
}

INLINE REAL sum_of_lanes(vector v)
{
    UNROLL
    for (int half = LANES / 2; half >= 1; half /= 2)
        v += __builtin_shuffle(v, lane_numbers() ^ half);
    return v[0];
}

/* Lane k of the result is the sum of all lanes of sums[k]: every stage halves the number of vectors. */
INLINE vector sum_of_each(vector sums[LANES])
{
    UNROLL
    for (int half = LANES / 2; half >= 1; half /= 2) {
        const lanes upper = (lane_numbers() & half) != 0;
        const lanes kept = lane_numbers() + (upper & LANES);
        const lanes added = (lane_numbers() ^ half) + (upper & LANES);
        UNROLL
        for (int j = 0; j < half; j++)
            sums[j] = __builtin_shuffle(sums[j], sums[j + half], kept) + __builtin_shuffle(sums[j], sums[j + half], added);
    }
    return sums[0];
}

INLINE vector choose(lanes flags, vector yes, vector no)
{
    return (vector)((flags & (lanes)yes) | (~flags & (lanes)no));
}

INLINE vector larger(vector a, vector b) { return choose(a > b, a, b); }

INLINE vector square_root(vector v)
{
    for (int l = 0; l < LANES; l++)
        v[l] = (REAL)sqrt(v[l]);
    return v;
}

INLINE int any_lane(lanes flags)
{
#ifdef __AVX512F__
    return _mm512_test_epi32_mask((__m512i)flags, (__m512i)flags) != 0;
#endif
    UNROLL
    for (int half = LANES / 2; half >= 1; half /= 2)
        flags |= __builtin_shuffle(flags, lane_numbers() ^ half);
    return flags[0] != 0;
}
