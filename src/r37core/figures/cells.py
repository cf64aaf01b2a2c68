"""Maps of coloured cells. As an image: drawn cell by cell a map of a sweep takes several times as long."""

from __future__ import annotations

from typing import Any, cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.image import AxesImage


def draw_cells(axes: Axes, across: np.ndarray, upward: np.ndarray, values: np.ndarray, **look: Any) -> AxesImage:
    """Cells about ascending middles `across` and `upward`, coloured by `values`, shape (upward, across); NaN stays empty.

    `look`: what Axes.pcolorfast takes for colours.
    """
    # of middles that are not evenly spaced an AxesImage, too
    return cast(AxesImage, axes.pcolorfast(_edges(across), _edges(upward), values, **look))


def largest_of_bins(order: np.ndarray, values: np.ndarray, most: int) -> tuple[np.ndarray, np.ndarray]:
    """Middles of at most `most` bins of engine orders, and the largest value in each, shape (speeds, bins)."""
    width = -(-len(order) // most)
    whole = len(order) // width * width
    return order[:whole].reshape(-1, width).mean(axis=1), values[:, :whole].reshape(len(values), -1, width).max(axis=2)


def _edges(middles: np.ndarray) -> np.ndarray:
    """Edges of cells about ascending middles, half-way between them; a single one has a cell of length 1."""
    middles = np.asarray(middles, dtype=float)
    if len(middles) == 1:
        return middles[0] + np.array([-0.5, 0.5])
    between = 0.5 * (middles[1:] + middles[:-1])
    return np.concatenate([[2.0 * middles[0] - between[0]], between, [2.0 * middles[-1] - between[-1]]])
