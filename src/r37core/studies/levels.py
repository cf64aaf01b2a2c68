"""Choosing a fidelity level. Light: the workflow imports it."""

from __future__ import annotations

from collections.abc import Mapping


def recommended_level(errors: Mapping[str, float], costs: Mapping[str, float], tolerance: float) -> str | None:
    """The cheapest level whose error is within the tolerance; None if there is none."""
    fitting = [level for level, error in errors.items() if error <= tolerance]
    return min(fitting, key=lambda level: costs[level]) if fitting else None
