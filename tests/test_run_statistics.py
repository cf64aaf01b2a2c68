"""What a run's file keeps, against closed forms and counts by hand."""

from contextlib import nullcontext
from dataclasses import replace
from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest
from defaults import Casing, IntegrationChoice, Scene
from integration_cases import DIRECT, LINING, oscillator, random_model

from r37core.contact.laws import wear_at_the_casing
from r37core.time_integration.casing_of_run import CasingOfRun
from r37core.time_integration.initial_motion import InitialMotion
from r37core.time_integration.kept_numbers import wear_numbers
from r37core.time_integration.problem import Problem, UnstableStepError
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.speed_run import run_speed
from r37core.time_integration.state import SimulationState
from r37core.time_integration.status import RunStatus
from r37core.time_integration.time_grid import TimeGrid

FREE = Scene(Casing(1.0, lobes=0), damping_ratio=0.0)
SPEED = 1000.0

SWINGING = InitialMotion.from_arrays([1e-4], None)
"""Displacement (m) of the one mode as its run starts."""

kept_of = partial(run_speed, spectrum_highest_order=31, wear_angles=90)


def with_tip(normal, tangential):
    """One mode whose amplitude moves leading and trailing edge differently."""
    model = oscillator(10.0 * SPEED)
    operator = np.zeros((3, 2, 1))
    operator[0, :, 0], operator[1, :, 0] = normal, tangential
    return replace(model, tip_displacement_operator=operator)


def test_statistics_of_a_free_oscillation():
    """Ten periods a revolution of 0.1 mm: rms amplitude/sqrt(2) in metres and one line of the spectrum, at both edges."""
    choice = IntegrationChoice(1e-7, 6, 620)
    kept = kept_of(with_tip([1.0, 3.0], [0.5, 2.0]), SPEED, FREE, choice, ("spectrum",), motion=SWINGING)
    expected = 1e-4 * np.array([[1.0, 1.0, 0.5], [3.0, 3.0, 2.0]])
    np.testing.assert_allclose(kept["rms"], expected / np.sqrt(2.0), rtol=1e-4)
    np.testing.assert_allclose(kept["peak"], expected, rtol=1e-3)
    np.testing.assert_allclose(kept["revolution_maxima"], np.broadcast_to(expected, (6, 2, 3)), rtol=1e-3)
    line = kept["engine_order"] == 10.0
    np.testing.assert_allclose(kept["amplitude"][:, line], [[1e-4], [0.5e-4]], rtol=1e-3)
    assert kept["amplitude"][:, ~line].max() < 1e-7


def test_contact_statistics_counted_step_by_step():
    """Every step of a node driven by a lobed casing is sampled: contacts, their onsets and forces are read off the motion."""
    frequency, step = 6000.0, 1e-6
    choice = IntegrationChoice(step, 2, 6284)
    scene = Scene(Casing(1e-4, rise_fraction=0.0), damping_ratio=0.0)
    model = oscillator(frequency)
    simulation = Simulation(model, SPEED, scene, choice)
    assert simulation.problem.grid.steps_per_sample == 1
    kept = kept_of(model, SPEED, scene, choice, ())
    u = simulation.advance(simulation.start(), 2).samples[:, 0]
    u = np.concatenate([[0.0, 0.0], u])
    h = simulation.problem.grid.time_step
    # the force that the recursion of central differences leaves over, for a unit mass
    force = (u[2:] - 2.0 * u[1:-1] + u[:-2]) / h**2 + frequency**2 * u[1:-1]
    pushed = np.abs(force) > 1e-6 * np.abs(force).max()
    assert 0.0 < pushed.mean() < 1.0
    assert kept["share_of_time_in_contact"] == pytest.approx(pushed.mean(), rel=1e-9)
    assert kept["largest_normal_force"] == pytest.approx(np.abs(force).max(), rel=1e-6)
    assert kept["casing_hits"] == np.count_nonzero(pushed & ~np.concatenate([[False], pushed[:-1]]))


@pytest.mark.parametrize("edge", [0, 1])
def test_either_edge_of_the_tip_can_diverge(edge):
    """The limit is on what any output moves, at the leading edge as at the trailing edge."""
    moves = [0.0, 0.0]
    moves[edge] = 5.0
    model, choice = with_tip(moves, [0.0, 0.0]), IntegrationChoice(1e-7, 4, 62)
    for limit, status in ((6e-4, RunStatus.COMPLETED), (4e-4, RunStatus.DIVERGED)):
        kept = kept_of(model, SPEED, replace(FREE, divergence_limit=limit), choice, (), motion=SWINGING)
        assert kept["status"] == status


