"""Height of the lobes in clearances or in m, and the remark on lobes that scale with a clearance that varies."""

import warnings
from dataclasses import replace

import numpy as np
import pytest
import yaml
from defaults import IntegrationChoice
from integration_cases import ABRADABLE, DIRECT, random_model, with_static_modes
from workflow_runs import overlay

import r37
from r37core.config import ConfigError, checked_scene, command_line_document
from r37core.config.changed_numbers import scene_numbers
from r37core.config.scenes import SceneEntry
from r37core.product.reading import read_settings
from r37core.product.remarks import remarks as remarks_of_run
from r37core.stability import plan as stability
from r37core.time_integration.simulate import Simulation

CLEARANCE = {"clearance_m": 3.56e-4}
COLD = {"clearance": {"cold_m": 3.56e-4}}
IN_CLEARANCES = {"casing.amplitude_m": None, "casing.amplitude_clearances": 2.0}
SAID = "lobes grow with the clearance, which this run changes or spreads: casing.amplitude_clearances"


def casing_of(**keys):
    return checked_scene({"casing": keys}).casing


@pytest.mark.parametrize("clearance", [CLEARANCE, COLD], ids=["fixed", "growing"])
def test_two_clearances_are_so_many_metres(clearance):
    assert casing_of(**clearance).lobe_height == casing_of(**clearance, amplitude_clearances=2.0).lobe_height == 7.12e-4
    assert casing_of(**clearance, amplitude_m=7.12e-4).lobe_height == 7.12e-4
    assert casing_of(**clearance, amplitude_m=7.12e-4, lobes=0).lobe_height == 0.0


def test_a_height_in_metres_stays():
    for clearance in ({"clearance_m": 5e-4}, {"clearance": {"cold_m": 5e-4}}):
        assert casing_of(**clearance, amplitude_m=7.12e-4).lobe_height == 7.12e-4
        assert casing_of(**clearance, amplitude_clearances=2.0).lobe_height == 1e-3


@pytest.mark.slow
@pytest.mark.parametrize(
    ("engine", "scene", "growing"),
    [("compiled", ABRADABLE, True), ("compiled", DIRECT, False), ("reference", ABRADABLE, False), ("reference", DIRECT, True)],
)
def test_both_give_the_same_bits(engine, scene, growing):
    model = with_static_modes(random_model(3), 1e-9)
    choice = IntegrationChoice(2e-6, 1, 31, integrator="exact_modal", engine=engine)

    def samples(**casing):
        rubs_on = replace(scene, casing=replace(scene.casing, centrifugal=growing, rise_fraction=0.2, **casing))
        simulation = Simulation(model, 1000.0, rubs_on, choice)
        return simulation.advance(simulation.start(), choice.revolutions).samples

    lobes = samples(amplitude=2.0)
    assert np.abs(lobes).max() > 1e-9
    np.testing.assert_array_equal(samples(height=7.12e-4), lobes)
    assert not np.array_equal(samples(height=7.0e-4), lobes)


def test_a_scene_has_one_height():
    found = (
        "casing: found amplitude_clearances and amplitude_m; allowed: one of them; in Python, a key that is None is left out$"
    )
    with pytest.raises(ConfigError, match=found):
        checked_scene({"casing": {**CLEARANCE, "amplitude_clearances": 2.0, "amplitude_m": 7.12e-4}})
    with pytest.raises(ConfigError, match=found):
        r37.scene("abradable", **{"casing.amplitude_clearances": 3.0})
    assert r37.scene("abradable", **IN_CLEARANCES).entry.scene().casing.lobe_height == 7.12e-4
    assert r37.scene("abradable", **{"casing.amplitude_m": None}).entry.casing.amplitude_clearances == 2.0


def test_a_height_may_spread_that_is_left_out_or_given():
    for given, key, value in (({}, "amplitude_clearances", 2.0), ({"amplitude_m": 1e-3}, "amplitude_m", 1e-3)):
        heights = {name: number for name, number in numbers_of(given).items() if "amplitude" in name}
        assert heights == {f"casing.{key}": value}


def numbers_of(casing):
    return scene_numbers(SceneEntry.model_validate({"casing": {**CLEARANCE, **casing}}))


