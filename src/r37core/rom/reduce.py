"""Building the reduced model of a blade from its mesh and matrices."""

from collections.abc import Mapping

import numpy as np
import scipy.linalg as la
import scipy.sparse as sp
from numpy import ndarray
from scipy.sparse import csr_array

from r37core.fem.material import Material
from r37core.fem.matrices import StructuralMatrices
from r37core.fem.sector import Sector
from r37core.mesh.blade_mesh import TIP_LINES, BladeMesh

from .contact_weights import tip_contact
from .craig_bampton import multi_speed_basis, symmetric
from .disc_reduction import reduce_disc
from .linear_blade import LinearBlade
from .naming import ideal_shapes
from .recovery_nodes import RecoveryNodes
from .reduced_model import ReducedModel
from .reduction_choice import LINEAR, BoundaryChoice, ReductionChoice
from .region_choice import RegionChoice
from .rotating_blade import RotatingBlade
from .stress_region import make_regions


def reduce_blade(
    mesh: BladeMesh,
    matrices: StructuralMatrices,
    material: Material,
    boundary: BoundaryChoice,
    reduction: ReductionChoice,
    stress_regions: Mapping[str, RegionChoice],
) -> ReducedModel:
    """Project the blade's matrices on a Craig-Bampton basis over several speeds.

    `material`: of which the matrices are. Raises BoundaryError for too few tip nodes, and NoEquilibriumError.
    """
    mass = matrices.mass()
    contact = tip_contact(mesh, boundary)
    coordinates = csr_array(sp.kron(contact.weights[:, matrices.free_nodes], sp.eye_array(3)))
    shapes = {name: matrices.free(shape) for name, shape in ideal_shapes(mesh).items()}
    if mesh.cyclic is None:
        is_linear = reduction.kinematics == LINEAR
        blade = LinearBlade(matrices, reduction) if is_linear else RotatingBlade(mesh, matrices, material, reduction)
        vectors, singular_values = multi_speed_basis(blade.states(), mass, coordinates, reduction, blade.derivatives)
        rotation_shapes, rotation_stiffening = blade.shapes_of_rotation()
        fields = blade.stiffness_terms(vectors) | {"rotation_stiffening": rotation_stiffening}
        fields["mass"] = symmetric(vectors.T @ (mass @ vectors))
        squares, modes = la.eigh(fields["stiffness"], fields["mass"])
    else:
        vectors, singular_values, rotation_shapes, fields = reduce_disc(
            Sector.of(mesh), matrices, coordinates, reduction, np.array(list(shapes.values()))
        )
        squares, modes = fields["disc"].squared_frequencies[-1], fields["disc"].highest_modes
    whole, rotated = matrices.whole(vectors), matrices.whole(rotation_shapes)

    def recovery(nodes: ndarray) -> RecoveryNodes:
        return RecoveryNodes(nodes, mesh.points[nodes], whole[nodes], rotated[nodes])

    mass_times_vectors = mass @ vectors
    at_rest = np.sqrt(squares) / (2.0 * np.pi), modes
    return ReducedModel(
        **fields,
        contact=boundary.contact,
        contact_nodes=contact.nodes(RecoveryNodes(np.arange(len(mesh.points)), mesh.points, whole, rotated)),
        contact_chord=contact.mean_chord,
        contact_tip_lengths=contact.lengths,
        tip_lines={line: recovery(mesh.node_set(name)) for line, name in TIP_LINES.items()},
        stress_regions=make_regions(stress_regions, mesh, recovery, material, *at_rest, contact.weights.indices),
        whole_blade=recovery(np.arange(len(mesh.points))) if reduction.recover_whole_blade else None,
        shape_names=tuple(shapes),
        shape_products=np.array([shape @ mass_times_vectors for shape in shapes.values()]),
        shape_norms=np.array([np.sqrt(shape @ (mass @ shape)) for shape in shapes.values()]),
        tolerance=reduction.basis_tolerance,
        singular_values=singular_values,
        mesh_nodes=len(mesh.points),
    )
