"""Calls of r37 over several runs, what they say of changes, and the examples of all docstrings."""

import doctest
import inspect
import json
import re
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from workflow_runs import copy_finished

import r37
from r37core.base.dataset_file import write_dataset
from r37core.results.table_file import write_table

SPEEDS = [750.0, 1150.0, 1550.0]
CALLS = [name for name in r37.__all__ if inspect.isfunction(getattr(r37, name))]


@pytest.fixture(scope="module")
def finished(small_sweep, warm_calls, tmp_path_factory):
    """A sweep of the workflow, whose configuration is the shipped one of the calls."""
    folder = copy_finished(small_sweep, tmp_path_factory.mktemp("finished") / "sweep")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("r37.call_configuration._PACKAGE", folder)
        patch.chdir(folder)
        yield folder


@pytest.mark.slow
def test_a_comparison_is_the_sweep_of_the_workflow(finished):
    again = r37.run(["Ref", "CS100"], ["abradable", "direct"], SPEEDS, cores=2)
    results = r37.open_results(finished / "results")
    assert list(again) == list(results) and list(again.tables) == list(results.tables)
    for name, dataset in results.items():
        xr.testing.assert_identical(again[name], dataset)
    for name, table in results.tables.items():
        pd.testing.assert_frame_equal(again.tables[name], table)


@pytest.fixture(scope="module")
def examples(finished):
    """The package for all examples: a run that is asked for once more is the one that was made."""
    made = {}

    def run(*arguments, **named):
        key = repr((arguments, named))
        if key not in made:
            made[key] = r37.run(*arguments, **named)
        return made[key]

    return SimpleNamespace(**{name: getattr(r37, name) for name in r37.__all__} | {"run": run})


@pytest.mark.slow
@pytest.mark.parametrize("name", CALLS)
def test_the_example_of_a_docstring_runs(examples, name, tmp_path, monkeypatch):
    """With the small level in place of others: what an example shows holds for both."""
    (test,) = doctest.DocTestFinder(recurse=False).find(inspect.unwrap(getattr(r37, name)), name, globs={"r37": examples})
    assert test.examples
    if name == "init":
        monkeypatch.chdir(tmp_path)
    if name == "lining_from_rub_test":
        # its scene is one that the small configuration does not have
        monkeypatch.setattr("r37.call_configuration._PACKAGE", Path(r37.__file__).parent)
    for example in test.examples:
        example.source = example.source.replace('fidelity="draft"', 'fidelity="tiny"')
    told = []
    assert doctest.DocTestRunner(optionflags=doctest.ELLIPSIS).run(test, out=told.append).failed == 0, "".join(told)


@pytest.mark.parametrize("name", CALLS)
def test_a_docstring_says_what_a_call_takes(name):
    call = getattr(r37, name)
    _, _, section = inspect.getdoc(call).partition("Args:\n")
    entries = re.findall(r"^    (\S.*?): \S", section.partition("\n\n")[0], re.MULTILINE)
    described = [part.strip("* ") for entry in entries for part in entry.split(",")]
    assert described == list(inspect.signature(call).parameters)


def test_blades_of_two_files_are_told_how_to_come_together(root, tmp_path):
    file = tmp_path / "blades.yaml"
    file.write_text("Other: { base: Ref }\n" + (root / "config/blades.yaml").read_text().replace("config/", f"{root}/config/"))
    with pytest.raises(r37.ConfigError, match="blades of one file; write them into one: r37 init <folder> gives the shipped"):
        r37.run(["Ref", r37.blade("Other", file=file)], "direct", [9])


@pytest.mark.slow
def test_what_was_changed_is_told(finished):
    swept = r37.blade("Ref", chordwise_sweep_deg=np.float64(10))
    smooth = r37.scene("direct", **{"friction.coefficient": 0.05})
    label = "Ref, chordwise_sweep_deg=10.0"
    diagram = r37.campbell(swept)
    assert diagram.attrs["blade"] == label and json.loads(diagram.attrs["blade_changes"]) == {"chordwise_sweep_deg": 10.0}
    assert r37.plot_campbell(diagram).axes[0].get_title() == f"Campbell diagram, blade {label}"
    response = r37.simulate(swept, smooth, 1150, results=[])
    assert response.attrs["blade"] == label and response.attrs["scene"] == "direct, friction.coefficient=0.05"
    assert label in r37.plot_response(response).axes[0].get_title()
    # a name changes no number
    named = r37.blade("Ref", chordwise_sweep_deg=10, name="Swept")
    assert r37.campbell(named).equals(diagram)
    assert json.loads(r37.campbell(named).attrs["blade_changes"]) == {"base": "Ref", "chordwise_sweep_deg": 10}
    assert r37.plot_campbell(r37.campbell(named)).axes[0].get_title().endswith("blade Swept")
    plain = r37.campbell("Ref").attrs
    assert plain["blade"] == "Ref" and "blade_changes" not in plain


