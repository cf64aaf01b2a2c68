"""The explorer: one page with data, program and plotly inside, which opens offline."""

import hashlib
import html
import json
from collections.abc import Sequence
from pathlib import Path

from r37core.base.io import write_text

FOLDER = Path(__file__).parent

_PROGRAMS = ("theme", "panels", "explorer")

PARTS = (FOLDER / "explorer.html", FOLDER / "explorer.css", *(FOLDER / f"{name}.js" for name in _PROGRAMS))
"""Files of the page apart from its data and plotly: page, style, and its program in the order it runs."""


def page_parts(programs: Sequence[Path | str]) -> tuple[Path, ...]:
    """The parts of a page with panels of extensions, whose programs run before the page's own."""
    return (*PARTS[:-1], *map(Path, programs), PARTS[-1])


def parts_hash(parts: Sequence[Path] = PARTS) -> str:
    """Hash of the parts: with it as a rule's parameter an edited part makes the page anew."""
    return hashlib.sha256(b"\0".join(part.read_bytes() for part in parts)).hexdigest()[:16]


def write_page(contents: object, title: str, file: Path | str, parts: Sequence[Path] = PARTS) -> None:
    """Write the page made of `parts` (page, style, programs) and its contents, atomically."""
    # heavy, and rules import this module for its parts
    from plotly.offline import get_plotlyjs

    page, style, *programs = (part.read_text(encoding="utf-8") for part in parts)
    # "<" would end the script that carries the data, if a name had it
    data = json.dumps(contents, allow_nan=False).replace("<", "\\u003c")
    for mark, text in (
        ("title", html.escape(title)),
        ("style", style),
        ("plotly", get_plotlyjs()),
        ("data", data),
        ("program", "\n".join(programs)),
    ):
        page = page.replace(f"<!-- {mark} -->", text)
    write_text(page, file)
