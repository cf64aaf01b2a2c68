"""The Coriolis force in the time integration: exact solutions, the reference engine, energy, limits and refusals."""

from dataclasses import replace

import numpy as np
import pytest
from defaults import Casing, Friction, IntegrationChoice, Scene
from integration_cases import ABRADABLE, DIRECT, ELASTIC, NARROW, SCENES, model_of_node, random_model, with_static_modes
from integration_runs import (
    ENGINES,
    assert_close,
    assert_same_record,
    assert_same_state,
    assert_stable,
    both_engines,
    times,
    whole_run,
)
from reference_motion import CoupledMotion
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from r37core.config import ConfigError, command_line_document
from r37core.product.extensions import read_settings
from r37core.rom.reduced_model import contact_model
from r37core.run_ups.choice import RunUp
from r37core.run_ups.integration import RunUpIntegration
from r37core.time_integration import problem as problem_module
from r37core.time_integration import step_limit
from r37core.time_integration.gyroscopic import LARGEST_TURN
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL
from r37core.time_integration.problem import Problem, UnstableStepError
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.step_checks import pressed_ratio
from r37core.trials import stability, tradeoff

CHOICE = IntegrationChoice(2e-7, 1, 62, integrator=EXACT_MODAL)
FREE = Scene(Casing(1.0, lobes=0), damping_ratio=0.0, divergence_limit=10.0)
TURN = np.array([[0.0, -2.0], [2.0, 0.0]])
"""2 Omega z x velocity of a point, per Omega."""

STATIC = 1e-9
"""Flexibility (m/N) of static modes."""


def pendulum(frequencies, **others):
    """A point whose modes move it radially and tangentially in turn, alike in all directions across the axis."""
    pairs = len(frequencies) // 2
    others = {"coriolis": np.kron(np.eye(pairs), TURN)} | others
    return model_of_node(np.tile(np.eye(3)[:, :2], pairs), frequencies, **others)


def coupled_model(nodes=8, size=3.0):
    """A blade of random nodes and modes, with a Coriolis matrix of random numbers of about this size, that rotation moves."""
    model, generator = random_model(nodes), np.random.default_rng(nodes + 1)
    modes = len(model.squared_frequencies)
    coupling = size * generator.standard_normal((modes, modes))
    moved = 2e-12 * generator.standard_normal(model.rotation_shapes.shape)
    return with_static_modes(replace(model, coriolis=coupling - coupling.T, rotation_shapes=moved), STATIC)


def moving(simulation, displacement, velocity):
    """A state with displacement and velocity of the speed's real modes."""
    problem, state = simulation.problem, simulation.start()
    motion = np.concatenate([problem.blade.frequencies * displacement, velocity])
    CoupledMotion(problem, problem.contact.recursion).write(motion, state)
    return state


@pytest.mark.parametrize("jumps", [True, False])
@pytest.mark.parametrize("engine", ENGINES)
def test_foucault_pendulum(jumps, engine):
    """In the fixed frame it is a plain oscillator; the rotor's frame turns under it, hundreds of turns."""
    frequency, speed = 5000.0, 1300.0
    choice = replace(CHOICE, time_step=2e-5, revolutions=300 if engine == "compiled" else 10, jumps=jumps)
    model = with_static_modes(pendulum([frequency, frequency], per_square=-1.0), STATIC)
    simulation = ENGINES[engine](model, speed, FREE, choice)
    start, velocity = np.array([1e-3, 2e-3]), np.array([3.0, -1.0])
    state = moving(simulation, start, velocity)
    record = simulation.advance(state, choice.revolutions)
    # the velocity in the fixed frame has that of the frame, Omega z x start
    fixed = velocity + speed * np.array([-start[1], start[0]])
    time = times(simulation, len(record.samples))[:, None]
    motion = start * np.cos(frequency * time) + fixed / frequency * np.sin(frequency * time)
    seen = (motion[:, 0] + 1j * motion[:, 1]) * np.exp(-1j * speed * time[:, 0])
    assert (state.totals["steps_jumped"] > 0) == (jumps and engine == "compiled")
    assert_close(record.samples[:, 1] + 1j * record.samples[:, 2], seen, 1e-10)


