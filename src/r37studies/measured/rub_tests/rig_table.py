"""Table of a rub rig: forces of a tool that presses an abradable lining, over depth."""

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from r37core.config import ConfigError
from r37core.config.messages import did_you_mean, single_line
from r37studies.measured.csv_cells import LENGTHS, read_cells

_NEEDED, _FORCE_UNITS = ("depth", "force", "thickness", "width"), {"n": 1.0, "kn": 1e3, "lbf": 4.4482216}
_UNITS = dict.fromkeys(_NEEDED, LENGTHS) | dict.fromkeys(("force", "uncertainty"), _FORCE_UNITS)
_UNITS |= {"speed": {"m_s": 1.0}, "test": {"": 1.0}}
"""Quantity of a column -> unit at the end of the column's name -> what one of it is in the SI."""


_FALLS = -0.2
"""Correlation of forces with depths below which they fall."""


def read_rub_test(table: Path | str | Mapping[str, Any], constant: Mapping[str, float]) -> pd.DataFrame:
    """Points in SI units: `depth` (m), the `deepest` (m) at its place until then, `force` (N), `thickness` and `width` (m).

    `place`: name of the test. Also `speed` (m/s) and `uncertainty` (N), where the `table`, a CSV file or columns by name, has
    them. `constant`: thickness and width that all points have. Raises ConfigError, with points counted from 1.
    """
    file = Path(table) if isinstance(table, Path | str) else None
    try:
        return _points(read_cells(file) if file else pd.DataFrame(table), constant)
    except ValueError as error:
        remedy = "" if isinstance(error, ConfigError) else "; allowed: columns of one length"
        raise ConfigError(f"{file or 'table'}: {error}{remedy}") from None


def _points(cells: pd.DataFrame, constant: Mapping[str, float]) -> pd.DataFrame:
    points, columns = pd.DataFrame(dict(constant), index=range(len(cells))), _columns([*cells.columns], constant)
    # without a column of tests each point is a first contact
    has_tests = "test" in columns
    tests = cells[columns.pop("test")[0]].astype(str).to_numpy() if has_tests else np.arange(len(cells))
    for quantity, (title, factor) in columns.items():
        points[quantity] = factor * pd.to_numeric(cells[title], errors="coerce").to_numpy(float)
        impossible = ~np.isfinite(points[quantity]) | ((points[quantity] <= 0.0) & (quantity not in ("depth", "force")))
        _refuse(impossible, cells[title], "a number, more than 0 but for depth and force")
    points["deepest"] = points.depth.groupby(tests).cummax()
    points["place"] = tests if has_tests else "all"
    _refuse(points.depth > points.thickness, points.depth, "at most the thickness of the lining, in m")
    pressed = points.force[points.depth > 0.0]
    if len(pressed) < 2 or not pressed.mean() > 0.0:
        numbers = f"{len(pressed)} points with a depth above 0 and a mean force of {pressed.mean():g} N"
        raise ConfigError(f"found {numbers}; allowed: two or more, with forces that are positive while the tool presses")
    if np.corrcoef(points.depth, points.force)[0, 1] < _FALLS:
        raise ConfigError(
            "found forces that fall with depth while the tool goes in; allowed: forces that grow, with depths from the "
            "lining's surface on, and a column test where the tool returns"
        )
    return points


def _refuse(refused: pd.Series, cells: pd.Series, allowed: str) -> None:
    if refused.any():
        row = int(np.argmax(refused))
        raise ConfigError(f"point {row + 1}: {cells.name}: found {single_line(str(cells.iloc[row]))}; allowed: {allowed}")


def _columns(header: list[str], constant: Mapping[str, float]) -> dict[str, tuple[str, float]]:
    """Quantity -> title of its column, and the factor to SI units. Raises ConfigError with the whole header."""
    columns: dict[str, tuple[str, float]] = {}
    problems = []
    for title in header:
        quantity, _, unit = re.sub(r"\W+", "_", re.sub("[µμ]", "u", str(title).lower())).strip("_").partition("_")
        if quantity not in _UNITS:
            # a rig records more than a fit needs, but a misspelt column must not be left out in silence
            problems += [f"{title}{likely}" for likely in [did_you_mean(quantity, _UNITS)] if likely]
        elif unit not in _UNITS[quantity] or quantity in columns or quantity in constant:
            problems.append(f"{title}, {'given twice' if unit in _UNITS[quantity] else 'without a known unit'}")
        else:
            columns[quantity] = (title, _UNITS[quantity][unit])
    problems = problems or [f"no {name}" for name in _NEEDED if name not in columns and name not in constant]
    if problems:
        units = "; ".join(f"{name} {', '.join(units)}".strip() for name, units in _UNITS.items())
        place = f"in the header '{single_line(', '.join(map(str, header)))}'"
        raise ConfigError(f"found {', '.join(problems)} {place}; allowed: {units}; thickness_m and width_m as arguments")
    return columns
