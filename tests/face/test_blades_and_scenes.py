"""Blades and scenes of calls from Python."""

import warnings

import numpy as np
import pytest
from test_contact_patches import settings_with  # noqa: F401
from test_lining import CLEARANCE, IN_CLEARANCES, SAID
from test_refusals import edit
from test_rotor_section import ROTOR
from test_section_changes import chord, of_each, shapes, stagger, thickness

import r37
from r37.call_settings import call_of
from r37core.blade.profile import BladeShapeError
from r37core.config import ConfigError, checked_scene
from r37core.config.changed_numbers import ImpossibleValueError, blade_number, changed_blade, entry_with, scene_numbers
from r37core.plans.provenance import structure_hash
from r37core.time_integration.settling import MotionAtEnd


def test_a_blade_has_the_contact_and_kinematics_of_its_base(settings_with, config_copy):
    def chosen(settings):
        return {name: settings.boundary_choice(name).contact for name in settings.blades}

    settings, point_contact = settings_with(), settings_with({"contact": "points"})
    own = dict.fromkeys(("Mine", "Sweep_5", "Sweep_10", "Alone"), "patches") | {"Kept": "points", "Like": "points"}
    assert chosen(settings) == dict.fromkeys(("Ref", "L50", "L100", "S50", "S100", "CS50", "CS100"), "points") | own
    kinematics = {name: settings.reduction_choice(name).kinematics for name in settings.blades}
    assert kinematics == dict.fromkeys(settings.blades, "linear") | {"Alone": "quadratic"}
    assert set(chosen(settings_with({"contact": "patches"})).values()) == {"patches"}
    assert structure_hash(settings, "Mine") != structure_hash(point_contact, "Mine")
    for base in ("Mine", "Kept", "Like", "Alone"):
        file = config_copy / "config/blades.yaml"
        assert r37.blade(base, thickness_percent=90, name="Copy", file=file).settings.contact == own[base]


@pytest.mark.slow
def test_a_run_has_it_from_model_to_dataset(config):
    """The benchmark's blade on patches and points, in the lining and in bare casing: only there its edge passes the casing."""
    found = {}
    for contact in ("points", "patches"):
        blade = r37.blade("Ref", contact=contact, config=config)
        for name in ("direct", "abradable"):
            scene = r37.scene(name, config=config, revolutions=100)
            found[name, contact] = r37.simulate(blade, scene, 1330.0, results=[]).largest_penetration.item()
    assert found["abradable", "points"] == found["abradable", "patches"] == 0.0
    # a tenth of the clearance to all of it, and fewer on short end patches
    assert 3e-5 < found["direct", "patches"] < 0.5 * found["direct", "points"] < 5e-4


def test_a_scene_has_one_height():
    found = "amplitude_clearances and amplitude_m; allowed: one of them"
    with pytest.raises(ConfigError, match=f"{found}$"):
        checked_scene({"casing": {**CLEARANCE, "amplitude_clearances": 2.0, "amplitude_m": 7.12e-4}})
    with pytest.raises(ConfigError, match=f"{found}; null .None in Python. leaves out an inherited one$"):
        r37.scene("abradable", **{"casing.amplitude_clearances": 3.0})
    assert r37.scene("abradable", **IN_CLEARANCES).entry.scene().casing.lobe_height == 7.12e-4
    assert r37.scene("abradable", **{"casing.amplitude_m": None}).entry.casing.amplitude_clearances == 2.0


@pytest.mark.parametrize(
    "rotor",
    [
        {"rotor": {"blades": 4, "mistuning_percent": {1: 0.4, 3: -0.7}}},
        {"rotor": {"blades": 4, "mistuning_percent": {"1": 0.4, "3": -0.7}}},
        {"rotor": {"blades": 4, "mistuning_percent": {np.int64(1): 0.4, np.int8(3): np.float32(-0.7)}}},
        {"rotor.blades": 4, "rotor.mistuning_percent.1": 0.4, "rotor.mistuning_percent.3": -0.7},
    ],
)
def test_tables_by_number_are_given_in_python(rotor):
    scene = r37.scene("abradable", results=["stress"], **rotor)
    np.testing.assert_allclose(scene.entry.scene().rotor.frequency_factors, (1.004, 1.0, 0.993, 1.0), rtol=1e-8)


