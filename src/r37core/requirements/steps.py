"""The steps of requirements: what lies in the operating range, and the verdict."""

from typing import Any

from r37core.base.dataset_file import read_dataset
from r37core.base.io import as_list
from r37core.base.plain import from_plain
from r37core.fem.assembly import mesh_volume
from r37core.mesh.mesh_files import read_vtu
from r37core.results.operating_range import OperatingRange
from r37core.results.table_file import read_table, write_table

from .choice import Requirements
from .table import operating_table, verdict_table


def judge(input: Any, output: Any, params: Any) -> None:
    """Judge each blade and scene. Output: verdict (csv).

    Inputs: datasets by kind, volumes (geometry or mesh of each blade with a density); if there, members and motions. Params:
    pairs, requirements, operating, densities, clearance and thickness by scene.
    """
    files = dict(input.items())
    shapes = zip(params.densities.items(), as_list(files.pop("volumes")), strict=True)
    masses = {blade: density * _volume(file) for (blade, density), file in shapes}
    numbers = {"clearance": params.clearance, "thickness": params.thickness, "mass": masses}
    datasets = {kind: read_dataset(file) for kind, file in files.items()}
    requirements, operating = from_plain(Requirements, params.requirements), from_plain(OperatingRange, params.operating)
    write_table(verdict_table(params.pairs, requirements, operating, datasets, numbers), output.verdict, digits=6)


def _volume(file: str) -> float:
    """Volume (m3) of a blade, by its geometry or its mesh."""
    if file.endswith(".nc"):
        return float(read_dataset(file)["volume"])
    mesh = read_vtu(file)
    return mesh_volume(mesh.blocks, mesh.points)


def list_operating(input: Any, output: Any, params: Any) -> None:
    """List what lies in the operating range. Inputs: datasets by kind, summary. Output: table (csv).

    Params: pairs, operating.
    """
    files = dict(input.items())
    interactions = read_table(files.pop("summary"))
    datasets = {kind: read_dataset(file) for kind, file in files.items()}
    table = operating_table(params.pairs, from_plain(OperatingRange, params.operating), datasets, interactions)
    write_table(table, output.table, digits=6)
