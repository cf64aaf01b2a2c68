"""Matrices of another program as a reduced model: the second way in, from a directory of files.

`M.mtx` and `K_<speed>.mtx` at rest and at two speeds in rad/s, full or already reduced, the root clamped, as Matrix
Market. `boundary.csv`: the contact nodes from the leading to the trailing edge, with
columns x, y, z (file's unit and axes) and dof_x, dof_y, dof_z: rows of the matrices, from 0. A column tip_length (file's unit)
may follow: the length of tip, along the casing's meridian, that a node stands for. For contact on patches the table has the
nodes of the tip line, from which the patches are made.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
import scipy.linalg as la
import scipy.sparse as sp

from r37core.base.io import TextFileError, read_text
from r37core.base.units import MASS_UNITS, STIFFNESS_UNITS
from r37core.blade.profile import BladeShapeError
from r37core.blade.profile_tables import number_rows
from r37core.fem.solver import Solve, factorise
from r37core.rom.boundary_table import COLUMNS, TIP_LENGTH
from r37core.rom.contact_weights import TipContact, contact_along, tip_lengths
from r37core.rom.craig_bampton import StateAtSpeed, combine_columns, constraint_and_fixed_modes, multi_speed_basis, projected
from r37core.rom.naming import NAMED_MODES
from r37core.rom.recovery_nodes import RecoveryNodes
from r37core.rom.reduced_model import ReducedModel
from r37core.rom.reduction_choice import POINTS, BoundaryChoice, ReductionChoice
from r37imports.placement import contact_nodes_to_blade
from r37imports.refusal import ImportRefused, blamed, warn_of

from .files import matrix_files
from .matrix_file import read_matrix
from .source import MatricesSource
from .tip import arc_length, check_order, check_sense_of_nodes, fractions_along

_REDUCED_UP_TO = 500  # coordinates beside those of the contact nodes: matrices that small are taken as they are
_FEWEST = 20  # rows: the Campbell diagram follows some more modes than it shows
_RIGID = 1e-15
_LINEAR = 1e-6
_FASTEST = 1e6  # rad/s, as in the configuration
_APART = (0.1, 0.99)  # the middle speed over the highest: between them rounding stays small in the fit
_REACH = 20.0  # how far beyond the highest speed of the files the fit may be used


@dataclass(frozen=True)
class _InputMatrices:
    """Mass (kg), stiffness at rest (N/m) and its change per squared speed, and the nodes, in the blade's frame.

    `tip_lengths` (m), shape (nodes,): lengths of tip that the nodes stand for, where the table has them.
    """

    mass: sp.csr_array
    stiffness: sp.csr_array
    per_square: sp.csr_array
    residual: float
    points: np.ndarray
    tip_lengths: np.ndarray | None

    @cached_property
    def solve_at_rest(self) -> Solve:
        """Displacements (m) under forces (N); factorised at the first call. ImportRefused where nothing holds the blade."""
        try:
            return factorise(self.stiffness)
        except RuntimeError:
            raise _not_held(0.0) from None

    def states(self, speeds: Iterable[float]) -> Iterator[StateAtSpeed]:
        """The blade at the speeds (rad/s), one after another."""
        for speed in speeds:
            stiffness = sp.csr_array(self.stiffness + speed**2 * self.per_square)
            yield StateAtSpeed(speed, stiffness, factorise(stiffness) if speed else self.solve_at_rest)


def import_matrices(
    source: MatricesSource, boundary: BoundaryChoice, reduction: ReductionChoice, folder: Path | str = "."
) -> ReducedModel:
    """The reduced model of the matrices: as they are if small, else reduced as `reduction` says.

    With contact on points the contact nodes are those of the table; patches, as many as `boundary` says, are made of them.
    Raises ImportRefused for files that do not fit together, matrices that are not symmetric, and a stiffness that is not
    linear in the squared speed; BoundaryError for patches that the table has too few nodes for. Spin softening must be in the
    stiffness already.
    """
    files = matrix_files(source.folder, Path(folder))
    with blamed("matrices", source.folder):
        matrices = _read(files, source, max(reduction.speeds))
        model = _reduced(matrices, boundary, reduction)
        check_frequency(model, arc_length(matrices.points)[-1])
        return model


def _reduced(matrices: _InputMatrices, boundary: BoundaryChoice, reduction: ReductionChoice) -> ReducedModel:
    contact = _contact(matrices, boundary)
    rows = matrices.mass.shape[0]
    coordinates = sp.csr_array(sp.kron(contact.weights, sp.eye_array(3)))
    coordinates.resize((coordinates.shape[0], rows))
    if rows <= 3 * len(matrices.points) + _REDUCED_UP_TO:
        vectors = np.eye(rows)
        if boundary.contact != POINTS:
            # other coordinates for the same motions
            whole = matrices.stiffness, matrices.mass, coordinates
            constraint, _ = constraint_and_fixed_modes(*whole, 0, matrices.solve_at_rest)
            vectors, _ = combine_columns(constraint, vectors, matrices.mass, coordinates, 0.0)
        tolerance, singular = 0.0, np.ones(rows)
    else:
        tolerance, states = reduction.basis_tolerance, matrices.states(reduction.speeds)
        vectors, singular = multi_speed_basis(states, matrices.mass, coordinates, reduction)
    mass, stiffness = projected(matrices.mass, vectors), projected(matrices.stiffness, vectors)
    _check_positive(mass, stiffness)
    shapes = _ideal_shapes(matrices)
    nodes = np.arange(len(matrices.points))
    size = vectors.shape[1]
    line = RecoveryNodes(nodes, matrices.points, vectors[: 3 * len(nodes)].reshape(-1, 3, size), np.empty((len(nodes), 3, 0)))
    return ReducedModel(
        stiffness=stiffness,
        geometric_stiffness=projected(matrices.per_square, vectors),
        mass=mass,
        contact=boundary.contact,
        contact_nodes=contact.nodes(line),
        contact_chord=contact.mean_chord,
        contact_tip_lengths=contact.lengths,
        tip_lines={boundary.tip_line: line},
        stress_regions={},
        shape_names=tuple(shapes),
        shape_products=np.array([shape @ (matrices.mass @ vectors) for shape in shapes.values()]),
        shape_norms=np.array([np.sqrt(shape @ (matrices.mass @ shape)) for shape in shapes.values()]),
        tolerance=tolerance,
        singular_values=singular,
        rotation_stiffening=np.empty(0),
        quadratic_residual=matrices.residual,
    )


def _contact(matrices: _InputMatrices, boundary: BoundaryChoice) -> TipContact:
    """Contact nodes on the line of the table; points are its nodes, with its lengths of tip where it has some."""
    points, chord = matrices.points, fractions_along(matrices.points)
    if boundary.contact == POINTS:
        lengths = tip_lengths(points, chord, chord) if matrices.tip_lengths is None else matrices.tip_lengths
        return TipContact(np.arange(len(points)), chord, sp.csr_array(sp.eye_array(len(points))), lengths)
    return contact_along(points, chord, boundary)


def _check_positive(mass: np.ndarray, stiffness: np.ndarray) -> None:
    lowest = np.linalg.eigvalsh(mass)[0]
    if not lowest > 0.0:
        raise ImportRefused(f"the mass is not positive (lowest eigenvalue {lowest:.3g} kg); leave no massless rows")
    squares = la.eigvalsh(stiffness, mass)
    if not squares[0] > _RIGID * squares[-1]:
        raise _not_held(squares[0])


def _not_held(square: float) -> ImportRefused:
    return ImportRefused(
        f"the stiffness at rest is not positive (lowest squared frequency {square:.3g} rad2/s2); clamp the "
        "root: leave out its rows and columns"
    )


def _read(files: Mapping[str, Path], source: MatricesSource, fastest: float) -> _InputMatrices:
    """Content of the files; `fastest`: the highest speed (rad/s) that the stiffness is needed at."""
    orientation = source.orientation
    nodes, dofs, lengths = _boundary(files["boundary"])
    with blamed("matrices", files["boundary"].name):
        points = contact_nodes_to_blade(orientation, nodes)
        check_order(points)
        if source.sense_check:
            check_sense_of_nodes(points)
    speeds = sorted((_speed(name, file), name) for name, file in files.items() if name.startswith("K_"))
    _check_speeds([speed for speed, _ in speeds], fastest)
    mass, *stiffness = (read_matrix(files[name]) for name in ("M", *(name for _, name in speeds)))
    size = mass.shape[0]
    if any(matrix.shape != (size, size) for matrix in stiffness):
        raise ImportRefused(f"the matrices differ in size: {', '.join(str(m.shape[0]) for m in (mass, *stiffness))}")
    if size < _FEWEST:
        raise ImportRefused(f"found matrices of {size} rows; allowed: {_FEWEST} or more")
    if len(np.unique(dofs)) != len(dofs) or dofs.min() < 0 or dofs.max() >= size:
        raise ImportRefused(f"boundary.csv: the columns dof_... must name {len(dofs)} different rows from 0 to {size - 1}")
    rest, per_square, residual = _fitted(np.array([speed for speed, _ in speeds]), stiffness)
    turn = _boundary_first(size, dofs, orientation.rows)
    mass, rest, per_square = (sp.csr_array(turn.T @ matrix @ turn) for matrix in (mass, rest, per_square))
    kilograms, newtons = MASS_UNITS[source.mass_unit], STIFFNESS_UNITS[source.stiffness_unit]
    if lengths is not None:
        lengths = orientation.metres_per_unit * lengths
    return _InputMatrices(kilograms * mass, newtons * rest, newtons * per_square, residual, points, lengths)


def _speed(name: str, file: Path) -> float:
    try:
        speed = float(name.removeprefix("K_"))
    except ValueError:
        speed = np.nan
    if not 0.0 <= speed <= _FASTEST:
        raise ImportRefused(f"{file.name}: found a name without a speed; allowed: K_<speed> in rad/s, from 0 to {_FASTEST:g}")
    return speed


def _check_speeds(speeds: list[float], fastest: float) -> None:
    """ImportRefused for speeds (rad/s), ascending, that do not determine the change of the stiffness."""
    rest, middle, top = speeds
    if rest != 0.0 or not _APART[0] * top <= middle <= _APART[1] * top:
        raise ImportRefused(
            f"found K_<speed> at {', '.join(f'{speed:.9g}' for speed in speeds)} rad/s; allowed: at 0 and two others, the "
            f"lower one {_APART[0]:g} to {_APART[1]:g} times the higher one"
        )
    if _REACH * top < fastest:
        raise ImportRefused(
            f"found K_<speed> up to {top:g} rad/s, for a blade that is needed up to {fastest:g} rad/s; allowed: a highest "
            f"speed of {fastest / _REACH:g} or more"
        )


def _boundary(file: Path) -> tuple[np.ndarray, np.ndarray, np.ndarray | None]:
    """Positions of the contact nodes, shape (nodes, 3), the rows of their displacements, shape (3 nodes,), and tip lengths."""
    try:
        rows = number_rows(read_text(file))
    except (OSError, TextFileError, BladeShapeError) as error:
        raise ImportRefused(f"{file.name}: {error}") from None
    if not rows or tuple(rows[0]) not in (COLUMNS, (*COLUMNS, TIP_LENGTH)):
        content = f"columns {', '.join(rows[0])}" if rows else "no contact nodes"
        raise ImportRefused(
            f"{file.name}: found {content}; allowed: a row for each, with {', '.join(COLUMNS)}, and {TIP_LENGTH} or none "
            "behind them"
        )
    numbers = np.array([[*row.values()] for row in rows])
    places, rows_of_nodes, lengths = numbers[:, :3], numbers[:, 3:6], numbers[:, 6:].ravel()
    if (wrong := (rows_of_nodes % 1.0 != 0.0).any(axis=1) | (numbers[:, 6:] <= 0.0).any(axis=1)).any():
        raise ImportRefused(
            f"{file.name}: contact node {np.argmax(wrong) + 1} must have three whole numbers of rows and, in a column "
            f"{TIP_LENGTH}, a length above 0"
        )
    if len(np.unique(places, axis=0)) < len(places):
        raise ImportRefused(f"{file.name}: two contact nodes lie at the same place")
    return places, rows_of_nodes.astype(np.int64).ravel(), lengths if len(lengths) else None


def _fitted(speeds: np.ndarray, stiffness: list[sp.csr_array]) -> tuple[sp.csr_array, sp.csr_array, float]:
    """K0 and K1 of K = K0 + s K1 + s^2 K2 with s the squared speed, and the size of the last term at the highest speed."""
    squares = speeds**2
    rest = stiffness[0]
    middle, top = ((k - rest) / square for k, square in zip(stiffness[1:], squares[1:], strict=True))
    quadratic = (top - middle) / (squares[2] - squares[1])
    residual = float(abs(quadratic).max() * squares[2] ** 2 / abs(rest).max())
    if not residual <= _LINEAR:
        raise ImportRefused(
            f"the stiffness is not linear in the squared speed (the next term has {residual:.2g} of its size, "
            f"allowed {_LINEAR:g}); give stiffnesses about one static state, of the linear theory, to twelve digits"
        )
    return rest, top, residual


def _boundary_first(size: int, dofs: np.ndarray, rows: np.ndarray) -> sp.csr_array:
    """Old coordinates from new ones: the boundary's first and turned to the blade's frame, the others behind."""
    others = np.setdiff1d(np.arange(size), dofs)
    permutation = sp.eye_array(size, format="csr")[:, np.concatenate([dofs, others])]
    turns = sp.block_diag([*([rows.T] * (len(dofs) // 3)), sp.eye_array(len(others))])
    return sp.csr_array(permutation @ turns)


def _ideal_shapes(matrices: _InputMatrices) -> dict[str, np.ndarray]:
    """Shapes to name modes by, without a mesh: static answers to the tip moved along its normal, and turned.

    What the first has beyond a further static step (inverse stiffness times mass), orthogonal to it, is the second bending.
    """
    tangent = matrices.points[-1] - matrices.points[0] if len(matrices.points) > 1 else [0.0, 0.0, 1.0]
    radial = matrices.points.mean(axis=0) * [1.0, 1.0, 0.0]
    normal = np.cross(tangent, radial)
    normal /= np.linalg.norm(normal)
    chord = fractions_along(matrices.points)
    boundary = 3 * len(chord)
    bending, torsion = (np.outer(share, normal).ravel() for share in (np.ones(len(chord)), chord - 0.5))
    if len(chord) == 1:
        torsion = np.cross(normal, radial / np.linalg.norm(radial))
    inner, coupling = matrices.stiffness[boundary:, boundary:], matrices.stiffness[boundary:, :boundary]
    solve = factorise(inner) if inner.shape[0] else lambda load: load
    first, twist = (np.concatenate([part, -solve(coupling @ part)]) for part in (bending, torsion))
    load = matrices.mass @ first
    smooth = matrices.solve_at_rest(load)
    second = first - smooth * (smooth @ load) / (smooth @ (matrices.mass @ smooth))
    return dict(zip(NAMED_MODES, (smooth, twist, second), strict=True))


_USUAL = (2.0, 500.0)
"""First frequency times the chord of the tip (m/s).

