"""Speeds to simulate: numbers and ranges, joined; and how a speed stands in file names."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any

LARGEST_NUMBER = 100_000
"""Speeds of one blade in one scene."""


class SpeedError(ValueError):
    """Speeds that cannot be used together."""


def expand_speeds(entries: Sequence[float | Mapping[str, Any]], default_step: float) -> tuple[float, ...]:
    """Speeds (rad/s), ascending, of numbers and ranges with `start`, `stop` (included) and, if given, `step`.

    Raises SpeedError for a range that runs backwards, for more than LARGEST_NUMBER and for a speed given twice.
    """
    speeds: list[float] = []
    for entry in entries:
        if not isinstance(entry, Mapping):
            speeds.append(float(entry))
            continue
        start, stop, step = float(entry["start"]), float(entry["stop"]), float(entry.get("step", default_step))
        if stop < start:
            raise SpeedError(f"found a range from {start:g} to {stop:g}; allowed: stop not below start")
        intervals = (stop - start) / step + 1e-9
        if not len(speeds) + intervals < LARGEST_NUMBER:
            raise SpeedError(
                f"found {intervals + 1:.4g} speeds from {start:g} to {stop:g} rad/s in steps of {step:g}; "
                f"allowed: at most {LARGEST_NUMBER} speeds together"
            )
        # rounded, so that a step like 0.1 gives the numbers a user would write
        speeds += [round(start + i * step, 9) for i in range(int(intervals) + 1)]
    speeds.sort()
    twice = [a for a, b in pairwise(speeds) if a == b]
    if twice:
        raise SpeedError(f"found {exact_text(twice[0])} rad/s twice; allowed: each speed once (do the ranges overlap?)")
    return tuple(speeds)


def exact_text(number: float) -> str:
    """The shortest text that `float` reads as exactly this number, without a trailing .0: how numbers stand in file names."""
    return repr(float(number)).removesuffix(".0")
