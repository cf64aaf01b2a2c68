"""The published results in the manner of the field: response, stress and yield as shipped."""

from __future__ import annotations

from collections.abc import Mapping

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from r37core.figures import style
from r37core.results.measures import leading_edge, peak_speed
from validation.published import BLADES, DIRECT_PEAK, INTERACTIONS, QUIET
from validation.studies.measures import history_of

from .cases import CHOICES, DIRECT
from .validation import PEAK_WITHIN, Runs

SCENES = {"lined": ("abradable lining", "C0"), "direct": ("direct contact", "C1")}
"""Kind of scene -> its label and colour."""

_DIRECTIONS = {"rms_normal": "normal to the casing", "rms_tangential": "tangential"}


def draw_reference(survey: Runs, shipped: Runs) -> Figure:
    """Rms of both scenes over the whole range, the survey and the finer windows together; dotted: published peaks."""
    windows = [shipped[row.name] for row in INTERACTIONS if row.blade == "Ref"]
    runs = {"lined": joined(*windows, survey["Ref_lined"]), "direct": joined(shipped[DIRECT], survey["Ref_direct"])}
    figure, panels = plt.subplots(2, 1, figsize=(style.PAGE, 5.0), sharex=True)
    for axes, (name, direction) in zip(panels, _DIRECTIONS.items(), strict=True):
        for scene, run in runs.items():
            label, color = SCENES[scene]
            axes.semilogy(run["speed"], 1e3 * run[name], color=color, linewidth=1.1, label=label)
        for row in INTERACTIONS:
            if row.blade == "Ref":
                axes.axvline(row.peak, color="C0", linestyle=":", linewidth=0.9)
                axes.annotate(
                    f"1B/{row.engine_order}", (row.peak + 4, 0.96), xycoords=("data", "axes fraction"), fontsize=7, va="top"
                )
        axes.axvline(DIRECT_PEAK, color="C1", linestyle=":", linewidth=0.9)
        axes.set_ylabel(f"rms, {direction} (mm)")
    panels[0].legend(loc="upper right", bbox_to_anchor=(0.73, 1.0))
    panels[0].set_title("blade Ref, leading edge, last half of the run; dotted: published peaks")
    panels[1].set_xlabel("speed (rad/s)")
    style.rpm_axis(panels[0])
    return figure


def draw_blades(shipped: Runs) -> Figure:
    """Rms of all blades about their interaction of 1B with order 4; dotted: published peaks."""
    figure, panels = plt.subplots(2, 1, figsize=(style.PAGE, 5.2), sharex=True)
    for axes, (name, direction) in zip(panels, _DIRECTIONS.items(), strict=True):
        _draw_about_order_4(axes, shipped, name, 1e3)
        axes.set_ylabel(f"rms, {direction} (mm)")
    style.rpm_axis(panels[0])
    _legend_above(figure, panels[0])
    panels[1].set_xlabel("speed (rad/s); dotted: published peaks")
    return figure


def draw_stress(shipped: Runs) -> Figure:
    """Largest stress of the last revolution of all blades about 1B/4, with the yield line; dotted: published peaks."""
    figure, axes = plt.subplots(figsize=(style.PAGE, 3.6))
    _draw_about_order_4(axes, shipped, "max_von_mises", 1e-9)
    yields = {row.blade: float(shipped[row.name]["yield_stress"]) for row in INTERACTIONS[: len(BLADES)]}
    style.yield_lines(axes, yields, named=True)
    axes.set(ylabel="largest von Mises, last revolution (GPa)", yscale="log")
    axes.set_xlabel("speed (rad/s); dotted: published peaks")
    style.rpm_axis(axes)
    _legend_above(figure, axes)
    return figure


def _draw_about_order_4(axes: Axes, shipped: Runs, name: str, scale: float) -> None:
    """One curve for each blade, and its published peak."""
    for number, row in enumerate(INTERACTIONS[: len(BLADES)]):
        run, color = leading_edge(shipped[row.name]), f"C{number}"
        axes.plot(run["speed"], scale * run[name], ".-", color=color, markersize=3, linewidth=1.0, label=row.blade)
        axes.axvline(row.peak, color=color, linestyle=":", linewidth=0.9)


def _legend_above(figure: Figure, axes: Axes) -> None:
    """The legend of one panel above the figure, out of the way of its peaks."""
    figure.legend(*axes.get_legend_handles_labels(), loc="outside upper center", ncols=len(BLADES) + 1, fontsize=8)


def draw_histories(shipped: Runs) -> Figure:
    """Largest stress of every revolution of the reference blade in both scenes, at three published speeds."""
    runs = {"lined": shipped[INTERACTIONS[0].name], "direct": shipped[DIRECT]}
    figure, panels = plt.subplots(1, 3, figsize=(style.PAGE, 2.9), sharey=True)
    for axes, speed in zip(panels, (INTERACTIONS[0].peak, DIRECT_PEAK, QUIET), strict=True):
        for scene, run in runs.items():
            label, color = SCENES[scene]
            history = 1e-9 * history_of(run, speed)
            shown = np.where(history > 0.0, history, np.nan)
            axes.semilogy(run["revolution"], shown, color=color, linewidth=1.2, label=label)
        style.yield_lines(axes, {name: float(run["yield_stress"]) for name, run in runs.items()})
        axes.set(xlabel="revolution", title=f"{speed:g} rad/s")
    panels[0].set_ylabel("largest von Mises of the revolution (GPa)")
    panels[0].legend()
    return figure


def joined(*runs: xr.Dataset) -> xr.Dataset:
    """Several runs of one blade and scene as one, by ascending speed; the first counts where two have a speed."""
    parts = [leading_edge(run)[list(_DIRECTIONS)] for run in runs]
    return xr.concat(parts, "speed").drop_duplicates("speed").sortby("speed")


def draw_choices(choices: Mapping[str, Runs]) -> Figure:
    """One row for each choice: error of every peak speed in percent, and how many there are; grey: what counts as agreeing."""
    figure, axes = plt.subplots(figsize=(9.0, 0.32 * len(choices) + 1.6))
    axes.axvspan(-100 * PEAK_WITHIN, 100 * PEAK_WITHIN, color="0.92", zorder=0)
    rows = np.arange(len(choices))
    for number, published in enumerate(INTERACTIONS):
        speeds = [peak_speed(runs[published.name]) if published.name in runs else np.nan for runs in choices.values()]
        errors = 100.0 * (np.array(speeds) / published.peak - 1.0)
        marker = "o" if published.engine_order == 4 else "^sD"[published.engine_order - 5]
        color = f"C{number}" if published.engine_order == 4 else "C0"
        axes.plot(errors, rows, marker, color=color, alpha=0.8, markersize=5, linestyle="none", label=published.label)
    for row, runs in enumerate(choices.values()):
        found_peaks = sum(np.isfinite(peak_speed(runs[published.name])) for published in INTERACTIONS if published.name in runs)
        axes.annotate(
            f"{found_peaks} of {len(INTERACTIONS)}", (1.01, row), xycoords=("axes fraction", "data"), va="center", fontsize=8
        )
    axes.set_yticks(rows, [CHOICES[name].what for name in choices])
    axes.invert_yaxis()
    axes.set(xlabel="peak speed less the published one (%)")
    axes.annotate("peaks found", (1.01, 1.0), xycoords="axes fraction", va="bottom", fontsize=8)
    figure.legend(loc="outside lower center", ncols=5, fontsize=8)
    return figure
