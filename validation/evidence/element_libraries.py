"""Stiffness and mass from our element table, from scikit-fem and from FElupe: time, and whether the numbers agree.

Needs both libraries: pip install scikit-fem felupe.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import felupe
import numpy as np
import scipy.sparse as sp
import skfem
from skfem.models.elasticity import lame_parameters, linear_elasticity

from r37core.fem.assembly import NodePattern, assemble_mass, assemble_stiffness, block_matrix
from r37core.fem.elements import ELEMENTS
from r37core.fem.material import Material
from r37core.mesh.blade_mesh import BladeMesh

from .pages import write_table

sys.path.append(str(Path(__file__).parents[2] / "tests"))

from box_mesh import box_mesh

STEEL = Material(youngs_modulus=180e9, poissons_ratio=0.3, density=8000.0)
COUNTS = {"tetra10": (24, 12, 4), "hexahedron20": (20, 10, 6)}
"""Elements that all three have, and how many along each side of a box."""

REPETITIONS = 3
Matrices = tuple[sp.csr_array, sp.csr_array]


def ours(mesh: BladeMesh, name: str) -> Matrices:
    """Matrices by r37."""
    pattern = NodePattern.build(mesh.blocks, len(mesh.points))
    stiffness = assemble_stiffness(pattern, mesh.blocks, mesh.points, STEEL)
    mass = assemble_mass(pattern, mesh.blocks, mesh.points, STEEL.density)
    blocks = mass[:, None, None] * np.eye(3)
    return tuple(block_matrix(pattern.indptr, pattern.indices, part) for part in (stiffness, blocks))


def scikit_fem(mesh: BladeMesh, name: str) -> Matrices:
    """Matrices by scikit-fem, quadrature of equal order."""
    corners = mesh.blocks[name][:, : ELEMENTS[name].corners]
    used, numbers = np.unique(corners, return_inverse=True)
    points, cells = mesh.points[used].T, numbers.reshape(corners.shape)
    if name == "tetra10":
        basis = skfem.Basis(skfem.MeshTet(points, cells.T), skfem.ElementVector(skfem.ElementTetP2()), intorder=2)
        mass_basis = skfem.Basis(basis.mesh, basis.elem, intorder=4)
    else:
        order = [0, 1, 3, 4, 2, 5, 7, 6]  # of its corners
        basis = skfem.Basis(skfem.MeshHex(points, cells[:, order].T), skfem.ElementVector(skfem.ElementHexS2()), intorder=5)
        mass_basis = basis
    stiffness = linear_elasticity(*lame_parameters(STEEL.youngs_modulus, STEEL.poissons_ratio)).assemble(basis)

    @skfem.BilinearForm
    def mass(u, v, _):
        return STEEL.density * skfem.helpers.dot(u, v)

    return stiffness, mass.assemble(mass_basis)


def felupe_library(mesh: BladeMesh, name: str) -> Matrices:
    """Matrices by FElupe, with its own quadrature."""
    kinds = {
        "tetra10": ("tetra10", felupe.RegionQuadraticTetra),
        "hexahedron20": ("hexahedron20", felupe.RegionQuadraticHexahedron),
    }
    kind, region = kinds[name]
    field = felupe.FieldContainer([felupe.Field(region(felupe.Mesh(mesh.points, mesh.blocks[name], kind)), dim=3)])
    body = felupe.SolidBody(felupe.LinearElastic(E=STEEL.youngs_modulus, nu=STEEL.poissons_ratio), field, density=STEEL.density)
    return body.assemble.matrix(), body.assemble.mass()


def measure(way: Callable[[BladeMesh, str], Matrices], mesh: BladeMesh, name: str) -> tuple[float, float, float]:
    """Shortest time (s), trace of the stiffness (N/m) and total mass (kg)."""
    times = []
    for _ in range(REPETITIONS):
        began = time.perf_counter()
        stiffness, mass = way(mesh, name)
        times.append(time.perf_counter() - began)
    return min(times), stiffness.diagonal().sum(), mass.sum() / 3.0


def table(input: Any, output: Any, params: Any) -> None:
    """Time, trace of the stiffness and mass by each."""
    rows = []
    for name, counts in COUNTS.items():
        mesh = box_mesh(0.1, 0.05, 0.005, counts, element=name)
        _, trace, mass = measure(ours, mesh, name)
        for label, way in (("r37", ours), ("scikit-fem", scikit_fem), ("FElupe", felupe_library)):
            spent, *sums = measure(way, mesh, name)
            off = [f"{abs(total / own - 1.0):.0e}" for total, own in zip(sums, (trace, mass), strict=True)]
            rows.append([name, f"{len(mesh.points):,}", label, f"{spent:.2f}", *off])
    write_table(["element", "nodes", "by", "time (s)", "trace of the stiffness, off by", "mass, off by"], rows, output.table)
