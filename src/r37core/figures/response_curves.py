"""Response over speed: rms of the leading edge, stress against yield, and which speeds are dangerous or unknown."""

from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from xarray import Dataset

from r37core.results.measures import ran
from r37core.results.other_motions import half_step, swept
from r37core.time_integration.settling import MotionAtEnd
from r37core.time_integration.status import RunStatus

from . import style
from .danger_rows import LEGEND, ROW_HEIGHT, draw_danger_rows, shown_runs

_MARKERS = (
    ("motion_at_end", MotionAtEnd.CUT_FREE, "o", "cut free at the end"),
    ("motion_at_end", MotionAtEnd.GROWING, "^", "growing at the end"),
)
"""Variable and state of a run that is marked, its open marker, and what it is called."""


def draw_response(
    title: str,
    campbell: Dataset | None,
    rms: Dataset,
    stress: Dataset | None = None,
    motions: Dataset | None = None,
    further_runs: Dataset | None = None,
) -> Figure:
    """One blade: normal and tangential rms of the leading edge in every scene, bands of the stress with the yield line, rows.

    A row of a scene shows which of its speeds are dangerous, unknown or sustained (danger_rows).

    `campbell`: where 1B crosses engine orders, None to leave that out; `motions`: more than that from rest, whose largest is
    drawn where it differs from that (results/other_motions.py), and these speeds shaded; `further_runs`: of a verdict.
    """
    rms, stress, whole = shown_runs(rms, stress, further_runs)
    scenes = rms["scene"].values.tolist()
    heights = [*[1.8] * (2 if stress is None else 3), ROW_HEIGHT * len(scenes)]
    figure, grid = style.panels(len(heights), 1, 1.0 + sum(heights), sharex=True, height_ratios=heights)
    *panels, rows = grid[:, 0]
    for axes, direction in zip(panels, ("normal", "tangential"), strict=False):
        _draw_scenes(axes, rms, direction)
        if motions is not None:
            _draw_largest(axes, motions, f"rms_{direction}", 1e3)
        axes.set_ylabel(f"rms, {direction} (mm)")
    if rms.sizes["speed"] > 1:
        panels[0].set_xlim(float(rms["speed"].min()), float(rms["speed"].max()))
    for axes in panels:
        for order, speed in style.crossings_seen(axes, campbell):
            axes.axvline(speed, color="0.5", linewidth=0.8, linestyle=":")
            place, across = (speed, 0.98), ("data", "axes fraction")
            axes.annotate(f"1B/{order} ", place, xycoords=across, fontsize=6, color="0.3", ha="right", va="top")
    crossings = "; dotted: 1B with engine orders" if campbell is not None else ""
    panels[0].set_title(f"blade {title}: leading edge over the last half of the run{crossings}")
    if stress is not None:
        for scene in stress["scene"].values:
            runs = stress.sel(scene=scene).dropna("speed", subset=["max_von_mises_ever"])
            style.stress_band(panels[2], runs["speed"], runs, style.scene_words(scene))
        if motions is not None and "max_von_mises_ever" in motions:
            _draw_largest(panels[2], motions, "max_von_mises_ever", 1e-9)
        style.yield_lines(panels[2], stress["yield_stress"].to_series(), named=True, linear=style.is_linear(stress))
        panels[2].set_ylabel(style.stress_label(stress))
    for axes in panels:
        axes.set_ylim(bottom=0.0)
    responses = {style.scene_words(scene): ran(whole.sel(scene=scene)) for scene in scenes}
    draw_danger_rows(rows, responses, [f"C{number}" for number in range(len(scenes))])
    rows.set_xlabel(style.SPEED_LABEL)
    style.rpm_axis(panels[0])
    style.legend_below(figure, panels, 3, LEGEND)
    return figure


def _draw_scenes(axes: Axes, rms: Dataset, direction: str) -> None:
    for scene in rms["scene"].values:
        runs = rms.sel(scene=scene)
        response = runs[f"rms_{direction}"].sel(tip_point="leading_edge").dropna("speed")
        (line,) = axes.plot(response["speed"], 1e3 * response, ".-", markersize=3, label=style.scene_words(scene))
        # open markers where a run's motion has cut itself free, or still grows
        drawn = runs.sel(speed=response["speed"].values)
        look: dict[str, Any] = {"color": line.get_color(), "fillstyle": "none", "markersize": 4}
        for name, state, marker, label in _MARKERS:
            there = 1e3 * response[drawn[name].values == state] if name in runs else response[:0]
            if there.size:
                axes.plot(there["speed"], there, marker, label=label, **look)
        style.mark_diverged(axes, runs["speed"].values[runs["status"].values == RunStatus.DIVERGED])


def _draw_largest(axes: Axes, motions: Dataset, name: str, factor: float) -> None:
    """The largest of all motions of each scene where they differ, in the colour of the scene, on shaded speeds."""
    for number, scene in enumerate(motions["scene"].values):
        pair = swept(motions.sel(scene=scene))
        largest = factor * pair[name].max("motion").where(pair["differ"] > 0.0)
        label = f"{style.scene_words(scene)}, largest motion"
        axes.plot(pair["speed"], largest, "+", color=f"C{number}", markersize=5, label=label)
        shade(axes, pair, f"C{number}", f"{style.scene_words(scene)}: motions differ")


def shade(axes: Axes, pair: Dataset, colour: Any = "0.5", name: str = "motions differ") -> None:
    """Shade the speeds at which the motions of one blade and scene differ (results/other_motions.py)."""
    speeds, differ = pair["speed"].values, pair["differ"].values > 0.0
    half = half_step(speeds)
    for number, speed in enumerate(speeds[differ]):
        label = name if number == 0 else None
        axes.axvspan(speed - half, speed + half, color=colour, alpha=0.15, linewidth=0, zorder=0, label=label)
