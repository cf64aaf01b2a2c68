"""A measurement's file (CSV): what its columns are, by their units, and the points that they give."""

import re
from collections.abc import Mapping
from math import pi
from pathlib import Path

import numpy as np
import pandas as pd

from r37core.base.units import LENGTH_UNITS, RAD_S
from r37core.config import ConfigError
from r37core.config.declaring import si_fields
from r37studies.measured.csv_cells import read_cells

from .points import STRAIN, TIP_TIMING, VALUES, WORN_DEPTH, Points, feature_speed
from .section import ASKED, MeasurementError, MeasurementSection

MOST_SPEEDS = 60
"""Speeds of a measurement that are run; of more, those spread evenly over the curve and its largest value."""

_LARGEST_ORDER, _LEAST_SHARE = 24, 0.1
"""Engine orders of a time signal that are fitted, and the least share of the largest amplitude that counts."""

_SPEED, _ANGLE, _TIME, _LENGTH, _STRAIN = "speed", "angle", "time", "length", "strain"
_UNITS = {
    _SPEED: RAD_S | {"rad_s": 1.0, "1/min": RAD_S["rpm"], "hz": 2.0 * pi, "1/s": 2.0 * pi},
    _ANGLE: {"deg": pi / 180.0, "rad": 1.0},
    _TIME: {"s": 1.0, "ms": 1e-3},
    _LENGTH: LENGTH_UNITS | {"mil": 2.54e-5},
    _STRAIN: {"strain": 1.0, "m/m": 1.0, "um/m": 1e-6, "microstrain": 1e-6, "ue": 1e-6},
}
_UNCERTAINTY = re.compile(r"uncertainty|sigma|std|deviation|error|(?<![a-z])sd(?![a-z])", re.IGNORECASE)


def _columns(cells: pd.DataFrame) -> dict[str, tuple[str, float]]:
    """Title of each column -> the kind of quantity by its unit, "" without one, and what one of that is in the SI."""
    return {title: _kind(title) for title in cells}


def _header(cells: pd.DataFrame) -> str:
    kinds = {title: kind or "no number" for title, (kind, _) in _columns(cells).items()}
    kinds |= {title: "uncertainty" for title, (kind, _) in _columns(cells).items() if kind and _UNCERTAINTY.search(title)}
    return ", ".join(f"{title} ({kind})" for title, kind in kinds.items())


def _column(cells: pd.DataFrame, key: str, kind: str, title: str | None = None, *, uncertain: bool = False) -> str | None:
    """The column of this `title`, or the one that fits. Raises MeasurementError for none of the title, and for several."""
    columns = [each for each, (own, _) in _columns(cells).items() if own == kind]
    fitting = [each for each in columns if (each == title if title else bool(_UNCERTAINTY.search(each)) == uncertain)]
    if len(fitting) > 1 or (title and not fitting):
        problem = f"'{title}'" if title else f"{len(fitting)} columns with a {kind}"
        raise MeasurementError(key, f"found {problem}; allowed: one column with a {kind} of the header: {_header(cells)}")
    return fitting[0] if fitting else None


def _numbers(texts: pd.Series) -> np.ndarray:
    """Numbers of a column in SI units, NaN where a field is empty. Raises MeasurementError for a text."""
    numbers = pd.to_numeric(texts, errors="coerce")
    strange = texts[numbers.isna() & texts.notna()]
    if len(strange):
        place = f"found '{strange.iloc[0]}' under {texts.name}, in row {strange.index[0] + 1} below the header"
        raise MeasurementError("file", f"{place}; allowed: a number with a point")
    return _kind(str(texts.name))[1] * numbers.to_numpy(float)


