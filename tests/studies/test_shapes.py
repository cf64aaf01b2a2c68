"""Shapes: files of modes and worst instants against what they are made of, and stills of them."""

from dataclasses import replace

import numpy as np
import pytest
import pyvista

from r37core.base.io import read_json, write_json
from r37core.fem.surface import outer_faces
from r37core.figures.style import save
from r37core.stress.operator import von_mises
from r37core.stress.recovery import stress_operator
from r37studies.fields import Target, WorstInstant, displacement_of, mode_shapes, stress_of, write_modes
from r37studies.shapes.stills import draw_modes, draw_worst_instants
from r37studies.shapes.worst_shapes import INDEX, LARGEST_SHOWN, write_worst_shapes


@pytest.fixture(scope="module")
def modes(whole, mesh, steel, tmp_path_factory):
    """Folder with four modes at rest and their stress."""
    folder = tmp_path_factory.mktemp("modes")
    write_modes(mesh, whole, [0.0], 4, Target(folder), steel)
    return folder


def test_modes_have_their_stress(whole, mesh, steel, modes):
    """That of the vibration in the mode's shape alone."""
    names, _, displacements = mode_shapes(whole, 0.0, 4)
    assert names == ("1B", "1T", "2B", "4")
    fields = pyvista.read(modes / "modes_0.vtu").point_data
    coordinates = whole.modes(0.0, 8)[1].T
    for number, (name, displacement) in enumerate(zip(names, displacements, strict=True)):
        np.testing.assert_array_equal(fields[f"mode {name}"], displacement)
        expected = von_mises(stress_of(mesh, whole, steel, WorstInstant(0.0, coordinates, number), 0.0)[1])
        np.testing.assert_allclose(fields[f"von Mises stress of mode {name}"], expected)


@pytest.fixture(scope="module")
def instant(whole, steel):
    """A revolution in which two modes swing, the first three times and the second twice."""
    angle = 2.0 * np.pi * np.arange(62) / 62
    shapes = whole.modes(0.0, 2)[1].T
    revolution = 2e-4 * (np.outer(np.sin(3 * angle), shapes[0]) + 0.2 * np.outer(np.cos(2 * angle), shapes[1]))
    stress = stress_operator(whole, steel).max_von_mises(revolution)
    number = int(np.argmax(stress))
    return WorstInstant(float(stress[number]), revolution, number)


@pytest.mark.parametrize(("share", "marks"), [(0.99, ["above yield, not linear"]), (1.01, [])])
def test_worst_instants_have_a_title_and_a_magnification(whole, mesh, steel, instant, tmp_path, share, marks):
    """The largest displacement of the revolution is at most a tenth of the blade's height; stress above yield is marked."""
    material = replace(steel, yield_stress=share * instant.largest)
    write_worst_shapes(mesh, whole, material, {1150.5: instant}, {1150.5: "1B/4"}, tmp_path)
    (entry,) = read_json(tmp_path / INDEX)
    assert (tmp_path / entry["file"]).exists() and (tmp_path / "stress.pvd").exists()
    assert entry["title"][:2] == ["1B/4", "at 1150.5 rad/s (10986 rpm):"]
    assert entry["title"][2] == f"largest von Mises stress of the region {1e-6 * instant.largest:.0f} MPa"
    assert entry["title"][3:] == [*marks, f"shown {entry['magnification']:g} times as large"]
    corners = np.concatenate([part.nodes[:, : part.corners].ravel() for part in outer_faces(mesh.blocks)])
    shown = entry["magnification"] * displacement_of(whole, instant.revolution)[:, corners]
    share_of_height = np.linalg.norm(shown, axis=2).max() / np.ptp(np.hypot(*mesh.points[:, :2].T))
    assert 0.5 * LARGEST_SHOWN < share_of_height <= LARGEST_SHOWN


def test_stills(whole, mesh, steel, modes, instant, tmp_path):
    titles = {900.0: "1B/7, abradable", 1150.5: "1B/5, abradable"}
    write_worst_shapes(mesh, whole, steel, dict.fromkeys(titles, instant), titles, tmp_path)
    for figure, panels in ((draw_modes(modes), 8), (draw_worst_instants(tmp_path), 2)):
        assert len([axes for axes in figure.axes if axes.get_title()]) == panels
        files = [tmp_path / f"still.{suffix}" for suffix in ("png", "pdf")]
        save(figure, files, "Caption.")
        picture = np.asarray(pyvista.read(files[0]).point_data.active_scalars)
        assert len(np.unique(picture, axis=0)) > 200
        assert b"/FontFile" in files[1].read_bytes()
    write_json([], tmp_path / INDEX)
    (axes,) = draw_worst_instants(tmp_path).axes
    assert axes.texts[0].get_text() == "no interaction that ran to its end"
