"""Steps of the workflow (docs/architecture.md): Campbell diagrams, responses, the datasets and tables of all blades."""

from collections.abc import Callable
from functools import reduce
from typing import Any

import numpy as np
from pandas import DataFrame
from xarray import Dataset

from r37core.base.dataset_file import attributes_of, joined_hash, read_dataset, write_dataset
from r37core.base.io import as_list, function_named, write_json
from r37core.base.origin import origin
from r37core.base.plain import from_plain
from r37core.contact.elastic_casing import ElasticCasing
from r37core.rom.rom_file import read_reduced_model
from r37core.stress.statistic import Strengths

from .campbell import campbell_dataset, gather_blades
from .casing_coincidence import coincidence_table
from .columns import IN_REGION
from .datasets import response_of, write_sweep_dataset
from .interactions import InteractionChoice, summarise
from .operating_range import OperatingRange
from .ranking import length_sustained, measures_of, measures_of_members, ranking_table
from .regions import other_regions
from .response import write_response
from .table_file import write_table


def configuration(input: Any, output: Any, params: Any) -> None:
    """Keep what a run is made with. Params: merged. Output: configuration (json)."""
    write_json(params.merged, output.configuration)


def campbell_of_blade(input: Any, output: Any, params: Any) -> None:
    """Campbell diagram of a blade. Input: rom. Params: campbell, maximum_speed, tip_line, provenance. Output: campbell (nc)."""
    choice = dict(params.campbell)
    speeds = np.linspace(0.0, params.maximum_speed, max(4, round(params.maximum_speed / choice.pop("speed_step")) + 1))
    dataset = campbell_dataset(read_reduced_model(input.rom), speeds=speeds, tip_line=params.tip_line, **choice)
    write_dataset(dataset, output.campbell, params.provenance)


def campbell_of_all(input: Any, output: Any, params: Any) -> None:
    """Gather the Campbell diagrams. Inputs: campbells, of each blade. Params: blades, fidelity. Output: campbell (nc)."""
    files = as_list(input.campbells)
    made = {"fidelity": params.fidelity, "input_hash": joined_hash(attributes_of(files))} | origin(
        "Campbell diagrams of blades"
    )
    write_dataset(gather_blades(params.blades, files), output.campbell, made)


def response(input: Any, output: Any, params: Any) -> None:
    """Reduce the speeds of a blade and scene. Inputs: speeds. Output: response (nc).

    Params: speeds, stress_history_speeds, yield_stress, strengths, provenance.
    """
    write_response(
        as_list(input.speeds),
        params.speeds,
        output.response,
        stress_history_speeds=params.stress_history_speeds,
        yield_stress=params.yield_stress,
        strengths=from_plain(Strengths, params.strengths),
        provenance=params.provenance,
    )


def sweep_dataset(input: Any, output: Any, params: Any) -> None:
    """Join one kind of result. Inputs: responses, of all runs. Params: kind, runs, fidelity. Output: dataset (nc)."""
    responses = dict(zip(map(tuple, params.runs), as_list(input.responses), strict=True))
    write_sweep_dataset(params.kind, responses, output.dataset, {"fidelity": params.fidelity})


def coincidences(input: Any, output: Any, params: Any) -> None:
    """Where modes of blades meet waves of a casing. Input: campbell. Params: casings. Output: table (csv)."""
    casings = from_plain(dict[str, ElasticCasing], params.casings)
    write_table(coincidence_table(read_dataset(input.campbell), casings), output.table, digits=8)


def summary(input: Any, output: Any, params: Any) -> None:
    """List the interactions. Inputs: datasets by kind, and files of what extensions add. Output: table (csv).

    Params: choice; added: name of an input -> function that adds its columns (plans.extension.AddedColumns).
    """
    datasets, added = _inputs(input, params)
    write_table(added(summarise(datasets, from_plain(InteractionChoice, params.choice))), output.table)


def ranking(input: Any, output: Any, params: Any) -> None:
    """Rank the blades. Inputs: datasets by kind, members if there, files of what extensions add. Output: table (csv).

    Params: runs, errors (relative one of the stress, of each run), operating (the range, or None), contacts (blade -> what its
    contact acts on), added (as of summary).
    """
    datasets, added = _inputs(input, params)
    members = measures_of_members(datasets.pop("members")) if "members" in datasets else None
    operating = params.operating and from_plain(OperatingRange, params.operating)
    measures = {
        (blade, scene): measures_of(datasets, blade, scene, operating, error)
        for (blade, scene), error in zip(params.runs, params.errors, strict=True)
    }
    for region in other_regions(datasets["stress"]) if "stress" in datasets else []:
        for blade, scene in params.runs:
            response = response_of(datasets, blade, scene, region)
            measures[blade, scene][IN_REGION.format(region)] = length_sustained(response)
    write_table(added(ranking_table(measures, members, params.contacts)), output.table, digits=6)


def _inputs(input: Any, params: Any) -> tuple[dict[str, Dataset], Callable[[DataFrame], DataFrame]]:
    """The datasets by name, and what adds the columns of extensions to a table."""
    files = dict(input.items())
    additions = [(function_named(function), files.pop(name)) for name, function in params.added.items()]
    datasets = {kind: read_dataset(file) for kind, file in files.items()}
    return datasets, lambda table: reduce(lambda made, addition: addition[0](made, addition[1]), additions, table)
