"""The time integration as a plain loop over NumPy arrays: a third witness of the engines, and a measure of their programs.

It does runs of the benchmark's two scenes: exact modal steps, forces at t_n, linear gap, vector friction, a rigid casing with a
lining or bare, and the compiled engine's jumps over free flight. numba compiles it as it stands. Energies, snapshots and the
tip's edge are left out. Formulas: time_integration.compiled.contact_steps and jump_steps, contact.node_sweeps, contact.laws.
"""

import time
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numba import njit
from numba.extending import register_jitable

from r37core.contact.casing import rise_rate
from r37core.contact.laws import line_of_wear
from r37core.machine_code.alignment import LANES
from r37core.rom.contact_model import read_contact_model
from r37core.time_integration.jump_numbers import BEYOND, COARSE, D_FROM_D, D_FROM_U, U_FROM_D, U_FROM_U
from r37core.time_integration.jump_plan import jump_lengths, nearest_casing, plan_jumps
from r37core.time_integration.problem import Problem
from r37core.time_integration.simulate import Simulation

from .configuration import settings_of
from .contact_runs import BARE, LINED
from .pages import write_table

SPEEDS, REVOLUTIONS, TURNS = range(800, 2000, 120), 50, 5
"""Speeds (rad/s) and length of the runs that are timed; how often."""

_MARGIN, _TOLERANCE, _SWEEPS = 1e-9, 1e-13, 500
"""Margin of the distances of a jump; change of a penetration, over the largest gap, that ends the sweeps; most of these."""


class Loop(NamedTuple):
    """Numbers of a run, as the Problem and the JumpPlan have them; steps are counted from its start."""

    keep: np.ndarray
    pull: np.ndarray
    inverse: np.ndarray
    rows: np.ndarray  # displacement of the nodes along normal, tangent and meridian, shape (3, nodes, modes)
    flexibility: np.ndarray  # normal displacement (m/N) of the last node per force on the first, shape (3, nodes, nodes)
    outputs: np.ndarray  # a sample per u, shape (6, modes)
    force_outputs: np.ndarray  # and per force, shape (6, 3, nodes)
    clearance: np.ndarray
    rotation: np.ndarray  # sliding in a step (m), shape (nodes,)
    friction: float
    shape: np.ndarray  # f(theta), shape (steps per revolution, nodes)
    nearest: np.ndarray  # the largest of each interval, shape (samples per revolution, intervals, nodes)
    lobe_height: float
    rise: float  # rate per step
    steps_per_sample: int
    lengths: np.ndarray
    slow: np.ndarray
    jumps: np.ndarray
    amplitude_rows: np.ndarray
    lined: bool
    law: tuple[float, ...]  # of a bar: elastic and plastic modulus, yield stress, thickness
    wear_line: tuple[float, ...]  # wear over penetration: slope, offset, largest penetration
    area: np.ndarray
    bar_position: np.ndarray  # angle of the nodes at step 0, in bars


def loop_of(problem: Problem) -> Loop:
    """The numbers of a problem."""
    contact, casing, grid, scene = problem.contact, problem.casing, problem.grid, problem.scene
    assert problem.choice.second_order and casing.ring is None and not scene.exact_gap and casing.rise_time > 0.0
    assert scene.friction is not None and scene.friction.vector
    nodes, modes = contact.displacement_operator.shape[1:]
    steps, recursion, lining = grid.steps_per_sample, contact.recursion, scene.lining
    plan = plan_jumps(recursion, steps, LANES, followed=modes)
    assert plan is not None
    law, wear_line = (0.0,) * 4, (0.0,) * 3
    if lining is not None:
        law = lining.elastic_modulus, lining.plastic_modulus, lining.yield_stress, lining.thickness
        wear_line = *line_of_wear(lining), lining.thickness
    shape = scene.casing.shape(casing.theta(np.arange(grid.steps_per_revolution)[:, None]))
    return Loop(
        keep=recursion.keep,
        pull=recursion.pull,
        inverse=recursion.inverse,
        rows=contact.displacement_operator,
        flexibility=contact.contact_flexibility,
        outputs=np.ascontiguousarray(contact.output_operator[:, :modes]),
        force_outputs=np.ascontiguousarray(contact.output_operator[:, modes:]).reshape(-1, 3, nodes),
        clearance=casing.clearance,
        rotation=casing.rotation_velocity * grid.time_step,
        friction=scene.friction.coefficient,
        shape=shape,
        nearest=nearest_casing(shape, steps),
        lobe_height=scene.casing.lobe_height,
        rise=rise_rate(casing.rise_time) * grid.time_step,
        steps_per_sample=steps,
        lengths=jump_lengths(steps),
        slow=plan.slow_modes,
        jumps=plan.jumps,
        amplitude_rows=plan.amplitude_rows,
        lined=lining is not None,
        law=law,
        wear_line=wear_line,
        area=casing.pressed_areas,
        bar_position=casing.tip.theta / (2.0 * np.pi) * casing.bars,
    )


