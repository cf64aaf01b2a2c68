"""The plan of a search and its steps from files to files; and searches whose variables are of scenes, too."""

import math
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
import xarray as xr
import yaml
from test_search import BLADES, SEARCH, START, choice, gave, searched, structure
from workflow_runs import overlay

from r37core.base.dataset_file import read_dataset, write_dataset
from r37core.base.io import Named, read_json, write_json
from r37core.base.plain import to_plain
from r37core.config import ConfigError
from r37core.config.changed_numbers import scene_numbers
from r37core.plans.samples import NOMINAL
from r37core.plans.sweep_plan import Sweep
from r37core.product.extensions import beside
from r37core.product.reading import read_settings
from r37core.search import steps
from r37core.search.dataset import search_dataset
from r37core.search.plan import Search, designs_of, remarks
from r37core.search.quantity import Quantity
from r37core.search.rounds import SearchRound, first_round, read_round, write_round
from r37core.stress.operator import StressOperator


def test_a_round_is_made_of_the_one_before_it_and_what_its_designs_gave(tmp_path):
    def propose(number, count, **inputs):
        file = tmp_path / f"round_{number}.json"
        steps.propose_round(Named(**inputs), Named(round=file), Named(choice=to_plain(choice()), round=number, number=count))
        return read_round(file)

    first = propose(0, 3)
    assert first == first_round(3, choice())
    for name in first.new:
        write_json({"refused": "crossed" if name == "d0001" else None}, tmp_path / name / "shape.json")
    shapes = [tmp_path / name / "shape.json" for name in first.new]
    steps.built(Named(shapes=shapes), Named(built=tmp_path / "built.json"), Named())
    assert read_json(tmp_path / "built.json") == {"d0001": "crossed"}
    unknown = {"lined": (None, None), "mass": (2.0, 0.0)}
    for name, measures in (("start", START), ("d0000", gave(first.new["d0000"])), ("d0002", unknown)):
        write_json(measures, tmp_path / name / "measures.json")
    files = {"before": tmp_path / "round_0.json", "built": tmp_path / "built.json", "start": tmp_path / "start/measures.json"}
    second = propose(1, 2, **files, measures=[tmp_path / name / "measures.json" for name in ("d0000", "d0002")])
    assert second == searched(choice(), (3, 2))[-1]


def test_all_designs_are_joined_and_the_best_written(tmp_path, monkeypatch):
    last = searched(choice())[-1]
    write_round(last, tmp_path / "round_3.json")
    dataset, table, best = (tmp_path / name for name in ("search.nc", "search.csv", "best"))
    params = Named(choice=to_plain(choice()), fidelity="draft")
    steps.join(Named(round=tmp_path / "round_3.json"), Named(dataset=dataset, table=table), params)
    search = read_dataset(dataset)
    xr.testing.assert_equal(search, search_dataset(last, choice()))
    assert search.attrs["fidelity"] == "draft" and len(search.attrs["input_hash"]) > 8
    rows = pd.read_csv(table, index_col="design")
    assert list(rows.index) == ["start", *last.tried] and rows.loc["d0001", "refused"] == "crossed"
    first, second = rows[rows["order"] > 0].sort_values("order").index[:2]

    monkeypatch.setattr(steps, "read_geometry", lambda file: file)
    monkeypatch.setattr(steps, "write_step", lambda shape, file: file.write_text(shape))
    entries = {"Ref": {"density": 1.0}, "Free": {"base": "Ref", "sweep_lean": [{"sweep_cm": 0.0}, {"sweep_cm": 0.0}]}}
    shapes = [f"search/{name}/Free/geometry.nc" for name in last.tried]
    steps.best(Named(dataset=dataset, shapes=shapes), Named(folder=best), Named(entries=entries, scenes={}, number=2))
    assert {file.name for file in best.iterdir()} == {"blades.yaml", "Free_best1.step", "Free_best2.step"}
    for name, place in ((first, 1), (second, 2)):
        assert (best / f"Free_best{place}.step").read_text() == f"search/{name}/Free/geometry.nc"
    text = (best / "blades.yaml").read_text()
    assert "blades='[Free, Free_best1, Free_best2]'" in text
    written = yaml.safe_load(text)
    assert list(written) == ["Ref", "Free", "Free_best1", "Free_best2"]
    tip, sweep = last.tried[first].values
    rows = [{"sweep_cm": 0.0}, {"sweep_cm": sweep}]
    assert written["Free_best1"] == {"base": "Ref", "sweep_lean": rows, "stagger_deg": {"tip": tip}}
    assert f"# {first}: lined {last.tried[first].quantities['lined'][0]:.4g} rad s-1; the start: lined 40 rad s-1" in text


