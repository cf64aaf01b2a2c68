"""Steps of the workflow (docs/architecture.md): the cost of the sweep."""

from typing import Any

from r37core.cases.table import case_table, read_cases
from r37core.results.table_file import write_table

from .projection import numbers, projected_costs, time_start_up


def report(input: Any, output: Any, params: Any) -> None:
    """Project the cost. Inputs: cases, their responses. Output: table (csv). Params: values."""
    costs = projected_costs(case_table(read_cases(input, output), numbers), start_up=time_start_up(), **params.values)
    write_table(costs, output.table, digits=6)
