"""tolerances.csv: interactions with the range of their numbers over the members; and the line that a run ends with."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from r37core.base.dataset_file import open_dataset
from r37core.results.closing import counted
from r37core.results.columns import ENDS, names
from r37core.results.interactions import Interaction, InteractionChoice
from r37core.results.table_file import read_table
from r37core.time_integration.status import RunStatus

from .plan import DATASET, TABLE
from .ranges import RANGED

ROBUST = 0.5
"""Share of the members that show an interaction, below which it is not robust."""


_NOMINAL = ""
"""Name of the nominal run among those that show an interaction."""

_Match = dict[str, Interaction]
"""One interaction, as the nominal run has it, which is the first if it does, and as members do, by name."""


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
    matches: list[_Match] = [{_NOMINAL: row} for row in nominal if speeds[0] <= row["peak_speed_rad_s"] <= speeds[1]]
    for name, interactions in members.items():
        for row in interactions:
            fits = [match for match in matches if name not in match and _same(row, match, choice)]
            if fits:
                min(fits, key=lambda match: abs(_speed(match) - row["peak_speed_rad_s"]))[name] = row
            else:
                matches.append({name: row})
    return [_row(match, len(members)) for match in sorted(matches, key=_speed)]


def _speed(match: _Match) -> float:
    return float(np.median([row["peak_speed_rad_s"] for row in match.values()]))


def _same(row: Interaction, match: _Match, choice: InteractionChoice) -> bool:
    known = next(iter(match.values()))
    if (row["mode"], row["engine_order"]) != (known["mode"], known["engine_order"]):
        return False
    low, high = sorted((row["peak_speed_rad_s"], _speed(match)))
    return bool(row["mode"]) or high <= choice.span * low


def _row(match: _Match, members: int) -> dict[str, object]:
    known, shown = next(iter(match.values())), [row for name, row in match.items() if name != _NOMINAL]
    share = len(shown) / members
    row: dict[str, object] = {"mode": known["mode"], "engine_order": known["engine_order"], "members": members}
    row |= {"share_of_members": share, "robust": share >= ROBUST}
    for name in names(RANGED):
        values = np.array([member[name] for member in shown], float)
        values = values[np.isfinite(values)]
        quantiles = np.quantile(values, list(ENDS.values()), method="inverted_cdf") if len(values) else [np.nan] * len(ENDS)
        row[name] = known[name] if _NOMINAL in match else np.nan
        row |= {f"{name}_{end}": float(value) for end, value in zip(ENDS, quantiles, strict=True)}
    return row


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