SPREAD = {"casing.clearance_m": {"uniform_percent": 5}}
SPREAD_COLD = {"casing.clearance.cold_m": {"uniform_percent": 5}}
QUANTILE = {"measure": "largest_rms_m", "scenes": ["abradable"], "quantile": 0.9}
SEARCH = {"blade": "Ref", "variables": {"stagger_deg.tip": [-2, 2]}, "objectives": {"lined": QUANTILE}}
SEARCH |= {"tolerances": {"members": 2, "of_scenes": SPREAD}}


@pytest.mark.parametrize(
    ("config", "scenes", "named"),
    [
        ({}, {}, None),
        ({"tolerances": {"members": 2, "of_scenes": SPREAD}}, {}, "abradable, direct"),
        ({"tolerances": {"members": 2, "of_scenes": {"friction.coefficient": {"uniform_percent": 5}}}}, {}, None),
        ({"tolerances": {"members": 2, "of_scenes": SPREAD}, "search": SEARCH}, {}, "abradable, direct"),
        ({"search": SEARCH}, {}, "abradable, direct"),
        (
            {"tolerances": {"members": 2, "of_scenes": SPREAD_COLD}, "scenes": ["direct", "growing_direct"]},
            {},
            "growing_direct",
        ),
        ({"tolerances": {"members": 2, "of_scenes": SPREAD}}, {"direct": {"lobes": 0}}, "abradable"),
        ({}, {"direct": {"clearance_m": 4e-4}}, "abradable, direct"),
        ({"scenes": ["direct"]}, {"direct": {"clearance_m": 4e-4}}, None),
    ],
)
def test_lobes_that_scale_are_remarked_on_once(config_copy, config, scenes, named):
    run = {"blades": ["Ref"], "scenes": ["abradable", "direct"], **config}
    for in_metres in (False, True):
        height = {"amplitude_m": 7.12e-4} if in_metres else {"amplitude_clearances": 2.0}
        file = config_copy / "config/scenes.yaml"
        entries = yaml.safe_load(file.read_text())
        for name, entry in entries.items():
            casing = entry.setdefault("casing", {})
            for key in ("amplitude_m", "amplitude_clearances"):
                casing.pop(key, None)
            casing |= height | (scenes.get(name, {}))
        file.write_text(yaml.safe_dump(entries))
        remarks = [one for one in remarks_of_run(read_settings(config_copy, command_line_document(run))) if "lobes" in one]
        expected = [] if in_metres or named is None else [f"scene {named}: {SAID}"]
        assert [one[: len(expected[0])] if expected else one for one in remarks] == expected


def test_shipped_runs_hold_the_height(root):
    for name in ("tolerances", "ranking", "clearance"):
        changes = yaml.safe_load((root / f"config/{name}.yaml").read_text())
        assert not [one for one in remarks_of_run(read_settings(root, command_line_document(changes))) if "lobes" in one]


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
    monkeypatch.setattr("r37.simulations.Calculation", None)
    scene = r37.scene("direct", config=root / "config/config.yaml", **changes)
    with warnings.catch_warnings(record=True) as caught, pytest.raises(TypeError):
        warnings.simplefilter("always")
        r37.sweep("Ref", scene, [1500])
    assert len([one for one in caught if SAID in str(one.message)]) == said


def test_extremes_of_clearance_and_lobes_are_those_of_lobes_in_clearances(config_copy):
    """Otherwise, nothing would touch at the largest clearance."""
    cases = stability.cases(read_settings(config_copy))
    assert cases["clearance_0.01__direct"].scene.casing.lobe_height == pytest.approx(2e-2)
    assert cases["ovalisation_in_clearances_10__direct"].scene.casing.lobe_height == pytest.approx(3.56e-3)
    assert cases["damping_ratio_0.1__direct"].scene.casing.height == 7.12e-4
    overlay(config_copy, "config.yaml", "scenes: [growing_direct]")
    growing = stability.cases(read_settings(config_copy))["clearance_0.01__growing_direct"].scene.casing
    assert (growing.clearance, growing.lobe_height) == (0.01, pytest.approx(2e-2))
