"""The table of cases: a row for each, from which the tables of the presets follow."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from r37core.base.dataset_file import SPEED


def refusal(reason: str) -> xr.Dataset:
    """A response without speeds, whose attribute `refused` has the reason, without its remedies."""
    return xr.Dataset(coords={"speed": ("speed", np.empty(0), SPEED.attributes)}, attrs={"refused": reason.split(";")[0]})


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
