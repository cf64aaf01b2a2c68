"""Mesh quality: the scaled Jacobian at the integration points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from r37core.mesh.wedge_mesh import WedgeMesh

from .wedge15 import MASS_RULE, shape_gradients


class MeshQualityError(ValueError):
    """A mesh too distorted to compute with."""


@dataclass(frozen=True)
class MeshQuality:
    """Scaled Jacobian of a mesh: smallest over each element's integration points, shape (elements,); 1 is ideal."""

    per_element: np.ndarray

    @property
    def minimum(self) -> float:
        """Smallest value of the mesh."""
        return float(np.min(self.per_element))

    @property
    def one_percent_quantile(self) -> float:
        """Value that 1% of the elements fall below."""
        return float(np.quantile(self.per_element, 0.01))

    def check(self, allowed_minimum: float) -> None:
        """Raise MeshQualityError when an element lies below `allowed_minimum`."""
        if not self.minimum >= allowed_minimum:
            worst = int(np.argmin(self.per_element))
            raise MeshQualityError(
                f"element {worst + 1} has a scaled Jacobian of {self.minimum:.3g}, below minimum_scaled_jacobian "
                f"({allowed_minimum:g}); use a finer or less layered mesh, blunt edges, or a smoother blade"
            )


def mesh_quality(mesh: WedgeMesh) -> MeshQuality:
    """Scaled Jacobian of every element: determinant over the product of the two longest in-plane edge vectors and the
    through-thickness vector at the point, times 2/sqrt(3), so that an equilateral right prism has 1.
    """
    jacobian = np.einsum("qak,eai->eqki", shape_gradients(MASS_RULE[0]), mesh.points[mesh.elements], optimize=True)
    along_xi, along_eta, along_zeta = (jacobian[:, :, k] for k in range(3))
    edges = np.stack([np.linalg.norm(v, axis=2) for v in (along_xi, along_eta, along_eta - along_xi)])
    longest = np.prod(edges, axis=0) / np.min(edges, axis=0)
    scale = longest * np.linalg.norm(along_zeta, axis=2)
    scaled = 2.0 / np.sqrt(3.0) * np.linalg.det(jacobian) / scale
    return MeshQuality(scaled.min(axis=1))
