"""What a page takes of a table: all of it, its summary, or README's few lines."""

import re

_LARGEST = 3


def whole(text: str) -> str:
    """The table as it is."""
    return text


def summary(text: str) -> str:
    """What stands before the first table, and the rows of that with something bold in them: what differs."""
    before, _, table = text.partition("\n|")
    header, line, *rows = f"|{table}".splitlines()
    bold = [row for row in rows if row.startswith("|") and "**" in row]
    return "\n".join([before.strip(), *(["", header, line, *bold] if bold else [])])


def differences(text: str) -> str:
    """Of the table of all checks: how many agree, and the numbers that differ most, largest first."""
    match = re.match(r"(\d+ of \d+) published numbers and statements agree", text.strip())
    if match is None:
        raise ValueError("a table of checks begins with how many agree")
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines() if line.startswith("|")]
    # of yes and no there is no size
    numbers = [row for row in rows if re.fullmatch(r"\*\*[\d.]+%\*\*", row[3])]
    numbers.sort(key=lambda row: -float(row[3].strip("*%")))
    shown = [f"- {what}: {float(ours):.3g}, published {published}" for what, published, ours, *_ in numbers[:_LARGEST]]
    head = f"At `paper` {match[1]} published numbers and statements agree. Furthest off:"
    return "\n".join([head, "", *shown])
