"""The section rotor of a scene: tables by number of a blade from files and from Python, what is drawn, and what is refused."""

import json

import jsonschema
import numpy as np
import pytest
from test_refusals import edit

from r37core.base.plain import from_plain, to_plain
from r37core.base.yaml_file import load_yaml
from r37core.config import ConfigError, checked_scene, command_line_document
from r37core.config.declaring import si
from r37core.config.rotor_section import RotorSection
from r37core.contact.scene import Rotor
from r37core.product.extensions import read_settings

ROTOR = "rotor: { blades: 36, mistuning_spread_percent: { normal: 1.0 }, seed: 0 }"
"""Of the scene rotor_abradable."""


def lined(**rotor):
    casing = {"clearance_m": 3.56e-4}
    lining = {"thickness_m": 5e-3, "elastic_modulus_pa": 2e10, "plastic_modulus_pa": 5e9, "yield_stress_pa": 1.5}
    return {"casing": casing, "lining": lining, "results": ["stress"], "rotor": rotor}


def test_a_rotor_is_drawn_from_a_seed():
    spread = {"mistuning_spread_percent": {"normal": 1.0}, "longer_spread_m": {"uniform": 2e-5}}
    rotor = checked_scene(lined(blades=36, **spread)).rotor
    assert rotor == checked_scene(lined(blades=36, **spread)).rotor == from_plain(Rotor, to_plain(rotor))
    assert rotor != checked_scene(lined(blades=36, seed=1, **spread)).rotor
    assert 0.5 < 100.0 * np.std(rotor.frequency_factors) < 1.5 and 1e-5 < np.max(np.abs(rotor.longer)) < 2e-5
    # a blade keeps its draw where another one is missing or has a value of its own
    fewer = checked_scene(lined(blades=36, missing=[2], mistuning_percent={1: 3.0}, **spread)).rotor
    assert fewer.numbers == (1, *range(3, 37)) and fewer.frequency_factors[0] == 1.03
    assert fewer.frequency_factors[1:] == rotor.frequency_factors[2:] and fewer.angles[1] == rotor.angles[2]


@pytest.mark.parametrize("table", ["{ 1: 0.4, 3: -0.7 }", '{ "1": 0.4, "3": -0.7 }', "{ 1: 0.4, '3': -0.7 }"])
def test_tables_by_number_stand_in_a_file(config_copy, table):
    """The number of a blade is a number or a text there, and the schema for editors allows both."""
    scenes = config_copy / "config/scenes.yaml"
    rotor = f"rotor: {{ blades: 4, mistuning_percent: {table}, longer_m: {table.replace('0.', '0.0')} }}"
    edit(scenes, ROTOR, rotor)
    of_file = read_settings(config_copy, command_line_document({"scenes": "all"})).scenes["rotor_abradable"].scene.rotor
    assert of_file.frequency_factors == (1.004, 1.0, 0.993, 1.0)
    assert of_file.longer == (0.04, 0.0, -0.07, 0.0)
    schema = json.loads((config_copy / "config/schemas/scenes.schema.json").read_text())
    jsonschema.validate(load_yaml(scenes), schema)
    edit(scenes, "0.4", "4000")
    with pytest.raises(jsonschema.ValidationError, match="4000 is greater than the maximum"):
        jsonschema.validate(load_yaml(scenes), schema)
    with pytest.raises(ConfigError, match=r"^config/scenes\.yaml:\d+: rotor_\w+\.rotor\.mistuning_percent\.1: found 4000"):
        read_settings(config_copy)


NO_NUMBER = "allowed: the number of a blade, from 1 to 1000"


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"longer_m": {0: 1e-5}}, rf"longer_m\.0: found the key 0; {NO_NUMBER}"),
        ({"longer_m": {1001: 1e-5}}, rf"longer_m\.1001: found the key 1001; {NO_NUMBER}"),
    ],
)
def test_what_no_rotor_has_is_refused_in_one_line(keys, message):
    with pytest.raises(ConfigError, match=rf"^scenes\.yaml: rotor\.{message}") as refusal:
        checked_scene(lined(**{"blades": 4} | keys))
    assert "\n" not in str(refusal.value)


def test_what_is_at_a_bound_is_a_rotor():
    """A blade may stand where a missing one would, and the widest spreads are drawn within the bounds."""
    angles = [0.0, 0.0, 0.1, 180.0]
    assert len(checked_scene(lined(blades=4, missing=[2], angles_deg=angles)).rotor.numbers) == 3
    assert checked_scene(lined(blades=1, angles_deg=[7.0])).rotor.angles == (np.radians(7.0),)
    spreads = {"longer_spread_m": {"uniform": 0.1}, "mistuning_spread_percent": {"between": [-95.0, 1000.0]}}
    rotor = checked_scene(lined(blades=1000, mistuning_percent={1000: 1000.0, 1: -95.0}, **spreads)).rotor
    assert min(rotor.frequency_factors) == pytest.approx(0.05) and max(rotor.frequency_factors) == 11.0
    assert 0.0999 < max(map(abs, rotor.longer)) <= 0.1
    section = RotorSection(blades=2, longer_spread_m={"values": [0.1]}, mistuning_percent={2: 1.0})
    assert si(section).longer == (0.1, 0.1) and si(section).frequency_factors == (1.0, 1.01)
