"""Matrices that are exported, and imported again."""

import re
import shutil
import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import scipy.linalg as la
from defaults import Orientation
from full_matrices import write_full_matrices
from import_defaults import MatricesSource, refused
from refusal_tables import pattern_of, refusal_rows
from scipy.io import mmwrite
from test_contact_patches import PATCHES, SPEEDS, every, patched  # noqa: F401
from test_exports import NAMES, directory  # noqa: F401
from test_import_parts import ANGLES

from r37core.fem.orientation import OURS
from r37core.results.campbell import campbell_diagram
from r37core.rom.contact_weights import contact_along, mean_fields
from r37core.rom.reduced_model import contact_model
from r37core.rom.reduction_choice import BoundaryError
from r37imports.importing.matrices_in import import_matrices, wording
from r37imports.importing.matrix_file import read_matrix
from r37imports.refusal import MeshWarning
from r37studies.exports.matrices_out import write_reduced_matrices


@pytest.fixture(scope="module")
def reduced_files(model, tmp_path_factory):
    folder = tmp_path_factory.mktemp("reduced")
    write_reduced_matrices(model, (0.0, 1000.0, 2000.0), folder)
    return folder


TABLE = Path(__file__).parents[1] / "imports/refusals.txt"
SMALL = np.diag(np.arange(4.0, 28.0))


@pytest.fixture
def imported(boundary, reduction):
    """The reduced model of the matrices in a folder, with another boundary, or other values of their source."""

    def read(folder, boundary=boundary, **changes):
        return import_matrices(replace(MatricesSource(str(folder), OURS), **changes), boundary, reduction)

    return read


def write_small(folder, table, **changes):
    """Matrices of 24 rows with a table of contact nodes; what is None is left out."""
    for name, matrix in ({"M": SMALL, "K_0": SMALL, "K_100": 2 * SMALL, "K_200": 5 * SMALL} | changes).items():
        if matrix is not None:
            mmwrite(folder / f"{name}.mtx", matrix)
    (folder / "boundary.csv").write_text(table)


@pytest.fixture(scope="module")
def on_patches(matrices, patched, tmp_path_factory):
    """Full matrices of the blade on patches, with all nodes of its edge in boundary.csv."""
    folder = tmp_path_factory.mktemp("matrices")
    write_full_matrices(matrices, patched.tip_lines["pressure_edge"], SPEEDS, folder)
    return folder


@pytest.mark.slow
def test_patches_of_full_matrices(on_patches, patched, imported):
    """Nodes on the line, and no elements: hats of straight pieces, on a coarse mesh within a percent of the elements' own."""
    again = imported(on_patches, replace(PATCHES, nodes=5))
    assert len(again.singular_values) == len(patched.singular_values)
    np.testing.assert_allclose(again.modes(1000.0, 8)[0], patched.modes(1000.0, 8)[0], rtol=1e-4)
    found, ours = (la.inv(model.stiffness)[:15, :15] for model in (again, patched))
    np.testing.assert_allclose(found, ours, atol=0.02 * np.abs(ours).max())
    np.testing.assert_allclose(again.contact_chord, patched.contact_chord, atol=0.02)


@pytest.mark.slow
def test_patches_of_reduced_matrices_keep_every_motion(every, imported, tmp_path):
    """A small model on all nodes of the edge, taken with other coordinates: its modes are the same, its patches means."""
    write_reduced_matrices(every, SPEEDS, tmp_path)
    again = imported(tmp_path, PATCHES)
    assert again.size == every.size
    np.testing.assert_allclose(again.modes(1500.0)[0][:40], every.modes(1500.0)[0][:40], rtol=1e-7)
    chord = np.linspace(0.0, 1.0, len(every.contact_nodes.nodes))
    weights = contact_along(every.contact_nodes.points, chord, PATCHES).weights
    rows = mean_fields(weights, every.contact_nodes.basis).reshape(12, -1)
    np.testing.assert_allclose(again.contact_nodes.basis.reshape(12, -1)[:, :12], np.eye(12), atol=1e-8)
    flexibility = rows @ la.solve(every.stiffness, rows.T)
    np.testing.assert_allclose(la.inv(again.stiffness)[:12, :12], flexibility, atol=2e-3 * np.abs(flexibility).max())


def test_matrices_without_the_nodes_for_patches(model, imported, tmp_path):
    write_reduced_matrices(model, SPEEDS, tmp_path)
    message = r"found 8 contact patches on the 8 nodes of boundary\.csv; allowed: at most 4 .* or contact: points"
    with pytest.raises(BoundaryError, match=message):
        imported(tmp_path, replace(PATCHES, nodes=8))
    single = replace(PATCHES, nodes=1)
    with pytest.raises(BoundaryError, match=r"on the 1 nodes .* allowed: none .* because a patch is made of two or more"):
        contact_along(np.array([[0.25, 0.0, 0.0]]), np.array([0.5]), single)


