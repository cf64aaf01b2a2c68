"""Closing line of the trade-off."""

from __future__ import annotations

from pathlib import Path

import pandas as pd

from r37core.dataset_file import read_dataset
from r37core.results.table_file import read_table


def closing(results: Path) -> str:
    """The recommended level, and which parameters were left out."""
    levels, attributes = read_table(results / "tradeoff_levels.csv"), read_dataset(results / "tradeoff.nc").attrs
    said = ["no levels were compared"] if levels.empty else [_advice(levels)]
    if attributes["left_out"]:
        said.append(f"left out: {attributes['left_out']}")
    return "; ".join(said)


def _advice(levels: pd.DataFrame) -> str:
    best = levels[levels["recommended"] == "yes"]
    within = f"within the tolerance of {100 * levels['tolerance'].iloc[0]:g}%"
    if best.empty:
        return (
            f"no level is {within}: the best differs by {100 * levels['error'].min():.1f}% from {levels['reference'].iloc[0]}"
        )
    row = best.iloc[0]
    return f"cheapest level {within} of {row['reference']}: {row['level']}, {100 * row['error']:.1f}%"
