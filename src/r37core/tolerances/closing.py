"""What a run says of the members of its tolerances when it ends."""

from __future__ import annotations

from pathlib import Path

from r37core.dataset_file import open_dataset
from r37core.results.closing import counted
from r37core.results.table_file import read_table
from r37core.time_integration.status import RunStatus

from .plan import DATASET, TABLE


def closing(results: Path) -> str:
    """How many interactions the members show, how many runs diverged, and the largest stress of any of them, with its range."""
    table = read_table(results / TABLE.removeprefix("<results>/"))
    text = f"{counted(len(table), 'interaction')} in up to {int(table['members'].max()) if len(table) else 0} members"
    text += f", {int(table['robust'].sum())} of them in at least half of those"
    with open_dataset(results / DATASET.removeprefix("<results>/")) as dataset:
        status = dataset["status"].values
    if diverged := int((status == RunStatus.DIVERGED).sum()):
        text += f"; {diverged} of {int((status != RunStatus.NOT_RUN).sum())} runs diverged"
    high = table["max_von_mises_pa_high"]
    if high.notna().any():
        row = table.loc[high.idxmax()]
        low_end, high_end = (1e-9 * row[f"max_von_mises_pa_{end}"] for end in ("low", "high"))
        text += f"; the largest stress {low_end:.2g} to {high_end:.2g} GPa, {row['blade']} in {row['scene']}"
    return text
