"""Configuration: what is accepted, and what the refusals say."""

import numpy as np
import pytest
import yaml
from overlays import overlay
from test_refusals import edit

from r37core.base.yaml_file import load_yaml
from r37core.config import ConfigError, plain
from r37core.config.remarks import remarks_of_pipeline, remarks_on_laws
from r37core.plans.provenance import structure_hash
from r37core.product.reading import load_settings, read_settings


def load(folder, **changes):
    return load_settings(load_yaml(folder / "config/config.yaml") | changes, folder)


def test_shipped_configuration(settings):
    assert list(settings.blades) == ["Ref", "L50", "L100", "S50", "S100", "CS50", "CS100"]
    assert settings.blades["Ref"].definition.stacking is None
    assert settings.blades["CS100"].definition.stacking[3] == pytest.approx((1.0, -0.0116, np.radians(4.89)))
    assert settings.blades["S50"].material.youngs_modulus == 180e9


def test_three_ways_to_give_a_shape(with_blades):
    blades = with_blades(
        "Mine: {base: Ref, chordwise_sweep_deg: 12}\nRows:\n  base: CS100\n  sweep_lean:\n"
        "    - {span_percent: 0, sweep_cm: 0, lean_deg: 0}\n    - {span_percent: 100, sweep_cm: 0.2, lean_deg: 1}\n"
        "Stiff: {base: CS100, material: {youngs_modulus_pa: 2e11}}\n"
    ).blades
    assert blades["Mine"].definition.chordwise_sweep_angle == pytest.approx(np.radians(12.0))
    assert blades["Rows"].definition.stacking == ((0.0, 0.0, 0.0), (1.0, 0.002, pytest.approx(np.radians(1.0))))
    assert blades["Stiff"].definition.stacking == blades["CS100"].definition.stacking
    assert blades["Stiff"].material.youngs_modulus == 2e11
    assert blades["Stiff"].material.density == 8000.0


def test_defaults_are_filled_in(config_copy):
    settings = load_settings({"blades": ["Ref"], "scenes": ["direct"], "fidelity": "draft"}, config_copy)
    assert plain(settings.structure.boundary) == {"tip_line": "pressure_edge", "corners": True}
    assert settings.config.campbell.highest_engine_order == 20
    assert list(settings.scenes) == ["direct"] and list(settings.speed_plans) == [("Ref", "direct")]
    assert settings.speed_plans["Ref", "direct"].certain[:2] == (750.0, 770.0)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"blades": []}, r"config\.yaml: blades: found \[\]"),
        ({"structure": {"edges": "sharp"}}, r"structure\.edges: found 'sharp'; allowed: one of round, blunt"),
        ({"structure": {"maximum_speed_rad_s": -5}}, r"maximum_speed_rad_s: found -5; allowed: .*at least"),
        ({"structure": {"stress_submesh": {"minimum_z_m": 1}}}, r"stress_submesh\.minimum_z_m: found 1; allowed: less than"),
        ({"campbell": {"modes": 2}}, r"campbell\.modes: found 2; allowed: .*at least 3"),
        ({"blades_file": "config/none.yaml"}, r"config/none\.yaml: there is no such file"),
    ],
)
def test_config_refusals(config_copy, changes, message):
    with pytest.raises(ConfigError, match=message):
        load(config_copy, **changes)


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
def test_profile_table_refusals(config_copy, old, new, message):
    edit(config_copy / "config/profiles/rotor37.csv", old, new)
    with pytest.raises(ConfigError, match=message):
        load(config_copy)


def test_tolerance_picks_the_cheapest_level_that_keeps_it(config_copy):
    file = config_copy / "config/fidelity.yaml"
    levels = load_yaml(file)
    for level in levels.values():
        del level["measured"]
    for name, error, cost in (("draft", 0.3, 0.1), ("standard", 0.08, 0.5), ("paper", 0.02, 1.0)):
        levels[name]["measured"] = {"error": error, "cpu_s_per_run": cost}
    file.write_text(yaml.safe_dump(levels))
    for tolerance, level in ((0.5, "draft"), (0.1, "standard"), (0.02, "paper")):
        assert load(config_copy, fidelity="auto", tolerance=tolerance).fidelity_name == level
    assert load(config_copy, fidelity="draft", tolerance=0.02).fidelity_name == "draft"
    with pytest.raises(ConfigError, match=r"tolerance: found 0\.001; measured errors .*; accept more"):
        load(config_copy, fidelity="auto", tolerance=0.001)
    # direct contact on points has errors of its own
    for name, error in (("draft", 0.5), ("standard", 0.4), ("paper", 0.3)):
        levels[name]["measured"]["error_on_points"] = error
    file.write_text(yaml.safe_dump(levels))
    assert load(config_copy, fidelity="auto", tolerance=0.4, scenes=["abradable", "direct"]).fidelity_name == "standard"
    assert load(config_copy, fidelity="auto", tolerance=0.1, scenes=["abradable"]).fidelity_name == "standard"
    patches = {"boundary": {"contact": "patches"}}
    assert load(config_copy, fidelity="auto", tolerance=0.1, scenes=["direct"], structure=patches).fidelity_name == "standard"
    with pytest.raises(
        ConfigError, match=r"found 0\.1; measured errors .* draft 0\.5, .*or take structure\.boundary\.contact: pat"
    ):
        load(config_copy, fidelity="auto", tolerance=0.1, scenes=["direct"])


def test_structure_hash_follows_what_the_blade_depends_on(with_blades, config_copy):
    before = load(config_copy)
    assert structure_hash(load(config_copy, blades=["Ref"]), "Ref") == structure_hash(before, "Ref")
    with open(config_copy / "config/stacking/rotor37.csv", "a") as stream:
        stream.write("New,0,0,0\nNew,100,0.1,0\n")
    extended = with_blades("New: {base: Ref, stacking_table: config/stacking/rotor37.csv}")
    assert structure_hash(extended, "L50") == structure_hash(before, "L50")
    edit(config_copy / "config/profiles/rotor37.csv", "17.780", "17.781")
    assert structure_hash(load(config_copy), "Ref") != structure_hash(before, "Ref")


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
