"""Published numbers beside the range of ours over the members of a sample."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..checks import Check, number, score
from ..tables import markdown_table


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
        return sum(one.agrees for one in self.members)

    @property
    def values(self) -> np.ndarray:
        """Numbers of the members that have one, ascending."""
        found = np.array([one.ours for one in self.members], float)
        return np.sort(found[np.isfinite(found)])

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
    found = [{check.name: check for check in checks} for checks in members]
    judged = []
    for check in shipped:
        if check.published is None:
            continue
        ran = any(check.name in checks for checks in found)
        lacking = Check(check.name, check.published, "no" if isinstance(check.published, str) else np.nan)
        several = tuple(checks.get(check.name, lacking) for checks in found) if ran else ()
        judged.append(Judged(check, ours.get(check.name), several))
    return judged


def range_report(judged: Sequence[Judged], tolerances: Mapping[str, str]) -> str:
    """The conclusion, what the members have, and the table; `tolerances`: how each number spreads, in words."""
    return "\n\n".join([_conclusion(judged), _members(judged, tolerances), range_table(judged)])


def _conclusion(judged: Sequence[Judged]) -> str:
    ranged = [one for one in judged if one.members]
    differing = [one for one in judged if not one.shipped.agrees]
    inside = [one for one in differing if one.inside]
    groups = {
        "differ as shipped, but lie inside": inside,
        "differ, and the range does not reach them": [one for one in differing if one.members and not one.inside],
        "differ, and none of these tolerances touches them": [one for one in differing if not one.members],
        "agree as shipped, though outside": [one for one in ranged if one.shipped.agrees and not one.inside],
    }
    first = f"{sum(one.inside for one in ranged)} of {len(ranged)} published numbers and statements lie inside the range."
    second = f"Of the {len(differing)} that differ as shipped, {len(inside)} lie inside."
    lines = [f"- {words} ({len(group)}): {'; '.join(one.shipped.name for one in group)}" for words, group in groups.items()]
    return "\n".join([f"{first} {second}", "", *(line for line, group in zip(lines, groups.values(), strict=True) if group)])


def _members(judged: Sequence[Judged], tolerances: Mapping[str, str]) -> str:
    ranged = [one for one in judged if one.members]
    count = len(ranged[0].members) if ranged else 0
    agreeing = [sum(one.members[place].agrees for one in ranged) for place in range(count)]
    spread = ", ".join(f"`{key}` {words}" for key, words in tolerances.items())
    nominal = score([one.nominal for one in ranged if one.nominal])
    most = f"Of these {len(ranged)}, single members agree with {min(agreeing)} to {max(agreeing)}. " if count else ""
    return f"{count} members; {spread}.\n{most}The nominal run agrees with {nominal}."


def range_table(judged: Sequence[Judged]) -> str:
    """All that have a range, and those that differ without one: first what differs, outside the range before inside."""
    rows = []
    shown = [one for one in judged if one.members or not one.shipped.agrees]
    for one in sorted(shown, key=lambda one: (one.shipped.agrees, one.inside)):
        unit = f" {one.shipped.unit}" if one.shipped.unit else ""
        nominal = one.nominal.shown if one.nominal else ""
        ours = one.shipped.shown if one.shipped.agrees else f"**{one.shipped.shown}**"
        rows.append([one.shipped.name, number(one.shipped.published) + unit, ours, nominal, one.shown, one.verdict])
    return markdown_table(["what", "published", "ours", "nominal", "range", "inside"], rows)
