"""Cases: runs of one blade beside the sweep, each with a model, scene or time integration of its own."""

import json
import re
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from defaults import IntegrationChoice
from integration_cases import ABRADABLE, DIRECT, random_model, with_static_modes

from r37core.base.dataset_file import read_dataset, write_dataset
from r37core.base.io import Named, read_json
from r37core.base.plain import from_plain, to_plain
from r37core.cases import runner
from r37core.cases.case import MODEL_NAME, OWN_MESH, Case, ModelChoice, model_of_name
from r37core.cases.runner import crossing_speed, run_case, run_case_of_files
from r37core.cases.steps import model as model_step
from r37core.mesh.mesh_files import write_vtu
from r37core.rom.contact_model import read_contact_model
from r37core.stress.recovery import stress_operator
from r37core.time_integration.compiled.engine import _program
from r37core.time_integration.problem import Problem
from r37core.time_integration.speed_run import run_speed


def case_of(choice, scene=DIRECT, speeds=(1500.0,), results=("energy",), **fields):
    kept = {"spectrum_highest_order": 12, "wear_angles": 100}
    return Case("Ref", "pressure_edge", scene, choice, speeds, results, None, kept, **fields)


def test_cases_are_planned_without_what_runs_them():
    """The rules import the plans each time that Snakemake starts."""
    modules = [f"r37core.{name}.plan" for name in ("cases", "tradeoff", "stability", "estimate")]
    code = f"import sys, {', '.join(modules)}; print(*{{'netCDF4', 'matplotlib', 'xarray', 'pyvista'}} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == ""


def test_a_case_is_plain_data():
    lined = replace(ABRADABLE, friction=None)
    case = case_of(IntegrationChoice(2e-7, 4, 62), lined, crossing=("1B", None), history_speeds=(1500.0,))
    for each in (
        case,
        replace(case, model=ModelChoice(5000, 8, 10, "submesh", "camber", "corners"), scene=None, refused="why"),
    ):
        assert from_plain(Case, json.loads(json.dumps(to_plain(each)))) == each
    with pytest.raises(ValueError, match="allowed: ascending, none twice"):
        replace(case, speeds=(1.0, 0.9))


def test_a_model_has_the_name_of_its_choice():
    for values in ((5000, 8, 0, "submesh", "pressure_edge", "corners"), (OWN_MESH, 2, 10, "whole", "camber", "inside")):
        choice = ModelChoice(*values)
        assert re.fullmatch(MODEL_NAME, choice.name) and model_of_name(choice.name) == choice


def test_a_case_of_a_model_that_the_mesh_cannot_have_is_refused(mesh, steel, choice, tmp_path):
    names = {"rom": "rom.nc", "contact": "contact.npz", "cost": "cost.json"}
    files = {name: str(tmp_path / file) for name, file in names.items()}
    write_vtu(mesh, tmp_path / "mesh.vtu", np.ones(sum(map(len, mesh.blocks.values()))))

    def make(nodes):
        wanted = ModelChoice(OWN_MESH, nodes, 3, "submesh", "pressure_edge", "corners")
        params = {"choice": to_plain(wanted), "reduction": to_plain(choice), "material": to_plain(steel), "provenance": {}}
        model_step(Named(mesh=str(tmp_path / "mesh.vtu")), Named(**files), Named(**params))

    make(3)
    assert len(read_contact_model(files["contact"]).radius) == 3 and read_json(files["cost"])["cpu_s"] > 0.0
    make(150)
    assert read_json(files["cost"]).keys() == {"refused"}
    run_case_of_files(case_of(IntegrationChoice(2e-7, 4, 62)), files, tmp_path / "case.nc")
    response = read_dataset(tmp_path / "case.nc")
    assert "150" in response.attrs["refused"] and response.sizes["speed"] == 0


def test_a_refused_case_needs_no_file(tmp_path):
    case = case_of(IntegrationChoice(2e-7, 4, 62), None, refused="Fan is given by a mesh; more")
    run_case_of_files(case, {}, tmp_path / "case.nc")
    assert read_dataset(tmp_path / "case.nc").attrs["refused"] == "Fan is given by a mesh"


