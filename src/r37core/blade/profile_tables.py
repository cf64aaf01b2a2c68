"""Profile and stacking tables: reading them, and checking them before any work starts."""

import re
from collections import Counter
from collections.abc import Iterable, Sequence
from functools import lru_cache
from itertools import pairwise
from pathlib import Path

import numpy as np

from r37core.base.io import TextFileError, read_text
from r37core.base.table_text import table_rows
from r37core.base.units import si_name

from .profile import BladeShapeError, ProfileParameters

PROFILE_COLUMNS = {
    "span_percent": "span",
    "r_ic_cm": "inlet_radius",
    "r_oc_cm": "outlet_radius",
    "kappa_ic_deg": "inlet_angle",
    "kappa_tc_deg": "transition_angle",
    "kappa_oc_deg": "outlet_angle",
    "t_i_cm": "inlet_thickness",
    "t_m_cm": "maximum_thickness",
    "t_o_cm": "outlet_thickness",
    "z_mc_cm": "maximum_thickness_axial",
    "z_tc_cm": "transition_axial",
    "z_oc_cm": "outlet_axial",
}
"""Column of a profile table -> attribute of ProfileParameters."""

_NUMBER = re.compile(r"[-+]?(nan|inf|infinity|(\.[0-9]+|[0-9]+(\.[0-9]*)?)(e[-+]?[0-9]+)?)", re.IGNORECASE)

STACKING_COLUMNS = ("span_percent", "sweep_cm", "lean_deg")
"""Columns of a sweep and lean table."""


def read_profile_table(file: Path) -> list[ProfileParameters]:
    """Profiles of a CSV table, from hub to tip; the rows may run either way.

    Raises BladeShapeError for missing columns, unreadable numbers, spans out of order or not reaching 0 and 100%,
    impossible rows and profiles that cross; TextFileError for a file that is no UTF-8 text.
    """
    rows = number_rows(read_text(file), tuple(PROFILE_COLUMNS))
    profiles = [ProfileParameters(**{name: _si_cell(row, column) for column, name in PROFILE_COLUMNS.items()}) for row in rows]
    if len(profiles) > 1 and profiles[0].span > profiles[-1].span:
        profiles.reverse()
    if len(profiles) < 4:
        raise BladeShapeError(f"the table has {len(profiles)} profiles; the spline along the span needs at least 4")
    check_spans([p.span for p in profiles])
    for profile in profiles:
        profile.check()
    check_profile_order(profiles)
    return profiles


def stacking_table_rows(file: Path, blade: str) -> list[dict[str, float]]:
    """Rows of one blade, by STACKING_COLUMNS, from a sweep and lean CSV with a column `blade`; BladeShapeError without any."""
    rows = [row for row in number_rows(read_text(file), STACKING_COLUMNS, ("blade",)) if row["blade"] == blade]
    if not rows:
        raise BladeShapeError(f"no row of the table has '{blade}' in its column 'blade'")
    return [{column: float(row[column]) for column in STACKING_COLUMNS} for row in rows]


def read_designs(file: Path, kind: str) -> dict[str, dict[str, float]]:
    """Designs of a CSV table: values by name and key, in the units of the keys.

    `kind`: column of the names, blade or scene. Raises BladeShapeError for missing columns, unreadable numbers and a name given
    twice; TextFileError as for others.
    """
    rows = number_rows(read_text(file), None, (kind,))
    if not rows or len(rows[0]) < 2:
        raise BladeShapeError(
            f"the table has no designs; it needs the column {kind}, one more for each key, and a row for each {kind}"
        )
    twice = [name for name, times in Counter(row[kind] for row in rows).items() if times > 1]
    if twice:
        raise BladeShapeError(f"the {kind} '{twice[0]}' is given twice")
    return {row[kind]: {key: value for key, value in row.items() if key != kind} for row in rows}


