"""tolerances.csv: interactions with the range of their numbers over the members; and the line that a run ends with."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pandas as pd

from r37core.base.dataset_file import open_dataset
from r37core.results.closing import counted
from r37core.results.columns import ENDS, names
from r37core.results.interactions import Interaction, InteractionChoice
from r37core.results.table_file import read_table
from r37core.time_integration.status import RunStatus

from .plan import DATASET, TABLE
from .ranges import COLUMNS, RANGED

ROBUST = 0.5
"""Share of the members that show an interaction, below which it is not robust."""


@dataclass
class _Found:
    """One interaction, as the nominal run has it, if it does, and as members do, by name."""

    nominal: Interaction | None = None
    members: dict[str, Interaction] = field(default_factory=dict)

    def speed(self) -> float:
        rows = (*filter(None, [self.nominal]), *self.members.values())
        return float(np.median([row["peak_speed_rad_s"] for row in rows]))

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
    within = [row for row in nominal if speeds[0] <= row["peak_speed_rad_s"] <= speeds[1]]
    return [_row(match, len(members)) for match in sorted(_matched(within, members, choice), key=_Found.speed)]


def _matched(
    nominal: Sequence[Interaction], members: Mapping[str, Sequence[Interaction]], choice: InteractionChoice
) -> list[_Found]:
    """The nominal interactions in their order with the members that show them, then those of members alone."""
    matches = [_Found(row) for row in nominal]
    for name, interactions in members.items():
        for row in interactions:
            fits = [match for match in matches if name not in match.members and _same(row, match, choice)]
            if fits:
                min(fits, key=lambda match: abs(match.speed() - row["peak_speed_rad_s"])).members[name] = row
            else:
                matches.append(_Found(members={name: row}))
    return matches


def _same(row: Interaction, match: _Found, choice: InteractionChoice) -> bool:
    known = match.any()
    if (row["mode"], row["engine_order"]) != (known["mode"], known["engine_order"]):
        return False
    low, high = sorted((row["peak_speed_rad_s"], match.speed()))
    return bool(row["mode"]) or high <= choice.span * low


def _row(match: _Found, members: int) -> dict[str, object]:
    known, share = match.any(), len(match.members) / members
    row: dict[str, object] = {"mode": known["mode"], "engine_order": known["engine_order"], "members": members}
    row |= {"share_of_members": share, "robust": share >= ROBUST}
    for name in names(RANGED):
        values = np.array([member[name] for member in match.members.values()], float)
        values = values[np.isfinite(values)]
        quantiles = np.quantile(values, list(ENDS.values()), method="inverted_cdf") if len(values) else [np.nan] * len(ENDS)
        row[name] = match.nominal[name] if match.nominal else np.nan
        row |= {f"{name}_{end}": float(value) for end, value in zip(ENDS, quantiles, strict=True)}
    return row


def range_table(rows: Iterable[tuple[str, str, dict[str, object]]]) -> pd.DataFrame:
    """The rows of all blades and scenes as a table, columns as in COLUMNS."""
    made = [{"blade": blade, "scene": scene, **row} for blade, scene, row in rows]
    return pd.DataFrame(made, columns=COLUMNS).astype({"engine_order": "Int64"})


def closing(results: Path) -> str:
    """How many interactions the members show, how many runs diverged, and the largest stress of any of them, with its range."""
    table = read_table(results / TABLE.removeprefix("<results>/"))
    text = f"{counted(len(table), 'interaction')} in up to {int(table['members'].max()) if len(table) else 0} members"
    text += f", {int(table['robust'].sum())} of them in at least half of those"
    with open_dataset(results / DATASET.removeprefix("<results>/")) as dataset:
        status = dataset["status"].values
    if diverged := int((status == RunStatus.DIVERGED).sum()):
        text += f"; {diverged} of {int((status != RunStatus.NOT_RUN).sum())} runs diverged"
    high = table["largest_stress_pa_high"]
    if high.notna().any():
        row = table.loc[high.idxmax()]
        low_end, high_end = (1e-9 * row[f"largest_stress_pa_{end}"] for end in ("low", "high"))
        text += f"; the largest stress {low_end:.2g} to {high_end:.2g} GPa, {row['blade']} in {row['scene']}"
    return text