@pytest.fixture(scope="module")
def coupled_blade(turning):
    return contact_model(turning, "pressure_edge")


@pytest.mark.slow
def test_free_motion_has_the_frequencies_of_the_campbell_diagram(turning, coupled_blade):
    """Each mode alone: three samples in a row obey the recursion of its frequency."""
    speed = 1800.0
    campbell, without = (model.modes(speed, 8)[0] for model in (turning, replace(turning, coriolis=None)))
    assert np.abs(campbell / without - 1.0).max() > 1e-4
    simulation = Simulation(coupled_blade, speed, FREE, CHOICE)
    stepped = simulation.problem.blade.complex_modes.frequencies[:8]
    # static modes are not coupled, but they are fast
    np.testing.assert_allclose(stepped, campbell, rtol=1e-6)
    for mode, frequency in enumerate(stepped):
        state = simulation.start()
        state.displacement[mode] = state.increment[mode] = 1e-6
        record = simulation.advance(state, 1)
        samples, turn = record.samples, 2.0 * np.cos(frequency * times(simulation, 1)[0])
        missing = samples[2:] + samples[:-2] - turn * samples[1:-1]
        assert np.abs(missing).max() < 1e-8 * np.abs(samples).max(), mode
    # with more static modes
    lined = Problem(coupled_blade, speed, NARROW, replace(CHOICE, time_step=6.4e-6))
    assert len(lined.blade.frequencies) < len(coupled_blade.squared_frequencies)
    np.testing.assert_allclose(lined.blade.complex_modes.frequencies[:8], campbell, rtol=1e-5)


SCENES = SCENES | {"abradable_growing": replace(ABRADABLE, casing=replace(ABRADABLE.casing, centrifugal=True))}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "step", "static_above"),
    [
        *((name, step, 1.0) for name in SCENES for step in (2e-7, 1.2e-6)),
        *((name, 8.1e-7, 2.5) for name in ("direct", "abradable")),
    ],
)
def test_compiled_time_integration_is_the_reference(name, step, static_above, monkeypatch):
    """Against the dense exponential of displacement and velocity; in long steps modes are static, or too fast to couple."""
    # nearer to the limit than a run with friction may be
    monkeypatch.setattr(step_limit, "WITH_FRICTION", 1.0)
    choice = replace(CHOICE, time_step=step, static_above=static_above, snapshots_per_revolution=62, snapshot_revolutions=1)
    (_, ours, record), (simulation, theirs, plain) = both_engines(coupled_model(), 12_000.0, SCENES[name], choice)
    blade = simulation.problem.blade
    assert len(blade.frequencies) == (24 if step < 1e-6 else 8)
    assert (blade.frequencies[-1] * step > LARGEST_TURN) == (static_above > 2.0)
    assert blade.complex_modes.shapes.imag.any()
    assert ours.totals["steps_in_contact"] > 100 and ours.totals["steps_jumped"] > 100
    assert_same_record(record, plain)
    for name in ("displacement", "increment"):
        assert_close(getattr(ours, name), getattr(theirs, name), 1e-9)
    assert_same_state(ours, theirs)


@pytest.mark.parametrize("name", ["direct", "abradable", "thin_lining"])
def test_without_a_force_to_speak_of_it_is_the_run_without(name):
    """A Coriolis matrix that tends to zero, in the program that has complex modes."""
    model = coupled_model()
    weak, none = (replace(model, coriolis=coriolis) for coriolis in (1e-14 * model.coriolis, None))
    (_, state, found), (_, _, expected) = (whole_run(one, 3000.0, SCENES[name], CHOICE) for one in (weak, none))
    assert state.totals["steps_in_contact"] > 100
    assert_close(found.samples, expected.samples, 1e-11)


