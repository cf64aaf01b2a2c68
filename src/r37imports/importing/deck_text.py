"""Texts in the language of Abaqus and CalculiX: whether a file is one, its lines, the files it includes.

Light: the configuration imports it.
"""

import os
import re
from collections.abc import Iterator
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


def deck_number(cell: str) -> float:
    """A number of a deck, whose exponent may follow a D as in Fortran. Raises ValueError for other texts."""
    return float(re.sub("[dD]", "e", cell))


def keyword_and_options(line: str) -> tuple[str, dict[str, str]]:
    """Keyword, "" of a line of data, and options of `*KEYWORD, OPTION=value, ...`; keyword and names of options in capitals."""
    if not line.startswith("*"):
        return "", {}
    keyword, *words = [word.strip() for word in line[1:].split(",")]
    pairs = (word.partition("=") for word in words)
    return keyword.upper(), {key.strip().upper(): value.strip().strip('"') for key, _, value in pairs}


_WITH_DATA = ("NODE", "ELEMENT", "NSET", "ELSET", "SURFACE", "BOUNDARY")
"""Keywords that are read, whose data may lie in a file of their own."""

_DEEPEST = 50
"""Files of which each includes the next."""


def deck_lines(deck: Path, files: dict[Path, None] | None = None, above: tuple[Path, ...] = ()) -> Iterator[str]:
    """Lines of a deck and of what it includes, in place: without blanks at their ends, comments and empty ones left out.

    A keyword line and what continues it are one. A file that is included again says the same once more, and is left out; one
    that holds the data of a keyword (*NODE, INPUT=FILE) is not.
    `files`: takes the included ones in; `above`: those that include this one. Raises ImportRefused for a file that is not
    there, for one that includes itself, and for a long chain of files.
    """
    files = {} if files is None else files
    above = (*above, deck.resolve())
    if len(above) > _DEEPEST:
        raise ImportRefused(f"{deck.name} is included over {_DEEPEST} files; put what it holds into fewer files", "mesh")
    unfinished = ""
    with open(deck, encoding="utf-8-sig", errors="replace") as text:
        for line in map(str.strip, text):
            if not line or line.startswith("**"):
                continue
            line = unfinished + line
            unfinished = line if line.startswith("*") and line.endswith(",") else ""
            if unfinished:
                continue
            keyword, options = keyword_and_options(line)
            is_include = keyword == "INCLUDE"
            called = options.get("INPUT") if is_include or keyword in _WITH_DATA else None
            if not is_include:
                yield line
                if not called:
                    continue
            if not called:
                raise ImportRefused(
                    f"{deck.name} has a line *INCLUDE that names no file; allowed: *INCLUDE, INPUT=FILE", "mesh"
                )
            file = (deck.parent / called).resolve()
            if not os.path.isfile(file):
                raise ImportRefused(f"there is no file {called}, which {deck.name} includes", "mesh")
            if file in above:
                raise ImportRefused(f"{deck.name} includes {file.name}, which includes it; take one *INCLUDE out", "mesh")
            if file not in files or not is_include:
                files[file] = None
                yield from deck_lines(file, files, above)


def included_files(deck: Path) -> list[Path]:
    """The files that a deck includes, directly or not, each once. Raises ImportRefused as `deck_lines`."""
    files: dict[Path, None] = {}
    for _ in deck_lines(deck, files):
        pass
    return list(files)
