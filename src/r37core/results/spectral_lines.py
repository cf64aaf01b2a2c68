"""Interactions of a bare casing, named by lines of the spectrum: a mode at a whole order, or a combination of two modes."""

import re
from typing import Any

import numpy as np
import scipy
from xarray import DataArray, Dataset

from r37core.base.peaks import prominent_peaks

from .campbell import crossing_speed, frequency_at_order
from .interaction_choice import InteractionChoice

STRONGEST, STRONG = 0.25, 0.1
"""Shares of the largest amplitude from which a line at a mode gives a name, and from which a second one joins it."""

CLEAR = 10.0
"""Amplitude of a line over the median within half an order about it: a broadband spectrum reaches 4."""


def modes_of(name: str) -> tuple[str, ...]:
    """Modes of a name: one, or two of a combination. 7-5 is the difference of the frequencies, 5+7 their sum."""
    return tuple(re.split("[+-]", name))


def frequency_named(campbell: Dataset, name: str, order: int | None = None) -> DataArray:
    """Frequency (Hz) over speed of a mode or combination (modes_of) in a Campbell diagram; `order`: see frequency_at_order."""
    first, *second = (frequency_at_order(campbell, mode, order) for mode in modes_of(name))
    return (first + second[0] if "+" in name else abs(first - second[0])) if second else first


def crossing_of(campbell: Dataset, name: str, order: int) -> float:
    """Speed (rad/s) at which a blade's mode or combination (modes_of) crosses an engine order; NaN where none is known."""
    frequency = frequency_named(campbell, name, order)
    return crossing_speed(frequency["speed"].values, frequency.values, order)


def named_by_lines(response: Dataset, campbell: Dataset, choice: InteractionChoice) -> dict[str, Any]:
    """Columns `mode`, `engine_order` and `campbell_speed_rad_s` of a `response` at one speed; empty where nothing has a name.

    The strongest line at a mode decides. At a whole order its mode is the name. Else it is a combination with the strongest
    line of another mode whose order differs from it by a multiple of the lobes, or adds up to one: a casing of so many lobes
    couples these frequencies (Floquet). The speed lies about the crossing of what is named, of a combination within `above`.
    """
    lobes = int(response.get("casing_lobes", 0))
    if not lobes or "amplitude" not in response:
        return {}
    # spectra of several lengths are joined on the orders of all
    response = response.isel(engine_order=np.flatnonzero(np.isfinite(response["amplitude"].values)))
    if response.sizes["engine_order"] < 2:
        return {}
    per_order = round(1.0 / float(np.diff(response["engine_order"].values[:2])[0]))
    lines = _lines_at_modes(response, campbell, per_order, lobes, choice)
    if not lines or lines[0][0] < STRONGEST:
        return {}
    (_, index, mode), *others = lines
    whole = _is_multiple(index, per_order)
    names = [(1.0, mode, index)] if whole else _combinations(index, mode, others, lobes * per_order)
    for _, name, place in sorted(names, reverse=True):
        speed, order = float(response["speed"]), round(place / per_order)
        crossing = crossing_of(campbell, name, order)
        below = choice.below if whole else choice.above
        if -below * crossing <= speed - crossing <= choice.above * crossing:
            return {"mode": name, "engine_order": order, "campbell_speed_rad_s": crossing}
    return {}


def _combinations(index: int, mode: str, others: list[tuple[float, int, str]], period: int) -> list[tuple[float, str, int]]:
    """Combinations of a line with other modes' lines: strength, name, and difference or sum of the indices, in whole `period`s.

    None of a line that repeats after three or four lobes, as a motion of one mode alone can. A sum goes before a difference
    that is not twice as strong: symmetric coupling makes sums alone unstable (Nayfeh and Mook, Nonlinear Oscillations).
    """
    if any(_is_multiple(lobes * index, period) for lobes in (3, 4)):
        return []
    combinations = []
    for share, other, second in others:
        (low, lower), (high, higher) = sorted([(index, mode), (other, second)])
        pair = [(2.0 * share, f"{lower}+{higher}", low + high), (share, f"{higher}-{lower}", high - low)]
        combinations += [each for each in pair if second != mode and _is_multiple(each[2], period)]
    return combinations


def _is_multiple(index: int, base: int) -> bool:
    """True within 1 of a multiple: each of two lines is known to half a step of the spectrum."""
    return (index + 1) % base <= 2


def _lines_at_modes(
    response: Dataset, campbell: Dataset, per_order: int, lobes: int, choice: InteractionChoice
) -> list[tuple[float, int, str]]:
    """Lines of a spectrum that modes amplify, the strongest first: share of the largest amplitude, index, and mode.

    The mode is the nearest within the limits of the `choice`, here of the frequency. A line that a mode amplifies is at least
    as strong as those one number of lobes below and above it. `per_order`: steps of the spectrum in an engine order.
    """
    order, speed = response["engine_order"].values, float(response["speed"])
    amplitude = np.nan_to_num(np.hypot(response["amplitude"].values, response["amplitude_tangential"].values))
    amplitude[order < 0.5] = 0.0
    padded = np.pad(amplitude, lobes * per_order)
    neighbours = np.maximum(padded[: len(amplitude)], padded[-len(amplitude) :])
    strong = amplitude >= np.maximum(STRONG * amplitude.max(), CLEAR * scipy.ndimage.median_filter(amplitude, per_order))
    frequency = campbell["frequency"].interp(speed=speed)
    lines = []
    for index in prominent_peaks(np.where(strong & (amplitude >= neighbours), amplitude, 0.0)).tolist():
        distance = order[index] * speed / (2.0 * np.pi * frequency.values) - 1.0
        distance = np.where((distance >= -choice.below) & (distance <= choice.above), np.abs(distance), np.inf)
        if np.isfinite(distance.min()):
            lines.append((float(amplitude[index] / amplitude.max()), index, str(frequency["mode"].values[distance.argmin()])))
    return sorted(lines, reverse=True)
