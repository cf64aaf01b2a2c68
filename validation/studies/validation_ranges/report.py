"""Published numbers beside the range of ours over the members of a sample."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr

from r37core.dataset_file import read_dataset
from validation.studies.checks import Check, number, score
from validation.studies.modelling_choices.report import campbells_of, runs_of
from validation.studies.modelling_choices.validation import choice_checks, shipped_checks
from validation.studies.tables import markdown_table

from .cases import NOMINAL


def report(responses: Mapping[str, xr.Dataset], files: Any, values: Mapping[str, Any]) -> dict[str, Any]:
    """The table with its conclusion."""
    shipped = runs_of({name: read_dataset(file) for name, file in zip(values["shipped"], files.shipped, strict=True)})
    published = shipped_checks(read_dataset(files.geometry), campbells_of(files, values), shipped)
    checks = {member: choice_checks(runs) for member, runs in runs_of(responses).items()}
    nominal = checks.pop(NOMINAL)
    return {"table": range_report(judge(published, nominal, list(checks.values())), values["tolerances"])}


@dataclass(frozen=True)
class Judged:
    """A published number or statement: ours as shipped, of the nominal run, and of `members`.

    `nominal` None and no `members`: none of their runs gives it.
    """

    shipped: Check
    nominal: Check | None
    members: tuple[Check, ...]

    @property
    def is_statement(self) -> bool:
        """Whether it is true or false, not a number."""
        return isinstance(self.shipped.published, str)

    @property
    def true_for(self) -> int:
        """Members of which the statement is true."""
        return sum(entry.agrees for entry in self.members)

    @property
    def values(self) -> np.ndarray:
        """Numbers of the members that have one, ascending."""
        values = np.array([check.ours for check in self.members], float)
        return np.sort(values[np.isfinite(values)])

    @property
    def inside(self) -> bool:
        """Whether the published number is in the range, or the statement true of at least one member."""
        if self.is_statement:
            return self.true_for > 0
        values, published = self.values, self.shipped.published
        return bool(len(values)) and values[0] <= float(published or np.nan) <= values[-1]

    @property
    def shown(self) -> str:
        """The range as text; nothing without members."""
        total = len(self.members)
        if not total:
            return ""
        if self.is_statement:
            return f"{self.true_for} of {total}"
        values = self.values
        ends = " to ".join(dict.fromkeys(number(float(end)) for end in (values[0], values[-1]))) if len(values) else "none"
        return ends + (f" ({total - len(values)} of {total} none)" if 0 < len(values) < total else "")

    @property
    def verdict(self) -> str:
        """The cell `inside`."""
        return ("yes" if self.inside else "**no**") if self.members else ""


def judge(shipped: Sequence[Check], nominal: Sequence[Check], members: Sequence[Sequence[Check]]) -> list[Judged]:
    """Each published number with the checks of the same name; a member without it counts as having no number."""
    ours = {check.name: check for check in nominal}
    by_name = [{check.name: check for check in checks} for checks in members]
    judged = []
    for check in shipped:
        if check.published is None:
            continue
        ran = any(check.name in checks for checks in by_name)
        lacking = Check(check.name, check.published, "no" if isinstance(check.published, str) else np.nan)
        several = tuple(checks.get(check.name, lacking) for checks in by_name) if ran else ()
        judged.append(Judged(check, ours.get(check.name), several))
    return judged


def range_report(judged: Sequence[Judged], tolerances: Mapping[str, str]) -> str:
    """The conclusion, what the members have, and the table; `tolerances`: how each number spreads, in words."""
    return "\n\n".join([_conclusion(judged), _members(judged, tolerances), range_table(judged)])


def _conclusion(judged: Sequence[Judged]) -> str:
    ranged = [row for row in judged if row.members]
    differing = [row for row in judged if not row.shipped.agrees]
    inside = [row for row in differing if row.inside]
    groups = {
        "differ as shipped, but lie inside": inside,
        "differ, and the range does not reach them": [row for row in differing if row.members and not row.inside],
        "differ, and none of these tolerances touches them": [row for row in differing if not row.members],
        "agree as shipped, though outside": [row for row in ranged if row.shipped.agrees and not row.inside],
    }
    first = f"{sum(row.inside for row in ranged)} of {len(ranged)} published numbers and statements lie inside the range."
    second = f"Of the {len(differing)} that differ as shipped, {len(inside)} lie inside."
    lines = [
        f"- {words} ({len(group)}): {'; '.join(row.shipped.name for row in group)}" for words, group in groups.items() if group
    ]
    return "\n".join([f"{first} {second}", "", *lines])


def _members(judged: Sequence[Judged], tolerances: Mapping[str, str]) -> str:
    ranged = [row for row in judged if row.members]
    count = len(ranged[0].members) if ranged else 0
    agreeing = [sum(row.members[member].agrees for row in ranged) for member in range(count)]
    spread = ", ".join(f"`{key}` {words}" for key, words in tolerances.items())
    nominal = score([row.nominal for row in ranged if row.nominal])
    most = f"Of these {len(ranged)}, single members agree with {min(agreeing)} to {max(agreeing)}. " if count else ""
    return f"{count} members; {spread}.\n{most}The nominal run agrees with {nominal}."


def range_table(judged: Sequence[Judged]) -> str:
    """All that have a range, and those that differ without one: first what differs, outside the range before inside."""
    rows = []
    shown = [row for row in judged if row.members or not row.shipped.agrees]
    for row in sorted(shown, key=lambda row: (row.shipped.agrees, row.inside)):
        unit = f" {row.shipped.unit}" if row.shipped.unit else ""
        nominal = row.nominal.shown if row.nominal else ""
        ours = row.shipped.shown if row.shipped.agrees else f"**{row.shipped.shown}**"
        rows.append([row.shipped.name, number(row.shipped.published) + unit, ours, nominal, row.shown, row.verdict])
    return markdown_table(["what", "published", "ours", "nominal", "range", "inside"], rows)
