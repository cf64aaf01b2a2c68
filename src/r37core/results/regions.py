"""The region of the stress that decides. Where a dataset of responses is read, all but it is left aside."""

from pathlib import Path

import numpy as np
from xarray import Dataset

from r37core.base.dataset_file import read_dataset


def judged(dataset: Dataset) -> Dataset:
    """The dataset with the stress of its first region alone, the one that decides, without the dimension `region`."""
    return dataset.isel(region=0, drop=True) if "region" in dataset.dims else dataset


def read_judged(file: Path | str, group: str | None = None) -> Dataset:
    """The dataset of a file or its group, with the judged region alone. Raises InputFileError where it cannot be read."""
    return judged(read_dataset(file, group=group))


def other_regions(dataset: Dataset) -> list[str]:
    """Names of the regions that do not decide, as far as the dataset has stress there."""
    if "region" not in dataset.dims:
        return []
    known = dataset["max_von_mises_ever"].notnull().any([dim for dim in dataset["max_von_mises_ever"].dims if dim != "region"])
    return [str(name) for name in dataset["region"].values[1:][np.asarray(known)[1:]]]
