"""Results that take long to make, in files by a hash of all that their content follows from; each is checked when it is read.

They lie in the user's own folder in the package, the cache folder or the temporary one, or where a caller says. A file that is
cut short or damaged is made again; all may be removed at any time. Of several processes and threads that need the same one
makes it and the others wait, so that a core is not busy twice with one thing. Light: simulation jobs import it.
"""

import fcntl
import hashlib
import logging
import os
import re
import secrets
import shutil
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path
from typing import BinaryIO

_PACKAGE = Path(__file__).parents[1]


def kept_file(name: str, made_of: object, make: Callable[[Path], None], folder: Path) -> Path:
    """The file called `name` in a folder that is there; `make(path)` writes it where there is none, or a damaged one.

    `made_of`: what its content follows from, told apart by its repr. Raises what `make` raises, and OSError.
    """
    file = folder / _hashed(name, made_of)
    if not _sound(file):
        with _alone(file), tempfile.TemporaryDirectory(prefix=f".{file.name}.", dir=folder) as partial:
            if not _sound(file):
                make(made := Path(partial) / name)
                # where the file system has no locks another process may have been faster
                if not _sound(file):
                    _put(made, file)
    return file


def kept_for_user(name: str, made_of: object, make: Callable[[Path], None]) -> Path | None:
    """`kept_file` in the user's folder; None where that cannot be written. Raises what `make` raises but OSErrors."""
    with suppress(OSError):
        return kept_file(name, made_of, make, writable_folder())
    return None


def kept_bytes(name: str, made_of: object, make: Callable[[], bytes], worth_keeping: Callable[[], bool]) -> bytes:
    """Content of a kept file, in memory; a new one is kept if it is `worth_keeping` when it is made."""
    name = _hashed(name, made_of)
    if (content := read_kept(name)) is not None:
        return content
    with _alone(_folder() / name):
        if (content := read_kept(name)) is not None:
            return content
        content = make()
        if worth_keeping():
            # a full disk is for those to tell who write results
            with suppress(OSError):
                keep(content, name)
        return content


def read_kept(name: str) -> bytes | None:
    """Content of what is kept under a name; None if it is not there, cannot be read or is not what was written."""
    file = _folder() / name
    try:
        content, digest = file.read_bytes(), _digest_of(file).read_text()
    except (OSError, UnicodeDecodeError):
        return None
    return content if digest == hashlib.sha256(content).hexdigest() else None


def keep(content: bytes, name: str) -> None:
    """Keep under a name, in place of what was; processes may do so side by side."""
    # no folder: one that vanishes ends a walk through the package's files
    made = _folder() / f".{secrets.token_hex(8)}"
    try:
        made.write_bytes(content)
        _put(made, _folder() / name)
    finally:
        for file in (made, _digest_of(made)):
            file.unlink(missing_ok=True)