def test_a_design_is_measured_by_its_structure_and_by_all_its_runs(tmp_path, monkeypatch):
    """The stress by rotation alone grows with the square of the speed where nothing stiffens; `b` has a diverged run."""
    lengths = {"a": 3.0, "a/0": 4.0, "a/1": 8.0, "b": math.nan}
    files = {name: str(tmp_path / f"{name.replace('/', '_')}.nc") for name in ("geometry", "campbell", *lengths)}
    write_dataset(xr.Dataset({"volume": 2.0}), files["geometry"])
    write_dataset(structure().campbell, files["campbell"])
    for name, length in lengths.items():
        write_dataset(xr.Dataset({"length": length}), files[name])

    def robustness(response, chance_scatter=True, operating=None):
        scatter = {"length_certain_scatter_rad_s": 0.5} if chance_scatter else {}
        return {"length_certain_rad_s": float(response["length"]), **scatter}

    operator = np.zeros((6, 1, 2))
    operator[0, 0] = 7.0, 1.0
    monkeypatch.setattr(steps, "robustness", robustness)
    monkeypatch.setattr(steps, "read_contact_model", lambda file: Named(rotation_stiffening=np.zeros(1)))
    monkeypatch.setattr(steps, "read_stress_operators", lambda file: {"one": StressOperator(operator, 1, "")})
    quantities = {
        "nominal": Quantity("length_certain_rad_s", ("a",)),
        "high": Quantity("length_certain_rad_s", ("a",), quantile=1.0),
        "lost": Quantity("length_certain_rad_s", ("b",)),
        "mass": Quantity("mass_kg"),
        "still": Quantity("static_stress_pa"),
        "slow": Quantity("static_stress_pa", speed=500.0),
        "flap": Quantity("frequency_hz", mode="1B", speed=500.0),
    }
    inputs = {name: files[name] for name in ("geometry", "campbell")} | {"responses": [files[name] for name in lengths]}
    params = {
        "quantities": to_plain(quantities),
        "scenes": {"a": 3, "b": 1},
        "density": 8000.0,
        "highest_speed": 1000.0,
        "operating": None,
    }
    steps.measure(Named(**inputs, contact="", stress=""), Named(measures=tmp_path / "measures.json"), Named(**params))
    measured = read_json(tmp_path / "measures.json")
    assert measured.pop("high") == [8.0, pytest.approx(math.sqrt(3.0), abs=0.2)]
    assert measured == {
        "nominal": [3.0, 0.5], "lost": [None, 0.5], "mass": [16000.0, 0.0], "still": [1e6, 0.0], "slow": [2.5e5, 0.0],
        "flap": [120.0, 0.0],
    }  # fmt: skip


def test_the_plan_asks_for_what_the_designs_of_a_round_need(config_copy, monkeypatch):
    """The second design cannot be built, and the third is no blade."""
    monkeypatch.chdir(config_copy)
    overlay(config_copy, "blades.yaml", BLADES)
    overlay(config_copy, "config.yaml", SEARCH)
    overlay(config_copy, "config.yaml", "{ scenes: [direct, abradable], search: { designs: 7, first: 3 } }")
    settings = read_settings(config_copy)
    results = settings.results / "search"
    write_round(SearchRound({"d0000": (0.5, 1.0), "d0001": (0.0, 2.0), "d0002": (0.0, 89.0)}), results / "round_0.json")
    write_round(SearchRound({"d0003": (0.1, 1.0)}), results / "round_1.json")
    write_round(SearchRound({"d0004": (0.2, 1.0)}), results / "round_2.json")
    for number, refused in enumerate(({"d0001": "crossed", "d0002": "no blade"}, {"d0003": "crossed"}, {})):
        write_json(refused, results / f"built_{number}.json")
    file, sweep = f"{results}/{{}}_{{}}.json".format, Sweep(settings, beside=beside(settings))
    search = Search(sweep, lambda number: file("round", number), lambda number: file("built", number))

    assert [search.number_of_designs(Named(round=number)) for number in range(4)] == [3, 2, 2, 0]
    assert search.last_round(None) == "<results>/search/round_3.json"
    assert search.round_inputs(Named(round=0)) == {}
    measures = "<results>/search/{}/measures.json".format
    assert search.round_inputs(Named(round="1")) == {
        "before": file("round", 0), "built": file("built", 0), "start": measures("start"), "measures": [measures("d0000")],
    }  # fmt: skip
    assert search.shapes(Named(round="0")) == [f"<results>/search/d000{n}/shape.json" for n in range(3)]
    built = [f"<results>/search/{name}/Free/geometry.nc" for name in ("d0000", "d0004")]
    assert search.shapes_of_all(None) == built

    made = {name: search.shape(Named(design=name)) for name in ("start", "d0000", "d0002")}
    for name, values in (("start", None), ("d0000", (0.5, 1.0))):
        definition = designs_of(settings).blade(name, values).definition
        assert made[name] == {"definition": to_plain(definition), "refused": None}
    assert made["d0002"]["definition"] is None and "stagger_deg" in made["d0002"]["refused"]
    measured = search.measured(Named(design="d0000"))
    assert list(measured) == ["geometry", "campbell", "contact", "stress", "responses"]
    (response,) = measured["responses"]
    assert response == "<results>/search/d0000/Free/abradable/response.nc"
    assert search.responses_of_scenes(Named(design="d0000")) == {"abradable": 1}
    assert search.density(Named(design="d0000")) == settings.blades["Free"].material.density
    assert remarks(settings)[0].startswith("search: 7 designs of 'Free' in rounds of 2, at most 3 simulations of each")
    assert search.budget(None) == [7, 3, 2] and search.designs.entry.best == 3


