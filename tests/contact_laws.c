/* The laws of contact, one call each, for test_contact.py. Compiled with NODES. */
#include "contact/vector.h"

#define PADDED ((NODES + LANES - 1) / LANES * LANES)

#include "contact/complementarity.h"
#include "contact/friction.h"
#include "contact/lining.h"

REAL press_bar(REAL penetration, REAL *wear, const REAL *bar)
{
    return return_mapping(penetration, wear, bar[0], bar[1], bar[2], bar[3]);
}

void direct_friction(REAL rotation, REAL tangential, REAL axial, REAL *answer)
{
    const vector none = {0};
    const struct direction direction = friction_direction(none + rotation, none + tangential, none + axial);
    answer[0] = direction.tangential[0];
    answer[1] = direction.axial[0];
}

/* matrix: (NODES, NODES), by rows */
REAL complement(const REAL *matrix, const REAL *gap, const REAL *guess, REAL *multipliers)
{
    REAL columns[NODES][PADDED] ALIGNED = {{0}}, padded[PADDED] ALIGNED = {0};
    for (int i = 0; i < NODES; i++) {
        padded[i] = gap[i];
        for (int j = 0; j < NODES; j++)
            columns[j][i] = matrix[i * NODES + j];
    }
    return solve_complementarity((const REAL(*)[PADDED])columns, padded, guess, multipliers);
}
