"""Stiffness and mass from our element table beside those of scikit-fem and FElupe: time, and the same numbers.

The question was whether a library's shape functions and quadrature would leave less code at equal speed. Needs both:
pip install scikit-fem felupe; then: python validation/benchmarks/element_libraries.py   (some minutes). The table goes into
docs/structure.md.
"""

import sys
import time
from pathlib import Path

import felupe
import numpy as np
import skfem
from skfem.models.elasticity import lame_parameters, linear_elasticity

from r37core.fem.assembly import NodePattern, assemble_mass, assemble_stiffness, block_matrix
from r37core.fem.elements import ELEMENTS
from r37core.fem.material import Material
from r37core.io import write_text

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "tests"))

from box_mesh import box_mesh  # noqa: E402

STEEL = Material(youngs_modulus=180e9, poissons_ratio=0.3, density=8000.0)
COUNTS = {"tetra10": (24, 12, 4), "hexahedron20": (40, 20, 6), "wedge15": (40, 20, 5)}
REPETITIONS = 3


def ours(mesh, _):
    """Matrices by the code that r37 runs."""
    pattern = NodePattern.of(mesh.blocks, len(mesh.points))
    stiffness = assemble_stiffness(pattern, mesh.blocks, mesh.points, STEEL)
    mass = assemble_mass(pattern, mesh.blocks, mesh.points, STEEL.density)
    blocks = mass[:, None, None] * np.eye(3)
    return tuple(block_matrix(pattern.indptr, pattern.indices, part) for part in (stiffness, blocks))


def scikit_fem(mesh, name):
    """The same by scikit-fem, quadrature of equal order."""
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


def felupe_library(mesh, name):
    """The same by FElupe, with its own quadrature."""
    kinds = {
        "tetra10": ("tetra10", felupe.RegionQuadraticTetra),
        "hexahedron20": ("hexahedron20", felupe.RegionQuadraticHexahedron),
    }
    kind, region = kinds[name]
    field = felupe.FieldContainer([felupe.Field(region(felupe.Mesh(mesh.points, mesh.blocks[name], kind)), dim=3)])
    body = felupe.SolidBody(felupe.LinearElastic(E=STEEL.youngs_modulus, nu=STEEL.poissons_ratio), field, density=STEEL.density)
    return body.assemble.matrix(), body.assemble.mass()


def measure(way, mesh, name):
    """Shortest time (s), trace of the stiffness (N/m) and total mass (kg)."""
    times = []
    for _ in range(REPETITIONS):
        began = time.perf_counter()
        stiffness, mass = way(mesh, name)
        times.append(time.perf_counter() - began)
    return min(times), stiffness.diagonal().sum(), mass.sum() / 3.0


def main():
    lines = ["| element | nodes | by | time (s) | trace of the stiffness, off by | mass, off by |", "|---|---|---|---|---|---|"]
    for name, counts in COUNTS.items():
        mesh = box_mesh(0.1, 0.05, 0.005, counts, element=name)
        reference = measure(ours, mesh, name)
        for label, way in (("r37", ours), ("scikit-fem", scikit_fem), ("FElupe", felupe_library)):
            begin = f"| {name} | {len(mesh.points)} | {label} |"
            if way is not ours and name == "wedge15":
                lines.append(f"{begin} has none | | |")
                continue
            spent, trace, total = reference if way is ours else measure(way, mesh, name)
            lines.append(
                f"{begin} {spent:.2f} | {abs(trace / reference[1] - 1.0):.0e} | {abs(total / reference[2] - 1.0):.0e} |"
            )
            print(lines[-1], flush=True)
    write_text("\n".join(lines) + "\n", ROOT / "results/studies/element_libraries.md")


if __name__ == "__main__":
    main()
