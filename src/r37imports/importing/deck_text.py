"""Texts in the language of Abaqus and CalculiX: whether a file is one, its lines, the files it includes.

Light: the configuration imports it.
"""

import os
import re
from collections.abc import Iterator, Mapping
from pathlib import Path

from r37imports.refusal import ImportRefused

_LOOKED_AT = 65536
"""Characters at a file's beginning that tell its kind."""


def is_deck(file: Path) -> bool:
    """True if the first line that is no comment begins with a keyword of Abaqus, whatever the file's ending."""
    with open(file, encoding="utf-8-sig", errors="replace") as text:
        lines = text.read(_LOOKED_AT).splitlines()
    first = next((line for line in map(str.strip, lines) if line and not line.startswith("**")), "")
    # *KEYWORD begins a file of LS-DYNA
    return bool(re.match(r"\*[A-Za-z]", first)) and not first.upper().startswith("*KEYWORD")


def deck_lines(file: Path) -> Iterator[str]:
    """Lines without blanks at their ends, comments and empty ones left out; a keyword line and what continues it are one."""
    unfinished = ""
    with open(file, encoding="utf-8-sig", errors="replace") as text:
        for line in map(str.strip, text):
            if not line or line.startswith("**"):
                continue
            line = unfinished + line
            unfinished = line if line.startswith("*") and line.endswith(",") else ""
            if not unfinished:
                yield line


def keyword_and_options(line: str) -> tuple[str, dict[str, str]]:
    """Keyword, "" of a line of data, and options of `*KEYWORD, OPTION=value, ...`; keyword and names of options in capitals."""
    if not line.startswith("*"):
        return "", {}
    keyword, *words = [word.strip() for word in line[1:].split(",")]
    pairs = (word.partition("=") for word in words)
    return keyword.upper(), {key.strip().upper(): value.strip().strip('"') for key, _, value in pairs}


_DEEPEST = 50
"""Files of which each includes the next."""


def included_files(deck: Path) -> list[Path]:
    """The files that a deck includes, directly or not, each once.

    Raises ImportRefused for a file that is not there, for one that includes itself, and for a long chain of files.
    """
    files: dict[Path, None] = {}
    _include(deck, [], files)
    return list(files)


def included(deck: Path, options: Mapping[str, str]) -> Path:
    """The file that a line *INCLUDE of a deck names. Raises ImportRefused where it is not there."""
    called = options.get("INPUT")
    if not called:
        raise ImportRefused(f"{deck.name} has a line *INCLUDE that names no file; allowed: *INCLUDE, INPUT=FILE", "mesh")
    file = deck.parent / called
    if not os.path.isfile(file):
        raise ImportRefused(f"there is no file {called}, which {deck.name} includes", "mesh")
    return file.resolve()


def _include(deck: Path, above: list[Path], files: dict[Path, None]) -> None:
    above = [*above, deck.resolve()]
    if len(above) > _DEEPEST:
        raise ImportRefused(f"{deck.name} is included over {_DEEPEST} files; put what it holds into fewer files", "mesh")
    for line in deck_lines(deck):
        keyword, options = keyword_and_options(line)
        if keyword != "INCLUDE":
            continue
        file = included(deck, options)
        if file in above:
            raise ImportRefused(f"{deck.name} includes {file.name}, which includes it; take one *INCLUDE out", "mesh")
        if file not in files:
            files[file] = None
            _include(file, above, files)
