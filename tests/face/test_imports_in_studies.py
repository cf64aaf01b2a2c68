"""Blades of other programs in the studies."""

from dataclasses import replace
from itertools import product
from types import SimpleNamespace

import numpy as np
import pytest
import yaml
from section_files import csv_text, fan, turbine
from test_imported_blades import MATRICES, MESH, settings_with, three  # noqa: F401
from test_sections import ENTRY, SHARES, definition_of
from workflow_runs import overlay

import r37
from r37.call_settings import call_of
from r37.run_folder import write_run
from r37core.base.plain import to_plain
from r37core.blade.definition import shape_from_plain
from r37core.blade.geometry_file import read_geometry, write_geometry
from r37core.fem.orientation import OURS
from r37core.plans.paths import filled
from r37core.plans.sweep_plan import Sweep
from r37core.product.extensions import read_settings
from r37core.product.targets import targets
from r37core.stress.gauge import Gauge
from r37imports.importing.import_mesh import blade_parameters
from r37studies.exports.plan import Exports
from r37studies.exports.plan import targets as exported_targets
from r37studies.gauges import gauge_rows
from r37studies.signals.plan import Signals
from r37studies.step_file import write_step
from r37studies.trials import stability, tradeoff
from r37studies.trials.plan import Trials


def test_gauges_of_an_imported_mesh(mesh):
    """Chord, span and sides found from the shape alone: some millimetres from those of the profiles, on the right side."""
    parameters, normals = blade_parameters(mesh.points, mesh.node_set("root"), mesh.node_set("tip"), True)
    imported = replace(mesh, parameters=parameters, normals=normals)
    gauges = [Gauge(*place, 0.0) for place in product((0.1, 0.5, 0.9), (0.1, 0.5, 0.9), ("pressure", "suction"))]
    ours, theirs = (gauge_rows(each, np.zeros((len(each.points), 3, 1)), gauges)[1] for each in (mesh, imported))
    assert np.linalg.norm(ours - theirs, axis=1).max() < 3e-3
    across = np.sum((ours[1::2] - ours[::2]) * (theirs[1::2] - theirs[::2]), axis=1)
    assert np.all(across > 0.0)


@pytest.mark.parametrize(
    ("entry", "config", "signals", "modes"),
    [
        (MESH, {}, ["Fan"], []),
        (MATRICES, {"# shapes: {": "shapes: { imported: true }\n#"}, ["Fan"], []),
        (MESH, {"# shapes: {": "shapes: { imported: true }\nsignals: { imported: false }\n#"}, [], ["Fan"]),
        (MESH, {"# shapes: {": "signals: { speeds_rad_s: [900] }\n#"}, ["Ref", "Fan"], []),
        (MESH, {"# shapes: {": "signals: { blades: [Ref] }\n#"}, [], []),
    ],
)
def test_a_blade_of_another_program_has_signals_at_its_interactions_and_modes_if_asked_for(
    settings_with, entry, config, signals, modes
):
    """The benchmark's own have none by default."""
    sweep = Sweep(settings_with(entry, config=config, blades=("Ref", "Fan")))
    wanted = targets(sweep)
    runs = [{"blade": blade, "scene": scene} for blade in signals for scene in ("abradable", "direct")]
    assert wanted["<results>/{blade}/{scene}/signals.nc"] == runs
    for pattern in ("<results>/shapes/{blade}/modes", "<results>/figures/shapes_{blade}.png"):
        assert wanted[pattern] == [{"blade": blade} for blade in modes]
    recorded = Signals(sweep)
    if not config:
        inputs = recorded.inputs(SimpleNamespace(blade="Fan", scene="direct"))
        assert recorded.speeds == [] and inputs["response"] == "<results>/Fan/direct/response.nc"


def test_a_geometry_file_and_a_rule_give_the_same_blade(tmp_path):
    shape = definition_of(turbine(), hub=((0.0, 0.301),), tip=((-0.1, 0.358), (0.1, 0.356)), pressure_forward=False)
    assert shape_from_plain(to_plain(shape)) == shape
    made = shape.build(round_edges=True)
    write_geometry(made, tmp_path / "geometry.nc")
    again = read_geometry(tmp_path / "geometry.nc")
    for thickness in (-1.0, 0.3, 1.0):
        parameters = SHARES, SHARES, np.full(9, thickness)
        np.testing.assert_array_equal(made.position(*parameters), again.position(*parameters))
    write_step(again, tmp_path / "surface.step")
    assert (tmp_path / "surface.step").stat().st_size > 10_000


