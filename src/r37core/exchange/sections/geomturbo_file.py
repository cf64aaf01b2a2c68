"""Files .geomTurbo of NUMECA: suction and pressure side of each section of the first blade, hub and shroud of the channel."""

from collections.abc import Iterator

import numpy as np

from r37core.base.io import TextFileError

from .section_text import FileSection, SectionFile, joined_sides, point_in

_SIDES = ("suction", "pressure")
_FORMS = ("xyz", "zrth", "rthz")
"""Coordinates of a section: x y z; or z, r and the angle (rad); or r, the angle and z."""

Line = tuple[int, str]


def read_geomturbo(text: str) -> SectionFile:
    """Sections and, where the file has a channel, points of its hub and shroud about z. Raises TextFileError."""
    lines = [(number, line.strip()) for number, line in enumerate(text.splitlines(), start=1) if line.strip()]
    sides = {side: _sections(lines, side) for side in _SIDES}
    counts = [len(sides[side]) for side in _SIDES]
    if counts[0] != counts[1]:
        line = sides["pressure"][0][0]
        counted = f"found {counts[0]} sections of the suction and {counts[1]} of the pressure side"
        raise TextFileError(line, f"{counted}; needed: as many of both")
    sections = [
        FileSection(joined_sides(suction, pressure), line)
        for (line, suction), (_, pressure) in zip(sides["suction"], sides["pressure"], strict=True)
    ]
    hub, shroud = (_channel(lines, name) for name in ("hub", "shroud"))
    return SectionFile(tuple(sections), hub, shroud)


def _sections(lines: list[Line], side: str) -> list[tuple[int, np.ndarray]]:
    """First line and points of each section of a side of the first blade."""
    start = next((place for place, (_, text) in enumerate(lines) if text.lower() == side), None)
    if start is None:
        raise TextFileError(1, f"found no line '{side}'; needed: SECTIONAL curves under suction and under pressure")
    rest = iter(lines[start + 1 :])
    number, text = next(rest, (lines[start][0], ""))
    if text.lower() != "sectional":
        raise TextFileError(number, f"found '{text}' under {side}; needed: SECTIONAL, curves of sections")
    return [_section(rest, number) for _ in range(_count(rest, number))]


def _section(rest: Iterator[Line], line: int) -> tuple[int, np.ndarray]:
    line, form = _next(rest, line)
    if form.lower() not in _FORMS:
        raise TextFileError(line, f"found coordinates '{form}'; allowed: {', '.join(_FORMS).upper()}")
    points, first = [], line
    for _ in range(_count(rest, line)):
        line, text = _next(rest, line)
        points.append(point_in(text, line))
    if len(points) < 2:
        raise TextFileError(first, f"found {len(points)} points of a side; needed: at least 2")
    return first, _cartesian(np.array(points), form.lower())


def _cartesian(points: np.ndarray, form: str) -> np.ndarray:
    if form == "xyz":
        return points
    z, r, angle = points.T if form == "zrth" else points[:, [2, 0, 1]].T
    return np.stack([r * np.cos(angle), r * np.sin(angle), z], axis=1)


def _channel(lines: list[Line], name: str) -> np.ndarray | None:
    """Points of the basic curves that make the hub or the shroud of the channel, shape (n, 3)."""
    curves: dict[str, np.ndarray] = {}
    current, rest = "", iter(lines)
    used: list[str] = []
    inside = False
    for number, text in rest:
        words = text.lower().split()
        if words[0] == "name" and len(words) > 1 and not inside:
            current = text.split(None, 1)[1]
        elif words[0] == "zr":
            pairs = [point_in(_next(rest, number)[1], number, 2) for _ in range(_count(rest, number))]
            curves[current] = np.array([(r, 0.0, z) for z, r in pairs])
        elif words[:2] == ["ni_begin", "channel_curve"]:
            inside = words[-1] == name
        elif words[:2] == ["ni_end", "channel_curve"]:
            inside = False
        elif inside and words[0] == "vertex" and len(words) > 3:
            used.append(text.split(None, 2)[2].rsplit(None, 1)[0])
    # without channel curves the basic curves have their names
    parts = [curves[curve] for curve in dict.fromkeys(used or [name]) if curve in curves]
    if not parts:
        return None
    points = np.concatenate(parts)
    return points[np.concatenate([[True], np.any(np.diff(points, axis=0) != 0.0, axis=1)])]


def _next(rest: Iterator[Line], line: int) -> Line:
    """The next line that is no remark; TextFileError at the end of the file."""
    for number, text in rest:
        if not text.startswith("#"):
            return number, text
    raise TextFileError(line, "the file ends within a section; needed: as many sections and points as it announces")


def _count(rest: Iterator[Line], line: int) -> int:
    number, text = _next(rest, line)
    if not text.split()[0].isdigit():
        raise TextFileError(number, f"found '{text}'; needed: how many sections or points follow")
    return int(text.split()[0])