SCENES_ALONE = "scene.lining.thickness_m: [0.001, 0.004], scene.friction.coefficient: [0.05, 0.2]"
BOTH_SCENES = "objectives: { lined: { scenes: [abradable] }, bare: { scenes: [direct] } }"


def searched_settings(folder, variables, changes=""):
    """Settings of a search with these variables."""
    overlay(folder, "blades.yaml", BLADES)
    overlay(folder, "config.yaml", SEARCH)
    file = folder / "config/config.yaml"
    content = yaml.safe_load(file.read_text())
    content["search"] |= yaml.safe_load(f"{{ variables: {{ {variables} }}, {BOTH_SCENES} {changes} }}")
    file.write_text(yaml.safe_dump(content, sort_keys=False))
    return read_settings(folder)


def search_of(settings):
    return Search(Sweep(settings, beside=beside(settings)), str, str)


@pytest.mark.parametrize(
    ("variables", "message"),
    [
        ("scene.lining.thicknes_m: [1, 2]", "variables.scene.lining.thicknes_m: .*none of the scenes abradable, direct has; .*"
         "mean scene.lining.thickness_m"),
        ("scene.lining.thickness_m: [-1, 0.001]", "variables.scene.lining.thickness_m: scene 'abradable': found -1"),
        ("scene.damping_ratio: [0.001, 0.002]", "scene.damping_ratio with 0.0005 in 'abradable', 0.001 in 'direct'; allowed: "
         "scenes of the search that start at the same value"),
        ("scene.casing: [1, 2], scene.casing.clearance_m: [1, 2]", "scene.casing.clearance_m beside scene.casing"),
        ("casing.clearance_m: [1, 2]", "unknown key casing.clearance_m; .* in a search as scene.casing.clearance_m"),
    ],
)  # fmt: skip
def test_what_no_scene_has_or_can_have_is_refused(config_copy, variables, message):
    overlay(config_copy, "scenes.yaml", "direct: { damping_ratio: 0.001 }")
    with pytest.raises(ConfigError, match=rf"^config/config.yaml:\d+: .*{message}") as refusal:
        searched_settings(config_copy, variables)
    assert "\n" not in str(refusal.value)


def test_a_variable_of_scenes_changes_every_scene_that_has_it_and_no_model(config_copy):
    designs = designs_of(searched_settings(config_copy, SCENES_ALONE))
    assert designs.start_values == [0.005, 0.15]
    for name, values, thickness, friction in (("start", None, 0.005, 0.15), ("d0002", (0.002, 0.1), 0.002, 0.1)):
        samples = designs.samples(name, values)
        lined, bare = (samples["Free", scene].members[NOMINAL] for scene in ("abradable", "direct"))
        assert lined.scene.lining.thickness == thickness and bare.scene.lining is None
        assert lined.scene.friction.coefficient == bare.scene.friction.coefficient == friction
        assert {member.model for member in (lined, bare)} == {samples["Free", "direct"].campbell} == {NOMINAL}
        assert lined.blade == bare.blade == designs.settings.blades["Free"]


def test_with_a_variable_of_the_blade_each_design_but_the_start_has_a_model(config_copy):
    designs = designs_of(searched_settings(config_copy, f"{SCENES_ALONE}, stagger_deg.tip: [-3, 3]"))
    member = designs.samples("d0002", (0.002, 0.1, 1.0))["Free", "abradable"].members[NOMINAL]
    assert member.model == "search/d0002/" and member.scene.lining.thickness == 0.002
    assert member.blade == designs.blade("d0002", (0.002, 0.1, 1.0)) != designs.blade("start", None)
    assert designs.samples("start", None)["Free", "abradable"].members[NOMINAL].model == NOMINAL


