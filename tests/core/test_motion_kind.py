"""Kind of a motion and its Lyapunov exponent, against closed forms."""

import copy
from dataclasses import replace

import numpy as np
import pytest
from defaults import Casing, IntegrationChoice, Scene
from integration_cases import ABRADABLE, DIRECT, RING, model_of_node, oscillator, random_model, with_static_modes
from reference_engine import ReferenceSimulation

from r37core.base.dataset_file import read_dataset
from r37core.config import ConfigError, checked_scene, command_line_document, plain
from r37core.product.extensions import read_settings
from r37core.results.response import write_response
from r37core.time_integration import motion_kind as kinds
from r37core.time_integration.carrying import CarriedMotion
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL
from r37core.time_integration.motion_kind import kind_numbers, kind_of_motion, samples_of_period
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.speed_file import read_speed, write_speed
from r37core.time_integration.speed_run import run_speed
from r37core.time_integration.status import MotionKind

CHOICE = IntegrationChoice(2e-6, 4, 124, integrator=EXACT_MODAL)
FREE = Scene(Casing(1.0, lobes=0), damping_ratio=0.004)
SPEED = 2000.0


def in_motion(simulation):
    state = simulation.start()
    state.displacement[:] = 1e-3
    return state


def test_neighbours_of_a_free_motion_meet_at_the_damping_of_the_slowest_mode():
    model = model_of_node([3 * [1.0], 3 * [0.0], 3 * [0.0]], [5000.0, 50_000.0, 51_000.0])
    simulation = Simulation(model, SPEED, FREE, CHOICE)
    state = in_motion(simulation)
    before = copy.deepcopy(state)
    kind = kind_of_motion(simulation, state)
    assert kind.kind is MotionKind.FREE
    assert kind.exponent == pytest.approx(-FREE.damping_ratio * 5000.0 * 2.0 * np.pi / SPEED, rel=1e-2)
    np.testing.assert_array_equal(state.displacement, before.displacement)


@pytest.fixture
def hopping():
    """A mass that hops on a lobed casing through a spring."""
    scene = Scene(Casing(0.356e-3, lobes=1, amplitude=1.5, rise_fraction=0.0), damping_ratio=0.02)
    simulation = Simulation(with_static_modes(oscillator(5000.0), 1e-7), 5250.0, scene, CHOICE)
    state = simulation.start()
    simulation.advance(state, 400)
    return simulation, state


def test_a_motion_with_the_period_of_the_casing(hopping):
    kind = kind_of_motion(*hopping)
    assert kind.kind is MotionKind.PERIODIC
    assert kind.period == 1.0
    assert kind.recurrence < 1e-9
    # a spring neither adds nor takes energy: neighbours meet at the damping of the mode
    assert kind.exponent == pytest.approx(-0.02 * 5000.0 * 2.0 * np.pi / 5250.0, rel=1e-2)


def test_the_twin_s_forces_are_brought_back_with_its_motion(hopping):
    state = hopping[1]
    twin = copy.deepcopy(state)
    state.contact_force[:], twin.contact_force[:] = 10.0, 16.0
    kinds._bring_back(twin, state, 3.0)
    np.testing.assert_array_equal(twin.contact_force, 12.0)
    np.testing.assert_array_equal(state.contact_force, 10.0)


@pytest.mark.slow
def test_the_engines_agree_on_a_kind(hopping, monkeypatch):
    monkeypatch.setattr(kinds, "COUNTED", 10)
    monkeypatch.setattr(kinds, "MOST_PERIODS", 2)
    simulation, state = hopping
    one, other = (kind_of_motion(each, state) for each in (simulation, ReferenceSimulation.build(simulation.problem)))
    assert other.exponent == pytest.approx(one.exponent, rel=1e-6)
    assert other.kind == one.kind


def test_neighbours_of_a_chaotic_motion_part(contact):
    simulation = Simulation(contact, 1340.0, DIRECT, IntegrationChoice(6.4e-6, 4, 248, integrator=EXACT_MODAL))
    state = simulation.start()
    simulation.advance(state, 100)
    kind = kind_of_motion(simulation, state)
    assert kind.kind is MotionKind.CHAOTIC
    assert kind.exponent > 5.0 * kind.error > 0.0
    assert kind.recurrence > 0.1


@pytest.mark.parametrize(
    ("exponent", "error", "recurrence", "period", "expected"),
    [
        (0.5, 0.1, 1e-6, 1, MotionKind.PERIODIC),
        (0.5, 0.1, 1e-6, 3, MotionKind.MULTIPLE),
        (0.5, 0.1, 1.0, 3, MotionKind.CHAOTIC),
        (0.1, 0.1, 1.0, 3, MotionKind.QUASI_PERIODIC),
        (-0.1, 0.1, 1.0, 1, MotionKind.QUASI_PERIODIC),
        (-0.5, 0.1, 0.1, 2, MotionKind.CONVERGING),
    ],
)
def test_kinds_by_their_numbers(exponent, error, recurrence, period, expected):
    assert kinds._kind(exponent, error, recurrence, period) is expected


