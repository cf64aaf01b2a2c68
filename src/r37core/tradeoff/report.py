"""What accuracy costs: one parameter at a time against a fine value of it; and how cost grows with each."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from r37core.config.fidelity import recommended_level
from r37core.dataset_file import about
from r37core.figures import style
from r37core.results.measures import leading_edge

from ..checks import energy_share
from ..tables import markdown_table
from .cases import LEVEL

CONVERGING = {"rms_normal": "m", "rms_tangential": "m", "high_von_mises": "Pa"}
"""Name -> unit of what levels are judged by: rms of the leading edge, and the stress that a tenth of the instants exceed."""

MAXIMA = {"peak_normal": "m", "max_von_mises": "Pa"}
"""Largest values of a run, which 0.1% of friction moves as much as a level does."""

QUANTITIES = {**CONVERGING, **MAXIMA, "max_wear": "m"}
"""What is compared of every run, name -> unit; stresses over the last revolution, the wear at the end."""

_HIGH = 0.9

COSTS = {"cpu_s": "s", "wall_s": "s", "bytes_written": "1", "peak_memory_bytes": "1"}
_OF_THE_MODEL = ("model_cpu_s", "model_peak_memory_bytes")
_FLOOR = 1e-7

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


def report(responses: Mapping[str, xr.Dataset], files: Any, values: Mapping[str, Any]) -> dict[str, Any]:
    """All numbers, the tables of parameters, levels and growth, and figures."""
    references = values["references"]
    together = gather_cases(responses, values["places"], references)
    growing = growths(together)
    made = {
        "dataset": together.assign_attrs({name: values[name] for name in ("blade", "base_level")}),
        "levels": level_table(together, values["tolerance"]),
        "table": parameter_tables(together, references),
        "growth": growth_table(growing),
        "growth_figure": draw_growth(growing),
        "pareto": draw_pareto(together),
    }
    return made | {f"of_{parameter}": draw_parameter(together, parameter) for parameter in references}


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
    of_model = {name: np.full(shape[:1], np.nan) for name in _OF_THE_MODEL}
    refused = np.full(shape[:2], "", dtype=object)
    for name, (case, scene) in names.items():
        response, at = responses[name], (cases.index(case), scenes.index(scene))
        refused[at] = response.attrs.get("refused", "")
        for cost in _OF_THE_MODEL:
            of_model[cost][at[0]] = response.attrs.get(cost, np.nan)
        if not refused[at]:
            response = response.isel(speed=rows)
            edge = leading_edge(response)
            if "max_von_mises_of_instant" in edge:
                edge = edge.assign(high_von_mises=edge["max_von_mises_of_instant"].quantile(_HIGH, "instant"))
            for quantity in {*QUANTITIES, "status"} & set(map(str, edge.data_vars)):
                data[quantity][at] = edge[quantity].values
            data["energy_residual"][at] = energy_share(response)
            for cost in COSTS:
                data[cost][at] = response[cost].mean() if cost in response else response.attrs[cost]
    units = {**QUANTITIES, **COSTS}
    together = xr.Dataset(
        {name: (dims[: array.ndim], array, about(units.get(name, "1"), name.replace("_", " "))) for name, array in data.items()}
        | {name: ("case", array) for name, array in of_model.items()}
        | {"refused": (dims[:2], refused)},
        {"scene": scenes, "place": ("speed_number", [place for place, several in places.items() for _ in several])},
    )
    parameters, values = zip(*(case.split("/") for case in cases), strict=True)
    speed = ("speed_number", speeds, about("rad s-1", "angular speed of the rotor"))
    return together.assign_coords(speed=speed, parameter=("case", list(parameters)), value=("case", list(values)))


def compare(ours: xr.Dataset, theirs: xr.Dataset, place: str) -> tuple[np.ndarray, np.ndarray]:
    """Errors and scatter at one place, shape (cases, scenes, QUANTITIES); NaN where the reference has nothing."""
    at = ours["place"].values == place
    errors, scatters = [], []
    for name in QUANTITIES:
        x, y = (np.compress(at, each[name].values, axis=-1) for each in (ours, theirs))
        mean, positive = y.mean(axis=-1), np.all(y > 0.0, axis=-1, keepdims=True)
        errors.append(abs(x.mean(axis=-1) / np.where(mean > 0.0, mean, np.nan) - 1.0))
        scatters.append(np.sqrt(np.mean((x / np.where(positive, y, np.nan) - 1.0) ** 2, axis=-1)))
    return np.stack(errors, axis=-1), np.stack(scatters, axis=-1)


def centre_of_peak(cases: xr.Dataset) -> np.ndarray:
    """Mean speeds (rad/s) over peak and jump, weighted with the squared rms: smooth where the largest one jumps.

    Shape (cases, scenes).
    """
    at = np.isin(cases["place"].values, ["peak", "jump"])
    weight = np.compress(at, cases["rms_normal"].values ** 2 + cases["rms_tangential"].values ** 2, axis=-1)
    return (cases["speed"].values[at] * weight).sum(axis=-1) / weight.sum(axis=-1)


def level_error(together: xr.Dataset, value: str, quantities: Iterable[str] = CONVERGING) -> float:
    """Error of a fidelity level: the largest at the peak, over scenes and `quantities`."""
    levels = _cases_of(together, LEVEL)
    case = levels.isel(case=levels["value"].values == value)
    return float(case["error"].sel(at="peak", quantity=list(quantities)).max())


def parameter_tables(together: xr.Dataset, references: Mapping[str, str]) -> str:
    """One table per parameter: errors at the peak and off resonance, and cost, for every value and scene."""
    head = ["value", "scene", "rms, normal", "rms, tangential", "high stress", "largest, normal", "largest stress", "wear"]
    head += ["peak speed", "rms, normal, off resonance", "CPU s", "MB", "kB written"]
    tables = []
    for parameter in dict.fromkeys(together["parameter"].values):
        cases = _cases_of(together, parameter)
        rows = [_cells(cases.isel(case=row).sel(scene=scene)) for row in range(cases.sizes["case"]) for scene in cases["scene"]]
        heading = f"### {parameter.replace('_', ' ')} (reference: {references[parameter]})"
        tables.append(f"{heading}\n\n{markdown_table(head, rows)}")
    return "\n".join(tables)


def _cases_of(together: xr.Dataset, parameter: str) -> xr.Dataset:
    return together.isel(case=together["parameter"].values == parameter)


def _cells(case: xr.Dataset) -> list[str]:
    value, scene, refused = (str(case[name].item()) for name in ("value", "scene", "refused"))
    if refused:
        return [value, scene, f"refused: {refused}", *[""] * 10]
    errors = [_percent(case["error"].sel(at="peak", quantity=name)) for name in QUANTITIES]
    memory, written = float(case["peak_memory_bytes"]) / 1e6, float(case["bytes_written"]) / 1e3
    cost = [f"{float(case['cpu_s']):.2f}", f"{memory:.0f}", f"{written:.0f}"]
    off = _percent(case["error"].sel(at="off_resonance", quantity="rms_normal"))
    return [value, scene, *errors, _percent(case["peak_speed_error"]), off, *cost]


def _percent(value: xr.DataArray) -> str:
    number = 100.0 * float(value)
    return "" if np.isnan(number) else f"{number:.2g}%"


def level_table(together: xr.Dataset, tolerance: float) -> str:
    """The levels' errors and costs, and the one recommended for the tolerance."""
    rows = np.flatnonzero(together["parameter"].values == LEVEL)
    levels = {str(together["value"].values[row]): together.isel(case=row) for row in rows}
    errors = {name: level_error(together, name) for name in levels}
    costs = {name: float(level["cpu_s"].mean()) for name, level in levels.items()}
    cells = [
        [
            f"`{name}`",
            f"{100 * errors[name]:.1f}%",
            f"{costs[name]:.2f}",
            f"{float(level['model_cpu_s']):.0f}",
            f"{100 * level_error(together, name, MAXIMA):.1f}%",
        ]
        for name, level in levels.items()
    ]
    head = ["level", "error at the peak", "CPU s per run", "building the model, CPU s", "largest values differ by"]
    chosen = recommended_level(errors, costs, tolerance)
    if chosen is None:
        advice = f"No level is within the tolerance of {100 * tolerance:g}%: the best has {100 * min(errors.values()):.1f}%."
    else:
        advice = f"Recommended for a tolerance of {100 * tolerance:g}%: `{chosen}`."
    return f"{markdown_table(head, cells)}\n{advice}\n"


