"""Choosing some of many speeds. Light: the workflow imports it."""

from __future__ import annotations

from collections.abc import Sequence


def sample(speeds: Sequence[float], every: int) -> list[float]:
    """Every so many of the speeds, each from the middle of the stretch it stands for."""
    return list(speeds[min(every // 2, len(speeds) - 1) :: every])
