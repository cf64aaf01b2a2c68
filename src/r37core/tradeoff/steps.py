"""Steps of the workflow (docs/architecture.md): dataset and tables of the trade-off."""

from typing import Any

from r37core.base.dataset_file import write_dataset
from r37core.base.origin import origin
from r37core.cases.table import read_cases
from r37core.results.table_file import write_table

from .errors import gather_cases
from .tables import growth_table, level_table, parameter_table


def report(input: Any, output: Any, params: Any) -> None:
    """Compare all cases. Inputs: cases, their responses. Outputs: dataset (nc), table, levels, growth (csv).

    Params: values, as of tradeoff.plan.values.
    """
    values = params.values
    together = gather_cases(read_cases(input, output), values["places"], values["references"])
    table = parameter_table(together, values["references"])
    attributes = origin("Accuracy over cost") | {name: values[name] for name in ("blade", "base_level", "left_out")}
    write_dataset(together, output.dataset, attributes)
    write_table(table, output.table, digits=6)
    write_table(level_table(table, values["tolerance"]), output.levels, digits=6)
    write_table(growth_table(table), output.growth, digits=6)
