"""A measurement's file (CSV): what its columns are, by their units, and the points that they give."""

import re
from collections.abc import Mapping, Set
from dataclasses import replace
from math import pi
from pathlib import Path

import numpy as np
import pandas as pd

from r37core.base.units import RAD_S
from r37core.config import ConfigError
from r37core.config.declaring import si_fields
from r37studies.measured.csv_cells import LENGTHS, read_cells

from .points import STRAIN, TIP_TIMING, VALUES, WORN_DEPTH, Points, feature_speed
from .section import ASKED, PHASOR, MeasurementError, MeasurementSection
from .time_signals import MOST_SPEEDS, OrderAmplitudes, order_amplitudes, passages, spectrum_amplitudes, sweep_legs, turned

_LARGEST = 1e30
_HERTZ = 2.0 * pi

_SPEED, _ANGLE, _TIME, _LENGTH, _STRAIN, _TURNS = "speed", "angle", "time", "length", "strain", "turns"
_UNITS = {
    _SPEED: RAD_S
    | dict.fromkeys(("rad_s", "rad/sec", "rad s-1"), 1.0)
    | dict.fromkeys(("1/min", "min-1", "u/min", "r/min", "rev/min", "tr/min"), RAD_S["rpm"])
    | dict.fromkeys(("hz", "1/s", "s-1"), _HERTZ)
    | {"krpm": 1e3 * RAD_S["rpm"], "khz": 1e3 * _HERTZ},
    _ANGLE: dict.fromkeys(("deg", "degree", "degrees", "\N{DEGREE SIGN}"), pi / 180.0) | {"rad": 1.0},
    _TIME: dict.fromkeys(("s", "sec", "seconds"), 1.0) | {"ms": 1e-3, "us": 1e-6},
    _LENGTH: LENGTHS,
    _STRAIN: {"strain": 1.0, "m/m": 1.0, "mm/m": 1e-3} | dict.fromkeys(("um/m", "microstrain", "ustrain", "ue", "ppm"), 1e-6),
}
_ROTOR = re.compile(r"speed|rot|rev|shaft|drehz|omega|(?<![a-z])n\d?(?![a-z])", re.IGNORECASE)
"""Titles in Hz that are of a speed, not of a frequency of vibration."""
_LETTERS = str.maketrans({"\u00b5": "u", "\u03bc": "u", "\u03b5": "e", "\u00b7": " ", "^": ""})
"""Micro, both signs of it, and epsilon of a unit, as its Latin letters; signs that a unit may lack."""
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
    if kind == _SPEED and len(fitting) > 1:
        # beside a speed of the rotor Hz are those of the vibration
        fitting = [each for each in fitting if not _is_frequency(each)]
    if len(fitting) > 1 or (title and not fitting):
        problem = f"'{title}'" if title else f"{len(fitting)} columns with a {kind}"
        raise MeasurementError(key, f"found {problem}; allowed: one column with a {kind} of the header: {_header(cells)}")
    return fitting[0] if fitting else None


def _numbers(texts: pd.Series) -> np.ndarray:
    """Numbers of a column in SI units, NaN where a field is empty. Raises MeasurementError for a text."""
    numbers = pd.to_numeric(texts, errors="coerce")
    strange = texts[~(numbers.abs() <= _LARGEST) & texts.notna()]
    if len(strange):
        place = f"found '{strange.iloc[0]}' under {texts.name}, in row {strange.index[0] + 1} below the header"
        raise MeasurementError("file", f"{place}; allowed: a number with a point")
    return _kind(str(texts.name))[1] * numbers.to_numpy(float)


