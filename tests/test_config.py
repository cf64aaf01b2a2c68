"""Configuration: what is accepted, and what the refusals say."""

import shutil

import numpy as np
import pytest
import yaml
from overlays import overlay

from r37core.config import ConfigError, plain
from r37core.config.remarks import remarks_of_pipeline, remarks_on_laws
from r37core.io import TextFileError
from r37core.plans.provenance import structure_hash
from r37core.product.reading import load_settings, read_settings
from r37core.yaml_file import load_yaml


@pytest.fixture
def project(root, tmp_path):
    shutil.copytree(root / "config", tmp_path / "config")
    return tmp_path


def load(project, **changes):
    return load_settings(load_yaml(project / "config/config.yaml") | changes, project)


def add_blade(project, text):
    with open(project / "config/blades.yaml", "a") as stream:
        stream.write("\n" + text)


def replace_in_table(project, old, new):
    file = project / "config/profiles/rotor37.csv"
    content = file.read_text()
    assert old in content
    file.write_text(content.replace(old, new, 1))


def test_shipped_configuration(settings):
    assert list(settings.blades) == ["Ref", "L50", "L100", "S50", "S100", "CS50", "CS100"]
    assert settings.blades["Ref"].definition.stacking is None
    assert settings.blades["CS100"].definition.stacking[3] == pytest.approx((1.0, -0.0116, np.radians(4.89)))
    assert settings.blades["S50"].material.youngs_modulus == 180e9


def test_three_ways_to_give_a_shape(project):
    add_blade(project, "Mine: {base: Ref, chordwise_sweep_deg: 12}")
    add_blade(
        project,
        "Rows:\n  base: CS100\n  sweep_lean:\n"
        "    - {span_percent: 0, sweep_cm: 0, lean_deg: 0}\n    - {span_percent: 100, sweep_cm: 0.2, lean_deg: 1}\n",
    )
    add_blade(project, "Stiff: {base: CS100, material: {youngs_modulus_pa: 2e11}}")
    blades = load(project).blades
    assert blades["Mine"].definition.chordwise_sweep_angle == pytest.approx(np.radians(12.0))
    assert blades["Rows"].definition.stacking == ((0.0, 0.0, 0.0), (1.0, 0.002, pytest.approx(np.radians(1.0))))
    assert blades["Stiff"].definition.stacking == blades["CS100"].definition.stacking
    assert blades["Stiff"].material.youngs_modulus == 2e11
    assert blades["Stiff"].material.density == 8000.0


