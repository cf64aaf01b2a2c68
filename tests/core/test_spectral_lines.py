"""Names of peaks on a bare casing: tones of known order, and spectra without any."""

import numpy as np
import pytest
import xarray as xr
from defaults import InteractionChoice

from r37core.results.interactions import find_interactions, titles
from r37core.results.spectral_lines import crossing_of, frequency_named, named_by_lines

CHOICE = InteractionChoice()
STEP = 0.01
ORDERS = STEP * np.arange(3001)
FREQUENCY = {"1B": 160.0, "1T": 410.0, "2B": 640.0, "4": 860.0, "5": 1073.0, "6": 1300.0, "7": 1537.0}
"""Frequencies (Hz) at rest; their squares rise by STIFFENING times the square of the speed."""
STIFFENING = 0.01
LOBES = 2


def campbell():
    speed = np.linspace(0.0, 1000.0, 21)
    values = np.sqrt(np.square(list(FREQUENCY.values()))[:, None] + STIFFENING * speed**2)
    return xr.Dataset({"frequency": (("mode", "speed"), values)}, {"mode": list(FREQUENCY), "speed": speed})


def at(speed, tones, lobes=LOBES, noise=1e-6):
    """One speed: tones (order -> m), tangential but for those above order 20, and noise below them."""
    amplitudes = noise * np.random.default_rng(1).rayleigh(size=(2, len(ORDERS)))
    for order, amplitude in tones.items():
        amplitudes[int(order <= 20.0), round(order / STEP)] = amplitude
    names = dict(zip(("amplitude", "amplitude_tangential"), amplitudes, strict=True))
    data = {name: ("engine_order", values) for name, values in names.items()} | {"casing_lobes": lobes}
    return xr.Dataset(data, {"engine_order": ORDERS, "speed": speed})


def named(speed, tones, **how):
    columns = named_by_lines(at(speed, tones, **how), campbell(), CHOICE)
    return (columns["mode"], columns["engine_order"]) if columns else None


def order_of(mode, speed, higher=0.0):
    """The order, on the spectrum's steps, of a mode's frequency that contact raises by a share."""
    frequency = float(frequency_named(campbell(), mode).interp(speed=speed))
    return round(2.0 * np.pi * (1.0 + higher) * frequency / speed / STEP) * STEP


def test_a_whole_order_at_a_mode_is_named_and_others_are_not():
    # 1B/2 at 529.5 rad/s, 1B/3 at 342.6; forced orders 4 and 6 are no mode's
    assert named(535.0, {2.0: 1e-3, 4.0: 6e-4, 6.0: 3e-4}) == ("1B", 2)
    # half way between two multiples of the lobes: the motion repeats after two lobes
    assert named(345.0, {2.0: 4e-4, 4.0: 3e-4, 3.0: 5e-4}) == ("1B", 3)
    assert named(700.0, {2.0: 1e-3, 4.0: 3e-4}) is None
    # forced: weaker than the next one below, or weak next to all
    assert named(535.0, {2.0: 1e-3, 4.0: 2e-3}) is None
    assert named(535.0, {2.0: 2e-4, 3.0: 1e-3}) is None
    assert named(535.0, {2.0: 1e-3}, lobes=0) is None


def test_a_spectrum_joined_with_longer_ones_has_its_own_orders():
    """A run of 100 revolutions beside one of 300: an axis of uneven steps, and no amplitude at the orders of the other."""
    union = np.union1d(ORDERS, np.round(np.arange(9001) / 300.0, 12))

    def joined(tones):
        spectrum = at(535.0, tones)
        amplitudes = spectrum[["amplitude", "amplitude_tangential"]].reindex(engine_order=union)
        return named_by_lines(amplitudes.assign(casing_lobes=LOBES), campbell(), CHOICE)

    assert joined({2.0: 1e-3, 4.0: 6e-4, 6.0: 3e-4})["mode"] == "1B"
    assert joined({}) == {}


