"""Run-ups: motion, stress and wear while the speed changes, and the largest stress against the rate."""

from collections.abc import Iterable, Mapping
from typing import Any, Literal

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib import colormaps
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from r37core.figures import style
from r37core.results.measures import leading_edge

from .dataset import runs_of
from .tables import CASE

_QUANTITIES = {**style.CURVES, "max_von_mises": style.CURVES["max_von_mises_ever"], "max_wear": ("largest wear (mm)", 1e3)}
_FEW_REVOLUTIONS, _FAINT = 60, 1e-5
_DIRECTIONS: dict[str, Literal["-", "--"]] = {"up": "-", "down": "--"}
_LININGS = {"new": "o", "worn": "x"}
_RANGE = ["low_speed_rad_s", "high_speed_rad_s"]


def draw_run_ups(run_ups: xr.Dataset, title: str, blade: str, scene: str) -> Figure:
    """Leading edge's rms, stress and wear of every revolution, over its mean speed.

    Colour is the rate, dashes are run-downs, crosses a lining that was worn before.
    """
    runs = runs_of(run_ups, blade=blade, scene=scene)
    runs.sort(key=lambda run: (float(run["rate"]) < 0.0, abs(float(run["rate"]))))
    # what another scene computes is in the dataset, too; runs that diverged at once have nothing
    there = [name for name in _QUANTITIES if name in run_ups and any(run[name].notnull().any() for run in runs)]
    shown = {name: _QUANTITIES[name] for name in there or ["rms_normal"]}
    figure, grid = style.panels(len(shown), 1, 1.6 * len(shown) + 0.8, sharex=True)
    panels = dict(zip(shown, grid[:, 0], strict=True))
    rates = sorted({abs(float(run["rate"])) for run in runs})
    colours = dict(zip(rates, colormaps["viridis"](np.linspace(0.0, 0.9, len(rates))), strict=True))
    for run in runs:
        marker = "." if run.sizes["revolution"] < _FEW_REVOLUTIONS else None
        for name, axes in panels.items():
            axes.plot(
                run["speed"],
                shown[name][1] * leading_edge(run)[name],
                color=colours[abs(float(run["rate"]))],
                linestyle=_DIRECTIONS[_direction(run)],
                marker=_LININGS["worn"] if run["worn"] else marker,
                markevery=0.05 if run["worn"] else None,
                markersize=3 if run["worn"] else 2,
                linewidth=0.9,
            )
    for name, axes in panels.items():
        axes.set_ylabel(shown[name][0])
        if there and name != "max_wear":
            axes.set_yscale("log")
            low, high = axes.get_ylim()
            axes.set_ylim(max(low, _FAINT * high), high)
        if name == "max_von_mises":
            style.yield_lines(axes, {blade: float(runs[0]["yield_stress"])}, named=True)
        if not there:
            style.say(axes, style.ALL_DIVERGED)
    axes.set_xlabel(style.RUN_UP_LABEL)
    style.rpm_axis(grid[0, 0])
    figure.suptitle(f"run-ups: {title}, leading edge")
    style.legend_below(figure, panels.values(), 6, _keys(runs, colours))
    return figure


def _direction(run: xr.Dataset) -> str:
    return "down" if run["stop_speed"] < run["start_speed"] else "up"


def _keys(runs: Iterable[xr.Dataset], colours: Mapping[float, Any]) -> dict[str, Line2D]:
    """Legend entries: the meaning of colours, dashes and crosses."""
    keys: dict[str, dict[str, Any]] = {f"{rate:.4g} rad/s²": {"color": colour} for rate, colour in colours.items()}
    there = {_direction(run) for run in runs}
    keys |= {f"run-{name}": {"color": "0.3", "ls": dashes} for name, dashes in _DIRECTIONS.items() if name in there}
    if any(run["worn"] for run in runs):
        keys["worn before"] = {"color": "0.3", "ls": "", "marker": _LININGS["worn"], "markersize": 3}
    return {name: Line2D([], [], **look) for name, look in keys.items()}


def draw_rates(runs: pd.DataFrame, title: str, scene: str) -> Figure:
    """Largest stress of each run-up of a scene against its rate, run-ups beside run-downs; blades in their colours."""
    styles = style.blade_styles(dict.fromkeys(runs["blade"]))
    runs = runs[(runs["scene"] == scene) & (runs["rate_rad_s2"] > 0.0)].sort_values("rate_rad_s2", kind="stable")
    directions = [name for name in _DIRECTIONS if name in set(runs["direction"])] or ["up"]
    figure, panels = style.panels(1, len(directions), 3.6, sharey=True)
    several = runs.groupby("blade")[_RANGE].nunique().max().max() > 1 if len(runs) else False
    for axes, direction in zip(panels[0], directions, strict=True):
        axes.set_title(f"run-{direction}s")
        axes.set_xlabel("rate (rad/s²)")
        if "largest_stress_pa" not in runs or runs["largest_stress_pa"].isna().all():
            continue
        for values, group in runs[runs["direction"] == direction].groupby(CASE, sort=False):
            case = dict(zip(CASE, values, strict=True))
            speeds = " to ".join(f"{case[name]:.0f}" for name in _RANGE)
            label = ", ".join([case["blade"], *(["worn"] if case["lining"] == "worn" else []), *([speeds] if several else [])])
            group = group.dropna(subset="largest_stress_pa")
            stress, look = 1e-9 * group["largest_stress_pa"], {"marker": _LININGS[case["lining"]], "markersize": 3}
            axes.plot(group["rate_rad_s2"], stress, label=label, **styles[case["blade"]] | look)
        style.yield_lines(axes, runs.groupby("blade")["yield_stress_pa"].first().to_dict(), named=True)
        axes.set_xscale("log")
        axes.set_yscale("log")
    panels[0, 0].set_ylabel("largest von Mises (GPa)")
    figure.suptitle(f"largest stress against rate: {title}")
    style.legend_below(figure, panels[0], 5)
    return figure