def diagram(*speeds):
    """Crossings of 1B with the engine orders from 2 on, up to 2000 rad/s."""
    crossing = xr.DataArray([speeds], {"mode": ["1B"], "engine_order": range(2, 2 + len(speeds))})
    return xr.Dataset({"crossing_speed": crossing}, {"speed": [0.0, 2000.0]})


def test_without_an_order_the_fastest_crossing_inside_the_diagram_counts():
    crossings = diagram(np.nan, 1990.0, 1600.0, 1200.0)
    assert crossing_speed(crossings, "1B", 5, 1.0) == 1200.0
    assert crossing_speed(crossings, "1B", None, 1.0) == 1990.0
    assert crossing_speed(crossings, "1B", None, 1.1) == 1600.0
    # the only ones, though the speeds above them lie outside
    assert crossing_speed(diagram(np.nan, 1990.0), "1B", None, 1.1) == 1990.0


def test_a_crossing_that_is_not_there_is_named(tmp_path):
    """A blade may have none with an engine order."""
    write_dataset(diagram(np.nan, np.nan), tmp_path / "campbell.nc", {})
    case = case_of(IntegrationChoice(2e-7, 4, 62), speeds=(1.0,), crossing=("1B", 3))
    files = {"campbell": str(tmp_path / "campbell.nc")}
    with pytest.raises(ValueError, match=r"1B of Ref does not cross engine order 3 below .*; choose another engine_order"):
        run_case_of_files(case, files, tmp_path / "case.nc")
    with pytest.raises(ValueError, match="does not cross any engine order"):
        run_case_of_files(replace(case, crossing=("1B", None)), files, tmp_path / "case.nc")


def test_a_run_that_diverged_has_no_stress_at_instants(contact, model, steel, tmp_path):
    choice = IntegrationChoice(2e-7, 4, 62, snapshots_per_revolution=62)
    diverging = replace(DIRECT, divergence_limit=1e-6)
    case = replace(case_of(choice, diverging), results=("stress", "instants"), material=steel)
    run_case(case, contact, stress_operator(model, steel), tmp_path / "case.nc")
    response = read_dataset(tmp_path / "case.nc")
    assert response["status"].values.all() and response["max_von_mises_of_instant"].isnull().all()


def test_half_a_step_is_half_of_the_one_taken(contact, tmp_path):
    """A step far beyond the sampling instants is shortened to them: half of it would be shortened to the same."""
    case = case_of(IntegrationChoice(1e-5, 4, 620, integrator="exact_modal"), speeds=(1495.0, 1500.0))
    for name, half in (("case", False), ("half", True)):
        run_case(replace(case, half_step=half), contact, None, tmp_path / f"{name}.nc")
    steps = [read_dataset(tmp_path / f"{name}.nc")["time_step"].values for name in ("case", "half")]
    np.testing.assert_allclose(steps[0], 2.0 * np.pi / np.array([1495.0, 1500.0]) / 620)
    np.testing.assert_allclose(steps[1], 0.5 * steps[0], rtol=1e-12)


def test_modes_that_are_left_out(contact):
    problem = Problem(contact, 1500.0, DIRECT, IntegrationChoice(2e-7, 1, 62, highest_frequency=2e4))
    assert problem.blade.frequencies[-1] <= 2 * np.pi * 2e4
    assert 5 < len(problem.blade.frequencies) < len(contact.squared_frequencies)


@pytest.mark.slow
def test_no_priced_run_compiles(tmp_path, monkeypatch):
    """Two speeds whose modes, cut at a frequency, need programs of two layouts."""
    model = with_static_modes(replace(random_model(8), stiffness_per_square=1e8 * np.eye(24)), 1e-9)
    choice = IntegrationChoice(1e-6, 2, 62, integrator="exact_modal", highest_frequency=3e5, static_above=3.0)
    counts, compiled = [], []

    def timed(model, speed, scene, choice, *given, **kept):
        before = _program.cache_info().misses
        run = run_speed(model, speed, scene, choice, *given, **kept)
        counts.append(len(Problem(model, speed, scene, choice).blade.frequencies))
        compiled.append(_program.cache_info().misses - before)
        return run

    monkeypatch.setattr(runner, "run_speed", timed)
    runner.run_case(case_of(choice, speeds=(10.0, 180.0)), model, None, tmp_path / "case.nc")
    assert compiled == [0, 0]
    assert counts[1] <= counts[0] - 8
