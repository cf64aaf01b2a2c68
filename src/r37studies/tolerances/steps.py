"""Steps of the workflow (docs/architecture.md): members under tolerances, and what they give together."""

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import pandas as pd
import xarray as xr

from r37core.base.dataset_file import attributes_of, joined_hash, read_dataset, write_dataset, write_groups
from r37core.base.io import as_list
from r37core.base.origin import origin
from r37core.base.plain import from_plain
from r37core.results.interactions import InteractionChoice, find_interactions
from r37core.results.regions import read_judged
from r37core.results.table_file import write_table
from r37core.sweep.blade_sweep import CAMPBELL, BladeSweep, SharedSpeeds
from r37core.sweep.driver import Driver
from r37core.sweep.forks import forked_results
from r37core.sweep.recipe import STRUCTURES

from .dataset import CAMPBELL_GROUP, RESPONSE, tolerances_dataset
from .ranges import COLUMNS
from .table import ranges


def run(input: Any, output: Any, params: Any) -> None:
    """Run the members of a blade and scene. Inputs: campbell (of the nominal blade), models. Output: members (nc).

    Params: sweeps, speeds, structure, about, provenance, cores.
    """
    files = {**dict(zip(("contact_model", "stress_operator"), as_list(input.models), strict=False)), CAMPBELL: input.campbell}
    planned = {name: from_plain(BladeSweep, sweep) for name, sweep in params.sweeps.items()}
    sweeps = {name: replace(sweep, existing=files if sweep.existing else {}) for name, sweep in planned.items()}
    folder = Path(output.members).parent
    structures = folder.parents[1] / STRUCTURES
    driver = Driver(folder, structures, params.structure, partial(forked_results, params.cores))
    responses = driver.run(sweeps, from_plain(SharedSpeeds, params.speeds), input.campbell, params.about)

    def groups() -> Iterator[tuple[str, xr.Dataset]]:
        for name, response in responses.items():
            yield RESPONSE.format(name), read_dataset(response)
            yield CAMPBELL_GROUP.format(name), read_dataset(sweeps[name].file(CAMPBELL, structures, params.structure))

    write_groups(groups(), output.members, params.provenance)


def join(input: Any, output: Any, params: Any) -> None:
    """Join the members. Inputs: members, of each sample. Params: samples, numbers, fidelity. Output: dataset (nc)."""
    files = as_list(input.members)
    made = {"fidelity": params.fidelity, "input_hash": joined_hash(attributes_of(files))}
    dataset = tolerances_dataset(zip(params.samples, files, strict=True), params.numbers)
    write_dataset(dataset, output.dataset, made | origin("Members under tolerances"))


def table(input: Any, output: Any, params: Any) -> None:
    """List interactions with their ranges. Params: samples, choice. Output: table (csv).

    Inputs: members, of each sample, and nominal and nominal_campbells of the nominal runs.
    """
    choice = from_plain(InteractionChoice, params.choice)
    rows = []
    inputs = map(as_list, (input.members, input.nominal, input.nominal_campbells))
    for (blade, scene, names), file, *nominal in zip(params.samples, *inputs, strict=True):
        members, speeds = {}, (0.0, math.inf)
        for name in names:
            response = read_judged(file, RESPONSE.format(name))
            members[name] = find_interactions(response, read_dataset(file, group=CAMPBELL_GROUP.format(name)), choice)
            speeds = float(response["speed"][0]), float(response["speed"][-1])
        interactions = find_interactions(read_judged(nominal[0]), read_dataset(nominal[1]), choice)
        rows += [{"blade": blade, "scene": scene, **row} for row in ranges(interactions, members, choice, speeds)]
    write_table(pd.DataFrame(rows, columns=COLUMNS).astype({"engine_order": "Int64"}), output.table)
