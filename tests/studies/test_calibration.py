"""Calibration: draws, surrogates and rounds against models whose answer is known."""

import numpy as np
import pytest
import yaml
from conftest import CONFIGURATION

from r37core.base.varied_number import SCENE, VariedNumber
from r37core.config import Document
from r37core.config.scenes import SceneEntry
from r37core.config.spread import SpreadEntry
from r37core.product.extensions import load_settings
from r37core.sweep.driver import one_by_one
from r37studies.measured.calibration import Calibration
from r37studies.measured.model_check import FAR, one_sided
from r37studies.measured.points import Measurement, Points
from r37studies.measured.posterior import calibrated_scenes, calibration_dataset, is_range, notes, number_table
from r37studies.measured.sampling import draws

pytest.importorskip("sklearn")

LENGTH, FRICTION = VariedNumber(SCENE, "lining.contact_length_m"), VariedNumber(SCENE, "friction.coefficient")
DAMPING = VariedNumber(SCENE, "damping_ratio")
SPREADS = {LENGTH: SpreadEntry(log_between=[1e-4, 1e-2]), FRICTION: SpreadEntry(between=[0.0, 0.5])}
SPEEDS = tuple(np.linspace(100.0, 200.0, 8))


def peak(length, friction, speeds=SPEEDS):
    """A resonance whose place is the length's and whose height is the friction's."""
    middle = 150.0 + 20.0 * np.log10(length / 1e-3)
    return (1.0 + 4.0 * friction) / (1.0 + ((np.array(speeds) - middle) / 15.0) ** 2)


def configured():
    """Settings of a run of Ref."""
    content = {"blades": ["Ref"], "scenes": ["material_abradable"], "speeds": [1000.0], "fidelity": "draft"}
    return load_settings(Document("config.yaml", content), CONFIGURATION.parent)


def product(length, friction):
    """Depends on the product of both numbers alone."""
    return 1e3 * length * (0.1 + friction) * np.ones(len(SPEEDS))


def calibrated(model, measured, runs=28, deviation=0.05, speeds=SPEEDS, gain=None, second=FRICTION):
    values = tuple(np.asarray(measured, dtype=float))
    points = Points(tuple(speeds), values, tuple(deviation * np.array(values)), (0,) * len(speeds))
    measurement = Measurement("tip.csv", "A", "s", "displacement_normal", points)
    spreads = {LENGTH: SPREADS[LENGTH], second: SPREADS[FRICTION]} | ({VariedNumber("gain", "m0.gain"): gain} if gain else {})
    nominal = (1e-3, 0.15, 1.0)[: len(spreads)]
    calibration = Calibration({"m0": measurement}, spreads, nominal, 0, lambda calls, what="": one_by_one(calls))

    def simulate(designs):
        return [{"m0": model(values[LENGTH], values[second])} for values in designs.values()]

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
    assert not dataset.attrs["doubts"]
    assert told[0] == "calibrate: round 0, 12 designs" and told[-1].endswith("of 8 points within 2 sigma")


@pytest.mark.slow
def test_numbers_of_which_only_the_product_counts_are_told_together():
    dataset, _ = calibrated(product, product(1e-3, 0.2))
    assert any("identifiable only together with scene.friction.coefficient" in note for note in notes(dataset, LENGTH.name))
    assert dataset["correlation"].values[0, 1] < -0.7


@pytest.mark.slow
def test_one_point_that_no_run_reaches_is_named_and_makes_no_model_wrong():
    """And a number that changes nothing is not told."""
    measured = peak(1e-3, 0.2)
    measured[2] *= 4.0
    dataset, _ = calibrated(lambda length, friction: peak(length, 0.2), measured)
    assert notes(dataset, FRICTION.name) == ["not identifiable by these measurements"]
    assert np.flatnonzero(np.abs(dataset["misfit"]) > FAR).tolist() == [2] and not dataset["elsewhere"].any()
    assert not dataset.attrs["doubts"]
    row = number_table(dataset).set_index("number").loc[LENGTH.name]
    assert row["low_95"] < 1e-3 < row["high_95"]


