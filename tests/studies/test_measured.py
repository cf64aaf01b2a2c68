"""Measurements: files, what a run says at their points, and the comparison."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import yaml
from conftest import CONFIGURATION
from refusal_tables import pattern_of, refusal_rows

from r37core.config import ConfigError, Document
from r37core.product.extensions import load_settings
from r37core.stress.gauge import Gauge
from r37studies.agreement import disagreements, disagrees, groups, words
from r37studies.measured.file import MOST_SPEEDS, read_points
from r37studies.measured.measurement_plan import Measured
from r37studies.measured.observed import statistic
from r37studies.measured.points import Measurement, Points, feature_speed, turned_profile
from r37studies.measured.section import MeasurementError, MeasurementSection
from r37studies.measured.steps import compared

READING = MeasurementSection(file="f", blade="A", scene="s", quantity="displacement_normal", uncertainty_percent=5)
TABLE = Path(__file__).with_name("refusals.txt")


def reading(**keys):
    return READING.model_copy(update=keys)


WORN = reading(quantity="worn_depth", speed_rad_s=1200.0)


@pytest.fixture
def read(tmp_path):
    def points(text, entry=READING):
        (tmp_path / "file.csv").write_text(text, encoding="utf-8")
        return read_points(tmp_path / "file.csv", entry)[0]

    return points


@pytest.mark.parametrize(
    "header, speed, value",
    [
        ("speed_rad_s,amplitude_m", 1000.0, 2e-3),
        ("n (rpm),a (mm)", 1000.0 * np.pi / 30, 2.0),
        ("rpm,amplitude_\u00b5m", 1000.0 * np.pi / 30, 2000.0),
        ("rotation_hz,tip_mil", 2000.0 * np.pi, 2e-3 / 2.54e-5),
    ],
)
def test_a_column_has_the_unit_of_its_name(read, header, speed, value):
    points = read(f"# a test\n{header}\n1000,{value!r}\n")
    assert (*points.speeds, *points.values, *points.deviations) == pytest.approx((speed, 2e-3, 1e-4))


def test_rows_without_a_number_are_left_out_and_speeds_ascend(read):
    points = read("speed_rpm;a_mm;uncertainty_mm\n3000;2;0.2\n2000;;0.1\n1000;1;0.1\n")
    assert points.values == (1e-3, 2e-3) and points.deviations == (1e-4, 2e-4)
    assert points.speeds == pytest.approx((1000 * np.pi / 30, 3000 * np.pi / 30))
    assert points.remark == "1 rows without all numbers left out"


def test_a_long_file_has_rows_that_are_chosen_and_a_wide_one_columns(read):
    long = "blade,speed_rad_s,a_m\nA,1,1\nB,1,2\nB,2,4\n"
    assert read(long, reading(rows={"blade": "B"})).values == (2.0, 4.0)
    wide = "speed_rad_s,a_m,b_m\n1,1,3\n"
    assert read(wide, reading(value="b_m")).values == (3.0,)
    with pytest.raises(MeasurementError, match=r"2 columns with a length; .*a_m \(length\), b_m") as refused:
        read(wide)
    assert refused.value.key == "value"
    with pytest.raises(MeasurementError, match=r"the columns are: speed_rad_s \(speed\), a_m \(length\), b_m \(length\)"):
        read(wide, reading(value="?"))


@pytest.mark.parametrize("title, named", [("sd (um)", None), ("spread_um", "spread_um")])
def test_an_uncertainty_is_known_by_its_name_or_named(read, title, named):
    points = read(f"speed_rpm,amplitude (um),{title}\n1000,5,2\n", READING.model_copy(update={"uncertainty": named}))
    assert points.values == pytest.approx((5e-6,)) and points.deviations == pytest.approx((2e-6,))


def test_a_speed_that_was_measured_twice_has_the_mean(read):
    points = read("speed_rad_s,a_m\n1,1\n1,3\n2,5\n")
    assert points.values == (2.0, 5.0)
    np.testing.assert_allclose(points.deviations[0], np.hypot(0.05, 0.15) / 2)


def test_of_a_hundred_thousand_points_some_are_run_the_largest_among_them(read):
    speeds = np.linspace(1000, 2000, 100_001)
    values = 1.0 + 1.0 / (1.0 + (speeds - 1234.56) ** 2)
    points = read("speed_rad_s,a_m\n" + "".join(f"{a:.9g},{b:.9g}\n" for a, b in zip(speeds, values, strict=True)))
    assert len(points.values) <= MOST_SPEEDS + 1 and max(points.values) == pytest.approx(2.0)


@pytest.mark.parametrize(("kind", "snippet", "message"), refusal_rows(TABLE, "files of measurements"))
def test_a_file_that_fits_nothing_says_what_would(read, kind, snippet, message):
    entry, _, text = snippet.partition(" / ")
    with pytest.raises(MeasurementError, match=pattern_of(message)):
        read(text.replace(" / ", "\n") + "\n", reading(**yaml.safe_load(entry)))


def test_feature_speed_a_limit_lies_anywhere_between_two_speeds(read):
    text = "speed_rad_s,a_m\n100,1\n110,1\n120,3\n130,9\n"
    points = read(text, reading(speed_of="first_above", limit=2.0))
    assert points.values == (115.0,)
    np.testing.assert_allclose(points.deviations, 10.0 / np.sqrt(12.0))


@pytest.mark.parametrize(
    "values, limit, speed",
    [
        ([1, 2, 1, 1], 2.0, np.inf),
        ([3, 1, 1, 1], 2.0, 1.0),
        ([1, np.inf, 1, 1], 2.0, 2.0),
        ([1, 1, 2, 4], 3.0, 3.5),
        ([4, 3, 1, 1], None, 1.0),
        ([1, 3, 2, 1, 1], None, 2.0 + 1.0 / 6.0),
        ([1, 3, 3, 1], None, 2.5),
        ([1, 3, np.inf, 1], None, np.inf),
    ],
)
def test_feature_speed_of_a_curve(values, limit, speed):
    assert feature_speed(1.0 + np.arange(len(values)), np.array(values, float), limit) == pytest.approx(speed)


def test_a_time_signal_is_amplitudes_of_its_engine_orders(read):
    """Of a made-up signal of orders 3 and 7, with an offset."""
    times = np.arange(0, 0.2, 2e-4)
    signal = 5.0 + 0.4 * np.cos(3 * 1000 * times + 0.3) + 0.1 * np.sin(7 * 1000 * times)
    text = "time_s,a_mm\n" + "".join(f"{t:.6g},{v:.9g}\n" for t, v in zip(times, signal, strict=True))
    points = read(text, reading(speed_rad_s=1000.0))
    assert points.orders == (3, 7)
    np.testing.assert_allclose(points.values, [4e-4, 1e-4], rtol=1e-6)
    # an amplitude from so many values
    rows = zip(text.splitlines(), ["sigma_mm", *len(times) * ["0.2"]], strict=True)
    deviations = read("\n".join(map(",".join, rows)), reading(speed_rad_s=1000.0)).deviations
    np.testing.assert_allclose(deviations, 2e-4 * np.sqrt(2.0 / len(times)))


def signal_rows(angle, times, *more):
    """Rows of a made-up signal of orders 1 and 4, of 20 and 100 um."""
    values = 20.0 * np.cos(angle) + 100.0 * np.cos(4.0 * angle + 1.0)
    columns = zip(times, *more, values, strict=True)
    return "".join(",".join(f"{each:.9g}" for each in row) + "\n" for row in columns)


TIMES = np.arange(0.0, 0.6, 2e-4)
SPEEDS = {"steady": np.full(len(TIMES), 1089.0), "rising": 1089.0 * (1.0 + 0.05 * TIMES / TIMES[-1])}
NOISE = 1.0 + 1e-3 * np.random.default_rng(0).standard_normal(len(TIMES))


@pytest.mark.parametrize("kind, speeds", [("steady", 1), ("rising", 10)])
@pytest.mark.parametrize("angle_by", ["speed", "key phasor"])
def test_amplitudes_of_a_signal_survive_a_tachometers_noise_and_a_rising_speed(read, kind, speeds, angle_by):
    speed = SPEEDS[kind]
    angle = np.append(0.0, np.cumsum(0.5 * (speed[1:] + speed[:-1]) * np.diff(TIMES)))
    if angle_by == "speed":
        points = read("time_s,n_rad_s,tip_um\n" + signal_rows(angle, TIMES, speed * NOISE))
    else:
        pulses = np.exp(-(((angle - 1.0) % (2.0 * np.pi) - np.pi) ** 2) / 0.05)
        entry = reading(columns={"key_phasor": "pulse"})
        points = read("time_s,pulse,tip_um\n" + signal_rows(angle, TIMES, pulses), entry)
    amplitudes = np.array(points.values).reshape(-1, 2)
    assert points.orders[:2] == (1, 4) and len(amplitudes) == pytest.approx(speeds, abs=1)
    np.testing.assert_allclose(amplitudes, np.tile([2e-5, 1e-4], (len(amplitudes), 1)), rtol=0.01)
    assert min(points.speeds) == pytest.approx(1089.0, rel=0.005) and "coherence 1.00" in points.remark


# a speed that is 0.2% too high, and one of a fan
@pytest.mark.parametrize("speed, told", [(1091.2, "drift .* were 0.99[78]"), (1.0, "rows a revolution|revolutions")])
def test_a_signal_that_tells_nothing_says_what_would(read, speed, told):
    with pytest.raises(MeasurementError, match=told):
        read("time_s,tip_um\n" + signal_rows(1089.0 * TIMES, TIMES), reading(speed_rad_s=speed))


@pytest.mark.parametrize(
    "text, entry, speeds, values, orders",
    [
        # the log of an order tracker, Hz of the vibration beside rpm, a spectrum, and both ways of a sweep
        ("t_s,n_rpm,a_um\n0,9000,1\n2,9100,2\n4,9200,3\n", READING, (9000, 9100, 9200), (1, 2, 3), (0, 0, 0)),
        ("n_rpm,f (Hz),a_um\n9000,1387,300\n9100,1391,250\n", READING, (9000, 9100), (300, 250), (0, 0)),
        ("n_rpm,m_rpm,a_um\n1,9000,1\n", reading(columns={"speed": "m_rpm"}), (9000,), (1,), (0,)),
        ("f (Hz),a_um\n150,9\n300,40\n301,30\n420,90\n1200,2\n", reading(speed_rpm=9000), (9000, 9000), (9, 40), (1, 2)),
        ("n_rpm,a_um\n9,1\n10,2\n11,3\n10,4\n9,5\n", reading(sweep="up"), (9, 10, 11), (1, 2, 3), (0, 0, 0)),
        ("n_rpm,a_um\n9,1\n10,2\n11,3\n10,4\n9,5\n", reading(sweep="down"), (9, 10, 11), (5, 4, 3), (0, 0, 0)),
        ("speed (U/min),a (mils)\n9000,1\n", READING, (9000,), (25.4,), (0,)),
    ],
)
def test_what_a_file_is_follows_from_its_columns(read, text, entry, speeds, values, orders):
    points = read(text, entry)
    assert points.speeds == pytest.approx(tuple(np.pi / 30.0 * np.array(speeds)))
    assert points.values == pytest.approx(tuple(1e-6 * np.array(values))) and points.orders == orders


def test_a_profile_is_turned_to_where_it_fits_and_says_when_it_is_backwards(read):
    angles = np.arange(360.0)
    wear = 1e-4 * (1.0 + np.exp(-(((angles - 90.0) / 20.0) ** 2)) + 0.5 * np.exp(-(((angles - 200.0) / 8.0) ** 2)))
    rows = "".join(f"{(a - 50.0) % 360},{1e6 * wear[int(a)]:.6g}\n" for a in angles[::6])
    points = read(f"angle_deg,depth_um\n{rows}", WORN)
    profile, remark = turned_profile(wear, points)
    np.testing.assert_allclose(profile, points.values, rtol=0.05)
    assert remark == "turned by 50 degrees" or remark == "turned by 51 degrees"
    backwards = replace(points, angles=tuple(-np.array(points.angles) % (2.0 * np.pi)))
    assert "read backwards" in turned_profile(wear, backwards)[1]
    # clearly better: by more than half, and by more than 9
    middles = tuple((np.arange(4) + 0.5) * np.pi / 2.0)
    for last, deviation, is_backwards in ((0.0, 0.47, True), (0.0, 0.48, False), (1.3, 0.1, True), (1.5, 0.1, False)):
        four = Points.collected(1.0, [0.0, 3.0, 1.0, last], deviation, 0, angles=middles)
        profile, remark = turned_profile(np.array([0.0, 1.0, 3.0, 0.0]), four)
        assert profile == pytest.approx([1.0, 3.0, 0.0, 0.0]) and remark.startswith("turned by 90 degrees")
        assert ("read backwards" in remark) == is_backwards
    # many points are means of a degree
    many = read("angle_deg,depth_um\n" + "".join(f"{a / 100},{a % 100}\n" for a in range(36_000)), WORN)
    assert len(many.values) == 360
    np.testing.assert_allclose(many.values, 49.5e-6, rtol=0.02)


def test_a_statistic_is_that_of_its_name():
    turn = np.arange(400) / 100
    signal = 0.5 + 3.0 * np.cos(2.0 * np.pi * 4 * turn)
    measurement = Measurement("f", "A", "s", "displacement_normal", Points((), (), (), ()))
    assert statistic(signal, 100, measurement, 4) == pytest.approx(3.0)
    assert statistic(signal, 100, measurement, 5) == pytest.approx(0.0, abs=1e-12)
    assert statistic(signal, 100, measurement, 0) == pytest.approx(np.sqrt(0.25 + 4.5))
    assert statistic(signal, 100, replace(measurement, statistic="half_peak_to_peak"), 0) == pytest.approx(3.0, rel=5e-3)


def comparison(simulated, scatter=(0.0, 0.0, 0.0), error=0.0):
    points = Points((100.0, 200.0, 300.0), (1.0, 2.0, 4.0), (0.1, 0.1, 0.1), (0, 0, 0))
    measurement = Measurement("tip.csv", "A", "s", "displacement_normal", points)
    numbers = {"m0": {"values": simulated, "scatter": scatter, "remark": ""}}
    return compared({"m0": measurement}, numbers, {("A", "s"): error})


def test_a_difference_is_in_units_of_both_uncertainties():
    table = comparison([1.3, 2.0, 4.0], error=0.1)
    np.testing.assert_allclose(table["simulated_uncertainty"], [0.13, 0.2, 0.4])
    np.testing.assert_allclose(table["difference_over_uncertainty"], [0.3 / np.hypot(0.1, 0.13), 0.0, 0.0])
    by_chance = comparison([1.3, 2.0, 4.0], scatter=[0.2, 0.0, 0.0])
    assert by_chance["difference_over_uncertainty"][0] == pytest.approx(0.3 / np.hypot(0.1, 0.2))


def test_the_error_of_the_level_is_one_of_amplitudes():
    points = Points((1000.0,), (1000.0,), (2.0,), (0,))
    peak = Measurement("tip.csv", "A", "s", "displacement_normal", points, speed_of="peak", curve_speeds=(990.0, 1010.0))
    table = compared({"m0": peak}, {"m0": {"values": [1010.0], "scatter": [0.0], "remark": ""}}, {("A", "s"): 0.1})
    assert table["difference_over_uncertainty"].tolist() == [5.0]


def test_words_say_how_many_points_agree_and_where_others_lie():
    scattered = words(comparison([5.0, 2.0, 4.0], scatter=[3.0, 0.0, 0.0]))
    assert scattered == "3 of 3 points within 2 sigma, at 1 of them as the simulation scatters by chance"
    table = comparison([1.0, 4.0, None])
    assert words(table) == "1 of 3 points within 2 sigma; 200 rad/s: simulated 2 times measured; 300 rad/s: diverged"
    assert disagrees(table) and not disagrees(comparison([1.0, 2.0, 4.0]))
    note = "simulation disagrees with 1 measurement (measured.csv)"
    assert disagreements(pd.concat([table, comparison([1.0, 2.0, 4.0]).assign(blade="B")])) == {("A", "s"): note}
    assert [key for key, _ in groups(table)] == [("A", "s", "displacement_normal, rms", "tip.csv")]


def configured(folder, measured, text="speed_rad_s,a_m\n1000,1e-3\n1100,2e-3\n", **more):
    """Settings of a run of Ref with measurements, of which the file has this text."""
    (folder / "tip.csv").write_text(text)
    shared = {"file": str(folder / "tip.csv"), "blade": "Ref", "scene": "abradable", "quantity": "displacement_normal"}
    entries = [{**shared, "uncertainty_percent": 5, **entry} for entry in measured]
    scenes = sorted({entry["scene"] for entry in entries} - {"nowhere"})
    content = {"blades": ["Ref"], "scenes": scenes or ["abradable"], "speeds": [1000.0], "fidelity": "draft", **more}
    return load_settings(Document("config.yaml", content | {"measured": entries}), CONFIGURATION.parent)


def test_a_gauge_is_that_of_the_signals(tmp_path):
    gauge = {"chord": 0.5, "span": 0.3, "side": "pressure", "angle_deg": 90.0}
    text = "speed_rad_s,g_microstrain\n1000,200\n"
    strain = {"quantity": "strain", "gauge": gauge, "statistic": "half_peak_to_peak"}
    (measured,) = configured(tmp_path, [strain], text).made(Measured).all.values()
    assert measured.gauge == Gauge(0.5, 0.3, "pressure", np.pi / 2) and measured.points.values == pytest.approx((2e-4,))
    assert measured.unit == "1" and measured.title.startswith("strain at chord 0.5, span 0.3, pressure side")


@pytest.mark.parametrize(("kind", "entry", "message"), refusal_rows(TABLE, "measured"))
def test_a_measurement_that_fits_nothing_is_refused(tmp_path, kind, entry, message):
    with pytest.raises(ConfigError, match=pattern_of(message)):
        configured(tmp_path, [yaml.safe_load(entry)])


def test_rpm_taken_for_rad_s_are_refused(tmp_path):
    with pytest.raises(ConfigError, match=r"found 12000 rad/s in .*; allowed: up to 4000.*rpm in a column"):
        configured(tmp_path, [{}], "speed_rad_s,a_m\n12000,1e-3\n")


def test_speeds_are_checked_as_those_of_a_sweep(tmp_path):
    with pytest.raises(ConfigError, match=r"measured.0.file: found 0.01\d* rad/s, a revolution of .* steps"):
        configured(tmp_path, [{}], "speed_rpm,a_m\n0.1,1e-3\n")


def test_measurements_of_one_file_are_kept_apart(tmp_path):
    entries = [
        {"tip_point": point, "value": column} for point in ("leading_edge", "trailing_edge") for column in ("a_m", "b_m")
    ]
    text = "speed_rad_s,a_m,b_m\n1000,1e-3,2e-3\n1100,2e-3,3e-3\n"
    every = configured(tmp_path, entries, text).made(Measured).all
    numbers = {name: {"values": [1e-3, 2e-3], "scatter": [0.0, 0.0], "remark": ""} for name in every}
    table = compared(every, numbers, {("Ref", "abradable"): 0.0})
    assert [key[2] for key, _ in groups(table)] == [
        f"displacement_normal{place}, rms" for place in ("", " at the trailing edge") for _ in "ab"
    ]
    assert [len(rows) for _, rows in groups(table)] == [2, 2, 2, 2]


def test_a_speed_without_a_curve_is_compared_with_the_sweep_about_it(tmp_path):
    speeds = {"speeds": [{"start": 900, "stop": 1100, "step": 10}]}
    text = "peak_speed_rad_s,sigma_rad_s\n1000,2\n"
    (measured,) = configured(tmp_path, [{"speed_of": "peak"}], text, **speeds).made(Measured).all.values()
    assert measured.run_speeds == tuple(np.arange(960.0, 1041.0, 10.0)) and measured.unit == "rad s-1"
    assert measured.points.values == (1000.0,) and measured.points.deviations == (2.0,)
    curve = {speed: {"m0": np.array([1.0 / (1.0 + ((speed - 993.0) / 30.0) ** 2)])} for speed in measured.run_speeds}
    np.testing.assert_allclose(measured.simulated(curve, "m0")[0], 993.0, atol=0.3)
    with pytest.raises(ConfigError, match="peak with 1 of them; allowed: speeds of the sweep, 5 or more within 5% of 1000"):
        configured(tmp_path, [{"speed_of": "peak"}], text)


@pytest.mark.parametrize(("kind", "sections", "message"), refusal_rows(TABLE, "calibrations"))
def test_a_calibration_that_cannot_be_done_is_refused(tmp_path, kind, sections, message):
    with pytest.raises(ConfigError, match=pattern_of(message)):
        configured(tmp_path, **{"measured": [{}]} | yaml.safe_load(sections))
