"""What the runs of one blade cost (docs/speed.md)."""

from typing import Any

import pandas as pd

from .tables import write_table

SHOWN = ("time integration", "start-up", "total")


def cost(input: Any, output: Any, params: Any) -> None:
    """Table of core minutes, projected from a sample. Inputs: by the name of a row, a table of the extension `estimate`."""
    rows = []
    for name, file in input.items():
        costs = pd.read_csv(file).set_index("part")
        rows.append([name, f"{costs.simulations['total']:,.0f}", *(f"{60.0 * costs.core_hours[part]:.1f}" for part in SHOWN)])
    write_table(["runs", "number", *(f"{part} (core min)" for part in SHOWN)], rows, output.table)
