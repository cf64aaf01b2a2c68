"""The figure of the extremes."""

import matplotlib.pyplot as plt
import pandas as pd
from matplotlib.figure import Figure

from r37core.figures import style

COLOURS = {"accurate": "#009E73", "degraded": "#E69F00", "diverged": "#D55E00", "refused": "0.7", "unsound": "#000000"}
"""Outcome -> colour."""


def draw_stability(table: pd.DataFrame) -> Figure:
    """The outcome of every value of every extreme, one panel per scene."""
    names, scenes = list(table["what"].unique()), list(table["scene"].unique())
    height = 0.8 + 0.26 * len(names)
    figure, panels = plt.subplots(1, len(scenes), figsize=(style.PAGE, height), sharey=True, squeeze=False)
    places = table.groupby(["scene", "what"]).cumcount()
    for axes, scene in zip(panels[0], scenes, strict=True):
        for outcome, colour in COLOURS.items():
            rows = table[(table["scene"] == scene) & (table["outcome"] == outcome)]
            heights = [names.index(name) for name in rows["what"]]
            axes.scatter(places[rows.index], heights, marker="s", s=70, color=colour, label=outcome)
            for x, y, value in zip(places[rows.index], heights, rows["value"], strict=True):
                axes.annotate(f"{value:g}", (x, y), xytext=(7, 0), textcoords="offset points", fontsize=5.5, va="center")
        axes.set(title=scene, xticks=[], xlim=(-0.5, places.max() + 1.0), ylim=(len(names) - 0.5, -0.5))
        axes.set_yticks(range(len(names)), [name.replace("_", " ") for name in names])
        axes.grid(False)
    figure.legend(*style.legend_entries(panels[0]), loc="outside lower center", ncols=len(COLOURS))
    return figure
