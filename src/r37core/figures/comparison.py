"""Blades compared: around an interaction that they share, and by their speeds above yield, scene by scene."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from r37core.time_integration.status import RunStatus

from . import style

_MOST_RANKED = 60
"""Blades whose bars fit in a picture."""

_IN_MOST, _IN_SOME = "length_most_revolutions_rad_s", "length_some_revolutions_rad_s"


def shared_order(campbell: xr.Dataset, low: float, high: float) -> int | None:
    """The engine order whose crossings with 1B most blades have between `low` and `high` (rad/s), of several the lowest.

    None where no blade has any.
    """
    crossing = campbell["crossing_speed"].sel(mode="1B")
    count = ((crossing >= low) & (crossing <= high)).sum("blade").values
    return int(campbell["engine_order"].values[int(np.argmax(count))]) if count.max() else None


def draw_comparison(
    campbell: xr.Dataset, rms: xr.Dataset, stress: xr.Dataset | None = None, title: str = "", *, below: float, above: float
) -> Figure:
    """All blades in one scene about their crossing of 1B with the engine order that most of them meet.

    Speeds are those above the crossing, as shares of it: the crossings of the blades lie hundreds of rad/s apart. The
    picture reaches from `below` to `above` the crossing, as shares too: where peaks are looked for. Runs that diverged are
    crosses of the blade's colour at the upper edge.
    """
    styles = style.blade_styles(rms["blade"].values)
    order = shared_order(campbell, float(rms["speed"].min()), float(rms["speed"].max()))
    panels_of = {"rms, normal (mm)": 1e3 * rms["rms_normal"].sel(tip_point="leading_edge")}
    panels_of["rms, tangential (mm)"] = 1e3 * rms["rms_tangential"].sel(tip_point="leading_edge")
    if stress is not None:
        panels_of["largest von Mises (GPa)"] = 1e-9 * stress["max_von_mises"]
    figure, panels = plt.subplots(len(panels_of), 1, figsize=(style.PAGE, 1.9 * len(panels_of) + 0.5), sharex=True)
    for axes, (label, values) in zip(panels, panels_of.items(), strict=True):
        for blade in values["blade"].values if order else []:
            crossing = float(campbell["crossing_speed"].sel(blade=blade, mode="1B", engine_order=order))
            about = slice((1.0 - below) * crossing, (1.0 + above) * crossing)
            curve = values.sel(blade=blade, speed=about).dropna("speed")
            status = rms["status"].sel(blade=blade, speed=about)
            diverged = status["speed"].values[status.values == RunStatus.DIVERGED]
            if curve.size or len(diverged):
                above_crossing = 100 * (curve["speed"] / crossing - 1.0)
                axes.plot(above_crossing, curve, marker=".", markersize=3, label=str(blade), **styles[str(blade)])
                style.mark_diverged(axes, 100 * (diverged / crossing - 1.0), styles[str(blade)]["color"])
        axes.axvline(0.0, color="0.5", linewidth=0.8, linestyle=":")
        axes.set_ylabel(label)
    if stress is not None:
        style.yield_lines(panels[-1], stress["yield_stress"].to_series(), named=True)
    label = f"speed above the crossing of 1B with engine order {order} (%)" if order else "no crossing of 1B was run"
    panels[-1].set_xlabel(label)
    panels[0].set_title(f"blades in scene {title}")
    if panels[0].lines[:-1]:
        figure.legend(*style.legend_entries(panels), loc="outside lower center", ncols=5)
    return figure


def draw_ranking(ranking: pd.DataFrame, scenes: Sequence[str] | None = None) -> Figure:
    """Bars of the speeds above yield in most and in some revolutions, a panel per scene, blades in the order of the first.

    `scenes`: those that are drawn, or all. Of many blades the first and the last in that order are drawn; a row between them
    says how many are left out.
    """
    scenes = [name for name in dict.fromkeys(ranking["scene"]) if scenes is None or name in scenes]
    first = ranking[ranking["scene"] == scenes[0]]["blade"]
    contacts = dict(zip(ranking["blade"], ranking["contact"], strict=True)) if ranking["contact"].nunique() > 1 else {}
    blades = list(dict.fromkeys([*first, *ranking["blade"]]))
    if len(blades) > _MOST_RANKED:
        half = _MOST_RANKED // 2
        blades = [*blades[:half], f"({len(blades) - _MOST_RANKED} more)", *blades[-half:]]
    columns = min(len(scenes), 2)
    rows = -(-len(scenes) // columns)
    size = (style.PAGE, 0.5 + rows * (0.4 + 0.34 * max(len(blades), 3)))
    figure, panels = plt.subplots(rows, columns, figsize=size, sharey=True, squeeze=False)
    for axes in panels.flat[len(scenes) :]:
        axes.set_visible(False)
    for axes, scene in zip(panels.flat, scenes, strict=False):
        _draw_bars(axes, ranking[ranking["scene"] == scene].set_index("blade").reindex(blades))
        axes.set(title=style.scene_words(scene), xlabel="speeds above yield (rad/s)")
    named = [f"{blade}\n{contacts[blade]}" if blade in contacts else blade for blade in blades]
    panels[0][0].set_yticks(np.arange(len(blades)), named)
    panels[0][0].invert_yaxis()
    figure.legend(*style.legend_entries(list(panels.flat)), loc="outside lower center", ncols=3)
    return figure


def _draw_bars(axes: Axes, rows: pd.DataFrame) -> None:
    positions = np.arange(float(len(rows)))
    axes.barh(positions, rows[_IN_SOME], 0.76, color="C0", alpha=0.35, label="in some revolutions")
    axes.barh(positions, rows[_IN_MOST], 0.44, color="C0", label="in most revolutions")
    low, high, meaning = _range(rows)
    if np.isfinite(low).any():
        axes.errorbar(
            rows[_IN_MOST], positions, xerr=[low, high], fmt="none", ecolor="0.15", elinewidth=1.0, capsize=2.5, label=meaning
        )
    high = np.nan_to_num(high)
    largest = np.nanmax([1.0, *rows[_IN_SOME], *(rows[_IN_MOST] + high)])
    for position, above, (_, row) in zip(positions, high, rows.iterrows(), strict=True):
        if np.isfinite(row[_IN_MOST]):
            ends = np.nanmax([row[_IN_SOME], row[_IN_MOST] + above])
            axes.text(ends + 0.02 * largest, position, f"{row[_IN_MOST]:.0f} to {row[_IN_SOME]:.0f}", va="center", fontsize=7)
    axes.set_xlim(0.0, 1.25 * largest)


def _range(rows: pd.DataFrame) -> tuple[np.ndarray, np.ndarray, str]:
    """Reach (rad/s) of the length in most revolutions, below and above, shape (blades,), NaN if unknown, and its meaning."""
    if f"{_IN_MOST}_low" in rows and rows[f"{_IN_MOST}_low"].notna().any():
        low, high = rows[_IN_MOST] - rows[f"{_IN_MOST}_low"], rows[f"{_IN_MOST}_high"] - rows[_IN_MOST]
        return low.clip(lower=0.0).values, high.clip(lower=0.0).values, "nine tenths of the members"
    scatter = rows["length_most_revolutions_scatter_rad_s"].values
    return scatter, scatter, "standard deviation by chance"
