"""Campbell diagrams with the interactions of a run, each a mark by its danger, of the area of its length."""

from collections.abc import Iterable
from itertools import product
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.patheffects import withStroke
from matplotlib.transforms import Bbox
from pandas import DataFrame
from xarray import Dataset

from r37core.results.closing import interaction_title
from r37core.results.events import Danger
from r37core.results.interactions import sized
from r37core.results.measures import ran
from r37core.results.spectral_lines import frequency_named
from r37core.rom.naming import NAMED_MODES
from r37core.time_integration.status import RunStatus

from . import style
from .campbell_diagram import draw_engine_orders
from .danger_rows import LINE, draw_danger_rows, shown_runs

_WIDTH = 5.2
"""Width (inch) at which letters can still be read where a telephone shows the figure."""

_MOST_SCENES, _MOST_LABELS = 6, 5
_LARGEST, _STRIP = 26.0, 0.09
"""Diameter (pt) of the largest circle; how deep below 0 the strip of what has no engine order lies, as a share of the panel."""

_SMALLEST = 25.0
"""Smallest area (pt^2) of a circle, which can still be seen: that of what is not above yield."""

_UNKNOWN, _DANGEROUS = Danger.UNKNOWN.text, Danger.DANGEROUS.text
_MARKS = {
    _DANGEROUS: ("o", np.nan, 0.45, "dangerous"),
    _UNKNOWN: ("D", 60.0, 0.0, "unknown: model left first"),
    Danger.BELOW.text: ("o", _SMALLEST, 0.0, "below yield"),
    "": (".", _SMALLEST, 0.0, "stress not known"),
}
"""`danger` of results.interactions.sized -> marker, its area (pt^2; NaN: by the size), how dense it is, and its meaning."""

_MOST_ROWS, _ROW_HEIGHT = 14, 0.14
"""Blades of which each has a row in each scene, and its height (inch)."""

_LETTERS: dict[Any, Any] = {f"{part}size": 9 for part in ("font.", "axes.label", "xtick.label", "ytick.label", "legend.font")}
_HALO = [withStroke(linewidth=2.0, foreground="white")]
_AWAY = [(side, distance) for distance in (1.5, 12.0, 24.0, 36.0) for side in product((1, -1, 0), (1, -1, 0)) if any(side)]
"""Sides of a circle, across and up, on which its label may stand, and how far from it (pt)."""

_LEADER = {"arrowstyle": "-", "color": "0.3", "linewidth": 0.6, "shrinkA": 0.0, "shrinkB": 0.0}
_OTHERS = "0.45"
"""Colour of blades that have none of their own."""


