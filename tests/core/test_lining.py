"""The casing's side of a scene: what presses and wears the lining by its material, and the height of the lobes."""

from dataclasses import replace

import numpy as np
import pytest
from defaults import Casing, IntegrationChoice, Lining, Scene
from integration_cases import NARROW, oscillator, random_model, with_static_modes
from integration_runs import ENGINES, whole_run
from workflow_runs import overlay

from r37core.config import ConfigError, checked_scene
from r37core.config.remarks import remarks_on_laws
from r37core.product.extensions import read_settings
from r37core.rom.contact_weights import tip_lengths
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL
from r37core.time_integration.kept_numbers import lining_at_tip
from r37core.time_integration.simulate import Simulation

LINING = Lining(5e-3, 20e9, 5e9, 1.5, contact_length=2e-4)
SOFT = replace(LINING, elastic_modulus=1e3, plastic_modulus=2.5e2, yield_stress=0.0)
"""So soft that the blade does not move."""


def test_contact_nodes_share_the_length_of_tip_along_the_meridian():
    """A tip on a cone whose line also turns about the axis: the turn is no length of lining."""
    axial, radius = np.linspace(0.0, 0.04, 9), 0.25 - 0.03 * np.linspace(0.0, 1.0, 9)
    theta = np.linspace(0.0, 0.3, 9)
    points = np.stack([radius * np.cos(theta), radius * np.sin(theta), axial], axis=1)
    chord = np.linspace(0.0, 1.0, 9)
    np.testing.assert_allclose(tip_lengths(points, chord, np.linspace(0.0, 1.0, 5)), 0.05 / 8 * np.array([1, 2, 2, 2, 1]))
    np.testing.assert_allclose(tip_lengths(points, chord, np.array([0.5])), 0.05)
    assert tip_lengths(points, chord, np.array([0.0, 0.1, 0.5, 1.0])).sum() == pytest.approx(0.05)


def test_stiffness_at_the_tip_is_that_of_springs_side_by_side():
    """Three nodes that each move on a spring of their own, pressed in proportion to their lengths of tip."""
    model = with_static_modes(random_model(3), 1e-9)
    alone = replace(model, tip_lengths=np.array([1e-3, 2e-3, 1e-3]), tip_cone_angle=0.0)
    operator = np.zeros_like(alone.displacement_operator)
    operator[0, :, :3] = np.diag(np.sqrt(alone.squared_frequencies[:3]) / np.sqrt([1e6, 2e6, 4e6]))
    scene = Scene(Casing(1e-4), LINING)
    found = lining_at_tip(replace(alone, displacement_operator=operator), scene)
    assert found["tip_stiffness"] == pytest.approx(1.0 / (0.25**2 / 1e6 + 0.5**2 / 2e6 + 0.25**2 / 4e6))
    assert found["lining_elastic_stiffness"] == pytest.approx(4e-3 * 2e-4 * 20e9 / 5e-3)
    assert found["lining_plastic_stiffness"] == pytest.approx(found["lining_elastic_stiffness"] / 5.0)
    assert found["lined_tip_share"] == pytest.approx(1.0)
    published = replace(scene, lining=replace(LINING, bar_width=0.5e-3))
    assert lining_at_tip(alone, published)["lined_tip_share"] == pytest.approx(3 * 0.5e-3 / 4e-3)
    assert lining_at_tip(alone, replace(scene, lining=None)) == {}


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize(("integrator", "step"), [(EXACT_MODAL, 2e-5), (CENTRAL_DIFFERENCE, 1e-5)])
@pytest.mark.parametrize("exact", [False, True])
def test_every_bar_that_is_passed_is_worn_to_where_the_tip_was(engine, integrator, step, exact):
    """Steps of some thirty bars, round lobes that are there from the start: w = E x/(E + K) with the depth x at each bar."""
    casing = Casing(1e-4, lobes=2, amplitude=2.0, rise_fraction=0.0)
    model = oscillator(3e4) if integrator == CENTRAL_DIFFERENCE else with_static_modes(oscillator(3e4), 1e-6)
    scene = Scene(casing, replace(SOFT, bars=20_000), exact_gap=exact)
    choice = IntegrationChoice(step, 2, 20, integrator=integrator)
    _, state, _ = whole_run(model, 1000.0, scene, choice, engine=engine)
    angles = (np.arange(20_000) + 0.5) * 2.0 * np.pi / 20_000
    depth = np.maximum(casing.lobe(angles, 1.0, 0.0) - casing.clearance, 0.0)
    assert np.count_nonzero(depth) > 4000
    # chords in place of arcs between two steps
    np.testing.assert_allclose(state.wear[0], depth / 1.25, rtol=0, atol=2e-3 * depth.max())