def test_a_blade_of_a_file_has_another_value_in_python(config_copy):
    scenes = config_copy / "config/scenes.yaml"
    edit(scenes, ROTOR, "rotor: { blades: 3, longer_m: { 1: 2.0e-5, 2: 3.0e-5 } }")
    changed = r37.scene("rotor_abradable", file=scenes, rotor={"longer_m": {2: -1e-5, 3: 5e-6}})
    assert changed.entry.scene().rotor.longer == (2e-5, -1e-5, 5e-6)


def test_a_member_of_a_sample_has_another_value_of_one_blade():
    entry = r37.scene("abradable", results=["stress"], rotor={"blades": 2, "longer_m": {2: 3e-5}}).entry
    assert scene_numbers(entry)["rotor.longer_m.2"] == 3e-5
    assert entry_with(entry, {"rotor.longer_m.2": 4e-5}).scene().rotor.longer == (0.0, 4e-5)


@pytest.mark.slow
def test_the_reference_blade_cuts_itself_free():
    """Interaction 1B/4 on points: at 200 revolutions 1726 and 1729 rad/s move more than 1700, at 1,000 that alone is left."""
    blade = r37.blade("Ref", name="Points", contact="points")
    speeds, rise = [1700.0, 1726.0, 1729.0], {"casing.rise_revolutions": 40, "friction.form": "vector"}
    scenes = [r37.scene("abradable", name="long", revolutions=revolutions, **rise) for revolutions in (200, 1000)]
    early, late = (r37.sweep(blade, scene, speeds, fidelity="draft", results=["wear"]) for scene in scenes)
    tip = {"tip_point": "leading_edge"}
    np.testing.assert_allclose(1e3 * early["rms_normal"].sel(tip), [0.551, 3.277, 2.604], atol=0.01)
    assert early["motion_at_end"].values.tolist() == [MotionAtEnd.LASTING, MotionAtEnd.GROWING, MotionAtEnd.GROWING]
    assert late["motion_at_end"].values.tolist() == [MotionAtEnd.LASTING, MotionAtEnd.CUT_FREE, MotionAtEnd.CUT_FREE]
    np.testing.assert_allclose(late["rms_normal"].sel(tip)[0], early["rms_normal"].sel(tip)[0], rtol=1e-3)
    assert (late["revolution_maximum"].sel(tip)[1:, -1] < 1e-6).all()
    # the lobes have grown alike, and the lining is used up where the blade has cut itself free
    np.testing.assert_allclose(late["revolution_maximum"][:, :200], early["revolution_maximum"], rtol=1e-3)
    np.testing.assert_allclose(late["used_thickness"], [0.690e-3, 5e-3, 5e-3], rtol=1e-2)


@pytest.mark.slow
def test_a_tip_that_has_cut_its_way_in_and_rests_is_quiet():
    """Rotation brings it 32 um into the lining: so much is used, nothing is worn through, and nothing moves."""
    changes = {"casing.lobes": 0, "casing.clearance.cold_m": 3e-5, "lining.thickness_m": 1e-4}
    scene = r37.scene("growing_abradable", name="cut", **changes)
    run = r37.simulate("Ref", scene, 1700, fidelity="draft", results=["wear"])
    assert run.motion_at_end == MotionAtEnd.QUIET and run.worn_through_share == 0.0
    assert run.used_thickness == run.max_wear and 2e-5 < run.max_wear < 5e-5


def test_python_takes_laws_as_yaml_does(with_blades, root):
    blade = with_blades("Mine: { base: S100, stagger_deg: { tip: 2 }, camber_deg: 1 }").blades["Mine"]
    for changes in ({"stagger_deg": {"hub": 0, "tip": 2}, "name": "Turned"}, {"stagger_deg.tip": np.float64(2)}):
        called = r37.blade("S100", config=root / "config/config.yaml", camber_deg=1.0, **changes).settings
        assert called.definition.profiles == blade.definition.profiles


def test_members_have_changes_on_top_of_the_blade_s(root):
    blade = r37.blade("S100", config=root / "config/config.yaml", stagger_deg=1, thickness_percent={"tip": 90}).settings
    changes = {"stagger_deg": 0.5, "stagger_deg.tip": 1.0, "chord_percent.hub": 104.0, "thickness_percent": 110.0}
    member, nominal = changed_blade(blade, changes), shapes(blade)
    spans = of_each(nominal, lambda profile: profile.parameters.span)
    np.testing.assert_allclose(stagger(shapes(member)) - stagger(nominal), 0.5 + spans, atol=0.02)
    np.testing.assert_allclose(chord(shapes(member)), (1.04 - 0.04 * spans) * chord(nominal), rtol=1e-9)
    np.testing.assert_allclose(thickness(shapes(member)), 1.1 * thickness(nominal), rtol=1e-12)
    assert changed_blade(blade, {key: blade_number(blade, key) for key in changes}) == blade


