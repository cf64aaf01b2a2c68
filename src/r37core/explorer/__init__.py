"""One page to look at all results of a run, and one with the shapes of a blade."""

import hashlib
from collections.abc import Sequence
from pathlib import Path

PARTS = ("explorer.html", "explorer.css", "explorer.js")
"""What the page is put together from, in this folder, beside its data and plotly."""

SHAPE_PARTS = ("shapes.html", "explorer.css", "shapes.js")
"""The same of the page with a blade's shapes."""


def parts_hash(parts: Sequence[str] = PARTS) -> str:
    """Hash of the parts: with it as a rule's parameter an edited part makes the page anew."""
    texts = [(Path(__file__).parent / part).read_bytes() for part in parts]
    return hashlib.sha256(b"\0".join(texts)).hexdigest()[:16]
