/* The central-difference march in modal coordinates, compiled for what the scene needs.
 *
 * Recursion (section 5 of the benchmark, diagonal in the modes of one speed): u* = a u_n + b u_{n-1}; where a tip node passes
 * the lining or the casing, u_{n+1} = u* + c F. It is carried in displacement u and increment d = u_n - u_{n-1}, which is the
 * same recursion without its loss of digits (a + b differs from 1 by only c omega^2): d* = -b d - c omega^2 u, u* = u + d*. */

#include "march/march.h"

#include "contact/complementarity.h"
#include "contact/friction.h"
#include "contact/lining.h"
#include "march/flight.h"

/* One step's contact. */
struct contact {
    int pressed[NODES], count; /* nodes with a force */
    int sliding_known[NODES];
    REAL gap[PADDED] ALIGNED;
    REAL force[3][PADDED] ALIGNED; /* normal, tangential, meridional */
    REAL direction[2][PADDED] ALIGNED;
    REAL multiplier[PADDED] ALIGNED;
    REAL columns[NODES][PADDED] ALIGNED; /* opening of each gap per unit multiplier of a node */
};

/* Sums that are added up over a block. */
struct sums {
    vector work, loss;
    REAL jump_loss;
};

/* The free step of every mode. */
INLINE void predict(const struct march *m, REAL *displacement, const REAL *before, REAL *now, struct sums *sums)
{
    const vector *keep = vectors(m->recursion + KEEP * MODES), *pull = vectors(m->recursion + PULL * MODES);
    const vector *per_square = vectors(m->loss), *old = vectors(before);
    vector *u = (vector *)displacement, *increment = (vector *)now;
    vector loss[2] = {{0}, {0}};
    UNROLL
    for (int c = 0; c < CHUNKS; c++) {
        const vector d = keep[c] * old[c] - pull[c] * u[c];
        increment[c] = d;
        u[c] += d;
        if (HAS_LOSS) {
            const vector moved = d + old[c];
            loss[c % 2] += per_square[c] * moved * moved;
        }
    }
    if (HAS_LOSS)
        sums->loss += loss[0] + loss[1];
}

/* Displacement of the nodes of group g along one of the directions of `rows`. */
INLINE vector along(const REAL *rows, const REAL *modal, int g)
{
    const vector *row = vectors(rows) + g * LANES, *u = vectors(modal);
    vector total[LANES];
    for (int k = 0; k < LANES; k++)
        total[k] = (vector){0};
    UNROLL
    for (int c = 0; c < CHUNKS; c++)
        for (int k = 0; k < LANES && g * LANES + k < NODES; k++)
            total[k] += row[c * PADDED + k] * u[c];
    return sum_of_each(total);
}

/* Distance of the nodes from the casing; returns whether any is beyond it. */
INLINE int measure_gaps(const struct march *m, const REAL *u, int64_t place, REAL lobes, REAL *gap)
{
    int touching = 0;
    for (int g = 0; g < GROUPS; g++) {
        vector position = along(m->rows, u, g);
        if (HAS_EXACT_GAP) {
            const vector radius = vectors(m->radius)[g], y = along(m->rows + MODES * PADDED, u, g);
            const vector x = radius + position;
            position = square_root(x * x + y * y) - radius;
        }
        const vector left = (REAL)m->clearance - lobes * vectors(m->casing + place * PADDED)[g] - position;
        ((vector *)gap)[g] = left;
        touching |= any_lane(left < 0);
    }
    return touching;
}

