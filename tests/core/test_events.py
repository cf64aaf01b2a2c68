"""Events of a run: when it leaves the model, by which cause, and whether yield is passed before that."""

from dataclasses import replace

import numpy as np
import pytest
from box_operator import box_operator
from integration_cases import DIRECT
from quadratic_cases import CHOICE

from r37core.results.events import Danger, exit_of, yield_events
from r37core.results.limits import Cause
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.speed_run import numbers_of_run

YIELD, SPEED, REVOLUTIONS = 1.0, 2.0 * np.pi, 40


def made_up(stress=(), heat=0.0, heights=(), force=(), bounded=(), diverged=np.nan, **numbers):
    """Arrays of a run of one region, a second a revolution, with what it has from some revolutions on."""
    history, motion = np.full((1, REVOLUTIONS), 0.5), np.full(REVOLUTIONS, 0.01)
    so_far = {name: np.zeros(REVOLUTIONS) for name in ("force_so_far", "bounded_so_far")}
    for revolution in stress:
        history[0, revolution - 1] = 1.5
    for revolution in heights:
        motion[revolution - 1] = 0.2
    for revolution in force:
        so_far["force_so_far"][revolution - 1 :] = 1e6
    for revolution in bounded:
        so_far["bounded_so_far"][revolution - 1 :] = 1.0
    heated = heat * np.arange(1.0, REVOLUTIONS + 1)
    return {
        "status": np.array(int(np.isfinite(diverged))),
        "speed": np.array(SPEED),
        "diverged_revolution": np.array(diverged),
        "revolution_von_mises": history,
        "revolution_maximum": np.zeros((REVOLUTIONS, 2)),
        "statistic_end": np.array(REVOLUTIONS),
        "revolution_share_of_height": motion,
        "peak_share_of_height": motion.max(),
        "share_of_height_limit": np.array(0.1),
        "largest_normal_force": so_far["force_so_far"][-1],
        "bounded_share_of_time": so_far["bounded_so_far"][-1],
        "energy_residual_share": np.array(0.0),
        "friction_power": np.array(heat),
        "friction_heat": heated[-1],
        "heat_so_far": heated,
        "melting_power": np.array(100.0),
        **so_far,
        **numbers,
    }


@pytest.mark.parametrize(
    ("run", "left", "cause", "danger", "inside"),
    [
        (made_up(), np.nan, Cause.NONE, Danger.BELOW, 0.5),
        (made_up(stress=[7]), np.nan, Cause.NONE, Danger.DANGEROUS, 1.5),
        (made_up(stress=[7], heights=[9]), 9, Cause.HEIGHT, Danger.DANGEROUS, 1.5),
        (made_up(stress=[9], heights=[7]), 7, Cause.HEIGHT, Danger.UNKNOWN, 0.5),
        # in one revolution nobody knows which came first
        (made_up(stress=[7], heights=[7]), 7, Cause.HEIGHT, Danger.UNKNOWN, 0.5),
        (made_up(heights=[7]), 7, Cause.HEIGHT, Danger.UNKNOWN, 0.5),
        (made_up(stress=[30], force=[20]), 20, Cause.FORCE, Danger.UNKNOWN, 0.5),
        (made_up(stress=[3], bounded=[5], heights=[6]), 5, Cause.ENERGY, Danger.DANGEROUS, 1.5),
        (made_up(stress=[3], energy_residual_share=np.array(0.5)), 1, Cause.ENERGY, Danger.UNKNOWN, 0.0),
        # 99 J a revolution are less than 100 W, and 100 J in the second one
        (made_up(stress=[1], heat=99.0), 2, Cause.HEAT, Danger.DANGEROUS, 1.5),
        (made_up(stress=[2], heat=101.0), 1, Cause.HEAT, Danger.UNKNOWN, 0.0),
        # one that diverges passes every limit, if it has not left the model before
        (made_up(diverged=12.5), np.nan, Cause.NONE, Danger.DANGEROUS, 0.5),
        (made_up(diverged=12.5, heights=[11]), 11, Cause.HEIGHT, Danger.UNKNOWN, 0.5),
    ],
)
def test_what_comes_before_the_exit_counts(run, left, cause, danger, inside):
    exits = exit_of(run)
    np.testing.assert_array_equal(exits["exit_revolution"], left)
    assert exits["exit_cause"] == cause
    events = yield_events(run, YIELD, float(exits["exit_revolution"]))
    assert events["yield_danger"].tolist() == [danger]
    assert events["max_von_mises_inside"].tolist() == [inside]


def test_revolutions_above_yield_are_counted_from_the_first_on():
    events = yield_events(made_up(stress=[3, 4, 39]), YIELD, np.nan)
    assert (events["first_yield_revolution"].tolist(), events["revolutions_above_yield"].tolist()) == ([3.0], [3])


def test_every_revolution_has_its_largest_stress(contact, model, steel):
    """Of the states of all revolutions, recovered node by node."""
    stress = {"box": box_operator(model, steel)}
    choice = replace(CHOICE, revolutions=6, snapshots_per_revolution=31).recorded
    run = Simulation(contact, 1340.0, DIRECT, choice).run()
    kept = numbers_of_run(run, ("stress",), stress=stress, spectrum_highest_order=1, wear_angles=8)
    coordinates = run.records[0].snapshots @ (run.problem.model.to_reduced @ run.problem.contact.state_shapes).T
    slow = stress["box"].max_von_mises(coordinates).reshape(6, 31).max(axis=1)
    np.testing.assert_allclose(kept["revolution_von_mises"][0], slow, rtol=1e-5)
    assert len(kept["heat_so_far"]) == 6 and kept["heat_so_far"][-1] == kept["friction_heat"]
    assert np.all(np.diff(kept["force_so_far"]) >= 0.0) and kept["force_so_far"][-1] == kept["largest_normal_force"]
