"""Units that people read and write beside those of the SI."""

import math
import re
from functools import cache

RPM = 30.0 / math.pi
"""Revolutions per minute of one rad/s."""

RAD_S = {"rad/s": 1.0, "rpm": math.pi / 30.0}
"""Angular speed (rad/s) of one of each unit that speeds may be given in."""

_PLAIN = ("_m", "_m2", "_s", "_hz", "_pa", "_kg", "_kg_m3", "_n_m2", "_rad_s", "_rad_s2", "_clearances")
SUFFIXES = dict.fromkeys(_PLAIN, 1.0) | dict.fromkeys(("_rpm", "_rpm_s"), RAD_S["rpm"])
SUFFIXES |= {"_cm": 0.01, "_percent": 0.01, "_deg": math.pi / 180.0}
"""End of a key or of a table's column -> what one of its unit is in the SI."""

LENGTH_UNITS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "in": 0.0254, "ft": 0.3048}
"""Name of a length unit -> metres."""

MASS_UNITS = {"kg": 1.0, "g": 1e-3, "t": 1e3}
"""Name of a unit of mass -> kg."""

STIFFNESS_UNITS = {"N/m": 1.0, "N/mm": 1e3}
"""Name of a unit of stiffness -> N/m."""

SI_UNITS = {"_m": "m", "_pa": "Pa", "_kg": "kg", "_hz": "Hz", "_rad_s": "rad s-1", "_percent": "percent"}
"""End of a table's column -> its unit as datasets have it."""

LIKE_A_UNIT = re.compile(
    r"_([kcmu]?m|in|ft|m?m[23]|k?g|t|m?s|min|k?hz|[kmg]?pa|k?n|j|k?w|rad|deg|rpm|rad_s2?|rpm_s|percent|kg_m3|n_m2?)$",
    re.IGNORECASE,
)
"""Ends of names that a reader takes for a unit."""

_SHOWN = {"m": ("mm", 1e3), "Pa": ("MPa", 1e-6), "rad s-1": ("rad/s", 1.0), "percent": ("%", 1.0), "1": ("", 1.0)}


def shown_unit(unit: str) -> tuple[str, float]:
    """Unit that values of a dataset's `unit` are shown in to people, "" for a plain number, and the factor to it."""
    return _SHOWN.get(unit, (unit, 1.0))


@cache
def si_name(key: str) -> tuple[str, float | None]:
    """The key without its unit, and what one of that is in the SI; None for a key without a unit."""
    ends = [end for end in SUFFIXES if key.endswith(end)]
    if not ends:
        return key, None
    end = max(ends, key=len)
    return key.removesuffix(end), SUFFIXES[end]


def unit_of(column: str) -> str:
    """Unit of a table's column, as datasets have it, by the end of its name; "1" for a plain number.

    Raises ValueError for a name that ends like a unit which is none of SI_UNITS.
    """
    unit = next((unit for end, unit in SI_UNITS.items() if column.endswith(end)), "1")
    if unit == "1" and LIKE_A_UNIT.search(column):
        raise ValueError(f"{column}: ends like a unit that no column has; known: {', '.join(SI_UNITS)} (units.SI_UNITS)")
    return unit
