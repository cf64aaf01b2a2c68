"""Figures of measurements beside the simulation, and of a calibration."""

from pathlib import Path
from textwrap import fill

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.figure import Figure

from r37core.base.dataset_file import read_dataset
from r37core.base.units import shown_unit
from r37core.figures import style
from r37studies.agreement import groups, words

NO_MEMBERS = Path("none")
"""Stands for the file of members where there is none: by its annotation a figure takes a path (r37core.figures.steps)."""

_CURVES = {"displacement_normal, rms": "rms_normal", "displacement_tangential, rms": "rms_tangential"}
"""Quantity that members under tolerances have, too, at the leading edge."""


def draw_measured(blade: str, scene: str, table: pd.DataFrame, members: Path = NO_MEMBERS) -> Figure:
    """Measured and simulated values of each measurement of a blade in a scene, with two standard deviations.

    `members`: file of the members under tolerances, where there are some.
    """
    own = [(quantity, rows) for (*pair, quantity, _), rows in groups(table) if pair == [blade, scene]]
    sampled = None
    if members != NO_MEMBERS and blade in (every := read_dataset(members))["blade"].values and scene in every["scene"].values:
        sampled = every.sel(blade=blade, scene=scene)
    figure, grid = style.panels(len(own), 1, 0.4 + 2.1 * len(own))
    for axes, (quantity, rows) in zip(grid.flat, own, strict=True):
        rows = rows.assign(simulated=rows["simulated"].replace(np.inf, np.nan))
        unit, factor = shown_unit(rows["unit"].iloc[0])
        column, label = "speed_rad_s", style.SPEED_LABEL
        if rows["engine_order"].nunique() > 1:
            column, label = "engine_order", "engine order"
        elif rows["angle_deg"].notna().all():
            column, label = "angle_deg", "casing angle (degrees)"
        curve = _CURVES.get(quantity)
        if curve and sampled:
            part = sampled[f"{curve}_quantile"].dropna("speed")
            ends = factor * part.isel(quantile=[0, -1]).transpose("quantile", "speed").values
            axes.fill_between(part["speed"], *ends, color=style.COLOURS[4], alpha=0.3, label="tolerances")
        ordered = rows.sort_values(column, kind="stable")
        simulated, spread = factor * ordered["simulated"], 2.0 * factor * ordered["simulated_uncertainty"]
        axes.plot(ordered[column], simulated, "o-", markersize=3, label="simulated")
        axes.fill_between(ordered[column], simulated - spread, simulated + spread, alpha=0.2)
        bars = 2.0 * factor * ordered["measured_uncertainty"]
        axes.errorbar(
            ordered[column], factor * ordered["measured"], bars, fmt="s", markersize=3, linewidth=0.8, label="measured"
        )
        axes.set(xlabel=label, ylabel=f"{fill(quantity, 24)}\n({unit or '1'})", title=words(rows).split("; ")[0])
    grid.flat[0].legend()
    return figure


def draw_calibration(calibration: xr.Dataset) -> Figure:
    """Ranges of the numbers over their distributions before, and each measured point beside the simulated range."""
    count = calibration.sizes["number"]
    figure, ((left, right),) = style.panels(1, 2, 1.2 + 0.5 * max(count, 4), width_ratios=[1, 1.4])
    for place, name in enumerate(calibration["number"].values):
        shares = calibration["share"].sel(number=name)
        for (low, high), width in (((0.025, 0.975), 1.5), ((0.16, 0.84), 5.0)):
            left.plot(shares.quantile([low, high]), [place, place], color=style.COLOURS[0], linewidth=width)
        left.plot(shares.values[0], place, "o", color=style.COLOURS[1], markersize=5)
    left.set(yticks=range(count), yticklabels=calibration["number"].values)
    left.set(xlim=(0, 1), xlabel="share of the distribution before")
    # of each measurement in units of its largest value
    largest = calibration["measured"].groupby("measurement").max()
    scale = largest.sel(measurement=calibration["measurement"]).values
    places = np.arange(calibration.sizes["point"])
    low, middle, high = calibration["simulated"].values / scale
    right.errorbar(places, middle, [middle - low, high - middle], fmt="o", markersize=3, label="simulated, 95%")
    measured, bars = calibration["measured"] / scale, 2.0 * calibration["deviation"] / scale
    right.errorbar(places + 0.2, measured, bars, fmt="s", markersize=3, label="measured, 2 sigma")
    right.set(xlabel="measured point", ylabel="over the largest measured", ylim=(0, None))
    right.legend()
    return figure