def content_digest(file: Path | str) -> str:
    """SHA-256 of a file's content."""
    with open(file, "rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def users_cache() -> Path:
    """The user's cache folder for r37, which may not be there yet; a private temporary one where the home cannot be written."""
    if named := os.environ.get("XDG_CACHE_HOME"):
        return Path(named) / "r37"
    folder = Path(os.path.expanduser("~/.cache"))
    # a user without a home has the letter ~
    if folder.is_absolute():
        with suppress(OSError):
            folder.mkdir(parents=True, exist_ok=True)
        if os.access(folder, os.W_OK):
            return folder / "r37"
    private = _private_folder(Path(tempfile.gettempdir()))
    _tell(f"{folder} cannot be written: machine code and structures are kept in {private}; XDG_CACHE_HOME names another")
    return (private or folder) / "r37"


def named_folder() -> Path:
    """The user's folder of structures, which may not be there yet: that of R37_CACHE, else the user's cache folder."""
    named = os.environ.get("R37_CACHE")
    return Path(named) if named else users_cache()


def writable_folder() -> Path:
    """The folder of structures, made where it is missing. Raises OSError where it cannot be written."""
    folder = named_folder()
    folder.mkdir(parents=True, exist_ok=True)
    tempfile.TemporaryFile(dir=folder).close()
    return folder


@cache
def numerics(*libraries: str) -> list[str]:
    """Versions of libraries and kernels of linear algebra that numbers depend on; empty for a library not installed by pip."""
    # slow to import, and no simulation job asks
    from importlib.metadata import distributions

    from threadpoolctl import threadpool_info

    kernels = {str(library["architecture"]) for library in threadpool_info() if "architecture" in library}
    versions = (next((package.version for package in distributions(name=library)), "") for library in libraries)
    return [*versions, *sorted(kernels)]


def _hashed(name: str, made_of: object) -> str:
    digest = hashlib.sha256(repr((name, made_of)).encode()).hexdigest()[:32]
    return f"{Path(name).stem}-{digest}{Path(name).suffix}"


@contextmanager
def _alone(file: Path) -> Iterator[None]:
    """Wait for others that make this file, threads too; where the file system has no locks, several may make it."""
    _remove_abandoned(file.parent)
    name = file.with_name(f".{file.name}.lock")
    while True:
        with open(name, "ab") as lock:
            with suppress(OSError):
                # no lockf: all locks of a process on a file end when it closes the file once
                fcntl.flock(lock, fcntl.LOCK_EX)
            if not _is_at(lock, name):
                # who had it before has removed it
                continue
            try:
                yield
            finally:
                name.unlink(missing_ok=True)
            return


_OWN_LOCK = re.compile(r"\..*-[0-9a-f]{32}(\.\w+)?\.lock", re.DOTALL)
"""Names of locks that `_alone` makes, from those of `_hashed`: the folder may be one that other programs use, too."""


def _remove_abandoned(folder: Path) -> None:
    """Remove what killed processes left: the system has released their locks, while those of living processes are held."""
    for name in (file for file in folder.glob(".*.lock") if _OWN_LOCK.fullmatch(file.name)):
        with suppress(OSError), open(name, "ab") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            if _is_at(lock, name):
                for scratch in folder.glob(f"{name.stem}.*/"):
                    shutil.rmtree(scratch, ignore_errors=True)
                name.unlink()


def _is_at(opened: BinaryIO, name: Path) -> bool:
    try:
        return os.path.samestat(os.fstat(opened.fileno()), name.stat())
    except FileNotFoundError:
        return False


def _put(made: Path, file: Path) -> None:
    """Move a finished file into place, and then its digest: until both are there it counts as damaged."""
    (digest := _digest_of(made)).write_text(content_digest(made))
    os.replace(made, file)
    os.replace(digest, _digest_of(file))


def _sound(file: Path) -> bool:
    """True if a file is there as it was written."""
    try:
        return _digest_of(file).read_text() == content_digest(file)
    except (OSError, UnicodeDecodeError):
        return False


def _digest_of(file: Path) -> Path:
    return file.with_name(f"{file.name}.sha256")


def _folder() -> Path:
    """The user's own folder of machine code: nobody else may write what is run. PermissionError where there is none."""
    package, users, temporary = _PACKAGE / "__pycache__", named_folder(), Path(tempfile.gettempdir())
    for parent in (package, users, temporary):
        if folder := _private_folder(parent):
            if parent == temporary:
                _tell(f"{package} and {users} cannot be written: machine code is kept in {folder}; R37_CACHE names another")
            return folder
    raise PermissionError("R37_CACHE: found no folder that can be written for machine code; allowed: a folder that can")


def _private_folder(parent: Path) -> Path | None:
    """A folder in `parent` that its user alone may write, made where it is missing; None where it cannot be."""
    folder = parent / f"r37-{os.getuid()}"
    with suppress(OSError):
        folder.mkdir(0o700, parents=True, exist_ok=True)
        state = folder.lstat()
        # links have all rights
        if state.st_uid != os.getuid() or state.st_mode & 0o022:
            _tell(f"{folder}: not used, as others may write it; remove it, and it is made anew")
        elif os.access(folder, os.W_OK):
            return folder
    return None


_tell = cache(logging.getLogger("r37").warning)
"""Warns of something once in a process."""
