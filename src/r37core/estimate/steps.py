"""Steps of the workflow (docs/architecture.md): the cost of the sweep."""

from typing import Any

from r37core.base.dataset_file import read_dataset
from r37core.base.io import as_list
from r37core.results.table_file import write_table

from .projection import projected_costs, sample_of, time_start_up


def report(input: Any, output: Any, params: Any) -> None:
    """Project the cost. Inputs: cases, their responses. Output: table (csv). Params: cases, their names; values."""
    files = dict(zip(params.cases, as_list(input.cases), strict=True))
    samples = [sample_of(read_dataset(file), params.values["runs"][name]) for name, file in files.items()]
    costs = projected_costs(samples, time_start_up(), params.values["workflow_s_per_job"], params.values["cores"])
    write_table(costs, output.table, digits=6)
