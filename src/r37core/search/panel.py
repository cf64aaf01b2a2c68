"""Panel of a search in the explorer: objectives against each other, all numbers of each design, and the best ones."""

import math

import numpy as np
import xarray as xr

from r37core.base.units import shown_unit


def search_contents(search: xr.Dataset) -> dict[str, object]:
    """Numbers of each design of `search.nc` in the units that are shown; None for what is not known."""
    return {
        "designs": [str(name) for name in search["design"].values],
        "objectives": [_quantity(search, "objective", name) for name in search["objective"].values],
        "constraints": [_quantity(search, "constraint", name) for name in search["constraint"].values],
        "variables": [
            {"label": broken_key(str(key)), "values": _numbers(search["value"].sel(variable=key).values)}
            for key in search["variable"].values
        ],
        "feasible": search["feasible"].values.astype(bool).tolist(),
        "front": search["not_dominated"].values.astype(bool).tolist(),
        "order": search["order"].values.tolist(),
        "round": search["round"].values.tolist(),
        "refused": [str(reason) for reason in search["refused"].values],
    }


def _quantity(search: xr.Dataset, kind: str, name: str) -> dict[str, object]:
    chosen = search.sel({kind: name})
    unit, factor = shown_unit(chosen[f"{kind}_unit"].item())
    scatter = {"scatter": _numbers(factor * chosen["objective_scatter"].values)} if kind == "objective" else {}
    return {"label": unit_label(str(name), unit), "values": _numbers(factor * chosen[f"{kind}_value"].values), **scatter}


def _numbers(values: np.ndarray) -> list[float | None]:
    return [float(f"{value:.5g}") if math.isfinite(value) else None for value in values.tolist()]


_LONGEST = 14
"""Characters of a name in one line."""


def unit_label(name: str, unit: str) -> str:
    """A quantity's name with the unit it is shown in."""
    return f"{name} ({unit})" if unit else name


def broken_key(key: str) -> str:
    """A dotted key; a long one with its last part in a second line."""
    before, dot, last = key.rpartition(".")
    return key if len(key) <= _LONGEST or not dot else f"{before}.\n{last}"
