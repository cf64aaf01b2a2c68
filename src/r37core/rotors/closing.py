"""What a run says of its rotors when it ends."""

from __future__ import annotations

from pathlib import Path

from r37core.results.closing import counted, largest_stress_text
from r37core.results.table_file import read_table


def closing(results: Path) -> str:
    """How many rotors there are, how many of their runs diverged, and the largest stress of any of their blades."""
    table = read_table(results / "rotors.csv")
    text = counted(len(table), "rotor")
    if diverged := int(table["diverged_speeds"].sum()):
        text += f", {diverged} of {counted(int(table['speeds'].sum()), 'run')} diverged"
    return text + largest_stress_text(table, "worst_speed_rad_s")
