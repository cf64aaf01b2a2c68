"""The published results in the manner of the field: response, stress and yield of the shipped reading."""

from __future__ import annotations

import matplotlib.pyplot as plt
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from r37core.figures import style
from r37core.published import BLADES, DIRECT_PEAK, INTERACTIONS, QUIET

from .reading_places import DIRECT
from .validation import Runs

_SCENES = {"lined": ("abradable lining", "C0"), "direct": ("direct contact", "C1")}
_DIRECTIONS = {"rms_normal": "normal to the casing", "rms_tangential": "tangential"}


def draw_reference(survey: Runs, shipped: Runs) -> Figure:
    """Rms of both scenes over the whole range, the survey and the finer windows together; dotted: published peaks."""
    windows = [shipped[one.name] for one in INTERACTIONS if one.blade == "Ref"]
    runs = {"lined": joined(*windows, survey["Ref_lined"]), "direct": joined(shipped[DIRECT], survey["Ref_direct"])}
    figure, panels = plt.subplots(2, 1, figsize=(style.PAGE, 5.0), sharex=True)
    for axes, (name, direction) in zip(panels, _DIRECTIONS.items(), strict=True):
        for scene, run in runs.items():
            label, color = _SCENES[scene]
            axes.semilogy(run["speed"], 1e3 * run[name], color=color, linewidth=1.1, label=label)
        for one in INTERACTIONS:
            if one.blade == "Ref":
                axes.axvline(one.peak, color="C0", linestyle=":", linewidth=0.9)
                axes.annotate(
                    f"1B/{one.engine_order}", (one.peak + 4, 0.96), xycoords=("data", "axes fraction"), fontsize=7, va="top"
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


def draw_stress(shipped: Runs, yield_stress: float) -> Figure:
    """Largest stress of the last revolution of all blades about 1B/4, with the yield line; dotted: published peaks."""
    figure, axes = plt.subplots(figsize=(style.PAGE, 3.6))
    _draw_about_order_4(axes, shipped, "max_von_mises", 1e-9)
    axes.axhline(1e-9 * yield_stress, color="0.2", linestyle="--", linewidth=1.0, label="yield")
    axes.set(ylabel="largest von Mises, last revolution (GPa)", yscale="log")
    axes.set_xlabel("speed (rad/s); dotted: published peaks")
    style.rpm_axis(axes)
    _legend_above(figure, axes)
    return figure


def _draw_about_order_4(axes: Axes, shipped: Runs, name: str, scale: float) -> None:
    """One curve for each blade, and its published peak."""
    for number, one in enumerate(INTERACTIONS[: len(BLADES)]):
        run, color = shipped[one.name], f"C{number}"
        axes.plot(run["speed"], scale * run[name], ".-", color=color, markersize=3, linewidth=1.0, label=one.blade)
        axes.axvline(one.peak, color=color, linestyle=":", linewidth=0.9)


def _legend_above(figure: Figure, axes: Axes) -> None:
    """The legend of one panel above the figure, out of the way of its peaks."""
    figure.legend(*axes.get_legend_handles_labels(), loc="outside upper center", ncols=len(BLADES) + 1, fontsize=8)


def draw_histories(shipped: Runs, yield_stress: float) -> Figure:
    """Largest stress of every revolution of the reference blade in both scenes, at three published speeds."""
    runs = {"lined": shipped[INTERACTIONS[0].name], "direct": shipped[DIRECT]}
    figure, panels = plt.subplots(1, 3, figsize=(style.PAGE, 2.9), sharey=True)
    for axes, speed in zip(panels, (INTERACTIONS[0].peak, DIRECT_PEAK, QUIET), strict=True):
        for scene, run in runs.items():
            label, color = _SCENES[scene]
            history = 1e-9 * run["history"].sel(history_speed=speed)
            axes.semilogy(history["revolution"], history.where(history > 0.0), color=color, linewidth=1.2, label=label)
        axes.axhline(1e-9 * yield_stress, color="0.2", linestyle="--", linewidth=1.0)
        axes.set(xlabel="revolution", title=f"{speed:g} rad/s")
    panels[0].set_ylabel("largest von Mises of the revolution (GPa)")
    panels[0].legend()
    return figure


def joined(*runs: xr.Dataset) -> xr.Dataset:
    """Several runs of one blade and scene as one, by ascending speed; the first counts where two have a speed."""
    kept = [run[list(_DIRECTIONS)] for run in runs]
    return xr.concat(kept, "speed").drop_duplicates("speed").sortby("speed")
