"""What an interaction is called. Light: a run's closing lines need it where nothing of results is loaded."""

from __future__ import annotations


def interaction_title(mode: str, engine_order: str | int | None) -> str:
    """What meets there: 1B/4, the engine order alone without a mode, or neither."""
    if mode:
        return f"{mode}/{engine_order}"
    return "a peak of its own" if engine_order in (None, "") else f"engine order {engine_order}"
