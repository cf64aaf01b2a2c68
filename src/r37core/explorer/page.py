"""Pages of one file with data, program and plotly inside, which open offline: explorer.html, and the shapes of a blade."""

from __future__ import annotations

import html
import json
from collections.abc import Sequence
from pathlib import Path

from plotly.offline import get_plotlyjs

from r37core.io import atomic_write

from . import PARTS


def write_page(contents: object, title: str, file: Path | str, parts: Sequence[Path] = PARTS) -> None:
    """Write the page made of `parts` (page, style, program) and its contents, by default the explorer, atomically."""
    page, style, program = (part.read_text(encoding="utf-8") for part in parts)
    # "<" would end the script that carries the data, if a name had it
    data = json.dumps(contents, allow_nan=False).replace("<", "\\u003c")
    for mark, text in (
        ("title", html.escape(title)),
        ("style", style),
        ("plotly", get_plotlyjs()),
        ("data", data),
        ("program", program),
    ):
        page = page.replace(f"<!-- {mark} -->", text)
    with atomic_write(file) as partial:
        partial.write_text(page, encoding="utf-8")
