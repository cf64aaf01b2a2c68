"""calibration.nc, calibration.csv and the files to go on with: what the measurements leave possible."""

from collections.abc import Sequence

import numpy as np
import pandas as pd
import xarray as xr

from r37core.base.variable import about
from r37core.base.varied_number import SCENE, VariedNumber, with_value
from r37core.base.yaml_file import yaml_text
from r37core.config import Settings
from r37core.config.changed_numbers import scene_numbers
from r37studies.member_values import drawn

from .calibration import Calibration
from .model_check import checked_model

ENDS = {"low_95": 0.025, "low_68": 0.16, "median": 0.5, "high_68": 0.84, "high_95": 0.975}

UNTOLD = 0.8
"""Share of its width before that a number's range keeps where the measurements do not determine it."""

TOGETHER = 0.7
"""Correlation from which on measurements identify two numbers together and not each."""

_AT_END, _WIDE = 0.02, 0.5
_DAMPING = VariedNumber(SCENE, "damping_ratio")


def calibration_dataset(calibration: Calibration, count: int) -> xr.Dataset:
    """Dataset of a calibration over (number, draw), (point) and (design): the first of the draws is the most likely."""
    likelihood, cube, logs = calibration.posterior()
    # the best first, and others evenly over the draws, which are sorted by their likelihood
    kept = np.unique(np.linspace(0, len(cube) - 1, min(count, len(cube))).astype(int))
    measurements = calibration.measurements.values()
    titles = [f"{each.blade} {each.scene}: {each.title}" for each in measurements for _ in each.points.values]
    names = [number.name for number in calibration.spreads]
    values, designs = (
        np.array([list(drawn(calibration.spreads, calibration.nominal, share).values()) for share in part])
        for part in (cube, calibration.cube)
    )
    check = checked_model(calibration, likelihood)
    ends = np.quantile(cube, (0.025, 0.16, 0.84, 0.975), axis=0)
    is_bounded = ((ends[0] < _AT_END) | (ends[3] > 1.0 - _AT_END)).astype(int)
    means, _ = likelihood.predicted(cube)
    # the simulated value is the exponential of what the surrogates have
    ranges = np.exp(np.quantile(means, (0.025, 0.5, 0.975), axis=1)) - calibration.floors
    return xr.Dataset(
        {
            "value": (("draw", "number"), values[kept], about("", "drawn values, in the units of the keys")),
            "share": (("draw", "number"), cube[kept], about("1", "share of the number's distribution below a draw")),
            "best": ("number", values[0], about("", "most likely values")),
            "quantile": (("end", "number"), np.quantile(values, list(ENDS.values()), axis=0), about("", "ends of ranges")),
            "width_share": ("number", (ends[2] - ends[1]) / 0.68, about("1", "width of the 68% range over that before")),
            "at_end": ("number", is_bounded, about("1", "1 where the 95% range reaches an end of the number's range")),
            "correlation": (("number", "number_2"), np.atleast_2d(np.corrcoef(cube.T)), about("1", "correlation of the draws")),
            "measured": ("point", calibration.column("values"), about("", "measured value")),
            "deviation": ("point", calibration.column("deviations"), about("", "its deviation")),
            "simulated": (("range", "point"), ranges, about("", "simulated: 2.5, 50 and 97.5% of the draws")),
            "misfit": ("point", check.differences, about("1", "difference over uncertainty of the run that fits best")),
            "elsewhere": ("point", check.elsewhere.astype(int), about("1", "1: a run at these numbers is on the same branch")),
            "design_value": (("design", "number"), designs, about("", "values")),
            "design_misfit": ("design", calibration.misfits, about("1", "misfit, NaN where a run diverged")),
        },
        coords={
            "number": names, "number_2": names, "end": list(ENDS), "range": ["low", "median", "high"],
            "measurement": ("point", titles),
            "speed": ("point", calibration.column("speeds"), about("rad s-1", "speed")),
        },
        attrs={
            "doubts": "; ".join(check.doubts),
            "probability_of_misfit": check.misfit,
            "probability_of_signs": check.by_chance,
            "log_likelihood_of_best": float(logs[0]),
        },
    )  # fmt: skip


def number_table(dataset: xr.Dataset) -> pd.DataFrame:
    """A row for each number: best value, ranges, and what the measurements do not determine."""
    names, best, width_share = (dataset[name].values for name in ("number", "best", "width_share"))
    ranges = dict(zip(dataset["end"].values, dataset["quantile"].values, strict=True))
    note = ["; ".join(notes(dataset, name)) for name in names]
    return pd.DataFrame({"number": names, "best": best, **ranges, "width_share": width_share, "note": note})


def notes(dataset: xr.Dataset, name: str) -> list[str]:
    """Texts on what the measurements do not determine of a number."""
    number, lines = dataset.sel(number=name), []
    if number["width_share"] > UNTOLD:
        lines.append("not identifiable by these measurements")
    elif number["at_end"]:
        lines.append("reaches an end of its range")
    for other, share in zip(dataset["number_2"].values, number["correlation"].values, strict=True):
        if other != name and abs(share) > TOGETHER:
            lines.append(f"identifiable only together with {other} (correlation {share:.2f})")
    return lines


def is_range(dataset: xr.Dataset, number: VariedNumber) -> bool:
    """True of a damping ratio that the measurements hardly tell: scenes have its range, and members nothing of it."""
    others = dataset.sizes["number"] > 1
    return number == _DAMPING and others and bool(dataset["width_share"].sel(number=number.name) > _WIDE)


def calibrated_scenes(settings: Settings, dataset: xr.Dataset, scenes: Sequence[str]) -> str:
    """Text of a file of scenes with the best values, and with lowest and highest of a damping that is not told."""
    entries, names = {}, map(str, dataset["number"].values)
    best = dict(zip(map(VariedNumber.named, names), dataset["best"].values.tolist(), strict=True))
    for scene in dict.fromkeys(scenes):
        entry = settings.scene_designs.entries[scene]
        content, known = entry.model_dump(exclude_none=True, exclude_unset=True), scene_numbers(entry)
        for number, value in best.items():
            if number.kind == SCENE and number.key in known:
                content = with_value(content, number.key, float(f"{value:.6g}"))
                if is_range(dataset, number):
                    low, high = dataset["quantile"].sel(number=number.name, end=["low_95", "high_95"]).values
                    row = {"mode": 0, "ratio": value, "lowest": min(low, value), "highest": max(high, value)}
                    content[number.key] = [{key: float(f"{part:.6g}") for key, part in row.items()} | {"mode": 0}]
        entries[f"{scene}-calibrated"] = content
    others = ", ".join(f"{number.key} {value:.6g}" for number, value in best.items() if number.kind != SCENE)
    blade_line = f"# Others: {others}.\n" if others else ""
    return f"# Most likely values of a calibration; calibration.csv has their ranges.\n{blade_line}{yaml_text(entries)}"
