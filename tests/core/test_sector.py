"""A sector of a disc against the closed form of a plate, the whole disc, and CalculiX."""

import shutil
import subprocess
from dataclasses import replace

import numpy as np
import pytest
import scipy.optimize
import scipy.sparse as sp
import scipy.sparse.linalg
import scipy.special
from box_mesh import TITANIUM
from defaults import BoundaryChoice
from discs import plate_sector, turn, whole_disc

from r37core.blade.profile import BladeShapeError
from r37core.fem.abaqus_deck import write_abaqus
from r37core.fem.disc_mesh import mesh_disc
from r37core.fem.matrices import assemble
from r37core.fem.mesh_quality import mesh_quality
from r37core.fem.sector import Sector, aliased
from r37core.fem.solver import lowest_modes
from r37core.fem.surface import mask_within, outer_faces
from r37core.mesh.blade_mesh import TIP_LINES
from r37core.mesh.disc import Disc
from r37core.mesh.generate import generate_mesh
from r37core.rom.contact_weights import tip_contact
from r37core.rom.reduce import reduce_blade
from r37core.rom.reduction_choice import ReductionChoice
from r37core.rom.rotation import rotation_amplitudes

DISC = Disc(web=0.008, rim=0.01, bore_radius=0.08, sectors=36)


def frequencies(mesh, matrices, speed, count, softening=0.0):
    """Of each nodal diameter (Hz), shape (nodal diameters, count)."""
    per_square = matrices.geometric_stiffness() + softening * matrices.spin_softening()
    sector, stiffness = Sector.of(mesh), matrices.stiffness() + speed**2 * per_square
    parts = [sector.matrix(sp.csr_array(part)) for part in (stiffness, matrices.mass())]
    phases = [sector.phase(number) for number in sector.nodal_diameters]
    return np.array([np.sqrt(lowest_modes(*(p.at(phase) for p in parts), count)[0]) for phase in phases]) / (2 * np.pi)


def plate_root(number, ratio, poisson):
    """Lowest k b of a thin annular plate, clamped inside and free outside: Leissa, NASA SP-160, section 2.2.

    w = (A J_n + B Y_n + C I_n + D K_n)(k r), w = w' = 0 inside, moment and Kelvin-Kirchhoff shear 0 outside.
    """

    def determinant(k):
        rows = []
        for function, sign in zip(("jv", "yv", "iv", "kv"), (-1, -1, 1, 1), strict=True):
            value = getattr(scipy.special, function)
            slope = getattr(scipy.special, f"{function}p")
            w, d = (lambda x, order, v=value, s=slope: v(number, x) if order == 0 else s(number, x, order)), k
            outer, first = w(d, 0), w(d, 1) * d
            laplace = sign * d**2 * outer
            moment = laplace - (1 - poisson) * (first - number**2 * outer)
            shear = sign * d**2 * first - (1 - poisson) * number**2 * (first - outer)
            rows.append([w(ratio * d, 0), w(ratio * d, 1), moment, shear])
        return np.linalg.det(np.array(rows).T / np.abs(rows).max(axis=1))

    grid = np.linspace(1.5, 12.0, 400)
    values = [determinant(k) for k in grid]
    change = next(i for i in range(len(grid) - 1) if values[i] * values[i + 1] < 0)
    return scipy.optimize.brentq(determinant, grid[change], grid[change + 1])


@pytest.mark.parametrize("number", range(4))
def test_an_annular_plate_is_that_of_its_closed_form(number):
    """Clamped inside at half the radius, free outside; within 1%."""
    outer, thickness = 0.2, 0.004
    mesh = plate_sector(0.5 * outer, outer, thickness, 12, (16, 4, 1))
    material = replace(TITANIUM, poissons_ratio=0.3)
    found = frequencies(mesh, assemble(mesh, material), 0.0, 1)[number, 0]
    rigidity = material.youngs_modulus * thickness**2 / 12 / (1 - 0.3**2) / material.density
    unit = np.sqrt(rigidity) / outer**2 / (2 * np.pi)
    assert found == pytest.approx(plate_root(number, 0.5, 0.3) ** 2 * unit, rel=1e-2)


@pytest.mark.parametrize("sectors", [12, 5])
def test_the_whole_disc_is_its_sector(sectors):
    """All lowest frequencies, at rest and spinning, to 1e-6; an odd number of sectors has no standing wave but that of 0."""
    mesh = plate_sector(0.06, 0.2, 0.01, sectors, (3, 2, 1))
    matrices, whole = assemble(mesh, TITANIUM), whole_disc(mesh, sectors)
    disc = assemble(whole, TITANIUM)
    assert len(np.intersect1d(mesh.cyclic[:, 0], mesh.cyclic[:, 1])) == 0
    np.testing.assert_allclose(mesh.points[mesh.cyclic[:, 0]] @ turn(sectors).T, mesh.points[mesh.cyclic[:, 1]], atol=1e-12)
    for speed in (0.0, 1500.0):
        single = frequencies(mesh, matrices, speed, 6)
        twice = [number for number in range(len(single)) if 0 < number < sectors / 2]
        ours = np.sort(np.concatenate([single.ravel(), single[twice].ravel()]))[:24]
        stiffness = disc.stiffness() + speed**2 * disc.geometric_stiffness()
        theirs = np.sqrt(lowest_modes(sp.csr_array(stiffness), disc.mass(), 24)[0]) / (2 * np.pi)
        np.testing.assert_allclose(ours, theirs, rtol=1e-6)


