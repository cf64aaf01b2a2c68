"""Shapes that move: modes and the worst instants of interactions, their files, and one page of each blade."""

import base64
from collections.abc import Mapping
from pathlib import Path

from r37core.base.io import read_json, readable
from r37core.explorer import FOLDER as EXPLORER

FOLDER = Path(__file__).parent

PARTS = (FOLDER / "shapes.html", EXPLORER / "explorer.css", EXPLORER / "theme.js", FOLDER / "shapes.js")
"""Parts that the page of a blade is put together from, next to its data and plotly: body, style, program."""

INDEX = "shapes.json"
"""Name of the file in each folder of shapes that says what its .glb files show."""


def shapes_contents(folders: Mapping[str, Path], explorer_in_report: str = "") -> dict[str, object]:
    """All shapes of the folders, by the scene whose interactions they are of ("" for modes); files lie beside the page.

    `explorer_in_report`: where the explorer is in the archive of the report.
    Raises InputFileError for a file that cannot be read.
    """
    shapes = []
    for scene, folder in folders.items():
        for entry in read_json(folder / INDEX):
            file = folder / f"{entry['shape']}.glb"
            with readable(file):
                glb = base64.b64encode(file.read_bytes()).decode()
            here = f"{folder.parent.name}/{folder.name}"
            data = "modes_0" if not scene else entry["shape"]
            files = [f"{here}/{file.name}", f"{here}/{data}.vtu"]
            shapes.append({**entry, "name": f"{folder.name}/{entry['shape']}", "scene": scene, "files": files, "glb": glb})
    return {"shapes": shapes, "explorer_in_report": explorer_in_report}
