"""Damping ratios over the frequency of a mode, by mode and by speed: closed forms, both engines, and what is refused."""

from dataclasses import dataclass, replace
from typing import Annotated

import numpy as np
import pytest
from defaults import Casing, IntegrationChoice, Scene
from integration_cases import RING, SCENES, model_of_node, oscillator, random_model, with_static_modes
from integration_runs import ENGINES, assert_close, assert_same_record, assert_same_state, free_motion, times
from integration_runs import whole_run as run_of
from motion_at_start import MotionAtStart
from pydantic import TypeAdapter

from r37core.base.declared import Key
from r37core.base.plain import from_plain, to_plain
from r37core.config import Document
from r37core.config.changed_numbers import scene_numbers
from r37core.config.declaring import section_of, si
from r37core.config.scenes import DampingSection, SceneEntry
from r37core.config.section import either
from r37core.contact.scene import DampingRow, DampingTable, Rotor
from r37core.time_integration.integrators import EXACT_MODAL, INTEGRATORS, exact_modal, recursion
from r37core.time_integration.problem import Problem
from r37core.time_integration.rotor_blades import blade_problems
from r37core.time_integration.segments import segments_at

CHOICE = IntegrationChoice(1e-6, 2, 31, integrator=EXACT_MODAL)
RISING = DampingTable((1000.0, 8000.0, 20_000.0), (0.0005, 0.002, 0.05))
FREE = Scene(Casing(1.0, lobes=0), divergence_limit=10.0)
ELASTIC = replace(SCENES["abradable"], casing=replace(SCENES["abradable"].casing, ring=RING.modes()))
RUNS = {"direct": SCENES["direct"], "elastic casing": ELASTIC}


BLADE = with_static_modes(random_model(4, 20), 1e-9)


def with_damping(scene, damping_ratio):
    return replace(scene, damping_ratio=damping_ratio)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("name", RUNS)
def test_equal_ratios_give_the_bits_of_the_number(name, engine):
    model = BLADE
    motion = MotionAtStart(1e-6 * np.ones(len(model.to_reduced)))
    (one, ours, found), (other, theirs, expected) = (
        run_of(model, 12_000.0, with_damping(RUNS[name], damping), CHOICE, motion, engine)
        for damping in (0.03, DampingTable((10.0, 9e3), (0.03, 0.03)))
    )
    assert ours.totals["steps_in_contact"] > 20
    np.testing.assert_array_equal(found.samples, expected.samples)
    np.testing.assert_array_equal(ours.increment, theirs.increment)
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
    start = MotionAtStart(np.array([1e-3]))
    simulation, _, record = run_of(model, 1000.0, with_damping(FREE, RISING), choice, start, engine)
    assert_close(record.samples[:, 0], free_motion(omega, ratio, times(simulation, 62), 1e-3, 0.0), 1e-10)


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
    assert [one.scene.damping(one.frequencies, speed)[0] for one in tuned] == pytest.approx(expected)


ROWS = (DampingRow(0.03, 1, 2000.0), DampingRow(0.002), DampingRow(0.01, 1, 1000.0))
"""Of the first mode at two speeds, and of all others."""


@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize(("speed", "first"), [(500.0, 0.01), (1250.0, 0.015), (3000.0, 0.03)])
@pytest.mark.parametrize("mode", [0, 1])
def test_the_logarithmic_decrement_of_each_mode_is_that_of_its_ratio(integrator, speed, first, mode):
    """Of successive maxima, ln(u_k/u_(k+n)) = 2 pi n xi/sqrt(1 - xi^2)."""
    frequencies, ratio = [4000.0, 5000.0], (first, 0.002)[mode]
    start = MotionAtStart(1e-3 * np.eye(2)[mode])
    choice = replace(CHOICE, time_step=5e-6, samples_per_revolution=400, revolutions=4, integrator=integrator)
    model = model_of_node([[1.0, 1.0], [0.0, 0.0], [0.0, 0.0]], frequencies)
    if integrator == EXACT_MODAL:
        model = with_static_modes(model, 1e-9)
    found = run_of(model, speed, with_damping(FREE, ROWS), choice, start)[2].samples[:, 0]
    middle, before, after = found[1:-1], found[:-2], found[2:]
    peaks = np.flatnonzero((middle > before) & (middle >= after))
    # of the parabola through three samples
    heights = middle[peaks] + 0.125 * (after - before)[peaks] ** 2 / (2.0 * middle - before - after)[peaks]
    decrement = np.log(heights[0] / heights[-1]) / (len(peaks) - 1)
    assert decrement / np.hypot(decrement, 2.0 * np.pi) == pytest.approx(ratio, rel=1e-3)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("name", RUNS)
