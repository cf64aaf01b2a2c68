"""Ranges of speed in which a curve is above a level."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class SpeedRange:
    """Speeds (rad/s) from `begin` to `end`; `truncated`: it reaches to the first or last speed of all, and may go on beyond."""

    begin: float
    end: float
    truncated: bool

    @property
    def length(self) -> float:
        """Length of the range (rad/s)."""
        return self.end - self.begin


def ranges_above(speeds: np.ndarray, values: np.ndarray, level: float) -> list[SpeedRange]:
    """Where `values` at ascending `speeds` (rad/s) are above a `level`; between speeds they are a straight line.

    From an infinite value nothing of the way to one below counts.
    """
    above = np.concatenate([[False], values > level, [False]])
    firsts, lasts = np.flatnonzero(~above[:-1] & above[1:]), np.flatnonzero(above[:-1] & ~above[1:]) - 1

    def crossing(inside: int, outside: int) -> float:
        if not 0 <= outside < len(speeds):
            return float(speeds[inside])
        way = (values[inside] - level) / (values[inside] - values[outside]) if np.isfinite(values[inside]) else 0.0
        return float(speeds[inside] + way * (speeds[outside] - speeds[inside]))

    return [
        SpeedRange(crossing(first, first - 1), crossing(last, last + 1), bool(first == 0 or last == len(speeds) - 1))
        for first, last in zip(firsts.tolist(), lasts.tolist(), strict=True)
    ]


def joined(ranges: Sequence[SpeedRange]) -> list[SpeedRange]:
    """Ranges that overlap as one, ascending."""
    merged: list[SpeedRange] = []
    for current in sorted(ranges, key=lambda current: current.begin):
        if merged and current.begin <= merged[-1].end:
            before = merged.pop()
            current = SpeedRange(before.begin, max(before.end, current.end), before.truncated or current.truncated)
        merged.append(current)
    return merged
