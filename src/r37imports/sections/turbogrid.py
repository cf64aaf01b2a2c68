"""Files of TurboGrid and BladeGen next to a blade's profile: meridians, and the .inf with unit, axis and names of files."""

import re
from collections.abc import Mapping
from pathlib import Path, PureWindowsPath

import numpy as np

from r37core.base.units import LENGTH_UNITS
from r37core.fem.orientation import Orientation
from r37imports.refusal import ImportRefused

from .section_file import PROFILE_ENDINGS

UNIT = "geometry units"
"""Entry of an .inf that names the unit of length."""

_WORDS = {"hub": ("hub",), "tip": ("shroud", "shd", "shr", "casing")}
"""Words in the name of a meridian's file, by the key of the surface; an .inf has the first."""


def companion_of(profile: Path) -> dict[str, str]:
    """Entries of the .inf next to a profile that names it, by names in small letters; empty without one. Raises OSError.

    Of files only the names count, as their folders may be those of another machine.
    """
    for file in sorted(profile.parent.glob("*.inf")):
        lines = (line.partition(":") for line in file.read_text(encoding="utf-8", errors="replace").splitlines())
        entries = {name.strip().lower(): PureWindowsPath(value.strip()).name for name, _, value in lines}
        if entries.get("profile data file", "").lower() == profile.name.lower():
            return entries
    return {}


def check_companion(companion: Mapping[str, str], orientation: Orientation) -> None:
    """Raise ImportRefused for a unit or a rotor axis that the .inf contradicts."""
    unit, axis = (companion.get(name, "-").lower() for name in (UNIT, "axis of rotation"))
    fits = unit not in LENGTH_UNITS or np.isclose(LENGTH_UNITS[unit], orientation.metres_per_unit)
    aligned = axis not in ("x", "y", "z") or np.isclose(abs(orientation.rows[2]["xyz".index(axis)]), 1.0)
    for key, agrees, other in (("length_unit", fits, unit), ("rotor_axis", aligned, f"the axis {axis}")):
        if not agrees:
            reason = f"found {getattr(orientation, key)}, and {other} in the .inf next to the sections, or in their file"
            raise ImportRefused(f"{reason}; correct one of them", key)


def meridian_next_to(profile: Path, key: str) -> str | None:
    """Name of the file with the meridian of hub or tip next to a profile; None without one.

    The .inf names it, or it is named as the profile, or the only one with one of its words. Raises ImportRefused for several,
    and where the other end has one and a further file may be this one.
    """
    if named := companion_of(profile).get(f"{_WORDS[key][0]} data file"):
        return named
    if profile.suffix.lower() not in PROFILE_ENDINGS:
        return None
    files = [file for file in sorted(profile.parent.iterdir()) if file.suffix.lower() in PROFILE_ENDINGS and file != profile]
    ends = {end: [file.name for file in files if _is_named(file.stem, _WORDS[end])] for end in _WORDS}
    names, (other_end,) = ends.pop(key), ends.values()
    if same := [name for word in _WORDS[key] if (name := profile.name.replace("profile", word)) in names]:
        return same[0]
    if len(names) > 1:
        raise ImportRefused(f"found {', '.join(names)} next to the sections; give {key}: one of them, or sections", key)
    others = [file.name for file in files if "profile" not in file.stem.lower() and file.name not in other_end]
    if not names and other_end and others:
        known = f"found {', '.join(other_end)} next to the sections, and {', '.join(others)}"
        raise ImportRefused(f"{known}; give {key}: one of them, or sections", key)
    return names[0] if names else None


def _is_named(stem: str, words: tuple[str, ...]) -> bool:
    """True where a file's name has one of the words: from a letter that follows none, or in capitals, on."""
    return any(re.search(rf"(?<![A-Za-z])(?i:{word})|{word.capitalize()}", stem) for word in words)
