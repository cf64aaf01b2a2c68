"""Spectra with fewer points: the largest amplitude of each bin of engine orders."""

from __future__ import annotations

import numpy as np


def largest_of_bins(order: np.ndarray, values: np.ndarray, most: int) -> tuple[np.ndarray, np.ndarray]:
    """Middles of at most `most` bins of engine orders, and the largest value in each, shape (speeds, bins)."""
    width = -(-len(order) // most)
    whole = len(order) // width * width
    return order[:whole].reshape(-1, width).mean(axis=1), values[:, :whole].reshape(len(values), -1, width).max(axis=2)