def test_full_matrices_come_back(directory, model, imported):
    """The same reduced model to round-off: frequencies, names, contact rows."""
    assert {file.name for file in directory.iterdir()} == NAMES
    again = imported(directory)
    speeds = np.array([0.0, 700.0, 1700.0])
    ours, theirs = (campbell_diagram(m, speeds, 6) for m in (model, again))
    assert theirs.mode_names == ours.mode_names
    np.testing.assert_allclose(theirs.frequencies, ours.frequencies, rtol=1e-7)
    contact, wanted = contact_model(again, "pressure_edge"), contact_model(model, "pressure_edge")
    np.testing.assert_allclose(contact.radius, wanted.radius, rtol=1e-12)
    compliance, expected = (
        np.einsum("anj,bnj,j->abn", m.displacement_operator, m.displacement_operator, 1.0 / m.squared_frequencies)
        for m in (contact, wanted)
    )
    np.testing.assert_allclose(compliance, expected, rtol=1e-6, atol=1e-6 * np.abs(expected).max())


def test_reduced_matrices_come_back_in_any_unit(reduced_files, model, imported):
    assert {file.name for file in reduced_files.iterdir()} == NAMES
    again = imported(reduced_files)
    np.testing.assert_allclose(again.mass, model.mass, atol=1e-12 * np.abs(model.mass).max())
    np.testing.assert_allclose(again.modes(1400.0, 12)[0], model.modes(1400.0, 12)[0], rtol=1e-8)
    # patches lie within the tip, so their places do not say it
    np.testing.assert_allclose(again.contact_tip_lengths, model.contact_tip_lengths, rtol=1e-12)
    # tonnes and N/mm, as programs in millimetres have them
    again = imported(reduced_files, mass_unit="t", stiffness_unit="N/mm")
    np.testing.assert_allclose(again.mass, 1e3 * model.mass, atol=1e-9 * np.abs(model.mass).max())
    expected = 1e3 * model.stiffness_at(900.0)
    np.testing.assert_allclose(again.stiffness_at(900.0), expected, atol=1e-6 * np.abs(model.stiffness).max())


def test_reduced_matrices_in_other_axes(model, imported, tmp_path):
    """Rotor axis along -y, blade along z, mm: taken as they are, and turned."""
    turn = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])  # file's axes in rows of ours
    nodes = len(model.contact_nodes.nodes)
    whole = np.eye(model.size)
    whole[: 3 * nodes, : 3 * nodes] = np.kron(np.eye(nodes), turn)
    for name, matrix in {"M": model.mass, **{f"K_{s:g}": model.stiffness_at(s) for s in (0.0, 800.0, 1600.0)}}.items():
        mmwrite(tmp_path / f"{name}.mtx", whole.T @ matrix @ whole)
    points = model.contact_nodes.points
    rows = np.arange(3 * nodes).reshape(-1, 3)
    header = "x,y,z,dof_x,dof_y,dof_z"
    np.savetxt(tmp_path / "boundary.csv", np.hstack([1e3 * points @ turn, rows]), delimiter=",", header=header, comments="")
    orientation = Orientation("mm", rotor_axis=tuple(turn[2]), radial=tuple(turn[0]), rotation="negative")
    again = imported(tmp_path, orientation=orientation)
    np.testing.assert_allclose(again.modes(1000.0, 10)[0], model.modes(1000.0, 10)[0], rtol=1e-8)
    np.testing.assert_allclose(again.tip_lines["pressure_edge"].points, points, atol=1e-12)
    rows_again, rows_ours = (contact_model(m, "pressure_edge").displacement_operator for m in (again, model))
    np.testing.assert_allclose(np.abs(rows_again[:, :, :6]), np.abs(rows_ours[:, :, :6]), rtol=1e-5, atol=1e-6)


