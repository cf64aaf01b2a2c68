"""Stress on the submesh, recovered from reduced coordinates."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from r37core.fem.material import Material
from r37core.fem.stress import stress_at
from r37core.fem.wedge15 import NODES, physical_gradients
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
        submesh, elements = model.stress_submesh, model.stress_elements
        if len(elements) == 0:
            raise ValueError(
                "the stress submesh has no elements; enlarge structure.stress_submesh in config.yaml or use a finer mesh"
            )
        gradients, _ = physical_gradients(submesh.points[elements], NODES)
        count = np.bincount(elements.ravel(), minlength=len(submesh.nodes))
        self.operator = np.zeros((6, len(submesh.nodes), model.size))
        for j in range(model.size):
            stress = stress_at(gradients, submesh.basis[elements, :, j], material)
            for component, (a, b) in enumerate(_COMPONENTS):
                summed = np.bincount(elements.ravel(), weights=stress[:, :, a, b].ravel(), minlength=len(count))
                self.operator[component, :, j] = summed / count

    def max_von_mises(self, coordinates: np.ndarray) -> np.ndarray:
        """Largest von Mises stress (Pa) over the submesh, shape (instants,), for coordinates, shape (instants, coordinates)."""
        xx, yy, zz, xy, yz, zx = np.einsum("cnj,tj->ctn", self.operator, coordinates, optimize=True)
        normal = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2
        von_mises = np.sqrt(0.5 * normal + 3.0 * (xy**2 + yz**2 + zx**2))
        return von_mises.max(axis=1)


def largest_of_run(run: Mapping[str, np.ndarray], recovery: StressRecovery, stress_instants: int) -> float:
    """Largest von Mises stress (Pa) in the last revolution of a run with so many snapshots in each; NaN if it diverged."""
    return float("nan") if run["status"] else float(recovery.max_von_mises(run["snapshots"][-stress_instants:]).max())