/* Directions of the friction forces on the wanted nodes, from their sliding velocities over the last step. */
INLINE void set_directions(const struct march *m, const REAL *increment, const int *wanted, struct contact *contact)
{
    const REAL per_step = (REAL)(1.0 / m->step);
    for (int g = 0; g < GROUPS; g++) {
        const vector *tangential = vectors(m->rows) + CHUNKS * PADDED, *axial = tangential + CHUNKS * PADDED;
        vector along_nodes[LANES] = {{0}}, across_nodes[LANES] = {{0}};
        lanes chosen = {0};
        for (int k = 0; k < LANES && g * LANES + k < NODES; k++) {
            const int node = g * LANES + k;
            if (!wanted[node])
                continue;
            chosen |= lane_numbers() == k;
            contact->sliding_known[node] = 1;
            if (!(m->vector_friction > 0))
                continue;
            vector along_node[2] = {{0}, {0}}, across_node[2] = {{0}, {0}};
            UNROLL
            for (int c = 0; c < CHUNKS; c++) {
                along_node[c % 2] += tangential[c * PADDED + node] * vectors(increment)[c];
                across_node[c % 2] += axial[c * PADDED + node] * vectors(increment)[c];
            }
            along_nodes[k] = along_node[0] + along_node[1];
            across_nodes[k] = across_node[0] + across_node[1];
        }
        const struct direction direction = friction_direction(
            vectors(m->rotation_velocity)[g], sum_of_each(along_nodes) * per_step, sum_of_each(across_nodes) * per_step);
        vector *kept[2] = {(vector *)contact->direction[0] + g, (vector *)contact->direction[1] + g};
        *kept[0] = choose(chosen, direction.tangential, *kept[0]);
        *kept[1] = choose(chosen, direction.axial, *kept[1]);
    }
}

/* Add a normal force (negative: towards the axis) and the friction it causes. */
INLINE void press(const struct march *m, struct contact *contact, int k, REAL normal)
{
    contact->force[0][k] += normal;
    if (HAS_FRICTION) {
        contact->force[1][k] -= (REAL)m->friction * normal * contact->direction[0][k];
        contact->force[2][k] -= (REAL)m->friction * normal * contact->direction[1][k];
    }
}

/* Normal forces of the bars that the nodes press, from the predicted positions; wears them. */
INLINE void press_lining(const struct march *m, int64_t place, struct contact *contact)
{
    /* the rotor turns towards negative theta */
    const REAL turned = (REAL)((double)place * (double)m->bars / (double)m->steps_per_revolution);
    for (int k = 0; k < NODES; k++) {
        if (!(contact->gap[k] < 0))
            continue;
        int64_t bar = (int64_t)floor(m->bar_position[k] - turned);
        while (bar < 0)
            bar += m->bars;
        REAL *wear = m->wear + (m->rings > 1 ? k * m->bars : 0) + bar;
        const REAL stress = return_mapping(-contact->gap[k], wear, (REAL)m->thickness, (REAL)m->elastic_modulus,
                                           (REAL)m->plastic_modulus, (REAL)m->yield_stress);
        press(m, contact, k, -stress * (REAL)m->bar_area);
    }
    /* the casing lies behind the lining; its gap after the lining's forces */
    for (int g = 0; g < GROUPS; g++) {
        vector gap = vectors(contact->gap)[g] + (REAL)m->thickness;
        for (int k = 0; k < NODES; k++)
            if (contact->force[0][k] < 0)
                for (int axis = 0; axis < (HAS_FRICTION ? 3 : 1); axis++)
                    gap -= vectors(m->coupling + (axis * PADDED + k) * PADDED)[g] * contact->force[axis][k];
        ((vector *)contact->gap)[g] = gap;
    }
}

/* Opening of each gap per unit multiplier of each node, with the friction it causes where that is coupled. */
INLINE void casing_columns(const struct march *m, struct contact *contact)
{
    for (int k = 0; k < NODES; k++)
        for (int g = 0; g < GROUPS; g++) {
            vector column = vectors(m->coupling + k * PADDED)[g];
            if (HAS_FRICTION && m->coupled_friction > 0)
                column -= (REAL)m->friction *
                          (vectors(m->coupling + (PADDED + k) * PADDED)[g] * contact->direction[0][k] +
                           vectors(m->coupling + (2 * PADDED + k) * PADDED)[g] * contact->direction[1][k]);
            ((vector *)contact->columns[k])[g] = column;
        }
}

