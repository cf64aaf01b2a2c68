"""The step of families of designs."""

from typing import Any

from r37core.base.dataset_file import read_dataset
from r37core.base.io import as_list
from r37core.base.plain import from_plain
from r37core.results.operating_range import OperatingRange
from r37core.results.table_file import read_table, write_table

from .table import design_table


def tabulate(input: Any, output: Any, params: Any) -> None:
    """Compare the designs of families. Output: table (csv).

    Inputs: datasets by kind, summary, geometry of each blade whose volume is known. Params: pairs, variables, families,
    errors (relative one of the stress, of each pair), densities, operating.
    """
    files = dict(input.items())
    summary, shapes = read_table(files.pop("summary")), as_list(files.pop("geometry"))
    densities = zip(params.densities.items(), shapes, strict=True)
    masses = {blade: density * float(read_dataset(file)["volume"]) for (blade, density), file in densities}
    datasets = {kind: read_dataset(file) for kind, file in files.items()}
    operating = params.operating and from_plain(OperatingRange, params.operating)
    pairs = dict(zip(map(tuple, params.pairs), params.errors, strict=True))
    table = design_table(pairs, params.variables, params.families, masses, datasets, summary, operating)
    write_table(table, output.table, digits=6)
