"""What a claim is: files in README and docs/ that one command makes, and what decides their numbers."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

from .texts import whole

ROOT = Path(__file__).resolve().parents[3]
STUDIES = "results/studies"


@dataclass(frozen=True)
class Output:
    """A file of the documentation, or the part between two markers of a page, and the file of results that it is made from.

    `place`: docs/x.png, or docs/page.md#marker; `source`: None where the command writes the place itself. `drawn_by`: files of
    code that decide about this output alone. `text`: what a page takes of the source's text.
    """

    place: str
    source: str | None
    drawn_by: tuple[str, ...] = ()
    text: Callable[[str], str] = whole

    @property
    def page(self) -> str:
        """The file."""
        return self.place.partition("#")[0]

    @property
    def marker(self) -> str:
        """Name of the part, empty for a whole file."""
        return self.place.partition("#")[2]

    @property
    def kind(self) -> str:
        """What a reader sees: a table, a picture or a page."""
        return "picture" if self.page.endswith(".png") else "table" if self.marker else "page"


@dataclass(frozen=True)
class Claim:
    """Outputs that one list of shell commands makes.

    `code`: scripts of validation/benchmarks/ (with what they import there) and files of src/; `configuration`: `file` or
    `file:dotted.key`; `numbers`: fixed runs of docs/fingerprint.json that stand for the engine.
    `minutes` on two cores, None where not measured. `by_hand`: what to do, where there is no command. `checked_by`: a test that
    makes the output anew and compares it, so that it needs no hash.
    """

    name: str
    outputs: tuple[Output, ...]
    commands: tuple[str, ...] = ()
    minutes: float | None = None
    code: tuple[str, ...] = ()
    configuration: tuple[str, ...] = ()
    numbers: tuple[str, ...] = ()
    by_hand: str = ""
    checked_by: str = ""


def tables(page: str, prefix: str, names: Iterable[str]) -> tuple[Output, ...]:
    """Parts of a page, each from the file of results of its name after a prefix."""
    return tuple(Output(f"docs/{page}.md#{name}", f"{STUDIES}/{prefix}{name}.md") for name in names)


def picture(name: str, source: str, *drawn_by: str) -> Output:
    """A picture of docs/; `drawn_by`: modules of r37core, as `folder/module`, beside the style that all share."""
    files = tuple(f"src/r37core/{module}.py" for module in ("figures/style", *drawn_by))
    return Output(f"docs/{name}.png", source, files)
