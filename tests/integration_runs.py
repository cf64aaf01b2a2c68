"""Runs that the tests of the time integration share, and what they compare of them."""

from dataclasses import replace
from itertools import chain, combinations

import numpy as np
import pytest
from defaults import Friction
from integration_cases import NARROW
from reference_engine import ReferenceRotor, ReferenceSimulation

from r37core.time_integration.problem import stable_problem
from r37core.time_integration.rotor_simulation import RotorSimulation
from r37core.time_integration.simulate import DIRECTIONS, Simulation

ENGINES = {"compiled": Simulation, "reference": ReferenceSimulation}
ROTORS = {"compiled": RotorSimulation, "reference": ReferenceRotor}
"""Simulations of a blade and of a rotor by each of the two engines."""


def whole_run(model, speed, scene, choice, motion=None, engine="compiled"):
    """Simulation of all revolutions of a choice, its state at the end, and its record."""
    simulation = ENGINES[engine](model, speed, scene, choice)
    state = simulation.start(motion)
    return simulation, state, simulation.advance(state, choice.revolutions)


def both_engines(model, speed, scene, choice):
    """The whole run of the compiled engine, and that of the reference."""
    return [whole_run(model, speed, scene, choice, engine=engine) for engine in ENGINES]


def in_all_directions(numbers, kind):
    """Numbers of a run in all three directions, which are the last axis."""
    return np.stack([numbers[f"{kind}_{direction}"] for direction in DIRECTIONS], axis=-1)


def times(simulation, count):
    """When so many samples from the start on are taken (s)."""
    grid = simulation.problem.grid
    return (1 + np.arange(count)) * grid.steps_per_sample * grid.time_step


def free_motion(frequency, ratio, time, start, velocity):
    """Displacement of an underdamped oscillator (Meirovitch, Fundamentals of Vibrations, section 2.2)."""
    damped = frequency * np.sqrt(1 - ratio**2)
    sine = (velocity + ratio * frequency * start) / damped
    return np.exp(-ratio * frequency * time) * (start * np.cos(damped * time) + sine * np.sin(damped * time))


def assert_close(found, expected, within):
    """Numbers that are off by at most a share of the largest one expected."""
    np.testing.assert_allclose(found, expected, rtol=0, atol=within * np.abs(expected).max())


def assert_same_record(ours, theirs, within=1e-10):
    """Of the same samples, snapshots and, where it is elastic, motion of the casing."""
    for name in ("samples", "snapshots", "casing"):
        expected = getattr(theirs, name)
        if expected is not None and expected.size:
            assert_close(getattr(ours, name), expected, within)


def assert_same_state(ours, theirs, within=1e-10):
    """Of the states that two engines leave; `within`: of the largest wear, for each bar's."""
    for total in ("steps", "steps_in_contact", "casing_hits"):
        assert ours.totals[total] == theirs.totals[total]
    for total in ("largest_force", "work", "loss", "friction_heat"):
        assert ours.totals[total] == pytest.approx(theirs.totals[total], rel=1e-8)
    if ours.wear.size:
        assert_close(ours.wear, theirs.wear, within)


def assert_stable(model, choice, modulus, steps, counts):
    """Of eight nodes without friction no `counts` that stay on bars of a `modulus` (Pa) move more and more.

    At these `steps` (s), or shorter ones where they must be. Bars of an infinite modulus are the casing.
    """
    lining = replace(NARROW.lining, elastic_modulus=min(modulus, 1e14))
    scene = replace(NARROW, lining=lining, friction=Friction(0.0))
    for step in steps:
        problem = stable_problem(model, 1600.0, scene, replace(choice, time_step=step, shorten=True))
        bar = problem.casing.lining_stiffness[0] if modulus < np.inf else np.inf
        for nodes in chain.from_iterable(combinations(range(8), count) for count in counts):
            largest = np.abs(np.linalg.eigvals(_pressed_step(problem.contact, list(nodes), bar))).max()
            assert largest**problem.grid.steps_per_revolution - 1.0 < 1e-6, (step, problem.grid.time_step, nodes)


def _pressed_step(contact, nodes, bar):
    """A step of u and d with `nodes` on bars of a stiffness (N/m), as a matrix.

    The force at t_n is -K N u_n, K = (1/bar + R)^-1 of the nodes pressed.
    """
    recursion, modes = contact.recursion, len(contact.recursion.keep)
    rows = contact.displacement_operator[0, nodes]
    held = np.linalg.inv(np.eye(len(nodes)) / bar + contact.contact_flexibility[0][np.ix_(nodes, nodes)].T)
    kick = recursion.inverse / recursion.keep
    kicked = np.eye(2 * modes)
    kicked[modes:, :modes] = -kick[:, None] * rows.T @ held @ rows
    increment = np.hstack([-np.diag(recursion.pull), np.diag(recursion.keep)]) @ kicked
    return np.vstack([kicked[:modes] + increment, increment])
