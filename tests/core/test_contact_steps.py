"""Contact forces at t_n and the static modes that hold the nodes: order, energy, stability, long steps; the tip's edge."""

from dataclasses import replace

import numpy as np
import pytest
from defaults import Casing, Friction, IntegrationChoice, Lining, Scene
from integration_cases import (
    AT_ONCE,
    DIRECT,
    ELASTIC,
    LINING,
    NARROW,
    RING,
    SCENES,
    oscillator,
    random_model,
    with_modes,
    with_static_modes,
)
from integration_runs import (
    ENGINES,
    assert_close,
    assert_same_record,
    assert_same_state,
    assert_stable,
    both_engines,
    in_all_directions,
    times,
    whole_run,
)
from motion_at_start import MotionAtStart
from reference_engine import ReferenceSimulation, complementary
from scipy.integrate import solve_ivp

from r37core.contact.scene import Rotor
from r37core.time_integration import problem as problem_module
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL
from r37core.time_integration.problem import Problem, UnstableStepError, stable_problem
from r37core.time_integration.simulate import Simulation, rest_state
from r37core.time_integration.speed_run import run_speed
from r37core.time_integration.step_checks import pressed_ratio

THIN = SCENES["thin_lining"]
"""With the casing behind it in reach."""

LONG = IntegrationChoice(3.2e-6, 2, 62, integrator=EXACT_MODAL)


def order_of(errors, steps):
    """Power of the step with which errors fall: those of single steps scatter with where in a step a contact begins."""
    return np.polyfit(np.log(steps), np.log(errors), 1)[0]


@pytest.mark.parametrize(
    ("integrator", "flexibility", "largest", "order"),
    [(EXACT_MODAL, 1e-10, 1e-3, 2), (EXACT_MODAL, 2e-7, 1e-3, 2), (CENTRAL_DIFFERENCE, 0.0, 0.06, 1)],
)
def test_error_of_a_mode_on_an_elastic_bar_falls_with_the_step_or_its_square(integrator, flexibility, largest, order):
    """Lobes press the bar against one damped mode, through a static one; exact: SciPy's DOP853 on two springs in series.

    With central differences there is no static mode, and the force of the bar comes a step late.
    """
    frequency, ratio, speed = 3000.0, 0.02, 1000.0
    casing = Casing(1e-4, lobes=2, amplitude=2.0, rise_fraction=0.0)
    scene = Scene(casing, ELASTIC, damping_ratio=ratio, divergence_limit=1.0)
    model = with_static_modes(oscillator(frequency), flexibility) if flexibility else oscillator(frequency)
    choice = replace(LONG, revolutions=3, samples_per_revolution=50, integrator=integrator)
    stiffness = 1.0 / (ELASTIC.thickness / ELASTIC.elastic_modulus / ELASTIC.bar_area + flexibility)

    def motion(time, state):
        shape = casing.shape(np.array([model.theta[0] - speed * time]))[0]
        pressed = max(0.0, state[0] - casing.clearance * (1.0 - casing.amplitude * shape))
        return state[1], -2 * ratio * frequency * state[1] - frequency**2 * state[0] - stiffness * pressed

    # whatever the step, of samples there are fifty in a revolution
    time = 2.0 * np.pi / speed / 50 * np.arange(1, 151)
    found = solve_ivp(motion, (0.0, time[-1]), [0.0, 0.0], "DOP853", time, rtol=1e-11, atol=1e-15, max_step=2e-5)
    errors, steps = [], []
    for step in 1.6e-5 * 0.5 ** np.arange(0.0, 3.1, 0.25):
        simulation, _, record = whole_run(model, speed, scene, replace(choice, time_step=step))
        np.testing.assert_allclose(times(simulation, 150), time, rtol=1e-12)
        errors.append(np.abs(record.samples[:, 0] - found.y[0]).max() / np.abs(found.y[0]).max())
        steps.append(simulation.problem.grid.time_step)
    assert errors[0] < largest
    assert 0.9 * order < order_of(errors, steps) < 1.15 * order, errors