def read_points(file: Path, entry: MeasurementSection) -> tuple[Points, tuple[float, ...]]:
    """Points of a file, and the speeds (rad/s) of its curve where one of these counts. Raises MeasurementError."""
    cells = _counting_rows(file, entry)
    kind = _STRAIN if entry.quantity == STRAIN else _LENGTH
    axes = {kind: _column(cells, "rows", kind) for kind in (_SPEED, _ANGLE, _TIME)}
    title = entry.value
    if title is None and entry.uncertainty in cells:
        # the other one, where a column is named that does not look like an uncertainty
        others = [each for each, (own, _) in _columns(cells).items() if own == kind and each != entry.uncertainty]
        title = others[0] if len(others) == 1 else None
    value = _column(cells, "value", kind, title) or (axes[_SPEED] if entry.speed_of != VALUES else None)
    if value is None:
        wanted = f"no column of {entry.quantity}, with a {kind} in {', '.join(_UNITS[kind])}"
        raise MeasurementError("value", f"{wanted}; the header is: {_header(cells)}")
    is_speed = _kind(value)[0] == _SPEED
    sigma = _column(cells, "uncertainty", _SPEED if is_speed else kind, entry.uncertainty, uncertain=True)
    columns = {name: column for name, column in {**axes, "value": value, "sigma": sigma}.items() if column}
    numbers = {name: _numbers(cells[column]) for name, column in columns.items()}
    known = np.isfinite([*numbers.values()]).all(axis=0)
    if not known.any():
        titles = ", ".join(columns.values())
        raise MeasurementError("file", f"found no row with all numbers in {titles}; allowed: one or more")
    numbers = {name: part[known] for name, part in numbers.items()}
    if _SPEED not in numbers:
        if (speed := si_fields(entry).get("speed")) is None:
            problem = f"found no column with a speed, in rad/s or rpm, among {_header(cells)}"
            raise MeasurementError("speed_rad_s", f"{problem}; allowed: this key")
        numbers[_SPEED] = np.full(len(numbers["value"]), speed)
    if (slow := numbers[_SPEED] <= 0.0).any():
        raise MeasurementError("file", f"found a speed of {numbers[_SPEED][slow][0]:g} rad/s; allowed: above 0")
    if _TIME in numbers:
        return _signal_amplitudes(numbers, entry), ()
    if (negative := numbers["value"] < 0.0).any():
        raise MeasurementError("value", f"found {value} {numbers['value'][negative][0]:g}; allowed: 0 or more")
    if is_speed:
        # one speed in place of a curve
        if known.sum() > 1:
            raise MeasurementError("rows", f"found {known.sum()} speeds of a {entry.speed_of}; allowed: one row, or a curve")
        return Points.collected(numbers[_SPEED], numbers[_SPEED], _deviations(numbers, entry), 0), ()
    if entry.quantity == WORN_DEPTH and _ANGLE in numbers:
        return _profile(numbers, entry), ()
    return _over_speeds(numbers, entry)


def _counting_rows(file: Path, entry: MeasurementSection) -> pd.DataFrame:
    """The rows of a file that count."""
    try:
        cells = read_cells(file)
    except ConfigError as error:
        raise MeasurementError("file", str(error)) from None
    if entry.value == ASKED:
        raise MeasurementError("value", f"the columns are: {_header(cells)}; name one, or leave the key out where one fits")
    for key in {"blade", "scene"} & {*cells} - {*entry.rows}:
        if others := {*cells[key].str.strip().dropna()} - {getattr(entry, key)}:
            problem = f"found rows of the {key} '{min(others)}'"
            raise MeasurementError("rows", f"{problem}; allowed: those of {getattr(entry, key)}, or rows: {{ {key}: name }}")
    for title, text in entry.rows.items():
        if title not in cells:
            raise MeasurementError("rows", f"found no column '{title}'; the header is: {_header(cells)}")
        cells = cells[cells[title].str.strip() == text]
    return cells


def _kind(title: str) -> tuple[str, float]:
    """Kind and factor of a column by its title: `speed (rpm)`, `speed [rpm]`, `speed_rpm` or `rpm`."""
    name = re.sub("[\u00b5\u03bc]", "u", title.lower())
    bracket = re.search(r"[(\[]\s*([^)\]]+?)\s*[)\]]\s*$", name)
    for kind, units in _UNITS.items():
        for unit, factor in units.items():
            if bracket[1] == unit if bracket else f"_{name}".endswith(f"_{unit}"):
                return kind, factor
    return "", 1.0


def _deviations(numbers: Mapping[str, np.ndarray], entry: MeasurementSection) -> np.ndarray:
    """Standard deviations: of a column, or a percentage of each value, of small ones of a tenth of the largest."""
    if "sigma" in numbers:
        if not np.all(numbers["sigma"] > 0.0):
            raise MeasurementError("uncertainty", f"found {numbers['sigma'].min():g}; allowed: above 0, a standard deviation")
        return numbers["sigma"]
    if entry.uncertainty_percent is None:
        raise MeasurementError("uncertainty_percent", "found neither it nor a column 'uncertainty'; allowed: one of them")
    values = np.abs(numbers["value"])
    if not values.any():
        raise MeasurementError("uncertainty_percent", "found values that are all 0; allowed: a column 'uncertainty' for them")
    return 0.01 * entry.uncertainty_percent * np.maximum(values, 0.1 * values.max())


