"""A blade's matrices as Matrix Market, in the layout that matrices_in reads."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import pandas as pd
import scipy.io
import scipy.sparse as sp

from r37core.base.io import atomic_write
from r37core.base.speeds import exact_text
from r37core.fem.matrices import StructuralMatrices
from r37core.rom.boundary_table import COLUMNS, TIP_LENGTH
from r37core.rom.recovery_nodes import RecoveryNodes
from r37core.rom.reduced_model import ReducedModel
from r37core.rom.reduction_choice import POINTS


def write_reduced_matrices(model: ReducedModel, speeds: Sequence[float], folder: Path) -> None:
    """Write the reduced M and K_<speed> at `speeds` (rad/s) with boundary.csv; contact nodes come first.

    Of patches the rows of boundary.csv are mean displacements, at the patches' places, and have their lengths of tip.
    """
    content = {"M": model.mass} | {f"K_{exact_text(speed)}": model.stiffness_at(speed) for speed in speeds}
    points = model.contact_nodes.points
    table = _table(points, np.arange(3 * len(points)).reshape(-1, 3)).assign(**{TIP_LENGTH: model.contact_tip_lengths})
    _write(content, table, folder)


def table_nodes(model: ReducedModel, tip_line: str) -> RecoveryNodes:
    """Nodes that boundary.csv of the full matrices names: the contact nodes, of patches all nodes of `tip_line`."""
    return model.contact_nodes if model.contact == POINTS else model.tip_lines[tip_line]


def write_full_matrices(
    matrices: StructuralMatrices, model: ReducedModel, tip_line: str, speeds: Sequence[float], folder: Path
) -> None:
    """Write the full M and K_<speed> at `speeds` (rad/s) with boundary.csv, which names `table_nodes` of the model.

    Rows are x y z of the unclamped nodes, in m and the blade's frame; with geometric stiffness and, where the reduced model
    has it, spin softening.
    """
    stiffness, per_square = matrices.stiffness(), matrices.geometric_stiffness()
    if model.spin_softening is not None:
        per_square = sp.csr_array(per_square + matrices.spin_softening())
    content = {"M": matrices.mass()} | {f"K_{exact_text(speed)}": stiffness + speed**2 * per_square for speed in speeds}
    named = table_nodes(model, tip_line)
    rows = 3 * np.searchsorted(matrices.free_nodes, named.nodes)[:, None] + np.arange(3)
    _write(content, _table(named.points, rows), folder)


def _table(points: np.ndarray, rows: np.ndarray) -> pd.DataFrame:
    return pd.DataFrame(np.hstack([points, rows]), columns=list(COLUMNS)).astype(dict.fromkeys(COLUMNS[3:], int))


def _write(content: Mapping[str, np.ndarray | sp.csr_array], table: pd.DataFrame, folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    for name, matrix in content.items():
        with atomic_write(folder / f"{name}.mtx") as partial:
            scipy.io.mmwrite(partial, 0.5 * (matrix + matrix.T), precision=17, symmetry="symmetric")
    with atomic_write(folder / "boundary.csv") as partial:
        table.to_csv(partial, index=False)
