"""Whether a committed file is out of date, by content and never by times: made_from.json says what each was made from.

`python -m evidence.made_from` lists those that are, and ends with 1 if there are any.
"""

from __future__ import annotations

import fcntl
import hashlib
import sys
from collections.abc import Iterable
from pathlib import Path

from evidence.pages import Pages, of_now
from evidence.plan import MADE, TABLES, Plan
from r37core.base.io import read_json, write_json

RECORD = f"{TABLES}/made_from.json"


def out_of_date(plan: Plan) -> dict[str, str]:
    """Files that are not those which their items would make now, or that nothing makes, and why."""
    root, stale, known = plan.root, {}, read_json(plan.root / RECORD)
    for file, item in plan.committed.items():
        if file not in known:
            stale[file] = "was never made"
        elif known[file]["made_from"] != plan.hash_of(item.name):
            stale[file] = "what it is made from has changed"
        elif not (root / file).exists() or content_hash(root / file) != known[file]["content"]:
            stale[file] = "is not what was made"
    pages = Pages(root)
    shown = {*pages.all_tables, *pages.pictures}
    stale |= dict.fromkeys(sorted(shown - plan.committed.keys()), "no item makes it")
    for page in pages.files:
        try:
            if of_now(root, page) != (root / page).read_text(encoding="utf-8"):
                stale[page] = "its tables have other numbers"
        except (FileNotFoundError, ValueError) as error:
            stale[page] = str(error)
    return stale


def note(plan: Plan, files: Iterable[str]) -> None:
    """Note what committed files have just been made from; several processes may do so at a time."""
    made = {file: plan.committed[file].name for file in files if file in plan.committed}
    new = {file: {"made_from": plan.hash_of(name), "content": content_hash(plan.root / file)} for file, name in made.items()}
    lock = plan.root / MADE / "made_from.lock"
    lock.parent.mkdir(parents=True, exist_ok=True)
    with open(lock, "w") as stream:
        fcntl.flock(stream, fcntl.LOCK_EX)
        known = {file: entry for file, entry in read_json(plan.root / RECORD).items() if file in plan.committed}
        write_json(dict(sorted((known | new).items())), plan.root / RECORD)


def content_hash(file: Path) -> str:
    """Short hash of a file."""
    return hashlib.sha256(file.read_bytes()).hexdigest()[:16]


if __name__ == "__main__":
    stale = out_of_date(Plan())
    print("".join(f"{file}: {why}\n" for file, why in stale.items()) + f"{len(stale)} files of the pages are out of date")
    sys.exit(bool(stale))
