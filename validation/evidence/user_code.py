"""Figures of docs/user_code.md: each is drawn by a program of examples/figures, whose lines stand on the page."""

from __future__ import annotations

import ast
import runpy
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt


def part(program: Path) -> str:
    """Heading, words, lines and picture of a program, as they stand on the page."""
    text = program.read_text(encoding="utf-8")
    title, _, about = (ast.get_docstring(ast.parse(text)) or "").partition("\n\n")
    code = text.split('"""', 2)[2].strip()
    picture = f"![{title}](user_code/{program.stem}.png)"
    return f"## {title.removesuffix('.')}\n\n{about}\n\n```python\n{code}\n```\n\n{picture}\n"


def picture(input: Any, output: Any, params: Any) -> None:
    """Figure of a program, with matplotlib's own style. Input: the program."""
    with plt.rc_context():
        runpy.run_path(input[0])["figure"].savefig(output[0], dpi=110)
        plt.close("all")
