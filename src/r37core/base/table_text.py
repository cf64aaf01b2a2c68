"""Tables in text files, as spreadsheets and measuring programs write them: header and rows of cells."""

import csv
import re
from collections.abc import Iterator

from .io import TextFileError

_SEPARATORS = ";\t,"
_COMMENT = re.compile(r"^\s*#.*|\s#\s.*|^sep=.$")
_NUMBER = re.compile(r"\s*[-+]?[\d.,]*\d[\d.,]*(e[-+]?\d+)?\s*", re.IGNORECASE)
_DECIMAL_COMMA = re.compile(r"\s*[-+]?\d*,\d+(e[-+]?\d+)?\s*", re.IGNORECASE)
_THOUSANDS = re.compile(r"\s*[-+]?[1-9]\d{0,2},\d{3}\s*")
"""Numbers whose comma may separate thousands, too."""


def table_rows(text: str) -> Iterator[tuple[int, list[str]]]:
    """Number of the line (from 1) and stripped cells of the header, then of each row; of an empty text nothing.

    Comma, semicolon or tab separate cells. Between semicolons or tabs a number may have a decimal comma, which becomes a point.
    Blank lines, comments (#) and lines before the header are skipped. Raises TextFileError for text that is no CSV, and for
    1,234 where no other number of the table tells whether that is 1.234.
    """
    lines = [_COMMENT.sub("", line) for line in text.splitlines()]
    start, separator = _header(lines)
    reader = csv.reader((line + "\n" for line in lines[start:]), delimiter=separator, strict=True, skipinitialspace=True)
    try:
        rows = [(start + reader.line_num, cells) for cells in reader if any(cell.strip() for cell in cells)]
    except csv.Error as error:
        raise TextFileError(start + reader.line_num, f"not readable as a table: {error}") from None
    if separator != ",":
        _take_decimal_commas(rows)
    yield from ((line, [cell.strip() for cell in cells]) for line, cells in rows)


def _take_decimal_commas(rows: list[tuple[int, list[str]]]) -> None:
    """Make points of decimal commas. Raises TextFileError where all numbers with commas may have thousands."""
    places = [(row, place) for row, (_, cells) in enumerate(rows) for place, cell in enumerate(cells) if "," in cell]
    commas = [(row, place) for row, place in places if _DECIMAL_COMMA.fullmatch(rows[row][1][place])]
    doubtful = [(row, place) for row, place in commas if _THOUSANDS.fullmatch(rows[row][1][place])]
    if doubtful and len(doubtful) == len(commas):
        line, cells = rows[doubtful[0][0]]
        cell = cells[doubtful[0][1]].strip()
        raise TextFileError(line, f"{cell} may be {cell.replace(',', '.')} or {cell.replace(',', '')}: write points")
    for row, place in commas:
        rows[row][1][place] = rows[row][1][place].replace(",", ".")


def _header(lines: list[str]) -> tuple[int, str]:
    """Place of the header, the first line of titles with as many separators as the last line has, and the separator."""
    filled = [place for place, line in enumerate(lines) if line.strip()]
    if not filled:
        return 0, ","
    headers = []
    for order, separator in enumerate(_SEPARATORS):
        count = lines[filled[-1]].count(separator)
        alike = [place for place in filled[:-1] if lines[place].count(separator) == count]
        if count and alike and not any(map(_NUMBER.fullmatch, lines[alike[0]].split(separator))):
            headers.append((alike[0], order))
    if headers:
        place, order = min(headers)
        return place, _SEPARATORS[order]
    return filled[0], max(",;\t", key=lines[filled[0]].count)