def test_one_blade_is_moved_by_forces_on_it_as_on_the_whole_disc():
    """Receptance of contact nodes: static exactly; below, between and above the first modes as the whole mesh has it."""
    sectors = 7
    mesh = plate_sector(0.06, 0.2, 0.02, sectors, (3, 2, 2))
    line = np.flatnonzero(
        (np.hypot(*mesh.points[:, :2].T) > 0.1999)
        & (np.abs(np.arctan2(mesh.points[:, 1], mesh.points[:, 0]) - np.pi / 7) < 1e-9)
    )
    line = line[np.argsort(mesh.points[line, 2])]
    chord = mesh.points[:, 2] / 0.02
    sets = dict(mesh.node_sets) | dict.fromkeys(TIP_LINES.values(), line)
    mesh = replace(mesh, node_sets=sets, parameters=np.stack([chord, 0.0 * chord, 0.0 * chord], axis=1))
    matrices, whole = assemble(mesh, TITANIUM), whole_disc(mesh, sectors)
    disc = assemble(whole, TITANIUM)
    boundary = BoundaryChoice(nodes=3)
    model = reduce_blade(mesh, matrices, TITANIUM, boundary, ReductionChoice((0.0, 600.0, 1200.0), 8), {})
    weights = tip_contact(whole, boundary).weights[:, disc.free_nodes]
    rows = sp.csr_array(sp.kron(weights, sp.eye_array(3)))
    first, count = model.modes(0.0, 1)[0][0], 9
    for speed, share, within in ((0, 0, 1e-9), (0, 0.8, 1e-6), (0, 1.55, 1e-4), (1200, 0, 1e-4), (1200, 1.55, 1e-3)):
        dynamic = -((share * first) ** 2)
        full = sp.csc_array(disc.stiffness() + speed**2 * disc.geometric_stiffness() + dynamic * disc.mass())
        expected = rows @ sp.linalg.spsolve(full, rows.T.toarray())
        found = np.linalg.inv(model.stiffness_at(speed) + dynamic * model.mass)[:count, :count]
        np.testing.assert_allclose(found, expected, rtol=0, atol=within * np.abs(expected).max())
    displaced = model.contact_nodes.rotation_shapes @ rotation_amplitudes(model.rotation_stiffening, 1200.0)
    full = sp.csc_array(disc.stiffness() + 1200.0**2 * disc.geometric_stiffness())
    expected = rows @ sp.linalg.spsolve(full, 1200.0**2 * disc.free_load)
    np.testing.assert_allclose(displaced.ravel(), expected, rtol=0, atol=1e-9 * np.abs(expected).max())


@pytest.fixture(scope="module")
def on_disc(blade):
    """A blade of the package, alone and on a disc of 36."""
    alone = generate_mesh(blade, 1200, 1, 8)
    return alone, mesh_disc(alone, DISC)


def test_a_disc_is_meshed_under_a_blade(on_disc):
    """Its volume is that of a rim below the hub's cone and a plane web; its faces match; elements share their faces."""
    alone, mesh = on_disc
    assert mesh_quality(mesh).min() > 0.1
    disc = assemble(mesh, TITANIUM).total_mass - assemble(alone, TITANIUM).total_mass
    x, y, z = alone.points[alone.node_set("root")].T
    hub, width, middle = np.polynomial.Polynomial.fit(z, np.hypot(x, y), 2), np.ptp(z), 0.5 * (z.min() + z.max())
    spread, angle = np.linspace(-0.5, 0.5, 1001), 2 * np.pi / DISC.sectors
    rim = hub(middle + 1.2 * width * spread)
    web = hub(middle + DISC.web * spread) - DISC.rim
    areas = 1.2 * width * np.mean(rim**2 - (rim - DISC.rim) ** 2), DISC.web * np.mean(web**2 - DISC.bore_radius**2)
    assert disc == pytest.approx(TITANIUM.density * 0.5 * angle * sum(areas), rel=2e-3)
    low, high = (mesh.points[nodes] for nodes in mesh.cyclic.T)
    np.testing.assert_allclose(low @ turn(DISC.sectors).T, high, atol=1e-9)
    assert Sector.of(mesh).sectors == DISC.sectors
    radius = np.hypot(*mesh.points[mesh.node_set("root"), :2].T)
    np.testing.assert_allclose(radius, DISC.bore_radius, rtol=1e-12)
    surface = outer_faces(mesh.blocks)
    sides = [mask_within(surface, np.isin(np.arange(len(mesh.points)), nodes)) for nodes in mesh.cyclic.T]
    assert sides[0].sum() == sides[1].sum() > 0
    # no face lies inside: the surface, without an edge, is as large as elements that share their faces leave it
    pairs = np.sort(np.concatenate([faces.edges()[:, ::2] for faces in surface]), axis=1)
    assert np.all(np.unique(pairs, axis=0, return_counts=True)[1] == 2)


