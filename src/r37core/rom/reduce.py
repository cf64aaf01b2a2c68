"""Building the reduced model of a blade from its mesh and matrices."""

import numpy as np
import scipy.linalg as la
import scipy.sparse as sp

from r37core.fem.material import Material
from r37core.fem.matrices import StructuralMatrices
from r37core.mesh.blade_mesh import TIP_LINES, BladeMesh

from .contact_weights import contact_weights, mean_positions, tip_lengths
from .craig_bampton import multi_speed_basis
from .naming import ideal_shapes
from .recovery_nodes import RecoveryNodes
from .reduced_model import ReducedModel
from .reduction_choice import ReductionChoice
from .rotation import shapes_of_rotation
from .stress_region import RegionMaker


def reduce_blade(mesh: BladeMesh, matrices: StructuralMatrices, choice: ReductionChoice, material: Material) -> ReducedModel:
    """Project the blade's matrices on a Craig-Bampton basis over several speeds; BoundaryError for too few tip nodes.

    `material`: of which the matrices are, for the nodes where stress is looked for.
    """
    stiffness, geometric, mass = matrices.stiffness(), matrices.geometric_stiffness(), matrices.mass()
    softening = matrices.spin_softening() if choice.spin_softening else None
    per_square = geometric if softening is None else geometric + softening
    weights = contact_weights(mesh, choice.boundary)
    boundary = sp.csr_array(sp.kron(weights[:, matrices.free_nodes], sp.eye_array(3)))
    load = matrices.centrifugal_load[matrices.free_nodes].ravel()
    vectors, singular_values, displaced = multi_speed_basis(
        lambda speed: sp.csr_array(stiffness + speed**2 * per_square), mass, boundary, choice, matrices.solve_at_rest, load
    )
    rotation_shapes, rotation_stiffening = shapes_of_rotation(stiffness, per_square, displaced, load)

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
    mass_times_vectors, static = mass @ vectors, projected(stiffness, vectors)
    reduced_mass = _symmetric(vectors.T @ mass_times_vectors)
    squares, modes = la.eigh(static, reduced_mass)
    maker = RegionMaker(mesh, recovery, material, np.sqrt(squares) / (2.0 * np.pi), modes, weights.indices)
    return ReducedModel(
        stiffness=static,
        geometric_stiffness=projected(geometric, vectors),
        mass=reduced_mass,
        spin_softening=None if softening is None else projected(softening, vectors),
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
        quadratic_residual=_quadratic_residual(stiffness, per_square, vectors, static, max(choice.speeds)),
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


def projected(matrix: sp.csr_array, vectors: np.ndarray) -> np.ndarray:
    """A symmetric matrix in the coordinates of the basis `vectors`, symmetric to the bit."""
    return _symmetric(vectors.T @ (matrix @ vectors))


def _symmetric(matrix: np.ndarray) -> np.ndarray:
    return 0.5 * (matrix + matrix.T)


def _quadratic_residual(
    stiffness: sp.csr_array, per_square: sp.csr_array, vectors: np.ndarray, static: np.ndarray, highest: float
) -> float:
    """Largest entry of the Omega^4 term (at the highest speed) of the reduced stiffness, over that of the stiffness.

    The term is fitted through the stiffness reduced at three speeds, `static` among them; the linear theory makes it zero.
    """
    if highest == 0.0:
        return 0.0
    middle, top = (projected(sp.csr_array(stiffness + (share * highest) ** 2 * per_square), vectors) for share in (0.5, 1.0))
    # with s = (Omega / highest)^2: K(1/4), K(1) give K2 = (16 K(1/4) - 4 K(1) - 12 K(0)) / -3
    quadratic = (16.0 * middle - 4.0 * top - 12.0 * static) / -3.0
    return float(np.max(np.abs(quadratic)) / np.max(np.abs(static)))
