"""Closing line of the estimate."""

from __future__ import annotations

from pathlib import Path

from r37core.results.closing import counted
from r37core.results.table_file import read_table


def closing(results: Path) -> str:
    """How many simulations there are, and how long they take."""
    total = read_table(results / "estimate.csv").set_index("part").loc["total"]
    length = f"{total['wall_hours']:.2f} h on {counted(int(total['cores']), 'core')}"
    return f"{counted(int(total['simulations']), 'simulation')} at most, {length}"