def read_points(file: Path, entry: MeasurementSection) -> tuple[Points, tuple[float, ...]]:
    """Points of a file, and the speeds (rad/s) of its curve where one of these counts. Raises MeasurementError."""
    cells = _counting_rows(file, entry)
    kind = _STRAIN if entry.quantity == STRAIN else _LENGTH
    named = {str(each): column for each, column in entry.columns.items()}
    axes = {each: _column(cells, "columns", each, named.get(each)) for each in (_SPEED, _ANGLE, _TIME)}
    if (pulses := named.get(PHASOR)) is not None and pulses not in cells:
        raise MeasurementError("columns", f"found no column '{pulses}'; the header is: {_header(cells)}")
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
    constant_speed, speed_title = si_fields(entry).get("speed"), axes[_SPEED]
    is_spectrum = bool(
        speed_title
        and not (is_speed or named.get(_SPEED))
        and _is_frequency(speed_title)
        and (constant_speed or not _ROTOR.search(speed_title))
    )
    if is_spectrum and constant_speed is None:
        raise MeasurementError(
            "speed_rad_s", f"found frequencies, {speed_title}, and no speed; allowed: this key, or columns: {{ speed: ... }}"
        )
    if speed_title and constant_speed and not is_spectrum:
        raise MeasurementError(
            "speed_rad_s", f"found it beside the column {speed_title}; allowed: one of them, or rows of the file that count"
        )
    if axes[_TIME] is axes[_ANGLE] is None and not is_spectrum:
        _refuse_unread(cells, speed_title, {*entry.rows, value, sigma})
    columns = {name: column for name, column in {**axes, PHASOR: pulses, "value": value, "sigma": sigma}.items() if column}
    numbers = {name: _numbers(cells[column]) for name, column in columns.items()}
    known = np.isfinite([*numbers.values()]).all(axis=0)
    if not known.any():
        titles = ", ".join(columns.values())
        raise MeasurementError("file", f"found no row with all numbers in {titles}; allowed: one or more")
    numbers = {name: part[known] for name, part in numbers.items()}
    points, speeds = _points(numbers, entry, constant_speed, is_spectrum=is_spectrum, is_speed=is_speed)
    dropped = f"{(~known).sum()} rows without all numbers left out" if not known.all() else ""
    return replace(points, remark="; ".join(filter(None, [points.remark, dropped]))), speeds


def _points(
    numbers: dict[str, np.ndarray],
    entry: MeasurementSection,
    constant_speed: float | None,
    *,
    is_spectrum: bool,
    is_speed: bool,
) -> tuple[Points, tuple[float, ...]]:
    """Points of the columns, by what they are: a spectrum, a time signal, one speed, a profile or a curve."""
    count = len(numbers["value"])
    if is_spectrum:
        assert constant_speed is not None
        lines = spectrum_amplitudes(numbers[_SPEED], numbers["value"], constant_speed, entry.engine_order)
        return _order_points(lines, numbers, entry), ()
    if _TIME in numbers:
        order = np.argsort(numbers[_TIME], kind="stable")
        numbers = {name: part[order] for name, part in numbers.items()}
        if not (np.diff(numbers[_TIME]) > 0.0).all():
            raise MeasurementError("rows", "found a time that stands in several rows; allowed: each once, or rows that count")
    if PHASOR in numbers:
        if _TIME not in numbers:
            raise MeasurementError("columns", f"found a {PHASOR} and no column of times; allowed: both")
        marks = passages(numbers[_TIME], numbers[PHASOR])
        inside = (numbers[_TIME] >= marks[0]) & (numbers[_TIME] <= marks[-1])
        numbers = {name: part[inside] for name, part in numbers.items()}
        numbers[_TURNS] = np.interp(numbers[_TIME], marks, np.arange(len(marks)))
        numbers[_SPEED] = np.interp(numbers[_TIME], 0.5 * (marks[1:] + marks[:-1]), 2.0 * pi / np.diff(marks))
    elif _SPEED not in numbers:
        if constant_speed is None:
            raise MeasurementError("speed_rad_s", "found no column with a speed, in rad/s or rpm; allowed: this key")
        numbers[_SPEED] = np.full(count, constant_speed)
    if (slow := numbers[_SPEED] <= 0.0).any():
        raise MeasurementError("file", f"found a speed of {numbers[_SPEED][slow][0]:g} rad/s; allowed: above 0")
    steps, legs = _turns_of_rows(numbers), sweep_legs(numbers[_SPEED])
    is_signal = steps is not None and np.median(steps) <= 0.5
    ways = [way for way, _ in legs]
    # a speed that wavers during a signal is no sweep
    if len(legs) > 2 and not is_signal:
        raise MeasurementError("rows", f"found sweeps {', '.join(ways[:5])}; allowed: one, or one up and one down: their rows")
    if len(legs) == 2:
        if entry.sweep is None:
            raise MeasurementError("sweep", "found a sweep up and one down; allowed: up or down, each a measurement of its own")
        leg = legs[ways.index(entry.sweep)][1]
        numbers = {name: part[leg] for name, part in numbers.items()}
    if is_signal:
        return _signal(numbers.get(_TURNS, turned(numbers[_TIME], numbers[_SPEED])), numbers, entry), ()
    if steps is not None and np.ptp(numbers[_SPEED]) < 0.01 * numbers[_SPEED].max():
        rows = f"{1.0 / np.median(steps):.3g} rows a revolution at one speed"
        raise MeasurementError("file", f"found times with {rows}; allowed: 2 or more, in their unit, or amplitudes over speeds")
    if (negative := numbers["value"] < 0.0).any():
        raise MeasurementError("value", f"found {entry.quantity} {numbers['value'][negative][0]:g}; allowed: 0 or more")
    if is_speed:
        # one speed in place of a curve
        if count > 1:
            raise MeasurementError("rows", f"found {count} speeds of a {entry.speed_of}; allowed: one row, or a curve")
        return Points.collected(numbers[_SPEED], numbers[_SPEED], _deviations(numbers, entry), 0), ()
    if entry.quantity == WORN_DEPTH and _ANGLE in numbers:
        return _profile(numbers, entry), ()
    return _over_speeds(numbers, entry)