def test_bars_that_are_narrower_than_a_step_do_not_change_the_motion():
    """A force is that of the place where a step ends, which has a bar of its own."""
    model, choice = with_static_modes(random_model(8), 1e-9), IntegrationChoice(3.2e-6, 3, 62, integrator=EXACT_MODAL)
    runs = []
    for bars in (20_000, 80_000):
        scene = replace(NARROW, lining=replace(LINING, bars=bars))
        _, state, record = whole_run(model, 1600.0, scene, choice)
        assert state.totals["steps_in_contact"] > 50
        runs.append(record.samples)
    np.testing.assert_array_equal(*runs)


def test_a_stopped_run_wears_the_same_bars(contact):
    """Also where a node presses the lining, or has just left it."""
    choice = IntegrationChoice(6.4e-6, 3, 62, integrator=EXACT_MODAL)
    scene = replace(NARROW, lining=LINING)
    simulation, whole, _ = whole_run(contact, 1700.0, scene, choice)
    state = simulation.start()
    for _ in range(3):
        simulation.advance(state, 1)
    np.testing.assert_array_equal(state.wear, whole.wear)
    again = Simulation(contact, 1700.0, scene, choice)
    state = again.start()
    for _ in range(3 * 62):
        again.advance_samples(state, 1)
    np.testing.assert_allclose(state.wear, whole.wear, rtol=1e-9, atol=1e-15)


def test_a_published_lining_on_patches_is_remarked_on(config_copy):
    """It belongs to the benchmark's eight points: elsewhere it depends on the number of contact nodes."""
    overlay(config_copy, "config.yaml", "scenes: [abradable, material_abradable]")
    assert not [*remarks_on_laws(read_settings(config_copy))]
    overlay(config_copy, "config.yaml", "structure: { boundary: { contact: patches } }")
    (remark,) = remarks_on_laws(read_settings(config_copy))
    assert remark.startswith("scene 'abradable': lining.bar_width_m and bar_area_m2 are the published model's")
    assert "the lining of Ref, L50, L100, ... depends on structure.boundary.nodes" in remark


def test_a_contact_length_and_the_area_of_a_bar_are_one_too_many(config_copy):
    overlay(config_copy, "scenes.yaml", "material_abradable: { lining: { bar_width_m: 0.002, contact_length_m: 2.0e-4 } }")
    overlay(config_copy, "config.yaml", "scenes: [material_abradable]")
    found = r"lining.contact_length_m: found bar_width_m and contact_length_m; allowed: one of them"
    with pytest.raises(ConfigError, match=found):
        read_settings(config_copy)
    overlay(config_copy, "scenes.yaml", "abradable: { lining: { bar_area_m2: 1.0e-6 } }")
    overlay(config_copy, "config.yaml", "scenes: [abradable]")
    with pytest.raises(ConfigError, match="bar_area_m2: found bar_width_m and bar_area_m2; allowed: one of them"):
        read_settings(config_copy)


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


SPREAD = {"casing.clearance_m": {"uniform_percent": 5}}
SPREAD_COLD = {"casing.clearance.cold_m": {"uniform_percent": 5}}