FREQUENCY, START = 5000.0, -1e-3
STOPS = np.random.default_rng(1).uniform([0.2e-3, 1e-8], [0.6e-3, 1e-7], (20, 2))
"""Places (m) of a rigid stop, and flexibilities (m/N) of what meets it: errors of many tell their order."""


def bouncing(step, stop, flexibility, revolutions, engine="compiled"):
    """A mass that swings on its spring from START into a rigid stop, which a static mode of this flexibility meets first."""
    model = with_static_modes(oscillator(FREQUENCY), flexibility)
    scene = Scene(Casing(stop, lobes=0), damping_ratio=0.0)
    choice = replace(LONG, time_step=step, revolutions=revolutions, samples_per_revolution=50)
    simulation = ENGINES[engine](model, 1000.0, scene, choice)
    state = simulation.start()
    state.displacement[:] = START
    # u(-h) of what moves off from rest
    state.increment[:] = 0.5 * simulation.problem.contact.recursion.pull * START
    return simulation, state


def bounces(time, stop, flexibility):
    """Its displacement: free at the frequency w, in contact on a spring 1/R more about another rest, and so on for ever."""
    in_contact = np.sqrt(FREQUENCY**2 + 1.0 / flexibility)
    rest = stop / flexibility / in_contact**2
    hit = np.arccos(stop / START) / FREQUENCY
    velocity = -START * FREQUENCY * np.sin(FREQUENCY * hit)
    turns = hit + np.arctan2(velocity / in_contact, stop - rest) / in_contact
    # from the farthest point to the deepest and back the same way
    since = turns - np.abs(time % (2.0 * turns) - turns)
    angle = in_contact * (since - hit)
    pressed = rest + (stop - rest) * np.cos(angle) + velocity / in_contact * np.sin(angle)
    return np.where(since < hit, START * np.cos(FREQUENCY * since), pressed)


def test_a_mass_bounces_off_a_rigid_stop_as_in_closed_form():
    errors, steps = [], []
    for step in (8e-6, 4e-6, 2e-6, 1e-6):
        of_step = []
        for stop, flexibility in STOPS:
            simulation, state = bouncing(step, stop, flexibility, 2)
            record = simulation.advance(state, 2)
            exact = bounces(times(simulation, len(record.samples)), stop, flexibility)
            # beyond the stop by what the static mode gives way
            assert exact.max() > 1.2 * stop
            assert state.totals["casing_hits"] >= 8
            of_step.append(np.abs(record.samples[:, 0] - exact).max() / abs(START))
        errors.append(np.mean(of_step))
        steps.append(simulation.problem.grid.time_step)
    assert errors[0] < 1e-2
    assert 1.8 < order_of(errors, steps) < 2.3, errors
    found = []
    for engine in ENGINES:
        simulation, state = bouncing(8e-6, *STOPS[0], 2, engine=engine)
        found.append(simulation.advance(state, 2).samples)
    np.testing.assert_allclose(*found, rtol=0, atol=1e-10 * abs(START))


def test_bounces_off_a_rigid_stop_lose_no_energy():
    """The stop does no work on all modes together: what is missing between contacts falls with the square of the step.

    The static mode holds a part of the energy in contact and gives it all back: a thousand bounces later no more is missing.
    """
    start, missing, steps = 0.5 * (FREQUENCY * START) ** 2, [], []
    for step in (8e-6, 4e-6, 2e-6, 1e-6):
        of_step = []
        for stop, flexibility in STOPS:
            simulation, state = bouncing(step, stop, flexibility, 200)
            free, held, first = [], 0.0, simulation.energy(state) / start
            for _ in range(1000 if step == 8e-6 else 100):
                simulation.advance_samples(state, 10)
                held = max(held, simulation.problem.contact.static_energy(state.contact_force) / start)
                gained = simulation.work(state) / start
                assert abs(simulation.energy(state) / start - first - gained) < 1e-11
                if not state.contact_force.any():
                    free.append(abs(gained))
            assert held > 0.05
            if step == 8e-6:
                assert state.totals["casing_hits"] > 1000
                early, late = np.array_split(free, 2)
                assert late.max() < 1.1 * early.max()
            of_step.append(np.max(free))
        # some bounces are in step with the steps: these are not to tell the order
        missing.append(np.exp(np.mean(np.log(of_step))))
        steps.append(simulation.problem.grid.time_step)
    assert missing[0] < 1e-3
    assert 1.8 < order_of(missing, steps) < 2.3, missing