def test_calls_from_python_know_such_a_blade(project):
    (project / "fan.csv").write_text(csv_text(fan()))
    overlay(project, "blades.yaml", yaml.safe_dump({"Fan": {"sections": "fan.csv", "kinematics": "linear", **ENTRY}}))
    diagram = r37.campbell("Fan", config=project / "config/config.yaml")
    first = float(diagram["frequency"].isel(speed=0, mode=0))
    assert 30.0 < first < 200.0 and diagram.attrs["contact"] == "patches"
    turned = r37.blade("Fan", config=project / "config/config.yaml", stagger_deg=2).settings.definition
    before = r37.blade("Fan", config=project / "config/config.yaml").settings.definition
    assert turned.curve(0).stagger - before.curve(0).stagger == pytest.approx(np.radians(2.0), abs=1e-5)


def test_the_folder_of_a_call_finds_sections_and_meridians(tmp_path):
    """Which lie next to the blades.yaml, and not in the folder."""
    own, folder = tmp_path / "own", tmp_path / "run"
    own.mkdir()
    (own / "fan.csv").write_text(csv_text(fan()))
    (own / "shroud.curve").write_text("0.0 0.449 -0.1\n0.0 0.449 0.1\n")
    ends = {"hub": "sections", "tip": "shroud.curve"}
    (own / "blades.yaml").write_text(yaml.safe_dump({"Fan": {"sections": "fan.csv", **ENTRY, **ends}}))
    call = call_of(
        "r37.run", [r37.blade("Fan", file=own / "blades.yaml")], ["direct"], {"speeds": [500]}, config=None, fidelity=None
    )
    write_run(call, folder)
    (entry,) = (entry for name, entry in yaml.safe_load((folder / "config/blades.yaml").read_text()).items() if name == "Fan")
    assert (entry["sections"], entry["tip"]) == (str(own / "fan.csv"), str(own / "shroud.curve")) and entry["hub"] == "sections"
    assert read_settings(folder).blades["Fan"].definition.tip is not None


def test_what_is_varied_of_matrices(settings_with):
    """The model is the run's own."""
    settings = settings_with(MATRICES)
    model = {"mesh_nodes", "boundary_nodes", "fixed_interface_modes", "stress_instants"}
    reasons = {name.partition("/")[0]: case for name, case in tradeoff.cases(settings).items() if isinstance(case, str)}
    assert reasons == dict.fromkeys(model, "Fan is given by matrices")
    inputs = Trials(settings).inputs(SimpleNamespace(preset="tradeoff", case="revolutions/25__direct"))
    assert inputs == {"contact": "<results>/Fan/contact_pressure_edge.npz", "campbell": "<results>/Fan/campbell.nc"}
    assert stability.cases(settings)["lobes/5__direct"].model == "pressure_edge"


def test_what_is_varied_of_a_mesh(settings_with):
    settings = settings_with(MESH)
    case = SimpleNamespace(blade="Fan", model=tradeoff.cases(settings)["revolutions/25__direct"].model.name)
    assert Trials(settings).shape(case) == {"mesh": "<results>/Fan/mesh.vtu"}
    assert tradeoff.cases(settings)["mesh_nodes/5000__direct"] == "Fan is given by a mesh"


def test_plan_of_exports(three):
    _, sweep = three
    exports = Exports(sweep)
    files = {file.removeprefix("<results>/exports/") for file in filled(exported_targets(exports.sweep))}
    assert {"Ref/surface.step", "Ref/modes", "Fan/mesh.msh", "Fan/stress_direct", "Given/matrices"} <= files
    assert not files & {"Fan/surface.step", "Given/mesh.msh", "Given/modes", "Given/stress_direct"}
    fan = SimpleNamespace(blade="Fan", scene="direct", tip_line="camber")
    structure = Sweep(sweep.settings)
    assert structure.whole_blade_model(fan) == "<results>/Fan/whole_blade_pressure_edge.nc"
    assert structure.boundary(fan)["tip_line"] == "camber"
    assert exports.orientation(fan)["length_unit"] == "mm"
    assert exports.orientation(SimpleNamespace(blade="Ref")) == to_plain(OURS)
    assert exports.choice["mode_speeds"] == (0.0, 2000.0)
