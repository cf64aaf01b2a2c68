"""The central-difference march in modal coordinates, compiled for what the scene needs.

Arguments that a scene lacks are None: numba compiles a version of its own for them, in which their code is gone.
Recursion (section 5 of the benchmark, diagonal in the modes of one speed): u* = a u_n + b u_{n-1}; where a tip node
passes the lining or the casing, u_{n+1} = u* + c F. It is carried in displacement u and increment d = u_n - u_{n-1}, which is
the same recursion without its loss of digits (a + b differs from 1 by only c omega^2): d* = -b d - c omega^2 u, u* = u + d*.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from r37core.contact.complementarity import solve_complementarity
from r37core.contact.friction import friction_direction
from r37core.contact.lining import return_mapping

# sums may be reordered and contracted, so that they vectorise; NaN and infinity keep their meaning
_FAST = {"reassoc", "contract", "nsz"}

STEPS_IN_CONTACT, CASING_HITS, LARGEST_FORCE, WORST_COMPLEMENTARITY, WORK, LOSS, STEPS = range(7)
"""Places in the array of totals: steps with any contact force, onsets of casing contact, largest normal force (N),
largest relative complementarity violation, work of the contact forces (J), energy lost to damping (J), steps done."""
TOTALS = 7


@njit(cache=True, fastmath=_FAST)
def advance(
    state,  # (2, modes): u_n, u_n - u_{n-1}
    recursion,  # (3, modes): -b, c omega^2, c
    rows,  # (3, nodes, modes): radial, tangential, axial
    coupling,  # (3, 3, nodes, nodes): rows[i] c rows[j]^T
    casing,  # (steps per revolution, nodes): f(theta) of each node at each step of a revolution
    distance,  # clearance, amplitude (m), rise rate times step, 1 where the casing is deformed from the start
    radius,  # None or (nodes,): exact radial position in the gap
    lining,  # None or (6,): thickness, elastic and plastic modulus, yield stress, bar area, bars
    wear,  # None or (rings, bars)
    on_casing,  # (nodes,): 1 where the node touched the casing in the last step
    bar_position,  # None or (nodes,): angle of each node at step 0, in bars
    friction,  # None or (3,): coefficient, 1 for vector, 1 for coupled
    rotation_velocity,  # None or (nodes,): signed tangential velocity of the rotation
    loss,  # None or (modes,): energy lost per step and squared central difference
    step,  # time step (s)
    first_step,  # number of steps already done
    blocks,  # blocks of steps to do
    steps_per_block,
    output_rows,  # (outputs, modes)
    samples,  # (blocks, outputs): written at the end of each block
    snapshot_of_block,  # None or (blocks,): row of `snapshots` to write at the end of the block, or -1
    snapshots,  # None or (rows, modes)
    totals,  # (TOTALS,), added to
    limit,  # largest displacement of an output allowed (m)
):
    """Do up to `blocks` blocks of steps. Returns how many were done; fewer when an output passed the limit or is NaN."""
    modes = state.shape[1]
    nodes = rows.shape[1]
    steps_per_revolution = casing.shape[0]
    keep, pull, c = recursion[0], recursion[1], recursion[2]
    now, step_before, step_now = state[0].copy(), state[1].copy(), state[1].copy()
    radial, tangential = rows[0], rows[1]
    gap = np.empty(nodes)
    forces = np.zeros((3, nodes))
    scratch = np.empty((nodes, nodes + 2))
    matrix = np.empty((nodes, nodes))
    directions = np.zeros((2, nodes))
    sliding_known = np.zeros(nodes, dtype=np.bool_)
    multipliers = np.zeros(nodes)
    push = np.empty(modes)
    done = 0
    for block in range(blocks):
        start = first_step + block * steps_per_block
        place = start % steps_per_revolution
        remaining = 0.0 if distance[3] > 0.0 else np.exp(-distance[2] * start)
        decay = 0.0 if distance[3] > 0.0 else np.exp(-distance[2])
        block_loss = 0.0
        for _ in range(steps_per_block):
            place += 1
            if place == steps_per_revolution:
                place = 0
            remaining *= decay
            if loss is None:
                for i in range(modes):
                    step_now[i] = keep[i] * step_before[i] - pull[i] * now[i]
                    now[i] += step_now[i]
            else:
                step_loss = 0.0
                for i in range(modes):
                    step_now[i] = keep[i] * step_before[i] - pull[i] * now[i]
                    now[i] += step_now[i]
                    moved = step_now[i] + step_before[i]
                    step_loss += loss[i] * moved * moved
                block_loss += step_loss
            touching = False
            amplitude = distance[1] * (1.0 - remaining)
            for k in range(nodes):
                total = 0.0
                for i in range(modes):
                    total += radial[k, i] * now[i]
                if radius is not None:
                    across = 0.0
                    for i in range(modes):
                        across += tangential[k, i] * now[i]
                    total = np.sqrt((radius[k] + total) ** 2 + across * across) - radius[k]
                gap[k] = distance[0] - amplitude * casing[place, k] - total
                touching = touching or gap[k] < 0.0
            if not touching:
                for k in range(nodes):
                    on_casing[k] = 0.0
            else:
                for k in range(nodes):
                    forces[0, k] = 0.0
                    forces[1, k] = 0.0
                    forces[2, k] = 0.0
                    multipliers[k] = 0.0
                    sliding_known[k] = False
                    directions[0, k] = 0.0
                    directions[1, k] = 0.0
                    if friction is not None and gap[k] < 0.0:
                        _set_direction(k, rows, step_before, step, friction, rotation_velocity, directions)
                        sliding_known[k] = True
                if lining is not None:
                    turned = place * lining[5] / steps_per_revolution
                    _press_lining(gap, wear, lining, bar_position, turned, forces)
                    if friction is not None:
                        _add_friction(forces, directions, friction[0])
                    # the casing lies behind the lining; its gap after the lining's forces
                    for k in range(nodes):
                        gap[k] += lining[0] - _push(coupling, forces, k)
                closed = False
                for k in range(nodes):
                    closed = closed or gap[k] < 0.0
                if closed:
                    _press_casing(
                        gap,
                        coupling,
                        rows,
                        step_before,
                        step,
                        friction,
                        rotation_velocity,
                        directions,
                        sliding_known,
                        matrix,
                        multipliers,
                        scratch,
                        on_casing,
                        forces,
                        totals,
                    )
                else:
                    for k in range(nodes):
                        on_casing[k] = 0.0
                block_loss += _push_blade(forces, rows, friction, c, loss, now, step_before, step_now, push, totals)
            step_before, step_now = step_now, step_before
        totals[LOSS] += block_loss
        totals[STEPS] += steps_per_block
        done = block + 1
        bounded = True
        for o in range(output_rows.shape[0]):
            total = 0.0
            for i in range(modes):
                total += output_rows[o, i] * now[i]
            samples[block, o] = total
            # written so that NaN fails as well
            bounded = bounded and abs(total) < limit
        if snapshot_of_block is not None and snapshot_of_block[block] >= 0:
            for i in range(modes):
                snapshots[snapshot_of_block[block], i] = now[i]
        if not bounded:
            break
    state[0], state[1] = now, step_before
    return done


@njit(cache=True, forceinline=True, fastmath=_FAST)
def _set_direction(k, rows, increment, step, friction, rotation_velocity, directions):
    """Direction of the friction force on node k, from its sliding velocity over the last step."""
    along, across = 0.0, 0.0
    if friction[1] > 0.0:
        for i in range(len(increment)):
            along += rows[1, k, i] * increment[i]
            across += rows[2, k, i] * increment[i]
    directions[0, k], directions[1, k] = friction_direction(
        rotation_velocity[k], along / step, across / step, friction[1] > 0.0
    )


@njit(cache=True, forceinline=True)
def _press_lining(gap, wear, lining, bar_position, turned, forces):
    """Normal forces of the bars that the nodes press, from the predicted positions; wears them."""
    rings = wear.shape[0]
    bars = wear.shape[1]
    for k in range(len(gap)):
        if gap[k] < 0.0:
            # the rotor turns towards negative theta
            bar = int(np.floor(bar_position[k] - turned)) % bars
            ring = k if rings > 1 else 0
            stress, worn = return_mapping(-gap[k], wear[ring, bar], lining[0], lining[1], lining[2], lining[3])
            wear[ring, bar] = worn
            forces[0, k] = -stress * lining[4]


@njit(cache=True, forceinline=True)
def _add_friction(forces, directions, coefficient):
    for k in range(forces.shape[1]):
        forces[1, k] = -coefficient * forces[0, k] * directions[0, k]
        forces[2, k] = -coefficient * forces[0, k] * directions[1, k]


@njit(cache=True, forceinline=True)
def _push(coupling, forces, k):
    """Radial displacement (m) of node k caused in one step by the forces on all nodes."""
    total = 0.0
    for j in range(forces.shape[1]):
        if forces[0, j] != 0.0:
            for axis in range(3):
                total += coupling[0, axis, k, j] * forces[axis, j]
    return total


@njit(cache=True, forceinline=True)
def _press_casing(
    gap,
    coupling,
    rows,
    increment,
    step,
    friction,
    rotation_velocity,
    directions,
    sliding_known,
    matrix,
    multipliers,
    scratch,
    on_casing,
    forces,
    totals,
):
    """Add the forces of casing contact: multipliers that close no gap beyond zero, and the friction they cause."""
    nodes = len(gap)
    violation = 0.0
    # a node that only the others' reaction brings to the casing needs its friction direction too
    unknown = True
    while unknown:
        _casing_matrix(coupling, directions, friction, matrix)
        violation = solve_complementarity(matrix, gap, multipliers, scratch, on_casing)
        unknown = False
        if friction is not None:
            for k in range(nodes):
                if multipliers[k] > 0.0 and not sliding_known[k]:
                    _set_direction(k, rows, increment, step, friction, rotation_velocity, directions)
                    sliding_known[k] = True
                    unknown = True
    totals[WORST_COMPLEMENTARITY] = max(totals[WORST_COMPLEMENTARITY], violation)
    for k in range(nodes):
        if multipliers[k] > 0.0:
            forces[0, k] -= multipliers[k]
            if friction is not None:
                forces[1, k] += friction[0] * multipliers[k] * directions[0, k]
                forces[2, k] += friction[0] * multipliers[k] * directions[1, k]
            if on_casing[k] == 0.0:
                totals[CASING_HITS] += 1.0
            on_casing[k] = 1.0
        else:
            on_casing[k] = 0.0


@njit(cache=True, forceinline=True, fastmath=_FAST)
def _push_blade(forces, rows, friction, c, loss, now, step_before, step_now, push, totals):
    """Correct the predicted displacement and increment for the nodes' forces; returns the change of the damping loss."""
    modes = len(now)
    pressed = False
    for i in range(modes):
        push[i] = 0.0
    for k in range(forces.shape[1]):
        normal, along, across = forces[0, k], forces[1, k], forces[2, k]
        if normal < 0.0:
            pressed = True
            totals[LARGEST_FORCE] = max(totals[LARGEST_FORCE], -normal)
            if friction is None:
                for i in range(modes):
                    push[i] += rows[0, k, i] * normal
            else:
                for i in range(modes):
                    push[i] += rows[0, k, i] * normal + rows[1, k, i] * along + rows[2, k, i] * across
    if not pressed:
        return 0.0
    totals[STEPS_IN_CONTACT] += 1.0
    work, extra_loss = 0.0, 0.0
    for i in range(modes):
        free = step_now[i] + step_before[i]
        pushed = c[i] * push[i]
        step_now[i] += pushed
        now[i] += pushed
        moved = free + pushed
        work += 0.5 * push[i] * moved
        if loss is not None:
            extra_loss += loss[i] * (moved * moved - free * free)
    totals[WORK] += work
    return extra_loss


@njit(cache=True, forceinline=True)
def _casing_matrix(coupling, directions, friction, matrix):
    """Opening of each gap per unit multiplier of each node, with the friction it causes where that is coupled."""
    nodes = matrix.shape[0]
    normal, tangential, axial = coupling[0, 0], coupling[0, 1], coupling[0, 2]
    for i in range(nodes):
        for j in range(nodes):
            matrix[i, j] = normal[i, j]
    if friction is not None and friction[2] > 0.0:
        for i in range(nodes):
            for j in range(nodes):
                along = tangential[i, j] * directions[0, j] + axial[i, j] * directions[1, j]
                matrix[i, j] -= friction[0] * along
