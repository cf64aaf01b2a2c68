"""How a user says where the root and the tip of an imported blade are: a set of the file, or a rule."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from r37core.exchange.refusal import ImportRefused
from r37core.fem.surface import Faces, faces_within

from .raw_mesh import RawMesh


@dataclass(frozen=True)
class Where:
    """A part of the surface: all faces whose nodes are in the set `set_name` or keep all the limits given.

    `limits`: (coordinate, bound, value in m) with coordinate r, x or z of the blade's frame and bound `at_least` or
    `at_most`; `cone_zr`: two points (z, r) in m of a straight meridian that the faces lie on; `tolerance` (m): of limits and
    cone.
    """

    set_name: str | None = None
    limits: tuple[tuple[str, str, float], ...] = ()
    cone_zr: tuple[tuple[float, float], tuple[float, float]] | None = None
    tolerance: float = field(kw_only=True)

    def faces(self, what: str, mesh: RawMesh, surface: list[Faces]) -> list[Faces]:
        """Faces of `surface`, the outer faces of `mesh`; ImportRefused, naming `what` is looked for, where there are none."""
        members = self._members(what, mesh)
        found = faces_within(surface, members)
        if not found:
            inside = "" if self.set_name is None else f" of set '{self.set_name}', which has {members.sum()} nodes,"
            raise ImportRefused(
                f"{what}: no outer face has all its nodes within {self.describe()}{inside and ';'}{inside} give another set "
                "or rule, or a wider tolerance_m"
            )
        return found

    def describe(self) -> str:
        """The rule in words."""
        if self.set_name is not None:
            return f"the set '{self.set_name}'"
        parts = [f"{name} {bound.replace('_', ' ')} {value:g} m" for name, bound, value in self.limits]
        if self.cone_zr is not None:
            parts.append("the cone through (z, r) = ({:g}, {:g}) and ({:g}, {:g}) m".format(*self.cone_zr[0], *self.cone_zr[1]))
        return f"{' and '.join(parts)}, to {self.tolerance:g} m"

    def _members(self, what: str, mesh: RawMesh) -> np.ndarray:
        """Mask over the nodes."""
        if self.set_name is not None:
            names = {name.upper(): name for name in mesh.sets}
            if self.set_name.upper() not in names:
                known = ", ".join(sorted(mesh.sets)) or "none"
                raise ImportRefused(f"{what}: found no set '{self.set_name}'; the file has: {known}")
            members = np.zeros(len(mesh.points), dtype=bool)
            members[mesh.sets[names[self.set_name.upper()]]] = True
            return members
        x, y, z = mesh.points.T
        coordinates = {"r": np.hypot(x, y), "x": x, "z": z}
        members = np.ones(len(mesh.points), dtype=bool)
        for name, bound, value in self.limits:
            sign = 1.0 if bound == "at_least" else -1.0
            members &= sign * (coordinates[name] - value) >= -self.tolerance
        if self.cone_zr is not None:
            (z0, r0), (z1, r1) = self.cone_zr
            length = np.hypot(z1 - z0, r1 - r0)
            off = ((coordinates["r"] - r0) * (z1 - z0) - (z - z0) * (r1 - r0)) / length
            members &= np.abs(off) <= self.tolerance
        return members