@pytest.mark.parametrize("name", ["direct", "direct_exact", "abradable", "abradable_constant", "thin_lining"])
@pytest.mark.parametrize(("size", "ratio"), [(1.0, 5e-4), (30.0, 0.0), (30.0, 0.05)])
def test_energy_balance_closes(name, size, ratio):
    scene = replace(SCENES[name], damping_ratio=ratio)
    simulation, state, _ = whole_run(coupled_model(8, size), 3000.0, scene, replace(CHOICE, revolutions=3))
    work, loss = simulation.work(state), state.totals["loss"]
    assert (loss > 0.0) == (ratio > 0.0) and work != 0.0
    assert abs(simulation.energy(state) - work + loss) < 1e-10 * (abs(work) + loss)


PRESSED = Scene(
    Casing(-1e-4, lobes=2, amplitude=0.2, rise_fraction=0.0), ELASTIC, Friction(0.4), damping_ratio=0.0, divergence_limit=1.0
)
"""Lobes and a bar that the node never leaves: what happens is smooth."""


def point_in_space(frequencies, radius=0.25):
    """A point that moves in three directions, with a Coriolis matrix between all of them."""
    coriolis = np.array([[0.0, -2.0, 1.5], [2.0, 0.0, 0.5], [-1.5, -0.5, 0.0]])
    return model_of_node(np.diag([1.0, 1.0, -1.0]), frequencies, radius, coriolis=coriolis)


def on_modes(contact, force):
    """What a force (N), shape (3,), on the only node is on the modes, by their u and by their d."""
    return [np.einsum("dki,d->i", rows, force) for rows in (contact.displacement_operator, contact.increment_operator)]


# the slow one's friction turns about with the vibration
@pytest.mark.parametrize("radius", [0.25, 1e-4])
def test_error_on_an_elastic_bar_falls_with_the_square_of_the_step(radius):
    """A node on its bar, with friction along the real sliding velocity; exact: SciPy's DOP853."""
    frequency, speed = 3000.0, 1000.0
    casing, lining, model = PRESSED.casing, PRESSED.lining, point_in_space(3 * [frequency], radius)
    # with the static mode in series
    flexibility = 1e-7
    stiffness = 1.0 / (lining.thickness / lining.elastic_modulus / lining.bar_area + flexibility)

    def motion(time, state):
        position, velocity = state[:3], state[3:]
        shape = casing.shape(np.array([-speed * time]))[0]
        pressed = stiffness * (position[0] - casing.clearance * (1.0 - casing.amplitude * shape))
        assert pressed > 0.0
        # normal, tangent and meridian, which points against the third mode
        sliding = np.array([0.0, -radius * speed + velocity[1], velocity[2]])
        force = np.array([-pressed, 0.0, 0.0]) - 0.4 * pressed * sliding / np.linalg.norm(sliding)
        return np.concatenate([velocity, force - frequency**2 * position - speed * model.coriolis @ velocity])

    # whatever the step, of samples there are fifty in a revolution
    time = 2.0 * np.pi / speed / 50 * np.arange(1, 51)
    exact = solve_ivp(motion, (0.0, time[-1]), np.zeros(6), "DOP853", time, rtol=1e-12, atol=1e-16, max_step=1e-5).y
    errors, steps = [], []
    for step in (1.6e-5, 8e-6, 4e-6, 2e-6):
        choice = replace(CHOICE, time_step=step, samples_per_revolution=50)
        simulation = Simulation(with_static_modes(model, flexibility), speed, PRESSED, choice)
        problem, state = simulation.problem, simulation.start()
        # the lining's force at the start, against the rotation, of whose kick only the second half comes after it
        force = stiffness * (casing.clearance - casing.lobe(model.theta, np.zeros(1), 0.0)[0]) * np.array([1.0, -0.4, 0.0])
        state.contact_force[:, 0] = force
        by_u, by_d = on_modes(problem.contact, force)
        state.displacement[:], state.increment[:] = 0.5 * problem.contact.recursion.inverse * np.array([by_d, -by_u])
        record = simulation.advance(state, 1)
        np.testing.assert_allclose(times(simulation, 50), time, rtol=1e-12)
        errors.append(np.abs(record.samples[:, [1, 2]].T - exact[:2]).max() / np.abs(exact[:2]).max())
        steps.append(simulation.problem.grid.time_step)
    orders = np.diff(np.log(errors)) / np.diff(np.log(steps))
    assert errors[0] < 3e-2
    assert np.all((orders > 1.9) & (orders < 2.1)), orders


