"""Speeds to simulate: numbers and ranges, joined."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any


class SpeedError(ValueError):
    """Speeds that cannot be used together."""


def expand_speeds(entries: Sequence[float | Mapping[str, Any]], default_step: float) -> tuple[float, ...]:
    """Speeds (rad/s), ascending, of numbers and ranges with `start`, `stop` (included) and, if given, `step`.

    Raises SpeedError for a range that runs backwards and for a speed given twice.
    """
    speeds: list[float] = []
    for entry in entries:
        if not isinstance(entry, Mapping):
            speeds.append(float(entry))
            continue
        start, stop, step = float(entry["start"]), float(entry["stop"]), float(entry.get("step", default_step))
        if stop < start:
            raise SpeedError(f"found a range from {start:g} to {stop:g}; allowed: stop not below start")
        # rounded, so that a step like 0.1 gives the numbers a user would write
        speeds += [round(start + i * step, 9) for i in range(int((stop - start) / step + 1e-9) + 1)]
    speeds.sort()
    twice = [a for a, b in pairwise(speeds) if a == b]
    if twice:
        raise SpeedError(f"found {twice[0]:g} rad/s twice; allowed: each speed once (do the ranges overlap?)")
    return tuple(speeds)
