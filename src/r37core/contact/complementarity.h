/* The small complementarity problem of rigid contact: NODES unknowns in arrays of PADDED. */
#pragma once

#include "contact/vector.h"

#define BLOCK_ROUNDS 8
#define SINGLE_ROUNDS 500
#define COMPLEMENTARITY_TOLERANCE (sizeof(REAL) == sizeof(double) ? 1e-12 : 1e-5) /* of the largest gap */

/* Gauss-Jordan elimination without exchanging rows, on whole columns at a time; returns 0 if a pivot all but cancels. Principal
 * minors of a P-matrix are positive, so that is rare. */
INLINE int solve_columns(const REAL columns[NODES][PADDED], const REAL *gap, const int *active, int count, REAL *answer)
{
    REAL left[NODES + 1][PADDED] ALIGNED, inverse[NODES];
    for (int g = 0; g < PADDED / LANES; g++) {
        for (int j = 0; j < count; j++)
            ((vector *)left[j])[g] = vectors(columns[active[j]])[g];
        ((vector *)left[count])[g] = -vectors(gap)[g];
    }
    int sound = 1;
    for (int k = 0; k < count; k++) {
        const int node = active[k];
        inverse[k] = 1 / left[k][node];
        sound &= left[k][node] > (REAL)1e-4 * columns[node][node];
        for (int g = 0; g < PADDED / LANES; g++) {
            const vector all = vectors(left[k])[g] * inverse[k];
            const vector factor = choose(lane_numbers() + g * LANES == node, (vector){0}, all);
            for (int j = k + 1; j <= count; j++)
                ((vector *)left[j])[g] -= factor * left[j][node];
        }
    }
    for (int k = 0; k < count; k++)
        answer[k] = left[count][active[k]] * inverse[k];
    return sound;
}

/* Gaussian elimination with partial pivoting. */
static __attribute__((noinline)) void solve_exchanging(const REAL columns[NODES][PADDED], const REAL *gap, const int *active,
                                                 int count, REAL *answer)
{
    REAL rows[NODES][NODES + 1];
    for (int i = 0; i < count; i++) {
        for (int j = 0; j < count; j++)
            rows[i][j] = columns[active[j]][active[i]];
        rows[i][count] = -gap[active[i]];
    }
    for (int k = 0; k < count; k++) {
        int pivot = k;
        for (int i = k + 1; i < count; i++)
            if (fabs(rows[i][k]) > fabs(rows[pivot][k]))
                pivot = i;
        if (pivot != k)
            for (int j = k; j <= count; j++) {
                const REAL kept = rows[k][j];
                rows[k][j] = rows[pivot][j];
                rows[pivot][j] = kept;
            }
        if (rows[k][k] == 0)
            continue;
        for (int i = k + 1; i < count; i++) {
            const REAL factor = rows[i][k] / rows[k][k];
            for (int j = k + 1; j <= count; j++)
                rows[i][j] -= factor * rows[k][j];
        }
    }
    for (int k = count - 1; k >= 0; k--) {
        REAL right = rows[k][count];
        for (int j = k + 1; j < count; j++)
            right -= rows[k][j] * answer[j];
        answer[k] = rows[k][k] != 0 ? right / rows[k][k] : 0;
    }
}

/* Gap zero at the active nodes, multiplier zero at the others. */
INLINE void solve_active(const REAL columns[NODES][PADDED], const REAL *gap, const int *active, int count, REAL *multipliers)
{
    REAL answer[NODES];
    if (!solve_columns(columns, gap, active, count, answer))
        solve_exchanging(columns, gap, active, count, answer);
    for (int k = 0; k < NODES; k++)
        multipliers[k] = 0;
    for (int a = 0; a < count; a++)
        multipliers[active[a]] = answer[a];
}

/* Find multipliers >= 0 with gap + matrix multipliers >= 0 and the two never both positive.
 *
 * columns[j][i]: opening of gap i per unit multiplier of node j. guess: positive where a node is expected to touch, as in the
 * step before; without any, the closed gaps. Block principal pivoting, then Murty's least-index rule, which ends for every
 * P-matrix (Cottle, Pang and Stone, The Linear Complementarity Problem, section 4.2). Returns the largest violation of
 * either sign condition, relative to the largest gap given. */
INLINE REAL solve_complementarity(const REAL columns[NODES][PADDED], const REAL *gap, const REAL *guess, REAL *multipliers)
{
    int touches[NODES], guessed = 0;
    REAL scale = 0;
    for (int k = 0; k < NODES; k++) {
        guessed |= guess[k] > 0;
        scale = scale > fabs(gap[k]) ? scale : (REAL)fabs(gap[k]);
    }
    for (int k = 0; k < NODES; k++)
        touches[k] = guessed ? guess[k] > 0 : gap[k] < 0;
    const REAL tolerance = COMPLEMENTARITY_TOLERANCE * scale;
    REAL violation = 0;
    for (int round = 0; round < BLOCK_ROUNDS + SINGLE_ROUNDS; round++) {
        int active[NODES], count = 0;
        for (int k = 0; k < NODES; k++)
            if (touches[k])
                active[count++] = k;
        solve_active(columns, gap, active, count, multipliers);
        REAL opened[PADDED] ALIGNED;
        for (int g = 0; g < PADDED / LANES; g++) {
            vector sum = vectors(gap)[g];
            for (int a = 0; a < count; a++)
                sum += vectors(columns[active[a]])[g] * multipliers[active[a]];
            ((vector *)opened)[g] = sum;
        }
        violation = 0;
        for (int k = 0; k < NODES; k++) {
            const REAL bad = touches[k] ? -multipliers[k] * columns[k][k] : -opened[k];
            if (bad > tolerance) {
                violation = violation > bad ? violation : bad;
                touches[k] = !touches[k];
                if (round >= BLOCK_ROUNDS)
                    break;
            }
        }
        if (violation == 0)
            break;
    }
    for (int k = 0; k < NODES; k++)
        if (multipliers[k] < 0)
            multipliers[k] = 0;
    return scale > 0 ? violation / scale : 0;
}
