/* What the march works on. Filled in by kernel.py, whose fields are in the same order. All arrays of numbers start on
 * a vector's boundary and are padded with zeros: MODES = CHUNKS * LANES, PADDED = nodes rounded up to whole vectors.
 *
 * The compiler's command line says what the scene has (HAS_LINING, HAS_FRICTION, HAS_EXACT_GAP, HAS_LOSS), NODES, CHUNKS,
 * COARSE (see flight.py) and REAL: what a scene lacks is not in the program. */
#pragma once

#include "contact/vector.h"

#define MODES (CHUNKS * LANES)
#define GROUPS ((NODES + LANES - 1) / LANES)
#define PADDED (GROUPS * LANES)
#define MOST_LEVELS 16

enum { KEEP, PULL, INVERSE, RECURSION_ROWS };
enum { U_FROM_U, U_FROM_D, D_FROM_U, D_FROM_D, LOSS_UU, LOSS_UD, LOSS_DD, BEYOND_LINE, JUMP_ROWS };
enum { AMPLITUDE_U, AMPLITUDE_D, AMPLITUDE_ROWS };
enum { STEPS_IN_CONTACT, CASING_HITS, LARGEST_FORCE, WORST_COMPLEMENTARITY, WORK, LOSS, STEPS, STEPS_JUMPED, TOTALS };

struct march {
    int64_t first_step;           /* number of steps already done */
    int64_t steps_per_revolution; /* a multiple of the next */
    int64_t steps_per_block;
    int64_t blocks; /* to do; a sample is taken at the end of each */
    int64_t outputs, bars, rings, levels;
    double step;                               /* s */
    double clearance, amplitude, rise;         /* m, m, rise rate of the casing's lobes times step; infinite: from the start */
    double limit;                              /* largest displacement of an output allowed (m) */
    double thickness, elastic_modulus, plastic_modulus, yield_stress, bar_area;
    double friction, vector_friction, coupled_friction; /* coefficient, and two flags */
    REAL *displacement, *increment;            /* (MODES): u_n, u_n - u_{n-1} */
    const REAL *recursion;                     /* (RECURSION_ROWS, MODES): -b, c omega^2, c */
    const REAL *loss;                          /* (MODES): energy lost per step and squared central difference */
    const REAL *rows;                          /* (3, CHUNKS, PADDED, LANES): normal, tangential, meridional */
    const REAL *coupling;                      /* (3, PADDED, PADDED): normal push on the last per force on the one before */
    const REAL *casing;                        /* (steps per revolution, PADDED): f(theta) of each node at each step */
    const REAL *casing_most;                   /* (samples, coarse steps, PADDED): largest f in the COARSE steps that follow */
    const REAL *radius;                        /* (PADDED): exact radial position in the gap */
    const REAL *bar_position;                  /* (PADDED): angle of each node at step 0, in bars */
    const REAL *rotation_velocity;             /* (PADDED): signed tangential velocity of the rotation */
    REAL *wear;                                /* (rings, bars) */
    REAL *on_casing;                           /* (PADDED): 1 where the node touched the casing in the last step */
    const int64_t *jump_length;                /* (levels): steps; the first: what is left of a block after whole COARSE steps */
    const int64_t *jump_chunks;                /* (levels): chunks of modes followed along their tangent */
    const REAL *jump;                          /* (levels, JUMP_ROWS, MODES) */
    const double *jump_decay;                  /* (levels): exp(-rise * length) */
    const REAL *amplitude_rows;                /* (AMPLITUDE_ROWS, MODES); see flight.h */
    const REAL *outputs_rows;                  /* (outputs, MODES) */
    double *samples;                           /* (blocks, outputs) */
    const int64_t *snapshot_of_block;          /* NULL or (blocks): row of `snapshots` to write, or -1 */
    REAL *snapshots;                           /* (rows, MODES) */
    double *totals;                            /* (TOTALS), added to */
};
