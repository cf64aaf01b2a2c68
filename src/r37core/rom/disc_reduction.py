"""Reduced model of one blade in contact on a disc of equal sectors, from one sector's mesh.

All nodal diameters n have a basis: the lowest modes at rest, their first change with the squared speed, and the static
displacement by each force on the contact nodes. A force on sector 0 alone is the sum of forces of all n over the number of
sectors N, and a wave of n moves all sectors: with modes u of unit mass in one sector, sector 0 moves by Re(u z) sqrt(2/N), by
u z sqrt(1/N) of n = 0 and N/2, and real and imaginary part of z are coordinates of unit mass of the whole disc. In these the
matrices are blocks of each n. A Craig-Bampton step over all of them keeps the lowest modes of each n, and the constraint modes
of the contact nodes of sector 0: the static flexibility of its tip is complete. Motion of other sectors is carried, without
contact. Source of the waves: D. L. Thomas, Int. J. Numer. Meth. Eng. 14 (1979) 81-102.
"""

from typing import Any, NamedTuple

import numpy as np
import scipy.linalg as la
import scipy.sparse as sp
from numpy import ndarray
from scipy.sparse import csr_array

from r37core.fem.matrices import StructuralMatrices
from r37core.fem.sector import Sector
from r37core.fem.solver import Solve, factorise, lowest_modes

from .craig_bampton import combine_columns, symmetric
from .disc_modes import DiscModes
from .reduction_choice import LINEAR, ReductionChoice
from .rotation import shapes_of_rotation

_INDEPENDENT = 1e-12
"""Eigenvalue of the scaled mass of a nodal diameter's columns below which they depend on each other."""

_CHANGED = 1e-3
"""Part of a mode, as its norm, that is another at another speed: less counts for nothing, as its square in a frequency."""


class DiscReduction(NamedTuple):
    """Basis of sector 0, shape (unclamped dofs, coordinates), with its singular values, and fields of the reduced model."""

    vectors: ndarray
    singular_values: ndarray
    rotation_shapes: ndarray
    fields: dict[str, Any]


class _Wave(NamedTuple):
    """Modes at rest of a nodal diameter: squared frequencies, change per squared speed, and shapes of one sector's dofs."""

    squares: ndarray
    per_square: ndarray
    shapes: ndarray


def reduce_disc(
    sector: Sector, matrices: StructuralMatrices, contact: csr_array, reduction: ReductionChoice, ideal: ndarray
) -> DiscReduction:
    """Reduce a disc, of whose `sector` these are the `matrices`.

    `contact`, shape (contact coordinates, unclamped dofs); `ideal`, shape (shapes, unclamped dofs): ideal shapes of a blade.
    """
    if reduction.kinematics != LINEAR:
        raise ValueError(f"kinematics {reduction.kinematics} on a disc; allowed: {LINEAR}")
    stiffness, mass, per_square = matrices.stiffness(), matrices.mass(), matrices.geometric_stiffness()
    if reduction.spin_softening:
        per_square = csr_array(per_square + matrices.spin_softening())
    cyclic = [sector.matrix(part) for part in (stiffness, mass, per_square)]
    waves = []
    for number in sector.nodal_diameters:
        phase = sector.phase(number)
        solve = cyclic[0].solver(phase)
        waves.append(_wave([part.at(phase) for part in cyclic], solve, sector.expansion(phase), contact, reduction))
    # coordinates of unit mass of the whole disc, nodal diameter by nodal diameter
    moved = np.hstack([_moved(wave.shapes, sector.sectors) for wave in waves])
    squares = np.concatenate([np.tile(wave.squares, _parts(wave)) for wave in waves])
    change = la.block_diag(*(_real(wave.per_square) for wave in waves))
    boundary = contact @ moved
    flexibility = boundary.T / squares[:, None]
    constraint = la.solve(boundary @ flexibility, flexibility.T, assume_a="pos").T
    kept = la.block_diag(*(_real(_kept(wave, reduction)) for wave in waves))
    columns, identity = np.hstack([constraint, kept]), sp.eye_array(len(squares), format="csr")
    basis, singular = combine_columns(constraint, columns, identity, csr_array(boundary), reduction.basis_tolerance)
    rotation_shapes, stiffening = _rotation(sector, stiffness, per_square, matrices.free_load, reduction.speeds)
    reduced_mass, first = symmetric(basis.T @ basis), len(squares) - len(waves[-1].squares) * _parts(waves[-1])
    fields = {
        "stiffness": symmetric(basis.T @ (squares[:, None] * basis)),
        "geometric_stiffness": symmetric(basis.T @ change @ basis),
        "mass": reduced_mass,
        "quadratic_residual": 0.0,
        "rotation_stiffening": stiffening,
        "disc": _disc_modes(waves, mass, ideal, la.solve(reduced_mass, basis[first:].T), sector.sectors),
    }
    return DiscReduction(moved @ basis, singular, rotation_shapes, fields)