def _turns_of_rows(numbers: Mapping[str, np.ndarray]) -> np.ndarray | None:
    """Revolutions from each row to the next one, of rows with times."""
    if _TIME not in numbers or len(numbers[_TIME]) < 2:
        return None
    return np.diff(numbers.get(_TURNS, turned(numbers[_TIME], numbers[_SPEED])))


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


def _refuse_unread(cells: pd.DataFrame, speed: str | None, read: Set[str | None]) -> None:
    """Refuse rows of one speed that differ in what is not read: a gauge, a frequency, an unknown unit."""
    groups = cells.groupby(speed) if speed else [("", cells)]
    for title in {*cells} - read - {speed}:
        is_unread = _kind(title)[0] == "" or _is_frequency(title)
        if is_unread and any(rows[title].nunique() > 1 for _, rows in groups):
            problem = f"found rows of one speed that differ in '{title}', which is not read"
            units = ", ".join(_UNITS[_SPEED] | _UNITS[_ANGLE] | _UNITS[_TIME])
            raise MeasurementError("rows", f"{problem}; allowed: rows: {{ {title}: ... }}, or one of the units {units}")


def _is_frequency(title: str) -> bool:
    return _kind(title) in ((_SPEED, _HERTZ), (_SPEED, 1e3 * _HERTZ))


def _kind(title: str) -> tuple[str, float]:
    """Kind and factor of a column by its title: `speed (rpm)`, `speed [rpm]`, `speed_rpm` or `rpm`."""
    name = title.lower().translate(_LETTERS)
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


def _signal(turns: np.ndarray, numbers: Mapping[str, np.ndarray], entry: MeasurementSection) -> Points:
    """Amplitudes of the engine orders of a time signal; while the speed changes, of each speed."""
    if entry.quantity in (WORN_DEPTH, TIP_TIMING):
        raise MeasurementError("file", f"found a time signal; allowed for {entry.quantity}: speeds or angles")
    tracked = order_amplitudes(turns, numbers[_SPEED], numbers["value"], entry.engine_order)
    return _order_points(tracked, numbers, entry)


def _order_points(tracked: OrderAmplitudes, numbers: Mapping[str, np.ndarray], entry: MeasurementSection) -> Points:
    amplitudes = {"value": tracked.amplitudes.ravel()}
    if "sigma" in numbers:
        # of an amplitude from so many values
        deviation = np.sqrt(2.0 * np.mean(numbers["sigma"] ** 2) / tracked.samples)
        amplitudes["sigma"] = np.repeat(deviation, len(tracked.orders))
    speeds, orders = (part.ravel() for part in np.meshgrid(tracked.speeds, tracked.orders, indexing="ij"))
    return Points.collected(speeds, amplitudes["value"], _deviations(amplitudes, entry), orders, remark=tracked.remark)