def test_a_named_copy_is_the_blade(finished):
    for name in ("Ref", "S100", "CS50"):
        copied, original = (
            (blade.definition.stacking, blade.material, blade.contact)
            for blade in (r37.blade(name, name="Copy").settings, r37.blade(name).settings)
        )
        assert copied == original
    text = (finished / "config/blades.yaml").read_text().replace("S50: {", "S50: { sweep_percent: 50,")
    Path("halved.yaml").write_text(text)
    with pytest.raises(r37.ConfigError, match="name: found sweep_percent of a copy of S50, whose table has a share already"):
        r37.blade("S50", file="halved.yaml", sweep_percent=80, name="Less")
    assert r37.blade("S50", file="halved.yaml", sweep_percent=80).settings.definition.stacking
    Path("turned.yaml").write_text(text.replace("sweep_percent: 50,", "stagger_deg: { tip: 1 },"))
    with pytest.raises(r37.ConfigError, match="stagger_deg of a copy of S50, which has a value of it already"):
        r37.blade("S50", file="turned.yaml", **{"stagger_deg.tip": 2}, name="More")


@pytest.mark.slow
def test_speeds_may_be_rpm(finished):
    in_rpm = r37.sweep("Ref", "abradable", speeds_rpm=[11000, 12000])
    np.testing.assert_allclose(in_rpm["speed"], np.array([11000, 12000]) * np.pi / 30)
    xr.testing.assert_identical(r37.simulate("Ref", "abradable", speed_rpm=11000), in_rpm.isel(speed=0))


def test_a_scene_may_leave_out_its_lining():
    bare = r37.scene("abradable", lining=None, results=["stress"])
    assert bare.entry.lining is None and bare.entry.friction is not None
    assert r37.scene("abradable", lining=None, results=["stress"], name="Bare").entry == bare.entry
    assert "lining=None" in bare.label
    # one that is left out already
    assert r37.scene("direct", lining=None).entry == r37.scene("direct").entry
    assert r37.blade("Ref", **{"stagger_deg.tip": None}).settings == r37.blade("Ref").settings


@pytest.mark.parametrize(
    ("key", "value", "told"),
    [
        ("density_kg_m3", 8.0, "found 8; alloys and composites have 1000 to 20000: check its unit"),
        ("yield_stress_pa", 1380.0, r"found 1380; alloys and composites have 1e\+07 to 5e\+09"),
    ],
)
def test_a_material_of_other_units_is_told(finished, monkeypatch, key, value, told):
    monkeypatch.setattr("r37.simulations.response_file", None)
    with pytest.warns(UserWarning, match=rf"Ref: material\.{key}: {told}"), pytest.raises(TypeError):
        r37.simulate(r37.blade("Ref", **{f"material.{key}": value}), "abradable", 1500)


def test_speeds_beyond_the_models_are_told(finished, monkeypatch):
    """Before anything is computed."""
    monkeypatch.setattr("r37.simulations.response_file", None)
    told = "speeds: up to 3141.59 rad/s, and structure.maximum_speed_rad_s is 2000: .*raise it to what is run$"
    with pytest.warns(UserWarning, match=told) as warned, pytest.raises(TypeError):
        r37.sweep("Ref", "abradable", speeds_rpm=[30000])
    assert warned[0].filename == __file__


@pytest.mark.parametrize(
    ("stage", "call"),
    [
        ("simulations.structure_file", lambda blade: r37.campbell(blade)),
        ("simulations.response_file", lambda blade: r37.sweep(blade, "abradable", [9])),
        ("runs.write_run", lambda blade: r37.run(blade, "abradable", [9])),
    ],
)
def test_remarks_point_at_the_line_of_the_caller(finished, monkeypatch, stage, call):
    monkeypatch.setattr(f"r37.{stage}", None)
    light = r37.blade("Ref", name="Light", **{"material.density_kg_m3": 8.0})
    with pytest.warns(UserWarning, match="density_kg_m3: found 8") as warned, pytest.raises(TypeError):
        call(light)
    assert {warning.filename for warning in warned if warning.category is UserWarning} == {__file__}


@pytest.mark.slow
def test_a_design_is_the_changed_blade(examples):
    family = r37.blade("S100", name="Sweep", vary={"sweep_percent": [50, 100]})
    results = examples.run(family, "abradable", [1150], fidelity="tiny")
    assert results.tables["designs"]["blade"].tolist() == ["Sweep_50", "Sweep_100"]
    alone = r37.sweep(r37.blade("S100", sweep_percent=50), "abradable", [1150])
    assert alone.equals(results.response("Sweep_50", "abradable"))


