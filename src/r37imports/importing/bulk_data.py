"""Cards of Nastran's bulk data, and their numbers. Light: the configuration imports it."""

import math
import re
from collections.abc import Iterator
from pathlib import Path


def bulk_cards(file: Path) -> Iterator[list[str]]:
    """Cards from BEGIN BULK, or the file's beginning, to ENDDATA, the last: name in capitals, then fields without blanks.

    Fields end at commas or have 8 characters, or 16 where a `*` follows the name. A line whose first field is empty or begins
    with `+` or `*` continues the card.
    """
    text = file.read_text(encoding="utf-8", errors="replace").expandtabs(8)
    bulk = re.split(r"^ *BEGIN +BULK.*$", text, maxsplit=1, flags=re.MULTILINE | re.IGNORECASE)[-1]
    card, count = [""], 8
    for line in filter(None, (line.partition("$")[0].rstrip() for line in bulk.splitlines())):
        name = (line.partition(",")[0] if "," in line else line[:8]).strip().upper()
        if re.match("END(DATA| +BULK)", line, re.IGNORECASE):
            yield card
            card = ["ENDDATA"]
            break
        if name and name[0] not in "+*":
            yield card
            card, count = [name.rstrip("* ")], 4 if name.endswith("*") else 8
        count = 4 if name.startswith("*") else count
        cells = line.split(",")[1:] if "," in line else [line[i : i + 64 // count] for i in range(8, 72, 64 // count)]
        # behind its fields a line has the name of the next one, or all other fields
        card += map(str.strip, cells if len(cells) > count + 1 else [*cells, *[""] * count][:count])
    yield card


def bulk_number(cell: str) -> float:
    """Number of a field, which may be written 2.1+11; NaN for other texts and of an empty field."""
    try:
        return float(re.sub(r"(?<=[\d.])([+-]\d+)$", r"e\1", cell.strip().upper().replace("D", "E")))
    except ValueError:
        return math.nan
