"""Text files that people write: read as UTF-8, with the line in the message where that fails, and their generated parts."""

from __future__ import annotations

import re
from pathlib import Path


class TextFileError(ValueError):
    """Something that a text file must not hold: `reason`, and the number of the `line`."""

    def __init__(self, line: int, reason: str):
        super().__init__(f"line {line}: {reason}")
        self.line, self.reason = line, reason


def read_text(file: Path) -> str:
    """Text of a UTF-8 file, with or without a byte order mark.

    Raises TextFileError for another encoding, and OSError as `open` does.
    """
    data = file.read_bytes()
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line, byte = data.count(b"\n", 0, error.start) + 1, data[error.start]
        raise TextFileError(line, f"found the byte 0x{byte:02x}, which is not UTF-8; save the file as UTF-8") from None


def with_part(text: str, name: str, part: str, made_with: str | None = None) -> str:
    """The text with another part between its markers <!-- name --> and <!-- end -->; ValueError where these are missing.

    `made_with`: a hash for the first marker, <!-- name made-with:hash -->; without, the marker stays as it is.
    """
    markers = _markers(text, name)
    opening = markers[1] if made_with is None else f"<!-- {name} made-with:{made_with} -->"
    return f"{text[: markers.start()]}{opening}\n{part.rstrip()}\n<!-- end -->{text[markers.end() :]}"


def part_of(text: str, name: str) -> str:
    """Part between the markers of this name; ValueError where these are missing."""
    return _markers(text, name)["part"]


def made_with_of(text: str, name: str) -> str | None:
    """The hash in the first marker of this name, None where it has none; ValueError where the markers are missing."""
    return _markers(text, name)["made_with"]


def _markers(text: str, name: str) -> re.Match[str]:
    pattern = rf"(<!-- {re.escape(name)}(?: made-with:(?P<made_with>\w+))? -->)\n(?P<part>.*?)<!-- end -->"
    match = re.search(pattern, text, re.DOTALL)
    if match is None:
        raise ValueError(f"there is no part between <!-- {name} --> and <!-- end -->")
    return match
