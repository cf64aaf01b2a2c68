"""Every key of scenes.yaml reaches the field of the scene that it names, and no other."""

import dataclasses

import numpy as np
import pytest

from r37core.config import checked_scene

ENTRY = {
    "casing": {"clearance_m": 2e-4},
    "lining": {"thickness_m": 4e-3, "elastic_modulus_pa": 1e10, "plastic_modulus_pa": 2e9, "yield_stress_pa": 3.0},
    "friction": {"form": "vector", "coefficient": 0.2},
}

REACHES = {
    "casing.cone_angle_deg": (-7.0, "casing.cone_angle", np.radians(-7.0)),
    "casing.clearance_m": (5e-4, "casing.clearance", 5e-4),
    "casing.lobes": (6, "casing.lobes", 6),
    "casing.width": (0.11, "casing.width", 0.11),
    "casing.amplitude_clearances": (2.5, "casing.amplitude", 2.5),
    "casing.amplitude_m": (5e-4, "casing.height", 5e-4),
    "casing.rise_fraction": (0.6, "casing.rise_fraction", 0.6),
    "casing.rise_revolutions": (30, "casing.rise_revolutions", 30),
    "lining.thickness_m": (7e-3, "lining.thickness", 7e-3),
    "lining.elastic_modulus_pa": (7e9, "lining.elastic_modulus", 7e9),
    "lining.plastic_modulus_pa": (7e8, "lining.plastic_modulus", 7e8),
    "lining.yield_stress_pa": (7e6, "lining.yield_stress", 7e6),
    "lining.bars": (70, "lining.bars", 70),
    "lining.contact_length_m": (7e-4, "lining.contact_length", 7e-4),
    "lining.bar_width_m": (7e-4, "lining.bar_width", 7e-4),
    "lining.bar_area_m2": (7e-7, "lining.bar_area", 7e-7),
    "friction.form": ("constant", "friction.vector", False),
    "friction.coefficient": (0.7, "friction.coefficient", 0.7),
    "damping_ratio": (0.07, "damping_ratio", 0.07),
    "gap": ("exact", "exact_gap", True),
    "divergence_limit_m": (0.07, "divergence_limit", 0.07),
}


def flat(scene):
    """Dotted field -> value."""
    fields = {}
    for name, value in dataclasses.asdict(scene).items():
        fields |= {f"{name}.{inner}": one for inner, one in value.items()} if isinstance(value, dict) else {name: value}
    return fields


def with_key(path, value):
    entry = {name: dict(part) if isinstance(part, dict) else part for name, part in ENTRY.items()}
    *parents, last = path.split(".")
    (entry[parents[0]] if parents else entry)[last] = value
    return entry


@pytest.mark.parametrize("path", REACHES)
def test_a_key_reaches_its_field_only(path):
    value, field, expected = REACHES[path]
    before, after = flat(checked_scene(ENTRY)), flat(checked_scene(with_key(path, value)))
    assert before[field] != after[field] == expected
    assert {name for name in before if before[name] != after[name]} == {field}


def test_every_field_has_a_key():
    """Those of a clearance that changes with the speed: see test_clearance; of an elastic casing: test_elastic_casing."""
    elsewhere = {"casing.centrifugal", "casing.growth_speeds", "casing.growth", "casing.ring", "casing.ring_radius"}
    # of the blades of a rotor
    elsewhere |= {"rotor", "casing.longer"}
    assert {field for _, field, _ in REACHES.values()} | elsewhere == set(flat(checked_scene(ENTRY)))


def test_by_default_the_tip_decides_the_cone_angle_and_all_of_it_has_a_lining():
    scene = checked_scene(ENTRY)
    assert (scene.casing.cone_angle, scene.lining.published) == (None, False)
    assert scene.casing.angle(-0.26) == -0.26
    assert checked_scene(with_key("casing.cone_angle_deg", 3.0)).casing.angle(-0.26) == np.radians(3.0)
