"""Runs examples/figures/*.py and writes docs/user_code.md: each figure with the lines that draw it.

Run: make claims ONLY=user_code.
"""

import ast
import runpy
from pathlib import Path

import matplotlib.pyplot as plt

from r37core.io import write_text

ROOT = Path(__file__).parents[2]
FILES = sorted((ROOT / "examples/figures").glob("*.py"))

HEAD = """# Figures and their code

Each figure takes about ten lines: calls of [r37](python.md), and matplotlib. The programs are in `examples/figures`. They run at level `draft`; the first run of a
blade takes longest.
"""


def page():
    """The page, without its pictures."""
    return "\n".join([HEAD, *map(_part, FILES)])


def _part(file):
    text = file.read_text(encoding="utf-8")
    title, _, about = ast.get_docstring(ast.parse(text)).partition("\n\n")
    code = text.split('"""', 2)[2].strip()
    picture = f"![{title}](user_code/{file.stem}.png)"
    return f"## {title.removesuffix('.')}\n\n{about}\n\n```python\n{code}\n```\n\n{picture}\n"


def draw(file):
    """The picture of one program."""
    with plt.rc_context():
        figure = runpy.run_path(str(file))["figure"]
        folder = ROOT / "docs/user_code"
        folder.mkdir(exist_ok=True)
        figure.savefig(folder / f"{file.stem}.png", dpi=110)
        plt.close("all")


if __name__ == "__main__":
    for file in FILES:
        draw(file)
    write_text(page(), ROOT / "docs/user_code.md")
