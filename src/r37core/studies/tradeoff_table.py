"""The trade-off study as Markdown tables."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import xarray as xr

from r37core.config.fidelity import recommended_level

from .case import QUANTITIES
from .tradeoff import level_error


def parameter_tables(together: xr.Dataset, references: Mapping[str, str]) -> str:
    """One table per parameter: errors at the peak and off resonance, and cost, for every value and scene."""
    lines = []
    for parameter in dict.fromkeys(together["parameter"].values):
        lines += ["", f"### {parameter.replace('_', ' ')} (reference: {references[parameter]})", ""]
        lines.append(
            "| value | scene | rms, normal | rms, tangential | largest, normal | stress | wear | peak speed "
            "| rms, normal, off resonance | CPU s | MB | kB written |"
        )
        lines.append("|---" * 12 + "|")
        for row in np.flatnonzero(together["parameter"].values == parameter):
            case = together.isel(case=row)
            for scene in case["scene"].values:
                lines.append(_line(case.sel(scene=scene), str(scene)))
    return "\n".join(lines).lstrip("\n") + "\n"


def _line(one: xr.Dataset, scene: str) -> str:
    value = str(one["value"].item())
    if str(one["refused"].item()):
        return f"| {value} | {scene} | refused: {one['refused'].item()} |" + " |" * 9
    errors = [_percent(one["error"].sel(at="peak", quantity=name)) for name in QUANTITIES]
    memory, written = float(one["peak_memory_bytes"]) / 1e6, float(one["bytes_written"]) / 1e3
    cost = [f"{float(one['cpu_s']):.2f}", f"{memory:.0f}", f"{written:.0f}"]
    off = _percent(one["error"].sel(at="off_resonance", quantity="rms_normal"))
    return "| " + " | ".join([value, scene, *errors, _percent(one["peak_speed_error"]), off, *cost]) + " |"


def _percent(value: xr.DataArray) -> str:
    number = 100.0 * float(value)
    return "" if np.isnan(number) else f"{number:.2g}%"


def level_table(together: xr.Dataset, tolerance: float) -> str:
    """The levels' errors and costs, and the one recommended for the tolerance."""
    rows = np.flatnonzero(together["parameter"].values == "level")
    names = [str(together["value"].values[row]) for row in rows]
    errors = {name: level_error(together, name) for name in names}
    costs = {name: float(together["cpu_s"].isel(case=row).mean()) for name, row in zip(names, rows, strict=True)}
    lines = ["| level | error at the peak | CPU s per run | building the model, CPU s |", "|---|---|---|---|"]
    for name, row in zip(names, rows, strict=True):
        model = float(together["model_cpu_s"].isel(case=row))
        lines.append(f"| `{name}` | {100 * errors[name]:.1f}% | {costs[name]:.2f} | {model:.0f} |")
    chosen = recommended_level(errors, costs, tolerance)
    if chosen is None:
        advice = f"No level is within the tolerance of {100 * tolerance:g}%: the best has {100 * min(errors.values()):.1f}%."
    else:
        advice = f"Recommended for a tolerance of {100 * tolerance:g}%: `{chosen}`."
    return "\n".join([*lines, "", advice]) + "\n"
