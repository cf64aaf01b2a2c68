"""One page to look at all results of a run."""

import hashlib
from pathlib import Path

PARTS = ("explorer.html", "explorer.css", "explorer.js")
"""What the page is put together from, in this folder, beside its data and plotly."""


def parts_hash() -> str:
    """Hash of the parts: with it as a rule's parameter an edited part makes the page anew."""
    texts = [(Path(__file__).parent / part).read_bytes() for part in PARTS]
    return hashlib.sha256(b"\0".join(texts)).hexdigest()[:16]