def test_a_rotation_recurs_after_its_period():
    turn = 2.0 * np.pi * np.arange(121) / 5.0
    states = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    assert kinds._recurrence(states, 1.0) == (pytest.approx(0.0, abs=1e-12), 5)
    incommensurate = np.stack([np.cos(turn * np.sqrt(2.0)), np.sin(turn * np.sqrt(2.0))], axis=1)
    assert kinds._recurrence(incommensurate, 1.0)[0] > 1e-2


def test_a_run_that_diverged_has_no_kind(hopping):
    simulation, state = hopping
    numbers = kind_numbers(simulation.problem, state, diverged=True)
    assert numbers["motion_kind"] == MotionKind.UNKNOWN
    assert np.isnan(numbers["lyapunov_exponent"])
    state.displacement[:] = 10.0
    assert kind_of_motion(simulation, state).kind is MotionKind.UNKNOWN


@pytest.mark.parametrize(("lobes", "samples"), [(0, 124), (1, 124), (2, 62), (3, 124), (4, 31), (8, 31)])
def test_the_period_of_a_casing(lobes, samples):
    model = with_static_modes(oscillator(5000.0), 1e-7)
    bare, lined = (replace(scene, casing=replace(scene.casing, lobes=lobes)) for scene in (DIRECT, ABRADABLE))
    assert samples_of_period(Simulation(model, SPEED, bare, CHOICE).problem) == samples
    assert samples_of_period(Simulation(model, SPEED, lined, CHOICE).problem) == 124


@pytest.mark.parametrize("integrator", [EXACT_MODAL, CENTRAL_DIFFERENCE])
@pytest.mark.parametrize("scene", ["direct", "abradable", "ring"])
def test_a_carried_motion_goes_on_as_if_nothing_had_happened(scene, integrator):
    scenes = {"direct": DIRECT, "abradable": ABRADABLE}
    scenes["ring"] = replace(DIRECT, casing=replace(DIRECT.casing, ring=RING.modes()))
    # as many modes as in the basis, so that nothing of it is lost
    model = replace(random_model(8), squared_frequencies=np.linspace(5e3, 3e5, 24) ** 2)
    choice = IntegrationChoice(2e-7, 4, 31, integrator=integrator)
    simulation = Simulation(model, 12_000.0, scenes[scene], choice)
    state = simulation.start()
    simulation.advance(state, 2)
    carried = CarriedMotion.ended(simulation.problem, state, keep_wear=True)
    other = simulation.start(carried)
    np.testing.assert_allclose(other.displacement, state.displacement, rtol=0.0, atol=1e-12 * np.abs(state.displacement).max())
    expected, motion = simulation.advance(state, 1).samples, simulation.advance(other, 1).samples
    np.testing.assert_allclose(motion, expected, rtol=0.0, atol=1e-6 * np.abs(expected).max())


def test_a_carried_motion_keeps_its_energy_at_another_speed(contact):
    choice = IntegrationChoice(6.4e-6, 4, 248, integrator=EXACT_MODAL)
    before, after = (Simulation(contact, speed, DIRECT, choice) for speed in (1340.0, 1340.001))
    state = before.start()
    before.advance(state, 20)
    carried = CarriedMotion.ended(before.problem, state)
    other = after.start(carried)
    assert after.energy(other) == pytest.approx(before.energy(state), rel=1e-4)
    # what is carried is its own: the run goes on
    force = carried.contact_force.copy()
    before.advance(state, 1)
    np.testing.assert_array_equal(carried.contact_force, force)


def test_a_run_keeps_the_kind_that_is_asked_for(contact, tmp_path):
    choice = IntegrationChoice(6.4e-6, 4, 62, integrator=EXACT_MODAL)
    files = []
    for number, results in enumerate(((), ("motion_kind",))):
        run = run_speed(contact, 1340.0, DIRECT, choice, results, spectrum_highest_order=4, wear_angles=8)
        files.append(tmp_path / f"{number}.npz")
        write_speed(run, files[-1], {})
    without, asked = (read_speed(file) for file in files)
    added = "motion_kind lyapunov_exponent lyapunov_exponent_error recurrence recurrence_period"
    assert asked.keys() - without.keys() == {*added.split()}
    for name, value in without.items():
        np.testing.assert_array_equal(asked[name], value, err_msg=name)
    write_response(files[1:], [1340.0], tmp_path / "response.nc", stress_history_speeds=(), yield_stress=1e9, provenance={})
    response = read_dataset(tmp_path / "response.nc")
    assert MotionKind(int(response["motion_kind"][0])) is MotionKind.CHAOTIC
    assert response["motion_kind"].attrs["flag_meanings"].split()[MotionKind.CHAOTIC] == "chaotic"
    assert response["lyapunov_exponent"][0] > 0.0


def test_a_rotor_has_no_kind(root):
    entry = plain(read_settings(root, command_line_document({"scenes": "all"})).scene_designs.entries["rotor_abradable"])
    with pytest.raises(ConfigError, match="found motion_kind; allowed: only in a scene without rotor"):
        checked_scene(entry | {"results": ["motion_kind"]})