def test_defaults_are_filled_in(project):
    content = {
        "blades_file": "config/blades.yaml",
        "fidelity_file": "config/fidelity.yaml",
        "scenes_file": "config/scenes.yaml",
        "blades": ["Ref"],
        "scenes": ["direct"],
        "fidelity": "draft",
    }
    settings = load_settings(content, project)
    assert plain(settings.structure.boundary) == {"tip_line": "pressure_edge", "nodes": 8, "corners": True}
    assert settings.config.campbell.highest_engine_order == 20
    assert list(settings.scenes) == ["direct"]
    assert settings.speed_plans["Ref", "direct"].certain[:2] == (750.0, 770.0)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"fidelity": "finest"}, r"config\.yaml: fidelity: found 'finest'; allowed: draft, standard, paper, fine, reference"),
        ({"blades": ["Ref", "R2"]}, r"config\.yaml: blades: found 'R2'; allowed: Ref, L50"),
        ({"blades": []}, r"config\.yaml: blades: found \[\]"),
        ({"bladez": 1}, r"config\.yaml: top level: found unknown key bladez; allowed keys: blades_file"),
        ({"structure": {"edges": "sharp"}}, r"structure\.edges: found 'sharp'; allowed: one of round, blunt"),
        ({"structure": {"boundary": {"nodes": 0}}}, r"structure\.boundary\.nodes: found 0; allowed: .*at least 1"),
        ({"structure": {"maximum_speed_rad_s": -5}}, r"maximum_speed_rad_s: found -5; allowed: .*at least"),
        ({"structure": {"stress_submesh": {"minimum_z_m": 1}}}, r"stress_submesh\.minimum_z_m: found 1; allowed: less than"),
        ({"campbell": {"modes": 2}}, r"campbell\.modes: found 2; allowed: .*at least 3"),
        ({"blades_file": "config/none.yaml"}, r"config/none\.yaml: there is no such file"),
    ],
)
def test_config_refusals(project, changes, message):
    with pytest.raises(ConfigError, match=message):
        load(project, **changes)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("X: {base: Nope}", r"blades\.yaml:25: X\.base: found 'Nope'; allowed: another blade"),
        ("X: {base: Y}\nY: {base: X}", r"blades\.yaml:26: Y\.base: found 'X'; allowed: another blade"),
        ("X: {}", r"blades\.yaml:25: X: found neither profiles nor base"),
        ("X: {base: Ref, chordwise_sweep_deg: 5, stacking_table: t.csv}", r"X: found stacking_table and chordwise_sweep_deg"),
        ("X: {base: Ref, sweep: 5}", r"X: found unknown key sweep; allowed keys: profiles, base"),
        ("X: {base: Ref, chordwise_sweep_deg: 80}", r"X\.chordwise_sweep_deg: found 80; allowed: .*less than 60"),
        ("X: {base: Ref, stacking_table: config/stacking/rotor37.csv}", r"rotor37\.csv: blade X: no row of the table has 'X'"),
        ("X: {base: Ref, stacking_table: none.csv}", r"X\.stacking_table: there is no file none\.csv"),
        ("X: {base: Ref, material: {density_kg_m3: 0}}", r"X\.material\.density_kg_m3: found 0; allowed: .*at least"),
        ("X: {profiles: config/profiles/rotor37.csv}", r"X\.material: missing key youngs_modulus_pa"),
        ("X: {base: Ref}\nX: {base: L50}", r"blades\.yaml:\d+: not readable as YAML: .*the key 'X' is given twice"),
        (
            "X: {base: Ref, sweep_lean: [{span_percent: 0, sweep_cm: 0, lean_deg: 0}, "
            "{span_percent: 90, sweep_cm: 0, lean_deg: 0}]}",
            r"X\.sweep_lean: blade X: the spans run from 0% to 90%",
        ),
    ],
)
def test_blade_refusals(project, text, message):
    add_blade(project, text)
    with pytest.raises(ConfigError, match=message):
        load(project)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("70,23.211", "96,23.211", r"rotor37\.csv: blade Ref: span 85%: comes after 96%"),
        ("0,17.780", "1,17.780", r"the spans run from 1% to 100%"),
        ("0.032,0.250", "0.032,-0.250", r"span 70%: maximum_thickness is -0\.0025 m; it must be positive"),
        ("50,21.761", "50,23.300", r"span 70%: the profile crosses the one at span 50%"),
        ("58.470", "98.470", r"span 70%: inlet_angle is 98\.47 degrees, so \|sin kappa\| passes 1"),
        ("58.470", "abc", r"line 6, column kappa_ic_deg: 'abc' is not a number"),
        ("58.470", "nan", r"line 6, column kappa_ic_deg: 'nan' is not finite"),
        ("z_oc_cm", "z_xx_cm", r"the table lacks the columns z_oc_cm"),
    ],
)
def test_profile_table_refusals(project, old, new, message):
    replace_in_table(project, old, new)
    with pytest.raises(ConfigError, match=message):
        load(project)


