"""Blades compared: around an interaction that they share, and by their speeds above yield, scene by scene."""

from collections.abc import Sequence
from textwrap import fill

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from pandas import DataFrame
from xarray import Dataset

from r37core.results.columns import LEFT_BY, LENGTHS, names
from r37core.results.measures import leading_edge, ran
from r37core.rom.reduction_choice import LINEAR
from r37core.time_integration.status import RunStatus

from . import style
from .danger_rows import LEGEND, ROW_HEIGHT, draw_danger_rows, shown_runs

_MOST_RANKED = 60
"""Blades whose bars fit in a picture."""

_DANGEROUS, _UNKNOWN, _SUSTAINED = names(LENGTHS)


def shared_order(campbell: Dataset, low: float, high: float) -> int | None:
    """The engine order whose crossings with 1B most blades have between `low` and `high` (rad/s), of several the lowest.

    None where no blade has any.
    """
    crossing = campbell["crossing_speed"].sel(mode="1B")
    count = ((crossing >= low) & (crossing <= high)).sum("blade").values
    return int(campbell["engine_order"].values[int(np.argmax(count))]) if count.max() else None


def draw_comparison(
    campbell: Dataset,
    rms: Dataset,
    stress: Dataset | None = None,
    title: str = "",
    further_runs: Dataset | None = None,
    *,
    below: float,
    above: float,
) -> Figure:
    """All blades in one scene about their crossing of 1B with the engine order that most of them meet.

    Speeds are those above the crossing, as shares of it: the crossings of the blades lie hundreds of rad/s apart. The
    picture reaches from `below` to `above` the crossing, as shares too: where peaks are looked for. Runs that diverged are
    crosses of the blade's colour at the upper edge. The title names the blades of which no run lies there, with their
    crossings. `further_runs`: of a verdict.
    """
    rms, stress, whole = shown_runs(rms, stress, further_runs)
    styles = style.blade_styles(rms["blade"].values)
    order = shared_order(campbell, float(rms["speed"].min()), float(rms["speed"].max()))
    crossings = campbell["crossing_speed"].sel(mode="1B", engine_order=order).to_series() if order else {}
    windows = {blade: slice((1.0 - below) * speed, (1.0 + above) * speed) for blade, speed in dict(crossings).items()}
    responses = {blade: ran(whole.sel(blade=blade, speed=window)) for blade, window in windows.items() if window.start > 0.0}
    drawn = {blade: response for blade, response in responses.items() if response.sizes["speed"]}
    curves = {f"rms, {direction} (mm)": f"rms_{direction}" for direction in ("normal", "tangential")}
    if stress is not None:
        curves[style.stress_label(stress)] = "max_von_mises_ever"
    heights = [*[1.8] * len(curves), ROW_HEIGHT * max(len(drawn), 1)]
    figure, grid = style.panels(len(heights), 1, 0.8 + sum(heights), sharex=True, height_ratios=heights)
    *panels, rows = grid[:, 0]
    for axes, (label, name) in zip(panels, curves.items(), strict=True):
        for blade, response in drawn.items():
            runs, look = leading_edge(response).dropna("speed", subset=[name]), styles[blade]
            places = 100 * (runs["speed"] / crossings[blade] - 1.0)
            if name.startswith("rms"):
                axes.plot(places, 1e3 * runs[name], marker=".", markersize=3, label=blade, **look)
            else:
                style.stress_band(axes, places, runs, blade, **look)
            diverged = response["speed"].values[response["status"].values == RunStatus.DIVERGED]
            style.mark_diverged(axes, 100 * (diverged / crossings[blade] - 1.0), look["color"])
        axes.axvline(0.0, color="0.5", linewidth=0.8, linestyle=":")
        axes.set_ylabel(label)
    if stress is not None:
        style.yield_lines(panels[-1], stress["yield_stress"].to_series(), named=True, linear=style.is_linear(stress))
    for axes in panels:
        axes.set_ylim(bottom=0.0)
    colours = [styles[blade]["color"] for blade in drawn]
    draw_danger_rows(rows, drawn, colours, lambda blade, speed: 100 * (speed / crossings[blade] - 1.0))
    if order:
        rows.set_xlabel(f"speed above the crossing of 1B with engine order {order} (%)")
    else:
        style.say(panels[0], "no crossing of 1B was run: see the figures of each blade")
    # of two designs the better one may be the one whose crossing was not run
    left_out = {blade: speed for blade, speed in dict(crossings).items() if blade not in drawn}
    texts = [f"{blade} ({'no crossing' if np.isnan(speed) else f'{speed:.0f} rad/s'})" for blade, speed in left_out.items()]
    missing = fill(f"not drawn, as no speed near their own crossing was run: {', '.join(texts)}", 110) if texts else ""
    panels[0].set_title(f"blades in scene {title}\n{missing}".strip())
    if drawn:
        style.legend_below(figure, panels, 3, LEGEND)
    return figure


