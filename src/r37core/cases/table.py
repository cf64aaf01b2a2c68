"""The table of cases: a row for each, from which the tables of the extensions follow."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from r37core.base.dataset_file import read_dataset
from r37core.base.io import as_list


def read_cases(input: Any, output: Any) -> dict[str, xr.Dataset]:
    """Responses of all cases by name. Input: cases, their files, in the folder that is called like the output `table`."""
    folder = Path(output.table).with_suffix("")
    return {str(Path(file).relative_to(folder).with_suffix("")): read_dataset(file) for file in as_list(input.cases)}


def case_table(responses: Mapping[str, xr.Dataset], numbers: Callable[[xr.Dataset], Mapping[str, Any]]) -> pd.DataFrame:
    """A row for each case, by its name: attributes of its response, among them its costs, and `numbers` of what was run.

    `refused`: reason of a case that was not run, which has no numbers; else empty.
    """
    rows = [
        {"refused": "", **response.attrs, **({} if "refused" in response.attrs else numbers(response))}
        for response in responses.values()
    ]
    return pd.DataFrame(rows, index=list(responses))


def energy_share(response: xr.Dataset) -> np.ndarray:
    """Part of the energy balance that stays open, as a share of all that went in and out, shape (speeds,)."""
    turned_over = np.abs(response["contact_work"].values) + response["damping_loss"].values
    residual = response["energy_residual"].values
    return np.divide(residual, turned_over, out=np.zeros_like(residual), where=turned_over > 0.0)
