"""Closing lines that several studies have."""

import pandas as pd


def largest_stress_text(table: pd.DataFrame, speed: str) -> str:
    """The largest stress of a table with the columns blade, scene and largest_stress_pa, and where; `speed`: a column's name.

    Empty where no row has a stress.
    """
    if "largest_stress_pa" not in table or table["largest_stress_pa"].isna().all():
        return ""
    row = table.loc[table["largest_stress_pa"].idxmax()]
    where = f"{row['blade']} in {row['scene']} at {row[speed]:.6g} rad/s"
    return f"; the largest stress {1e-9 * row['largest_stress_pa']:.2f} GPa, {where}"
