"""The user's folder of structures, which take minutes to make: calls from Python and runs of the workflow share it."""

import os
import tempfile
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from .kept import kept_file, users_cache


def named_folder() -> Path:
    """Path of the folder, which may not be there yet: that of R37_CACHE, else the user's cache folder."""
    named = os.environ.get("R37_CACHE")
    return Path(named) if named else users_cache()


def writable_folder() -> Path:
    """The folder, made where it is missing. Raises OSError where it cannot be written."""
    folder = named_folder()
    folder.mkdir(parents=True, exist_ok=True)
    tempfile.TemporaryFile(dir=folder).close()
    return folder


def kept_for_user(name: str, made_of: object, make: Callable[[Path], None]) -> Path | None:
    """`kept_file` in the folder; None where that cannot be written. Raises what `make` raises but OSErrors."""
    with suppress(OSError):
        return kept_file(name, made_of, make, writable_folder())
    return None


@cache
def numerics(*libraries: str) -> list[str]:
    """Versions of libraries that numbers come from, and what their linear algebra is compiled for: others round otherwise."""
    from threadpoolctl import threadpool_info

    kernels = {str(library["architecture"]) for library in threadpool_info() if "architecture" in library}
    return [*map(_version, libraries), *sorted(kernels)]


def _version(library: str) -> str:
    try:
        return version(library)
    except PackageNotFoundError:
        # installed by another way than pip's
        return ""
