"""What happens at extremes of the configuration: tables of docs/stability.md, from stability.csv of a run of the product."""

import re
from typing import Any

import pandas as pd

from r37core.trials.stability_tables import ACCURATE, COLUMNS, DEGRADED, DIVERGED, OUTCOMES, REFUSED

from .pages import write_table

SHOWN = 8
"""Rows of the table of what is not accurate, those that change most."""


def tables(input: Any, output: Any, params: Any) -> None:
    """How many cases of each outcome, those that are not accurate, and all. Input: cases, a table of the extension."""
    cases = pd.read_csv(input.cases, dtype={"value": str}).fillna("")
    write_table(*counts(cases), output.table)
    write_table(*inaccurate(cases), output.inaccurate)
    write_table(COLUMNS, cases[list(COLUMNS)].astype(str).values.tolist(), output.cases)


def counts(cases: pd.DataFrame) -> tuple[list[str], list[list[str]]]:
    """How many cases of each scene have each outcome."""
    rows = [
        [scene, f"{len(part)}", *(f"{(part.outcome == outcome).sum()}" for outcome in OUTCOMES)]
        for scene, part in cases.groupby("scene")
    ]
    return ["scene", "cases", *OUTCOMES], rows


def inaccurate(cases: pd.DataFrame) -> tuple[list[str], list[list[str]]]:
    """Cases that ran and are not accurate, those that diverge first, then by the change of rms with half the step."""
    ran = cases[~cases.outcome.isin([ACCURATE, REFUSED])]
    order = ran.detail.map(_change).where(ran.outcome == DEGRADED, float("inf")).sort_values(ascending=False).index
    rows = [
        [row.what.replace("_", " "), row.value, row.scene, row.outcome, _words(row)]
        for row in ran.loc[order[:SHOWN]].itertuples()
    ]
    return ["what", "value", "scene", "outcome", "with half the step"], rows


def _change(detail: str) -> float:
    """Percent, of a detail that has them."""
    found = re.search(r"([\d.e+-]+)%", detail)
    return float(found[1]) if found else float("inf")


def _words(row: Any) -> str:
    if row.outcome == DIVERGED:
        return str(row.detail).partition(";")[0]
    return f"rms changes by {_change(row.detail):.0f}%" if "%" in row.detail else row.detail
