"""The first picture of README: speeds above yield of the seven blades, with lining and without, linear and of second order."""

from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from r37core.figures import style
from r37core.results.ranking import read_ranking

from .which_blade import write_ranks

SCENES = {"material_abradable": "abradable lining", "direct": "bare casing"}
LENGTHS = ("linear", "second order", "worst motion")
NEUTRAL = "#767676"
"""Grey of letters and lines that can be read on a white and on a dark page."""

ON_ANY_PAGE: dict[Any, Any] = {
    **dict.fromkeys(("text.color", "axes.labelcolor", "axes.edgecolor", "xtick.color", "ytick.color"), NEUTRAL),
    **dict.fromkeys(("figure.facecolor", "axes.facecolor"), "none"),
    **{f"{name}size": 10 for name in ("font.", "axes.title", "axes.label", "xtick.label", "ytick.label", "legend.font")},
    "grid.color": NEUTRAL,
}
_COLOURS = {"linear": "#B0B0B0", "second order": "#D55E00"}


def draw(input: Any, output: Any, params: Any) -> None:
    """Bars by blade. Inputs: linear, quadratic, rankings. Outputs: table, with the rank in brackets; picture."""
    linear, quadratic = (read_ranking(file).set_index("blade") for file in (input.linear, input.quadratic))
    columns: dict[str, pd.Series] = {}
    for scene, words in SCENES.items():
        of_scene = quadratic[quadratic["scene"] == scene]
        length = "length_most_revolutions_rad_s"
        worst = np.maximum(of_scene[length], of_scene["length_most_revolutions_worst_rad_s"])
        for name, values in zip(LENGTHS, (linear[linear["scene"] == scene][length], of_scene[length], worst), strict=True):
            columns[f"{words}: {name}"] = values
    lengths = pd.DataFrame(columns).sort_values("bare casing: second order")
    write_ranks(lengths, output.table)
    with plt.rc_context(ON_ANY_PAGE):
        figure, panels = plt.subplots(2, 1, figsize=(5.2, 6.0))
        for axes, words in zip(panels, SCENES.values(), strict=True):
            _bars(axes, lengths[[f"{words}: {name}" for name in LENGTHS]].set_axis(LENGTHS, axis=1))
            axes.set_title(words, loc="left", fontweight="bold")
        panels[-1].set_xlabel("speeds above yield, of 1,250 rad/s")
        figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=3, handlelength=1.2)
        style.save(figure, output.picture, dots_per_inch=150)


def _bars(axes: Axes, lengths: pd.DataFrame) -> None:
    """A pair of bars for each blade, the best at the top, with their lengths and a mark at that of the worst motion."""
    places = np.arange(len(lengths), dtype=float)
    for offset, (name, colour) in zip((-0.19, 0.19), _COLOURS.items(), strict=True):
        label = {"linear": "linear theory", "second order": "large displacements"}[name]
        axes.barh(places + offset, lengths[name], 0.36, color=colour, label=label)
    axes.plot(
        lengths["worst motion"],
        places + 0.19,
        "|",
        color="#0072B2",
        markersize=9,
        markeredgewidth=2.2,
        label="its worst motion",
    )
    for place, row in zip(places, lengths.itertuples(index=False), strict=True):
        linear, second_order, worst = row
        for up, reach, text in ((-0.19, linear, f"{linear:.0f}"), (0.19, worst, f"{second_order:.0f}, worst {worst:.0f}")):
            axes.annotate(text, (reach, place + up), (5, 0), textcoords="offset points", va="center", fontsize=9)
    axes.set(yticks=places, yticklabels=lengths.index, xlim=(0.0, 1250.0))
    axes.invert_yaxis()
    axes.grid(visible=False, axis="y")
    axes.tick_params(axis="y", length=0)
