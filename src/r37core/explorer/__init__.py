"""One page to look at all results of a run."""

import hashlib
from collections.abc import Sequence
from pathlib import Path

FOLDER = Path(__file__).parent

PARTS = tuple(FOLDER / name for name in ("explorer.html", "explorer.css", "explorer.js"))
"""What the page is put together from, beside its data and plotly: page, style, program."""


def parts_hash(parts: Sequence[Path] = PARTS) -> str:
    """Hash of the parts: with it as a rule's parameter an edited part makes the page anew."""
    return hashlib.sha256(b"\0".join(part.read_bytes() for part in parts)).hexdigest()[:16]