@pytest.mark.parametrize(
    ("changes", "key", "message"),
    [
        ({"stagger_deg.hub": 45.0, "sweep_cm": 1.0}, "stagger_deg.hub", "span 0%: inlet_angle is 9"),
        ({"camber_deg": 80.0, "stagger_deg": 5.0}, "camber_deg", "camber_deg and stagger_deg: span 0%"),
        ({"chord_percent.tip": 5.0}, "chord_percent.tip", "found 5; allowed: number, at least 10"),
    ],
)
def test_an_impossible_member_names_its_number(root, changes, key, message):
    with pytest.raises(ImpossibleValueError, match=message) as refusal:
        changed_blade(r37.blade("Ref", config=root / "config/config.yaml").settings, changes)
    assert refusal.value.number.key == key


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"stagger_deg": 25}, "blade Ref: span 100%: no suction-side arc .*; where the blade's entry has stagger_deg, "),
        ({"chord_percent": {"tip": 200}}, "blade Ref: span 100%: the plane section .* or thickness_percent, a smaller"),
    ],
)
def test_a_shape_that_cannot_be_built_names_span_and_remedy(root, changes, message):
    definition = r37.blade("Ref", config=root / "config/config.yaml", **changes).settings.definition
    with pytest.raises(BladeShapeError, match=message):
        definition.build(round_edges=True)


def test_a_changed_scene_in_python_is_alone(config_copy):
    """What starts from it stays as it is; None takes away what the base has, too, and the base may be another one."""
    file = config_copy / "config/scenes.yaml"
    shipped = {name: r37.scene(name, file=file).entry for name in r37.scenes(file=file)}
    assert shipped["material_abradable"].lining.bar_width_m is None and shipped["direct"].lining is None
    bare = r37.scene("abradable", file=file, lining=None, friction={"form": "vector"}, results=["stress"])
    assert bare.entry == shipped["direct"].model_copy(update={"results": ["stress"]})
    for options in ({}, {"name": "Mine"}):
        bare = r37.scene("material_abradable", file=file, lining=None, results=["stress"], **options)
        assert bare.entry == shipped["direct"].model_copy(update={"results": ["stress"]})
        flexible = r37.scene("direct", file=file, base="elastic_abradable", **options)
        assert flexible.entry == shipped["elastic_direct"].model_copy(update={"results": shipped["direct"].results})
    with pytest.raises(ConfigError, match=r'^r37\.scene\("direct"\): direct\.base: found \'none\'; allowed: another scene of'):
        r37.scene("direct", file=file, base="none")
    with pytest.raises(ConfigError, match=r"material_abradable\.lining\.thickness_m: found -1"):
        r37.scene("material_abradable", file=file, **{"lining.thickness_m": -1})


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"casing.clearance_m": 4e-4}, False),
        ({**IN_CLEARANCES, "casing.clearance_m": 4e-4}, True),
        ({**IN_CLEARANCES, "casing.clearance_m": 3.56e-4}, False),
        ({**IN_CLEARANCES, "casing.clearance_m": None, "casing.clearance": {"cold_m": 4e-4}}, True),
        (IN_CLEARANCES, False),
    ],
)
def test_a_call_that_changes_the_clearance_is_warned(root, monkeypatch, changes, said):
    monkeypatch.setattr("r37.simulations.response_file", None)
    scene = r37.scene("direct", config=root / "config/config.yaml", **changes)
    with warnings.catch_warnings(record=True) as caught, pytest.raises(TypeError):
        warnings.simplefilter("always")
        r37.sweep("Ref", scene, [1500])
    assert len([one for one in caught if SAID in str(one.message)]) == said


def test_families_from_python(config_copy):
    """Of a blade and of a scene, which a run takes as it takes single ones."""
    config = config_copy / "config/config.yaml"
    scene = r37.scene("direct", config=config, name="Rooms", vary={"casing.clearance_m": [3e-4, 4e-4]})
    blade = r37.blade("S100", config=config, name="Sweep", vary={"sweep_percent": [50, 100]})
    call = call_of("r37.run", [blade], [scene], {"speeds": [1150]}, config=config, fidelity=None, whole=True)
    assert call.settings.blade_names == ["Sweep_50", "Sweep_100"]
    assert call.settings.scene_names == ["Rooms_0p0003", "Rooms_0p0004"]
