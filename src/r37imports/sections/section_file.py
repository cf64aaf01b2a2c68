"""Files of section curves, by their endings: .curve, .crv, .geomTurbo, .csv."""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

from r37core.base.io import TextFileError, read_text
from r37core.base.table_text import table_rows
from r37core.base.units import LENGTH_UNITS
from r37core.blade.profile import BladeShapeError

from .section_curve import cartesian

_NUMBER = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([ed][-+]?[0-9]+)?", re.IGNORECASE)
_EQUAL, _LARGEST = 1e-9, 1e9
"""Distance of two points that are one, as a share of the section's size; a number beyond any coordinate in any unit."""


@dataclass(frozen=True)
class FileSection:
    """A section: its closed curve, points in the file's unit and axes, shape (n, 3), and the line where it begins."""

    points: np.ndarray
    line: int


@dataclass(frozen=True)
class SectionFile:
    """Content of a file: sections in its order; points of the meridians of hub and tip, shape (n, 3), or None.

    `unit`: the unit of length that the file names, or an empty text.
    """

    sections: tuple[FileSection, ...]
    hub: np.ndarray | None = None
    tip: np.ndarray | None = None
    unit: str = ""


def number_in(text: str, line: int, what: str) -> float:
    """Number of a cell, with an exponent e or d; TextFileError for another text."""
    number = float(text.lower().replace("d", "e")) if _NUMBER.fullmatch(text) else np.inf
    if abs(number) > _LARGEST:
        allowed = f"coordinates such as 0.25 or 2.5e-1, of at most {_LARGEST:g}"
        raise TextFileError(line, f"{what}: '{text}' is not a number of a blade; allowed: {allowed}, or leave the point out")
    return number


def point_in(text: str, line: int, count: int = 3) -> list[float]:
    """The first `count` numbers of a line, separated by blanks or commas; words may follow. Raises TextFileError."""
    cells = [cell for cell in re.split(r"[\s,;]+", text.strip()) if cell]
    if len(cells) < count:
        raise TextFileError(line, f"found {len(cells)} values; needed: {count}, separated by blanks or commas")
    extra = [cell for cell in cells[count:] if _NUMBER.fullmatch(cell)]
    if extra:
        raise TextFileError(line, f"found {count + len(extra)} numbers; needed: {count}, separated by blanks or commas")
    return [number_in(cell, line, f"value {place + 1}") for place, cell in enumerate(cells[:count])]


def closed(points: np.ndarray) -> np.ndarray:
    """Points of a closed curve without those that repeat the one before them, the first at the end among them."""
    size = max(float(np.ptp(points, axis=0).max()), 1e-300)
    steps = np.linalg.norm(points - np.roll(points, 1, axis=0), axis=1)
    return points[steps > _EQUAL * size]