def draw_interactions(
    campbell: Dataset, rms: Dataset, interactions: DataFrame, stress: Dataset | None = None, further_runs: Dataset | None = None
) -> Figure:
    """Draw a panel for each scene, at most six: those with the longest dangerous ranges; below it danger_rows of the blades.

    `interactions`: summary.csv; `rms`: which speeds were run. A circle stands at the peak speed and at the frequency of its
    engine order there, without one on a strip below. Its area is the length of the dangerous speeds or, in a scene without
    stress, the motion; other marks are unknown or below yield. Lines: dangerous and sustained speeds. Of more than _MOST_ROWS
    blades the title has in place of rows how many runs leave the model. `further_runs`: of a verdict, for the rows.
    """
    rows = sized(interactions, rms)
    lengths = rows[rows["unit"] == "rad/s"].groupby("scene")["size"].max()
    scenes = rms["scene"].values.astype(str).tolist()
    longest = sorted(scenes, key=lambda scene: -lengths.get(scene, 0.0))[:_MOST_SCENES]
    scenes = [scene for scene in scenes if scene in longest]
    rows = rows[rows["scene"].isin(scenes)]
    rows = rows.assign(scale=rows.groupby("unit")["size"].transform("max"))
    blades, largest = campbell["blade"].values.astype(str).tolist(), rows.groupby("blade")["size"].max()
    looks, owner = style.blade_styles(blades), dict[str, str]()
    # each colour is that of the blade with the largest circle that has it
    for blade in sorted(blades, key=lambda blade: -largest.get(blade, -1.0)):
        owner.setdefault(looks[blade]["color"], blade)
    colours = {blade: look["color"] if owner[look["color"]] == blade else _OTHERS for blade, look in looks.items()}
    speeds = rms["speed"].values[(rms["status"] != RunStatus.NOT_RUN).any(("blade", "scene")).values]
    margin = max(0.03 * (speeds[-1] - speeds[0]), 0.01 * speeds[-1])
    _, _, whole = shown_runs(rms, stress, further_runs)
    drawn = rms["blade"].values.tolist() if rms.sizes["blade"] <= _MOST_ROWS else []
    highest = np.nanmin([1.3 * float(campbell["frequency"].sel(mode="2B").max()), 1.15 * rows["frequency"].max()])
    strip = -_STRIP * highest if rows["frequency"].isna().any() else 0.0
    rows = rows.assign(frequency=rows["frequency"].fillna(strip).clip(upper=highest), higher=rows["frequency"] > highest)
    sized_by_motion = rows["unit"] == "mm"
    rows["danger"] = rows["danger"].mask(sized_by_motion, _DANGEROUS)
    rows["area"] = rows["danger"].map({above: area for above, (_, area, *_) in _MARKS.items()})
    rows["area"] = rows["area"].fillna(_LARGEST**2 * rows["size"] / rows["scale"]).fillna(0.0).clip(lower=_SMALLEST)
    with plt.rc_context(_LETTERS | {"axes.titlesize": 10}):
        heights = [3.0 if len(scenes) < 3 else 2.4, _ROW_HEIGHT * len(drawn) or 0.01]
        shape: dict[str, Any] = {"sharex": True, "squeeze": False, "height_ratios": heights * len(scenes)}
        figure, grid = plt.subplots(2 * len(scenes), 1, figsize=(_WIDTH, 1.1 + len(scenes) * sum(heights)), **shape)
        panels = dict(zip(scenes, grid[::2, 0], strict=True))
        # the circles of what is higher stay below the upper scale
        top = highest * (1.08 if rows["higher"].any() else 1.0)
        grid[0, 0].set_xlim(speeds[0] - margin, speeds[-1] + margin)
        style.rpm_axis(grid[0, 0], most_ticks=6)
        grid[-1, 0].set_xlabel(style.SPEED_LABEL)
        for scene, axes in panels.items():
            higher = " (circles at the top edge: higher)" if rows["higher"][rows["scene"] == scene].any() else ""
            left = "" if drawn else _unknown_share(whole.sel(scene=scene))
            axes.set(title=f"{style.scene_words(scene)}{higher}{left}", ylabel="frequency (Hz)", ylim=(2.0 * strip, top))
            axes.grid(visible=False)
            _draw_modes(axes, campbell, dict.fromkeys([*NAMED_MODES, *rows["mode"][rows["scene"] == scene].dropna()]))
            if strip:
                axes.axhline(0.0, color="0.3", linewidth=0.8)
                ticks = [tick for tick in axes.get_yticks() if 0.0 <= tick <= highest]
                axes.set_yticks([strip, *ticks], ["no order", *(f"{tick:g}" for tick in ticks)])
            _draw_marks(axes, rows[rows["scene"] == scene], colours)
        for scene, axes in zip(scenes, grid[1::2, 0], strict=True):
            responses = {blade: ran(whole.sel(scene=scene, blade=blade)) for blade in drawn}
            draw_danger_rows(axes, responses, [looks[blade]["color"] for blade in drawn])
            axes.tick_params(axis="y", labelsize=6)
            axes.set_visible(bool(drawn))
        close: dict[str, Any] = {"handletextpad": 0.1, "columnspacing": 1.0}
        style.legend_below(figure, grid[::2, 0], 5, **close)
        if not sized_by_motion.all():
            known = {above: mark for above, mark in _MARKS.items() if above or "" in set(rows["danger"])}
            keys = [
                Patch(**style.UNKNOWN)
                if above == _UNKNOWN
                else Line2D([], [], marker=mark, markerfacecolor=to_rgba("0.2", share), linestyle="", markeredgecolor="0.2")
                for above, (mark, _, share, _) in known.items()
            ]
            labels = [label for *_, label in known.values()]
            if drawn:
                keys, labels = [*keys, LINE], [*labels, "sustained"]
            figure.legend(keys, labels, loc="outside upper center", ncols=4, **close)
        figure.draw_without_rendering()
        # above yield or with a motion, the longest first and then those with the most revolutions
        dangerous = rows[rows["danger"].isin([_DANGEROUS, _UNKNOWN])]
        dangerous = dangerous.sort_values(["size", "share_of_revolutions_above_yield"], ascending=False)
        for scene, axes in panels.items():
            _label(axes, dangerous[dangerous["scene"] == scene], figure.dpi / 72.0, named=len(colours) > 1)
    return figure


def _draw_modes(axes: Axes, campbell: Dataset, names: Iterable[str]) -> None:
    """Engine orders, and modes and combinations by name: a line, or a band from the lowest to the highest blade."""
    (left, right), highest = axes.get_xlim(), axes.get_ylim()[1]
    orders = campbell["engine_order"].values
    draw_engine_orders(axes, orders[orders * left < 2.0 * np.pi * highest], np.array([left, right]), highest, letters=8)
    for mode in filter(None, names):
        frequency = frequency_named(campbell, mode)
        low, high, look = frequency.min("blade"), frequency.max("blade"), "-" if mode in NAMED_MODES else "--"
        axes.fill_between(campbell["speed"], low, high, color="0.5", alpha=0.25, linewidth=0.0, zorder=1.0)
        for edge in (low, high):
            axes.plot(campbell["speed"], edge, look, color="0.35", linewidth=0.9, zorder=1.1)
        place = (left, float(np.interp(left, campbell["speed"], high)))
        # the name of a mode at the upper edge would stand above the panel
        if place[1] < 0.95 * highest:
            axes.annotate(
                mode,
                place,
                xytext=(3, 2),
                textcoords="offset points",
                va="bottom",
                fontweight="bold",
                color="0.2",
                path_effects=_HALO,
            )


