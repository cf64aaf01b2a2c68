"""Steps of the workflow (docs/architecture.md): dataset and tables of the trade-off."""

from typing import Any

from r37core.base.dataset_file import read_dataset, write_dataset
from r37core.base.io import as_list
from r37core.results.table_file import write_table

from .errors import gather_cases
from .growth import growth_table
from .tables import level_table, parameter_table


def report(input: Any, output: Any, params: Any) -> None:
    """Compare all cases. Inputs: cases, their responses. Outputs: dataset (nc), table, levels, growth (csv).

    Params: cases, their names; values, as of tradeoff.plan.values.
    """
    responses = {name: read_dataset(file) for name, file in zip(params.cases, as_list(input.cases), strict=True)}
    values = params.values
    together = gather_cases(responses, values["places"], values["references"])
    table = parameter_table(together, values["references"])
    attributes = {name: values[name] for name in ("blade", "base_level", "left_out")}
    write_dataset(together, output.dataset, attributes)
    write_table(table, output.table, digits=6)
    write_table(level_table(table, values["tolerance"]), output.levels, digits=6)
    write_table(growth_table(table), output.growth, digits=6)
