"""Steps of the workflow (docs/architecture.md): a search, round by round, and what is made of all its designs."""

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from r37core.base.dataset_file import write_dataset
from r37core.base.io import JOB_NEWS
from r37core.base.origin import origin
from r37core.base.varied_number import BLADE, VariedNumber
from r37core.blade.geometry_file import read_geometry
from r37core.exchange.step_file import write_step
from r37core.results.table_file import write_table
from r37core.sweep.forks import forked_results

from .dataset import BLADES_HEADER, SCENES_HEADER, search_dataset, search_table, write_entries
from .designs import choice_of
from .evaluation import Evaluation
from .problem import START
from .rounds import SearchRound, first_round, progress, round_after, tried_after


def search(input: Any, output: Any, params: Any) -> None:
    """Search for designs, round by round. Outputs: dataset (nc), table (csv), best (folder).

    Params: carried (the settings), budget (designs of each round), fidelity, number, entries, scenes, varied_in_scenes (see
    `_write_best`), cores.
    """
    settings, folder = params.carried.settings, Path(output.best).parent
    choice, run_all = choice_of(settings), partial(forked_results, params.cores)
    evaluation = Evaluation(settings, folder, run_all, params.cores)
    asked = first_round(params.budget[0], choice)
    for number, count in enumerate([*params.budget[1:], 0], 1):
        JOB_NEWS.info(progress(asked, choice, number - 1))
        asked = _after(asked, number, count, evaluation)
    JOB_NEWS.info(progress(asked, choice, len(params.budget)))
    dataset = search_dataset(asked, choice)
    provenance = {"fidelity": params.fidelity, "input_hash": asked.digest} | origin("Designs of a search")
    write_dataset(dataset, output.dataset, provenance)
    write_table(search_table(dataset), output.table, digits=6)
    _write_best(dataset, asked, evaluation, params, Path(output.best))


def _after(before: SearchRound, number: int, count: int, evaluation: Evaluation) -> SearchRound:
    """The round of `count` designs after one whose designs are evaluated now."""
    start: dict[str, Sequence[float] | None] = {} if before.start else {START: None}
    gave = dict(zip([*start, *before.new], evaluation.quantities({**start, **before.new}), strict=True))
    of_start = gave.pop(START, before.start)
    if isinstance(of_start, str):
        # what is wrong with the start is no result
        raise ValueError(of_start)
    refused = {name: reason for name, reason in gave.items() if isinstance(reason, str)}
    done = {name: values for name, values in gave.items() if not isinstance(values, str)}
    return round_after(tried_after(before, number, refused, done), of_start, count, choice_of(evaluation.settings))


def _write_best(search: xr.Dataset, last: SearchRound, evaluation: Evaluation, params: Any, folder: Path) -> None:
    """Write the best designs. `params`: number; entries, of the start and its bases, where its blade varies; scenes, entries
    where they vary, and varied_in_scenes, by which variables.
    """
    ordered = search.isel(design=np.flatnonzero(search["order"].values > 0)).sortby("order")
    designs = ordered["design"].values[: params.number].tolist()
    folder.mkdir(parents=True)
    if params.scenes:
        scenes = params.scenes, params.varied_in_scenes
        write_entries(search, designs, *scenes, SCENES_HEADER, folder / "scenes.yaml")
    if params.entries:
        numbers = map(VariedNumber.named, search["variable"].values.tolist())
        varied = {list(params.entries)[-1]: [number.key for number in numbers if number.kind == BLADE]}
        names = write_entries(search, designs, params.entries, varied, BLADES_HEADER, folder / "blades.yaml")
        for name, design in zip(names, designs, strict=True):
            write_step(read_geometry(evaluation.geometry(design, last.tried[design].values)), folder / f"{name}.step")
