"""What a run says of its families of designs when it ends."""

from __future__ import annotations

from pathlib import Path

from r37core.results.closing import counted
from r37core.results.ranking import RANKED_BY
from r37core.results.table_file import read_table


def closing(results: Path) -> str:
    """How many designs there are, and the one that is above yield at the fewest speeds of each scene."""
    table = read_table(results / "designs.csv")
    text = counted(table["blade"].nunique(), "design")
    for scene, rows in table.dropna(subset=RANKED_BY[0]).groupby("scene", sort=False):
        best = rows.sort_values(list(RANKED_BY)).iloc[0]
        text += f"; {scene}: {best['blade']} is above yield at the fewest speeds ({best[RANKED_BY[0]]:.0f} rad/s)"
    return text
