"""A search whose variables are of scenes, too: what varies, which model designs start from, and what the best become."""

from types import SimpleNamespace

import pytest
import xarray as xr
import yaml
from overlays import overlay
from test_search import BLADES
from test_search import SEARCH as SEARCH_OF_BLADE

from r37core.base.dataset_file import write_dataset
from r37core.base.io import Named
from r37core.config import ConfigError
from r37core.config.changed_numbers import scene_numbers
from r37core.plans.samples import NOMINAL
from r37core.plans.sweep_plan import Sweep
from r37core.product.extensions import beside
from r37core.product.reading import read_settings
from r37core.search import steps
from r37core.search.plan import Search, designs_of

SCENES_ALONE = "scene.lining.thickness_m: [0.001, 0.004], scene.friction.coefficient: [0.05, 0.2]"
BOTH_SCENES = "objectives: { lined: { scenes: [abradable] }, bare: { scenes: [direct] } }"


def searched(folder, variables, changes=""):
    """Settings of a search with these variables."""
    overlay(folder, "blades.yaml", BLADES)
    overlay(folder, "config.yaml", SEARCH_OF_BLADE)
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
        searched(config_copy, variables)
    assert "\n" not in str(refusal.value)


def test_a_variable_of_scenes_changes_every_scene_that_has_it_and_no_model(config_copy):
    designs = designs_of(searched(config_copy, SCENES_ALONE))
    assert designs.start_values == [0.005, 0.15]
    for name, values, thickness, friction in (("start", None, 0.005, 0.15), ("d0002", (0.002, 0.1), 0.002, 0.1)):
        samples = designs.samples(name, values)
        lined, bare = (samples["Free", scene].members[NOMINAL] for scene in ("abradable", "direct"))
        assert lined.scene.lining.thickness == thickness and bare.scene.lining is None
        assert lined.scene.friction.coefficient == bare.scene.friction.coefficient == friction
        assert {member.model for member in (lined, bare)} == {samples["Free", "direct"].campbell} == {NOMINAL}
        assert lined.blade == bare.blade == designs.settings.blades["Free"]


def test_with_a_variable_of_the_blade_each_design_but_the_start_has_a_model(config_copy):
    designs = designs_of(searched(config_copy, f"{SCENES_ALONE}, stagger_deg.tip: [-3, 3]"))
    member = designs.samples("d0002", (0.002, 0.1, 1.0))["Free", "abradable"].members[NOMINAL]
    assert member.model == "search/d0002/" and member.scene.lining.thickness == 0.002
    assert member.blade == designs.blade("d0002", (0.002, 0.1, 1.0)) != designs.blade("start", None)
    assert designs.samples("start", None)["Free", "abradable"].members[NOMINAL].model == NOMINAL


def test_tolerances_spread_about_the_value_of_the_design(config_copy):
    searched(config_copy, SCENES_ALONE)
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
    settings = searched(config_copy, SCENES_ALONE)
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
    steps.shape(Named(), Named(shape=file), Named(shape=shape, edges="round", mesh={}, stress_submesh={}))
    assert yaml.safe_load(file.read_text()) == {"refused": None}


def test_the_best_scenes_are_a_scenes_file(config_copy):
    """Of two designs; the bare scene has no lining, and one variable is of the blade."""
    settings = searched(config_copy, "scene.lining.thickness_m: [0.001, 0.004], stagger_deg.tip: [-3, 3]")
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
