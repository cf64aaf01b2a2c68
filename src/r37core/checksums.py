"""Checksums of what one stage writes and another reads, in a hidden file beside each; light, as the simulation jobs import it.

They have the form of `sha256sum`, which checks them too. A file without one is taken as it is: those of single speeds (.npz)
have checksums of their own, and older results have none.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path

_SUFFIXES = (".nc", ".csv", ".json", ".vtu")
"""Of files that other stages read and that do not find every damage themselves."""


def checksum_file(file: Path) -> Path:
    """Where the checksum of a file stands."""
    return file.with_name(f".{file.name}.sha256")


def drop_checksum(file: Path) -> None:
    """Of a file that is removed, or written anew."""
    checksum_file(file).unlink(missing_ok=True)


@contextmanager
def checksummed(files: Iterable[str]) -> Iterator[None]:
    """Give the files that the block writes their checksums; those that no other stage reads get none."""
    paths = [Path(file) for file in files]
    for file in paths:
        drop_checksum(file)
    yield
    for file in paths:
        if file.suffix in _SUFFIXES:
            partial = checksum_file(file).with_suffix(".partial")
            partial.write_text(f"{content_digest(file)}  {file.name}\n", encoding="utf-8")
            os.replace(partial, checksum_file(file))


def is_as_written(file: Path) -> bool:
    """Whether a file is what its checksum says, or has none."""
    if file.suffix not in _SUFFIXES:
        return True
    try:
        written = checksum_file(file).read_text(encoding="utf-8", errors="replace")
    except FileNotFoundError:
        return True
    return written.partition(" ")[0] == content_digest(file)


def content_digest(file: Path | str) -> str:
    """SHA-256 of a file's content."""
    with open(file, "rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()
