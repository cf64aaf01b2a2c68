"""Steps of the workflow (docs/architecture.md): the outcomes of the extremes."""

from typing import Any

import pandas as pd

from r37core.base.dataset_file import read_dataset
from r37core.base.io import as_list
from r37core.results.table_file import write_table

from .judging import judge

COLUMNS = ("what", "value", "scene", "outcome", "detail", "time_step_s", "rms_m", "share_in_contact")


def report(input: Any, output: Any, params: Any) -> None:
    """Judge every extreme. Inputs: cases, their responses. Output: table (csv). Params: cases, their names; extremes."""
    files = dict(zip(params.cases, as_list(input.cases), strict=True))
    rows = [{**each, **judge(read_dataset(files[each["case"]]), read_dataset(files[each["half"]]))} for each in params.extremes]
    write_table(pd.DataFrame(rows, columns=list(COLUMNS)), output.table, digits=6)
