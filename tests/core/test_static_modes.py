"""Which modes are static: as many as make the contact forces unique, as friction has it, and no more than the step asks for."""

import re
from dataclasses import replace

import numpy as np
import pytest
from defaults import Casing, Friction, IntegrationChoice, Scene
from integration_cases import ABRADABLE, DIRECT, oscillator, random_model, with_modes, with_static_modes
from integration_runs import assert_close, both_engines

from r37core.contact.casing import casing_axes
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL
from r37core.time_integration.problem import Problem, UnstableStepError, stable_problem
from r37core.time_integration.static_modes import (
    SMALLEST_DEFINITENESS,
    TooFewStaticModesError,
    definiteness,
    residual_flexibility,
    stepped_modes,
)

CHOICE = IntegrationChoice(3.2e-6, 1, 62, integrator=EXACT_MODAL)


def with_friction(coefficient, **others):
    return replace(DIRECT, friction=Friction(coefficient, **others))


def problem_of(model, coefficient, step, **others):
    return Problem(model, 1600.0, with_friction(coefficient), replace(CHOICE, time_step=step, **others))


def test_what_is_stepped_and_what_is_static_are_the_whole_flexibility(contact):
    """Normal displacement per force along each direction, by the stiffness matrix of the speed."""
    problem = problem_of(contact, 0.15, 3.2e-6)
    rows, nodes = problem.contact.operator_at_rest, len(contact.theta)
    stiffness = np.diag(contact.squared_frequencies) + 1600.0**2 * contact.stiffness_per_square
    whole = np.stack([along @ np.linalg.solve(stiffness, rows[0].T) for along in rows])
    stepped = rows @ problem.blade.modes / problem.blade.frequencies
    found = problem.contact.contact_flexibility + stepped @ stepped[0].T
    assert found.shape == (3, nodes, nodes)
    assert_close(found, whole, 1e-9)
    # most of it moves slowly
    assert np.abs(problem.contact.contact_flexibility).max() < 0.2 * np.abs(whole).max()


def test_definiteness_by_hand():
    """Two nodes of flexibility 4 and 1 that share 0.8, pulled along by half as much: 1 - 0.4 without friction."""
    normal = np.array([[4.0, 0.8], [0.8, 1.0]])
    flexibility = np.array([normal, 0.5 * normal, 0.0 * normal])
    assert definiteness(flexibility, 0.0) == pytest.approx(0.6)
    # at worst friction along the tangent takes a share of 0.5 mu from all
    assert definiteness(flexibility, 0.4) == pytest.approx(0.8 * 0.6)
    assert definiteness(flexibility, 2.0) == pytest.approx(0.0, abs=1e-12)
    assert definiteness(flexibility, 4.0) < 0.0
    assert definiteness(np.array([np.diag([1.0, 0.0]), np.zeros((2, 2)), np.zeros((2, 2))]), 0.0) == 0.0


def test_static_modes_are_those_that_the_step_does_not_follow(contact):
    """As far as whole vectors of modes are stepped, and the forces bear it; none turns by more than twice what is static."""
    frequencies, counts = np.sqrt(contact.squared_frequencies), []
    most = len(frequencies)
    rows = casing_axes(contact.displacement_operator, contact.tip_cone_angle)
    for step in (1e-8, 3.2e-6, 6.4e-6, 1.28e-5):
        counts.append(stepped_modes(frequencies, rows, 0.15, step, 1.0, most))
        assert counts[-1] % 8 == 0
        assert frequencies[counts[-1] - 1] * step <= 2.0
        assert len(problem_of(contact, 0.15, step).blade.frequencies) == counts[-1]
    assert counts == sorted(counts, reverse=True) and counts[0] > counts[1] > counts[2] > counts[3]
    # a step that follows every mode still leaves the forces their flexibility
    assert frequencies[-1] * 1e-8 < 1.0 and counts[0] < len(frequencies)
    of_rest = residual_flexibility(frequencies[counts[0] :], rows[..., counts[0] :])
    assert definiteness(of_rest, 0.15) > SMALLEST_DEFINITENESS
    # twice as fast a mode is stepped where that is asked for
    assert stepped_modes(frequencies, rows, 0.15, 6.4e-6, 2.0, most) == counts[1]
    # and fewer where that is
    assert stepped_modes(frequencies, rows, 0.15, 3.2e-6, 1.0, 5) == 5


def test_strong_friction_steps_more_modes_or_shortens_the_step(contact):
    weak, strong = (len(problem_of(contact, coefficient, 2.9e-6).blade.frequencies) for coefficient in (0.15, 0.8))
    assert strong > weak
    message = r"time_step_s: 6\.4e-06 s, not below (\S+) s: .*friction of 0\.5 modes up to"
    with pytest.raises(UnstableStepError, match=message) as error:
        problem_of(contact, 0.5, 6.4e-6)
    limit = float(re.search(message, str(error.value))[1])
    shortened = stable_problem(contact, 1600.0, with_friction(0.5), replace(CHOICE, time_step=6.4e-6, shorten=True))
    # not more than it must be: to half of what pressed nodes bear, where that is less
    assert 0.4 * limit < shortened.grid.time_step <= limit * (1.0 + 1e-5)
    assert definiteness(shortened.contact.contact_flexibility, 0.5) > SMALLEST_DEFINITENESS


