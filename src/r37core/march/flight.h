/* Free flight without stepping: while no node can reach the lining or casing, many steps are done at once.
 *
 * Each mode is u_n = Re(C lambda^n) with |lambda| <= 1, so m steps are a 2 x 2 map of (u, d), made once (flight.py), and
 * |C| bounds the mode until the next contact. A jump is taken only if a bound on every node's position over all the steps it
 * skips stays clear of the casing's nearest position over them:
 * modes slow in the jump follow their tangent within |C| |1 - 1/lambda|^2 m (m + 1)/2, the others stay within |C|. */
#pragma once

#include "march/march.h"

#ifndef ROUNDING_MARGIN
#define ROUNDING_MARGIN 1e-9 /* of the distances compared; generous beside what summing rounds */
#endif

struct flight {
    int known;                            /* whether `amplitude` holds for the flight */
    int bound_known[MOST_LEVELS];
    int level;                            /* to try first */
    REAL amplitude[MODES] ALIGNED;        /* |C| of each mode */
    REAL beyond[MOST_LEVELS][PADDED] ALIGNED; /* how far each node may get beyond the slow modes' tangent */
    REAL across[PADDED] ALIGNED;          /* how far each node may get sideways */
};

/* Sum over the modes of |row| times amplitude times, if given, a factor of each mode: for every node. */
static void bound_nodes(const REAL *rows, const REAL *amplitude, const REAL *factor, REAL *bound)
{
    for (int k = 0; k < NODES; k++) {
        vector sum = {0};
        UNROLL
        for (int c = 0; c < CHUNKS; c++) {
            const vector row = vectors(rows)[c * PADDED + k];
            vector reach = vectors(amplitude)[c];
            if (factor)
                reach *= vectors(factor)[c];
            sum += larger(row, -row) * reach;
        }
        bound[k] = sum_of_lanes(sum);
    }
    for (int k = NODES; k < PADDED; k++)
        bound[k] = 0;
}

INLINE void bound_amplitudes(const struct march *m, const REAL *u, const REAL *d, struct flight *flight)
{
    const REAL *by_u = m->amplitude_rows + AMPLITUDE_U * MODES, *by_d = m->amplitude_rows + AMPLITUDE_D * MODES;
    for (int i = 0; i < MODES; i++) {
        const REAL imaginary = by_u[i] * u[i] + by_d[i] * d[i];
        flight->amplitude[i] = (REAL)sqrt(u[i] * u[i] + imaginary * imaginary);
    }
    if (HAS_EXACT_GAP)
        bound_nodes(m->rows + MODES * PADDED, flight->amplitude, 0, flight->across);
    for (int l = 0; l < MOST_LEVELS; l++)
        flight->bound_known[l] = 0;
    flight->known = 1;
}

/* Whether no node can touch anything in the jump. `remaining`: what the casing's lobes lack before it. */
INLINE int is_clear(const struct march *m, const REAL *u, const REAL *d, struct flight *flight, int level,
                    const REAL *casing_most, double remaining)
{
    const REAL *jump = m->jump + level * JUMP_ROWS * MODES;
    if (!flight->bound_known[level]) {
        bound_nodes(m->rows, flight->amplitude, jump + BEYOND_LINE * MODES, flight->beyond[level]);
        flight->bound_known[level] = 1;
    }
    const REAL length = (REAL)m->jump_length[level];
    const REAL lobes = (REAL)(m->amplitude * (1.0 - remaining * m->jump_decay[level]));
    const REAL clearance = (REAL)m->clearance;
    const int coarse = (int)((m->jump_length[level] + COARSE - 1) / COARSE);
    for (int g = 0; g < GROUPS; g++) {
        vector positions[LANES], velocities[LANES];
        for (int k = 0; k < LANES; k++)
            positions[k] = velocities[k] = (vector){0};
        for (int c = 0; c < m->jump_chunks[level]; c++)
            for (int k = 0; k < LANES && g * LANES + k < NODES; k++) {
                const vector row = vectors(m->rows)[c * PADDED + g * LANES + k];
                positions[k] += row * vectors(u)[c];
                velocities[k] += row * vectors(d)[c];
            }
        const vector position = sum_of_each(positions), velocity = sum_of_each(velocities);
        vector reach = position + larger(velocity, velocity * length) + vectors(flight->beyond[level])[g];
        if (HAS_EXACT_GAP) {
            /* sqrt((r + x)^2 + y^2) <= r + x + y^2 / (2 (r + x)), and grows with x */
            const vector across = vectors(flight->across)[g];
            const vector from_axis = vectors(m->radius)[g] + reach;
            reach += across * across / (from_axis + from_axis);
        }
        vector most = vectors(casing_most)[g];
        for (int j = 1; j < coarse; j++)
            most = larger(most, vectors(casing_most)[j * GROUPS + g]);
        const vector gap = clearance - lobes * most - reach;
        const vector margin = (REAL)ROUNDING_MARGIN * (clearance + lobes + larger(reach, -reach));
        /* written so that NaN is not clear; nodes that only pad the vector have no position */
        const lanes clear = (gap > margin) | (lane_numbers() + g * LANES >= NODES);
        if (any_lane(~clear))
            return 0;
    }
    return 1;
}

/* Do the steps of one jump; returns the energy they lose to damping. */
INLINE REAL jump_ahead(const struct march *m, REAL *u, REAL *d, int level)
{
    const vector *jump = vectors(m->jump + level * JUMP_ROWS * MODES);
    vector *displacement = (vector *)u, *increment = (vector *)d;
    vector loss = {0};
    UNROLL
    for (int c = 0; c < CHUNKS; c++) {
        const vector x = displacement[c], y = increment[c];
        displacement[c] = x + (jump[U_FROM_U * CHUNKS + c] * x + jump[U_FROM_D * CHUNKS + c] * y);
        increment[c] = y + (jump[D_FROM_U * CHUNKS + c] * x + jump[D_FROM_D * CHUNKS + c] * y);
        if (HAS_LOSS)
            loss += (jump[LOSS_UU * CHUNKS + c] * x + jump[LOSS_UD * CHUNKS + c] * y) * x + jump[LOSS_DD * CHUNKS + c] * y * y;
    }
    return HAS_LOSS ? sum_of_lanes(loss) : 0;
}

/* Jump as far as the block and the bounds allow from `position` in the block. Returns the steps done, 0 if none. */
INLINE int64_t try_jump(const struct march *m, REAL *u, REAL *d, struct flight *flight, int64_t position,
                        const REAL *casing_most, double *remaining, REAL *loss)
{
    const int64_t left = m->steps_per_block - position;
    int level = flight->level;
    if (left < COARSE)
        level = 0;
    else
        while (m->jump_length[level] > left)
            level--;
    if (!flight->known)
        bound_amplitudes(m, u, d, flight);
    while (!is_clear(m, u, d, flight, level, casing_most, *remaining)) {
        if (level <= 1) {
            flight->level = 1;
            return 0;
        }
        level--;
    }
    *loss += jump_ahead(m, u, d, level);
    *remaining *= m->jump_decay[level];
    flight->level = level + 1 < m->levels ? level + 1 : level;
    if (flight->level < 1)
        flight->level = 1;
    return m->jump_length[level];
}
