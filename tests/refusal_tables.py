"""Tables of refusals: what is added to a file of a configuration, and how the message about it begins.

A row is `snippet => message`, below `[config]`, `[blades]` or `[scenes]`, the file that it is added to; ` / ` is a line break
of the snippet, ` ... ` in the message stands for anything. Snippets for config.yaml lie on top of it.
"""

import re
from pathlib import Path

import pytest

from r37core.config import ConfigError, read_document
from r37core.product.extensions import read_settings


def refusal_rows(table, *kinds):
    """Rows (file, snippet, message) of a table; of these kinds alone, where some are given."""
    kind, rows = "", []
    for line in filter(None, Path(table).read_text().splitlines()):
        snippet, _, message = line.partition(" => ")
        if message:
            rows.append((kind, snippet.strip(), message))
        elif line.startswith("["):
            kind = line.strip("[]")
    return [row for row in rows if not kinds or row[0] in kinds]


def pattern_of(message):
    """Regular expression of a table's message."""
    return ".*".join(map(re.escape, message.split(" ... ")))


def check_refusal(folder, kind, snippet, message):
    """The configuration in a folder with a snippet added is refused with file, line, and this message."""
    name = "mine.yaml" if kind == "config" else f"config/{kind}.yaml"
    with open(folder / name, "a") as stream:
        stream.write("\n" + snippet.replace(" / ", "\n") + "\n")
    pattern = pattern_of(message)
    with pytest.raises(ConfigError, match=rf"(^|\n)config/stacking/\S+: {pattern}|(^|\n){re.escape(name)}:\d+: {pattern}"):
        read_settings(folder, *([read_document(folder, name)] if kind == "config" else []))
