"""Outputs that are known to be older than what makes them: docs/older.json, and the sentence beside each on its page."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

from r37core.io import read_json, write_json, write_text

from .claim import Output

LIST = "docs/older.json"
_NOTE = re.compile(r"\n\n<!-- older -->\n.*?\n<!-- end -->", re.DOTALL)


def read_older(root: Path) -> dict[str, str]:
    """Place -> in words, why it is older."""
    return read_json(root / LIST)


def write_older(older: Mapping[str, str], root: Path) -> None:
    """The list, and the sentences on all pages as it has them."""
    write_json(dict(sorted(older.items())), root / LIST)
    for file in pages(root):
        text = file.read_text(encoding="utf-8")
        noted = with_notes(text, str(file.relative_to(root)), older)
        if noted != text:
            write_text(noted, file)


def pages(root: Path) -> list[Path]:
    """README and the pages of docs/."""
    return [root / "README.md", *sorted((root / "docs").glob("*.md"))]


def with_notes(text: str, page: str, older: Mapping[str, str]) -> str:
    """A page with one sentence after each table and picture that is older, and after no other."""
    text = _NOTE.sub("", text)
    folder = Path(page).parent
    for place, why in older.items():
        output = Output(place, None)
        note = f"\n\n<!-- older -->\n*This {output.kind} is older than what makes it: {why}.*\n<!-- end -->"
        if output.kind == "picture":
            shown = re.escape(str(Path(place).relative_to(folder)))
            pattern = rf"^!\[[^\]]*\]\({shown}\)$"
        elif output.page == page:
            pattern = rf"^<!-- {re.escape(output.marker)}(?: made-with:\w+)? -->\n.*?<!-- end -->"
        else:
            continue
        text = re.sub(pattern, lambda match, note=note: match[0] + note, text, flags=re.DOTALL | re.MULTILINE)
    return text
