"""The results of a finished run of the workflow, from its folder."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property
from pathlib import Path

import pandas as pd
import xarray as xr

from r37core.dataset_file import read_dataset
from r37core.io import InputFileError
from r37core.results.ranking import read_ranking
from r37core.results.table_file import read_table


class RunResults(Mapping[str, xr.Dataset]):
    """Datasets of a run by name (campbell, rms, spectrum, stress, wear, ...), each read when it is first asked for."""

    def __init__(self, folder: Path):
        self.folder = folder
        self._read: dict[str, xr.Dataset] = {}

    def __getitem__(self, name: str) -> xr.Dataset:
        if name not in set(self):
            raise KeyError(f"found '{name}'; allowed: {', '.join(self)} (datasets in {self.folder})")
        if name not in self._read:
            self._read[name] = read_dataset(self.folder / f"{name}.nc")
        return self._read[name]

    def __iter__(self) -> Iterator[str]:
        return iter(sorted(file.stem for file in self.folder.glob("[!.]*.nc")))

    def __len__(self) -> int:
        return len(list(iter(self)))

    def __repr__(self) -> str:
        return f"RunResults({str(self.folder)!r}): {', '.join(self)}"

    @cached_property
    def summary(self) -> pd.DataFrame:
        """summary.csv: one row per interaction. Raises InputFileError where it cannot be read."""
        return read_table(self.folder / "summary.csv")

    @cached_property
    def ranking(self) -> pd.DataFrame:
        """ranking.csv: one row per blade and scene, the best blade first. Raises InputFileError where it cannot be read."""
        return read_ranking(self.folder / "ranking.csv")

    def response(self, blade: str, scene: str) -> xr.Dataset:
        """response.nc of one blade in one scene, as `r37.sweep` gives it. Raises InputFileError where it cannot be read."""
        return read_dataset(self.folder / blade / scene / "response.nc")


def open_results(folder: Path | str) -> RunResults:
    """The results of a run: `results`, or `results/runs/<name>`. Raises InputFileError for a folder without datasets."""
    if not Path(folder).is_dir():
        raise InputFileError(f"{folder}: there is no such folder; results of a run lie in results/ or results/runs/<name>/")
    results = RunResults(Path(folder))
    if not results:
        raise InputFileError(f"{folder}: there are no datasets (campbell.nc, rms.nc, ...); make them with: make all_blades")
    return results
