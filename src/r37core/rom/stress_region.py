"""Region of a blade whose stress is recovered from the reduced coordinates, and the points of it that are looked at."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy import ndarray

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
    elements: dict[str, ndarray]
    evaluated: ndarray
    places: ndarray
    integration_points: bool

    @property
    def points(self) -> ndarray:
        """Coordinates (m) of the evaluated points, shape (evaluated, 3)."""
        return interpolated(self.elements, self.nodes.points, self.integration_points)[self.evaluated]


def make_regions(
    choices: Mapping[str, RegionChoice],
    mesh: BladeMesh,
    recovery: Callable[[ndarray], RecoveryNodes],
    material: Material,
    frequencies: ndarray,
    modes: ndarray,
    contact_nodes: ndarray,
) -> dict[str, StressRegion]:
    """Regions of a mesh by name.

    `recovery`: what moves nodes of these numbers; `material`: of the blade; `frequencies` (Hz) and `modes`, shape (coordinates,
    modes), at rest; `contact_nodes`: mesh nodes that contact acts on.
    """
    every_mode: dict[RegionChoice, ndarray] = {}
    regions = {}
    for name, choice in choices.items():
        elements, inside = choice.elements(mesh, contact_nodes), choice.integration_points
        numbers = stress_numbers(elements, inside)
        evaluated = _occurring(numbers)
        if len(evaluated) > _MOST_POINTS:
            where = replace(choice, highest_frequency=np.inf)
            if where not in every_mode:
                # of the lowest modes, then of rotation's shapes
                nodes = _occurring(elements)
                moved = recovery(nodes)
                fields = np.concatenate([moved.basis @ modes[:, :_MOST_MODES], moved.rotation_shapes], axis=2)
                local = {kind: np.searchsorted(nodes, block) for kind, block in elements.items()}
                every_mode[where] = deviatoric(recovered_stress(local, moved.points, fields, material, inside))
            counts = np.ones(every_mode[where].shape[2], dtype=bool)
            lowest = frequencies[:_MOST_MODES]
            counts[: len(lowest)] = lowest <= choice.highest_frequency
            evaluated = evaluated[_candidates(every_mode[where][:, :, counts])]
        # elements that hold no evaluated point have no part in its mean
        touching = {kind: np.isin(numbers[kind], evaluated).any(axis=1) for kind in elements}
        kept = {kind: elements[kind][touched] for kind, touched in touching.items() if touched.any()}
        nodes, places = _occurring(kept), interpolated(elements, mesh.parameters, inside)
        regions[name] = StressRegion(
            description=choice.description(),
            highest_frequency=choice.highest_frequency,
            nodes=recovery(nodes),
            elements={kind: np.searchsorted(nodes, block) for kind, block in kept.items()},
            evaluated=np.searchsorted(_occurring({kind: numbers[kind][touching[kind]] for kind in kept}), evaluated),
            places=places[evaluated],
            integration_points=inside,
        )
    return regions


def _candidates(stress: ndarray) -> ndarray:
    """Places of the points that have the largest stress in some of many motions.

    `stress`, shape (5, points, fields), float32: deviatoric, of modes and of rotation's shapes. Motions are drawn by chance, so
    that every one of these can be the one that decides.
    """
    stress = stress / np.sqrt(np.sum(stress**2, axis=0)).max(axis=0)
    random = np.random.default_rng(_SEED)
    shape = (_DRAWS, stress.shape[2])
    motions = (random.choice([-1.0, 1.0], shape) * np.exp(1.5 * random.standard_normal(shape))).astype(np.float32)
    worst = [
        sum(np.square(part @ some.T) for part in stress).argmax(axis=0)
        for some in np.split(motions, range(_AT_ONCE, _DRAWS, _AT_ONCE))
    ]
    return np.unique(np.concatenate(worst))


def _occurring(numbers: Mapping[str, ndarray]) -> ndarray:
    """Numbers that occur, of nodes or points by element type, ascending."""
    return np.unique(np.concatenate([np.empty(0, int), *(part.ravel() for part in numbers.values())]))
