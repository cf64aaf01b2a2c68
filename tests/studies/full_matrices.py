"""Matrices of all nodes, as another program has them."""

import numpy as np

from r37studies.exports.matrices_out import boundary_table, write_matrices


def write_full_matrices(matrices, named, speeds, folder):
    """M and K_<speed> at `speeds` (rad/s), and the `named` nodes (RecoveryNodes) as boundary.csv."""
    stiffness, per_square = matrices.stiffness(), matrices.geometric_stiffness()
    content = {"M": matrices.mass()} | {f"K_{speed:g}": stiffness + speed**2 * per_square for speed in speeds}
    rows = 3 * np.searchsorted(matrices.free_nodes, named.nodes)[:, None] + np.arange(3)
    write_matrices(content, boundary_table(named.points, rows), folder)
