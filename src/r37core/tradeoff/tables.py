"""The tables of the trade-off: every value of every parameter, and the fidelity levels."""

from collections.abc import Iterator, Mapping
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
    return pd.DataFrame(list(_rows(together, references)))


def _rows(together: xr.Dataset, references: Mapping[str, str]) -> Iterator[dict[str, object]]:
    for number, (parameter, value) in enumerate(zip(together["parameter"].values, together["value"].values, strict=True)):
        for scene in together["scene"].values:
            case = together.isel(case=number).sel(scene=scene)
            peak_row, off = (case["error"].sel(at=place) for place in ("peak", "off_resonance"))
            yield {
                "parameter": parameter,
                "value": value,
                "reference": references[parameter],
                "scene": scene,
                "refused": str(case["refused"].item()),
                **{f"error_{name}": float(peak_row.sel(quantity=name)) for name in QUANTITIES},
                "error_peak_speed": float(case["peak_speed_error"]),
                "error_rms_normal_off_resonance": float(off.sel(quantity="rms_normal")),
                **{name: float(case[name]) for name in (*COSTS, *COSTS_OF_MODEL)},
            }


LEVEL_COLUMNS = (
    "level",
    "reference",
    "error",
    "error_of_largest_values",
    "cpu_s_per_run",
    "model_cpu_s",
    "tolerance",
    "recommended",
)


def level_table(table: pd.DataFrame, tolerance: float) -> pd.DataFrame:
    """The fidelity levels: largest error at the peak over scenes, costs, and which one is the cheapest within the tolerance."""
    levels = table[table["parameter"] == LEVEL]
    rows = [
        {
            "level": name,
            "reference": level["reference"].iloc[0],
            "error": level_error(level),
            "error_of_largest_values": level_error(level, MAXIMA),
            "cpu_s_per_run": level["cpu_s"].mean(),
            "model_cpu_s": level["model_cpu_s"].iloc[0],
            "tolerance": tolerance,
        }
        for name, level in levels.groupby("value", sort=False)
    ]
    errors = {row["level"]: row["error"] for row in rows if np.isfinite(row["error"])}
    chosen = recommended_level(errors, {row["level"]: row["cpu_s_per_run"] for row in rows}, tolerance)
    recommended = ({"recommended": "yes" if row["level"] == chosen else "no"} for row in rows)
    return pd.DataFrame([row | more for row, more in zip(rows, recommended, strict=True)], columns=list(LEVEL_COLUMNS))


def level_error(level: pd.DataFrame, quantities: Mapping[str, str] = CONVERGING) -> float:
    """Error of a fidelity level: the largest at the peak, over scenes and `quantities`."""
    return float(level[[f"error_{name}" for name in quantities]].max(axis=None))


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
