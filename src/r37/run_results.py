"""The results of a run of the workflow, from its folder, or of a call that makes the same."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import Generic, TypeVar

import pandas as pd
import xarray as xr

from r37core.base.dataset_file import lazy_dataset, read_dataset
from r37core.base.io import InputFileError
from r37core.base.varied_number import BLADE, SCENE, values_of
from r37core.config.messages import did_you_mean
from r37core.results.ranking import read_ranking
from r37core.results.table_file import read_table

from .stages import stages

Content = TypeVar("Content")


class FilesByName(Mapping[str, Content], Generic[Content]):
    """Files of a folder by their names without `suffix`, each read when it is first asked for; `kind`: for messages.

    `temporary`: the folder of what a call has made, which is gone with the last object that holds it.
    """

    def __init__(self, folder: Path, suffix: str, kind: str, read: Callable[[Path], Content], temporary: object = None):
        self._folder, self._suffix, self._kind, self._read, self._temporary = folder, suffix, kind, cache(read), temporary

    def __getitem__(self, name: str) -> Content:
        if name not in set(self):
            raise KeyError(
                f"found '{name}'; allowed: {', '.join(self)} ({self._kind} in {self._folder}){did_you_mean(name, self)}"
            )
        return self._read(self._folder / f"{name}{self._suffix}")

    def __iter__(self) -> Iterator[str]:
        return iter(sorted(file.stem for file in self._folder.glob(f"[!.]*{self._suffix}")))

    def __len__(self) -> int:
        return len(list(iter(self)))

    def __repr__(self) -> str:
        return f"{type(self).__name__}({str(self._folder)!r}): {', '.join(self)}"


class RunResults(FilesByName[xr.Dataset]):
    """Datasets of a run by name (campbell, rms, stress, wear, run_ups, rotor, tolerances, search, ...), and its `tables`.

    Each file is read at its first use. `folder` has the files; a temporary one is deleted with this object and its `tables`.
    An unknown name raises KeyError.
    """

    def __init__(self, folder: Path, temporary: object = None):
        super().__init__(folder, ".nc", "datasets, next to results.tables,", read_dataset, temporary)
        self.folder = folder
        self.tables = FilesByName(folder, ".csv", "tables", _table, temporary)
        """Tables by name (summary, ranking, designs, run_ups, run_up_rates, rotors, tolerances, search, coincidences)."""

    @property
    def summary(self) -> pd.DataFrame:
        """summary.csv: one row per interaction. Raises KeyError without one, InputFileError where it cannot be read."""
        return self.tables["summary"]

    @property
    def ranking(self) -> pd.DataFrame:
        """ranking.csv: one row per blade and scene, the best blade first. Raises as `summary` does."""
        return self.tables["ranking"]

    def response(self, blade: str, scene: str) -> xr.Dataset:
        """response.nc of one blade in one scene, as `r37.sweep` gives it. Raises InputFileError where it cannot be read."""
        return read_dataset(self.folder / blade / scene / "response.nc")

    def signals(self, blade: str, scene: str) -> xr.Dataset:
        """signals.nc of one blade in one scene: samples over time. Raises InputFileError where it cannot be read."""
        return read_dataset(self.folder / blade / scene / "signals.nc")

    def rotor(self, blade: str, scene: str) -> xr.Dataset:
        """rotor.nc of one blade in one scene. Raises InputFileError where it cannot be read."""
        return read_dataset(self.folder / blade / scene / "rotor.nc")

    def best_values(self) -> dict[str, float]:
        """Variables of the best blade of a search, as in `r37.blade("Ref", name="Better", **results.best_values())`.

        Raises KeyError for results without a search, ValueError where no design keeps all constraints.
        """
        return values_of(BLADE, self._best())

    def best_scene_values(self) -> dict[str, float]:
        """Variables of scenes of the best design of a search, for `r37.scene`, as `best_values` has those of its blade.

        Raises KeyError and ValueError as `best_values` does.
        """
        return values_of(SCENE, self._best())

    def _best(self) -> dict[str, float]:
        search = self["search"]
        best = search["value"].values[search["order"].values == 1]
        if not len(best):
            raise ValueError(f"search: no design of {self.folder} keeps all constraints; the table search has what each gave")
        return dict(zip(search["variable"].values.tolist(), best[0].tolist(), strict=True))

    def tree(self) -> xr.DataTree:
        """All datasets of the run as one tree: those of all blades at the top, `Ref/campbell`, `Ref/abradable/response` below.

        Values are read when they are used. Raises InputFileError for a file that cannot be read.
        """
        names = [f"{name}.nc" for name in self]
        kinds = ("*/campbell.nc", "*/*/response.nc", "*/*/rotor.nc", "*/*/signals.nc")
        below = [file for pattern in kinds for file in self.folder.glob(pattern)]
        files = [*(self.folder / name for name in names), *sorted(below)]
        return xr.DataTree.from_dict({str(file.relative_to(self.folder).with_suffix("")): lazy_dataset(file) for file in files})


def _table(file: Path) -> pd.DataFrame:
    return read_ranking(file) if file.stem == "ranking" else read_table(file)


@stages()
def open_results(folder: Path | str) -> RunResults:
    """Results of a finished run of the workflow.

    Args:
        folder: Folder of the run: `results`, or `results/runs/<name>`.

    Returns:
        Datasets by name, `tables` by name, each `response`, and all datasets as a `tree`.

    Raises:
        InputFileError: For a folder without datasets.

    Examples:
        >>> results = r37.open_results("results")
        >>> list(results)
        ['campbell', 'rms', 'spectrum', 'stress', 'wear']
        >>> list(results.tables)
        ['ranking', 'summary']
        >>> results.tree()["Ref/abradable/response"].sizes["speed"]
        3
    """
    if not isinstance(folder, str | os.PathLike):
        raise InputFileError(f"results: found {folder!r}; allowed: the folder of a run, such as results")
    if not os.path.isdir(folder):
        raise InputFileError(f"{folder}: there is no such folder; results of a run lie in results/ or results/runs/<name>/")
    results = RunResults(Path(folder))
    if not results:
        raise InputFileError(f"{folder}: there are no datasets (campbell.nc, rms.nc, ...); make them with: make all_blades")
    return results