def test_rows_are_a_table_over_the_frequencies_of_their_modes(name, engine):
    model, speed, scene = BLADE, 12_000.0, RUNS[name]
    motion = MotionAtStart(1e-6 * np.ones(len(model.to_reduced)))
    stepped = Problem(model, speed, scene, CHOICE).blade
    hertz = stepped.frequencies / (2.0 * np.pi)
    table = DampingTable((hertz[0], hertz[1], hertz[2]), (0.0625, 0.125, 0.001))
    # halfway between two speeds
    rows = (DampingRow(0.001), DampingRow(0.0625, 1), DampingRow(0.0, 2, 11_000.0), DampingRow(0.25, 2, 13_000.0))
    (_, ours, found), (_, theirs, expected) = (
        run_of(model, speed, with_damping(scene, damping), CHOICE, motion, engine) for damping in (rows, table)
    )
    assert ours.totals["steps_in_contact"] > 20
    assert_same_record(found, expected, 1e-9)
    assert_same_state(ours, theirs, 1e-9)


def test_the_ratio_of_a_run_up_is_that_of_each_speed():
    model, speeds = with_static_modes(oscillator(4000.0), 1e-9), np.array([500.0, 1250.0, 3000.0])
    problem = Problem(model, 1000.0, with_damping(FREE, ROWS), CHOICE)
    steps = 2.0 * np.pi / speeds / problem.grid.steps_per_revolution
    expected = exact_modal(np.full(3, 4000.0), np.array([0.01, 0.015, 0.03]), steps).keep
    np.testing.assert_allclose(segments_at(problem, speeds).recursion.keep[:, 0], expected, rtol=1e-12)


CASING = {"casing": {"clearance_m": 2e-4}}
TABLE = {"frequencies_hz": [1000, 8000], "ratios": [0.0005, 0.005]}


def test_the_table_of_a_file_reaches_the_jobs_and_is_no_number_that_varies():
    entry = Document("scenes.yaml", CASING | {"damping_ratio": TABLE}).check(SceneEntry)
    scene = entry.scene()
    assert scene.damping_ratio == DampingTable((1000.0, 8000.0), (0.0005, 0.005))
    assert from_plain(type(scene), to_plain(scene)) == scene
    assert not any("damping" in key for key in scene_numbers(entry))


@dataclass(frozen=True)
class Proportional:
    mass: Annotated[float, Key("of the mass", "_rad_s", ge=0)]
    stiffness: Annotated[float, Key("of the stiffness", "_s", ge=0)]

    def damping(self, frequencies, speed):
        return 0.5 * (self.mass / frequencies + self.stiffness * frequencies)


def test_a_second_law_is_a_dataclass_and_its_section():
    """One in contact/scene.py, the other in config/scenes.py."""
    laws = TypeAdapter(either(float, DampingSection, section_of(Proportional, "Damping in proportion.")))
    law = si(laws.validate_python({"mass_rad_s": 4.0, "stiffness_s": 0.5}))
    assert with_damping(FREE, law).damping(np.array([1.0, 2.0]), 100.0).tolist() == [2.25, 1.5]
    assert si(laws.validate_python(TABLE)) == DampingTable((1000.0, 8000.0), (0.0005, 0.005))


ROW = {"ratio": 0.001}


def test_rows_of_a_file_have_a_range():
    rows = [ROW | {"lowest": 0.0, "highest": 0.004}, {"mode": 1, "ratio": 0.002, "speed_rpm": 6000}]
    scene = Document("scenes.yaml", CASING | {"damping_ratio": rows}).check(SceneEntry).scene()
    ratios = lambda damped: damped.damping(np.ones(3), 100.0).tolist()  # noqa: E731
    assert scene.damping_ratio[1].speed == pytest.approx(200.0 * np.pi)
    assert from_plain(type(scene), to_plain(scene)) == scene
    assert ratios(scene) == [0.002, 0.001, 0.001]
    assert ratios(scene.damped("lowest")) == [0.002, 0.0, 0.0]
    assert ratios(scene.damped("highest")) == [0.002, 0.004, 0.004]
    assert FREE.damped("lowest") is FREE