@pytest.mark.slow
@pytest.mark.parametrize("scene", [NARROW, THIN, DIRECT], ids=["abradable", "thin", "direct"])
def test_work_of_the_contact_forces_is_that_of_forces_times_paths(contact, scene):
    """Counted in every step: trapezoids of the forces over the nodes' whole displacement, that of the static modes in it.

    What is left is half of the last force's work on the last step of the stepped modes, which it pushes in the next one, too.
    """
    every, steps_at_once = 2000, 10
    choice = replace(LONG, time_step=2e-6, samples_per_revolution=every, snapshots_per_revolution=every)
    choice = replace(choice, snapshot_revolutions=choice.revolutions)
    simulation = ReferenceSimulation(contact, 1600.0, scene, choice)
    problem, state = simulation.problem, simulation.start()
    assert problem.grid.steps_per_sample == 1
    rows = problem.contact.operator_at_rest.reshape(3 * len(contact.theta), -1) @ problem.contact.state_shapes
    stepped = len(problem.blade.frequencies)
    before, counted, found = np.zeros(rows.shape[1]), 0.0, []
    for _ in range(every // steps_at_once):
        for snapshot in simulation.advance_samples(state, steps_at_once).snapshots:
            path, force = snapshot - before, snapshot[stepped:]
            counted += 0.5 * (force + before[stepped:]) @ rows @ path
            before = snapshot
        left = 0.5 * force @ rows[:, :stepped] @ path[:stepped]
        found.append((counted - left, simulation.work(state), left))
    counted, work, left = np.array(found).T
    largest = np.abs(work).max()
    assert state.totals["steps"] == every
    # as often as not it ends in contact
    assert np.abs(left).max() > 1e-3 * largest and np.count_nonzero(left) > 20
    np.testing.assert_allclose(counted, work, rtol=0, atol=1e-10 * largest)


LAWS = ({}, {"friction": Friction(0.15, vector=False)}, {"exact_gap": True})


@pytest.mark.slow
@pytest.mark.parametrize(
    "scene",
    [THIN, *(replace(scene, **law) for scene in (NARROW, DIRECT) for law in LAWS)],
    ids=["thin", "abradable", "constant", "exact", "direct", "direct_constant", "direct_exact"],
)
def test_energy_balance_closes_with_static_modes(contact, scene):
    simulation = Simulation(contact, 1600.0, scene, replace(LONG, revolutions=4))
    assert len(simulation.problem.blade.frequencies) < len(contact.squared_frequencies)
    state, held = simulation.start(), []
    for _ in range(4 * 62):
        simulation.advance_samples(state, 1)
        work, loss = simulation.work(state), state.totals["loss"]
        held.append(work - state.totals["work"])
        assert abs(simulation.energy(state) - work + loss) <= 1e-10 * (np.abs(state.totals["work"]) + max(held) + loss)
    assert loss > 0.0
    # while the blade is pressed the static modes hold some of the work
    assert max(held) > 1e-4 * abs(work)
    assert (state.totals["casing_hits"] > 0) == (scene.lining is None or scene.lining.thickness < 1e-3)


def pressed_oscillator(share, scene):
    """A mode that a casing too tight for it holds by a static mode, started beside its rest; `share`: of the limit's stiffness.

    The casing is lobed with one lobe that is the same all round: a round one would leave no room at the start.
    """
    frequency, penetration, speed = 2e4, 1e-3, 1000.0
    choice = replace(LONG, time_step=2e-5, samples_per_revolution=314)
    scene = replace(scene, casing=Casing(1e-3, lobes=1, amplitude=2.0, width=1e6, rise_fraction=0.0), divergence_limit=1e300)
    free = Problem(with_static_modes(oscillator(frequency), 1.0), speed, scene, choice)
    free_recursion = free.contact.recursion
    keep, pull, inverse = (float(part[0]) for part in (free_recursion.keep, free_recursion.pull, free_recursion.inverse))
    flexibility = inverse / (share * 2.0 * (1.0 + keep) - pull)
    # of a bar that is worn through the thickness is left
    force = (penetration - (scene.lining.thickness if scene.lining else 0.0)) / (flexibility + 1.0 / frequency**2)
    return with_static_modes(oscillator(frequency), flexibility), speed, scene, choice, force, -force / frequency**2


BARE, WORN = Scene(DIRECT.casing), Scene(DIRECT.casing, Lining(1e-5, 1e6, 1e5, 1e3, bar_area=1e-9))


@pytest.mark.parametrize("scene", [BARE, WORN], ids=["bare", "worn"])
@pytest.mark.parametrize("share", [0.97, 1.03])
def test_the_limit_is_where_nodes_on_the_casing_become_unstable(monkeypatch, share, scene):
    model, speed, scene, choice, force, rest = pressed_oscillator(share, scene)
    if share > 1.0:
        with pytest.raises(UnstableStepError, match="limit for nodes pressed on the casing"):
            Problem(model, speed, scene, choice)
        monkeypatch.setattr(problem_module, "check_step", lambda contact: None)
    simulation = Simulation(model, speed, scene, choice)
    assert pressed_ratio(simulation.problem.contact) == pytest.approx(share, rel=1e-9)
    state = simulation.start()
    state.displacement[:] = rest * (1.0 + 1e-9)
    state.contact_force[0] = -force
    away = np.abs(simulation.advance(state, 1).samples[:, 0] / rest - 1.0)
    assert (away.max() > 1e-2) == (share > 1.0)
    assert share > 1.0 or away.max() < 1e-7


@pytest.mark.parametrize("scene", [BARE, WORN], ids=["bare", "worn"])
def test_nodes_held_stiffly_shorten_a_level_s_step_but_not_one_that_is_asked_for(scene):
    model, speed, scene, choice, _, _ = pressed_oscillator(4.0, scene)
    with pytest.raises(UnstableStepError, match=r"time_step_s: 2e-05 s .* limit for nodes pressed on the casing"):
        stable_problem(model, speed, scene, choice)
    shortened = stable_problem(model, speed, scene, replace(choice, shorten=True))
    assert shortened.grid.time_step < 0.6 * choice.time_step
    # not more than it must be
    with pytest.raises(UnstableStepError):
        Problem(model, speed, scene, replace(choice, time_step=4.0 * shortened.grid.time_step))


def test_bars_of_any_stiffness_bear_the_step_of_the_casing():
    """Bars of 1e15 Pa are the casing itself: the same step, and work that stays what it is on a soft lining."""
    model, choice = with_static_modes(random_model(8), 1e-9), replace(LONG, time_step=6.7e-7, revolutions=20)
    steps, works = [], []
    for modulus in (2e10, 1e15):
        elastic = replace(NARROW.lining, elastic_modulus=modulus, yield_stress=1e30)
        scene = replace(NARROW, lining=elastic, friction=Friction(0.0))
        run = run_speed(model, 1600.0, scene, choice, ("energy",), spectrum_highest_order=5, wear_angles=60)
        assert run["status"] == 0
        steps.append(float(run["time_step"]))
        works.append(float(run["contact_work"]))
    assert steps[0] == steps[1] > 6e-7
    assert 0.0 < works[1] < 100.0


@pytest.mark.slow
@pytest.mark.parametrize("modulus", [2e10, 1e12, 1e14, np.inf])
@pytest.mark.parametrize("number", [None, 8])
def test_no_few_nodes_that_stay_pressed_grow(contact, number, modulus):
    """Eigenvalues of a step of displacement and increment at the steps taken, without friction; the stiffest is the casing."""
    model = with_static_modes(random_model(number), 1e-9) if number else contact
    assert_stable(model, LONG, modulus, (6.4e-6, 3.2e-6, 1.6e-6, 8e-7), (2, 3, 8))


EVERY = replace(LONG, snapshots_per_revolution=62, snapshot_revolutions=2)


@pytest.mark.slow
@pytest.mark.parametrize("scene", [NARROW, DIRECT], ids=["abradable", "direct"])
def test_snapshots_and_split_runs(contact, scene):
    """Stopped after a revolution a run goes on with the same bits, and in the middle of contact, too.

    The samples are the snapshots' shapes at the tip, of which some percent are static when the blade is first pressed.
    """
    simulation, whole_state, whole = whole_run(contact, 1600.0, scene, EVERY)
    state = simulation.start()
    parts = [simulation.advance(state, 1), simulation.advance(state, 1)]
    for name in ("samples", "snapshots"):
        np.testing.assert_array_equal(np.concatenate([getattr(part, name) for part in parts]), getattr(whole, name))
    for name in ("wear", "contact_force", "totals"):
        np.testing.assert_array_equal(getattr(state, name), getattr(whole_state, name))
    state, pressed = simulation.start(), 0
    for row in range(2 * 62):
        found = simulation.advance_samples(state, 1).samples[0]
        pressed += bool(state.contact_force.any())
        np.testing.assert_allclose(found, whole.samples[row], rtol=0, atol=1e-12 * np.abs(whole.samples).max())
    assert pressed > 5
    radial = contact.tip_displacement_operator[0, 0] @ simulation.problem.contact.state_shapes
    assert_close(whole.snapshots @ radial, whole.samples[:, 1], 1e-12)
    stepped, largest = len(simulation.problem.blade.frequencies), np.abs(whole.samples[:, 1]).max()
    static = np.abs(whole.snapshots[:, stepped:] @ radial[stepped:]).max()
    assert 1e-3 * largest < static < (0.1 if scene.lining else 0.2) * largest


@pytest.mark.slow
def test_no_node_is_beyond_the_casing_and_none_is_pulled(contact):
    """At every sample of direct contact, with the static modes' share, whatever the stepped modes alone would do."""
    simulation = Simulation(contact, 1600.0, DIRECT, EVERY)
    problem, state = simulation.problem, simulation.start()
    stepped, nodes = len(problem.blade.frequencies), len(contact.theta)
    snapshots = simulation.advance(state, 2).snapshots
    normal = problem.contact.operator_at_rest[0] @ problem.contact.state_shapes
    step = problem.grid.steps_per_sample * (1 + np.arange(len(snapshots)))
    room = problem.casing.clearance - np.array([DIRECT.casing.lobe(problem.casing.theta(n), np.zeros(1), 0.0) for n in step])
    gap, force = room - snapshots @ normal.T, -snapshots[:, stepped : stepped + nodes]
    largest = np.abs(snapshots @ normal.T).max()
    assert force.min() >= 0.0 and np.count_nonzero(force) > 5
    assert gap.min() > -1e-10 * largest
    np.testing.assert_allclose(gap[force > 0.0], 0.0, atol=1e-10 * largest)
    alone = room - snapshots[:, :stepped] @ normal[:, :stepped].T
    assert alone.min() < -1e-3 * largest


@pytest.mark.slow
def test_long_steps_keep_motion_stress_and_wear(contact):
    """Eight times the step, half of the modes static, a bar in ten met by a step."""
    choice = replace(LONG, revolutions=20, samples_per_revolution=496, snapshots_per_revolution=62)
    kept, results = {"spectrum_highest_order": 10, "wear_angles": 1000}, ("spectrum", "wear", "energy")
    fine, coarse = (
        run_speed(contact, 1600.0, NARROW, replace(choice, time_step=step), results, **kept) for step in (4e-7, 3.2e-6)
    )
    assert coarse["time_step"] > 6 * fine["time_step"]
    assert coarse["wear"].shape == fine["wear"].shape == (1000,)
    for kind, within in (("rms", 2e-3), ("peak", 5e-3)):
        assert_close(in_all_directions(coarse, kind), in_all_directions(fine, kind), within)
    for name, within in (("amplitude", 2e-3), ("wear_harmonic", 1e-2), ("max_wear", 1e-2)):
        assert_close(coarse[name], fine[name], within)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["worn", "direct"])
