"""tolerances.csv: every interaction with the range of its numbers over the members, and how many of them show it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pandas as pd

from r37core.io import readable
from r37core.results.interactions import Interaction, InteractionChoice
from r37core.results.member_ends import ENDS
from r37core.results.table_file import read_table
from r37core.rounding import rounded_to

RANGED = ("peak_speed_rad_s", "width_above_yield_rad_s", "first_yield_speed_rad_s", "max_von_mises_pa")
"""Columns of summary.csv that have a range."""

RANGES = tuple(f"{name}_{end}" for name in RANGED for end in ENDS)

KEY = ["blade", "scene", "mode", "engine_order"]
COLUMNS = [
    *KEY,
    "members",
    "share_of_members",
    "robust",
    *(name for one in RANGED for name in (one, *(f"{one}_{end}" for end in ENDS))),
]
"""Columns of tolerances.csv: those without an end are of the nominal run."""

ROBUST = 0.5
"""Share of the members that show an interaction, below which it is not robust."""


@dataclass
class _Found:
    """One interaction, as the nominal run has it, if it does, and as members do, by name."""

    nominal: Interaction | None = None
    members: dict[str, Interaction] = field(default_factory=dict)

    def speed(self) -> float:
        speeds = [one.peak_speed_rad_s for one in (*filter(None, [self.nominal]), *self.members.values())]
        return float(np.median(speeds))

    def any(self) -> Interaction:
        return self.nominal or next(iter(self.members.values()))


def ranges(
    nominal: Sequence[Interaction],
    members: Mapping[str, Sequence[Interaction]],
    choice: InteractionChoice,
    speeds: tuple[float, float] = (0.0, np.inf),
) -> list[dict[str, object]]:
    """Rows of one blade in one scene, by ascending speed, from the interactions of the nominal run and of each member.

    Two are the same where mode and engine order are; those that no crossing explains where one crossing could hold both.
    `speeds`: first and last (rad/s) of the members; what the nominal run shows beyond them no member could.
    """
    within = [one for one in nominal if speeds[0] <= one.peak_speed_rad_s <= speeds[1]]
    found = sorted(_matched(within, members, choice), key=_Found.speed)
    return [_row(one, len(members)) for one in found]


def shares_of_members(
    nominal: Sequence[Interaction], members: Mapping[str, Sequence[Interaction]], choice: InteractionChoice
) -> list[float]:
    """Share of the members that show each of the nominal interactions, as in `ranges`, in the order of these."""
    return [len(one.members) / len(members) for one in _matched(nominal, members, choice)[: len(nominal)]]


def _matched(
    nominal: Sequence[Interaction], members: Mapping[str, Sequence[Interaction]], choice: InteractionChoice
) -> list[_Found]:
    """The nominal interactions in their order with the members that show them, then those of members alone."""
    found = [_Found(one) for one in nominal]
    for name, interactions in members.items():
        for one in interactions:
            fits = [other for other in found if name not in other.members and _same(one, other, choice)]
            if fits:
                min(fits, key=lambda other: abs(other.speed() - one.peak_speed_rad_s)).members[name] = one
            else:
                found.append(_Found(members={name: one}))
    return found


def _same(one: Interaction, other: _Found, choice: InteractionChoice) -> bool:
    known = other.any()
    if (one.mode, one.engine_order) != (known.mode, known.engine_order):
        return False
    low, high = sorted((one.peak_speed_rad_s, other.speed()))
    return bool(one.mode) or high <= choice.span * low


def _row(one: _Found, members: int) -> dict[str, object]:
    known, share = one.any(), len(one.members) / members
    row: dict[str, object] = {"mode": known.mode, "engine_order": known.engine_order, "members": members}
    row |= {"share_of_members": share, "robust": share >= ROBUST}
    for name in RANGED:
        values = np.array([getattr(member, name) for member in one.members.values()], float)
        values = values[np.isfinite(values)]
        quantiles = np.quantile(values, list(ENDS.values()), method="inverted_cdf") if len(values) else [np.nan] * len(ENDS)
        row[name] = getattr(one.nominal, name) if one.nominal else np.nan
        row |= {f"{name}_{end}": float(value) for end, value in zip(ENDS, quantiles, strict=True)}
    return row


def range_table(rows: Iterable[tuple[str, str, dict[str, object]]]) -> pd.DataFrame:
    """The rows of all blades and scenes as a table, columns as in COLUMNS."""
    made = [{"blade": blade, "scene": scene, **row} for blade, scene, row in rows]
    return pd.DataFrame(made, columns=COLUMNS).astype({"engine_order": "Int64"})


def read_ranges(file: Path | str) -> pd.DataFrame:
    """tolerances.csv. Raises InputFileError where it cannot be read."""
    table = read_table(file)
    with readable(file):
        if list(table.columns) != COLUMNS:
            raise ValueError(f"its columns are not {', '.join(COLUMNS)}")
        kinds = {"engine_order": "Int64", "robust": bool, **dict.fromkeys([*RANGED, *RANGES], float)}
        # what no crossing explains has no mode
        return table.fillna({"mode": ""}).astype(kinds)


def as_ranges_bear(summary: pd.DataFrame) -> pd.DataFrame:
    """The summary with as many digits of what has a range as its width bears, but for the nominal peaks, which are runs."""
    found = summary.copy()
    for one in RANGED:
        columns = [name for name in (one, *(f"{one}_{end}" for end in ENDS)) if name in found and name != "peak_speed_rad_s"]
        if f"{one}_low" in columns:
            rows = found[f"{one}_low"].notna() & found[f"{one}_high"].notna()
            spread = found.loc[rows, f"{one}_high"] - found.loc[rows, f"{one}_low"]
            for name in columns:
                values = zip(found.loc[rows, name], spread, strict=True)
                found.loc[rows, name] = [float(rounded_to(value, width) or np.nan) for value, width in values]
    return found


def with_ranges(summary: pd.DataFrame, table: pd.DataFrame) -> pd.DataFrame:
    """summary.csv with the share of members and the ranges of each interaction; empty for those without members."""
    beside = table[table["peak_speed_rad_s"].notna()][[*KEY, "peak_speed_rad_s", "share_of_members", "robust", *RANGES]]
    # an empty table has columns of no type
    return summary.astype({"peak_speed_rad_s": float, "engine_order": "Int64"}).merge(
        beside, "left", [*KEY, "peak_speed_rad_s"]
    )
