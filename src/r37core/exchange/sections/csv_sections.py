"""Tables (CSV) of sections: columns section, x, y, z, and side where the two sides of a section are apart."""

import csv
import io

import numpy as np

from r37core.base.io import TextFileError

from .section_text import FileSection, closed_section, joined_sides, number_in

_COLUMNS = ("section", "x", "y", "z")


def read_table(text: str) -> tuple[FileSection, ...]:
    """Sections of a table, in the order of their first rows. Raises TextFileError."""
    delimiter = ";" if ";" in text.partition("\n")[0] else ","
    reader = csv.DictReader(io.StringIO(text, newline=""), delimiter=delimiter, strict=True)
    # section -> side -> points
    sections: dict[str, dict[str, list[list[float]]]] = {}
    lines: dict[str, int] = {}
    try:
        reader.fieldnames = header = [column.strip().lower() for column in reader.fieldnames or []]
        missing = [column for column in _COLUMNS if column not in header]
        if missing:
            raise TextFileError(
                1, f"the table lacks the columns {', '.join(missing)}; needed: section, x, y, z, separated by commas"
            )
        for row in reader:
            if None in row or None in row.values():
                raise TextFileError(reader.line_num, "the row has more or fewer cells than the first line has columns")
            name, side = row["section"].strip(), row.get("side", "").strip()
            lines.setdefault(name, reader.line_num)
            point = [number_in(row[column].strip(), reader.line_num, f"column {column}") for column in "xyz"]
            sections.setdefault(name, {}).setdefault(side, []).append(point)
    except csv.Error as error:
        raise TextFileError(reader.line_num, f"not readable as a table separated by commas: {error}") from None
    if not sections:
        raise TextFileError(1, "found no rows; needed: section, x, y, z of each point")
    return tuple(_section(sides, lines[name]) for name, sides in sections.items())


def _section(sides: dict[str, list[list[float]]], line: int) -> FileSection:
    if len(sides) > 2:
        raise TextFileError(line, f"found {len(sides)} values in the column side of one section; allowed: one or two")
    parts = [np.array(points) for points in sides.values()]
    return closed_section(parts[0], line) if len(parts) == 1 else FileSection(joined_sides(*parts), line)
