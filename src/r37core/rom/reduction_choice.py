"""Choices of a reduced model: its contact nodes and its reduction. Light: the configuration imports it."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from typing import Annotated, Self

import numpy as np
from numpy import ndarray

from r37core.base.declared import Key
from r37core.mesh.blade_mesh import TIP_LINES

from .quadratic_terms import MOST_QUADRATIC_MODES


class BoundaryError(ValueError):
    """Boundary nodes that the mesh does not have."""


POINTS, PATCHES = "points", "patches"
"""Kinds of contact nodes: nodes of the mesh, or patches of the tip line."""

EVEN, COSINE = "even", "cosine"
"""Spacings of the contact nodes along the chord: equal distances, or smaller ones towards the leading and trailing edge."""

USUAL_POINTS, MOST_USUAL_PATCHES = 8, 12
"""Numbers of contact nodes where none is chosen: of points, and of patches the most, as a coarse tip has room for fewer."""


@dataclass(frozen=True)
class BoundaryChoice:
    """Positions of the contact nodes.

    With corners, node i of n lies at s = i/(n-1) of the chord; without, at s = (i + 1/2)/n. With a cosine `spacing` that is at
    (1 - cos(pi s))/2. `contact`: POINTS or PATCHES; see r37core.rom.contact_weights. A spacing of None is
    even of points and cosine of patches, for between the middle of an end patch and the blade's corner nothing holds the edge,
    so end patches are short; None `nodes` are as many as usual, of patches as many as a tip has room for: see `on`.
    """

    tip_line: Annotated[str, Key("Tip line of the contact nodes", one_of=TIP_LINES)] = "pressure_edge"
    nodes: Annotated[
        int | None, Key("Number of contact nodes; by default 8 points, or 12 patches, fewer on a coarse mesh", ge=1, le=200)
    ] = None
    corners: Annotated[bool, Key("Whether the leading and trailing corners are among them")] = True
    contact: str = field(kw_only=True)
    spacing: Annotated[
        str | None, Key("Spacing along the chord; by default cosine on patches, even on points", one_of=(EVEN, COSINE))
    ] = None

    @property
    def most_nodes(self) -> int:
        """Number of contact nodes; where none is chosen that of a fine mesh."""
        return self.nodes or (USUAL_POINTS if self.contact == POINTS else MOST_USUAL_PATCHES)

    @property
    def is_even(self) -> bool:
        """True where the contact nodes have equal distances."""
        return self.contact == POINTS if self.spacing is None else self.spacing == EVEN

    def on(self, chord: ndarray) -> Self:
        """The choice with a number of contact nodes, on a tip with nodes at fractions `chord` of its line."""
        if self.nodes is not None or self.contact == POINTS:
            return replace(self, nodes=self.most_nodes)
        counts = range(self.most_nodes, 0, -1)
        return replace(self, nodes=next((count for count in counts if _resolves(self, count, chord)), self.most_nodes))

    def chord_positions(self, count: int) -> ndarray:
        """Wanted fractions of the chord of so many contact nodes, from the leading to the trailing edge."""
        even = np.linspace(0.0, 1.0, count) if self.corners and count > 1 else (np.arange(count) + 0.5) / count
        if self.is_even:
            return even
        # the ends and the middle are exact
        return np.where(even == 0.5, 0.5, 0.5 - 0.5 * np.cos(np.pi * even))


def contact_positions(choice: BoundaryChoice, chord: ndarray, place: str) -> ndarray:
    """Wanted fractions of the chord of the contact nodes, from leading to trailing edge, on nodes at fractions `chord`.

    Raises BoundaryError where the nodes nearest to two points are the same, and unless one of the nodes lies between any two
    patches; `place`: what they are nodes of.
    """
    wanted = choice.on(chord).most_nodes
    positions = choice.chord_positions(wanted)
    if choice.contact == POINTS:
        nearest = np.abs(chord - positions[:, None]).argmin(axis=1) if len(chord) else np.empty(0, dtype=int)
        if len(np.unique(nearest)) == wanted:
            return positions
        raise BoundaryError(
            f"{wanted} boundary nodes do not fit on the {len(chord)} {place}; ask for fewer, {_even_instead(choice)}or raise "
            "tip_elements (for the camber line also: an odd number of layers, or an even one with nodes at mid-thickness) in "
            "the fidelity level; of an imported mesh, refine the tip"
        )
    if _resolves(choice, wanted, chord):
        return positions
    most = max((count for count in range(1, wanted) if _resolves(choice, count, chord)), default=0)
    reason = "because between two patches there must be a node" if most else "because a patch is made of two or more"
    raise BoundaryError(
        f"found {wanted} contact patches on the {len(chord)} {place}; allowed: {f'at most {most}' if most else 'none'} "
        f"(structure.boundary.nodes), {reason}; or contact: points, {_even_instead(choice)}or a finer tip"
    )


@contextmanager
def boundary_located(location: str) -> Iterator[None]:
    """Put in front of a BoundaryError where what contact acts on is chosen, as `file:line: key`."""
    try:
        yield
    except BoundaryError as error:
        raise BoundaryError(f"{location}: {error}") from None


def _even_instead(choice: BoundaryChoice) -> str:
    """A remedy where contact nodes are too close at the edges, for a message; empty where they are even."""
    return "" if choice.is_even else f"spacing: {EVEN}, "


def _resolves(choice: BoundaryChoice, count: int, chord: ndarray) -> bool:
    """True where there are two nodes for each patch, one of them between it and the next."""
    positions = choice.chord_positions(count)
    following = np.searchsorted(positions, chord)
    near_position = np.isclose(chord[:, None], positions).any(axis=1)
    between = np.unique(following[~near_position & (following > 0) & (following < count)])
    return len(chord) >= max(2 * count - 1, 2) and len(between) == count - 1


LINEAR, ROTATING, QUADRATIC = ("linear", "rotating", "quadratic")
"""Displacements: small ones of the undeformed blade; small ones about the equilibrium of large displacements under rotation;
and with terms of second order about that equilibrium."""


@dataclass(frozen=True)
class ReductionChoice:
    """Choices of a reduction: its basis at `speeds` (rad/s), and the terms of rotation and large displacements."""

    speeds: tuple[float, ...]
    fixed_interface_modes: Annotated[
        int, Key("Number of modes at each of three speeds: rest, half the maximum and the maximum", ge=0, le=500)
    ]
    basis_tolerance: Annotated[float, Key("Relative singular value below which a column is removed", ge=0, lt=1)] = 1e-8
    kinematics: str = LINEAR
    quadratic_modes: Annotated[
        int, Key("Number of modes with displacements of second order, from the lowest on", ge=1, le=MOST_QUADRATIC_MODES)
    ] = 4
    spin_softening: Annotated[bool, Key("Whether centrifugal forces follow the motion, which lowers the stiffness")] = False
    recover_whole_blade: Annotated[bool, Key("Whether the basis is kept on every node (a large file)")] = False