def _wave(terms: list[csr_array], solve: Solve, expansion: csr_array, contact: csr_array, reduction: ReductionChoice) -> _Wave:
    """Modes of one nodal diameter from its stiffness, with what solves with it, mass and change of the stiffness per square."""
    stiffness, mass, per_square = terms
    _, lowest = lowest_modes(stiffness, mass, reduction.fixed_interface_modes, solve)
    static = solve((contact @ expansion).toarray().conj().T)
    columns = np.hstack([lowest, solve(per_square @ lowest), static])
    columns = columns / np.sqrt(np.einsum("ij,ij->j", columns.conj(), mass @ columns).real)
    sizes, vectors = la.eigh(columns.conj().T @ (mass @ columns))
    large = sizes > _INDEPENDENT * sizes[-1]
    columns = columns @ (vectors[:, large] / np.sqrt(sizes[large]))
    squares, modes = la.eigh(columns.conj().T @ (stiffness @ columns), columns.conj().T @ (mass @ columns))
    shapes = columns @ modes
    return _Wave(squares, shapes.conj().T @ (per_square @ shapes), expansion @ shapes)


def _kept(wave: _Wave, reduction: ReductionChoice) -> ndarray:
    """The lowest modes at the speeds of the basis, in the modes at rest, without what they have in common."""
    speed_vectors = [
        la.eigh(np.diag(wave.squares) + speed**2 * wave.per_square)[1][:, : reduction.fixed_interface_modes]
        for speed in reduction.speeds
    ]
    left, singular_values, _ = la.svd(np.hstack(speed_vectors), full_matrices=False)
    return left[:, singular_values > _CHANGED]


def _parts(wave: _Wave) -> int:
    """How many coordinates an amplitude has: 1 of the waves that stand, 2 of those that turn both ways."""
    return 2 if np.iscomplexobj(wave.shapes) else 1


def _real(matrix: ndarray) -> ndarray:
    """A matrix between amplitudes, between their real and imaginary parts."""
    return np.block([[matrix.real, -matrix.imag], [matrix.imag, matrix.real]]) if np.iscomplexobj(matrix) else matrix


def _moved(shapes: ndarray, sectors: int) -> ndarray:
    """Displacement of sector 0 by each coordinate."""
    if not np.iscomplexobj(shapes):
        return shapes / np.sqrt(sectors)
    return np.hstack([shapes.real, -shapes.imag]) * np.sqrt(2.0 / sectors)


def _rotation(
    sector: Sector, stiffness: csr_array, per_square: csr_array, load: ndarray, speeds: tuple[float, ...]
) -> tuple[ndarray, ndarray]:
    """Shapes and stiffening of rotation, in which all sectors move alike: see r37core.rom.rotation."""
    expansion = sector.expansion(1.0 + 0.0j)
    rest, change = (sector.matrix(part).at(1.0 + 0.0j) for part in (stiffness, per_square))
    pull = expansion.T @ load
    displaced = [factorise(csr_array(rest + speed**2 * change))(pull) for speed in speeds]
    shapes, stiffening = shapes_of_rotation(rest, change, np.stack(displaced, axis=1), pull)
    return expansion @ shapes, stiffening


def _disc_modes(waves: list[_Wave], mass: csr_array, ideal: ndarray, highest: ndarray, sectors: int) -> DiscModes:
    """The waves as a reduced model keeps them, all with as many modes as the one with the fewest."""
    count = min(len(wave.squares) for wave in waves)
    units = [
        shapes / np.sqrt(np.einsum("ij,ij->j", shapes.conj(), mass @ shapes).real)
        for shapes in (wave.shapes[:, :count] for wave in waves)
    ]
    last = mass @ units[-1]
    return DiscModes(
        squared_frequencies=np.array([wave.squares[:count] for wave in waves]),
        stiffness_per_square=_halves(np.array([wave.per_square[:count, :count] for wave in waves])),
        likeness=_halves(np.array([unit.conj().T @ last for unit in units])),
        shape_products=_halves(ideal @ last),
        highest_modes=highest[:, :count],
        sectors=float(sectors),
    )


def _halves(values: ndarray) -> ndarray:
    """Real and imaginary parts, shape (2, ...)."""
    return np.stack([values.real, np.imag(values)])
