"""The same mesh in CalculiX: frequencies, a tip load and the centrifugal stress field."""

import shutil
import subprocess
from dataclasses import replace

import numpy as np
import pytest
from box_mesh import box_mesh, inner_places
from box_operator import box_operator

from r37core.fem.abaqus_deck import write_abaqus
from r37core.fem.elements import ELEMENTS, wedge_rule
from r37core.fem.matrices import assemble, centrifugal_load
from r37core.fem.solver import lowest_modes
from r37core.fem.stress import recovered_stress, stress_numbers
from r37core.rom.rotation import rotation_amplitudes
from r37core.stress import operator
from r37core.stress.revolutions import stress_cycles

pytestmark = pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (apt-get install calculix-ccx)")

SPEED = 1500.0


def run_calculix(folder, mesh, material, step=None, kind="*STEP"):
    """Run the project's deck, with another static step than its own if given; returns the tables it printed."""
    deck = folder / "mesh.inp"
    write_abaqus(mesh, deck, material, "check")
    if step is not None:
        lines = deck.read_text().splitlines()
        deck.write_text("\n".join([*lines[: lines.index("*STEP")], kind, "*STATIC", *step, "*END STEP"]) + "\n")
    subprocess.run(["ccx", "mesh"], cwd=folder, check=True, capture_output=True, timeout=300)
    return [line.split() for line in (folder / "mesh.dat").read_text().splitlines()]


def printed(rows, width):
    """Rows of numbers of one width, as an array."""
    return np.array([[float(cell) for cell in row] for row in rows if len(row) == width and row[0].isdigit()])


def von_mises(s):
    """Of stress tensors, shape (..., 3, 3)."""
    deviator = s - np.trace(s, axis1=-2, axis2=-1)[..., None, None] / 3 * np.eye(3)
    return np.sqrt(1.5 * np.sum(deviator**2, axis=(-2, -1)))


def check_frequencies(folder, mesh, matrices, material, count, within):
    calculix = printed(run_calculix(folder, mesh, material), 5)[:count, 3]
    values, _ = lowest_modes(matrices.stiffness(), matrices.mass(), count)
    np.testing.assert_allclose(np.sqrt(values) / (2 * np.pi), calculix, rtol=within)


def test_frequencies(mesh, matrices, steel, tmp_path):
    check_frequencies(tmp_path, mesh, matrices, steel, 10, 1e-4)


def test_static_tip_load(mesh, matrices, steel, tmp_path):
    node = int(mesh.node_set("tip_pressure_edge")[0])
    force = np.array([3.0, -50.0, 20.0])
    loads = [f"{node + 1}, {axis + 1}, {value}" for axis, value in enumerate(force)]
    rows = run_calculix(tmp_path, mesh, steel, ["*CLOAD", *loads, "*NODE PRINT, NSET=ALL_NODES", "U"])
    load = np.zeros_like(mesh.points)
    load[node] = force
    ours = matrices.displaced_by(load)
    np.testing.assert_allclose(ours, printed(rows, 4)[:, 1:], rtol=0, atol=1e-5 * np.abs(ours).max())


def check_centrifugal(folder, mesh, matrices, material):
    """Displacement within 2e-4 and von Mises stress at the integration points within 1e-3 of the largest."""
    spin = f"BLADE, CENTRIF, {SPEED**2}, 0, 0, 0, 0, 0, 1"
    step = ["*DLOAD", spin, "*NODE PRINT, NSET=ALL_NODES", "U", "*EL PRINT, ELSET=BLADE", "S"]
    rows = run_calculix(folder, mesh, material, step)
    ours = matrices.displaced_by(SPEED**2 * centrifugal_load(mesh.blocks, mesh.points, material.density))
    np.testing.assert_allclose(ours, printed(rows, 4)[:, 1:], rtol=0, atol=2e-4 * np.abs(ours).max())
    table = printed(rows, 8)
    xx, yy, zz, xy, xz, yz = table[:, 2:].T
    theirs = von_mises(np.stack([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]).transpose(2, 0, 1))
    stress, first = operator.von_mises(recovered_stress(mesh.blocks, mesh.points, ours[..., None], material, True))[:, 0], 1
    for nodes, numbers in zip(mesh.blocks.values(), stress_numbers(mesh.blocks, True).values(), strict=True):
        # CalculiX numbers an element's integration points in another order
        of_block = (table[:, 0] >= first) & (table[:, 0] < first + len(nodes))
        np.testing.assert_allclose(
            np.sort(stress[numbers], axis=1),
            np.sort(theirs[of_block].reshape(len(nodes), -1), axis=1),
            rtol=0,
            atol=1e-3 * theirs.max(),
        )
        first += len(nodes)
    return theirs.max()


def test_centrifugal_displacement_and_stress(mesh, matrices, steel, tmp_path):
    assert check_centrifugal(tmp_path, mesh, matrices, steel) > 1e8


