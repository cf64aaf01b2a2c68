"""What is kept from run to run because it takes long to make: each in a file that is checked when it is read.

It lies beside the package, or in the user's cache folder where the package cannot be written. A file that is cut short or
damaged is made again. Light: the simulation jobs import it.
"""

from __future__ import annotations

import fcntl
import hashlib
import os
import tempfile
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

_PACKAGE = Path(__file__).parent
_DIGEST_BYTES = 32


def read_kept(name: str) -> bytes | None:
    """Content of what is kept under a name; None if it is not there, cannot be read or is not what was written."""
    try:
        content = (_folder() / name).read_bytes()
    except OSError:
        return None
    digest, kept = content[:_DIGEST_BYTES], content[_DIGEST_BYTES:]
    return kept if digest == hashlib.sha256(kept).digest() else None


def kept_or_made(name: str, make: Callable[[], bytes], worth_keeping: Callable[[], bool]) -> bytes:
    """Content of what is kept under a name, or what `make` gives, kept if it is `worth_keeping` then.

    Of several processes that need the same one makes it and the others wait, so that a core is not busy twice with one thing.
    """
    content = read_kept(name)
    if content is not None:
        return content
    with open(_folder() / "making.lock", "ab") as lock:
        # a byte of its own for each name; where the file system has no locks, several may make it
        with suppress(OSError):
            fcntl.lockf(lock, fcntl.LOCK_EX, 1, int(hashlib.sha256(name.encode()).hexdigest()[:7], 16))
        content = read_kept(name)
        if content is None:
            content = make()
            if worth_keeping():
                keep(content, name)
    return content


def keep(content: bytes, name: str) -> None:
    """Write to a file of its own and move it into place, so that processes may do so side by side."""
    handle, partial = tempfile.mkstemp(suffix=".partial", dir=_folder())
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(hashlib.sha256(content).digest() + content)
        os.replace(partial, _folder() / name)
    finally:
        Path(partial).unlink(missing_ok=True)


def _folder() -> Path:
    beside = _PACKAGE / "__pycache__"
    if _writable(beside):
        return beside
    users = users_cache()
    users.mkdir(parents=True, exist_ok=True)
    return users


def users_cache() -> Path:
    """The user's cache folder for r37, which may not be there yet."""
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "r37"


def _writable(folder: Path) -> bool:
    try:
        folder.mkdir(exist_ok=True)
    except OSError:
        return False
    return os.access(folder, os.W_OK)
