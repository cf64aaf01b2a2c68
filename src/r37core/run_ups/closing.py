"""What a run says of its run-ups when it ends."""

from __future__ import annotations

from pathlib import Path

from r37core.results.closing import counted, largest_stress_text
from r37core.results.table_file import read_table
from r37core.time_integration.status import RunStatus


def closing(results: Path) -> str:
    """How many run-ups there are, how many pass yield or diverge, and the largest stress of all."""
    table = read_table(results / "run_ups.csv")
    text = counted(len(table), "run-up")
    if "max_von_mises_pa" in table:
        text += f", {int((table['max_von_mises_pa'] > table['yield_stress_pa']).sum())} of them above yield"
    if diverged := int((table["status"] == RunStatus.DIVERGED.text).sum()):
        text += f", {diverged} diverged"
    return text + largest_stress_text(table, "max_von_mises_speed_rad_s")
