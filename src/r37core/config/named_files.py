"""Files that configuration files name.

A name starts from the folder of its own file or, where nothing is there, from the folder above that has `config/`.
"""

import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from .blade_kind import blade_kinds

CONFIG_FILES = ("blades_file", "fidelity_file", "scenes_file")
SECTION_FILES = {"measured": ("file",), "tolerances": ("drawn_file",)}
"""Sections of config.yaml, or lists of them -> their keys with names of files."""

TABLES = ("profiles", "stacking_table", "designs")
"""Keys of blades with tables; those of other kinds of blades may be large, or belong to others."""


def file_keys(entry: Mapping[str, Any]) -> list[str]:
    """Keys of a blade's entry with names of files."""
    keys = [key for key in TABLES if isinstance(entry.get(key), str)]
    for kind in blade_kinds().values():
        named = kind.file_keys if kind.key in entry else ()
        keys += [key for key in named if isinstance(entry.get(key), str) and entry[key] not in kind.no_files]
    return keys


def study_folder(file: Path) -> Path:
    """The nearest folder above a file that has a folder `config`, or without one the file's own."""
    return next((folder for folder in file.parents if (folder / "config").is_dir()), file.parent)


def named_file(name: str, file: Path, root: Path | None = None) -> str:
    """The file that a name in `file` stands for, as seen from `root`, the last folder looked into; without that absolute."""
    places = [folder / name for folder in (file.parent, study_folder(file), root or file.parent)]
    there = [place for place in places if os.path.exists(place)]
    # one that is nowhere is missed where its folder is
    path = [*there, *(place for place in places if place.parent.is_dir()), places[1]][0]
    if root is None:
        return str(path)
    return name if path == root / name else str(path.relative_to(root) if path.is_relative_to(root) else path)


def located_files(content: Any, keys: Iterable[str], file: Path, root: Path | None) -> Any:
    """A section of `file`, or each of a list, with the files under some keys as `named_file` has them; others as they are."""
    if isinstance(content, list):
        return [located_files(each, keys, file, root) for each in content]
    if not isinstance(content, Mapping):
        return content
    names = {key: content[key] for key in keys if isinstance(content.get(key), str)}
    return {
        **content,
        **{key: named_file(name, file, root) for key, name in names.items() if name.strip() and name.isprintable()},
    }


def located_in_configuration(content: Mapping[str, Any], file: Path, root: Path | None) -> dict[str, Any]:
    """The content of config.yaml with the files that it and its sections name as `named_file` has them."""
    there = SECTION_FILES.keys() & content.keys()
    sections = {name: located_files(content[name], SECTION_FILES[name], file, root) for name in there}
    return {**located_files(content, CONFIG_FILES, file, root), **sections}
