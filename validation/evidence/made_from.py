"""Whether a committed file is out of date, by content and never by times: made_from.json says what each was made from."""

from __future__ import annotations

import hashlib
import io
import tokenize
from collections.abc import Iterable, Mapping
from pathlib import Path

from evidence.pages import Pages, renewed
from r37core.base.io import read_json, write_json
from r37core.base.yaml_file import load_yaml

RECORD = "validation/tables/made_from.json"

MAIN_JOB = tuple(f"config/{name}.yaml" for name in ("blades", "config", "fidelity", "scenes"))

_LAYOUT = (tokenize.COMMENT, tokenize.NL, tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT)


class MadeFrom:
    """Committed files of the folder `root`, and the hash of what each is made from: target -> rule file, and hash of its code.

    Beside these count the shared runs, the configuration of the main job and those of its files that the rules name and, for
    all but `engine` itself, the numbers of the engine.
    `sources`: target -> another file of the repository that it is made from.
    """

    def __init__(self, root: Path, rules: Mapping[str, tuple[Path, str]], engine: str, sources: Mapping[str, str]):
        self._root, self._rules, self._engine, self._sources = root, rules, engine, sources

    def now(self, target: str) -> str:
        """Hash of what a target would be made from."""
        file, code = self._rules[target]
        words = [*_words(file), *_words(file.with_name("runs.smk"))]
        others = {self._engine, self._sources.get(target, "")} - {target, ""}
        parts = [code, words, *((self._root / name).read_bytes() for name in sorted(others))]
        every = sorted([*self._root.glob("config/*.yaml"), *self._root.glob("validation/*.yaml")])
        main = [self._root / name for name in MAIN_JOB]
        configuration = [name for name in every if name in main or name.stem in " ".join(words)]
        return hashlib.sha256(repr([*parts, *map(load_yaml, configuration)]).encode()).hexdigest()[:16]

    def out_of_date(self, pages: Pages) -> list[str]:
        """Targets that were made from something else, and pages whose tables are others; of the rest no page is older."""
        known = read_json(self._root / RECORD)
        stale = [target for target in self._rules if known.get(target) != self.now(target)]
        for page in pages.files:
            file, tables = self._root / page, [self._root / name for name in pages.tables(page)]
            if all(table.exists() for table in tables):
                text = file.read_text(encoding="utf-8")
                if renewed(text, tables) != text:
                    stale.append(page)
                elif max(table.stat().st_mtime for table in tables) > file.stat().st_mtime:
                    file.touch()
        return stale

    def note(self, made: Iterable[str]) -> None:
        """Note what those of the `made` files that are committed were made from."""
        new = {target: self.now(target) for target in made if target in self._rules}
        write_json(dict(sorted((read_json(self._root / RECORD) | new).items())), self._root / RECORD)


def _words(file: Path) -> list[str]:
    """Words of a file of rules without comments and layout."""
    tokens = tokenize.generate_tokens(io.StringIO(file.read_text(encoding="utf-8")).readline)
    return [token.string for token in tokens if token.type not in _LAYOUT]