/* Add the forces of casing contact: multipliers that close no gap beyond zero, and the friction they cause. */
INLINE void press_casing(const struct march *m, const REAL *increment, struct contact *contact)
{
    REAL violation;
    /* a node that only the others' reaction brings to the casing needs its friction direction too */
    int unknown;
    do {
        casing_columns(m, contact);
        violation = solve_complementarity((const REAL(*)[PADDED])contact->columns, contact->gap, m->on_casing, contact->multiplier);
        int wanted[NODES];
        unknown = 0;
        for (int k = 0; HAS_FRICTION && k < NODES; k++)
            unknown |= wanted[k] = contact->multiplier[k] > 0 && !contact->sliding_known[k];
        if (unknown)
            set_directions(m, increment, wanted, contact);
    } while (unknown);
    if (violation > m->totals[WORST_COMPLEMENTARITY])
        m->totals[WORST_COMPLEMENTARITY] = violation;
    for (int k = 0; k < NODES; k++) {
        const int touches = contact->multiplier[k] > 0;
        if (touches)
            press(m, contact, k, -contact->multiplier[k]);
        m->totals[CASING_HITS] += touches && m->on_casing[k] == 0;
        m->on_casing[k] = (REAL)touches;
    }
}

/* Correct the predicted displacement and increment for the nodes' forces. */
INLINE void push_blade(const struct march *m, const struct contact *contact, REAL *displacement, const REAL *before, REAL *now,
                       struct sums *sums)
{
    vector push[CHUNKS];
    UNROLL
    for (int c = 0; c < CHUNKS; c++)
        push[c] = (vector){0};
    int pressed = 0;
    for (int k = 0; k < NODES; k++) {
        const REAL normal = contact->force[0][k];
        if (!(normal < 0))
            continue;
        pressed = 1;
        if (-normal > m->totals[LARGEST_FORCE])
            m->totals[LARGEST_FORCE] = -normal;
        UNROLL
        for (int c = 0; c < CHUNKS; c++) {
            push[c] += vectors(m->rows)[c * PADDED + k] * normal;
            if (HAS_FRICTION)
                push[c] += vectors(m->rows)[(CHUNKS + c) * PADDED + k] * contact->force[1][k] +
                           vectors(m->rows)[(2 * CHUNKS + c) * PADDED + k] * contact->force[2][k];
        }
    }
    if (!pressed)
        return;
    m->totals[STEPS_IN_CONTACT] += 1;
    const vector *inverse = vectors(m->recursion + INVERSE * MODES), *per_square = vectors(m->loss), *old = vectors(before);
    vector *u = (vector *)displacement, *increment = (vector *)now;
    vector work[2] = {{0}, {0}}, loss[2] = {{0}, {0}};
    UNROLL
    for (int c = 0; c < CHUNKS; c++) {
        const vector free = increment[c] + old[c];
        const vector pushed = inverse[c] * push[c];
        increment[c] += pushed;
        u[c] += pushed;
        const vector moved = free + pushed;
        work[c % 2] += push[c] * moved;
        if (HAS_LOSS)
            loss[c % 2] += per_square[c] * (moved * moved - free * free);
    }
    sums->work += work[0] + work[1];
    if (HAS_LOSS)
        sums->loss += loss[0] + loss[1];
}

/* Everything that happens in a step in which a node is beyond the lining or casing. */
INLINE void meet(const struct march *m, int64_t place, REAL *displacement, const REAL *before, REAL *now,
                 struct contact *contact, struct sums *sums)
{
    for (int g = 0; g < GROUPS; g++) {
        for (int axis = 0; axis < 3; axis++)
            ((vector *)contact->force[axis])[g] = (vector){0};
        ((vector *)contact->multiplier)[g] = (vector){0};
        ((vector *)contact->direction[0])[g] = ((vector *)contact->direction[1])[g] = (vector){0};
    }
    int beyond[NODES];
    for (int k = 0; k < NODES; k++) {
        contact->sliding_known[k] = 0;
        beyond[k] = contact->gap[k] < 0;
    }
    if (HAS_FRICTION)
        set_directions(m, before, beyond, contact);
    if (HAS_LINING)
        press_lining(m, place, contact);
    int closed = 0;
    for (int g = 0; g < GROUPS; g++)
        closed |= any_lane(vectors(contact->gap)[g] < 0);
    if (closed)
        press_casing(m, before, contact);
    else
        for (int k = 0; k < NODES; k++)
            m->on_casing[k] = 0;
    push_blade(m, contact, displacement, before, now, sums);
}

