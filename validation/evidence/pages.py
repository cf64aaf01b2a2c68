"""Tables and numbers of pages: CSV files of validation/tables, which stand in the pages as Markdown and in sentences.

`<!-- table NAME -->` and `<!-- end -->` hold a table, `<!-- table NAME: Ref; S100 -->` its rows of these first cells, and
`<!-- lines NAME: fan -->` the last cells of such rows, as what a program prints.
A number in a sentence stands before its source, `452<!--NAME:Ref:bare_casing-->`: table, row and column, and from the second
number of a cell on its place, from 0. A row is named by its first cell, or by its first cells joined by +.
"""

import re
from collections.abc import Iterable, Sequence
from contextlib import suppress
from pathlib import Path

from r37core.base.io import write_text

from .tables import read_table

_MARKER = re.compile(r"^<!-- (?:table|lines) (\w+)(?:: [^\n]*)? -->$", re.MULTILINE)
_NUMBER = re.compile(
    r"(?P<number>[-+]?\d[\d.,]*\d|[-+]?\d)"
    r"<!--(?P<table>\w+):(?P<row>[^:\s]+):(?P<column>[^:\s]+?)(?::(?P<place>\d+))?-->"
)
_DIGITS = re.compile(r"(?<![\d\w])[-+]?\d(?:[\d.,]*\d)?(?:e[-+]?\d+)?")
_LINK = re.compile(r"(?<=/)validation/tables/\w+\.csv|(?<=\()validation/tables/\w+\.csv")
_PICTURE = re.compile(r"!\[[^\]]*\]\(([\w/]+\.png)\)")


def replace_part(text: str, name: str, part: str) -> str:
    """The text with another part between <!-- name --> and <!-- end -->; ValueError where these markers are missing."""
    markers = re.search(rf"(<!-- {re.escape(name)} -->\n).*?<!-- end -->", text, re.DOTALL)
    if markers is None:
        raise ValueError(f"there is no part between <!-- {name} --> and <!-- end -->")
    return f"{text[: markers.start()]}{markers[1]}{part.rstrip()}\n<!-- end -->{text[markers.end() :]}"


def markdown(rows: Iterable[Sequence[str]]) -> str:
    """A table as it stands in a page; the first row is the head."""
    escaped = [[cell.replace("|", r"\|") for cell in cells] for cells in rows]
    head, *lines = ["| " + " | ".join(cells) + " |\n" for cells in escaped]
    return "".join([head, "|---" * len(escaped[0]) + "|\n", *lines])


class Pages:
    """The pages of a project: README.md, docs/*.md and paper/paper.md, and the tables that stand in each."""

    def __init__(self, root: Path):
        self._root = root

    @property
    def files(self) -> list[str]:
        """Pages with a table."""
        return [name for page in self._pages() for name in [str(page.relative_to(self._root))] if self.tables(name)]

    def _pages(self) -> list[Path]:
        return [
            self._root / "README.md",
            *(page for name in ("docs", "paper") for page in sorted((self._root / name).glob("*.md"))),
        ]

    @property
    def all_tables(self) -> list[str]:
        """Files of the tables that stand in pages or that pages link."""
        linked = {name for page in self._pages() for name in _LINK.findall(page.read_text(encoding="utf-8"))}
        return sorted({*linked, *(file for page in self.files for file in self.tables(page))})

    @property
    def pictures(self) -> list[str]:
        """Pictures that stand in pages."""
        shown = {(page.parent / name) for page in self._pages() for name in _PICTURE.findall(page.read_text(encoding="utf-8"))}
        return sorted(str(file.relative_to(self._root)) for file in shown)

    def tables(self, page: str) -> list[str]:
        """Files of the tables of a page, then of the numbers in its sentences, each once."""
        text = (self._root / page).read_text(encoding="utf-8")
        names = dict.fromkeys([*_MARKER.findall(text), *(found["table"] for found in _NUMBER.finditer(text))])
        return [f"validation/tables/{name}.csv" for name in names]


def renewed(page: str, files: Iterable[Path | str]) -> str:
    """Text of a page with its tables and numbers taken from their files."""
    tables = {Path(file).stem: read_table(file) for file in files}
    for name, (head, *rows) in tables.items():
        for marker in re.findall(rf"^<!-- ((?:table|lines) {name}(?:: [^\n]*)?) -->$", page, re.MULTILINE):
            _, _, chosen = marker.partition(": ")
            shown = [row for row in rows if not chosen or row[0] in chosen.split("; ")]
            printed = "\n".join(["```text", *(row[-1] for row in shown), "```"])
            page = replace_part(page, marker, markdown([head, *shown]) if marker.startswith("table") else printed)
    return _NUMBER.sub(lambda found: found[0].replace(found["number"], _number(tables[found["table"]], found), 1), page)


def _number(table: Sequence[Sequence[str]], source: re.Match[str]) -> str:
    """The number that a source names; ValueError where the table has no such row, column or number."""
    head, *rows = table
    try:
        column = [_word(name) for name in head].index(source["column"])
        names = source["row"].split("+")
        row = next(row for row in rows if [_word(cell) for cell in row[: len(names)]] == names)
        return _DIGITS.findall(row[column])[int(source["place"] or 0)]
    except (ValueError, StopIteration, IndexError):
        raise ValueError(f"{source[0]}: the table has no such row, column or number") from None


def _word(cell: str) -> str:
    return re.sub(r"[^\w.-]+", "_", cell).strip("_")


def renew_all(root: Path) -> None:
    """Put the tables and numbers into all pages of a project; a page that asks for one that is not there stays as it is."""
    for name in Pages(root).files:
        text = (root / name).read_text(encoding="utf-8")
        with suppress(FileNotFoundError, ValueError):
            if (new := of_now(root, name)) != text:
                write_text(new, root / name)


def of_now(root: Path, name: str) -> str:
    """Text of a page with what its tables have now. Raises FileNotFoundError without one, ValueError without a number."""
    return renewed((root / name).read_text(encoding="utf-8"), [root / table for table in Pages(root).tables(name)])
