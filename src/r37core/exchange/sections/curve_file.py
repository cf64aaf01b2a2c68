"""Files .curve of BladeGen and TurboGrid: points x y z, one a line; a line that begins with # starts a profile."""

import numpy as np

from r37core.base.io import TextFileError

from .section_text import FileSection, closed_section, point_in

_REMARK = ("#", "!", "//")


def read_profiles(text: str) -> tuple[FileSection, ...]:
    """Sections of a profile.curve. Raises TextFileError."""
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
