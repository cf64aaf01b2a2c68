"""How many members a ranking of the numbers needs, as measured: docs/tolerances.md#how-many-members."""

from __future__ import annotations

NAMES_THE_FIRST, RANKS = 32, 128
"""Members of which rank coefficients always found the same first number, and those that told most numbers apart."""

SOBOL_RANKS = 32
"""Members whose Sobol indices have places: of fewer, some that bootstrap samples told apart were the other way round."""


def remarks_on_rankings(members: int, numbers: int, sensitivity: bool) -> list[str]:
    """What a run should say before it starts where its members are too few to rank so many numbers."""
    lines, where = [], "(docs/tolerances.md#how-many-members)"
    if numbers < 2:
        return []
    if members < NAMES_THE_FIRST:
        what = f"do not rank the numbers; {NAMES_THE_FIRST} name the first, {RANKS} tell most apart"
        lines.append(f"tolerances: {members} members {what} {where}")
    elif members < RANKS:
        lines.append(f"tolerances: {members} members name the first of the numbers at best; {RANKS} tell most apart {where}")
    if sensitivity and members < SOBOL_RANKS:
        what = f"do not rank the numbers; those of {SOBOL_RANKS} do, as far as they are told apart"
        lines.append(f"tolerances: Sobol indices of {members} members {what} {where}")
    return lines
