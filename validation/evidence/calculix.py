"""Displacements of a mesh by CalculiX, an independent program: the project's deck with other steps than its own."""

import shutil
import subprocess
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from r37core.base.io import InputFileError
from r37core.fem.abaqus_deck import write_abaqus
from r37core.fem.material import Material
from r37core.mesh.blade_mesh import BladeMesh


def displacements(mesh: BladeMesh, material: Material, steps: Sequence[str]) -> np.ndarray:
    """Displacements (m) of nodes in the order in which they are printed, shape (rows, 3).

    `steps`: lines after the model. Raises InputFileError where CalculiX is not installed, CalledProcessError where it fails.
    """
    if not shutil.which("ccx"):
        raise InputFileError("ccx: not found; this table needs CalculiX (on Debian: apt-get install calculix-ccx)")
    with TemporaryDirectory() as folder:
        deck = Path(folder) / "mesh.inp"
        write_abaqus(mesh, deck, material, "blade")
        model = deck.read_text(encoding="ascii").split("*STEP\n")[0]
        deck.write_text(model + "\n".join([*steps, ""]), encoding="ascii")
        subprocess.run(["ccx", "mesh"], cwd=folder, check=True, capture_output=True)
        return printed(deck.with_suffix(".dat").read_text(encoding="ascii"))


def printed(text: str) -> np.ndarray:
    """Rows of a node and three numbers in what CalculiX prints: the numbers, shape (rows, 3)."""
    rows = [line.split() for line in text.splitlines()]
    return np.array([row[1:] for row in rows if len(row) == 4 and row[0].isdigit()], dtype=float)
