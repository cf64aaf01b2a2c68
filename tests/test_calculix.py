"""The same mesh in CalculiX: frequencies, a tip load and the centrifugal stress field."""

import shutil
import subprocess

import numpy as np
import pytest

from r37core.fem.centrifugal import centrifugal_load
from r37core.fem.matrices import static_displacement
from r37core.fem.solver import lowest_modes
from r37core.fem.stress import stress_at
from r37core.fem.wedge15 import STIFFNESS_RULE, physical_gradients
from r37core.mesh.mesh_files import write_abaqus

pytestmark = pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (Debian: calculix-ccx) is not installed")

SPEED = 1500.0


def run_calculix(folder, mesh, material, step=None):
    """Run the project's deck, with another step than its own if given; returns the tables it printed."""
    deck = folder / "mesh.inp"
    write_abaqus(mesh, deck, material.youngs_modulus, material.density, material.poissons_ratio, "check")
    if step is not None:
        lines = deck.read_text().splitlines()
        deck.write_text("\n".join([*lines[: lines.index("*STEP")], "*STEP", "*STATIC", *step, "*END STEP"]) + "\n")
    subprocess.run(["ccx", "mesh"], cwd=folder, check=True, capture_output=True, timeout=300)
    return [line.split() for line in (folder / "mesh.dat").read_text().splitlines()]


def printed(rows, width):
    """Rows of numbers of one width, as an array."""
    return np.array([[float(cell) for cell in row] for row in rows if len(row) == width and row[0].isdigit()])


def von_mises(s):
    """Of stress tensors, shape (..., 3, 3)."""
    deviator = s - np.trace(s, axis1=-2, axis2=-1)[..., None, None] / 3 * np.eye(3)
    return np.sqrt(1.5 * np.sum(deviator**2, axis=(-2, -1)))


def test_frequencies(mesh, matrices, steel, tmp_path):
    rows = run_calculix(tmp_path, mesh, steel)
    calculix = printed(rows, 5)[:10, 3]
    values, _ = lowest_modes(matrices.stiffness(), matrices.mass(), 10)
    np.testing.assert_allclose(np.sqrt(values) / (2 * np.pi), calculix, rtol=1e-4)


def test_static_tip_load(mesh, matrices, steel, tmp_path):
    node = int(mesh.node_set("tip_pressure_edge")[0])
    force = np.array([3.0, -50.0, 20.0])
    loads = [f"{node + 1}, {axis + 1}, {value}" for axis, value in enumerate(force)]
    rows = run_calculix(tmp_path, mesh, steel, ["*CLOAD", *loads, "*NODE PRINT, NSET=ALL_NODES", "U"])
    load = np.zeros_like(mesh.points)
    load[node] = force
    ours = static_displacement(matrices, load)
    np.testing.assert_allclose(ours, printed(rows, 4)[:, 1:], rtol=0, atol=1e-5 * np.abs(ours).max())


def test_centrifugal_displacement_and_stress(mesh, matrices, steel, tmp_path):
    spin = f"BLADE, CENTRIF, {SPEED**2}, 0, 0, 0, 0, 0, 1"
    step = ["*DLOAD", spin, "*NODE PRINT, NSET=ALL_NODES", "U", "*EL PRINT, ELSET=BLADE", "S"]
    rows = run_calculix(tmp_path, mesh, steel, step)
    ours = static_displacement(matrices, SPEED**2 * centrifugal_load(mesh.elements, mesh.points, steel.density))
    np.testing.assert_allclose(ours, printed(rows, 4)[:, 1:], rtol=0, atol=2e-4 * np.abs(ours).max())
    gradients, _ = physical_gradients(mesh.points[mesh.elements], STIFFNESS_RULE[0])
    stress = np.sort(von_mises(stress_at(gradients, ours[mesh.elements], steel)), axis=1)
    xx, yy, zz, xy, xz, yz = printed(rows, 8)[:, 2:].T
    tensors = np.stack([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]).transpose(2, 0, 1)
    # CalculiX numbers an element's integration points in another order
    theirs = np.sort(von_mises(tensors).reshape(len(mesh.elements), -1), axis=1)
    assert stress.max() > 1e8
    np.testing.assert_allclose(stress, theirs, rtol=0, atol=1e-3 * theirs.max())