@pytest.mark.parametrize(("factor", "outcome"), [(1.0, "said"), (1e3, "warned"), (1e-3, "warned"), (1e-20, "refused")])
def test_the_first_frequency_shows_a_wrong_unit(model, imported, tmp_path, factor, outcome):
    """Of the reference blade 840 Hz; the frequency follows the root of the stiffness."""
    changed = replace(model, stiffness=factor * model.stiffness, geometric_stiffness=factor * model.geometric_stiffness)
    first = model.modes(0.0, 1)[0][0] / (2.0 * np.pi)
    write_reduced_matrices(changed, (0.0, 1000.0, 2000.0), tmp_path)
    said = re.escape(f"the first frequency at rest is {first * factor**0.5:.4g} Hz")
    if outcome == "said":
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            assert re.match(said, wording(imported(tmp_path)))
    elif outcome == "warned":
        with pytest.warns(MeshWarning, match=rf"{said}, with a tip of 56\.1 mm; .* look at mass_unit"):
            imported(tmp_path)
    else:
        with refused(rf"{re.escape(tmp_path.name)}: {said}"):
            imported(tmp_path)


def test_unsuitable_matrices_are_refused(imported, tmp_path):
    def unsuitable(message, **files):
        folder = tmp_path / str(len(list(tmp_path.iterdir())))
        folder.mkdir()
        write_small(folder, "x,y,z,dof_x,dof_y,dof_z\n0.2,0,0,0,1,2\n", **files)
        with refused(message):
            imported(folder)

    unsuitable("found K_<speed> at 100, 200, 300 rad/s; allowed: at 0 and two", K_0=None, K_300=10 * SMALL)
    for name in ("inf", "1e200", "nan", "-200", "fast"):
        named = {"K_200": None, f"K_{name}": SMALL}
        unsuitable(rf"K_{name}\.mtx: found a name without a speed; allowed: .* from 0 to 1e\+06", **named)
    for low, high in (("1e-3", "200"), ("200", "200.0001")):
        files = {"K_100": None, "K_200": None, f"K_{low}": SMALL, f"K_{high}": SMALL}
        unsuitable(rf"found K_<speed> at 0, {float(low):.9g}, {float(high):.9g} .* 0\.1 to 0\.99 times", **files)
    files = {"K_100": None, "K_200": None, "K_1": SMALL, "K_2": SMALL}
    unsuitable("found K_<speed> up to 2 rad/s, for a blade that is needed up to 2000 .* 100 or more", **files)
    unsuitable("is not linear in the squared speed .*, to twelve digits", K_200=7 * SMALL)
    unsuitable("matrices differ in size: 24, 3, 24, 24", K_0=SMALL[:3, :3])
    unsuitable("the mass is not positive .lowest eigenvalue -1 kg.; leave no massless", M=SMALL - np.diag(23 * [0.0] + [28.0]))
    free = np.diag([0.0, *np.arange(5.0, 28.0)])
    unsuitable("the stiffness at rest is not positive .* clamp the root", K_0=free, K_100=free + SMALL, K_200=free + 4 * SMALL)
    unsuitable("found matrices of 19 rows; allowed: 20", **{name: SMALL[:19, :19] for name in ("M", "K_0", "K_100", "K_200")})


@pytest.mark.parametrize(("file", "head", "message"), refusal_rows(TABLE, "M.mtx"))
def test_headers_that_promise_too_much(tmp_path, file, head, message):
    """Memory is taken by the header's numbers: a matrix of 1e9 rows took 24 s to its MemoryError."""
    head = head.replace(" / ", "\n")
    (tmp_path / file).write_text(f"%%MatrixMarket matrix {head}\n1 1 1.0\n")
    with refused(rf"^M\.mtx: {pattern_of(message)}"):
        read_matrix(tmp_path / file)


def test_a_small_matrix_fits_its_header(tmp_path):
    """The shortest entries of Matrix Market that there can be."""
    for text in ("array integer symmetric\n2 2\n2\n1\n2\n", "coordinate integer symmetric\n2 2 2\n1 1 3\n2 2 3\n"):
        (tmp_path / "M.mtx").write_text(f"%%MatrixMarket matrix {text}")
        assert read_matrix(tmp_path / "M.mtx").shape == (2, 2)


@pytest.mark.parametrize(("kind", "table", "message"), refusal_rows(TABLE, "boundary.csv"))
def test_unsuitable_tables_are_refused(imported, tmp_path, kind, table, message):
    with refused(pattern_of(message)) as refusal:
        write_small(tmp_path, table.replace(" / ", "\n"))
        imported(tmp_path)
    assert refusal.value.key == "matrices"