@pytest.mark.slow
@pytest.mark.parametrize("jumps", [1, 4])
def test_points_are_on_another_branch_where_runs_at_the_same_numbers_reach_them(jumps):
    """Of 16 points a tenth at most: of more it is the model."""
    count, speeds = 0, np.linspace(100.0, 200.0, 16)

    def jumping(length, friction):
        nonlocal count
        count += 1
        values = peak(length, friction, speeds)
        # the other branch in every fourth run, of points that were measured there and of others
        values[[*range(4, 4 + jumps), *range(10, 10 + jumps)]] *= 2.0 if count % 4 == 0 else 1.0
        return values

    measured = peak(1e-3, 0.2, speeds)
    measured[4 : 4 + jumps] *= 2.0
    dataset, _ = calibrated(jumping, measured, 20, speeds=speeds)
    assert np.flatnonzero(dataset["elsewhere"] > 0.5).tolist() in ([[4], [10]] if jumps == 1 else [[]])
    assert bool(dataset.attrs["doubts"]) == (jumps == 4)


@pytest.mark.slow
def test_measurements_that_no_values_give_are_doubted():
    dataset, _ = calibrated(peak, 3.0 - 2.0 * peak(1e-3, 0.1) / peak(1e-3, 0.1).max())
    assert "of right models would fit better" in dataset.attrs["doubts"]


@pytest.mark.slow
@pytest.mark.parametrize("gain", [None, SpreadEntry(normal=0.3)])
def test_differences_of_one_sign_are_doubted_and_a_gain_takes_them(gain):
    """They are within the uncertainties, which are overstated."""
    dataset, _ = calibrated(lambda length, friction: peak(length, 0.2), 1.25 * peak(1e-3, 0.2), deviation=0.25, gain=gain)
    if gain is None:
        assert dataset.attrs["doubts"].startswith("measured is larger than simulated over 100 to 200 rad/s")
    else:
        assert not dataset.attrs["doubts"]
        row = number_table(dataset).set_index("number").loc["m0.gain"]
        assert row["low_95"] < 1.25 < row["high_95"] and row["best"] == pytest.approx(1.25, abs=0.2)


@pytest.mark.parametrize(
    "differences, chance, stretch",
    [
        ([1.0] * 8, (0.0, 0.02), range(8)),
        ([1.0, -1.0] * 4, (0.9, 1.0), None),
        ([0.2, -0.3, 2.0, 1.8, 2.1, 1.9, 2.2, 1.7, -0.1, 0.3, -0.2, 0.1], (0.0, 0.1), range(2, 8)),
    ],
)
def test_the_most_one_sided_stretch_has_the_chance_of_random_signs(differences, chance, stretch):
    found, places = one_sided(np.array(differences), [np.arange(len(differences))])
    assert chance[0] <= found <= chance[1]
    assert stretch is None or places.tolist() == list(stretch)


@pytest.mark.slow
def test_a_damping_that_is_not_told_goes_on_as_a_range():
    dataset, _ = calibrated(lambda length, friction: peak(length, 0.2), peak(1e-3, 0.2), second=DAMPING)
    assert is_range(dataset, DAMPING) and not is_range(dataset, LENGTH)
    (entry,) = yaml.safe_load(calibrated_scenes(configured(), dataset, ["material_abradable"])).values()
    (row,) = entry["damping_ratio"]
    assert row["mode"] == 0 and row["lowest"] < 0.05 < row["highest"] and row["lowest"] <= row["ratio"] <= row["highest"]
    # a file of scenes takes it
    SceneEntry(**entry)


def test_a_measured_zero_counts():
    points = Points(SPEEDS, (0.0,) * 8, (1e-6,) * 8, (0,) * 8)
    measurement = Measurement("tip.csv", "A", "s", "worn_depth", points)
    calibration = Calibration({"m0": measurement}, SPREADS, (1e-3, 0.15), 0, one_by_one)
    calibration.cube, calibration.simulated = [(0.5, 0.5)], [calibration.scaled(np.full(8, 1e-4))]
    assert (calibration.differences < -3.0).all()
