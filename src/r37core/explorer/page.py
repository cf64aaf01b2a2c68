"""results/explorer.html: one file with data, program and plotly inside, which opens offline."""

from __future__ import annotations

import html
import json
from collections.abc import Mapping
from pathlib import Path

from plotly.offline import get_plotlyjs

from r37core.io import atomic_write

from . import PARTS


def write_page(contents: Mapping[str, object], title: str, file: Path | str) -> None:
    """Write the page for the contents of explorer_contents, atomically."""
    folder = Path(__file__).parent
    page, style, program = ((folder / part).read_text(encoding="utf-8") for part in PARTS)
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
