"""Shapes that move: modes and the worst instants of interactions, their files, and one page of each blade."""

from pathlib import Path

from r37core.explorer import FOLDER as EXPLORER

FOLDER = Path(__file__).parent

PARTS = (FOLDER / "shapes.html", EXPLORER / "explorer.css", FOLDER / "shapes.js")
"""What the page of a blade is put together from, beside its data and plotly: page, style, program."""
