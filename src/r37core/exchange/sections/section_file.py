"""Files of section curves, by their endings."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from pathlib import Path

import numpy as np

from r37core.base.io import TextFileError, read_text
from r37core.blade.profile import BladeShapeError
from r37core.blade.section_curve import FEWEST_POINTS
from r37core.blade.sections_definition import FEWEST_SECTIONS

from .csv_sections import read_table
from .curve_file import read_meridian, read_profiles
from .geomturbo_file import read_geomturbo
from .section_text import SectionFile

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
