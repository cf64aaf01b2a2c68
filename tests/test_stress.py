"""The stress of a run: largest of each revolution, and what a run's revolutions say together."""

from dataclasses import replace

import numpy as np
import pytest

from r37core.stress.operator import StressOperator, read_stress_operator, write_stress_operator
from r37core.stress.recovery import stress_operator
from r37core.stress.revolutions import largest_of_revolutions
from r37core.stress.statistic import stress_statistic

INSTANTS, REVOLUTIONS = 31, 40


@pytest.fixture
def stress(model, steel):
    return stress_operator(model, steel)


def motion(model, seed=0):
    """Random motion of ten modes, the slower the larger, and the modes as shapes of the reduced coordinates."""
    frequencies, shapes = model.modes(0.0, 10)
    random = np.random.default_rng(seed)
    return random.standard_normal((REVOLUTIONS * INSTANTS, 10)) * 1e-3 * frequencies[0] / frequencies, shapes


def in_full(stress, coordinates):
    return stress.max_von_mises(coordinates).reshape(REVOLUTIONS, INSTANTS).max(axis=1)


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_the_largest_stress_of_each_revolution_is_that_of_all_nodes_and_instants(model, stress, seed):
    states, shapes = motion(model, seed)
    wanted = in_full(stress, states @ shapes.T)
    np.testing.assert_allclose(largest_of_revolutions(stress, states, shapes, np.empty(0), INSTANTS), wanted, rtol=2e-6)


def test_rotation_s_stress_is_in_it(model, stress):
    states, shapes = motion(model)
    rotation = np.full(model.stress_submesh.rotation_shapes.shape[2], 2e6)
    both = np.hstack([states @ shapes.T, np.broadcast_to(rotation, (len(states), len(rotation)))])
    assert stress.have_rotation(both) and not stress.have_rotation(states @ shapes.T)
    found = largest_of_revolutions(stress, states, shapes, rotation, INSTANTS)
    np.testing.assert_allclose(found, in_full(stress, both), rtol=2e-6)
    assert np.all(found != largest_of_revolutions(stress, states, shapes, np.empty(0), INSTANTS))


def test_a_node_that_is_the_worst_in_one_revolution_alone_is_found():
    """Node 1 answers the second coordinate alone, which moves in one revolution; the last revolution does not know of it."""
    operator = np.zeros((6, 2, 2))
    operator[0, 0, 0], operator[3, 1, 1] = 1.0, 1.0
    states = np.zeros((3 * 3, 2))
    states[:, 0], states[4] = 1.0, (1.5, 2.0)
    found = largest_of_revolutions(StressOperator(operator, 2, ""), states, np.eye(2), np.empty(0), 3)
    np.testing.assert_allclose(found, [1.0, np.sqrt(3.0) * 2.0, 1.0], rtol=1e-6)


def test_a_region_without_elements_is_refused_before_any_simulation(model, steel):
    """Each simulation reads this operator, so that its job comes before theirs."""
    nothing = replace(model, stress_elements={}, stress_region="x < 0.15 m")
    with pytest.raises(ValueError, match=r"the stress submesh \(x < 0\.15 m\) has no elements; enlarge structure\.stress_subm"):
        stress_operator(nothing, steel)


def test_the_operator_survives_its_file(stress, tmp_path):
    write_stress_operator(stress, tmp_path / "stress.npz")
    again = read_stress_operator(tmp_path / "stress.npz")
    np.testing.assert_array_equal(again.operator, stress.operator)
    assert (again.coordinates, again.region) == (stress.coordinates, stress.region)


def test_the_statistic_of_known_revolutions():
    found = stress_statistic(np.arange(1.0, 12.0), 9.0)
    assert found == {
        "max_von_mises_ever": 11.0, "max_von_mises_median": 6.0, "max_von_mises_high": 10.0,
        "share_of_revolutions_above_yield": pytest.approx(2 / 11),
    }  # fmt: skip
    assert all(np.isnan(value) for value in stress_statistic(np.array([1.0, np.nan]), 9.0).values())
    assert stress_statistic(np.ones(3), np.inf)["share_of_revolutions_above_yield"] == 0.0