def test_static_modes_let_go_of_the_casing(contact, name):
    """The casing alone, or behind bars without a force from the start: when the blade leaves it, static modes keep nothing."""
    lining = replace(NARROW.lining, thickness=1e-5, elastic_modulus=20e6, plastic_modulus=5e6)
    scene = replace(NARROW, lining=lining) if name == "worn" else DIRECT
    choice, found = replace(EVERY, time_step=8e-7, samples_per_revolution=248, snapshots_per_revolution=248), []
    for simulation_class in ENGINES.values():
        simulation = simulation_class(contact, 6000.0, scene, choice)
        state = simulation.start()
        if scene.lining:
            state.wear[:] = lining.thickness
        found.append((state, simulation.advance(state, 2)))
    (ours, record), (theirs, plain) = found
    assert ours.totals["casing_hits"] > 0
    assert_same_state(ours, theirs)
    assert_same_record(record, plain)
    stepped = len(simulation.problem.blade.frequencies)
    pressed = np.any(plain.snapshots[:, stepped:] != 0.0, axis=1)
    assert 10 < np.count_nonzero(pressed) < 0.9 * len(pressed)
    np.testing.assert_array_equal(np.any(record.snapshots[:, stepped:] != 0.0, axis=1), pressed)


def with_edge(model, nodes):
    """The model with an edge of so many nodes between its contact nodes, and beyond them by half a distance."""
    place = np.linspace(-0.5, len(model.theta) - 0.5, nodes)
    low = np.clip(np.floor(place), 0, max(len(model.theta) - 2, 0)).astype(int)
    high, share = np.minimum(low + 1, len(model.theta) - 1), place - low

    def along(values):
        shape = (-1,) + (1,) * (values.ndim - 1)
        return values[low] * (1.0 - share).reshape(shape) + values[high] * share.reshape(shape)

    def of_nodes(operator):
        return np.moveaxis(along(np.moveaxis(operator, 1, 0)), 0, 1)

    return replace(
        model,
        edge_displacement_operator=of_nodes(model.displacement_operator),
        edge_radius=along(model.radius),
        edge_theta=along(model.theta),
        edge_rotation_shapes=of_nodes(model.rotation_shapes),
    )