A cantilever of length L and thickness h has about h c / 6 L**2 (c: speed of sound in a bar, 5000 m/s): from 2 m/s, of a thin
blade of fifteen chords, to 500 m/s, of a thick one of half a chord.
"""

_FARTHEST = 100.0
"""So many times less or more no blade has."""


def wording(model: ReducedModel) -> str:
    """The first frequency, for who imports matrices to see."""
    return f"the first frequency at rest is {_first_frequency(model):.4g} Hz"


def check_frequency(model: ReducedModel, chord: float) -> None:
    """Raise ImportRefused for a first frequency that no blade with this `chord` of its tip (m) has, warn of an unusual one.

    One contact node has no chord, and is not judged.
    """
    (low, high), product = _USUAL, chord * _first_frequency(model)
    if not chord > 0.0 or low <= product <= high:
        return
    text = (
        f"{wording(model)}, with a tip of {1e3 * chord:.3g} mm; blades of that size have {low / chord:.2g} to "
        f"{high / chord:.2g} Hz: look at mass_unit, stiffness_unit and length_unit"
    )
    if not low / _FARTHEST <= product <= high * _FARTHEST:
        raise ImportRefused(text)
    warn_of(text)


def _first_frequency(model: ReducedModel) -> float:
    """First natural frequency at rest (Hz)."""
    return float(model.modes(0.0, 1)[0][0]) / (2.0 * np.pi)
