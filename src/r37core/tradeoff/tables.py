"""The tables of the trade-off: every value of every parameter, the fidelity levels, and how costs grow with the parameters."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from r37core.base.dataset_file import read_dataset
from r37core.config.fidelity import recommended_level
from r37core.results.table_file import read_table

from .errors import CONVERGING, COSTS, COSTS_OF_MODEL, MAXIMA, QUANTITIES
from .plan import LEVEL


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
    said = ["no levels were compared"] if levels.empty else [_advice(levels)]
    if attributes["left_out"]:
        said.append(f"left out: {attributes['left_out']}")
    return "; ".join(said)


def _advice(levels: pd.DataFrame) -> str:
    best = levels[levels["recommended"] == "yes"]
    within = f"within the tolerance of {100 * levels['tolerance'].iloc[0]:g}%"
    if best.empty:
        nearest = f"{100 * levels['error'].min():.1f}%"
        return f"no level is {within}: the best differs by {nearest} from {levels['reference'].iloc[0]}"
    row = best.iloc[0]
    return f"cheapest level {within} of {row['reference']}: {row['level']}, {100 * row['error']:.1f}%"
