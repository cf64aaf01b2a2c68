"""Turning a reduced model into the contact model of the simulations."""

from __future__ import annotations

import numpy as np

from .contact_model import ContactModel
from .reduced_model import RecoveryNodes, ReducedModel


def contact_model(model: ReducedModel, tip_line: str) -> ContactModel:
    """The contact model of a reduced model whose boundary nodes lie on `tip_line`.

    Raises ValueError for a model with a Coriolis matrix, which the modal march cannot carry.
    """
    if model.coriolis is not None:
        raise ValueError("simulations cannot carry the Coriolis matrix yet; set structure.coriolis to false in config.yaml")
    frequencies, modes = model.modes(0.0)
    per_square = modes.T @ model.stiffness_per_square @ modes
    line = model.tip_lines[tip_line]
    numbers = [int(np.flatnonzero(line.nodes == node)[0]) for node in model.boundary_nodes]
    nodes = line.select(numbers)
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line.points, axis=0), axis=1))])
    first, last, gaps = along[numbers[0]], along[numbers[-1]], len(numbers) - 1
    spacing = (last - first) / gaps if gaps else along[-1]
    return ContactModel(
        squared_frequencies=frequencies**2,
        stiffness_per_square=0.5 * (per_square + per_square.T),
        rows=_cylindrical_rows(nodes, modes).transpose(1, 0, 2),
        radius=np.hypot(nodes.points[:, 0], nodes.points[:, 1]),
        theta=np.arctan2(nodes.points[:, 1], nodes.points[:, 0]),
        chord_share=float(spacing),
        tip_rows=_cylindrical_rows(line.select([0, -1]), modes),
        to_reduced=modes,
    )


def _cylindrical_rows(nodes: RecoveryNodes, modes: np.ndarray) -> np.ndarray:
    """Radial, tangential and axial displacement per mode, shape (nodes, 3, modes)."""
    per_mode = np.moveaxis(nodes.basis @ modes, 2, 0)
    return np.moveaxis(nodes.cylindrical(per_mode), 0, 2)
