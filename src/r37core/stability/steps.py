"""Steps of the workflow (docs/architecture.md): the outcomes of the extremes."""

from typing import Any

import pandas as pd

from r37core.cases.case import HALF_STEP
from r37core.cases.table import case_table, read_cases
from r37core.results.table_file import write_table

from .judging import judge, numbers

COLUMNS = ("what", "value", "scene", "outcome", "detail", "time_step_s", "rms_m", "share_in_contact")


def report(input: Any, output: Any, params: Any) -> None:
    """Judge every extreme. Inputs: cases, their responses. Output: table (csv)."""
    cases = case_table(read_cases(input, output), numbers).to_dict("index")
    rows = []
    for name in [name for name in cases if not name.endswith(HALF_STEP)]:
        outcome, detail = judge(cases[name], cases[f"{name}{HALF_STEP}"])
        rows.append({**words(name), **cases[name], "outcome": outcome, "detail": detail})
    write_table(pd.DataFrame(rows, columns=list(COLUMNS)), output.table, digits=6)


def words(name: str) -> dict[str, str]:
    """Columns of the table from the name of a case: what is extreme, its value and the scene."""
    extreme, _, scene = name.partition("__")
    what, _, value = extreme.rpartition("_")
    return {"what": what, "value": value, "scene": scene}
