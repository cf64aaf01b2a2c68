"""The reduced model of one blade: small dense matrices, and the parts of the basis that later stages need."""

from dataclasses import dataclass

import numpy as np
import scipy.linalg as la
from numpy import ndarray

from .contact_model import ContactModel
from .craig_bampton import symmetric
from .disc_modes import DiscModes
from .logarithmic_stiffness import LogarithmicStiffness
from .quadratic_terms import QuadraticTerms
from .recovery_nodes import RecoveryNodes, cylinder
from .stress_region import StressRegion


@dataclass(frozen=True, kw_only=True)
class ReducedModel:
    """Reduced matrices and recovery data; coordinates 0 to 3 n_c - 1 are the contact nodes' displacements (x y z of each).

    `stiffness` (N/m), `geometric_stiffness` (per Omega^2), `mass` (kg), and, only when asked for, `spin_softening` (per
    Omega^2): each of shape (coordinates, coordinates). `contact`: what contact acts on (see
    r37core.rom.contact_weights); `contact_nodes`: mean displacements there, with the number of the nearest node of the tip
    line; `contact_chord`: their chord fractions; `contact_tip_lengths` (m): see r37core.rom.contact_weights. `tip_lines`:
    recovery along each tip line; `stress_regions` by name, the first of which decides; `whole_blade` only on request.
    `shape_names`, `shape_products`, shape (shapes, coordinates), and `shape_norms`: mass products of the basis with the ideal
    bending and torsion shapes, by which modes are named. `tolerance`, `singular_values`: of the basis, one for each of its
    columns over all speeds. `rotation_stiffening` (s2/rad2), shape (shapes,): of what rotation does, see r37core.rom.rotation;
    none of a blade whose load is not known. `quadratic_residual`: share of the Omega^4 term in the reduced stiffness at the
    highest speed. `logarithmic_stiffness`, whose matrices its modes at rest project, and `quadratic`: of a blade about its
    equilibrium under rotation; its `geometric_stiffness` is the mean change up to half of the highest speed. `mesh_nodes`: of
    the mesh that it is made of, 0 of matrices. `disc`: modes by nodal diameter, of a blade on a disc.
    """

    stiffness: ndarray
    geometric_stiffness: ndarray
    mass: ndarray
    spin_softening: ndarray | None = None
    contact: str
    contact_nodes: RecoveryNodes
    contact_chord: ndarray
    contact_tip_lengths: ndarray
    tip_lines: dict[str, RecoveryNodes]
    stress_regions: dict[str, StressRegion]
    whole_blade: RecoveryNodes | None = None
    shape_names: tuple[str, ...]
    shape_products: ndarray
    shape_norms: ndarray
    tolerance: float
    singular_values: ndarray
    rotation_stiffening: ndarray
    quadratic_residual: float
    logarithmic_stiffness: LogarithmicStiffness | None = None
    quadratic: QuadraticTerms | None = None
    mesh_nodes: int = 0
    disc: DiscModes | None = None

    @property
    def size(self) -> int:
        """Number of reduced coordinates."""
        return self.mass.shape[0]

    def stiffness_at(self, speed: float) -> ndarray:
        """Stiffness (N/m) at `speed` (rad/s): K0 + Omega^2 K1, or that about the equilibrium there."""
        if self.logarithmic_stiffness is None:
            return self.stiffness + speed**2 * change_per_square(self)
        squares, modes_at_rest = la.eigh(self.stiffness, self.mass)
        squares, modes = self.logarithmic_stiffness.projected(modes_at_rest).spectrum(squares, speed)
        shapes = self.mass @ (modes_at_rest @ modes)
        return symmetric((shapes * squares) @ shapes.T)

    def modes(self, speed: float, count: int | None = None) -> tuple[ndarray, ndarray]:
        """Lowest angular frequencies (rad/s), ascending, and mode shapes, shape (coordinates, modes), at `speed`.

        Shapes are mass-normalised. Frequencies below zero stiffness are given as negative numbers (a blade that buckles under
        rotation).
        """
        squares, shapes = la.eigh(self.stiffness_at(speed), self.mass)
        frequencies = np.sign(squares) * np.sqrt(np.abs(squares))
        return frequencies[:count], shapes[:, :count]


def change_per_square(model: ReducedModel) -> ndarray:
    """Change of the stiffness per squared speed (N/m per rad2/s2): K1, with spin softening if the model has it."""
    return model.geometric_stiffness + (0.0 if model.spin_softening is None else model.spin_softening)


def contact_model(model: ReducedModel, tip_line: str) -> ContactModel:
    """The contact model of a reduced model whose contact nodes lie on `tip_line`."""
    frequencies, modes = model.modes(0.0)
    logarithmic, quadratic = model.logarithmic_stiffness, model.quadratic
    line, nodes = model.tip_lines[tip_line], model.contact_nodes
    ends = line.select([0, -1])
    return ContactModel(
        squared_frequencies=frequencies**2,
        stiffness_per_square=symmetric(modes.T @ change_per_square(model) @ modes),
        logarithmic_stiffness=None if logarithmic is None else logarithmic.projected(modes),
        quadratic=None if quadratic is None else quadratic.projected(modes),
        **_node_fields(nodes, modes),
        tip_lengths=model.contact_tip_lengths,
        tip_cone_angle=line.cone_angle,
        tip_displacement_operator=_cylindrical_parts(ends, ends.basis @ modes),
        to_reduced=modes,
        rotation_stiffening=model.rotation_stiffening,
        **{f"edge_{name}": field for name, field in _node_fields(line, modes).items()},
    )


def _node_fields(nodes: RecoveryNodes, modes: ndarray) -> dict[str, ndarray]:
    """Fields of a contact model for nodes that are moved by `modes`, shape (coordinates, modes)."""
    radius, theta, _ = cylinder(nodes.points)
    return {
        "displacement_operator": _cylindrical_parts(nodes, nodes.basis @ modes),
        "radius": radius,
        "theta": theta,
        "rotation_shapes": _cylindrical_parts(nodes, nodes.rotation_shapes),
    }


def _cylindrical_parts(nodes: RecoveryNodes, fields: ndarray) -> ndarray:
    """Radial, tangential and axial parts, shape (3, nodes, fields), of displacements (x, y, z), shape (nodes, 3, fields)."""
    return nodes.cylindrical(np.moveaxis(fields, 2, 0)).transpose(2, 1, 0)
