"""What happens at extremes of the configuration (docs/stability.md)."""

from typing import Any

import pandas as pd

from r37studies.trials.case_table import DEGRADED, DIVERGED, OUTCOMES

from .tables import write_table


def counts(input: Any, output: Any, params: Any) -> None:
    """Table of how many cases of each scene have each outcome, and which are not accurate. Input: cases, of the extension."""
    cases = pd.read_csv(input.cases, dtype={"value": str})
    rows = []
    for scene, part in cases.groupby("scene"):
        inaccurate = part[part.outcome.isin([DEGRADED, DIVERGED])]
        named = "; ".join(f"{row.what.replace('_', ' ')} {row.value}" for row in inaccurate.itertuples())
        rows.append([scene, f"{len(part)}", *(f"{(part.outcome == outcome).sum()}" for outcome in OUTCOMES), named])
    write_table(["scene", "cases", *OUTCOMES, "degraded or diverged"], rows, output.table)
