"""Attributes of a result file that joins others: what made it, after the conventions of CF and ACDD."""

import hashlib
import os
import platform
import time
from datetime import UTC, datetime
from functools import cache
from importlib.metadata import version
from pathlib import Path

import r37core

LIBRARIES = ("numpy", "scipy", "numba", "gmsh")
"""Libraries whose versions can change a digit of a result."""

REFERENCES = "https://doi.org/10.1016/j.jsv.2019.114878"
LICENSE = "results belong to who made them; r37 itself: MIT"


def origin(title: str) -> dict[str, str]:
    """Attributes of a file with this `title`: what made it, with which versions, and when."""
    made = date_created()
    return {
        "title": title,
        "history": f"{made}: joined by r37 {r37core.__version__}",
        "source": source(),
        "references": REFERENCES,
        "license": LICENSE,
        "date_created": made,
    }


def date_created() -> str:
    """Date and time now, or those of the environment's SOURCE_DATE_EPOCH (s since 1970), so that equal inputs give equal bytes.

    Raises ValueError for another text. See https://reproducible-builds.org/specs/source-date-epoch.
    """
    epoch = os.environ.get("SOURCE_DATE_EPOCH")
    try:
        return datetime.fromtimestamp(int(epoch or time.time()), UTC).isoformat(timespec="seconds")
    except (ValueError, OverflowError, OSError):
        raise ValueError(f"SOURCE_DATE_EPOCH: found {epoch!r}; allowed: whole seconds since 1970") from None


@cache
def source() -> str:
    """Version of r37, hash of its code, and versions of what it computes with."""
    libraries = ", ".join(f"{name} {version(name)}" for name in LIBRARIES)
    return f"r37 {r37core.__version__}, code {code_hash()}; Python {platform.python_version()}, {libraries}"


def code_hash() -> str:
    """Short hash of the installed code of r37core: names and texts of its modules."""
    root, digest = Path(r37core.__file__).parent, hashlib.sha256()
    for file in sorted(root.rglob("*.py")):
        digest.update(file.relative_to(root).as_posix().encode() + b"\0" + file.read_bytes())
    return digest.hexdigest()[:16]
