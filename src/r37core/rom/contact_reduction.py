"""Turning a reduced model into the contact model of the simulations."""

from __future__ import annotations

import numpy as np

from .contact_model import ContactModel
from .reduced_model import RecoveryNodes, ReducedModel


def contact_model(model: ReducedModel, tip_line: str) -> ContactModel:
    """The contact model of a reduced model whose boundary nodes lie on `tip_line`.

    Raises ValueError for a model with a Coriolis matrix, which the modal time integration cannot carry.
    """
    if model.coriolis is not None:
        raise ValueError("simulations cannot carry the Coriolis matrix yet; set structure.coriolis to false in config.yaml")
    frequencies, modes = model.modes(0.0)
    per_square = modes.T @ model.stiffness_per_square @ modes
    line, nodes = model.tip_lines[tip_line], model.contact_nodes(tip_line)
    return ContactModel(
        squared_frequencies=frequencies**2,
        stiffness_per_square=0.5 * (per_square + per_square.T),
        displacement_operator=_cylindrical_operator(nodes, modes),
        radius=np.hypot(nodes.points[:, 0], nodes.points[:, 1]),
        theta=np.arctan2(nodes.points[:, 1], nodes.points[:, 0]),
        tip_cone_angle=line.cone_angle,
        tip_displacement_operator=_cylindrical_operator(line.select([0, -1]), modes),
        to_reduced=modes,
    )


def _cylindrical_operator(nodes: RecoveryNodes, modes: np.ndarray) -> np.ndarray:
    """Radial, tangential and axial displacement per mode, shape (3, nodes, modes)."""
    per_mode = np.moveaxis(nodes.basis @ modes, 2, 0)
    return nodes.cylindrical(per_mode).transpose(2, 1, 0)
