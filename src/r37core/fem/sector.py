"""Cyclic symmetry: the matrices of one sector of a disc for each nodal diameter.

A disc of N equal sectors moves in waves: in nodal diameter n sector j has the displacement Re(u e^{i n j a}), a = 2 pi/N, in
axes that turn with it. So the high face of a sector moves as its low face, turned by a and multiplied by e^{i n a}: with the
degrees of freedom q without those of the high face u = (E + e^{i n a} H) q, and a symmetric matrix K of the sector becomes

    K_n = own + e^{i n a} coupling + e^{-i n a} coupling^T,  own = E^T K E + H^T K H,  coupling = E^T K H.

Source: D. L. Thomas, Int. J. Numer. Meth. Eng. 14 (1979) 81-102.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np
import scipy.linalg as la
import scipy.sparse as sp
from numpy import ndarray
from scipy.sparse import csr_array

from r37core.mesh.blade_mesh import BladeMesh

from .solver import Solve, factorise


def aliased(order: int, sectors: int) -> int:
    """Nodal diameter of a disc that an engine order excites: the distance to the next multiple of the sectors."""
    return abs((order + sectors // 2) % sectors - sectors // 2)


@dataclass(frozen=True)
class SectorMatrix:
    """A matrix of the sector over all nodal diameters; see the module's formula."""

    own: csr_array
    coupling: csr_array

    def at(self, phase: complex) -> csr_array:
        """The matrix at e^{i n a} = `phase`: Hermitian, and real at a real phase."""
        factor = phase if phase.imag else phase.real
        return csr_array(self.own + factor * self.coupling + np.conj(factor) * self.coupling.T)

    @cached_property
    def _inside(self) -> tuple[ndarray, ndarray, Solve, list[sp.csc_array], ndarray]:
        """Degrees of freedom of the low face, and all others, which no phase changes, with what solves for these.

        Their matrices with the low face, of `own` and of `coupling`, and what these two do to each other through the others.
        """
        face = np.unique(self.coupling.indices)
        others = np.setdiff1d(np.arange(self.own.shape[0]), face)
        solve = factorise(self.own[others][:, others])
        towards = [sp.csc_array(part[others][:, face]) for part in (self.own, self.coupling)]
        both = sp.csc_array(sp.hstack(towards))
        # two columns at once cost least
        parts = [both.T @ solve(both[:, [number, number + 1]].toarray()) for number in range(0, both.shape[1], 2)]
        return face, others, solve, towards, np.hstack([np.empty((len(face) * 2, 0)), *parts])

    def solver(self, phase: complex) -> Solve:
        """Solve with the positive definite matrix at e^{i n a} = `phase`.

        All but the low face is real and the same at all phases: it is factorised once, a tenth of the time of complex factors.
        """
        face, others, solve, (own, coupling), through = self._inside
        factor = phase if phase.imag else phase.real
        towards, phases = own + factor * coupling, np.repeat([1.0, factor], len(face))
        reaction = (np.conj(phases)[:, None] * through * phases).reshape(2, len(face), 2, len(face)).sum(axis=(0, 2))
        held = la.inv(self.at(phase)[face][:, face].toarray() - reaction)

        def inside(load: ndarray) -> ndarray:
            if not np.any(load.imag):
                return solve(np.real(load))
            parts = [solve(np.stack([column.real, column.imag], axis=1)) for column in load.reshape(len(load), -1).T]
            return (np.array(parts) @ [1.0, 1.0j]).T.reshape(load.shape)

        def solved(load: ndarray) -> ndarray:
            moved = np.empty(load.shape, dtype=np.result_type(load, factor))
            free = inside(load[others])
            moved[face] = held @ (load[face] - towards.conj().T @ free)
            moved[others] = free - inside(towards @ moved[face])
            return moved

        return solved


@dataclass(frozen=True)
class Sector:
    """A sector of a disc: its unclamped nodes, shape (nodes,), those of its faces, and how many `sectors` the disc has.

    `pairs`, shape (pairs, 2): a node of the low face and that of the high face which it becomes by a turn of one sector.
    """

    free_nodes: ndarray
    pairs: ndarray
    sectors: int

    @classmethod
    def of(cls, mesh: BladeMesh) -> Self:
        """The sector of a mesh that is one; see `cyclic` of BladeMesh."""
        assert mesh.cyclic is not None
        low, high = mesh.points[mesh.cyclic].transpose(1, 0, 2)
        turned = np.arctan2(low[:, 0] * high[:, 1] - low[:, 1] * high[:, 0], np.sum(low[:, :2] * high[:, :2], axis=1))
        return cls(mesh.free_nodes, mesh.cyclic, round(2.0 * np.pi / float(np.median(turned))))

    @property
    def angle(self) -> float:
        """Angle of a sector (rad)."""
        return 2.0 * np.pi / self.sectors

    @property
    def nodal_diameters(self) -> range:
        """All nodal diameters that the disc has."""
        return range(self.sectors // 2 + 1)

    def phase(self, nodal_diameter: int) -> complex:
        """e^{i n a}, real to the bit where it is 1 or -1."""
        if 2 * nodal_diameter % self.sectors == 0:
            return complex(1.0 if nodal_diameter == 0 else -1.0)
        return complex(np.exp(1j * nodal_diameter * self.angle))

    @cached_property
    def _parts(self) -> tuple[csr_array, csr_array]:
        """E and H, shape (unclamped dofs, unclamped dofs without the high face)."""
        free = self.free_nodes
        low, high = self.pairs[np.isin(self.pairs[:, 1], free)].T
        kept = np.setdiff1d(free, high)
        rows = np.searchsorted(free, kept)
        shape = len(free), len(kept)
        same = csr_array((np.ones(len(kept)), (rows, np.arange(len(kept)))), shape=shape)
        places = np.searchsorted(free, high), np.searchsorted(kept, low)
        turned = csr_array((np.ones(len(high)), places), shape=shape)
        cosine, sine = np.cos(self.angle), np.sin(self.angle)
        turn = np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])
        return csr_array(sp.kron(same, sp.eye_array(3))), csr_array(sp.kron(turned, turn))

    def matrix(self, free: csr_array) -> SectorMatrix:
        """The matrix for each nodal diameter, of one over the unclamped degrees of freedom."""
        same, turned = self._parts
        own = same.T @ free @ same + turned.T @ free @ turned
        return SectorMatrix(csr_array(own), csr_array(same.T @ free @ turned))

    def expansion(self, phase: complex) -> csr_array:
        """E + e^{i n a} H, which gives all unclamped degrees of freedom of the sector."""
        same, turned = self._parts
        return csr_array(same + (phase if phase.imag else phase.real) * turned)

    def displaced(self, stiffness: csr_array, load: ndarray) -> ndarray:
        """Displacement (m) of the unclamped degrees of freedom, shape (dofs,), where all sectors have the same load (N)."""
        expansion = self.expansion(1.0 + 0.0j)
        return expansion @ factorise(self.matrix(stiffness).at(1.0 + 0.0j))(expansion.T @ load)
