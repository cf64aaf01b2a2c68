"""How cost grows, from the costs that the trade-off study measured: a power law for each pair of cause and cost."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr

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
    """All pairs whose parameter the study turned; costs are means over the scenes."""
    found = []
    for parameter, cost, of in PAIRS:
        rows = np.flatnonzero(together["parameter"].values == parameter)
        values = np.array([float(value) for value in together["value"].values[rows]])
        costs = together[cost].isel(case=rows)
        cost_of_value = costs.mean("scene").values if "scene" in costs.dims else costs.values
        usable = np.isfinite(cost_of_value) & (cost_of_value > 0.0) & (values > 0.0)
        if usable.sum() >= 3:
            order = np.argsort(values[usable])
            values, cost_of_value = values[usable][order], cost_of_value[usable][order]
            found.append(Growth(parameter, cost, of, values, cost_of_value, exponent_of(values, cost_of_value)))
    return found


def exponent_of(values: np.ndarray, costs: np.ndarray) -> float:
    """Slope of log cost over log value, by least squares over the dearer half: small cases are dominated by what is fixed."""
    dear = np.argsort(costs)[-max(3, (len(costs) + 1) // 2) :]
    return float(np.polyfit(np.log(values[dear]), np.log(costs[dear]), 1)[0])


def growth_table(found: list[Growth]) -> str:
    """The exponents as Markdown."""
    lines = ["| parameter | cost | range | from | to | exponent |", "|---|---|---|---|---|---|"]
    for one in found:
        unit, scale = ("MB", 1e-6) if "memory" in one.cost or "bytes" in one.cost else ("s", 1.0)
        first, last = (f"{scale * value:.3g} {unit}" for value in (one.costs[0], one.costs[-1]))
        span = f"{one.values[0]:g} to {one.values[-1]:g}"
        lines.append(f"| {one.parameter.replace('_', ' ')} | {one.of} | {span} | {first} | {last} | {one.exponent:.2f} |")
    return "\n".join(lines) + "\n"
