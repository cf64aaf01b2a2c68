"""Steps of the workflow (docs/architecture.md): datasets and table of whole rotors."""

from typing import Any

from r37core.base.dataset_file import write_dataset
from r37core.base.io import as_list
from r37core.results.joining import join_runs
from r37core.results.table_file import write_table

from .dataset import RUNS, rotor_dataset, rotor_table


def rotor_of_run(input: Any, output: Any, params: Any) -> None:
    """Numbers of every blade. Inputs: speeds. Output: rotor (nc). Params: speeds, yield_stress, provenance."""
    dataset = rotor_dataset(as_list(input.speeds), params.speeds, params.yield_stress)
    write_dataset(dataset, output.rotor, params.provenance)


def join(input: Any, output: Any, params: Any) -> None:
    """Join all rotors in one dataset and table. Inputs: rotors. Params: runs, fidelity. Outputs: dataset (nc), table (csv)."""
    files = as_list(input.rotors)
    join_runs(files, params.runs, RUNS, output.dataset, "Every blade of rubbing rotors", params.fidelity)
    write_table(rotor_table(dict(zip(map(tuple, params.runs), files, strict=True))), output.table, digits=6)
