"""Run-ups: motion, stress and wear over the speed as it changes, and the largest stress against the rate."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.figure import Figure

from r37core.run_ups.dataset import runs_of

from . import style

_QUANTITIES = {
    "rms_normal": ("rms, normal (mm)", 1e3),
    "rms_tangential": ("rms, tangential (mm)", 1e3),
    "max_von_mises": ("largest von Mises (GPa)", 1e-9),
    "max_wear": ("largest wear (mm)", 1e3),
}
_FEW_REVOLUTIONS, _FAINT = 60, 1e-5
_DIRECTIONS = {"up": "-", "down": "--"}
_LININGS = {"new": "o", "worn": "x"}


def draw_run_ups(run_ups: xr.Dataset, title: str, *, blade: str, scene: str) -> Figure:
    """Leading edge's rms, stress and wear of every revolution over its speed; colour is the rate, dashes are run-downs."""
    runs = sorted(runs_of(run_ups, blade=blade, scene=scene), key=lambda run: abs(float(run["rate"])))
    # what another scene computes is in the dataset, too
    shown = {name: about for name, about in _QUANTITIES.items() if name in run_ups and runs[0][name].notnull().any()}
    figure, panels = plt.subplots(len(shown), 1, figsize=(style.PAGE, 1.6 * len(shown) + 0.8), sharex=True)
    rates = list(dict.fromkeys(abs(float(run["rate"])) for run in runs))
    colours = dict(zip(rates, plt.get_cmap("viridis")(np.linspace(0.95, 0.0, len(rates))), strict=True))
    for run in runs:
        rate, direction = abs(float(run["rate"])), "down" if run["stop_speed"] < run["start_speed"] else "up"
        worn = ", worn" if run["worn"] else ""
        for axes, (name, (_, scale)) in zip(panels, shown.items(), strict=True):
            values = run[name].sel(tip_point="leading_edge") if "tip_point" in run[name].dims else run[name]
            axes.plot(
                run["speed"],
                scale * values,
                color=colours[rate],
                linestyle=_DIRECTIONS[direction],
                marker="." if run.sizes["revolution"] < _FEW_REVOLUTIONS else None,
                markersize=3,
                label=f"{direction}, {rate:.4g} rad/s²{worn}",
            )
    for axes, (name, (label, _)) in zip(panels, shown.items(), strict=True):
        axes.set_ylabel(label)
        if name != "max_wear":
            axes.set_yscale("log")
            axes.set_ylim(bottom=_FAINT * axes.get_ylim()[1])
        if name == "max_von_mises":
            style.yield_lines(axes, {blade: float(runs[0]["yield_stress"])})
    panels[-1].set_xlabel("mean speed of the revolution (rad/s)")
    style.rpm_axis(panels[0])
    figure.suptitle(f"run-ups: {title}")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return figure


def draw_rates(runs: pd.DataFrame, title: str, *, scene: str) -> Figure:
    """Largest stress of each run-up of a scene against its rate, run-ups beside run-downs; blades in their colours."""
    styles = style.blade_styles(dict.fromkeys(runs["blade"]))
    runs = runs[(runs["scene"] == scene) & (runs["rate_rad_s2"] > 0.0)].sort_values("rate_rad_s2")
    figure, panels = plt.subplots(1, 2, figsize=(style.PAGE, 3.6), sharey=True)
    if "max_von_mises_pa" in runs:
        for axes, direction in zip(panels, _DIRECTIONS, strict=True):
            for (blade, lining, _, _), group in runs[runs["direction"] == direction].groupby(_CURVE, sort=False):
                label = f"{blade}, worn" if lining == "worn" else str(blade)
                stress, look = 1e-9 * group["max_von_mises_pa"], {"marker": _LININGS[str(lining)], "markersize": 3}
                axes.plot(group["rate_rad_s2"], stress, label=label, **styles[str(blade)] | look)
            style.yield_lines(axes, runs.groupby("blade")["yield_stress_pa"].first().to_dict())
            axes.set_xscale("log")
            axes.set_yscale("log")
    for axes, direction in zip(panels, _DIRECTIONS, strict=True):
        axes.set_title(f"run-{direction}s")
        axes.set_xlabel("rate (rad/s²)")
    panels[0].set_ylabel("largest von Mises (GPa)")
    figure.suptitle(f"largest stress against rate: {title}")
    entries = {label: line for axes in panels for line, label in zip(*axes.get_legend_handles_labels(), strict=True)}
    if entries:
        figure.legend(entries.values(), entries.keys(), loc="outside lower center", ncols=7)
    return figure


_CURVE = ["blade", "lining", "low_speed_rad_s", "high_speed_rad_s"]