def test_a_blade_on_a_clamped_disc_is_the_clamped_blade(on_disc):
    alone, mesh = on_disc
    held = np.setdiff1d(np.arange(len(mesh.points)), np.arange(len(alone.points)))
    stiff = replace(mesh, node_sets=dict(mesh.node_sets) | {"root": np.union1d(held, alone.node_set("root"))})
    ours, theirs = (assemble(each, TITANIUM) for each in (replace(stiff, cyclic=None), alone))
    for part in ("stiffness", "mass", "geometric_stiffness"):
        assert abs(getattr(ours, part)() - getattr(theirs, part)()).max() < 1e-9 * abs(getattr(theirs, part)()).max()


@pytest.mark.parametrize("key", ["web", "rim", "bore_radius", "sectors"])
def test_a_disc_that_does_not_fit_is_refused(on_disc, key):
    with pytest.raises(BladeShapeError, match=r"there: found bore_radius_m .*; allowed under this root: bore_radius_m below 0"):
        mesh_disc(
            on_disc[0], replace(DISC, **{key: {"web": 0.05, "rim": 0.1, "bore_radius": 0.17, "sectors": 300}[key]}), "there"
        )


def test_engine_orders_are_aliased():
    assert [aliased(order, 12) for order in (1, 6, 7, 11, 12, 13, 18, 25)] == [1, 6, 5, 1, 0, 1, 6, 1]
    assert [aliased(order, 5) for order in (2, 3, 4, 5, 6)] == [2, 2, 1, 0, 1]


@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (apt-get install calculix-ccx)")
@pytest.mark.parametrize("speed", [0.0, 1500.0])
def test_calculix_has_the_same_nodal_diameters(tmp_path, speed):
    """Cyclic symmetry of CalculiX on the same bricks, which has spin softening: to its digits at rest, within 0.1% spinning."""
    sectors, numbers, count = 12, (0, 1, 2, 6), 4
    mesh = plate_sector(0.06, 0.2, 0.01, sectors, (3, 2, 1))
    deck = tmp_path / "mesh.inp"
    write_abaqus(mesh, deck, TITANIUM, "check")
    lines = deck.read_text().splitlines()
    lines = lines[: lines.index("*STEP")]
    free = mesh.cyclic[~np.isin(mesh.cyclic[:, 0], mesh.node_set("root"))]
    for name, nodes in (("LOW", free[:, 0]), ("HIGH", free[:, 1])):
        lines += [f"*NSET, NSET={name}", *(f"{node + 1}," for node in nodes)]
    lines += ["*SURFACE, NAME=LEFT, TYPE=NODE", "HIGH,", "*SURFACE, NAME=RIGHT, TYPE=NODE", "LOW,"]
    lines += ["*TIE, NAME=CYCLE, CYCLIC SYMMETRY, POSITION TOLERANCE=1e-6", "LEFT, RIGHT"]
    lines += [f"*CYCLIC SYMMETRY MODEL, N={sectors}, TIE=CYCLE", "0, 0, 0, 0, 0, 1"]
    if speed:
        lines += ["*STEP", "*STATIC", "*DLOAD", f"BLADE, CENTRIF, {speed**2}, 0, 0, 0, 0, 0, 1", "*END STEP"]
    for number in numbers:
        lines += ["*STEP" + ", PERTURBATION" * bool(speed), "*FREQUENCY", f"{2 * count}"]
        lines += [f"*SELECT CYCLIC SYMMETRY MODES, NMIN={number}, NMAX={number}", "*END STEP"]
    deck.write_text("\n".join(lines) + "\n")
    subprocess.run(["ccx", "mesh"], cwd=tmp_path, check=True, capture_output=True, timeout=300)
    rows = [line.split() for line in (tmp_path / "mesh.dat").read_text().splitlines()]
    # nodal diameter, mode, eigenvalue, rad/s, Hz, imaginary part
    table = np.array([[float(cell) for cell in row] for row in rows if len(row) == 6 and row[0].isdigit()])
    # it prints each twice
    theirs = np.array([table[table[:, 0] == number][::2, 4] for number in numbers])
    ours = frequencies(mesh, assemble(mesh, TITANIUM), speed, count, softening=1.0)[list(numbers)]
    np.testing.assert_allclose(ours, theirs, rtol=1e-3 if speed else 1e-6)
