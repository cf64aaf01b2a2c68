"""Atomic writes, text files of users, one clear message for a file that cannot be read. Light: simulation jobs import it."""

import copyreg
import errno
import json
import logging
import os
import resource
import shutil
import tempfile
from collections.abc import ItemsView, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from pkgutil import resolve_name
from types import SimpleNamespace
from typing import Any

from r37core import __version__

FILE_ATTRIBUTES = {"Conventions": "CF-1.11", "r37core_version": __version__}
"""Global attributes of every netCDF file."""

JOB_LOG = logging.getLogger("r37core")
"""Logger of the steps, for the log of their job; from Python nobody hears it who does not ask for this logger's level DEBUG."""

JOB_NEWS = logging.getLogger("r37core.news")
"""Logger of the steps for what the user of a run should see while a job works."""

FULL_DISK = 2**20
"""Bytes left on a disk that counts as full."""

NO_ROOM = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
"""Numbers of the errors of a file that there is no room for."""


READ_ONLY = "change the folder's rights, or work in a copy of the whole project (cp -a)"
"""Remedy for a folder that cannot be written."""


class InputFileError(RuntimeError):
    """Error of a file that is missing, corrupt or written by another program; the message names the file and the remedy."""


class OutputFileError(InputFileError):
    """A file that has no room; the message names it and the remedy. Who expects a file's error gets this one, too."""


class CarriedError(ValueError):
    """Error that a process can raise of another one, although it is made from something else than its message."""

    def __reduce__(self) -> Any:
        # made without __init__
        return copyreg.__newobj__, (type(self), *self.args), vars(self)  # type: ignore[attr-defined]


class EntryRefused(CarriedError):
    """A description of a blade that cannot be used; `key`: of its entry in blades.yaml, whose value is to blame."""

    key: str | None = None


class TextFileError(CarriedError):
    """Something that a text file of a user must not hold: `reason`, and the number of the `line`."""

    def __init__(self, line: int, reason: str):
        super().__init__(f"line {line}: {reason}")
        self.line, self.reason = line, reason


@contextmanager
def atomic_write(file: Path | str) -> Iterator[Path]:
    """Give a temporary path next to `file`; it becomes `file` when the block ends well and vanishes when it does not.

    Raises OutputFileError where there is no room for it.
    """
    file = Path(file)
    with room_for(file):
        file.parent.mkdir(parents=True, exist_ok=True)
        # several processes may write the same file: the last one's counts
        partial = file.with_name(f".{file.stem}.{os.getpid()}.partial{file.suffix}")
        try:
            yield partial
            if shutil.disk_usage(file.parent).free < FULL_DISK:
                # gmsh cuts a file there without a word
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
            os.replace(partial, file)
        finally:
            partial.unlink(missing_ok=True)


@contextmanager
def room_for(file: Path) -> Iterator[None]:
    """Turn what libraries raise on a full disk, each its own, into an OutputFileError that says so."""
    try:
        yield
    except (OSError, RuntimeError) as error:
        reason = None if isinstance(error, InputFileError) else _no_room(error, file.parent)
        if reason is None:
            raise
        raise OutputFileError(f"{file}: cannot be written: {reason} ({error}); then give the same command again") from error


def _no_room(error: Exception, folder: Path) -> str | None:
    """Message about lacking room, and the remedy; None for an error of another kind."""
    number = getattr(error, "errno", None)
    # netCDF has numbers of its own, below 0, which say nothing of the cause
    unknown = number is None or number < 0
    limited = resource.getrlimit(resource.RLIMIT_FSIZE)[0] != resource.RLIM_INFINITY
    if number in (errno.ENOSPC, errno.EDQUOT) or (unknown and folder.is_dir() and shutil.disk_usage(folder).free < FULL_DISK):
        return "the disk is full; free some space"
    if number == errno.EFBIG or (unknown and limited):
        return "files may not be as large here; raise the limit (ulimit -f)"
    if number in (errno.EACCES, errno.EROFS) and not os.access(folder, os.W_OK):
        return f"nobody may write there; {READ_ONLY}"
    return None


def temporary_folder() -> tempfile.TemporaryDirectory[str]:
    """A folder that goes with the object. Raises OutputFileError where none can be made."""
    try:
        return tempfile.TemporaryDirectory(prefix="r37-")
    except OSError as error:
        reason = "no temporary folder can be made: free some space, or set TMPDIR to a folder that can be written"
        raise OutputFileError(f"{reason} ({error})") from error


@contextmanager
def scratch_folder() -> Iterator[Path]:
    """A folder for files that are gone after the block. Raises OutputFileError where none can be made."""
    with temporary_folder() as folder:
        yield Path(folder)


@contextmanager
def readable(file: Path | str) -> Iterator[None]:
    """Turn whatever goes wrong while reading `file` into an InputFileError that names it and the remedy."""
    try:
        yield
    except InputFileError:
        raise
    except Exception as error:
        reason = f"{type(error).__name__}: {error}" if Path(file).exists() else "there is no such file"
        # NumPy's advice for what it does not know is to run what stands in it
        reason = "its content is not what results have" if "pickle" in reason else reason
        raise InputFileError(f"{file}: cannot be read ({reason}); if it is a result, delete it and run again") from error


class Named(SimpleNamespace):
    """Arguments of a step that is called from Python: input, output and params, each with named attributes."""

    def items(self) -> ItemsView[str, Any]:
        """Names and what they stand for."""
        return vars(self).items()


def function_named(name: str) -> Any:
    """The function of a dotted name, `module.function`. Raises what importing its module raises."""
    module, _, function = name.rpartition(".")
    # with a colon: for dots alone resolve_name takes a failed import for the end of the module's name
    return resolve_name(f"{module}:{function}")


def as_list(files: str | Sequence[str]) -> list[str]:
    """The files of a job's input, which is a text where there is one file only."""
    return [files] if isinstance(files, str) else list(files)


def read_text(file: Path) -> str:
    """Text of a UTF-8 file, with or without a byte order mark.

    Raises TextFileError for another encoding, more than 64 MB, a device or pipe, and OSError as `open` does.
    """
    path = Path(file)
    if path.exists() and not (path.is_file() or path.is_dir()):
        # reading would wait for a pipe, and never end for a device
        raise TextFileError(1, "found a device or pipe; allowed: a regular text file")
    with open(file, "rb") as stream:
        data = stream.read(2**26 + 1)
    if len(data) > 2**26:
        raise TextFileError(1, "found more than 64 MB; allowed: a text file of at most that size")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line, byte = data.count(b"\n", 0, error.start) + 1, data[error.start]
        raise TextFileError(line, f"found the byte 0x{byte:02x}, which is not UTF-8; save the file as UTF-8") from None


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
