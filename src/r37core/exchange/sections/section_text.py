"""Sections as files give them, and the numbers in their lines."""

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from r37core.base.io import TextFileError

_NUMBER = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([ed][-+]?[0-9]+)?", re.IGNORECASE)
_NOT_FINITE = re.compile(r"[-+]?(nan|inf|infinity)", re.IGNORECASE)
_EQUAL = 1e-9
"""Distance of two points that are one, as a share of the section's size."""


@dataclass(frozen=True)
class FileSection:
    """A section: its closed curve, points in the file's unit and axes, shape (n, 3), and the line where it begins."""

    points: np.ndarray
    line: int


@dataclass(frozen=True)
class SectionFile:
    """Content of a file: sections in its order; points of the meridians of hub and tip, shape (n, 3), or None."""

    sections: tuple[FileSection, ...]
    hub: np.ndarray | None = None
    tip: np.ndarray | None = None


def number_in(text: str, line: int, what: str) -> float:
    """Number of a cell, with an exponent e or d; TextFileError for another text."""
    if _NOT_FINITE.fullmatch(text):
        raise TextFileError(line, f"{what}: '{text}' is not finite; give the coordinate, or leave the point out")
    if not _NUMBER.fullmatch(text):
        raise TextFileError(line, f"{what}: '{text}' is not a number; allowed: coordinates such as 0.25 or 2.5e-1")
    number = float(text.lower().replace("d", "e"))
    if not math.isfinite(number):
        raise TextFileError(line, f"{what}: '{text}' is not finite; give the coordinate, or leave the point out")
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
    forward, backward = (
        np.linalg.norm(side[-1] - back[0]) + np.linalg.norm(side[0] - back[-1]) for back in (other, other[::-1])
    )
    return closed(np.concatenate([side, other if forward <= backward else other[::-1]]))


def closed_section(points: Sequence[Sequence[float]] | np.ndarray, line: int) -> FileSection:
    """Section of points in their order."""
    return FileSection(closed(np.asarray(points, dtype=float)), line)