def with_moving_edge(model, factors):
    """The model of one node with an edge that moves by these factors as far as the node."""
    return replace(
        model,
        edge_displacement_operator=model.displacement_operator * factors[:, None],
        edge_radius=np.full(len(factors), 0.25),
        edge_theta=np.linspace(0.0, 1.0, len(factors)),
        edge_rotation_shapes=np.zeros((3, len(factors), 1)),
    )


@pytest.mark.slow
@pytest.mark.parametrize("integrator", [CENTRAL_DIFFERENCE, EXACT_MODAL])
@pytest.mark.parametrize(("engine", "nodes"), [("compiled", 2), ("compiled", 50), ("reference", 50)])
def test_an_edge_that_moves_further_than_its_contact_node(engine, integrator, nodes):
    """A stop holds the contact node, and an edge that moves up to half as much again passes it by half of the clearance.

    With forces at t_n a part of it is the static modes', which move the edge as much more.
    """
    stop, model = 0.5e-3, oscillator(5000.0)
    if integrator == EXACT_MODAL:
        model = with_static_modes(model, 1e-9)
    model = with_moving_edge(model, np.linspace(1.5, -1.0, nodes))
    scene = Scene(Casing(stop, lobes=0), damping_ratio=0.0)
    choice = IntegrationChoice(1e-7, 1, 100, integrator=integrator)
    _, state, _ = whole_run(model, 10000.0, scene, choice, MotionAtStart(np.array([-1e-3])), engine)
    assert state.totals["steps_in_contact"] > 0
    assert state.totals["largest_penetration"] == pytest.approx(0.5 * stop, rel=0.01)


