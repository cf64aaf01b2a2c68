"""Atomic writes, and one clear message for a file that cannot be read. Light: the simulation jobs import it."""

from __future__ import annotations

import json
import os
from collections.abc import ItemsView, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from . import __version__
from .checksums import checksum_file, is_as_written

FILE_ATTRIBUTES = {"Conventions": "CF-1.11", "r37core_version": __version__}
"""Global attributes of every netCDF file."""


class InputFileError(RuntimeError):
    """A file that is missing, corrupt or of another make; the message names it and the remedy."""


@contextmanager
def atomic_write(file: Path | str) -> Iterator[Path]:
    """Give a temporary path beside `file`; it becomes `file` when the block ends well and vanishes when it does not."""
    file = Path(file)
    file.parent.mkdir(parents=True, exist_ok=True)
    partial = file.with_name(f".{file.stem}.partial{file.suffix}")
    try:
        yield partial
        os.replace(partial, file)
    finally:
        partial.unlink(missing_ok=True)


@contextmanager
def readable(file: Path | str) -> Iterator[None]:
    """Turn whatever goes wrong while reading `file` into an InputFileError that names it and the remedy.

    A file that is not as the stage before has written it is refused, too.
    """
    try:
        if not is_as_written(Path(file)):
            raise ValueError(f"it has changed since it was written, {checksum_file(Path(file)).name} says")
        yield
    except InputFileError:
        raise
    except Exception as error:
        reason = f"{type(error).__name__}: {error}" if Path(file).exists() else "there is no such file"
        raise InputFileError(f"{file}: cannot be read ({reason}); if it is a result, delete it and run again") from error


class Named(SimpleNamespace):
    """What a step of the workflow is called with from Python: input, output and params, each with named attributes."""

    def items(self) -> ItemsView[str, Any]:
        """Names and what they stand for."""
        return vars(self).items()


def as_list(files: str | Sequence[str]) -> list[str]:
    """The files of a job's input, which is a text where there is one file only."""
    return [files] if isinstance(files, str) else list(files)


def write_text(text: str, file: Path | str) -> None:
    """Write a text file, atomically."""
    with atomic_write(file) as partial:
        partial.write_text(text, encoding="utf-8")


def write_json(content: object, file: Path | str) -> None:
    """Write plain numbers, texts, lists and dictionaries as JSON, atomically."""
    write_text(json.dumps(content, indent=1) + "\n", file)


def read_json(file: Path | str) -> Any:
    """Content of a JSON file; InputFileError when it cannot be read."""
    with readable(file):
        return json.loads(Path(file).read_text(encoding="utf-8"))
