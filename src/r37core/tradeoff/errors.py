"""Errors of all cases against the reference value of their parameter, and their costs, as one dataset."""

from collections.abc import Mapping, Sequence

import numpy as np
import xarray as xr

from r37core.base.dataset_file import about
from r37core.cases.runner import energy_share
from r37core.results.measures import leading_edge

CONVERGING = {"rms_normal": "m", "rms_tangential": "m", "high_von_mises": "Pa"}
"""Name -> unit of what levels are judged by: rms of the leading edge, and the stress that a tenth of the instants exceed."""

MAXIMA = {"peak_normal": "m", "max_von_mises": "Pa"}
"""Largest values of a run, which 0.1% of friction moves as much as a level does."""

QUANTITIES = {**CONVERGING, **MAXIMA, "max_wear": "m"}
"""What is compared of every run, name -> unit; stresses over the last revolution, the wear at the end."""

COSTS = {"cpu_s": "s", "wall_s": "s", "bytes_written": "1", "peak_memory_bytes": "1"}
COSTS_OF_MODEL = ("model_cpu_s", "model_peak_memory_bytes")


def gather_cases(
    responses: Mapping[str, xr.Dataset], places: Mapping[str, Sequence[int]], references: Mapping[str, str]
) -> xr.Dataset:
    """All cases, with errors against the reference value of each parameter; NaN where a case was refused, with the reason.

    `responses` by `parameter/value__scene`; `places`: rows of their speeds that lie at each.
    `error(case, scene, at, quantity)`: relative difference of the means over the speeds of a place. `scatter`, same shape: root
    mean square of the relative differences at its single speeds. `peak_speed_error(case, scene)`: of the rms-weighted mean
    speed over `peak` and `jump`.
    """
    together = _values(responses, places)
    parameters, values = together["parameter"].values, together["value"].values
    rows = [np.flatnonzero((parameters == name) & (values == references[name])).item() for name in parameters]
    theirs = together.isel(case=rows)
    errors, scatters = zip(*(compare(together, theirs, place) for place in places), strict=True)
    speed_error = abs(centre_of_peak(together) / centre_of_peak(theirs) - 1.0)
    together = together.assign_coords(quantity=list(QUANTITIES), at=list(places))
    dims = ("case", "scene", "at", "quantity")
    together["error"] = (dims, np.stack(errors, axis=2), about("1", "relative difference of means over neighbouring speeds"))
    what = "root mean square of the relative differences at the single speeds"
    together["scatter"] = (dims, np.stack(scatters, axis=2), about("1", what))
    together["peak_speed_error"] = (dims[:2], speed_error, about("1", "relative difference of the rms-weighted mean speed"))
    return together


def _values(responses: Mapping[str, xr.Dataset], places: Mapping[str, Sequence[int]]) -> xr.Dataset:
    """QUANTITIES over (case, scene, speed_number), costs over (case, scene), costs of the model over case."""
    names = {name: name.rsplit("__", 1) for name in responses}
    cases, scenes = (list(dict.fromkeys(parts)) for parts in zip(*names.values(), strict=True))
    rows = np.concatenate([np.asarray(several, dtype=int) for several in places.values()])
    speeds = next(response["speed"].values[rows] for response in responses.values() if response.sizes["speed"])
    dims = ("case", "scene", "speed_number")
    shape = (len(cases), len(scenes), len(speeds))
    data = {name: np.full(shape, np.nan) for name in (*QUANTITIES, "status", "energy_residual")}
    data |= {name: np.full(shape[:2], np.nan) for name in COSTS}
    model_error = {name: np.full(shape[:1], np.nan) for name in COSTS_OF_MODEL}
    refused = np.full(shape[:2], "", dtype=object)
    for name, (case, scene) in names.items():
        response, index = responses[name], (cases.index(case), scenes.index(scene))
        refused[index] = response.attrs.get("refused", "")
        for cost in COSTS_OF_MODEL:
            model_error[cost][index[0]] = response.attrs.get(cost, np.nan)
        if not refused[index]:
            response = response.isel(speed=rows)
            edge = leading_edge(response)
            if "max_von_mises_of_instant" in edge:
                edge = edge.assign(high_von_mises=edge["max_von_mises_of_instant"].quantile(0.9, "instant"))
            for quantity in {*QUANTITIES, "status"} & set(map(str, edge.data_vars)):
                data[quantity][index] = edge[quantity].values
            data["energy_residual"][index] = energy_share(response)
            for cost in COSTS:
                data[cost][index] = response[cost].mean() if cost in response else response.attrs[cost]
    units = {**QUANTITIES, **COSTS}
    together = xr.Dataset(
        {name: (dims[: array.ndim], array, about(units.get(name, "1"), name.replace("_", " "))) for name, array in data.items()}
        | {name: ("case", array) for name, array in model_error.items()}
        | {"refused": (dims[:2], refused)},
        {"scene": scenes, "place": ("speed_number", [place for place, several in places.items() for _ in several])},
    )
    parameters, values = zip(*(case.split("/") for case in cases), strict=True)
    speed = ("speed_number", speeds, about("rad s-1", "angular speed of the rotor"))
    return together.assign_coords(speed=speed, parameter=("case", list(parameters)), value=("case", list(values)))


def compare(ours: xr.Dataset, theirs: xr.Dataset, place: str) -> tuple[np.ndarray, np.ndarray]:
    """Errors and scatter at one place, shape (cases, scenes, QUANTITIES); NaN where the reference has nothing."""
    rows = ours["place"].values == place
    errors, scatters = [], []
    for name in QUANTITIES:
        x, y = (np.compress(rows, each[name].values, axis=-1) for each in (ours, theirs))
        mean, positive = y.mean(axis=-1), np.all(y > 0.0, axis=-1, keepdims=True)
        errors.append(abs(x.mean(axis=-1) / np.where(mean > 0.0, mean, np.nan) - 1.0))
        scatters.append(np.sqrt(np.mean((x / np.where(positive, y, np.nan) - 1.0) ** 2, axis=-1)))
    return np.stack(errors, axis=-1), np.stack(scatters, axis=-1)


def centre_of_peak(cases: xr.Dataset) -> np.ndarray:
    """Mean speeds (rad/s) over peak and jump, weighted with the squared rms: smooth where the largest one jumps.

    Shape (cases, scenes).
    """
    rows = np.isin(cases["place"].values, ["peak", "jump"])
    weight = np.compress(rows, cases["rms_normal"].values ** 2 + cases["rms_tangential"].values ** 2, axis=-1)
    return (cases["speed"].values[rows] * weight).sum(axis=-1) / weight.sum(axis=-1)
