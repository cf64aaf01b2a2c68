"""Arrays as a page carries them, and thinning: maps of a long sweep have more cells than a screen has points."""

from __future__ import annotations

import base64
import gzip

import numpy as np

MOST_SPEEDS = 400
"""Speeds of a map; beyond it neighbours are joined by their maximum. Curves keep every speed."""

MOST_ANGLES = 180
ORDERS_PER_STEP = 0.1
"""Width of a spectrum's bins in engine orders; a bin has the largest amplitude in it."""


def packed(values: np.ndarray, bits: int = 32) -> dict[str, object]:
    """Numbers as little-endian floats, compressed, in base64, with their shape; speeds take 64 bits, to stay what they are."""
    data = np.ascontiguousarray(values, dtype=f"<f{bits // 8}")
    compressed = gzip.compress(data.tobytes(), mtime=0)
    return {"shape": list(data.shape), "bits": bits, "base64": base64.b64encode(compressed).decode("ascii")}


def rounded(values: np.ndarray) -> np.ndarray:
    """To 14 binary digits, a relative error of at most 6e-5: what a map shows, and half as much to carry."""
    whole = np.ascontiguousarray(values, dtype=np.float32).view(np.uint32)
    near = ((whole + np.uint32(1 << 9)) & np.uint32(~((1 << 10) - 1) & 0xFFFFFFFF)).view(np.float32)
    return np.where(np.isfinite(values), near, np.float32(np.nan))


def joined(values: np.ndarray, axis: int, starts: np.ndarray) -> np.ndarray:
    """Largest of `values` in each stretch along an axis; `starts`: where the stretches begin. NaN where all are."""
    filled = np.where(np.isnan(values), -np.inf, values)
    largest = np.maximum.reduceat(filled, starts, axis=axis)
    return np.where(np.isneginf(largest), np.nan, largest)


def stretches(number: int, most: int) -> np.ndarray:
    """Where stretches of equal length begin, at most `most` of them."""
    length = -(-number // most)
    return np.arange(0, number, length)


def order_bins(orders: np.ndarray) -> np.ndarray:
    """Where bins of ORDERS_PER_STEP begin, each centred on a multiple of it; `orders`, shape (orders,), ascend from 0."""
    bins = np.floor(orders / ORDERS_PER_STEP + 0.5 + 1e-9)
    return np.flatnonzero(np.diff(bins, prepend=-1.0) > 0.0)