@pytest.mark.slow
@pytest.mark.parametrize("integrator", [CENTRAL_DIFFERENCE, EXACT_MODAL])
def test_an_edge_that_passes_a_thin_lining_before_its_contact_node(integrator):
    """The node stays in the first half of a stiff lining, and an edge that moves five times as far passes the casing."""
    model = oscillator(5000.0) if integrator == CENTRAL_DIFFERENCE else with_static_modes(oscillator(5000.0), 1e-9)
    model = with_moving_edge(model, np.linspace(5.0, 1.0, 50))
    lining = replace(LINING, thickness=1e-3, elastic_modulus=20e9, contact_length=1e-4, bar_width=None)
    scene, start = Scene(Casing(1e-4, lobes=0), lining, damping_ratio=0.0), MotionAtStart(np.array([-5e-4]))
    choice = IntegrationChoice(1e-7, 1, 100, integrator=integrator)
    ours, theirs = (
        whole_run(model, 10000.0, scene, choice, start, engine)[1].totals["largest_penetration"] for engine in ENGINES
    )
    assert theirs > 1e-4
    assert ours == pytest.approx(theirs, rel=1e-6)


def test_an_edge_inside_the_casing_at_rest_is_recorded():
    """Rotation brings a blade's edge into a bare casing, and its contact nodes not: nothing touches."""
    model = with_edge(with_static_modes(random_model(8), 1e-9), 40)
    shapes = np.zeros((3, 40, 1))
    shapes[0, -1] = 1.5e-9
    nothing = {"rotation_shapes": np.zeros((3, 8, 1)), "rotation_stiffening": np.zeros(1)}
    model = replace(model, edge_rotation_shapes=shapes, **nothing)
    casing = replace(DIRECT.casing, lobes=0, centrifugal=True, clearance=1e-3)
    choice = IntegrationChoice(2e-7, 1, 31, integrator=EXACT_MODAL)
    problem = Problem(model, 1000.0, replace(DIRECT, casing=casing), choice)
    assert rest_state(problem).totals["largest_penetration"] == pytest.approx(1.5e-3 * np.cos(0.26) - 1e-3, rel=1e-3)


