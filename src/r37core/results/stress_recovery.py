"""Stress on the submesh, recovered from reduced coordinates."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from r37core.fem.material import Material
from r37core.fem.stress import nodal_stress, von_mises
from r37core.rom.reduced_model import ReducedModel

from .measures import last_revolution


class StressRecovery:
    """Stress at the nodes of the stress submesh: of the vibration, and of rotation where the coordinates have it.

    `operator`, shape (6, nodes, coordinates + shapes): components xx yy zz xy yz zx (Pa) per unit of each reduced coordinate,
    then of each amplitude of rotation's shapes, averaged over the submesh elements that share the node. `region`: the submesh
    in words.

    Raises ValueError when the submesh has no elements.
    """

    def __init__(self, model: ReducedModel, material: Material):
        submesh = model.stress_submesh
        if not model.stress_elements:
            raise ValueError(
                "the stress submesh has no elements; enlarge structure.stress_submesh in config.yaml (of an imported mesh, its "
                "own stress_submesh in blades.yaml), or use a finer mesh"
            )
        self.region = model.stress_region
        self._coordinates = submesh.basis.shape[2]
        self.operator = nodal_stress(model.stress_elements, submesh.points, submesh.fields, material)

    def have_rotation(self, coordinates: np.ndarray) -> bool:
        """Whether the coordinates, shape (instants, coordinates), have the amplitudes of rotation's shapes."""
        return coordinates.shape[1] > self._coordinates

    def max_von_mises(self, coordinates: np.ndarray) -> np.ndarray:
        """Largest von Mises stress (Pa) over the submesh, shape (instants,).

        `coordinates`, shape (instants, coordinates), of the vibration alone, or with the amplitudes of rotation's shapes after
        them: then it is the stress of both together.
        """
        operator = self.operator[:, :, : coordinates.shape[1]]
        stress = np.einsum("cnj,tj->ctn", operator, coordinates, optimize=True)
        return von_mises(stress).max(axis=1)

    def of_last_revolution(self, run: Mapping[str, np.ndarray], per_revolution: int) -> np.ndarray:
        """Largest von Mises stress (Pa) at each of a run's snapshots in its last revolution, shape (snapshots,)."""
        return self.max_von_mises(last_revolution(run["snapshots"], per_revolution))
