"""Whether a committed file is out of date, by content and never by times: made_from.json says what each was made from.

`python -m evidence.made_from` lists those that are, and ends with 1 if there are any.
"""

from __future__ import annotations

import hashlib
import sys
from collections.abc import Iterable
from pathlib import Path

from evidence.pages import Pages, renewed
from evidence.plan import TABLES, Plan
from r37core.base.io import read_json, write_json

RECORD = f"{TABLES}/made_from.json"


def out_of_date(plan: Plan) -> dict[str, str]:
    """Files that are not those which their items would make now, or that nothing makes, and why."""
    root, stale, known = plan.root, {}, read_json(plan.root / RECORD)
    for file, item in plan.committed.items():
        if file not in known or not (root / file).exists():
            stale[file] = "was never made"
        elif known[file]["made_from"] != plan.hash_of(item.name):
            stale[file] = "what it is made from has changed"
        elif known[file]["content"] != content_hash(root / file):
            stale[file] = "was edited"
    pages = Pages(root)
    stale |= dict.fromkeys({*pages.all_tables, *pages.pictures} - plan.committed.keys(), "no item makes it")
    for page in pages.files:
        text, tables = (root / page).read_text(encoding="utf-8"), [root / name for name in pages.tables(page)]
        if all(table.exists() for table in tables) and renewed(text, tables) != text:
            stale[page] = "its tables have other numbers"
    return stale


def note(plan: Plan, files: Iterable[str]) -> None:
    """Note what committed files were made from: their items as they are now."""
    new = {file: {"made_from": plan.hash_of(plan.committed[file].name), "content": content_hash(plan.root / file)} for file in files}
    kept = {file: entry for file, entry in read_json(plan.root / RECORD).items() if file in plan.committed}
    write_json(dict(sorted((kept | new).items())), plan.root / RECORD)


def content_hash(file: Path) -> str:
    """Short hash of a file."""
    return hashlib.sha256(file.read_bytes()).hexdigest()[:16]


if __name__ == "__main__":
    stale = out_of_date(Plan())
    print("".join(f"{file}: {why}\n" for file, why in stale.items()) + f"{len(stale)} files of the pages are out of date")
    sys.exit(bool(stale))
