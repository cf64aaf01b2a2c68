"""Stress on the submesh, recovered from reduced coordinates."""

from __future__ import annotations

import numpy as np

from r37core.fem.assembly import typed_blocks
from r37core.fem.material import Material
from r37core.fem.stress import stress_at
from r37core.rom.reduced_model import ReducedModel

_COMPONENTS = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))


class StressRecovery:
    """Stress of the vibration at the nodes of the stress submesh; the static stress of rotation is not part of it.

    Each element's linear stress is evaluated at its own nodes, where bending stress is largest, and averaged over the
    submesh elements that share the node. `operator`, shape (6, nodes, coordinates): components xx yy zz xy yz zx (Pa) per
    unit of each reduced coordinate.

    Raises ValueError when the submesh has no elements.
    """

    def __init__(self, model: ReducedModel, material: Material):
        submesh, blocks = model.stress_submesh, model.stress_elements
        if not blocks:
            raise ValueError(
                "the stress submesh has no elements; enlarge structure.stress_submesh in config.yaml or use a finer mesh"
            )
        self.operator = np.zeros((6, len(submesh.nodes), model.size))
        count = np.zeros(len(submesh.nodes))
        for name, element, coordinates in typed_blocks(blocks, submesh.points):
            members = blocks[name].ravel()
            count += np.bincount(members, minlength=len(count))
            gradients, _ = element.physical_gradients(coordinates, element.nodes)
            for j in range(model.size):
                stress = stress_at(gradients, submesh.basis[blocks[name], :, j], material)
                for component, (a, b) in enumerate(_COMPONENTS):
                    weights = stress[:, :, a, b].ravel()
                    self.operator[component, :, j] += np.bincount(members, weights=weights, minlength=len(count))
        self.operator /= count[:, None]

    def max_von_mises(self, coordinates: np.ndarray) -> np.ndarray:
        """Largest von Mises stress (Pa) over the submesh, shape (instants,), for coordinates, shape (instants, coordinates)."""
        xx, yy, zz, xy, yz, zx = np.einsum("cnj,tj->ctn", self.operator, coordinates, optimize=True)
        normal = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2
        von_mises = np.sqrt(0.5 * normal + 3.0 * (xy**2 + yz**2 + zx**2))
        return von_mises.max(axis=1)