def test_tolerance_picks_the_cheapest_level_that_keeps_it(project):
    file = project / "config/fidelity.yaml"
    levels = load_yaml(file)
    for level in levels.values():
        del level["measured"]
    for name, error, cost in (("draft", 0.3, 0.1), ("standard", 0.08, 0.5), ("paper", 0.02, 1.0)):
        levels[name]["measured"] = {"error": error, "cpu_s_per_run": cost}
    file.write_text(yaml.safe_dump(levels))
    for tolerance, level in ((0.5, "draft"), (0.1, "standard"), (0.02, "paper")):
        assert load(project, fidelity="auto", tolerance=tolerance).fidelity_name == level
    assert load(project, fidelity="draft", tolerance=0.02).fidelity_name == "draft"
    with pytest.raises(ConfigError, match=r"tolerance: found 0\.001; measured errors .*; accept more"):
        load(project, fidelity="auto", tolerance=0.001)
    # direct contact on points has errors of its own
    for name, error in (("draft", 0.5), ("standard", 0.4), ("paper", 0.3)):
        levels[name]["measured"]["error_on_points"] = error
    file.write_text(yaml.safe_dump(levels))
    assert load(project, fidelity="auto", tolerance=0.4, scenes=["abradable", "direct"]).fidelity_name == "standard"
    assert load(project, fidelity="auto", tolerance=0.1, scenes=["abradable"]).fidelity_name == "standard"
    patches = {"boundary": {"contact": "patches"}}
    assert load(project, fidelity="auto", tolerance=0.1, scenes=["direct"], structure=patches).fidelity_name == "standard"
    with pytest.raises(
        ConfigError, match=r"found 0\.1; measured errors .* draft 0\.5, .*or take structure\.boundary\.contact: pat"
    ):
        load(project, fidelity="auto", tolerance=0.1, scenes=["direct"])


def test_structure_hash_follows_what_the_blade_depends_on(project):
    before = load(project)
    assert structure_hash(load(project, blades=["Ref"]), "Ref") == structure_hash(before, "Ref")
    with open(project / "config/stacking/rotor37.csv", "a") as stream:
        stream.write("New,0,0,0\nNew,100,0.1,0\n")
    add_blade(project, "New: {base: Ref, stacking_table: config/stacking/rotor37.csv}")
    extended = load(project)
    assert structure_hash(extended, "L50") == structure_hash(before, "L50")
    replace_in_table(project, "17.780", "17.781")
    assert structure_hash(load(project), "Ref") != structure_hash(before, "Ref")


def test_numbers_without_a_dot_are_numbers(tmp_path):
    (tmp_path / "a.yaml").write_text("a: 1e9\nb: 2.5E-3\nc: 7\nd: text\n")
    assert load_yaml(tmp_path / "a.yaml") == {"a": 1e9, "b": 2.5e-3, "c": 7, "d": "text"}
    (tmp_path / "b.yaml").write_text("a: 1\na: 2\n")
    with pytest.raises(TextFileError, match=r"line 2: .*'a' is given twice"):
        load_yaml(tmp_path / "b.yaml")


@pytest.mark.parametrize(
    ("scene", "changes", "said"),
    [
        ("physical_direct", {"friction": {"coefficient": 0.2}}, None),
        ("physical_direct", {"friction": {"coefficient": 0.25}}, "friction.coefficient is 0.25; above 0.2 exact_modal and"),
        # both integrators agree on a lining
        ("physical_abradable", {"friction": {"coefficient": 0.6}}, None),
        ("physical_abradable", {"lining": {"plastic_modulus_pa": 1.0e3}}, None),
        ("physical_abradable", {"lining": {"plastic_modulus_pa": 0}}, "lining.plastic_modulus_pa is 0: bars do not harden"),
    ],
)
def test_laws_beyond_what_a_run_can_bear_are_remarked_on(config_copy, scene, changes, said):
    """Scenes that are not run say nothing."""
    others = {name: {"friction": {"coefficient": 5}} for name in {"physical_direct", "elastic_direct"} - {scene}}
    overlay(config_copy, "scenes.yaml", yaml.safe_dump({scene: changes, **others}))
    overlay(config_copy, "config.yaml", f"scenes: [{scene}]")
    remarks = remarks_on_laws(read_settings(config_copy))
    begins = f"scene '{scene}': {said}"
    assert [remark[: len(begins)] for remark in remarks] == ([begins] if said else [])
    assert set(remarks) <= set(remarks_of_pipeline(read_settings(config_copy)))