@pytest.mark.parametrize(
    ("change", "key", "message"),
    [
        (lambda nodes: 1e3 * nodes, "length_unit", r"24\d to 2\d\d m from the rotor axis .*length_unit m.* does not fit"),
        (lambda nodes: 1e-3 * nodes, "length_unit", r"length_unit m"),
        (lambda nodes: nodes + np.array([1e9, 0, 0]), "length_unit", r"1e\+09 to 1e\+09 m from the rotor axis"),
        (lambda nodes: nodes * [0, 0, 1], "length_unit", "0 to 0 m from the rotor axis .* rotor_axis or axis_point"),
        (lambda nodes: nodes[:, [1, 0, 2]], "radial", "the contact nodes' middle lies at .* degrees round the axis"),
        (lambda nodes: nodes[::-1], "matrices", "the contact nodes run upstream; list them from the leading"),
        (lambda nodes: nodes[[0, 2, 1, *range(3, len(nodes))]], "matrices", "contact node 3 does not lie beyond"),
        (lambda nodes: nodes[np.argsort(np.arange(len(nodes)) % 2, kind="stable")], "matrices", "does not lie beyond"),
        (lambda nodes: nodes * [1, 1, 0], "matrices", "leading and trailing edge lie at the same z"),
    ],
)
def test_contact_nodes_of_another_size_or_order_are_refused(reduced_files, imported, tmp_path, change, key, message):
    shutil.copytree(reduced_files, tmp_path, dirs_exist_ok=True)
    table = pd.read_csv(tmp_path / "boundary.csv")
    table[["x", "y", "z"]] = change(table[["x", "y", "z"]].to_numpy())
    table.to_csv(tmp_path / "boundary.csv", index=False)
    with refused(rf"^{tmp_path}: boundary\.csv: .*{message}") as refusal:
        imported(tmp_path)
    assert refusal.value.key == key


def test_lengths_of_tip_are_optional_and_above_zero(reduced_files, imported, tmp_path):
    shutil.copytree(reduced_files, tmp_path, dirs_exist_ok=True)
    table = pd.read_csv(tmp_path / "boundary.csv")
    table.drop(columns="tip_length").to_csv(tmp_path / "boundary.csv", index=False)
    assert imported(tmp_path).contact_tip_lengths.sum() == pytest.approx(table["tip_length"].sum(), rel=0.2)
    table.loc[2, "tip_length"] = 0.0
    table.to_csv(tmp_path / "boundary.csv", index=False)
    with refused(r"boundary\.csv: contact node 3 must have .* tip_length, a length above 0"):
        imported(tmp_path)


@pytest.mark.parametrize("size", [1e-6, 1.0, 1e9])
def test_a_matrix_is_judged_whatever_its_unit(tmp_path, size):
    """Symmetric to a part in 1e8 of its largest entry, which is a number above 0."""
    matrix = size * SMALL

    def beside(share):
        return np.where(np.eye(24, k=1) > 0.0, share * matrix.max(), matrix)

    mmwrite(tmp_path / "M.mtx", beside(1e-9))
    assert read_matrix(tmp_path / "M.mtx").shape == (24, 24)
    broken = {"not symmetric": [beside(1e-6)], "some are no numbers": [beside(np.inf), beside(np.nan)]}
    for message, cases in (broken | {"all entries are 0": [0.0 * matrix]}).items():
        for case in cases:
            mmwrite(tmp_path / "M.mtx", case)
            with refused(rf"^M\.mtx: .*{message}"):
                read_matrix(tmp_path / "M.mtx")


@pytest.mark.parametrize(
    ("header", "message"),
    [
        ("", r"^M\.mtx: cannot be read as a matrix of Matrix Market \(.*banner\.\)$"),
        (
            "%%MatrixMarket matrix coordinate real general\n",
            "not symmetric; allowed: both triangles, or one with `symmetric` in",
        ),
    ],
)
def test_matrices_of_other_programs(tmp_path, header, message):
    """Without the first line, or with one triangle in a file that says it has both."""
    rows = "24 24 47\n" + "".join(f"{i} {i} 4.0\n" for i in range(1, 25)) + "".join(f"{i + 1} {i} 1.0\n" for i in range(1, 24))
    (tmp_path / "M.mtx").write_text(header + rows)
    with refused(message):
        read_matrix(tmp_path / "M.mtx")
    (tmp_path / "M.mtx").write_text("%%MatrixMarket matrix coordinate real symmetric\n" + rows)
    assert read_matrix(tmp_path / "M.mtx").sum() == 24 * 4.0 + 2 * 23


def test_matrices(model, imported, tmp_path):
    write_reduced_matrices(model, (0.0, 1000.0, 2000.0), tmp_path)
    wrong = replace(OURS, rotation="positive")
    with refused(rf"boundary\.csv: found the tip's {ANGLES}") as refusal:
        imported(tmp_path, orientation=wrong)
    assert refusal.value.key == "rotation"
    imported(tmp_path, orientation=wrong, sense_check=False)
