"""Area and centre of area of a plane polygon."""

from __future__ import annotations

import numpy as np


def area_and_centroid(x: np.ndarray, y: np.ndarray) -> tuple[float, float, float]:
    """Signed area (positive counter-clockwise) and centre of area of the closed polygon with corners (x, y).

    Shoelace formula, about the mean corner to keep the digits of a small polygon far from the origin.
    """
    x_mean, y_mean = float(np.mean(x)), float(np.mean(y))
    x, y = x - x_mean, y - y_mean
    x_next, y_next = np.roll(x, -1), np.roll(y, -1)
    cross = x * y_next - x_next * y
    area = 0.5 * float(np.sum(cross))
    x_centroid = float(np.sum((x + x_next) * cross)) / (6.0 * area)
    y_centroid = float(np.sum((y + y_next) * cross)) / (6.0 * area)
    return area, x_mean + x_centroid, y_mean + y_centroid
