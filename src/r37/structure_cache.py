"""Files that take long to make, kept by a hash of all that their content follows from.

They lie in the folder that R37_CACHE names, else in `r37` of XDG_CACHE_HOME, else in ~/.cache/r37. Each has a folder of its
own, which is moved into place when it is complete, so that processes may work side by side. One that is cut short or damaged
is made again. The folder may be removed at any time.
"""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path

from r37core.config import ConfigError
from r37core.kept import users_cache
from r37core.plain import to_plain

_DIGEST = "sha256"


def cache_folder() -> Path:
    """Where the files are kept."""
    named = os.environ.get("R37_CACHE")
    return Path(named) if named else users_cache()


def cached_file(name: str, made_of: object, make: Callable[[Path], None]) -> Path:
    """The file called `name` whose content follows from `made_of`; `make(path)` writes it where it is not there, or damaged.

    `made_of`: plain values and dataclasses. Raises ConfigError where the cache folder cannot be written, and what `make`
    raises.
    """
    content = json.dumps(to_plain([name, made_of]), sort_keys=True)
    folder = cache_folder() / f"{Path(name).stem}-{hashlib.sha256(content.encode()).hexdigest()[:32]}"
    if not _sound(folder / name):
        with _new_folder() as partial:
            made = Path(partial) / "made"
            made.mkdir()
            make(made / name)
            (made / _DIGEST).write_text(_digest(made / name))
            _move(made, folder, name)
    return folder / name


def _new_folder() -> tempfile.TemporaryDirectory[str]:
    """A temporary folder inside the cache folder."""
    cache = cache_folder()
    try:
        cache.mkdir(parents=True, exist_ok=True)
        return tempfile.TemporaryDirectory(prefix=".", dir=cache)
    except OSError as error:
        raise ConfigError(
            f"R37_CACHE: found the cache folder {cache}, which cannot be written ({error.strerror}); allowed: a folder that can"
        ) from None


def _move(made: Path, folder: Path, name: str) -> None:
    """Move a finished folder into place, unless another process has been faster."""
    if folder.exists() and not _sound(folder / name):
        shutil.rmtree(folder, ignore_errors=True)
    try:
        os.rename(made, folder)
    except OSError:
        if not _sound(folder / name):
            raise


def _sound(file: Path) -> bool:
    """Whether a file is there as it was written."""
    try:
        return file.with_name(_DIGEST).read_text() == _digest(file)
    except (OSError, UnicodeDecodeError):
        return False


def _digest(file: Path) -> str:
    with open(file, "rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()