/* Samples and snapshots at the end of a block; returns whether the outputs are within the limit. */
static int record(const struct march *m, int64_t block, const REAL *u)
{
    int bounded = 1;
    for (int64_t o = 0; o < m->outputs; o++) {
        vector total = {0};
        UNROLL
        for (int c = 0; c < CHUNKS; c++)
            total += vectors(m->outputs_rows)[o * CHUNKS + c] * vectors(u)[c];
        const double sample = sum_of_lanes(total);
        m->samples[block * m->outputs + o] = sample;
        /* written so that NaN fails as well */
        bounded = bounded && fabs(sample) < m->limit;
    }
    if (m->snapshot_of_block && m->snapshot_of_block[block] >= 0)
        for (int i = 0; i < MODES; i++)
            m->snapshots[m->snapshot_of_block[block] * MODES + i] = u[i];
    return bounded;
}

/* For the caller's check that both sides mean the same structure. */
int64_t size_of_march(void) { return (int64_t)sizeof(struct march); }

/* Do up to `blocks` blocks of steps. Returns how many were done; fewer when an output passed the limit or is NaN. */
int64_t advance(struct march *m)
{
    struct contact contact;
    struct flight flight;
    REAL buffer[2][MODES] ALIGNED, *u = m->displacement, *before = buffer[0], *now = buffer[1];
    const int at_once = isinf(m->rise);
    const double decay = at_once ? 0.0 : exp(-m->rise);
    const int64_t coarse_per_block = (m->steps_per_block + COARSE - 1) / COARSE;
    int64_t done = 0;
    int touching = 0;
    for (int i = 0; i < MODES; i++)
        before[i] = m->increment[i];
    while (done < m->blocks) {
        const int64_t start = m->first_step + done * m->steps_per_block;
        const int64_t place = start % m->steps_per_revolution;
        const REAL *casing_most = m->casing_most + place / m->steps_per_block * coarse_per_block * PADDED;
        double remaining = at_once ? 0.0 : exp(-m->rise * (double)start);
        struct sums sums = {0};
        if (place == 0) {
            /* so that a run stopped after a revolution goes on with the same bits */
            flight.known = touching = 0;
            flight.level = 1;
        }
        for (int64_t position = 0; position < m->steps_per_block;) {
            if (m->levels && !touching && position % COARSE == 0) {
                const int64_t jumped = try_jump(
                    m, u, before, &flight, position, casing_most + position / COARSE * PADDED, &remaining, &sums.jump_loss);
                if (jumped) {
                    for (int k = 0; k < NODES; k++)
                        m->on_casing[k] = 0;
                    m->totals[STEPS_JUMPED] += (double)jumped;
                    position += jumped;
                    continue;
                }
            }
            position++;
            remaining *= decay;
            predict(m, u, before, now, &sums);
            const int64_t here = place + position < m->steps_per_revolution ? place + position : 0;
            const REAL lobes = (REAL)(m->amplitude * (1.0 - remaining));
            touching = measure_gaps(m, u, here, lobes, contact.gap);
            if (touching) {
                meet(m, here, u, before, now, &contact, &sums);
                flight.known = 0;
            } else
                for (int k = 0; k < NODES; k++)
                    m->on_casing[k] = 0;
            REAL *other = before;
            before = now;
            now = other;
        }
        m->totals[WORK] += 0.5 * sum_of_lanes(sums.work);
        m->totals[LOSS] += sum_of_lanes(sums.loss) + sums.jump_loss;
        m->totals[STEPS] += (double)m->steps_per_block;
        if (!record(m, done++, u))
            break;
    }
    for (int i = 0; i < MODES; i++)
        m->increment[i] = before[i];
    return done;
}
