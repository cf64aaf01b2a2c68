"""Calibration: draws, surrogates and rounds against models whose answer is known."""

import numpy as np
import pytest

from r37core.base.varied_number import SCENE, VariedNumber
from r37core.config.spread import SpreadEntry
from r37core.sweep.driver import one_by_one
from r37studies.measured.calibration import Calibration
from r37studies.measured.points import Measurement, Points
from r37studies.measured.posterior import calibration_dataset, notes, number_table
from r37studies.measured.sampling import draws

pytest.importorskip("sklearn")

LENGTH, FRICTION = VariedNumber(SCENE, "lining.contact_length_m"), VariedNumber(SCENE, "friction.coefficient")
SPREADS = {LENGTH: SpreadEntry(log_between=[1e-4, 1e-2]), FRICTION: SpreadEntry(between=[0.0, 0.5])}
SPEEDS = tuple(np.linspace(100.0, 200.0, 8))


def peak(length, friction):
    """A resonance whose place is the length's and whose height is the friction's."""
    middle = 150.0 + 20.0 * np.log10(length / 1e-3)
    return (1.0 + 4.0 * friction) / (1.0 + ((np.array(SPEEDS) - middle) / 15.0) ** 2)


def product(length, friction):
    """Depends on the product of both numbers alone."""
    return 1e3 * length * (0.1 + friction) * np.ones(len(SPEEDS))


def calibrated(model, measured, runs=28, deviation=0.05):
    values = tuple(np.asarray(measured, dtype=float))
    points = Points(SPEEDS, values, tuple(deviation * np.array(values)), (0,) * len(SPEEDS))
    measurement = Measurement("tip.csv", "A", "s", "displacement_normal", points)
    calibration = Calibration({"m0": measurement}, SPREADS, (1e-3, 0.15), 0, lambda calls, what="": one_by_one(calls))

    def simulate(designs):
        return [{"m0": model(values[LENGTH], values[FRICTION])} for values in designs.values()]

    told = []
    calibration.run([12, *[4] * ((runs - 12) // 4)], simulate, told.append)
    return calibration_dataset(calibration, 64), told


def test_draws_of_normal_distributions_have_their_means_and_widths():
    middle, width = np.array([0.3, 0.7]), np.array([0.004, 0.05])
    cube, _ = draws(lambda cube: -0.5 * (((cube - middle) / width) ** 2).sum(axis=1), 2, 1024, 0)
    np.testing.assert_allclose(cube.mean(axis=0), middle, atol=0.2 * width.max())
    np.testing.assert_allclose(cube.std(axis=0), width, rtol=0.12)


def test_draws_of_two_branches_have_both():
    both = lambda cube: np.logaddexp(*(-0.5 * (((cube - at) / 0.03) ** 2).sum(axis=1) for at in (0.2, 0.8)))  # noqa: E731
    cube, _ = draws(both, 2, 1024, 1)
    assert 0.35 < (cube[:, 0] < 0.5).mean() < 0.65


@pytest.mark.slow
def test_hidden_values_are_within_their_ranges():
    rng = np.random.default_rng(3)
    dataset, told = calibrated(peak, peak(2e-3, 0.2) * (1.0 + 0.05 * rng.standard_normal(8)))
    table = number_table(dataset).set_index("number")
    for number, hidden in ((LENGTH, 2e-3), (FRICTION, 0.2)):
        row = table.loc[number.name]
        assert row["low_95"] < hidden < row["high_95"] and row["width_share"] < 0.4
        assert row["low_95"] < row["low_68"] < row["median"] < row["high_68"] < row["high_95"]
    assert not dataset.attrs["disagrees"]
    assert told[0] == "calibrate: round 0, 12 designs" and told[-1].endswith("of 8 points within 2 sigma")


@pytest.mark.slow
def test_numbers_of_which_only_the_product_counts_are_told_together():
    dataset, _ = calibrated(product, product(1e-3, 0.2))
    assert any("identifiable only together with scene.friction.coefficient" in note for note in notes(dataset, LENGTH.name))
    assert dataset["correlation"].values[0, 1] < -0.7


@pytest.mark.slow
def test_a_point_on_another_branch_is_named_and_moves_nothing():
    """And a number that changes nothing is not told."""
    measured = peak(1e-3, 0.2)
    measured[2] *= 4.0
    dataset, _ = calibrated(lambda length, friction: peak(length, 0.2), measured)
    assert notes(dataset, FRICTION.name) == ["not identifiable by these measurements"]
    assert np.flatnonzero(dataset["elsewhere"] > 0.5).tolist() == [2]
    row = number_table(dataset).set_index("number").loc[LENGTH.name]
    assert row["low_95"] < 1e-3 < row["high_95"]


@pytest.mark.slow
def test_measurements_that_no_values_give_disagree():
    dataset, _ = calibrated(peak, 3.0 - 2.0 * peak(1e-3, 0.1) / peak(1e-3, 0.1).max())
    assert dataset.attrs["disagrees"]