def stacking_rows(rows: Sequence[dict]) -> tuple[tuple[float, float, float], ...]:
    """Sweep and lean rows (keys as in STACKING_COLUMNS) in SI: (span, sweep (m), lean (rad)).

    Raises BladeShapeError for spans out of order or not reaching 0 and 100%.
    """
    table = tuple((_si_cell(row, "span_percent"), _si_cell(row, "sweep_cm"), _si_cell(row, "lean_deg")) for row in rows)
    if len(table) < 2:
        raise BladeShapeError("a sweep and lean table needs at least two rows, for 0 and 100% span")
    check_spans([row[0] for row in table])
    for span, sweep, lean in table:
        if abs(sweep) > 1.0 or abs(lean) >= 0.5 * np.pi:
            raise BladeShapeError(
                f"span {100 * span:g}%: found a sweep of {100 * sweep:g} cm and a lean of {np.degrees(lean):g} degrees; "
                "allowed: up to 100 cm, less than 90 degrees"
            )
    return table


def check_sweep(stacking: Sequence[tuple[float, float, float]], height: float) -> None:
    """Raise BladeShapeError for rows of sweep and lean that shift a profile by more than the `height` of the blade (m)."""
    for span, sweep, _ in stacking:
        if abs(sweep) > height:
            raise BladeShapeError(
                f"span {100 * span:g}%: found a sweep of {100 * sweep:g} cm; allowed: up to the height of the blade, "
                f"{100 * height:.3g} cm"
            )


def _si_cell(row: dict, column: str) -> float:
    return float(row[column]) * (si_name(column)[1] or 1.0)


def check_spans(spans: Sequence[float]) -> None:
    """Raise BladeShapeError unless the span fractions rise from 0 to 1."""
    for below, above in pairwise(spans):
        if not above > below:
            raise BladeShapeError(f"span {100 * above:g}%: comes after {100 * below:g}%; spans must be in order, each once")
    first, last = spans[0], spans[-1]
    if abs(first) > 1e-9 or abs(last - 1.0) > 1e-9:
        raise BladeShapeError(f"the spans run from {100 * first:g}% to {100 * last:g}%; the table must reach 0 and 100%")


def check_profile_order(profiles: Sequence[ProfileParameters]) -> None:
    """Raise BladeShapeError unless the radii rise from profile to profile, from hub to tip."""
    for below, above in pairwise(profiles):
        for name in ("inlet_radius", "outlet_radius"):
            if not getattr(above, name) > getattr(below, name):
                raise BladeShapeError(
                    f"{above.label}: the profile crosses the one at {below.label}: its {name} ({getattr(above, name):g} m) "
                    f"is not larger than {getattr(below, name):g} m"
                )


@lru_cache(maxsize=16)
def number_rows(
    text: str, number_columns: tuple[str, ...] | None = None, text_columns: tuple[str, ...] = ()
) -> tuple[dict, ...]:
    """Rows by column; without `number_columns` all but the texts are numbers. Read once for all designs of a family.

    Raises BladeShapeError for missing columns, columns given twice and cells that are no finite numbers.
    """
    try:
        rows = table_rows(text)
        line, header = next(rows, (1, []))
        if number_columns is None:
            number_columns = tuple(column for column in header if column not in text_columns)
        wanted = [*text_columns, *number_columns]
        missing = [column for column in wanted if column not in header]
        if missing:
            raise BladeShapeError(
                f"line {line}: the table lacks the columns {', '.join(missing)}; it has {', '.join(header) or 'none'}, "
                "separated by comma, semicolon or tab"
            )
        twice = [column for column in wanted if header.count(column) > 1]
        if twice:
            raise BladeShapeError(f"line {line}: the column {twice[0]} is given twice")
        return tuple(_row(header, cells, line, number_columns, text_columns) for line, cells in rows)
    except TextFileError as error:
        raise BladeShapeError(str(error)) from None


def _row(
    header: Sequence[str], cells: Sequence[str], line: int, number_columns: Iterable[str], text_columns: Iterable[str]
) -> dict:
    if len(cells) != len(header):
        raise BladeShapeError(f"line {line}: the row has more or fewer cells than the header has columns")
    raw = dict(zip(header, cells, strict=True))
    row: dict = {column: raw[column] for column in text_columns}
    for column in number_columns:
        text = raw[column]
        if not _NUMBER.fullmatch(text):
            raise BladeShapeError(f"line {line}, column {column}: '{text}' is not a number")
        row[column] = float(text)
        if not np.isfinite(row[column]):
            raise BladeShapeError(f"line {line}, column {column}: '{text}' is not finite")
    return row