def test_blade_that_rotation_holds(model, mesh, steel, tmp_path):
    """Linear: the displacement of the contact nodes at low speed, per squared speed, within 1e-5.

    With large displacements: what K0 + Omega^2 K1 leaves out. It takes a tenth off the error that K0 alone has.
    """
    nodes = model.contact_nodes
    step = ["*DLOAD", f"BLADE, CENTRIF, {SPEED**2}, 0, 0, 0, 0, 0, 1", "*NODE PRINT, NSET=ALL_NODES", "U"]
    theirs = {}
    for name, kind, lines in (("linear", "*STEP", step), ("large", "*STEP, NLGEOM, INC=100", ["0.5, 1.0", *step])):
        (tmp_path / name).mkdir()
        rows = printed(run_calculix(tmp_path / name, mesh, steel, lines, kind), 4)[-len(mesh.points) :, 1:]
        theirs[name] = rows[nodes.nodes]
    ours = {
        "linear": nodes.rotation_shapes.sum(axis=2) * SPEED**2,
        "large": nodes.rotation_shapes @ rotation_amplitudes(model.rotation_stiffening, SPEED),
    }
    largest = np.abs(theirs["large"]).max()
    np.testing.assert_allclose(ours["linear"], theirs["linear"], rtol=0, atol=1e-5 * largest)
    error, without = (np.abs(one - theirs["large"]).max() / largest for one in (ours["large"], ours["linear"]))
    assert error < 0.03
    assert without > 10.0 * error


def nodal_tensors(folder, nodes):
    """Stress tensors, shape (nodes, 3, 3), that CalculiX has averaged at `nodes`."""
    lines = iter((folder / "mesh.frd").read_text().splitlines())
    next(line for line in lines if line.startswith(" -4  STRESS"))
    rows = {}
    for line in lines:
        if line.startswith(" -3"):
            break
        if line.startswith(" -1"):
            rows[int(line[3:13])] = [float(line[start : start + 12]) for start in range(13, 85, 12)]
    xx, yy, zz, xy, yz, zx = np.array([rows[int(node) + 1] for node in nodes]).T
    return np.stack([[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]]).transpose(2, 0, 1)


def test_fatigue_of_three_nodes(model, mesh, steel, tmp_path):
    """Both stresses of the Goodman line, of contact nodes that swing about a place, on a blade that rotation holds.

    CalculiX solves the full mesh with the contact nodes moved, and with the linear centrifugal load. It extrapolates stress
    from integration points to nodes, and ours is evaluated there: they differ by up to 2%.
    """
    contact, places = model.contact_nodes.nodes, inner_places(model, mesh)
    moved = np.linspace(1.0, 2.0, len(contact))[:, None] * 1e-4 * np.array([0.2, -3.0, 1.0])
    number = moved.size
    held = [f"{contact[i] + 1}, {axis + 1}, {axis + 1}, {value:.12g}" for (i, axis), value in np.ndenumerate(moved)]
    steps = {"swing": ["*BOUNDARY", *held], "rotation": ["*DLOAD", f"BLADE, CENTRIF, {SPEED**2}, 0, 0, 0, 0, 0, 1"]}
    tensors = {}
    for name, load in steps.items():
        (tmp_path / name).mkdir()
        run_calculix(tmp_path / name, mesh, steel, [*load, "*EL FILE", "S"])
        tensors[name] = nodal_tensors(tmp_path / name, model.stress_regions["box"].nodes.nodes[places])
    inside = np.linalg.solve(model.stiffness[number:, number:], -model.stiffness[number:, :number] @ moved.ravel())
    swing = np.concatenate([moved.ravel(), inside])
    sine = 2.0 * np.sin(2.0 * np.pi * np.arange(80) / 40)[:, None]
    linear, stress = np.full(len(model.rotation_stiffening), SPEED**2), box_operator(model, steel)
    alternating, rotation = 2.0 * von_mises(tensors["swing"]), np.trace(tensors["rotation"], axis1=1, axis2=2)
    assert alternating.min() > 1e8 and rotation.min() > 1e8
    for place, mean in ((0.0, rotation), (3.0, rotation + 3.0 * np.trace(tensors["swing"], axis1=1, axis2=2))):
        found, found_mean = stress_cycles(stress, (place + sine) * swing, np.eye(len(swing)), linear, 40, 2)
        np.testing.assert_allclose(found[:, places], np.broadcast_to(alternating, (2, 3)), rtol=0.015)
        np.testing.assert_allclose(found_mean[places], mean, rtol=0.02)


@pytest.mark.parametrize("kind", ELEMENTS)
def test_each_element(kind, steel, tmp_path, monkeypatch):
    """With CalculiX's quadrature: it integrates the mass with the stiffness rule, and C3D6 at two points in all."""
    rule = wedge_rule(1, 2) if kind == "wedge" else ELEMENTS[kind].stiffness_rule
    monkeypatch.setitem(ELEMENTS, kind, replace(ELEMENTS[kind], stiffness_rule=rule, mass_rule=rule))
    # thick, with curved faces, off the axis
    mesh = box_mesh(0.08, 0.04, 0.012, (4, 3, 2), origin=(0.17, -0.02, -0.004), warp=1.0, element=kind)
    matrices = assemble(mesh, steel)
    check_frequencies(tmp_path, mesh, matrices, steel, 10, 1e-6)
    check_centrifugal(tmp_path, mesh, matrices, steel)


@pytest.mark.parametrize("kind", ["tetra10", "wedge15", "hexahedron20"])
def test_exact_mass_makes_little_difference(kind, steel, tmp_path):
    mesh = box_mesh(0.08, 0.03, 0.003, (18, 8, 1), origin=(0.17, -0.02, -0.004), warp=1.0, element=kind)
    check_frequencies(tmp_path, mesh, assemble(mesh, steel), steel, 5, 1e-4)