def test_wear_is_that_of_the_most_worn_ring(monkeypatch):
    """A ring worn by a + b cos(3 theta): its largest depth, its profile and its harmonics; another ring is worn less.

    Bars count as worn through that are worn as far as the casing behind them allows: to round-off none, or a twelfth.
    """
    bars = 720
    theta = 2.0 * np.pi * np.arange(bars) / bars
    worn = 2e-4 + 1e-4 * np.cos(3.0 * theta) + 2e-5 * np.cos(7.0 * theta + 0.3)
    advance = Simulation.advance_samples

    def worn_lining(simulation, state: SimulationState, *samples, **room):
        record = advance(simulation, state, *samples, **room)
        state.wear[:] = 0.25 * worn
        state.wear[-1] = worn
        return record

    monkeypatch.setattr(Simulation, "advance_samples", worn_lining)
    lining = replace(LINING, bars=bars)
    kept = kept_of(random_model(2), SPEED, replace(DIRECT, lining=lining), IntegrationChoice(2e-7, 2, 62), ("wear",))
    assert kept["max_wear"] == worn.max()
    np.testing.assert_allclose(kept["wear"], worn.reshape(90, -1).max(axis=1), rtol=1e-6)
    harmonics = np.zeros(21)
    harmonics[[0, 3, 7]] = 2e-4, 1e-4, 2e-5
    np.testing.assert_allclose(kept["wear_harmonic"], harmonics, atol=1e-15)
    assert kept["worn_through_share"] == 0.0
    largest = wear_at_the_casing(lining)
    assert largest == pytest.approx(lining.thickness * 20.0 / 25.0, rel=1e-6)
    for share, reached in ((1.0 / 12.0, largest), (1.0 / 12.0, largest * (1.0 - 1e-12)), (0.0, largest * (1.0 - 1e-6))):
        rings = np.zeros((2, bars))
        rings[1, : bars // 12] = reached
        assert wear_numbers(rings, 90, lining, np.zeros((2, 1)))["worn_through_share"] == share


def test_what_a_tip_has_cut_leaves_nothing_that_springs_back():
    """A ring is cut by 1 mm before the run: as much is used, and it is not worn through, until the law wears more."""
    lining, rings, cut = replace(LINING, thickness=1.2e-3), np.zeros((2, 100)), np.array([[1e-3], [0.0]])
    at_the_casing = wear_at_the_casing(lining)
    assert at_the_casing < 1e-3
    rings += cut
    numbers = wear_numbers(rings, 10, lining, cut)
    assert (numbers["used_thickness"], numbers["worn_through_share"]) == (1e-3, 0.0)
    rings[1, :10] = at_the_casing
    numbers = wear_numbers(rings, 10, lining, cut)
    assert numbers["used_thickness"] == pytest.approx(1.2e-3) and numbers["worn_through_share"] == 0.1


def test_a_lining_that_cannot_yield_is_not_worn_through():
    lining = replace(LINING, yield_stress=2.0 * LINING.elastic_modulus)
    numbers = wear_numbers(np.zeros((2, 100)), 10, lining, np.zeros((2, 1)))
    assert numbers["worn_through_share"] == 0.0


def test_step_limit_of_a_lining_is_four_thirds():
    """A node pressed on an elastic bar, x_{n+1} = (1 - g)(2 x_n - x_{n-1}), is stable for g < 4/3; the refusal begins there."""
    assert np.abs(np.roots([1.0, -2.0 * (1.0 - 1.33), 1.0 - 1.33])).max() < 1.0
    assert np.abs(np.roots([1.0, -2.0 * (1.0 - 1.34), 1.0 - 1.34])).max() > 1.0
    model, choice = oscillator(6000.0), IntegrationChoice(1e-6, 1, 62)
    step = Problem(model, SPEED, DIRECT, choice).grid.time_step
    soft = replace(LINING, elastic_modulus=1.0)
    stiffness_per_pascal = soft.pressed_areas(model.tip_lengths, 0.25)[0] / soft.thickness
    for share, refused in ((0.999, False), (1.001, True)):
        lining = replace(soft, elastic_modulus=share * 4.0 / 3.0 / step**2 / stiffness_per_pascal)
        with pytest.raises(UnstableStepError, match="limit for this lining") if refused else nullcontext():
            Problem(model, SPEED, replace(DIRECT, lining=lining), choice)


@pytest.mark.parametrize(("snapshots", "kept"), [(4, 2), (1, 1), (0, 2), (4, 0)])
def test_snapshots_are_the_last_samples_of_equal_parts(snapshots, kept):
    """In whatever pieces the run is done."""
    choice = IntegrationChoice(1e-5, 3, 8, snapshots_per_revolution=snapshots, snapshot_revolutions=kept)
    grid, samples = TimeGrid(1000.0, choice), 24
    every = 8 // snapshots if snapshots and kept else 0
    expected = [n for n in range(samples) if every and n >= samples - 8 * kept and (n + 1) % every == 0]
    assert grid.samples_per_snapshot == every and grid.snapshots_after(samples) == len(expected)
    for piece in (24, 5, 1):
        pieces = [(first, min(first + piece, samples)) for first in range(0, samples, piece)]
        assert [first + n for first, last in pieces for n in grid.snapshots_between(first, last)] == expected


def test_rotation_slides_the_tip_with_its_own_speed():
    run = SimpleNamespace(tip=SimpleNamespace(radius=np.array([0.25])), grid=SimpleNamespace(speed=1000.0))
    np.testing.assert_array_equal(CasingOfRun.rotation_velocity.fget(run), [-250.0])
