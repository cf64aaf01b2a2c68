"""Files of section curves, by their endings."""

import csv
import io
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path

import numpy as np

from r37core.base.io import TextFileError, read_text
from r37core.blade.definition import FEWEST_SECTIONS
from r37core.blade.profile import BladeShapeError
from r37core.blade.section_curve import FEWEST_POINTS

from .geomturbo_file import read_geomturbo
from .section_text import FileSection, SectionFile, closed_section, joined_sides, number_in, point_in

_READERS: dict[str, Callable[[str], SectionFile]] = {
    ".curve": lambda text: SectionFile(read_profiles(text)),
    ".geomturbo": read_geomturbo,
    ".csv": lambda text: SectionFile(read_table(text)),
}
_MOST_POINTS = 200_000
_NEXT_TO = {"hub": "hub", "tip": "shroud"}
"""Word in the name of the file of a meridian that lies next to a profile.curve."""


def read_section_file(file: Path) -> SectionFile:
    """Sections of a file, and the meridians of hub and tip in it or next to it.

    Raises TextFileError, BladeShapeError for an unknown ending, and OSError.
    """
    suffix = file.suffix.lower()
    if suffix not in _READERS:
        raise BladeShapeError(f"found a file of kind '{file.suffix}'; allowed: .curve, .geomTurbo, .csv")
    content = _checked(read_text(file), suffix)
    if suffix != ".curve":
        return content
    hub, tip = (_meridian_next_to(file, word) for word in _NEXT_TO.values())
    return SectionFile(content.sections, hub, tip)


def read_meridian_file(file: Path) -> np.ndarray:
    """Points of a meridian, shape (n, 3), from a file as hub.curve. Raises TextFileError and OSError."""
    return read_meridian(read_text(file))


def _meridian_next_to(file: Path, word: str) -> np.ndarray | None:
    """Points of hub.curve or shroud.curve of a profile.curve, named as that is but for this word; None without the file."""
    other = file.with_name(file.name.replace("profile", word))
    if other == file or not other.is_file():
        return None
    try:
        return read_meridian_file(other)
    except TextFileError as error:
        raise BladeShapeError(f"{other.name}:{error.line}: {error.reason}") from None


@lru_cache(maxsize=8)
def _checked(text: str, suffix: str) -> SectionFile:
    """Content of a file's text, read once for all designs of a family. Raises TextFileError."""
    content = _READERS[suffix](text)
    for section in content.sections:
        if len(section.points) < FEWEST_POINTS:
            raise TextFileError(
                section.line, f"found a section of {len(section.points)} points; allowed: at least {FEWEST_POINTS}"
            )
    if len(content.sections) < FEWEST_SECTIONS:
        raise TextFileError(
            content.sections[0].line,
            f"found {len(content.sections)} section; allowed: at least {FEWEST_SECTIONS}, from hub to tip",
        )
    count = sum(len(section.points) for section in content.sections)
    if count > _MOST_POINTS:
        raise TextFileError(1, f"found {count} points; allowed: at most {_MOST_POINTS}")
    return content


_COLUMNS = ("section", "x", "y", "z")


def read_table(text: str) -> tuple[FileSection, ...]:
    """Sections of a table (CSV), in the order of their first rows. Raises TextFileError.

    Columns section, x, y, z, and side where the two sides of a section are apart.
    """
    delimiter = ";" if ";" in text.partition("\n")[0] else ","
    reader = csv.DictReader(io.StringIO(text, newline=""), delimiter=delimiter, strict=True)
    # section -> side -> points
    sections: dict[str, dict[str, list[list[float]]]] = {}
    lines: dict[str, int] = {}
    try:
        reader.fieldnames = header = [column.strip().lower() for column in reader.fieldnames or []]
        missing = [column for column in _COLUMNS if column not in header]
        if missing:
            raise TextFileError(
                1, f"the table lacks the columns {', '.join(missing)}; needed: section, x, y, z, separated by commas"
            )
        for row in reader:
            if None in row or None in row.values():
                raise TextFileError(reader.line_num, "the row has more or fewer cells than the first line has columns")
            name, side = row["section"].strip(), row.get("side", "").strip()
            lines.setdefault(name, reader.line_num)
            point = [number_in(row[column].strip(), reader.line_num, f"column {column}") for column in "xyz"]
            sections.setdefault(name, {}).setdefault(side, []).append(point)
    except csv.Error as error:
        raise TextFileError(reader.line_num, f"not readable as a table separated by commas: {error}") from None
    if not sections:
        raise TextFileError(1, "found no rows; needed: section, x, y, z of each point")
    return tuple(_section(sides, lines[name]) for name, sides in sections.items())


def _section(sides: dict[str, list[list[float]]], line: int) -> FileSection:
    if len(sides) > 2:
        raise TextFileError(line, f"found {len(sides)} values in the column side of one section; allowed: one or two")
    parts = [np.array(points) for points in sides.values()]
    return closed_section(parts[0], line) if len(parts) == 1 else FileSection(joined_sides(*parts), line)


_REMARK = ("#", "!", "//")


def read_profiles(text: str) -> tuple[FileSection, ...]:
    """Sections of a profile.curve of BladeGen or TurboGrid. Raises TextFileError.

    Points x y z, one a line; a line that begins with # starts a profile.
    """
    profiles: list[tuple[int, list[list[float]]]] = []
    begins = True
    for number, line in enumerate(text.splitlines(), start=1):
        stripped = line.strip()
        if not stripped or stripped.startswith(_REMARK):
            # remarks before the first profile, and several lines in a row, start one
            begins = begins or stripped.startswith("#")
            continue
        if begins:
            profiles.append((number, []))
            begins = False
        profiles[-1][1].append(point_in(stripped, number))
    if not profiles:
        raise TextFileError(1, "found no points; needed: x y z in a line each, and a line with # before each profile")
    return tuple(closed_section(points, line) for line, points in profiles)


def read_meridian(text: str) -> np.ndarray:
    """Points of a hub.curve or shroud.curve, shape (n, 3). Raises TextFileError."""
    lines = enumerate(text.splitlines(), start=1)
    points = [point_in(line, number) for number, line in lines if line.strip() and not line.strip().startswith(_REMARK)]
    if len(points) < 2:
        raise TextFileError(1, f"found {len(points)} points of a meridian; needed: at least 2, x y z in a line each")
    return np.array(points)
