"""Steps of the workflow (docs/architecture.md): what a run gives of all blades, tolerances included."""

from __future__ import annotations

from typing import Any

from r37core.dataset_file import read_dataset
from r37core.io import write_json
from r37core.plain import from_plain
from r37core.results.datasets import response_of
from r37core.results.interactions import InteractionChoice, summarise
from r37core.results.ranking import ranking_table, robustness
from r37core.results.table_file import write_table
from r37core.tolerances.dataset import measures_of_members
from r37core.tolerances.table import read_ranges, with_ranges


def configuration(input: Any, output: Any, params: Any) -> None:
    """Keep what a run is made with. Params: merged. Output: configuration (json)."""
    write_json(params.merged, output.configuration)


def summary(input: Any, output: Any, params: Any) -> None:
    """List the interactions. Inputs: datasets by kind and, if there, tolerances. Params: choice. Output: table (csv)."""
    files = dict(input.items())
    ranges = files.pop("tolerances", None)
    datasets = {kind: read_dataset(file) for kind, file in files.items()}
    table = summarise(datasets, from_plain(InteractionChoice, params.choice))
    if ranges:
        table = with_ranges(table, read_ranges(ranges))
    write_table(table, output.table)


def ranking(input: Any, output: Any, params: Any) -> None:
    """Rank the blades. Inputs: datasets by kind and, if there, tolerances. Params: runs. Output: table (csv)."""
    datasets = {kind: read_dataset(file) for kind, file in input.items()}
    members = measures_of_members(datasets.pop("tolerances")) if "tolerances" in datasets else None
    found = {(blade, scene): robustness(response_of(datasets, blade, scene)) for blade, scene in params.runs}
    write_table(ranking_table(found, members), output.table, digits=6)