def resting(simulation, force):
    """The state in which undamped modes rest under a force (N), shape (3,), of the lining on the only node.

    Solution of d = d + c a - pull (u - c b), u = u - c b + d for u and d before the kick, with the kick's a and b.
    """
    problem, state = simulation.problem, simulation.start()
    recursion, (by_u, by_d) = problem.contact.recursion, on_modes(problem.contact, force)
    state.displacement[:] = recursion.inverse * (by_u / recursion.pull + by_d)
    state.increment[:] = recursion.inverse * by_d
    state.contact_force[:, 0] = force
    return state


def test_a_pressed_node_rests_where_the_stiffness_says():
    """A casing too tight for the blade, friction, and steps in which the modes turn by up to 48 degrees."""
    penetration, frequency, speed = 1e-4, 4e4, 2000.0
    scene = replace(PRESSED, casing=Casing(-penetration, lobes=0), friction=Friction(0.3))
    model = point_in_space([4e4, 3e4, 5.6e4])
    flexibility = 2e-7
    simulation = Simulation(with_static_modes(model, flexibility), speed, scene, replace(CHOICE, time_step=1.5e-5))
    stiffness = 1.0 / (1.0 / simulation.problem.casing.lining_stiffness[0] + flexibility)
    force = stiffness * penetration / (1.0 + stiffness / frequency**2) * np.array([-1.0, 0.3, 0.0])
    state = resting(simulation, force)
    assert np.abs(state.increment).max() > 1e-3 * np.abs(state.displacement).max()
    samples = simulation.advance(state, 1).samples
    np.testing.assert_allclose(samples[:, 1] / (force[0] / 4e4**2), 1.0, rtol=1e-8)
    np.testing.assert_allclose(samples[:, 2] / (force[1] / 3e4**2), 1.0, rtol=1e-8)


@pytest.mark.parametrize("share", [0.97, 1.03])
def test_the_limit_is_where_nodes_on_the_casing_become_unstable(monkeypatch, share):
    """Two coupled modes held on a casing too tight for them, by a static mode whose stiffness is `share` of the limit's.

    The casing has one lobe that is the same all round: a round one would leave no room at the start.
    """
    blade, choice = pendulum([2e4, 2.2e4], coriolis=6.0 * TURN), replace(CHOICE, time_step=2e-5, samples_per_revolution=314)
    casing = Casing(1e-3, lobes=1, amplitude=2.0, width=1e6, rise_fraction=0.0)
    scene = Scene(casing, damping_ratio=0.0, divergence_limit=1e300)

    def beyond(stiffness):
        return pressed_ratio(Problem(with_static_modes(blade, 1.0 / stiffness), 1000.0, scene, choice).contact) - 1.0

    with monkeypatch.context() as unchecked:
        unchecked.setattr(problem_module, "check_step", lambda contact: None)
        stiffness = share * brentq(beyond, 1e6, 1e12)
    model = with_static_modes(blade, 1.0 / stiffness)
    if share > 1.0:
        with pytest.raises(UnstableStepError, match="limit for nodes pressed on the casing"):
            Problem(model, 1000.0, scene, choice)
        monkeypatch.setattr(problem_module, "check_step", lambda contact: None)
    simulation = Simulation(model, 1000.0, scene, choice)
    rest = -1e-3 * stiffness / (stiffness + model.squared_frequencies[0])
    state = resting(simulation, np.array([-stiffness * (1e-3 + rest), 0.0, 0.0]))
    state.displacement[0] *= 1.0 + 1e-9
    away = np.abs(simulation.advance(state, 1).samples[:, 0] / rest - 1.0)
    assert (away.max() > 1e-2) == (share > 1.0)
    assert share > 1.0 or away.max() < 1e-6


