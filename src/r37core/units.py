"""Units that people read and write beside those of the SI."""

from __future__ import annotations

import math

RPM = 30.0 / math.pi
"""Revolutions per minute of one rad/s."""

RAD_S = {"rad/s": 1.0, "rpm": math.pi / 30.0}
"""Angular speed (rad/s) of one of each unit that speeds may be given in."""

SUFFIXES = {
    "_m": 1.0,
    "_cm": 0.01,
    "_m2": 1.0,
    "_s": 1.0,
    "_hz": 1.0,
    "_pa": 1.0,
    "_kg": 1.0,
    "_kg_m3": 1.0,
    "_n_m2": 1.0,
    "_rad_s": 1.0,
    "_rad_s2": 1.0,
    "_rpm": RAD_S["rpm"],
    "_rpm_s": RAD_S["rpm"],
    "_deg": math.pi / 180.0,
    "_percent": 0.01,
    "_clearances": 1.0,
}
"""End of a key or of a table's column -> what one of its unit is in the SI."""


def si_name(key: str) -> tuple[str, float | None]:
    """The key without its unit, and what one of that is in the SI; None for a key without a unit."""
    ends = [end for end in SUFFIXES if key.endswith(end)]
    if not ends:
        return key, None
    end = max(ends, key=len)
    return key.removesuffix(end), SUFFIXES[end]
