"""Region of a blade whose stress is recovered from the reduced coordinates, and the points of it that are looked at."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from r37core.fem.material import Material
from r37core.fem.stress import interpolated, recovered_stress, stress_numbers
from r37core.mesh.blade_mesh import BladeMesh

from .deviatoric import deviatoric
from .recovery_nodes import RecoveryNodes
from .region_choice import RegionChoice

_MOST_POINTS = 500
"""Points of a region above which stress is recovered at the candidates alone."""

_MOST_MODES, _DRAWS, _AT_ONCE, _SEED = 32, 2000, 50, 0


@dataclass(frozen=True)
class StressRegion:
    """Elements of a region, shape (elements, nodes of the type) by type, which index the `nodes`.

    `evaluated`: where stress is recovered, as stress_numbers numbers the elements' nodes or integration points; `places`, shape
    (evaluated, 3): chord, span and thickness there, as BladeMesh has them. `description`, `highest_frequency` (Hz),
    `integration_points`: see RegionChoice.
    """

    description: str
    highest_frequency: float
    nodes: RecoveryNodes
    elements: dict[str, np.ndarray]
    evaluated: np.ndarray
    places: np.ndarray
    integration_points: bool

    @property
    def points(self) -> np.ndarray:
        """Coordinates (m) of the evaluated points, shape (evaluated, 3)."""
        return interpolated(self.elements, self.nodes.points, self.integration_points)[self.evaluated]


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
            evaluated = _occurring(stress_numbers(elements, choice.integration_points))
            if len(evaluated) > _MOST_POINTS:
                where = replace(choice, highest_frequency=np.inf)
                if where not in every_mode:
                    # of the lowest modes, then of rotation's shapes
                    nodes = _occurring(elements)
                    moved = self.recovery(nodes)
                    fields = np.concatenate([moved.basis @ self.modes[:, :_MOST_MODES], moved.rotation_shapes], axis=2)
                    local = {name: np.searchsorted(nodes, block) for name, block in elements.items()}
                    stress = recovered_stress(local, moved.points, fields, self.material, choice.integration_points)
                    every_mode[where] = deviatoric(stress)
                evaluated = evaluated[self._candidates(every_mode[where], choice.highest_frequency)]
            made[name] = self._region(choice, elements, evaluated)
        return made

    def _region(self, choice: RegionChoice, elements: dict[str, np.ndarray], evaluated: np.ndarray) -> StressRegion:
        """The region with the elements that hold an evaluated point alone: others have no part in its mean."""
        inside = choice.integration_points
        numbers = stress_numbers(elements, inside)
        touching = {name: np.isin(numbers[name], evaluated).any(axis=1) for name in elements}
        kept = {name: elements[name][touched] for name, touched in touching.items() if touched.any()}
        nodes, places = _occurring(kept), interpolated(elements, self.mesh.parameters, inside)
        return StressRegion(
            description=choice.description(),
            highest_frequency=choice.highest_frequency,
            nodes=self.recovery(nodes),
            elements={name: np.searchsorted(nodes, block) for name, block in kept.items()},
            evaluated=np.searchsorted(_occurring({name: numbers[name][touching[name]] for name in kept}), evaluated),
            places=places[evaluated],
            integration_points=inside,
        )

    def _candidates(self, stress: np.ndarray, highest_frequency: float) -> np.ndarray:
        """Places of the points that have the largest stress in some of many motions.

        `stress`, shape (5, points, fields), float32: deviatoric, of the lowest modes, then of rotation's shapes.

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


def _occurring(numbers: Mapping[str, np.ndarray]) -> np.ndarray:
    """Numbers that occur, of nodes or points by element type, ascending."""
    return np.unique(np.concatenate([np.empty(0, int), *(part.ravel() for part in numbers.values())]))
