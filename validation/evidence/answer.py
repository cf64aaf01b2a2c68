"""Colours and sizes of pictures that stand on a white and on a dark page."""

from typing import Any

NEUTRAL = "#767676"
"""Grey of letters and lines that can be read on both."""

ON_ANY_PAGE: dict[Any, Any] = {
    **dict.fromkeys(("text.color", "axes.labelcolor", "axes.edgecolor", "xtick.color", "ytick.color"), NEUTRAL),
    **dict.fromkeys(("figure.facecolor", "axes.facecolor"), "none"),
    **{f"{name}size": 10 for name in ("font.", "axes.title", "axes.label", "xtick.label", "ytick.label", "legend.font")},
    "grid.color": NEUTRAL,
}
