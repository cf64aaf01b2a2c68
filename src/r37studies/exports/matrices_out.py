"""A blade's matrices as Matrix Market, in the layout that matrices_in reads."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import pandas as pd
import scipy.io
import scipy.sparse as sp

from r37core.base.io import atomic_write
from r37core.base.speeds import exact_text
from r37core.rom.boundary_table import COLUMNS, TIP_LENGTH
from r37core.rom.reduced_model import ReducedModel


def write_reduced_matrices(model: ReducedModel, speeds: Sequence[float], folder: Path) -> None:
    """Write the reduced M and K_<speed> at `speeds` (rad/s) with boundary.csv; contact nodes come first.

    Of patches the rows of boundary.csv are mean displacements, at the patches' places, and have their lengths of tip.
    """
    content = {"M": model.mass} | {f"K_{exact_text(speed)}": model.stiffness_at(speed) for speed in speeds}
    points = model.contact_nodes.points
    table = boundary_table(points, np.arange(3 * len(points)).reshape(-1, 3)).assign(**{TIP_LENGTH: model.contact_tip_lengths})
    write_matrices(content, table, folder)


def boundary_table(points: np.ndarray, rows: np.ndarray) -> pd.DataFrame:
    """Table boundary.csv of nodes at these `points` (m), shape (nodes, 3), with the `rows` of their displacements."""
    return pd.DataFrame(np.hstack([points, rows]), columns=list(COLUMNS)).astype(dict.fromkeys(COLUMNS[3:], int))


def write_matrices(content: Mapping[str, np.ndarray | sp.csr_array], table: pd.DataFrame, folder: Path) -> None:
    """Write symmetric matrices by name and boundary.csv."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, matrix in content.items():
        with atomic_write(folder / f"{name}.mtx") as partial:
            scipy.io.mmwrite(partial, 0.5 * (matrix + matrix.T), precision=17, symmetry="symmetric")
    with atomic_write(folder / "boundary.csv") as partial:
        table.to_csv(partial, index=False)
