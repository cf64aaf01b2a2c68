"""What the page with a blade's shapes shows: its .glb files and what they say."""

from __future__ import annotations

import base64
from collections.abc import Mapping
from pathlib import Path

from r37core.io import read_json, readable

from .moving import INDEX


def shapes_contents(folders: Mapping[str, Path]) -> list[dict[str, object]]:
    """All shapes of the folders, by the scene whose interactions they are of ("" for modes); files lie beside the page.

    Raises InputFileError for a file that cannot be read.
    """
    found = []
    for scene, folder in folders.items():
        for entry in read_json(folder / INDEX):
            file = folder / f"{entry['shape']}.glb"
            with readable(file):
                glb = base64.b64encode(file.read_bytes()).decode()
            here = f"{folder.parent.name}/{folder.name}"
            data = "modes_0" if not scene else entry["shape"]
            files = [f"{here}/{file.name}", f"{here}/{data}.vtu"]
            found.append({**entry, "name": f"{folder.name}/{entry['shape']}", "scene": scene, "files": files, "glb": glb})
    return found