def joined_sides(side: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Closed curve along one side and back along the other, which may run either way."""
    back = min((other, other[::-1]), key=lambda way: np.linalg.norm(side[-1] - way[0]) + np.linalg.norm(side[0] - way[-1]))
    return closed(np.concatenate([side, back]))


def read_table(text: str) -> SectionFile:
    """Sections of a table (CSV), in the order of their first rows. Raises TextFileError.

    Columns section, x, y, z, and side where the two sides of a section are apart.
    """
    # section -> side -> points
    sections: dict[str, dict[str, list[list[float]]]] = {}
    lines: dict[str, int] = {}
    rows = table_rows(text)
    first, header = next(rows, (1, []))
    header = [title.lower() for title in header]
    if missing := [column for column in ("section", "x", "y", "z") if column not in header]:
        lacking = f"the table lacks the columns {', '.join(missing)}"
        raise TextFileError(first, f"{lacking}; needed: section, x, y, z, separated by commas")
    for line, cells in rows:
        if len(cells) != len(header):
            raise TextFileError(line, "the row has more or fewer cells than the first line has columns")
        row = dict(zip(header, cells, strict=True))
        lines.setdefault(row["section"], line)
        point = [number_in(row[column], line, f"column {column}") for column in "xyz"]
        sections.setdefault(row["section"], {}).setdefault(row.get("side", ""), []).append(point)
    if not sections:
        raise TextFileError(1, "found no rows; needed: section, x, y, z of each point")
    return SectionFile(tuple(_joined_section(sides, lines[name]) for name, sides in sections.items()))


def _joined_section(sides: dict[str, list[list[float]]], line: int) -> FileSection:
    if len(sides) > 2:
        raise TextFileError(line, f"found {len(sides)} values in the column side of one section; allowed: one or two")
    parts = [np.array(points) for points in sides.values()]
    return FileSection(closed(parts[0]) if len(parts) == 1 else joined_sides(*parts), line)


_REMARK = ("#", "!", "//")


def read_profiles(text: str) -> SectionFile:
    """Sections of a profile.curve of BladeGen or TurboGrid. Raises TextFileError.

    Points x y z, one a line; a line that begins with # starts a profile.
    """
    profiles: list[tuple[int, list[list[float]]]] = []
    begins = True
    for number, line in enumerate(map(str.strip, text.splitlines()), start=1):
        if not line or line.startswith(_REMARK):
            # remarks before the first profile, and several lines in a row, start one
            begins = begins or line.startswith("#")
            continue
        if begins:
            profiles.append((number, []))
            begins = False
        profiles[-1][1].append(point_in(line, number))
    if not profiles:
        raise TextFileError(1, "found no points; needed: x y z in a line each, and a line with # before each profile")
    return SectionFile(tuple(FileSection(closed(np.array(points)), line) for line, points in profiles))


def read_meridian(file: Path) -> np.ndarray:
    """Points of a hub.curve or shroud.curve, shape (n, 3). Raises TextFileError and OSError."""
    lines = enumerate(map(str.strip, read_text(file).splitlines()), start=1)
    points = [point_in(line, number) for number, line in lines if line and not line.startswith(_REMARK)]
    if len(points) < 2:
        raise TextFileError(1, f"found {len(points)} points of a meridian; needed: at least 2, x y z in a line each")
    return np.array(points)


_COUNT = re.compile(r"\+?0*[1-9][0-9]{0,8}", re.ASCII)
_FORMS = {"xyz": None, "zrth": [1, 2, 0], "rthz": [0, 1, 2]}
"""Coordinates of a section: x y z, or places of r, of the angle (rad) and of z."""

Line = tuple[int, str]


def read_geomturbo(text: str) -> SectionFile:
    """Sections of the one blade of a .geomTurbo of NUMECA and, where it has a channel, points of hub and shroud about z.

    Raises TextFileError.
    """
    lines = [(number, line.strip()) for number, line in enumerate(text.splitlines(), start=1) if line.strip()]
    blades = [str(number) for number, line in lines if line.lower() == "suction"]
    if len(blades) > 1:
        counted = f"found {len(blades)} blades, with suction sides in lines {', '.join(blades)}"
        raise TextFileError(int(blades[1]), f"{counted}; allowed: one, in a file without the others")
    unit = ""
    for number, line in lines:
        name, *words = line.lower().split()
        if name not in ("units", "units-factor"):
            continue
        factor = number_in(words[0] if words else "", number, name)
        # many write 1 in any unit
        fitting = [known for known, metres in LENGTH_UNITS.items() if np.isclose(factor, metres, 1e-6, 0.0)]
        if not fitting:
            allowed = ", ".join(f"{metres:g} ({known})" for known, metres in LENGTH_UNITS.items())
            raise TextFileError(number, f"found {line}; allowed, in metres: {allowed}")
        unit = "" if factor == 1.0 else fitting[0]
    suction, pressure = (_sections(lines, side) for side in ("suction", "pressure"))
    if len(suction) != len(pressure):
        counted = f"found {len(suction)} sections of the suction and {len(pressure)} of the pressure side"
        raise TextFileError(pressure[0][0], f"{counted}; needed: as many of both")
    pairs = zip(suction, pressure, strict=True)
    sections = tuple(FileSection(joined_sides(side, other), line) for (line, side), (_, other) in pairs)
    return SectionFile(sections, _channel(lines, "hub"), _channel(lines, "shroud"), unit)


def _sections(lines: list[Line], side: str) -> list[tuple[int, np.ndarray]]:
    """First line and points of each section of a side."""
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
    points = [point_in(text, number) for number, text in (_next(rest, line) for _ in range(_count(rest, line)))]
    order, coordinates = _FORMS[form.lower()], np.array(points)
    return line, coordinates if order is None else cartesian(coordinates[:, order])


def _channel(lines: list[Line], name: str) -> np.ndarray | None:
    """Points of the basic curves that make the hub or the shroud of the channel, shape (n, 3)."""
    curves: dict[str, np.ndarray] = {}
    current, rest = "", iter(lines)
    used: dict[str, int] = {}
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
            used.setdefault(text.split(None, 2)[2].rsplit(None, 1)[0], number)
    for curve in used.keys() - curves.keys():
        wanted = f"found no basic curve named {curve} with ZR points, of which the {name} is made"
        raise TextFileError(used[curve], f"{wanted}; found: {', '.join(curves) or 'none'}")
    # without channel curves the basic curves have their names
    if not used and name not in curves:
        return None
    points = np.concatenate([curves[curve] for curve in used or [name]])
    return points[np.concatenate([[True], np.any(np.diff(points, axis=0) != 0.0, axis=1)])]


def _next(rest: Iterator[Line], line: int) -> Line:
    """The next line that is no remark; TextFileError at the end of the file."""
    for number, text in rest:
        if not text.startswith("#"):
            return number, text
    raise TextFileError(line, "the file ends within a section; needed: as many sections and points as it announces")


def _count(rest: Iterator[Line], line: int) -> int:
    number, text = _next(rest, line)
    # AutoBlade's counts carry a sign
    if not _COUNT.fullmatch(text.split()[0]):
        raise TextFileError(number, f"found '{text}'; needed: how many sections or points follow, 1 or more")
    return int(text.split()[0])


PROFILE_ENDINGS = (".curve", ".crv")
"""Endings of the files of TurboGrid and BladeGen, in small letters."""

_READERS: dict[str, Callable[[str], SectionFile]] = {
    **dict.fromkeys(PROFILE_ENDINGS, read_profiles),
    ".geomturbo": read_geomturbo,
    ".csv": read_table,
}
_FEWEST_POINTS, _MOST_POINTS = 12, 200_000
"""Numbers of points of a section, and of a file."""


def read_section_file(file: Path) -> SectionFile:
    """Sections of a file, and the meridians of hub and tip in it.

    Raises TextFileError, BladeShapeError for an unknown ending, and OSError.
    """
    suffix = file.suffix.lower()
    if suffix not in _READERS:
        raise BladeShapeError(f"found a file of kind '{file.suffix}'; allowed: .curve, .crv, .geomTurbo, .csv")
    return _checked(read_text(file), suffix)


@lru_cache(maxsize=8)
def _checked(text: str, suffix: str) -> SectionFile:
    """Content of a file's text, read once for all designs of a family. Raises TextFileError."""
    # before the work of reading them
    if (lines := text.count("\n")) > 2 * _MOST_POINTS:
        raise TextFileError(1, f"found {lines} lines; allowed: at most {_MOST_POINTS} points")
    content = _READERS[suffix](text)
    for section in content.sections:
        if (count := len(section.points)) < _FEWEST_POINTS:
            raise TextFileError(section.line, f"found a section of {count} points; allowed: at least {_FEWEST_POINTS}")
    if len(content.sections) < 2:
        raise TextFileError(content.sections[0].line, "found 1 section; allowed: at least 2, from hub to tip")
    if (count := sum(len(section.points) for section in content.sections)) > _MOST_POINTS:
        raise TextFileError(1, f"found {count} points; allowed: at most {_MOST_POINTS}")
    return content
