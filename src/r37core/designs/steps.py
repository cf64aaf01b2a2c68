"""The step of families of designs."""

from typing import Any

from r37core.dataset_file import read_dataset
from r37core.io import as_list
from r37core.results.table_file import read_table, write_table

from .table import design_table


def tabulate(input: Any, output: Any, params: Any) -> None:
    """Compare the designs of families. Output: table (csv).

    Inputs: datasets by kind, summary, geometry of each design. Params: designs, densities, scenes.
    """
    files = dict(input.items())
    summary, shapes = read_table(files.pop("summary")), as_list(files.pop("geometry"))
    geometries = dict(zip(params.designs, shapes, strict=True))
    masses = {blade: params.densities[blade] * float(read_dataset(file)["volume"]) for blade, file in geometries.items()}
    datasets = {kind: read_dataset(file) for kind, file in files.items()}
    write_table(design_table(params.designs, masses, datasets, summary, params.scenes), output.table, digits=6)