def _over_speeds(numbers: Mapping[str, np.ndarray], entry: MeasurementSection) -> tuple[Points, tuple[float, ...]]:
    speeds, places, counts = np.unique(numbers[_SPEED], return_inverse=True, return_counts=True)
    # a speed that was measured several times has the mean of its values
    values = np.bincount(places, numbers["value"]) / counts
    deviations = np.sqrt(np.bincount(places, _deviations(numbers, entry) ** 2)) / counts
    kept = np.unique(np.append(np.linspace(0, len(speeds) - 1, min(MOST_SPEEDS, len(speeds))).astype(int), values.argmax()))
    speeds, values, deviations = speeds[kept], values[kept], deviations[kept]
    if entry.speed_of == VALUES:
        return Points.collected(speeds, values, deviations, entry.engine_order or 0), ()
    first = feature_speed(speeds, values, entry.limit)
    if not speeds[0] < first < speeds[-1]:
        largest = f"values from {values.min():g} to {values.max():g}"
        raise MeasurementError("limit", f"found {largest}; allowed: a {entry.speed_of} between the first speed and the last")
    width = float(np.diff(speeds)[max(int(np.searchsorted(speeds, first)) - 1, 0)])
    # anywhere between two speeds: a uniform distribution
    return Points.collected(first, first, width / np.sqrt(12.0), 0), tuple(speeds.tolist())


def _profile(numbers: Mapping[str, np.ndarray], entry: MeasurementSection) -> Points:
    """A profile round the casing at one speed, in sectors of a degree where it has more points."""
    speeds = np.unique(numbers[_SPEED])
    if len(speeds) > 1:
        raise MeasurementError("rows", f"found a profile over angles at {len(speeds)} speeds; allowed: one, chosen by rows")
    angles, is_dense = numbers[_ANGLE] % (2.0 * pi), len(numbers[_ANGLE]) > 360
    sectors = (angles * 180.0 / pi).astype(int) if is_dense else np.arange(len(angles))
    used, places, counts = np.unique(sectors, return_inverse=True, return_counts=True)
    values, deviations = (np.bincount(places, part) / counts for part in (numbers["value"], _deviations(numbers, entry)))
    # an angle in the middle of its sector: a mean would be wrong at 0
    middles = (used + 0.5) * pi / 180.0 if is_dense else angles
    return Points.collected(speeds, values, deviations, 0, angles=tuple(middles.tolist()))


def _signal_amplitudes(numbers: Mapping[str, np.ndarray], entry: MeasurementSection) -> Points:
    """Amplitudes of the engine orders of a time signal at one speed, by least squares, of those that stand out."""
    if entry.quantity in (WORN_DEPTH, TIP_TIMING):
        raise MeasurementError("file", f"found a column with times; allowed for {entry.quantity}: speeds or angles")
    times, values, speed = numbers[_TIME], numbers["value"], float(numbers[_SPEED].min())
    turns, steps = speed * (times - times.min()) / (2.0 * pi), np.diff(np.sort(times))
    if turns.max() < 2.0 or not steps.max() > 0.0:
        raise MeasurementError("file", f"found a time signal of {turns.max():.3g} revolutions; allowed: 2 or more")
    highest = min(_LARGEST_ORDER, int(pi / (speed * float(np.median(steps)))))
    waves = np.exp(2j * pi * np.arange(1, highest + 1) * turns[:, None])
    fitted = np.linalg.lstsq(np.column_stack([np.ones(len(turns)), waves.real, waves.imag]), values, rcond=None)[0]
    amplitudes = np.hypot(fitted[1 : highest + 1], fitted[highest + 1 :])
    orders = 1 + np.flatnonzero(amplitudes >= _LEAST_SHARE * amplitudes.max())
    kept = {"value": amplitudes[orders - 1]}
    if "sigma" in numbers:
        # of an amplitude from so many values
        kept["sigma"] = np.full(len(orders), float(np.sqrt(2.0 * np.mean(numbers["sigma"] ** 2) / len(times))))
    return Points.collected(speed, kept["value"], _deviations(kept, entry), orders)