def test_tolerances_spread_about_the_value_of_the_design(config_copy):
    searched_settings(config_copy, SCENES_ALONE)
    spread = "members: 4, of_scenes: { friction.coefficient: { uniform_percent: 5 } }"
    overlay(
        config_copy, "config.yaml", f"search: {{ objectives: {{ lined: {{ quantile: 0.9 }} }}, tolerances: {{ {spread} }} }}"
    )
    members = designs_of(read_settings(config_copy)).samples("d0002", (0.002, 0.1))["Free", "abradable"].members
    coefficients = [member.scene.friction.coefficient for name, member in members.items() if name]
    assert len(set(coefficients)) == 4 and all(0.095 <= each <= 0.105 for each in coefficients)
    assert {member.scene.lining.thickness for member in members.values()} == {0.002}


def test_designs_of_scenes_alone_have_the_structure_of_the_nominal_blade(config_copy, monkeypatch):
    """The shape of such a design is not meshed, and cannot be refused but by its scene."""
    settings = searched_settings(config_copy, SCENES_ALONE)
    (settings.results / "search").mkdir(parents=True)
    monkeypatch.chdir(config_copy)
    search = search_of(settings)
    monkeypatch.setitem(
        search.sweep.samples.beside.later, "search", lambda name: designs_of(settings).samples(name, (0.002, 0.1))
    )
    measured = search.measured(SimpleNamespace(design="d0000"))
    assert measured["geometry"] == "<results>/Free/geometry.nc"
    assert measured["responses"] == [f"<results>/search/d0000/Free/{scene}/response.nc" for scene in ("abradable", "direct")]
    shape = search.shape(SimpleNamespace(design="d0000"))
    assert shape == {"definition": None, "refused": None} and search.shapes_of_all(None) == [] == list(search.entries(None))
    file = config_copy / "shape.json"
    steps.shape(Named(), Named(shape=file), Named(shape=shape, edges="round", mesh={}, stress_region={}))
    assert yaml.safe_load(file.read_text()) == {"refused": None}


def test_the_best_scenes_are_a_scenes_file(config_copy):
    """Of two designs; the bare scene has no lining, and one variable is of the blade."""
    settings = searched_settings(config_copy, "scene.lining.thickness_m: [0.001, 0.004], stagger_deg.tip: [-3, 3]")
    search = search_of(settings)
    values, order = [[0.005, 0.0], [0.002, 1.0], [0.003, 2.0]], [0, 2, 1]
    dataset = xr.Dataset(
        {"value": (("design", "variable"), values), "objective_value": (("design", "objective"), [[3.0], [2.0], [1.0]])},
        coords={
            "design": ["start", "d0000", "d0001"],
            "variable": list(settings.config.search.variables),
            "objective": ["lined"],
        },
    ).assign(order=("design", order))
    dataset = dataset.assign_coords(objective_unit=("objective", ["rad s-1"]))
    write_dataset(dataset, config_copy / "search.nc")
    params = {
        "scenes": search.scene_entries(None),
        "varied_in_scenes": search.varied_in_scenes(None),
        "entries": {},
        "number": 9,
    }
    best = config_copy / "best"
    steps.best(Named(dataset=config_copy / "search.nc", shapes=[]), Named(folder=best), Named(**params))
    assert [file.name for file in best.iterdir()] == ["scenes.yaml"]
    assert "# d0001: lined 1 rad s-1; the start: lined 3 rad s-1" in (best / "scenes.yaml").read_text()
    names = ["abradable", "direct", "abradable_best1", "abradable_best2"]
    file = config_copy / "config/config.yaml"
    content = {key: value for key, value in yaml.safe_load(file.read_text()).items() if key != "search"}
    file.write_text(yaml.safe_dump(content | {"scenes_file": "best/scenes.yaml", "scenes": names}))
    entries = read_settings(config_copy).scene_designs.entries
    assert list(entries) == names
    assert (
        entries["abradable"] == settings.scene_designs.entries["abradable"]
        and entries["direct"] == settings.scene_designs.entries["direct"]
    )
    for name, thickness in (("abradable_best1", 0.003), ("abradable_best2", 0.002)):
        expected = {**scene_numbers(entries["abradable"]), "lining.thickness_m": thickness}
        assert scene_numbers(entries[name]) == expected
