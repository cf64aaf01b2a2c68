"""Mesh quality: the scaled Jacobian at the integration points."""

from itertools import combinations

import numpy as np
from numpy import ndarray

from r37core.blade.definition import SMALLER_CHANGES
from r37core.mesh.blade_mesh import BladeMesh

from .assembly import typed_blocks
from .elements import Element


class MeshQualityError(ValueError):
    """A mesh too distorted to compute with."""


def mesh_quality(mesh: BladeMesh) -> ndarray:
    """Scaled Jacobian of every element, block after block, shape (elements,): smallest over its points; 1 is ideal."""
    parts = typed_blocks(mesh.blocks, mesh.points)
    return np.concatenate([scaled_jacobian(element, coordinates) for _, element, coordinates in parts])


def check_quality(mesh: BladeMesh, quality: ndarray, allowed_minimum: float) -> None:
    """Raise MeshQualityError when an element, of this `quality` by mesh_quality, lies below `allowed_minimum`."""
    if not np.min(quality) >= allowed_minimum:
        worst = int(np.argmin(quality))
        # of the middle of each element
        spans = np.concatenate([mesh.parameters[nodes, 1].mean(axis=1) for nodes in mesh.blocks.values()])
        raise MeshQualityError(
            f"span {100 * spans[worst]:.1f}%: element {worst + 1} has a scaled Jacobian of {quality[worst]:.3g}, below "
            f"minimum_scaled_jacobian ({allowed_minimum:g}); use a finer or less layered mesh, blunt edges, or a smoother "
            f"blade{SMALLER_CHANGES}"
        )


def scaled_jacobian(element: Element, coordinates: ndarray) -> ndarray:
    """Smallest scaled Jacobian over the points of the mass rule, shape (elements,), of nodes (elements, n, 3).

    Determinant over the product of the three longest independent edge vectors at the point, divided by what the ideal
    element (regular tetrahedron, equilateral right prism, cube) has, so that 1 is ideal; negative where it is inside out.
    """
    jacobian = element.jacobian(coordinates, element.mass_rule[0])
    lengths = np.linalg.norm(jacobian @ element.edge_directions.T, axis=2)
    triples = [list(triple) for triple in combinations(range(lengths.shape[2]), 3)]
    independent = [triple for triple in triples if abs(np.linalg.det(element.edge_directions[triple])) > 0.5]
    longest = np.max([np.prod(lengths[:, :, triple], axis=2) for triple in independent], axis=0)
    return (np.linalg.det(jacobian) / longest / element.shape.ideal).min(axis=1)