def test_friction_that_leaves_no_unique_forces_is_refused_with_what_is_allowed(contact):
    message = r"friction\.coefficient of the scene.*: found 1\.5, at which .*not unique.*; allowed: up to about (\S+), or the"
    with pytest.raises(TooFewStaticModesError, match=message) as error:
        problem_of(contact, 1.5, 8e-7)
    allowed = float(re.search(message, str(error.value))[1])
    assert 0.5 < allowed < 1.5
    problem_of(contact, allowed, 8e-7)


@pytest.mark.parametrize("seed", range(20))
def test_the_coefficient_that_is_said_to_be_allowed_is(seed):
    """Nodes that friction pulls towards the casing, each by more or less of its force."""
    generator, nodes = np.random.default_rng(seed), 3
    rows = np.stack([np.eye(nodes), np.diag(generator.uniform(0.5, 2.0, nodes)), np.zeros((nodes, nodes))])
    rows = np.concatenate([generator.standard_normal((3, nodes, 8)), 1e8 * 1e-4 * rows], axis=-1)
    frequencies = np.concatenate([np.linspace(1e4, 1e5, 8), np.full(nodes, 1e8)])
    with pytest.raises(TooFewStaticModesError, match=r"allowed: up to about \S+, or") as error:
        stepped_modes(frequencies, rows, 5.0, 1e-6, 1.0, 11)
    allowed = float(re.search(r"up to about (\S+), or", str(error.value))[1])
    assert stepped_modes(frequencies, rows, allowed, 1e-6, 1.0, 11) <= 8
    # and not much less than could be
    with pytest.raises(TooFewStaticModesError):
        stepped_modes(frequencies, rows, 1.05 * allowed, 1e-6, 1.0, 11)


@pytest.mark.parametrize("model", [oscillator(6000.0), random_model(16)], ids=["one", "random"])
@pytest.mark.parametrize("scene", [DIRECT, ABRADABLE], ids=["direct", "abradable"])
def test_models_of_too_few_modes_are_refused(model, scene):
    modes, nodes = len(model.squared_frequencies), len(model.theta)
    message = rf"the reduced model has {modes} modes for {nodes} contact nodes, too few for unique .*structure\.boundary\.nodes"
    with pytest.raises(TooFewStaticModesError, match=message):
        Problem(model, 1600.0, scene, replace(CHOICE, time_step=1e-7))
    Problem(model, 1600.0, scene, replace(CHOICE, time_step=1e-7, integrator=CENTRAL_DIFFERENCE))
    held = Problem(with_static_modes(model, 1e-9), 1600.0, scene, replace(CHOICE, time_step=1e-7))
    assert len(held.blade.frequencies) == modes


@pytest.mark.slow
@pytest.mark.parametrize(("nodes", "shared"), [(8, 0.05), (8, 0.2), (8, 1.0), (20, 1.0)])
def test_forces_settle_where_static_modes_move_all_nodes_together(nodes, shared):
    """A static mode beside those of each node alone, with `shared` of their flexibility, pressed all round by a casing."""
    together = np.zeros((3, nodes, 1))
    together[0] = np.sqrt(shared * 1e-9)
    model = with_modes(with_static_modes(random_model(nodes), 1e-9), 1e8, together)
    scene = Scene(Casing(1e-4, lobes=1, amplitude=1.5, width=1e6, rise_fraction=0.0, cone_angle=0.0))
    runs = both_engines(model, 24_000.0, scene, replace(CHOICE, time_step=6e-7))
    for simulation, state, _ in runs:
        assert definiteness(simulation.problem.contact.contact_flexibility, 0.0) > SMALLEST_DEFINITENESS
        assert state.totals["steps_in_contact"] > 0.1 * state.totals["steps"]
        assert state.totals["worst_complementarity"] == 0.0
    assert_close(*(record.samples for _, _, record in runs), 1e-6)


def close_patches(smallest, slow=16):
    """Frequencies and rows of modes, of which the static ones move four nodes mostly together: `smallest` eigenvalue."""
    nodes = 4
    flexibility = smallest * np.eye(nodes) + (1.0 - smallest)
    static = np.stack([np.linalg.cholesky(flexibility), np.zeros((nodes, nodes)), np.zeros((nodes, nodes))])
    rows = np.concatenate([1e-3 * np.ones((3, nodes, slow)), 1e4 * static], axis=-1)
    return np.concatenate([np.linspace(1e4, 1e5, slow), np.full(nodes, 1e8)]), rows


def test_close_patches_need_less_definiteness_and_fewer_stepped_modes_where_pressed_nodes_would_be_unstable():
    """Forces are unique, though sweeps take longer; below a twentieth modes are too few."""
    for smallest in (0.5, 0.1):
        assert stepped_modes(*close_patches(smallest), 0.0, 1e-5, 1.0, 20) == 16
    with pytest.raises(TooFewStaticModesError):
        stepped_modes(*close_patches(0.04), 0.0, 1e-5, 1.0, 20)
    frequencies, rows = close_patches(0.5)
    assert stepped_modes(frequencies, rows, 0.0, 1e-5, 1.0, 20, lambda stepped: stepped <= 8) == 8
    # where none is stable it is for the step to be shorter
    assert stepped_modes(frequencies, rows, 0.0, 1e-5, 1.0, 20, lambda stepped: False) == 16
