"""Tables of the trade-off: errors of all cases against the reference value of their parameter, levels, growth of costs."""

from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from r37core.base.dataset_file import about, read_dataset
from r37core.base.origin import origin
from r37core.config.fidelity import recommended_level
from r37core.results.measures import leading_edge
from r37core.results.table_file import read_table

from .case import LEVEL
from .case_table import case_table, energy_share

CONVERGING = {"rms_normal": "m", "rms_tangential": "m", "high_von_mises": "Pa"}
"""Name -> unit of what levels are judged by: rms of the leading edge, and the stress that a tenth of the instants exceed."""

MAXIMA = {"peak_normal": "m", "max_von_mises_last_revolution": "Pa"}
"""Largest values of a run, which 0.1% of friction moves as much as a level does."""

QUANTITIES = {**CONVERGING, **MAXIMA, "max_wear": "m"}
"""Name -> unit of the quantities of a run that are compared; stresses over the last revolution, the wear at the end."""

COSTS = {"cpu_s": "s", "wall_s": "s", "bytes_written": "1", "peak_memory_bytes": "1"}
COSTS_OF_MODEL = ("model_cpu_s", "model_peak_memory_bytes")

_DIMS = ("case", "scene", "speed_number")


def tables(
    responses: Mapping[str, xr.Dataset],
    places: Mapping[str, Sequence[int]],
    references: Mapping[str, str],
    tolerance: float,
    about_run: Mapping[str, str],
) -> dict[str, xr.Dataset | pd.DataFrame]:
    """Dataset of all cases, and the tables of the parameters, the levels and the growth; arguments as of tradeoff.values."""
    together = gather_cases(responses, places, references)
    table = parameter_table(together, references)
    attributes = origin("Accuracy over cost") | dict(about_run)
    levels, growth = level_table(table, tolerance), growth_table(table)
    return {"dataset": together.assign_attrs(attributes), "table": table, "levels": levels, "growth": growth}


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
    # smooth where the largest one jumps
    near = np.isin(place, ["peak", "jump"])
    weight = np.compress(near, together["rms_normal"].values ** 2 + together["rms_tangential"].values ** 2, axis=-1)
    centre = (together["speed"].values[near] * weight).sum(axis=-1) / weight.sum(axis=-1)
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


def parameter_table(together: xr.Dataset, references: Mapping[str, str]) -> pd.DataFrame:
    """One row for each value of each parameter in each scene: errors at the peak and off resonance, and costs.

    Errors are relative differences of means over neighbouring speeds from the reference value of the parameter. A value that
    was refused has the reason in `refused`, and no numbers.
    """
    peak, off = (together["error"].sel(at=place, drop=True) for place in ("peak", "off_resonance"))
    columns = {
        "parameter": together["parameter"],
        "value": together["value"],
        "reference": ("case", [references[name] for name in together["parameter"].values]),
        "scene": together["scene"],
        "refused": together["refused"],
        **{f"error_{name}": peak.sel(quantity=name, drop=True) for name in QUANTITIES},
        "error_peak_speed": together["peak_speed_error"],
        "error_rms_normal_off_resonance": off.sel(quantity="rms_normal", drop=True),
        **{name: together[name] for name in (*COSTS, *COSTS_OF_MODEL)},
    }
    table = xr.Dataset(columns).to_dataframe(dim_order=["case", "scene"])
    return table.reset_index()[list(columns)]


def level_table(table: pd.DataFrame, tolerance: float) -> pd.DataFrame:
    """The fidelity levels: largest error at the peak over scenes, costs, and which one is the cheapest within the tolerance."""
    levels = table[table["parameter"] == LEVEL].groupby("value", sort=False)
    errors, largest = (levels[[f"error_{name}" for name in several]].max().max(axis=1) for several in (CONVERGING, MAXIMA))
    costs = levels["cpu_s"].mean()
    best = recommended_level(errors.dropna().to_dict(), costs.to_dict(), tolerance)
    columns = {
        "level": list(errors.index),
        "reference": levels["reference"].first(),
        "error": errors,
        "error_of_largest_values": largest,
        "cpu_s_per_run": costs,
        "model_cpu_s": levels["model_cpu_s"].first(),
        "tolerance": tolerance,
        "recommended": ["yes" if name == best else "no" for name in errors.index],
    }
    return pd.DataFrame(columns, index=errors.index)


PAIRS = (
    ("mesh_nodes", "model_cpu_s", "making the model"),
    ("mesh_nodes", "model_peak_memory_bytes", "memory of making the model"),
    ("fixed_interface_modes", "cpu_s", "one run"),
    ("boundary_nodes", "cpu_s", "one run"),
    ("boundary_nodes", "model_cpu_s", "making the model"),
    ("revolutions", "cpu_s", "one run"),
    ("revolutions", "bytes_written", "file of one run"),
    ("central_difference_step", "cpu_s", "one run"),
    ("exact_modal_step", "cpu_s", "one run"),
)
"""Parameter, cost, and what the cost is of."""

COLUMNS = ("parameter", "cost", "of", "first_value", "last_value", "first_cost", "last_cost", "exponent")


def growth_table(table: pd.DataFrame) -> pd.DataFrame:
    """First and last value and cost of each pair of parameter and cost, and the exponent of a power law between them."""
    rows = []
    for parameter, cost, purpose in PAIRS:
        costs = costs_of(table, parameter, cost)
        if len(costs) >= 3:
            values, several = costs.index.to_numpy(), costs.to_numpy()
            ends = (values[0], values[-1], several[0], several[-1])
            rows.append((parameter, cost, purpose, *ends, exponent_of(values, several)))
    return pd.DataFrame(rows, columns=list(COLUMNS))


def costs_of(table: pd.DataFrame, parameter: str, cost: str) -> pd.Series:
    """Mean cost over the scenes by ascending value of a parameter, as far as they are known and positive."""
    rows = table[table["parameter"] == parameter]
    costs = rows.groupby(rows["value"].astype(float))[cost].mean().sort_index()
    return costs[(costs > 0.0) & (costs.index > 0.0)]


def exponent_of(values: np.ndarray, costs: np.ndarray) -> float:
    """Slope of log cost over log value, by least squares over the more expensive half: what is fixed dominates small cases."""
    largest = np.argsort(costs)[-max(3, (len(costs) + 1) // 2) :]
    return float(np.polyfit(np.log(values[largest]), np.log(costs[largest]), 1)[0])


def closing(results: Path) -> str:
    """The recommended level, and which parameters were left out."""
    levels, attributes = read_table(results / "tradeoff_levels.csv"), read_dataset(results / "tradeoff.nc").attrs
    left_out = f"; left out: {attributes['left_out']}" if attributes["left_out"] else ""
    if levels.empty:
        return f"no levels were compared{left_out}"
    best, first = levels[levels["recommended"] == "yes"], levels.iloc[0]
    within = f"within the tolerance of {100 * first['tolerance']:g}%"
    if best.empty:
        nearest = f"{100 * levels['error'].min():.1f}%"
        return f"no level is {within}: the best differs by {nearest} from {first['reference']}{left_out}"
    row = best.iloc[0]
    return f"cheapest level {within} of {row['reference']}: {row['level']}, {100 * row['error']:.1f}%{left_out}"