@dataclass(frozen=True)
class Growth:
    """Costs at a parameter's values, and the exponent of the power law fitted to the larger half of them."""

    parameter: str
    cost: str
    of: str
    values: np.ndarray
    costs: np.ndarray
    exponent: float


def growths(together: xr.Dataset) -> list[Growth]:
    """All pairs whose parameter the study varied; costs are means over the scenes."""
    pairs = []
    for parameter, cost, of in PAIRS:
        cases = _cases_of(together, parameter)
        values = cases["value"].values.astype(float)
        costs = cases[cost].mean("scene").values if "scene" in cases[cost].dims else cases[cost].values
        usable = np.flatnonzero(np.isfinite(costs) & (costs > 0.0) & (values > 0.0))
        if len(usable) >= 3:
            rows = usable[np.argsort(values[usable])]
            pairs.append(Growth(parameter, cost, of, values[rows], costs[rows], exponent_of(values[rows], costs[rows])))
    return pairs


def exponent_of(values: np.ndarray, costs: np.ndarray) -> float:
    """Slope of log cost over log value, by least squares over the more expensive half: what is fixed dominates small cases."""
    largest = np.argsort(costs)[-max(3, (len(costs) + 1) // 2) :]
    return float(np.polyfit(np.log(values[largest]), np.log(costs[largest]), 1)[0])


def growth_table(pairs: list[Growth]) -> str:
    """The exponents as Markdown."""
    rows = []
    for pair in pairs:
        unit, scale = ("MB", 1e-6) if "memory" in pair.cost or "bytes" in pair.cost else ("s", 1.0)
        first, last = (f"{scale * value:.3g} {unit}" for value in (pair.costs[0], pair.costs[-1]))
        span = f"{pair.values[0]:g} to {pair.values[-1]:g}"
        rows.append([pair.parameter.replace("_", " "), pair.of, span, first, last, f"{pair.exponent:.2f}"])
    return markdown_table(["parameter", "cost", "range", "from", "to", "exponent"], rows)


def draw_parameter(together: xr.Dataset, parameter: str) -> Figure:
    """Errors at the peak and the CPU time per run over one parameter's values, one column per scene."""
    varied, scenes = _cases_of(together, parameter), together["scene"].values
    labels = [str(value) for value in varied["value"].values]
    figure, panels = plt.subplots(2, len(scenes), figsize=(4.6 * len(scenes), 5.2), sharex=True, sharey="row", squeeze=False)
    for scene, errors, costs in zip(scenes, *panels, strict=True):
        cases = varied.sel(scene=scene)
        for name in QUANTITIES:
            error = cases["error"].sel(at="peak", quantity=name).values
            if np.any(np.isfinite(error)):
                errors.plot(labels, np.maximum(error, _FLOOR), "o-", label=name.replace("_", " "))
        errors.set_yscale("log")
        errors.set_title(str(scene), fontsize=9)
        costs.plot(labels, cases["cpu_s"].values, "s-", color="0.3")
        costs.set(yscale="log", xlabel=parameter.replace("_", " "))
        costs.tick_params(axis="x", rotation=30)
    panels[0, 0].set_ylabel("relative error of the mean at the peak")
    panels[1, 0].set_ylabel("CPU s per run")
    figure.legend(*style.legend_entries(panels[0]), loc="outside lower center", ncols=6)
    return figure


def draw_pareto(together: xr.Dataset) -> Figure:
    """Error of the normal rms at the peak over CPU time per run, all parameters; levels stand out."""
    scenes = together["scene"].values
    figure, panels = plt.subplots(1, len(scenes), figsize=(5.4 * len(scenes), 4.6), sharey=True, squeeze=False)
    for axes, scene in zip(panels[0], scenes, strict=True):
        for number, parameter in enumerate(dict.fromkeys(together["parameter"].values)):
            cases = _cases_of(together, parameter).sel(scene=scene)
            error = np.maximum(cases["error"].sel(at="peak", quantity="rms_normal").values, _FLOOR)
            level = parameter == LEVEL
            marker = "*" if level else "osv^Dx+"[number % 7]
            axes.loglog(cases["cpu_s"].values, error, marker, label=parameter.replace("_", " "), markersize=11 if level else 5)
            if level:
                for x, y, name in zip(cases["cpu_s"].values, error, cases["value"].values, strict=True):
                    axes.annotate(str(name), (x, y), fontsize=7, xytext=(4, 4), textcoords="offset points")
        # names of levels stand to the right of their marks
        axes.margins(x=0.15)
        axes.set(xlabel="CPU s per run", title=str(scene))
    panels[0, 0].set_ylabel("relative error of the mean normal rms at the peak")
    figure.legend(*style.legend_entries(panels[0]), loc="outside lower center", ncols=6)
    return figure


def draw_growth(pairs: Sequence[Growth]) -> Figure:
    """One panel per pair of parameter and cost, with the fitted power law."""
    columns = 4
    rows = max(1, -(-len(pairs) // columns))
    figure, panels = plt.subplots(rows, columns, figsize=(3.0 * columns, 2.6 * rows), squeeze=False)
    for axes, pair in zip(panels.ravel(), pairs, strict=False):
        axes.loglog(pair.values, pair.costs, "o")
        axes.loglog(pair.values, pair.costs[-1] * (pair.values / pair.values[-1]) ** pair.exponent, "--", color="0.5")
        axes.set_title(f"{pair.of}: exponent {pair.exponent:.2f}", fontsize=8)
        axes.set(xlabel=pair.parameter.replace("_", " "), ylabel=pair.cost.replace("_", " "))
    for axes in np.ravel(panels)[len(pairs) :]:
        axes.set_visible(False)
    if not pairs:
        figure.text(0.5, 0.5, "no parameter was varied over three values", ha="center")
    return figure