@pytest.mark.parametrize("contact", ["direct", "abradable"])
def test_an_edge_that_does_not_reach_the_casing(contact):
    """Nodes that do not move stay clear; nor does one that passes the lining's surface but not the casing behind it."""
    model = with_edge(with_static_modes(random_model(8), 1e-9), 40)
    if contact == "direct":
        model = replace(model, edge_displacement_operator=0.0 * model.edge_displacement_operator)
        scene = replace(DIRECT, casing=replace(AT_ONCE, amplitude=0.5))
    else:
        scene = SCENES["abradable"]
    for _, state, _ in both_engines(model, 12_000.0, scene, IntegrationChoice(2e-7, 1, 31, integrator=EXACT_MODAL)):
        assert state.totals["largest_penetration"] == 0.0


@pytest.mark.slow
@pytest.mark.parametrize("integrator", [CENTRAL_DIFFERENCE, EXACT_MODAL])
@pytest.mark.parametrize("scene", ["direct", "direct_exact", "thin_lining", "elastic"])
def test_both_engines_find_the_same_penetration(scene, integrator):
    model = random_model(8)
    if integrator == EXACT_MODAL:
        model = with_static_modes(model, 1e-9)
    elif scene == "elastic":
        pytest.skip("central differences step a casing in other tests")
    surroundings = {"elastic": replace(DIRECT, casing=replace(AT_ONCE, ring=RING.modes()))} | SCENES
    choice = IntegrationChoice(2e-7, 1, 31, integrator=integrator)
    (_, ours, _), (_, theirs, _) = both_engines(with_edge(model, 50), 12_000.0, surroundings[scene], choice)
    assert theirs.totals["largest_penetration"] > 1e-6
    assert ours.totals["largest_penetration"] == pytest.approx(theirs.totals["largest_penetration"], rel=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("friction", [0.0, 0.15])
def test_forces_of_twenty_patches_are_those_of_the_complementarity_problem(friction):
    """Static modes move neighbours together: after each sample the forces are those of Murty's rule on the gaps there."""
    nodes, scene = 20, replace(DIRECT, friction=Friction(friction) if friction else None)
    place, chosen = np.linspace(0.0, 1.0, nodes), IntegrationChoice(4e-7, 1, 62, integrator=EXACT_MODAL)
    near = np.zeros((3, nodes, nodes))
    near[0] = 1.2e-5 * np.exp(-20.0 * (place[:, None] - place) ** 2)
    model = with_modes(with_static_modes(random_model(nodes), 1e-9), 1e8, near)
    simulation = Simulation(model, 12_000.0, scene, chosen)
    state, engine, found = simulation.start(), simulation.engine, 0
    for _ in range(62):
        simulation.advance_samples(state, 1)
        pressure = -state.contact_force[0]
        if not np.any(pressure > 0.0):
            continue
        share = np.divide(state.contact_force[1:], pressure, out=np.zeros((2, nodes)), where=pressure > 0.0)
        directions = np.stack([-np.ones(nodes), *share])
        listed = pressure > 0.0
        matrix = -np.einsum("dk,dkg->gk", directions, simulation.problem.contact.contact_flexibility)
        gap = engine.record[0]["contact"]["gap"][:nodes].copy()
        # of the nodes that touch the direction of friction is known
        expected = complementary(matrix[np.ix_(listed, listed)], gap[listed])
        np.testing.assert_allclose(pressure[listed], expected, rtol=1e-6, atol=1e-9 * expected.max())
        assert np.all((gap + matrix @ pressure)[~listed] > -1e-11)
        found += listed.sum() > 2
    assert found > 3 and state.totals["worst_complementarity"] == 0.0


def test_a_rotor_has_the_largest_of_its_blades():
    """The longer blade has less clearance, and goes through the casing by as much more than the blade alone."""
    model = with_edge(with_static_modes(random_model(8), 1e-9), 40)
    choice, scene = IntegrationChoice(2e-7, 2, 31, integrator=EXACT_MODAL), SCENES["thin_lining"]
    arguments = dict(spectrum_highest_order=5, wear_angles=10)
    longer = replace(scene, casing=replace(scene.casing, longer=5e-5))
    alone = [float(run_speed(model, 12_000.0, one, choice, (), **arguments)["largest_penetration"]) for one in (scene, longer)]
    rotor = Rotor((1, 2), (0.0, np.pi), (1.0, 1.0), (0.0, 5e-5), shared_lining=False)
    both = run_speed(model, 12_000.0, replace(scene, rotor=rotor), choice, (), **arguments)
    assert alone[0] != alone[1]
    assert float(both["largest_penetration"]) == pytest.approx(max(alone), rel=0.1)


def test_contact_nodes_are_the_edge_where_no_other_is_known():
    """Contact nodes in bare casing keep clear of it, to round-off, with forces that correct the prediction."""
    choice = IntegrationChoice(2e-7, 1, 31)
    for _, state, _ in both_engines(random_model(8), 12_000.0, DIRECT, choice):
        assert state.totals["steps_in_contact"] > 100
        assert state.totals["largest_penetration"] < 1e-12