@pytest.mark.slow
@pytest.mark.parametrize("modulus", [2e10, 1e14, np.inf])
@pytest.mark.parametrize("size", [None, 1.0, 10.0])
def test_no_few_nodes_that_stay_pressed_grow(coupled_blade, modulus, size):
    """Eigenvalues of the step at the steps taken, for a blade and for random models with more and more coupling."""
    model = coupled_model(8, size) if size else coupled_blade
    assert_stable(model, CHOICE, modulus, (6.4e-6, 1.6e-6), (2, 8))


def _meets_casing(model, start, velocity, excess):
    """Whether a run with jumps meets a casing that a step of the free motion passes by `excess` of the closest position."""
    speed, steps = 4000.0, 5000
    choice = replace(CHOICE, time_step=2.0 * np.pi / speed / steps, samples_per_revolution=steps, jumps=False)
    free = Simulation(model, speed, replace(FREE, divergence_limit=1e9), choice)
    samples = free.advance(moving(free, start, velocity), 1).samples[:, [0, 3]]
    # lobes that come while a node still rises
    casing = Casing(1.0, lobes=40, width=0.1, amplitude=0.5, rise_fraction=0.0)
    theta = free.problem.casing.theta(np.arange(1, steps + 1)[:, None])
    reach = (samples[:, : theta.shape[1]] / (1.0 - casing.amplitude * casing.shape(theta))).max()
    # the same steps, of which many are jumped over
    choice = replace(choice, samples_per_revolution=50, jumps=True)
    jumping = Simulation(
        model, speed, replace(FREE, casing=replace(casing, clearance=reach * (1.0 - excess)), divergence_limit=1e9), choice
    )
    assert free.problem.grid.steps_per_revolution == jumping.problem.grid.steps_per_revolution == steps
    state = moving(jumping, start, velocity)
    jumping.advance(state, 1)
    return bool(state.totals["steps_in_contact"] > 0)


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("excess", [1e-6, -1e-6])
def test_no_contact_is_missed_by_a_jump(seed, excess):
    """The casing is put where a step of the free motion just passes it, or just does not."""
    generator = np.random.default_rng(seed)
    model = coupled_model(2, 10.0 ** generator.uniform(-1, 1.5))
    model = replace(model, tip_displacement_operator=model.displacement_operator, tip_cone_angle=0.3)
    # those that are stepped
    frequencies = np.sqrt(model.squared_frequencies[:24])
    share = generator.uniform(0.2, 1.0) ** np.arange(24)
    start, velocity = generator.standard_normal((2, 24)) * share / [frequencies, np.ones(24)]
    assert _meets_casing(model, start, velocity, excess) == (excess > 0)


@pytest.mark.parametrize("seed", range(12))
def test_no_contact_is_missed_where_the_increment_moves_the_node(seed):
    """Two slow modes, whose shapes are imaginary along the casing's normal."""
    frequencies = np.array([5000.0, 5300.0])
    model = with_static_modes(model_of_node(np.eye(3)[:, 1::-1], frequencies, coriolis=TURN), STATIC)
    start, velocity = np.random.default_rng(seed).standard_normal((2, 2)) * [[1e-3], [5.0]]
    assert _meets_casing(model, start, velocity, 1e-6)


@pytest.mark.parametrize("seed", range(4))
def test_jumps_follow_the_tangent_of_slow_modes(seed):
    """Four pendulums that move one node together: so many modes are followed along their tangent towards the casing."""
    model, scene = pendulum(np.repeat([4000.0, 4700.0, 5200.0, 6100.0], 2)), Scene(Casing(2e-3, lobes=0), damping_ratio=0.0)
    start, velocity = np.random.default_rng(seed).standard_normal((2, 8)) * [[1e-3], [5.0]]
    radial = model.displacement_operator[0, 0]
    start -= np.maximum(radial @ start, 0.0) * radial / 4.0
    records = []
    for jumps in (True, False):
        simulation = Simulation(with_static_modes(model, STATIC), 1300.0, scene, replace(CHOICE, jumps=jumps))
        state = moving(simulation, start, velocity)
        records.append(simulation.advance(state, 1).samples)
        assert (state.totals["steps_jumped"] > 0.5 * state.totals["steps"]) == jumps
        assert state.totals["casing_hits"] > 0
    assert_close(*records, 1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["direct", "direct_exact", "abradable"])
