"""What tables say in a run's last line."""

from __future__ import annotations

import pandas as pd


def counted(number: int, name: str) -> str:
    """A number of things with their name: 1 run-up, 2 run-ups."""
    return f"{number} {name}{'s' * (number != 1)}"


def largest_stress_text(table: pd.DataFrame, speed: str) -> str:
    """The largest stress of a table with the columns blade, scene and max_von_mises_pa, and where; `speed`: a column's name.

    Empty where no row has a stress.
    """
    if "max_von_mises_pa" not in table or table["max_von_mises_pa"].isna().all():
        return ""
    row = table.loc[table["max_von_mises_pa"].idxmax()]
    gigapascals = 1e-9 * row["max_von_mises_pa"]
    return f"; the largest stress {gigapascals:.2f} GPa, {row['blade']} in {row['scene']} at {row[speed]:.6g} rad/s"