def room_of(problem: Problem, revolutions: int) -> tuple[np.ndarray, np.ndarray]:
    """Room for the samples (m) of a run, and unworn bars."""
    wear = np.zeros((len(problem.casing.tip.theta), max(problem.casing.bars, 1)))
    return np.empty((revolutions * problem.choice.samples_per_revolution, 6)), wear


@register_jitable
def find_gaps(loop, u, lobes, place, gap):
    """Gaps (m) to casing or unworn lining at a place of a revolution, with `lobes` (m) high; returns whether one is passed."""
    passed = False
    for k in range(len(gap)):
        normal = 0.0
        for i in range(len(u)):
            normal += loop.rows[0, k, i] * u[i]
        gap[k] = loop.clearance[k] - lobes * loop.shape[place, k] - normal
        passed = passed or gap[k] < 0.0
    return passed


@register_jitable
def is_clear(loop, stride, u, d, reach, nearest, lobes):
    """Check that no node can touch anything in a jump: slow modes along their tangent, `reach` (m) beyond it.

    `nearest`: f(theta) of the intervals from here on; `lobes` (m): their height at the end.
    """
    length = loop.lengths[stride]
    for k in range(len(loop.clearance)):
        velocity = position = shape = 0.0
        for i in range(loop.slow[stride]):
            velocity += loop.rows[0, k, i] * d[i]
            position += loop.rows[0, k, i] * u[i]
        position += max(velocity, velocity * length) + reach[k]
        for j in range((length + COARSE - 1) // COARSE):
            shape = max(shape, nearest[j, k])
        room = loop.clearance[k] - lobes * shape - position
        if not room > _MARGIN * (abs(loop.clearance[k]) + lobes + abs(position)):
            return False
    return True


@register_jitable
def longest_jump(loop, first, left, u, d, amplitude, reach, nearest, remaining):
    """Longest clear jump of at most `left` steps from the `first` on; -1 without one. `remaining`: what the lobes lack."""
    highest, lowest = (first, 1) if left >= COARSE else (0, 0)
    for stride in range(highest, lowest - 1, -1):
        if np.isnan(reach[stride, 0]):
            for k in range(len(loop.clearance)):
                reach[stride, k] = 0.0
                for i in range(len(u)):
                    reach[stride, k] += abs(loop.rows[0, k, i]) * amplitude[i] * loop.jumps[stride, BEYOND, i]
        lobes = loop.lobe_height * (1.0 - remaining * np.exp(-loop.rise * loop.lengths[stride]))
        if loop.lengths[stride] <= left and is_clear(loop, stride, u, d, reach[stride], nearest, lobes):
            return stride
    return -1


@register_jitable
def press_node(loop, k, penetration, own, wear):
    """Normal force (N) on a node that would penetrate so much (m), had it none; `own` (m/N): its flexibility.

    Of the casing, or of a bar in series with the node: elastic up to the yield stress, which the plastic strain raises.
    """
    if not loop.lined:
        return max(penetration / own, 0.0)
    elastic_modulus, plastic_modulus, yield_stress, thickness = loop.law
    modulus = elastic_modulus / (1.0 + elastic_modulus * loop.area[k] / thickness * own)
    elastic = modulus / thickness * (penetration - wear)
    hardened = yield_stress + plastic_modulus / thickness * penetration
    stress = min(elastic, modulus / (modulus + plastic_modulus) * hardened)
    return max(stress * loop.area[k], (penetration - thickness) / own, 0.0)


@register_jitable
def press(loop, gap, d, last, bar, wear, force, pressure, column):
    """Turn the forces (N) at t_{n-1} into those at t_n, from the gaps (m) there, which they open; wears the bars.

    Node by node gets the force that its law says while the others keep theirs (projected Gauss-Seidel).
    """
    nodes, largest_gap, changed = len(gap), np.abs(gap).max(), True
    # of nodes that are not looked at
    pressure[:] = np.nan
    while changed:
        changed = False
        for k in range(nodes):
            if pressure[k] >= 0.0 or not gap[k] + wear[k, bar[k]] < 0.0:
                continue
            changed, pressure[k] = True, -force[0, k]
            # friction against the sliding at t_n, extrapolated
            along, across = loop.rotation[k], 0.0
            for i in range(len(d)):
                along += loop.rows[1, k, i] * (1.5 * d[i] - 0.5 * last[i])
                across += loop.rows[2, k, i] * (1.5 * d[i] - 0.5 * last[i])
            share = -loop.friction / np.sqrt(along * along + across * across)
            force[0, k], force[1, k], force[2, k] = -1.0, share * along, share * across
            for g in range(nodes):
                column[k, g] = 0.0
                for axis in range(3):
                    column[k, g] -= force[axis, k] * loop.flexibility[axis, k, g]
                gap[g] += column[k, g] * pressure[k]
        for _ in range(_SWEEPS):
            largest = 0.0
            for k in range(nodes):
                if pressure[k] >= 0.0:
                    own, before = column[k, k], pressure[k]
                    pressure[k] = press_node(loop, k, own * before - gap[k], own, wear[k, bar[k]])
                    largest = max(largest, abs(pressure[k] - before) * own)
                    for g in range(nodes):
                        gap[g] += column[k, g] * (pressure[k] - before)
            if largest <= _TOLERANCE * largest_gap:
                break
    for k in range(nodes):
        force[:, k] *= pressure[k] if pressure[k] >= 0.0 else 0.0
        if pressure[k] >= 0.0 and loop.lined:
            slope, offset, thickness = loop.wear_line
            wear[k, bar[k]] = max(wear[k, bar[k]], slope * min(-gap[k], thickness) + offset)


@register_jitable
def wear_passed_bars(ring, position, last, penetration, before, wear_line):
    """Wear the bars of a node's `ring` from its place in the `last` step to its `position` in this one, both in bars.

    By a penetration (m) that is linear between that `before` and this one.
    """
    slope, offset, thickness = wear_line
    bar = (int(np.floor(position)) + 1) % len(ring)
    for number in range(int(np.floor(position)) + 1, int(np.floor(last))):
        depth = penetration + (before - penetration) * (number + 0.5 - position) / (last - position)
        ring[bar] = max(ring[bar], slope * min(depth, thickness) + offset)
        bar = bar + 1 if bar + 1 < len(ring) else 0


def march(loop, samples, wear):
    """Fill the samples of a run from rest and wear the bars; returns the steps in contact, and those that are jumped over.

    u_{n+1} = u_n + d_{n+1}, d_{n+1} = keep d_n - pull u_n + inverse F_n, with the modal forces F_n of those at t_n.
    """
    (nodes, modes), steps, bars = loop.rows.shape[1:], len(loop.shape), wear.shape[1]
    u, d, last, amplitude = np.zeros(modes), np.zeros(modes), np.zeros(modes), np.zeros(modes)
    force, gap, penetration, bar = np.zeros((3, nodes)), np.zeros(nodes), np.zeros(nodes), np.zeros(nodes, np.int64)
    pressure, column, reach = np.zeros(nodes), np.zeros((nodes, nodes)), np.zeros((len(loop.lengths), nodes))
    decay = np.exp(-loop.rise)
    pressed, busy, bounded, measured, first, in_contact, jumped = False, False, False, False, 1, 0, 0
    for sample in range(len(samples)):
        begin, step, remaining = sample * loop.steps_per_sample, 0, np.exp(-loop.rise * sample * loop.steps_per_sample)
        if begin % steps == 0:
            # as the engine may be stopped there
            busy, bounded, first = pressed or (loop.lined and penetration.max() > 0.0), False, 1
            measured = busy
        while step < loop.steps_per_sample:
            if step % COARSE == 0 and not busy:
                if not bounded:
                    for i in range(modes):
                        imaginary = loop.amplitude_rows[0, i] * u[i] + loop.amplitude_rows[1, i] * d[i]
                        amplitude[i] = np.sqrt(u[i] * u[i] + imaginary * imaginary)
                    reach[:] = np.nan
                    bounded = True
                nearest = loop.nearest[begin % steps // loop.steps_per_sample, step // COARSE :]
                left = loop.steps_per_sample - step
                stride = longest_jump(loop, first, left, u, d, amplitude, reach, nearest, remaining)
                first = max(min(stride + 1, len(loop.lengths) - 1), 1)
                if stride >= 0:
                    jump = loop.jumps[stride]
                    for i in range(modes):
                        before = u[i]
                        u[i] += jump[U_FROM_U, i] * before + jump[U_FROM_D, i] * d[i]
                        d[i] += jump[D_FROM_U, i] * before + jump[D_FROM_D, i] * d[i]
                    step += loop.lengths[stride]
                    remaining *= np.exp(-loop.rise * loop.lengths[stride])
                    jumped += loop.lengths[stride]
                    measured = False
                    continue
            if loop.lined and not measured:
                lobes = loop.lobe_height * (1.0 - remaining)
                find_gaps(loop, u, lobes, (begin + step) % steps, gap)
                penetration[:] = -gap
                measured = True
            step += 1
            remaining *= decay
            place, lobes = (begin + step) % steps, loop.lobe_height * (1.0 - remaining)
            for i in range(modes):
                last[i] = d[i]
                d[i] = loop.keep[i] * d[i] - loop.pull[i] * u[i]
            if pressed:
                in_contact += 1
                bounded = False
                for k in range(nodes):
                    if force[0, k] != 0.0:
                        for i in range(modes):
                            push = loop.rows[0, k, i] * force[0, k] + loop.rows[1, k, i] * force[1, k]
                            d[i] += loop.inverse[i] * (push + loop.rows[2, k, i] * force[2, k])
            for i in range(modes):
                u[i] += d[i]
            busy, pressed = find_gaps(loop, u, lobes, place, gap), False
            if busy:
                for k in range(nodes):
                    bar[k] = int(np.floor(loop.bar_position[k] - place * bars / steps)) % bars
                press(loop, gap, d, last, bar, wear, force, pressure, column)
                pressed = force[0].min() < 0.0
            else:
                force[:] = 0.0
            for k in range(nodes if loop.lined else 0):
                if gap[k] < 0.0 or penetration[k] > 0.0:
                    here = loop.bar_position[k] - place * bars / steps
                    there = loop.bar_position[k] + (bars if place == 0 else 0) - ((place or steps) - 1) * bars / steps
                    wear_passed_bars(wear[k], here, there, -gap[k], penetration[k], loop.wear_line)
                penetration[k] = -gap[k]
        samples[sample] = 0.0
        for o in range(len(loop.outputs)):
            for i in range(modes):
                samples[sample, o] += loop.outputs[o, i] * u[i]
            for k in range(nodes if pressed else 0):
                for axis in range(3):
                    samples[sample, o] += loop.force_outputs[o, axis, k] * force[axis, k]
    return in_contact, jumped


def ratio(input: Any, output: Any, params: Any) -> None:
    """CPU time of a step by the compiled engine and by the plain loop, in turns. Input: model, of the reference blade."""
    settings, model, rows, compiled = settings_of(Path.cwd()), read_contact_model(input.model), [], njit(march)
    for name in (BARE, LINED):
        scene, times = settings.scenes[name].scene, []
        for speed in SPEEDS:
            recorded = settings.integration_choice("Ref", name, speed)
            choice = replace(recorded, snapshots_per_revolution=0, snapshot_revolutions=0)
            times.append(_nanoseconds(Simulation(model, speed, scene, choice), compiled))
        engine, plain = np.mean(times, axis=0)
        print(f"{name}: {engine:.0f} ns and {plain:.0f} ns")
        rows.append([name, f"{plain / engine:.1f}"])
    write_table(["scene", "CPU time of the plain loop over that of the engine"], rows, output.table)


def _nanoseconds(simulation: Simulation, compiled: Any) -> np.ndarray:
    """CPU time (ns) of a step by the engine, and by the compiled loop: medians."""
    problem, loop, spent = simulation.problem, loop_of(simulation.problem), []
    # the first turn compiles
    for _ in range(TURNS + 1):
        state, room, begun = simulation.start(), room_of(problem, REVOLUTIONS), time.process_time()
        simulation.advance(state, REVOLUTIONS)
        between = time.process_time()
        compiled(loop, *room)
        spent.append([between - begun, time.process_time() - between])
    return 1e9 * np.median(spent[1:], axis=0) / (REVOLUTIONS * problem.grid.steps_per_revolution)