def test_a_run_with_jumps_is_the_plain_run(coupled_blade, name):
    scene = replace(SCENES[name], casing=Casing(0.356e-3))
    choice = replace(CHOICE, time_step=4e-7, revolutions=8)
    (_, jumped, ours), (_, plain, theirs) = (
        whole_run(coupled_blade, 1600.0, scene, replace(choice, jumps=jumps)) for jumps in (True, False)
    )
    assert jumped.totals["steps_jumped"] > 0.1 * jumped.totals["steps"] and plain.totals["steps_jumped"] == 0
    assert_same_record(ours, theirs)
    np.testing.assert_allclose(jumped.totals["loss"], plain.totals["loss"], rtol=1e-9)


def test_snapshots_and_split_runs():
    """Samples are the snapshots' shapes at the tip, to the last number; a run that is stopped goes on with the same bits."""
    model = coupled_model()
    choice = replace(CHOICE, time_step=1.2e-6, revolutions=2, snapshots_per_revolution=62, snapshot_revolutions=2)
    simulation, whole_state, whole = whole_run(model, 6000.0, ABRADABLE, choice)
    assert len(simulation.problem.blade.frequencies) < len(model.squared_frequencies)
    state = simulation.start()
    parts = [simulation.advance(state, 1) for _ in range(2)]
    np.testing.assert_array_equal(np.concatenate([part.snapshots for part in parts]), whole.snapshots)
    np.testing.assert_array_equal(state.increment, whole_state.increment)
    assert state.totals["steps_in_contact"] > 100
    radial = model.tip_displacement_operator[0, 0] @ simulation.problem.contact.state_shapes
    assert_close(whole.snapshots @ radial, whole.samples[:, 1], 1e-12)


def test_central_differences_and_run_ups_do_not_carry_it():
    with pytest.raises(ValueError, match=r"central differences do not carry the Coriolis force; use .* exact_modal"):
        Problem(coupled_model(), 1000.0, DIRECT, replace(CHOICE, integrator=CENTRAL_DIFFERENCE))
    with pytest.raises(ValueError, match="run-ups do not carry the Coriolis force"):
        RunUpIntegration(coupled_model(), DIRECT, CHOICE, RunUp(1000.0, 1100.0, 5.0, 0, 0, worn=False))


WITH_CORIOLIS = {"structure": {"coriolis": True}}
RUN_UP = {"climb": {"from_rad_s": 1600, "to_rad_s": 1800, "rate_rad_s2": 100}}


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        (
            {"fidelity": "paper"},
            r"structure\.coriolis: found true at the level 'paper', whose integrator central_difference .*; allowed: false, or "
            r"a level of exact_modal \(draft, standard, fine\)",
        ),
        ({"run_ups": RUN_UP}, r"run_ups\.climb: found a run-up with structure\.coriolis: true; allowed: none"),
    ],
)
def test_configurations_that_cannot_carry_it(root, changes, message):
    with pytest.raises(ConfigError, match=message):
        read_settings(root, command_line_document(WITH_CORIOLIS | changes))
    read_settings(root, command_line_document(changes))


def test_central_differences_are_left_out_of_what_is_varied(root):
    settings = read_settings(root, command_line_document(WITH_CORIOLIS))
    assert "central_difference_step, because fewer than two" in tradeoff.not_varied(settings)
    levels = tradeoff.varied(settings)["level"]
    assert (levels.values, levels.reference) == (["draft", "standard", "fine"], "fine")
    planned = [*tradeoff.cases(settings).values(), *stability.cases(settings).values()]
    assert {case.choice.integrator for case in planned if not isinstance(case, str)} == {"exact_modal"}