@pytest.mark.slow
def test_a_rotor_of_a_scene(examples):
    """Numbers of the worst blade are those of the sweep; the joined dataset has them all."""
    scene = r37.scene("abradable", name="three", rotor={"blades": 3}, results=["stress"])
    results = examples.run("Ref", scene, [1550], fidelity="tiny")
    of_scene, response = results.rotor("Ref", "three"), results.response("Ref", "three")
    gathered = results["rotor"].set_index(run="speed").rename(run="speed").sel(speed=of_scene["speed"])
    np.testing.assert_array_equal(gathered["blade_rms"], of_scene["blade_rms"])
    assert results.tables["rotors"]["blades"].tolist() == [3] and "rotor" in results.tree()["Ref/three"].children
    # the response has the largest of any blade in each direction, the rotor that of both directions together
    normal, tangential = (response[f"rms_{name}"].sel(tip_point="leading_edge").values for name in ("normal", "tangential"))
    largest = of_scene["blade_rms"].max("blade_number").values
    assert (largest >= np.maximum(normal, tangential)).all() and (largest <= np.hypot(normal, tangential) * (1 + 1e-12)).all()
    stress = of_scene["blade_max_von_mises_ever"].max("blade_number")
    np.testing.assert_allclose(stress, response["max_von_mises_ever"].sel(region="airfoil"), rtol=1e-6)
    assert "three: a rotor of 3 blades" in r37.plot_rotor(of_scene.isel(speed=0)).get_suptitle()


@pytest.mark.slow
def test_all_that_a_run_has_is_reached(finished, tmp_path):
    """A table or dataset of an extension is one more file: here empty ones beside those of the sweep."""
    folder = copy_finished(finished / "results", tmp_path / "results")
    for name in ("run_ups", "tolerances"):
        write_dataset(xr.Dataset({"x": 1.0}), folder / f"{name}.nc")
    for name in ("designs", "run_ups"):
        write_table(pd.DataFrame({"blade": ["1e5"], "x": [1.0]}), folder / f"{name}.csv")
    write_dataset(xr.Dataset({"x": 2.0}), folder / "Ref/abradable/signals.nc")
    results = r37.open_results(folder)
    assert list(results) == ["campbell", "rms", "run_ups", "spectrum", "stress", "tolerances", "wear"]
    assert list(results.tables) == ["designs", "ranking", "run_ups", "summary"]
    assert results.tables["designs"]["blade"][0] == "1e5" and results["run_ups"]["x"] == 1.0
    assert results.signals("Ref", "abradable")["x"] == 2.0
    assert results["rms"] is results["rms"] and results.response("Ref", "direct").attrs["scene"] == "direct"
    assert results.ranking["rank"].dtype == "Int64" and results.summary is results.tables["summary"]
    with pytest.raises(KeyError, match=r"found 'designs'; allowed: campbell, .*datasets, next to results.tables, in "):
        results["designs"]
    with pytest.raises(KeyError, match=r"found 'strss'; allowed: campbell, rms.*did you mean stress"):
        results["strss"]
    tree = results.tree()
    assert set(tree.children) == {*results, "Ref", "CS100"}
    assert tree["Ref/abradable/signals"]["x"] == 2.0
    for blade in ("Ref", "CS100"):
        xr.testing.assert_identical(tree[f"{blade}/direct/response"].to_dataset().load(), results.response(blade, "direct"))


@pytest.mark.slow
def test_what_an_instrument_sees_is_what_signals_spectrum_and_wear_have(finished, tmp_path):
    """Strain, tip timing, trailing edge, an engine order and the worn depth, each by the other way to the same number."""
    tables = {"strain.csv": "a_microstrain", "length.csv": "a_mm"}
    for name, column in tables.items():
        (tmp_path / name).write_text(f"speed_rad_s,{column}\n{SPEEDS[0]},1\n")
    shared = {"blade": "Ref", "scene": "abradable", "uncertainty_percent": 10, "statistic": "half_peak_to_peak"}
    strain, length = ({**shared, "file": str(tmp_path / name)} for name in tables)
    gauge = {"chord": 0.5, "span": 0.3, "side": "pressure", "angle_deg": 0.0}
    measured = [
        {**strain, "quantity": "strain", "gauge": "G1"},
        {**length, "quantity": "tip_timing", "probe_deg": 30.0},
        {**length, "quantity": "displacement_normal", "tip_point": "trailing_edge"},
        {**length, "quantity": "displacement_normal", "statistic": "order", "engine_order": 4},
        {**length, "quantity": "worn_depth"},
    ]
    signals = {"speeds_rad_s": SPEEDS[:1], "gauges": {"G1": gauge}, "probes_deg": [30.0]}
    results = r37.run("Ref", "abradable", SPEEDS[:1], measured=measured, signals=signals)
    run = results.signals("Ref", "abradable").isel(speed=0)
    later = run.sel(turn=run.turn > 0.5 * run.turn.max())
    arrivals = run.arrival_displacement.isel(tip_point=0, probe=0)
    arrivals = arrivals[arrivals.sizes["revolution"] // 2 :]
    of_runs = results["spectrum"].amplitude.sel(blade="Ref", scene="abradable", engine_order=4), results["wear"].max_wear
    expected = [0.5 * float(each.max() - each.min()) for each in (later.strain[0], arrivals, later.normal[1])]
    expected += [float(each.squeeze()) for each in of_runs]
    np.testing.assert_allclose(results.tables["measured"]["simulated"], expected, rtol=1e-5)
