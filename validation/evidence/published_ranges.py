"""Published numbers next to the range of ours over the members of a sample."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .checks import Check, number


@dataclass(frozen=True)
class Judged:
    """A published number or statement: ours at the published step (`shipped`), of the nominal run, and of `members`."""

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
        """The range as text."""
        total = len(self.members)
        if self.is_statement:
            return f"{self.true_for} of {total}"
        values = self.values
        ends = " to ".join(dict.fromkeys(number(float(end)) for end in (values[0], values[-1]))) if len(values) else "none"
        return ends + (f" ({total - len(values)} of {total} none)" if 0 < len(values) < total else "")

    @property
    def verdict(self) -> str:
        """Whether it is inside, as text."""
        return "yes" if self.inside else "no"


def judge(shipped: Sequence[Check], nominal: Sequence[Check], members: Sequence[Sequence[Check]]) -> list[Judged]:
    """Each published number that members have; a member without it counts as having no number."""
    ours = {check.name: check for check in nominal}
    by_name = [{check.name: check for check in checks} for checks in members]
    judged = []
    for check in shipped:
        if check.published is None or not any(check.name in checks for checks in by_name):
            continue
        lacking = Check(check.name, check.published, "no" if isinstance(check.published, str) else np.nan)
        judged.append(Judged(check, ours.get(check.name), tuple(checks.get(check.name, lacking) for checks in by_name)))
    return judged


def counts(judged: Sequence[Judged]) -> list[tuple[str, int]]:
    """How many numbers lie inside the range and outside, by whether ours agrees at the published step."""
    return [
        (f"{words}, {where}", sum(row.shipped.agrees == agrees and row.inside == inside for row in judged))
        for agrees, words in ((True, "agree"), (False, "differ"))
        for inside, where in ((True, "inside the range"), (False, "outside"))
    ]
