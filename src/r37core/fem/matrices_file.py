"""matrices.npz: the finite-element matrices of one blade."""

from __future__ import annotations

from dataclasses import asdict, fields
from pathlib import Path

import numpy as np

from r37core.io import atomic_write, readable

from .matrices import StructuralMatrices


def write_matrices(matrices: StructuralMatrices, file: Path | str) -> None:
    """Write the matrices, one array per field of StructuralMatrices, uncompressed."""
    with atomic_write(file) as partial:
        np.savez(partial, **asdict(matrices))


def read_matrices(file: Path | str) -> StructuralMatrices:
    """The matrices of a file; InputFileError when it cannot be read."""
    with readable(file), np.load(file) as stored:
        return StructuralMatrices(**{field.name: stored[field.name] for field in fields(StructuralMatrices)})
