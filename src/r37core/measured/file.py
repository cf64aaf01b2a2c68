"""A measurement's file (CSV): what its columns are, by their units, and the points that they give."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from math import pi
from pathlib import Path

import numpy as np
import pandas as pd

from r37core.config.messages import single_line

from .points import ORDER, STRAIN, TIP_TIMING, VALUES, WORN_DEPTH, Points, feature_speed

MOST_SPEEDS = 60
"""Speeds of a measurement that are run; of more, those spread evenly over the curve and its largest value."""

_LARGEST_ORDER, _LEAST_SHARE = 24, 0.1
"""Engine orders of a time signal that are fitted, and the least share of the largest amplitude that counts."""

_MOST_BYTES = 50_000_000
_SPEED, _ANGLE, _TIME, _LENGTH, _STRAIN = "speed", "angle", "time", "length", "strain"
_UNITS = {
    _SPEED: {"rad/s": 1.0, "rad_s": 1.0, "rpm": pi / 30.0, "1/min": pi / 30.0, "hz": 2.0 * pi, "1/s": 2.0 * pi},
    _ANGLE: {"deg": pi / 180.0, "rad": 1.0},
    _TIME: {"s": 1.0, "ms": 1e-3},
    _LENGTH: {"m": 1.0, "mm": 1e-3, "um": 1e-6, "\u00b5m": 1e-6, "\u03bcm": 1e-6, "in": 0.0254, "mil": 2.54e-5},
    _STRAIN: {"strain": 1.0, "m/m": 1.0, "um/m": 1e-6, "microstrain": 1e-6, "ue": 1e-6},
}
_UNCERTAINTY = re.compile(r"uncertainty|sigma|std|deviation|error", re.IGNORECASE)


class MeasurementError(ValueError):
    """A file of a measurement that cannot be used, for a reason that `key` of its entry is to blame for."""

    def __init__(self, key: str, text: str):
        super().__init__(text)
        self.key = key


@dataclass(frozen=True)
class _Column:
    """A column with numbers: its kind, and what one of its unit is in the SI."""

    name: str
    kind: str
    factor: float

    @property
    def is_uncertainty(self) -> bool:
        return _UNCERTAINTY.search(self.name) is not None


@dataclass(frozen=True)
class Reading:
    """How a file is read: keys of its entry. `value`, `uncertainty`: columns, "" for those by their units; `percent` (1).

    `speed` (rad/s): of a file without speeds, else NaN; `rows`: column -> text of the rows that count.
    """

    quantity: str
    statistic: str
    order: int
    value: str
    uncertainty: str
    percent: float | None
    speed: float
    rows: Mapping[str, str]
    speed_of: str = VALUES
    limit: float | None = None


def read_points(file: Path, reading: Reading, *, asked: bool = False) -> tuple[Points, tuple[float, ...]]:
    """Points of a measurement's file, and the speeds (rad/s) of its curve of which one speed counts. Raises MeasurementError.

    `asked`: whether the header is to be told.
    """
    table = _read(file)
    if asked:
        raise MeasurementError("value", f"the columns are: {_header(table)}; name one, or leave the key out where one fits")
    for name, text in reading.rows.items():
        if name not in table:
            raise MeasurementError("rows", f"found no column '{name}'; the header is: {_header(table)}")
        table = table[table[name].astype(str).str.strip() == text]
    columns = [column for name in table if (column := _column(str(name)))]
    if reading.speed_of != VALUES and not _fitting(columns, reading):
        return _single_speed(table, columns, reading), ()
    value = _value_column(table, columns, reading)
    sigma = _single(table, [each for each in columns if each.is_uncertainty], "uncertainty", reading.uncertainty, value.kind)
    axes = {kind: _axis(table, columns, kind) for kind in (_SPEED, _ANGLE, _TIME)}
    chosen: dict[str, _Column | None] = {**axes, "value": value, "sigma": sigma}
    numbers = {name: _numbers(table, column) for name, column in chosen.items() if column}
    known = np.all([np.isfinite(part) for part in numbers.values()], axis=0)
    if not known.any():
        raise MeasurementError("file", f"has no row with all numbers in {', '.join(_told(each) for each in columns)}")
    numbers = {name: part[known] for name, part in numbers.items()}
    if sigma is None and reading.percent is None:
        raise MeasurementError("uncertainty_percent", "found neither it nor a column 'uncertainty'; allowed: one of them")
    if _TIME in numbers:
        return _signal_amplitudes(numbers, reading), ()
    if _SPEED not in numbers:
        if not np.isfinite(reading.speed):
            raise MeasurementError("speed_rad_s", f"found no column with a speed, in rad/s or rpm, among {_header(table)}")
        numbers[_SPEED] = np.full(len(numbers["value"]), reading.speed)
    if (negative := np.flatnonzero(numbers["value"] < 0.0)).size:
        raise MeasurementError("value", f"found {value.name} {numbers['value'][negative[0]]:g}; allowed: 0 or more")
    if (slow := numbers[_SPEED] <= 0.0).any():
        raise MeasurementError("file", f"found a speed of {numbers[_SPEED][slow][0]:g} rad/s; allowed: above 0")
    if reading.quantity == WORN_DEPTH and _ANGLE in numbers:
        return _profile(numbers, reading), ()
    return _over_speeds(numbers, reading, int((~known).sum()))


def _read(file: Path) -> pd.DataFrame:
    try:
        if not file.is_file() or file.stat().st_size > _MOST_BYTES:
            raise ValueError(f"no file of at most {_MOST_BYTES // 1_000_000} MB is there")
        with open(file, encoding="utf-8-sig") as stream:
            header = next((line for line in stream if line.strip() and not line.startswith("#")), "")
        separator = max(",;\t", key=header.count)
        table = pd.read_csv(file, sep=separator, comment="#", skipinitialspace=True, encoding="utf-8-sig")
    except (OSError, ValueError) as error:
        # those of pandas are ValueErrors
        raise MeasurementError("file", f"{single_line(str(error))}; allowed: a CSV with a header") from None
    return table.rename(columns=lambda name: str(name).strip())


def _header(table: pd.DataFrame) -> str:
    return ", ".join(_told(_column(name) or _Column(name, "no number", 1.0)) for name in map(str, table.columns))


def _told(column: _Column) -> str:
    return f"{column.name} ({'uncertainty' if column.is_uncertainty else column.kind})"


def _column(name: str) -> _Column | None:
    """Column by its name: `speed (rpm)`, `speed [rpm]`, `speed_rpm` or `rpm`; None without a unit."""
    bracket = re.search(r"[(\[]\s*([^)\]]+?)\s*[)\]]\s*$", name)
    for kind, units in _UNITS.items():
        for unit, factor in units.items():
            if (bracket[1].lower() if bracket else name.lower()) == unit or (not bracket and name.lower().endswith(f"_{unit}")):
                return _Column(name, kind, factor)
    return None


def _fitting(columns: list[_Column], reading: Reading) -> list[_Column]:
    kind = _STRAIN if reading.quantity == STRAIN else _LENGTH
    return [column for column in columns if column.kind == kind and not column.is_uncertainty]


def _single_speed(table: pd.DataFrame, columns: list[_Column], reading: Reading) -> Points:
    """The one speed that a file has in place of a curve."""
    sigma = _single(table, [each for each in columns if each.is_uncertainty], "uncertainty", reading.uncertainty, _SPEED)
    column = _axis(table, columns, _SPEED)
    speeds = np.empty(0) if column is None else _numbers(table, column)
    if len(speeds) != 1 or not speeds[0] > 0.0:
        raise MeasurementError("rows", f"found {len(speeds)} speeds of a {reading.speed_of}; allowed: one row, or a curve")
    numbers = {"value": speeds} | ({} if sigma is None else {"sigma": _numbers(table, sigma)})
    return Points.collected(speeds, speeds, _deviations(numbers, reading))


def _value_column(table: pd.DataFrame, columns: list[_Column], reading: Reading) -> _Column:
    kind = _STRAIN if reading.quantity == STRAIN else _LENGTH
    column = _single(table, _fitting(columns, reading), "value", reading.value, kind)
    if column is None:
        units = ", ".join(_UNITS[kind])
        raise MeasurementError(
            "value", f"no column of {reading.quantity}, with a {kind} in {units}; the header is: {_header(table)}"
        )
    return column


def _single(table: pd.DataFrame, fitting: list[_Column], key: str, name: str, kind: str) -> _Column | None:
    """The column of this `name`, or the one that fits. Raises MeasurementError for none of the name, and for several."""
    if name:
        fitting = [column for column in fitting if column.name == name and column.kind == kind]
    if (name and not fitting) or len(fitting) > 1:
        named = f"'{name}'" if name else f"{len(fitting)} columns that it may be"
        raise MeasurementError(key, f"found {named}; allowed: a column with a {kind} of the header: {_header(table)}")
    return fitting[0] if fitting else None


def _axis(table: pd.DataFrame, columns: list[_Column], kind: str) -> _Column | None:
    fitting = [column for column in columns if column.kind == kind and not column.is_uncertainty]
    if len(fitting) > 1:
        raise MeasurementError(
            "rows", f"found {len(fitting)} columns with a {kind}; allowed: one; the header is: {_header(table)}"
        )
    return fitting[0] if fitting else None


def _numbers(table: pd.DataFrame, column: _Column) -> np.ndarray:
    """Numbers of a column in SI units, NaN where a field is empty. Raises MeasurementError for a text."""
    texts = table[column.name]
    numbers = pd.to_numeric(texts, errors="coerce").to_numpy(float)
    strange = np.flatnonzero(np.isnan(numbers) & texts.notna().to_numpy() & (texts.astype(str).str.strip() != "").to_numpy())
    if strange.size:
        row = int(strange[0])
        place = f"found '{texts.iloc[row]}' under {column.name}, in row {row + 1} below the header"
        raise MeasurementError("file", f"{place}; allowed: a number with a point")
    return column.factor * numbers


def _deviations(numbers: Mapping[str, np.ndarray], reading: Reading) -> np.ndarray:
    """Standard deviations: of a column, or a percentage of each value, of small ones of a tenth of the largest."""
    if "sigma" in numbers:
        if not np.all(numbers["sigma"] > 0.0):
            raise MeasurementError("uncertainty", f"found {numbers['sigma'].min():g}; allowed: above 0, a standard deviation")
        return numbers["sigma"]
    assert reading.percent is not None
    values = np.abs(numbers["value"])
    largest = float(values.max())
    if largest == 0.0:
        raise MeasurementError("uncertainty_percent", "found values that are all 0; allowed: a column 'uncertainty' for them")
    return reading.percent * np.maximum(values, 0.1 * largest)


def _over_speeds(numbers: Mapping[str, np.ndarray], reading: Reading, missing: int) -> tuple[Points, tuple[float, ...]]:
    order = np.argsort(numbers[_SPEED], kind="stable")
    speeds, values, deviations = (part[order] for part in (numbers[_SPEED], numbers["value"], _deviations(numbers, reading)))
    is_new = np.append(True, np.diff(speeds) > 0.0)
    if not is_new.all():
        # a speed that was measured several times has the mean of its values
        groups, counts = np.cumsum(is_new) - 1, np.bincount(np.cumsum(is_new) - 1)
        values = np.bincount(groups, values) / counts
        deviations = np.sqrt(np.bincount(groups, deviations**2)) / counts
        speeds = speeds[is_new]
    kept = np.unique(np.append(np.linspace(0, len(speeds) - 1, min(MOST_SPEEDS, len(speeds))).astype(int), values.argmax()))
    speeds, values, deviations = speeds[kept], values[kept], deviations[kept]
    dropped = missing + len(order) - len(kept)
    if reading.speed_of != VALUES:
        first = feature_speed(speeds, values, reading.limit)
        if not speeds[0] < first < speeds[-1]:
            largest = f"values from {values.min():g} to {values.max():g}"
            raise MeasurementError(
                "limit", f"found {largest}; allowed: a {reading.speed_of} between the first speed and the last"
            )
        width = float(np.diff(speeds)[max(int(np.searchsorted(speeds, first)) - 1, 0)])
        # anywhere between two speeds: a uniform distribution
        point = Points.collected(np.array(first), np.array([first]), np.array(width / np.sqrt(12.0)), dropped=dropped)
        return point, tuple(speeds.tolist())
    order_of_all = np.array(reading.order if reading.statistic == ORDER else 0)
    return Points.collected(speeds, values, deviations, order_of_all, dropped=dropped), ()


def _profile(numbers: Mapping[str, np.ndarray], reading: Reading) -> Points:
    """A profile round the casing at one speed, in sectors of a degree where it has more points."""
    speeds = np.unique(numbers[_SPEED])
    if len(speeds) > 1:
        raise MeasurementError("rows", f"found a profile over angles at {len(speeds)} speeds; allowed: one, chosen by rows")
    angles, values, deviations = numbers[_ANGLE] % (2.0 * pi), numbers["value"], _deviations(numbers, reading)
    sectors = (angles * 180.0 / pi).astype(int) if len(angles) > 360 else np.arange(len(angles))
    used, places, counts = np.unique(sectors, return_inverse=True, return_counts=True)
    means = [np.bincount(places, part) / counts for part in (values, deviations)]
    # an angle in the middle of its sector: a mean would be wrong at 0
    middles = (used + 0.5) * pi / 180.0 if len(angles) > 360 else angles
    return Points.collected(speeds, *means, angles=middles, dropped=len(angles) - len(used))


def _signal_amplitudes(numbers: Mapping[str, np.ndarray], reading: Reading) -> Points:
    """Amplitudes of the engine orders of a time signal at one speed, by least squares, of those that stand out."""
    if reading.quantity in (WORN_DEPTH, TIP_TIMING):
        raise MeasurementError("file", f"found a column with times; allowed for {reading.quantity}: speeds or angles")
    speed = float(np.unique(numbers[_SPEED])[0]) if _SPEED in numbers else reading.speed
    if not np.isfinite(speed):
        raise MeasurementError("speed_rad_s", "found no speed of the time signal; allowed: the speed at which it was recorded")
    times, values = numbers[_TIME], numbers["value"]
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
    return Points.collected(np.array(speed), kept["value"], _deviations(kept, reading), orders)
