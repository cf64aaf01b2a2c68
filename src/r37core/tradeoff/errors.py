"""Errors of all cases against the reference value of their parameter, and their costs, as one dataset."""

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
import xarray as xr

from r37core.base.dataset_file import about
from r37core.cases.table import case_table, energy_share
from r37core.results.measures import leading_edge

CONVERGING = {"rms_normal": "m", "rms_tangential": "m", "high_von_mises": "Pa"}
"""Name -> unit of what levels are judged by: rms of the leading edge, and the stress that a tenth of the instants exceed."""

MAXIMA = {"peak_normal": "m", "max_von_mises": "Pa"}
"""Largest values of a run, which 0.1% of friction moves as much as a level does."""

QUANTITIES = {**CONVERGING, **MAXIMA, "max_wear": "m"}
"""Name -> unit of the quantities of a run that are compared; stresses over the last revolution, the wear at the end."""

COSTS = {"cpu_s": "s", "wall_s": "s", "bytes_written": "1", "peak_memory_bytes": "1"}
COSTS_OF_MODEL = ("model_cpu_s", "model_peak_memory_bytes")

_DIMS = ("case", "scene", "speed_number")


def gather_cases(
    responses: Mapping[str, xr.Dataset], places: Mapping[str, Sequence[int]], references: Mapping[str, str]
) -> xr.Dataset:
    """All cases, with errors against the reference value of each parameter; NaN where a case was refused, with the reason.

    `responses` by `parameter/value__scene`, all values in all scenes; `places`: rows of their speeds that lie at each.
    `error(case, scene, at, quantity)`: relative difference of the means over the speeds of a place. `scatter`, same shape: root
    mean square of the relative differences at its single speeds. `peak_speed_error(case, scene)`: of the rms-weighted mean
    speed over `peak` and `jump`.
    """
    together = _values(responses, places)
    parameters, values, place = (together[name].values for name in ("parameter", "value", "place"))
    rows = [np.flatnonzero((parameters == name) & (values == references[name])).item() for name in parameters]
    compared = np.stack([together[name].values for name in QUANTITIES], axis=2)
    pairs = [_errors(compared[..., place == name], compared[rows][..., place == name]) for name in places]
    errors, scatters = (np.stack(several, axis=2) for several in zip(*pairs, strict=True))
    centre = _centre_of_peak(together)
    together = together.assign_coords(quantity=list(QUANTITIES), at=list(places))
    dims = (*_DIMS[:2], "at", "quantity")
    together["error"] = (dims, errors, about("1", "relative difference of means over neighbouring speeds"))
    what = "root mean square of the relative differences at the single speeds"
    together["scatter"] = (dims, scatters, about("1", what))
    what = "relative difference of the rms-weighted mean speed"
    together["peak_speed_error"] = (dims[:2], abs(centre / centre[rows] - 1.0), about("1", what))
    return together


def _values(responses: Mapping[str, xr.Dataset], places: Mapping[str, Sequence[int]]) -> xr.Dataset:
    """QUANTITIES over (case, scene, speed_number), costs over (case, scene), costs of the model over case."""
    cases, scenes = (list(dict.fromkeys(parts)) for parts in zip(*(name.rsplit("__", 1) for name in responses), strict=True))
    table = case_table(responses, partial(_numbers, rows=np.concatenate([*places.values()]).astype(int)))
    speeds = table["speed"].dropna().iloc[0]

    def values(name: str, *shape: int) -> np.ndarray:
        rows = [np.broadcast_to(np.asarray(row, float), shape) for row in table.get(name, [np.nan] * len(table))]
        return np.reshape(rows, (len(cases), len(scenes), *shape))

    data = {name: values(name, len(speeds)) for name in (*QUANTITIES, "status", "energy_residual")}
    data |= {name: values(name) for name in COSTS}
    units = {**QUANTITIES, **COSTS}
    parameters, texts = zip(*(case.split("/") for case in cases), strict=True)
    return xr.Dataset(
        {name: (_DIMS[: each.ndim], each, about(units.get(name, "1"), name.replace("_", " "))) for name, each in data.items()}
        | {name: ("case", values(name)[:, -1]) for name in COSTS_OF_MODEL}
        | {"refused": (_DIMS[:2], table["refused"].to_numpy(object).reshape(len(cases), len(scenes)))},
        {
            "scene": scenes,
            "place": ("speed_number", [place for place, several in places.items() for _ in several]),
            "speed": ("speed_number", speeds, about("rad s-1", "angular speed of the rotor")),
            "parameter": ("case", list(parameters)),
            "value": ("case", list(texts)),
        },
    )


def _numbers(response: xr.Dataset, rows: np.ndarray) -> dict[str, Any]:
    """QUANTITIES, status and open energy balance at the speeds of some rows, and mean costs of a run."""
    edge = leading_edge(response.isel(speed=rows))
    if "max_von_mises_of_instant" in edge:
        edge = edge.assign(high_von_mises=edge["max_von_mises_of_instant"].quantile(0.9, "instant"))
    values = {name: edge[name].values for name in ("speed", *QUANTITIES, "status") if name in edge}
    costs = {name: float(edge[name].mean()) for name in COSTS if name in edge}
    return {**values, "energy_residual": energy_share(edge), **costs}


def _errors(ours: np.ndarray, theirs: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Error and scatter over the last axis; NaN where the reference has nothing."""
    mean, positive = theirs.mean(axis=-1), np.all(theirs > 0.0, axis=-1, keepdims=True)
    error = abs(ours.mean(axis=-1) / np.where(mean > 0.0, mean, np.nan) - 1.0)
    return error, np.sqrt(np.mean((ours / np.where(positive, theirs, np.nan) - 1.0) ** 2, axis=-1))


def _centre_of_peak(cases: xr.Dataset) -> np.ndarray:
    """Mean speeds (rad/s) over peak and jump, weighted with the squared rms: smooth where the largest one jumps.

    Shape (cases, scenes).
    """
    rows = np.isin(cases["place"].values, ["peak", "jump"])
    weight = np.compress(rows, cases["rms_normal"].values ** 2 + cases["rms_tangential"].values ** 2, axis=-1)
    return (cases["speed"].values[rows] * weight).sum(axis=-1) / weight.sum(axis=-1)
