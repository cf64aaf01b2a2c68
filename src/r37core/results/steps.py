"""Steps of the workflow (docs/architecture.md): Campbell diagrams, responses, the datasets of all blades, tables of these."""

from __future__ import annotations

from typing import Any

from r37core.contact.elastic_casing import ElasticCasing
from r37core.dataset_file import hash_of_parts, read_dataset, write_dataset
from r37core.io import as_list
from r37core.plain import from_plain
from r37core.rom.rom_file import read_reduced_model

from .campbell_dataset import campbell_dataset
from .casing_coincidence import coincidence_table
from .datasets import write_sweep_dataset
from .gather import gather_blades
from .response import write_response
from .table_file import write_table


def campbell_of_blade(input: Any, output: Any, params: Any) -> None:
    """Campbell diagram of a blade. Input: rom. Params: campbell, maximum_speed, tip_line, provenance. Output: campbell (nc)."""
    model = read_reduced_model(input.rom)
    dataset = campbell_dataset(model, maximum_speed=params.maximum_speed, tip_line=params.tip_line, **params.campbell)
    write_dataset(dataset, output.campbell, params.provenance)


def campbell_of_all(input: Any, output: Any, params: Any) -> None:
    """Gather the Campbell diagrams. Inputs: campbells, of each blade. Params: blades, fidelity. Output: campbell (nc)."""
    files = as_list(input.campbells)
    made = {"fidelity": params.fidelity, "input_hash": hash_of_parts(files)}
    write_dataset(gather_blades(params.blades, files), output.campbell, made)


def response(input: Any, output: Any, params: Any) -> None:
    """Reduce the speeds of a blade and scene. Inputs: speeds. Output: response (nc).

    Params: speeds, stress_history_speeds, yield_stress, provenance.
    """
    write_response(
        as_list(input.speeds),
        params.speeds,
        output.response,
        stress_history_speeds=params.stress_history_speeds,
        yield_stress=params.yield_stress,
        provenance=params.provenance,
    )


def sweep_dataset(input: Any, output: Any, params: Any) -> None:
    """Join one kind of result. Inputs: responses, of all runs. Params: kind, runs, fidelity. Output: dataset (nc)."""
    files = as_list(input.responses)
    made = {"fidelity": params.fidelity, "input_hash": hash_of_parts(files)}
    write_sweep_dataset(params.kind, dict(zip(map(tuple, params.runs), files, strict=True)), output.dataset, made)


def coincidences(input: Any, output: Any, params: Any) -> None:
    """Where modes of blades meet waves of a casing. Input: campbell. Params: casings. Output: table (csv)."""
    casings = from_plain(dict[str, ElasticCasing], params.casings)
    write_table(coincidence_table(read_dataset(input.campbell), casings), output.table, digits=8)
