"""Text files that people write: read as UTF-8, with the line in the message where that fails, and their generated parts."""

from __future__ import annotations

import errno
import os
import re
import stat
from pathlib import Path

_MERGE_MARKER = re.compile(r"(<{7}|>{7}|\|{7})( |$)|={7}$")


_LARGEST = 2**26
"""Bytes of a file that people write."""


class TextFileError(ValueError):
    """Something that a text file must not hold: `reason`, and the number of the `line`."""

    def __init__(self, line: int, reason: str):
        super().__init__(f"line {line}: {reason}")
        self.line, self.reason = line, reason


def read_text(file: Path) -> str:
    """Text of a UTF-8 file, with or without a byte order mark.

    Raises TextFileError for another encoding, a marker that a merge left behind and what is too long to be a person's; OSError
    as `open` does, and for what is no file.
    """
    data = _bytes_of(file)
    if data.startswith((b"\xff\xfe", b"\xfe\xff")) or b"\x00" in data[:200]:
        raise TextFileError(1, "found UTF-16 or binary data; allowed: text in UTF-8")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise TextFileError(
            line, f"found the byte 0x{data[error.start]:02x}, which is not UTF-8; save the file as UTF-8"
        ) from None
    for number, line_of_text in enumerate(text.splitlines(), start=1):
        if _MERGE_MARKER.match(line_of_text):
            raise TextFileError(number, f"found a merge marker, {line_of_text[:20]!r}; resolve the conflict")
    return text


def _bytes_of(file: Path) -> bytes:
    """A device may have no end, and a pipe no beginning."""
    with open(os.open(file, os.O_RDONLY | os.O_NONBLOCK), "rb") as stream:
        if not stat.S_ISREG(os.fstat(stream.fileno()).st_mode):
            raise OSError(errno.EINVAL, "it is a folder, a device or a pipe, and no file", str(file))
        data = stream.read(_LARGEST + 1)
    if len(data) > _LARGEST:
        raise TextFileError(1, f"found more than {_LARGEST >> 20} MiB; allowed: a text that somebody has written")
    return data


def with_part(text: str, name: str, part: str, made_with: str | None = None) -> str:
    """The text with another part between its markers <!-- name --> and <!-- end -->; ValueError where these are missing.

    `made_with`: a hash for the first marker, <!-- name made-with:hash -->; without, the marker stays as it is.
    """
    markers = _markers(text, name)
    opening = markers[1] if made_with is None else f"<!-- {name} made-with:{made_with} -->"
    return f"{text[: markers.start()]}{opening}\n{part.rstrip()}\n<!-- end -->{text[markers.end() :]}"


def part_of(text: str, name: str) -> str:
    """What stands between the markers of this name; ValueError where these are missing."""
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
