"""Damping ratios over the frequency of a mode: the number, closed forms, both engines, and what is refused."""

from dataclasses import replace

import numpy as np
import pytest
from defaults import Casing, IntegrationChoice, Scene
from integration_cases import RING, SCENES, model_of_node, oscillator, random_model, with_static_modes
from integration_runs import ENGINES, assert_close, assert_same_record, assert_same_state, both_engines, free_motion, times
from integration_runs import whole_run as run_of

from r37core.base.plain import from_plain, to_plain
from r37core.config import ConfigError, Document, checked_scene
from r37core.config.changed_numbers import scene_numbers
from r37core.config.scenes import SceneEntry
from r37core.contact.scene import DampingTable, Rotor
from r37core.time_integration.initial_motion import InitialMotion
from r37core.time_integration.integrators import EXACT_MODAL, INTEGRATORS, exact_modal, recursion
from r37core.time_integration.problem import Problem
from r37core.time_integration.rotor_blades import blade_problems
from r37core.time_integration.segments import segments_at

CHOICE = IntegrationChoice(1e-6, 2, 31, integrator=EXACT_MODAL)
RISING = DampingTable((1000.0, 8000.0, 20_000.0), (0.0005, 0.002, 0.05))
FREE = Scene(Casing(1.0, lobes=0), divergence_limit=10.0)
ELASTIC = replace(SCENES["abradable"], casing=replace(SCENES["abradable"].casing, ring=RING.modes()))
RUNS = {"direct": SCENES["direct"], "elastic casing": ELASTIC}


def blade(coriolis):
    coupling = 3.0 * np.random.default_rng(9).standard_normal((20, 20))
    return with_static_modes(replace(random_model(4, 20), coriolis=coupling - coupling.T if coriolis else None), 1e-9)


def with_damping(scene, damping_ratio):
    return replace(scene, damping_ratio=damping_ratio)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("coriolis", [False, True])
@pytest.mark.parametrize("name", RUNS)
def test_equal_ratios_give_the_bits_of_the_number(name, coriolis, engine):
    model = blade(coriolis)
    motion = InitialMotion(1e-6 * np.ones(len(model.to_reduced)), None)
    (one, ours, found), (other, theirs, expected) = (
        run_of(model, 12_000.0, with_damping(RUNS[name], damping), CHOICE, motion, engine)
        for damping in (0.03, DampingTable((10.0, 9e3), (0.03, 0.03)))
    )
    assert ours.totals["steps_in_contact"] > 20
    np.testing.assert_array_equal(found.samples, expected.samples)
    np.testing.assert_array_equal(ours.increment, theirs.increment)
    if not coriolis:
        ours, theirs = (segments_at(run.problem, np.array([11_000.0, 12_000.0])) for run in (one, other))
        np.testing.assert_array_equal(ours.recursion.keep, theirs.recursion.keep)
        np.testing.assert_array_equal(ours.increments.velocity_factor, theirs.increments.velocity_factor)


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_so_does_every_ratio(integrator):
    frequencies = np.geomspace(1e3, 1e6, 50)
    for ratio in np.linspace(0.0, 0.99, 500).tolist():
        one, many = (recursion(integrator, frequencies, damping, 1e-7) for damping in (ratio, np.full(50, ratio)))
        np.testing.assert_array_equal(list(vars(one).values()), list(vars(many).values()))


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize(("frequency", "ratio"), [(500.0, 0.0005), (4500.0, 0.00125), (14_000.0, 0.026), (30_000.0, 0.05)])
def test_a_mode_between_two_frequencies_decays_as_the_closed_form(engine, frequency, ratio):
    omega = 2.0 * np.pi * frequency
    model, choice = with_static_modes(oscillator(omega), 1e-9), replace(CHOICE, time_step=5e-6)
    start = InitialMotion(np.array([1e-3]), None)
    simulation, _, record = run_of(model, 1000.0, with_damping(FREE, RISING), choice, start, engine)
    assert_close(record.samples[:, 0], free_motion(omega, ratio, times(simulation, 62), 1e-3, 0.0), 1e-10)


@pytest.mark.parametrize("coriolis", [False, True])
@pytest.mark.parametrize("name", RUNS)
def test_both_engines_agree(name, coriolis):
    (_, ours, found), (_, theirs, expected) = both_engines(blade(coriolis), 12_000.0, with_damping(RUNS[name], RISING), CHOICE)
    assert_same_record(found, expected, 1e-8)
    assert_same_state(ours, theirs, 1e-8)


def test_the_frequency_is_that_of_the_speed_and_of_the_blade():
    """In a run-up it rises with the speed; a mistuned blade of a rotor has its own."""
    rest, per_square, speed = 2.0 * np.pi * 4000.0, 20.0, 1000.0
    model = with_static_modes(model_of_node([[1.0], [0.0], [0.0]], [rest], per_square=per_square), 1e-9)
    problem, speeds = Problem(model, speed, with_damping(FREE, RISING), CHOICE), np.array([1000.0, 2000.0])
    frequencies = np.sqrt(rest**2 + per_square * speeds**2)
    steps = 2.0 * np.pi / speeds / problem.grid.steps_per_revolution
    ratios = 0.0005 + 0.0015 * (frequencies / 2.0 / np.pi - 1000.0) / 7000.0
    keep = segments_at(problem, speeds).recursion.keep[:, 0]
    np.testing.assert_allclose(keep, exact_modal(frequencies, ratios, steps).keep, rtol=1e-12)
    rotor = Rotor((1, 2), (0.0, np.pi), (1.0, 1.5), (0.0, 0.0))
    lined = with_damping(replace(SCENES["abradable"], rotor=rotor), RISING)
    tuned = [one.blade for one in blade_problems(with_static_modes(oscillator(rest), 1e-9), speed, lined, rotor, CHOICE)]
    expected = [0.0005 + 0.0015 * 3.0 / 7.0, 0.0005 + 0.0015 * 5.0 / 7.0]
    assert [one.scene.damping(one.frequencies)[0] for one in tuned] == pytest.approx(expected)


CASING = {"casing": {"clearance_m": 2e-4}}
TABLE = {"frequencies_hz": [1000, 8000], "ratios": [0.0005, 0.005]}


def test_the_table_of_a_file_reaches_the_jobs_and_is_no_number_that_varies():
    entry = Document("scenes.yaml", CASING | {"damping_ratio": TABLE}).check(SceneEntry)
    scene = entry.scene()
    assert scene.damping_ratio == DampingTable((1000.0, 8000.0), (0.0005, 0.005))
    assert from_plain(type(scene), to_plain(scene)) == scene
    assert not any("damping" in key for key in scene_numbers(entry))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"frequencies_hz": [8000, 1000]}, r"damping_ratio\.frequencies_hz: found \[8000.0, 1000.0\]; allowed: ascending freq"),
        ({"ratios": [0.1] * 3}, r"damping_ratio\.ratios: found 3 numbers for 2 frequencies; allowed: one for each frequency"),
    ],
)
def test_a_table_that_cannot_be_is_refused(change, message):
    with pytest.raises(ConfigError, match=message) as refusal:
        checked_scene(CASING | {"damping_ratio": TABLE | change})
    assert "\n" not in str(refusal.value)
