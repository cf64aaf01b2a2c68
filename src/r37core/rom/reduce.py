"""Building the reduced model of a blade from its mesh and matrices."""

import numpy as np
import scipy.linalg as la
import scipy.sparse as sp

from r37core.fem.material import Material
from r37core.fem.matrices import StructuralMatrices
from r37core.mesh.blade_mesh import TIP_LINES, BladeMesh

from .contact_weights import contact_weights, mean_positions, tip_lengths
from .craig_bampton import multi_speed_basis, symmetric
from .linear_blade import LinearBlade
from .naming import ideal_shapes
from .recovery_nodes import RecoveryNodes
from .reduced_model import ReducedModel
from .reduction_choice import LINEAR, ReductionChoice
from .rotating_blade import RotatingBlade
from .stress_region import RegionMaker


def reduce_blade(mesh: BladeMesh, matrices: StructuralMatrices, choice: ReductionChoice, material: Material) -> ReducedModel:
    """Project the blade's matrices on a Craig-Bampton basis over several speeds.

    `material`: of which the matrices are. Raises BoundaryError for too few tip nodes, and NoEquilibriumError.
    """
    mass = matrices.mass()
    weights = contact_weights(mesh, choice.boundary)
    boundary = sp.csr_array(sp.kron(weights[:, matrices.free_nodes], sp.eye_array(3)))
    is_linear = choice.kinematics == LINEAR
    blade = LinearBlade(matrices, choice) if is_linear else RotatingBlade(mesh, matrices, material, choice)
    vectors, singular_values = multi_speed_basis(blade.states(), mass, boundary, choice, blade.derivatives)
    rotation_shapes, rotation_stiffening = blade.shapes_of_rotation()

    def whole_field(free_field: np.ndarray) -> np.ndarray:
        """The columns over the unclamped degrees of freedom as displacements of all nodes, shape (nodes, 3, columns)."""
        whole = np.zeros((len(mesh.points), 3, free_field.shape[1]))
        whole[matrices.free_nodes] = free_field.reshape(-1, 3, free_field.shape[1])
        return whole

    whole, rotated = whole_field(vectors), whole_field(rotation_shapes)

    def recovery(nodes: np.ndarray) -> RecoveryNodes:
        return RecoveryNodes(nodes, mesh.points[nodes], whole[nodes], rotated[nodes])

    line, chord = mesh.node_set(TIP_LINES[choice.boundary.tip_line]), mesh.parameters[:, 0]
    shapes = {name: shape[matrices.free_nodes].ravel() for name, shape in ideal_shapes(mesh).items()}
    mass_times_vectors, stiffness = mass @ vectors, blade.stiffness_terms(vectors)
    reduced_mass = symmetric(vectors.T @ mass_times_vectors)
    squares, modes = la.eigh(stiffness["stiffness"], reduced_mass)
    maker = RegionMaker(mesh, recovery, material, np.sqrt(squares) / (2.0 * np.pi), modes, weights.indices)
    return ReducedModel(
        **stiffness,
        mass=reduced_mass,
        coriolis=vectors.T @ (matrices.coriolis() @ vectors) if choice.coriolis else None,
        contact=choice.boundary.contact,
        contact_nodes=contact_nodes(weights, line, chord, RecoveryNodes(np.arange(len(chord)), mesh.points, whole, rotated)),
        contact_chord=weights @ chord,
        contact_tip_lengths=tip_lengths(mesh.points[line], chord[line], choice.boundary.chord_positions(weights.shape[0])),
        tip_lines={line: recovery(mesh.node_set(name)) for line, name in TIP_LINES.items()},
        stress_regions=maker.regions(choice.stress_regions),
        whole_blade=recovery(np.arange(len(mesh.points))) if choice.recover_whole_blade else None,
        shape_names=tuple(shapes),
        shape_products=np.array([shape @ mass_times_vectors for shape in shapes.values()]),
        shape_norms=np.array([np.sqrt(shape @ (mass @ shape)) for shape in shapes.values()]),
        tolerance=choice.basis_tolerance,
        singular_values=singular_values,
        rotation_stiffening=rotation_stiffening,
    )


def contact_nodes(weights: sp.csr_array, line: np.ndarray, chord: np.ndarray, every: RecoveryNodes) -> RecoveryNodes:
    """The contact nodes as means of `every` node, each with the number of the nearest node of the tip's `line`.

    `weights`: as contact_weights has them; `chord`: fraction of the chord of every node.
    """
    nearest = np.abs(chord[line] - (weights @ chord)[:, None]).argmin(axis=1)
    fields = (mean_fields(weights, nodes) for nodes in (every.basis, every.rotation_shapes))
    return RecoveryNodes(every.nodes[line[nearest]], mean_positions(every.points, weights), *fields)


def mean_fields(weights: sp.csr_array, fields: np.ndarray) -> np.ndarray:
    """Fields at the contact nodes, shape (contact nodes, 3, columns), from those at all nodes, shape (nodes, 3, columns)."""
    nodes, axes, columns = fields.shape
    return (weights @ fields.reshape(nodes, axes * columns)).reshape(weights.shape[0], axes, columns)