def draw_ranking(ranking: DataFrame, scenes: Sequence[str] | None = None) -> Figure:
    """Bars of dangerous and unknown speeds with a mark of sustained ones, a panel per scene with its blades by their rank.

    Before each name stand the places that its blade may have. `scenes`: those that are drawn, or all. Of many blades the first
    and the last are drawn; a row between them says how many are left out.
    """
    scenes = [name for name in dict.fromkeys(ranking["scene"]) if scenes is None or name in scenes]
    tables = {scene: ranking[ranking["scene"] == scene].set_index("blade") for scene in scenes}
    half = _MOST_RANKED // 2
    for scene, rows in tables.items():
        if len(rows) > _MOST_RANKED:
            # with a row of nothing between the first and the last
            tables[scene] = rows.reindex([*rows.index[:half], f"({len(rows) - _MOST_RANKED} more)", *rows.index[-half:]])
    columns = min(len(scenes), 2)
    lines = -(-len(scenes) // columns)
    figure, panels = style.panels(lines, columns, 0.7 + lines * (0.5 + 0.34 * max(3, *map(len, tables.values()))))
    for axes in panels.flat[len(scenes) :]:
        axes.set_visible(False)
    contacts = ranking["contact"].unique()
    for axes, (scene, table) in zip(panels.flat, tables.items(), strict=False):
        _draw_bars(axes, table, named=len(contacts) > 1)
        tied = len(table) > 1 and not (table["rank_lowest"] > 1).any()
        title = f"{style.scene_words(scene)}{': cannot be ranked' if tied else ''}"
        axes.set(title=title, xlabel="speeds (rad/s): dangerous / unknown / sustained")
    if len(contacts) == 1 and contacts[0]:
        nodes, _, kinematics = contacts[0].partition(", ")
        figure.suptitle(f"contact: {nodes}; kinematics: {kinematics or LINEAR}")
    style.legend_below(figure, panels.flat, 2)
    return figure


def _draw_bars(axes: Axes, rows: DataFrame, *, named: bool) -> None:
    """Bars of one scene, the best above; with `named` contacts under the names of the blades."""
    positions = np.arange(float(len(rows)))
    axes.barh(positions, rows[_DANGEROUS], 0.7, color="C0", label="dangerous: yield is passed inside the model")
    unknown = {"left": rows[_DANGEROUS], "label": "unknown: the model is left first", **style.UNKNOWN}
    axes.barh(positions, rows[_UNKNOWN], 0.7, **unknown)
    sustained = rows[_SUSTAINED].to_numpy(float)
    axes.vlines(sustained, positions - 0.4, positions + 0.4, color="0.1", label="sustained: in most later revolutions")
    # reach of the length of the dangerous speeds, below and above; NaN if unknown
    if f"{_DANGEROUS}_low" in rows and rows[f"{_DANGEROUS}_low"].notna().any():
        reach = rows[_DANGEROUS] - rows[f"{_DANGEROUS}_low"], rows[f"{_DANGEROUS}_high"] - rows[_DANGEROUS]
        (low, high), meaning = (each.clip(lower=0.0).values for each in reach), "nine tenths of the members"
    else:
        high, meaning = rows["length_dangerous_within_rad_s"].values, "dangerous, known to within"
        low = np.minimum(high, rows[_DANGEROUS].values)
    if np.isfinite(low).any():
        axes.errorbar(
            rows[_DANGEROUS], positions, xerr=[low, high], fmt="none", ecolor="0.15", elinewidth=1.0, capsize=2.5, label=meaning
        )
    ends = np.fmax(np.fmax(rows[_DANGEROUS] + rows[_UNKNOWN], rows[_SUSTAINED]), rows[_DANGEROUS] + np.nan_to_num(high))
    largest = np.nanmax([1.0, *ends])
    for position, end, (_, row) in zip(positions, ends, rows.iterrows(), strict=True):
        if np.isfinite(end):
            numbers = " / ".join(f"{row[name]:.0f}" for name in (_DANGEROUS, _UNKNOWN, _SUSTAINED))
            causes = ", ".join(cause.text for cause, column in LEFT_BY.items() if row[column.name] > 0.0)
            axes.text(end + 0.02 * largest, position, f"{numbers}{causes and ' by '}{causes}", va="center", fontsize=7)
    labels = []
    for blade, row in rows.iterrows():
        # of a row that stands for several, or a blade without stress, they are not known
        places = [f"{row[name]:.0f}" for name in ("rank_lowest", "rank_highest") if pd.notna(row[name])]
        contact = row["contact"] if named and pd.notna(row["contact"]) else ""
        labels.append(f"{' to '.join(dict.fromkeys(places))}  {blade}\n{contact}".strip())
    axes.set_yticks(positions, labels)
    axes.grid(visible=False, axis="y")
    axes.set_axisbelow(True)
    axes.set(xlim=(0.0, 1.45 * largest), ylim=(len(rows) - 0.5, -0.5))
