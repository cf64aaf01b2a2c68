"""Closing line of the extremes."""

from __future__ import annotations

from pathlib import Path

from r37core.results.closing import counted
from r37core.results.table_file import read_table


def closing(results: Path) -> str:
    """How many extremes have each outcome."""
    outcomes = read_table(results / "stability.csv")["outcome"]
    several = ", ".join(f"{number} {outcome}" for outcome, number in outcomes.value_counts().items())
    return f"{counted(len(outcomes), 'extreme')}: {several}"