def _draw_marks(axes: Axes, rows: DataFrame, colours: dict[str, str]) -> None:
    """Marks, the largest first, on lines along the speeds above yield; crosses for what diverged."""
    if rows.empty:
        style.say(axes, "no interaction was found")
        return
    for blade in [blade for blade in colours if blade in set(rows["blade"])] if len(colours) > 1 else []:
        axes.scatter([], [], 30.0, color=colours[blade], label="other blades" if colours[blade] == _OTHERS else blade)
    for row in rows.to_dict("records"):
        ends = np.array([row["from_rad_s"], row["to_rad_s"]], float)
        along = ends / row["peak_speed_rad_s"] if row["frequency"] > 0.0 and not row["higher"] else 1.0
        heights, colour = row["frequency"] * np.broadcast_to(along, 2), colours[row["blade"]]
        axes.plot(ends, heights, color=colour, linewidth=2.5, alpha=0.45, zorder=2.4, solid_capstyle="butt")
    diverged = rows["status"] == RunStatus.DIVERGED.text
    for above, (marker, _, share, _) in _MARKS.items():
        part = rows[(rows["danger"] == above) & (~diverged | (rows["size"] > 0.0))].sort_values("area", ascending=False)
        faces, edges = ([to_rgba(colours[blade], alpha) for blade in part["blade"]] for alpha in (share, 1.0))
        x, y = _places(part)
        look: dict[str, Any] = {"marker": marker, "linewidths": 0.9, "zorder": 2.5, "clip_on": False}
        look |= {"hatch": style.UNKNOWN["hatch"] * 2} if above == _UNKNOWN else {}
        axes.scatter(x, y, part["area"], facecolors=faces, edgecolors=edges, **look)
    if diverged.any():
        axes.plot(*_places(rows[diverged]), "x", color="red", zorder=2.6, label="diverged", clip_on=False)


def _unknown_share(runs: Dataset) -> str:
    """How many runs of all blades leave the model first; nothing where none does."""
    left = np.count_nonzero(runs["exit_revolution"].notnull())
    return f" ({left} of {np.count_nonzero(runs['status'] != RunStatus.NOT_RUN)} runs leave the model)" if left else ""


def _places(rows: DataFrame) -> tuple[pd.Series, pd.Series]:
    return rows["peak_speed_rad_s"], rows["frequency"]


def _label(axes: Axes, rows: DataFrame, point: float, *, named: bool) -> None:
    """Label the largest circles, as far as there is room: neither on each other nor on other circles. `point`: in pixels."""
    radii = 0.5 * np.sqrt(rows["area"].values)
    middles = axes.transData.transform(np.column_stack(_places(rows)))
    reach = point * radii[:, None]
    circles = [Bbox(corners) for corners in np.stack([middles - reach, middles + reach], axis=1)]
    taken: list[Bbox] = []
    for number, row in enumerate(rows.to_dict("records")):
        avoided = [*taken, *circles[:number], *circles[number + 1 :]]
        for (across, up), distance in _AWAY:
            offset = (radii[number] + distance) * np.array([across, up]) / np.hypot(across, up)
            xy = (row["peak_speed_rad_s"], row["frequency"])
            place: dict[str, Any] = {"xy": xy, "xytext": offset, "textcoords": "offset points"}
            sides: dict[str, Any] = {"ha": ("center", "left", "right")[across], "va": ("center", "bottom", "top")[up]}
            text = axes.annotate(_text(row, named=named), **place, **sides, path_effects=_HALO)
            box = text.get_window_extent()
            if axes.bbox.contains(*box.min) and axes.bbox.contains(*box.max) and not box.count_overlaps(avoided):
                axes.annotate("", **place, arrowprops=_LEADER)
                taken.append(box)
                break
            text.remove()
        if len(taken) == _MOST_LABELS:
            return


def _text(row: dict[str, Any], *, named: bool) -> str:
    """Label of a mark: Ref 1B/4, 98 rad/s; of an unknown one: Ref 1B/5, unknown after 0.8 x yield."""
    order = row["engine_order"]
    title = interaction_title(row["mode"], order).removeprefix("engine ") if pd.notna(order) else ""
    name = " ".join([row["blade"]] * named + [title] * bool(title))
    amount = f"{row['size']:.0f}" if row["size"] >= 10.0 else f"{row['size']:.2g}"
    amount = f"{'> ' * row['onward']}{amount} {row['unit']}"
    if row["danger"] == _UNKNOWN:
        # a run that leaves the model in its first revolution has no stress inside
        inside = row["largest_stress_over_yield"]
        amount = f"{_UNKNOWN} after {inside:.2g} x yield" if inside > 0.0 else _UNKNOWN
    return f"{name}, {amount}" if name else amount