@pytest.mark.parametrize("apart", [6, 5.5, 5, 6.5])
def test_two_tones_a_multiple_of_the_lobes_apart_are_a_difference(apart):
    """Modes 5 and 7, 1073 and 1537 Hz, at orders a and a + 6; at no other distance, where their sum is off, too."""
    speed, low = 478.0, 14.27
    assert order_of("5", speed) < low < order_of("5", speed, CHOICE.above)
    found = named_by_lines(at(speed, {2.0: 4e-4, low: 1e-3, low + apart: 3e-4}), campbell(), CHOICE)
    if apart != 6:
        assert not found
        return
    assert (found["mode"], found["engine_order"]) == ("7-5", 6)
    # closed form: (f7 - f5)(s) = 6 s / 2 pi
    stiffening = STIFFENING * found["campbell_speed_rad_s"] ** 2
    difference = np.sqrt(FREQUENCY["7"] ** 2 + stiffening) - np.sqrt(FREQUENCY["5"] ** 2 + stiffening)
    assert found["campbell_speed_rad_s"] == pytest.approx(2.0 * np.pi * difference / 6.0, rel=1e-6)
    # three lobes reach six too, four do not
    assert [named(speed, {low: 1e-3, low + 6.0: 3e-4}, lobes=lobes) for lobes in (3, 4)] == [("7-5", 6), None]


def test_two_tones_that_add_up_are_a_sum():
    speed = 2.0 * np.pi * (FREQUENCY["5"] + FREQUENCY["4"]) / 24.0
    low = order_of("4", speed, 0.01)
    assert named(speed, {low: 1e-3, 24.0 - low: 5e-4}) == ("4+5", 24)
    assert named(speed, {low: 1e-3, 24.0 - low + 0.04: 5e-4}) is None
    assert crossing_of(campbell(), "4+5", 24) == pytest.approx(speed, rel=2e-3)
    assert np.isnan(crossing_of(campbell(), "4+5", 1))


def test_of_sum_and_difference_the_sum_counts_unless_the_other_line_is_twice_as_strong():
    """At 372 rad/s modes 6 and 7 meet order 48 with their sum and order 4 with their difference."""
    tones = {22.3: 1e-3, 22.3 + 4.0: 3e-4}
    assert named(372.0, tones | {48.0 - 22.3: 2e-4}) == ("6+7", 48)
    assert named(372.0, tones | {48.0 - 22.3: 1.2e-4}) == ("7-6", 4)


def test_a_motion_that_repeats_after_three_or_four_lobes_is_no_combination():
    for low in (14.67, 14.5):
        assert named(478.0, {low: 1e-3, low + 6.0: 3e-4}) is None
        assert named(478.0, {low + 0.05: 1e-3, low + 6.05: 3e-4}) == ("7-5", 6)


def test_broadband_spectra_have_no_name():
    """Rayleigh amplitudes, as of a random motion; and with a tone at a mode that belongs to no order and no other tone."""
    speeds = np.linspace(300.0, 900.0, 200)
    rng = np.random.default_rng(7)
    for speed in speeds:
        random = at(speed, {})
        random["amplitude"] = ("engine_order", 1e-3 * rng.rayleigh(size=len(ORDERS)))
        assert not named_by_lines(random, campbell(), CHOICE)
    assert named(478.0, {14.27: 1e-3}) is None


def test_a_row_of_a_bare_casing_has_the_name_and_a_length_that_two_speeds_show_is_not_resolved():
    """A peak of 4 rad/s at 478 rad/s, on grids of 2 and of 15 rad/s."""

    def found(step):
        speeds = np.arange(478.0 - 10 * step, 478.0 + 10 * step, step)
        peak = np.exp(-(((speeds - 478.0) / 3.0) ** 2))
        runs = [at(speed, {14.27: 1e-3, 20.27: 4e-4}) for speed in speeds]
        data = xr.concat(runs, "speed").assign(casing_lobes=LOBES, lined=0, yield_stress=1e9)
        values = {f"rms_{name}": 1e-4 * (1.0 + peak) for name in ("normal", "tangential")}
        values |= {f"max_von_mises_{name}": 5.02e8 * (1.0 + peak) for name in ("median", "high", "ever", "inside")}
        values |= {
            "share_of_revolutions_above_yield": (peak > 0.99).astype(float),
            "exit_revolution": np.full(len(speeds), np.nan),
            "status": np.zeros(len(speeds), "i1"),
        }
        return find_interactions(data.assign({name: ("speed", each) for name, each in values.items()}), campbell(), CHOICE)

    for step, note in ((15.0, "not resolved: one or two speeds show the peak, 15 rad/s apart"), (1.0, "")):
        (row,) = found(step)
        assert titles([row]) == {478.0: "7-5/6"} and row["note"] == note
        assert row["shift_rad_s"] == pytest.approx(478.0 - crossing_of(campbell(), "7-5", 6))
