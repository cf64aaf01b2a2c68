"""Region of a blade whose stress is recovered from the reduced coordinates, and the nodes of it that are looked at."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from r37core.fem.material import Material
from r37core.fem.stress import nodal_stress
from r37core.mesh.blade_mesh import BladeMesh

from .deviatoric import deviatoric
from .recovery_nodes import RecoveryNodes
from .region_choice import RegionChoice

_MOST_NODES = 500
"""Nodes of a region above which stress is recovered at the candidates alone."""

_MOST_MODES, _DRAWS, _AT_ONCE, _SEED = 32, 2000, 50, 0


@dataclass(frozen=True)
class StressRegion:
    """Elements of a region, shape (elements, nodes of the type) by type, which index the `nodes`.

    `evaluated`: those of the nodes where stress is recovered, by their place; `places`, shape (evaluated, 3): chord, span and
    thickness there, as BladeMesh has them. `description`, `highest_frequency` (Hz): see RegionChoice.
    """

    description: str
    highest_frequency: float
    nodes: RecoveryNodes
    elements: dict[str, np.ndarray]
    evaluated: np.ndarray
    places: np.ndarray


@dataclass(frozen=True)
class RegionMaker:
    """Makes regions of a `mesh`.

    `recovery`: what moves nodes of these numbers; `material`: of the blade; `frequencies` (Hz) and `modes`, shape (coordinates,
    modes), at rest; `contact_nodes`: mesh nodes that contact acts on.
    """

    mesh: BladeMesh
    recovery: Callable[[np.ndarray], RecoveryNodes]
    material: Material
    frequencies: np.ndarray
    modes: np.ndarray
    contact_nodes: np.ndarray

    def regions(self, choices: Mapping[str, RegionChoice]) -> dict[str, StressRegion]:
        """The regions by name."""
        every_mode: dict[RegionChoice, np.ndarray] = {}
        made = {}
        for name, choice in choices.items():
            elements = choice.elements(self.mesh, self.contact_nodes)
            nodes = _nodes_of(elements)
            if len(nodes) > _MOST_NODES:
                where = replace(choice, highest_frequency=np.inf)
                if where not in every_mode:
                    every_mode[where] = self._stress_of_modes(elements, nodes)
                nodes = nodes[self._candidates(every_mode[where], choice.highest_frequency)]
            made[name] = self._region(choice, elements, nodes)
        return made

    def _region(self, choice: RegionChoice, elements: dict[str, np.ndarray], evaluated: np.ndarray) -> StressRegion:
        """The region with the elements that hold an evaluated node alone: others have no part in its mean."""
        touching = {name: nodes[np.isin(nodes, evaluated).any(axis=1)] for name, nodes in elements.items()}
        kept = {name: nodes for name, nodes in touching.items() if len(nodes)}
        nodes = _nodes_of(kept)
        return StressRegion(
            description=choice.description(),
            highest_frequency=choice.highest_frequency,
            nodes=self.recovery(nodes),
            elements={name: np.searchsorted(nodes, block) for name, block in kept.items()},
            evaluated=np.searchsorted(nodes, evaluated),
            places=self.mesh.parameters[evaluated],
        )

    def _stress_of_modes(self, elements: dict[str, np.ndarray], nodes: np.ndarray) -> np.ndarray:
        """Deviatoric stress of the lowest modes, then of rotation's shapes, shape (5, nodes, fields), float32."""
        moved = self.recovery(nodes)
        fields = np.concatenate([moved.basis @ self.modes[:, :_MOST_MODES], moved.rotation_shapes], axis=2)
        local = {name: np.searchsorted(nodes, block) for name, block in elements.items()}
        return deviatoric(nodal_stress(local, moved.points, fields, self.material))

    def _candidates(self, stress: np.ndarray, highest_frequency: float) -> np.ndarray:
        """Places of the nodes that have the largest stress in some of many motions; stress as above.

        Motions are drawn by chance, so that every mode can be the one that decides.
        """
        modes = min(self.modes.shape[1], _MOST_MODES)
        counts = np.concatenate([self.frequencies[:modes] <= highest_frequency, np.ones(stress.shape[2] - modes, dtype=bool)])
        stress = stress[:, :, counts] / np.sqrt(np.sum(stress[:, :, counts] ** 2, axis=0)).max(axis=0)
        random = np.random.default_rng(_SEED)
        shape = (_DRAWS, stress.shape[2])
        motions = (random.choice([-1.0, 1.0], shape) * np.exp(1.5 * random.standard_normal(shape))).astype(np.float32)
        worst = [
            sum(np.square(part @ some.T) for part in stress).argmax(axis=0)
            for some in np.split(motions, range(_AT_ONCE, _DRAWS, _AT_ONCE))
        ]
        return np.unique(np.concatenate(worst))


def _nodes_of(elements: dict[str, np.ndarray]) -> np.ndarray:
    """Numbers of the nodes of elements, ascending."""
    return np.unique(np.concatenate([np.empty(0, int), *(nodes.ravel() for nodes in elements.values())]))
