"""A mesh that is one sector of a disc: its faces, nodal diameters, and a rub of one blade on it."""

import runpy
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import yaml
from box_mesh import TITANIUM
from defaults import BoundaryChoice, Casing, IntegrationChoice
from import_defaults import refused
from integration_cases import ABRADABLE, DIRECT
from integration_runs import whole_run
from refusal_tables import pattern_of, refusal_rows

from r37core.fem.matrices import assemble
from r37core.fem.orientation import Orientation
from r37core.mesh.mesh_files import read_vtu, write_vtu
from r37core.results.campbell import campbell_dataset, gather_blades
from r37core.results.spectral_lines import crossing_of
from r37core.rom.reduce import reduce_blade
from r37core.rom.reduced_model import contact_model
from r37core.rom.reduction_choice import ReductionChoice
from r37core.rom.rom_file import read_reduced_model, write_reduced_model
from r37imports.importing.import_mesh import import_mesh
from r37imports.importing.source import CyclicFaces, MeshSource, Where

EXAMPLE = Path(__file__).parents[2] / "examples/blisk"
AXES = Orientation("m", (0.0, 0.0, 1.0), (1.0, 0.0, 0.0), "negative")
BLISK = MeshSource("sector.msh", AXES, Where(("bore",)), Where(("tip",)), hub_zr=((-0.1, 0.17), (0.1, 0.17)), sense_check=False)


SECTORS = 12
BOUNDARY, REDUCTION = BoundaryChoice(nodes=4), ReductionChoice((0.0, 750.0, 1500.0), 6)


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    """The folder with the mesh of the example's sector, coarse."""
    folder = tmp_path_factory.mktemp("blisk")
    runpy.run_path(str(EXAMPLE / "sector.py"))["mesh_sector"](str(folder / "sector.msh"), SECTORS, 0.014)
    return folder


@pytest.fixture(scope="module")
def sector(file):
    return import_mesh(replace(BLISK, cyclic=CyclicFaces(SECTORS)), file)[0]


@pytest.fixture(scope="module")
def model(sector):
    return reduce_blade(sector, assemble(sector, TITANIUM), TITANIUM, BOUNDARY, REDUCTION, {})


@pytest.mark.parametrize("cyclic", [{"low": "low", "high": "high"}, {"low": "high", "high": "low"}, {"low": "?"}])
def test_faces_are_paired(sector, file, cyclic, tmp_path):
    mesh, quality = import_mesh(replace(BLISK, cyclic=CyclicFaces(SECTORS, **cyclic)), file)
    np.testing.assert_array_equal(*(np.unique(part.cyclic, axis=0) for part in (mesh, sector)))
    write_vtu(mesh, tmp_path / "mesh.vtu", quality)
    np.testing.assert_array_equal(read_vtu(tmp_path / "mesh.vtu").cyclic, mesh.cyclic[np.argsort(mesh.cyclic[:, 0])])


@pytest.mark.parametrize(("kind", "cyclic", "message"), refusal_rows(Path(__file__).with_name("refusals.txt"), "cyclic"))
def test_faces_that_do_not_match_are_refused(file, kind, cyclic, message):
    with refused(rf"sector\.msh: .*{pattern_of(message)}") as caught:
        import_mesh(replace(BLISK, cyclic=CyclicFaces(**{"sectors": SECTORS} | yaml.safe_load(cyclic))), file)
    assert caught.value.key == "cyclic"


def test_a_root_ends_alike_at_both_faces(file):
    with refused(r"sector\.msh: .*have one clamped node .* such as the bore") as caught:
        import_mesh(replace(BLISK, cyclic=CyclicFaces(SECTORS), root=Where(("low",)), end_check=False), file)
    assert caught.value.key == "root"


def test_frequencies_have_nodal_diameters(model, tmp_path):
    """Those of the highest are the blade's; an engine order crosses the nodal diameter that it excites."""
    write_reduced_model(model, tmp_path / "rom.nc")
    model, speeds = read_reduced_model(tmp_path / "rom.nc"), np.linspace(0.0, 1500.0, 16)
    choice = {"speeds": speeds, "modes": 5, "highest_engine_order": 14, "largest_tangential_displacement": 0.01}
    campbell = campbell_dataset(model, tip_line="pressure_edge", **choice)
    nodal = campbell["nodal_frequency"]
    np.testing.assert_array_equal(nodal.sel(nodal_diameter=6), campbell["frequency"])
    np.testing.assert_allclose(campbell["blade_likeness"].sel(nodal_diameter=6), 1.0)
    # the disc softens the blade, most where it moves most
    assert np.all(campbell["disc_frequency"].diff("disc_mode") >= 0.0)
    first = nodal.sel(mode="1B", speed=0.0)
    assert first.sel(nodal_diameter=6) > first.sel(nodal_diameter=5) > first.sel(nodal_diameter=4)
    for order, diameter in ((5, 5), (7, 5), (8, 4)):
        speed = float(campbell["crossing_speed"].sel(mode="1B", engine_order=order))
        assert 2 * np.pi * float(nodal.sel(mode="1B", nodal_diameter=diameter).interp(speed=speed)) == pytest.approx(
            order * speed, rel=1e-3
        )
        assert crossing_of(campbell, "1B", order) == pytest.approx(speed, rel=1e-9)
    alone = campbell.drop_dims(["nodal_diameter", "disc_mode"]).drop_vars("sectors")
    for number, part in enumerate((campbell, alone)):
        part.to_netcdf(tmp_path / f"{number}.nc")
    both = gather_blades(["Disc", "Alone"], [tmp_path / "0.nc", tmp_path / "1.nc"])
    for blade, order, own in (("Disc", 8, campbell), ("Alone", 8, alone)):
        assert crossing_of(both.sel(blade=blade), "1B", order) == pytest.approx(crossing_of(own, "1B", order))
    assert crossing_of(both.sel(blade="Disc"), "1B", 8) != pytest.approx(crossing_of(alone, "1B", 8), rel=1e-3)


@pytest.mark.slow
def test_a_rub_on_a_stiff_disc_is_that_of_the_clamped_blade(sector, model):
    """All of the disc clamped; on the disc itself the motion differs."""
    rim = np.flatnonzero(np.hypot(*sector.points[:, :2].T) < 0.17 + 1e-6)
    stiff = replace(sector, node_sets=dict(sector.node_sets) | {"root": rim})
    choice = IntegrationChoice(4e-7, 3, 100, highest_frequency=12e3, integrator="exact_modal")
    meshes = (stiff, replace(stiff, cyclic=None))
    models = [model, *(reduce_blade(mesh, assemble(mesh, TITANIUM), TITANIUM, BOUNDARY, REDUCTION, {}) for mesh in meshes)]
    for scene in (DIRECT, ABRADABLE):
        rubbed = replace(scene, casing=Casing(5e-5, height=7e-5, rise_fraction=0.2))
        numbers = []
        for each in models:
            _, state, record = whole_run(contact_model(each, "pressure_edge"), 1100.0, rubbed, choice)
            numbers.append(np.sqrt(np.mean(record.samples**2)))
            assert state.totals["steps_in_contact"] > 0
        disc, held, clamped = numbers
        assert held == pytest.approx(clamped, rel=0.01)
        assert abs(disc / clamped - 1.0) > 0.02
