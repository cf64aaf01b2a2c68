"""Displacements of second order: a thin beam against closed forms, forces and energy against themselves, both engines."""

from dataclasses import replace

import numpy as np
import pytest
from defaults import Casing, Friction, Scene
from integration_cases import LINING, RING
from integration_runs import ENGINES, in_all_directions
from motion_at_start import MotionAtStart
from quadratic_cases import CHOICE, FAR, LENGTH, beam_model, free_blade, held
from scipy.integrate import solve_bvp, solve_ivp

from r37core.contact.scene import Rotor
from r37core.rom.quadratic_terms import PATH_SHARES, followed_modes
from r37core.rom.reduced_model import contact_model
from r37core.time_integration.rotor_blades import mistuned
from r37core.time_integration.rotor_simulation import RotorSimulation
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.speed_run import run_speed
from r37core.time_integration.status import RunStatus

SPEED = 1710.0


@pytest.fixture(scope="module")
def beam():
    return beam_model()


@pytest.fixture(scope="module")
def contact(displaced):
    return contact_model(displaced, "pressure_edge")


def tip(simulation, displacement):
    """Radial and tangential displacement (m) of the leading edge."""
    return simulation.problem.model.tip_displacement_operator[:2, 0] @ displacement


def first_mode(simulation, deflection):
    """Displacement of the stepped modes: of the first alone, whose leading edge moves tangentially by a deflection (m)."""
    shape = simulation.problem.model.tip_displacement_operator[1, 0] @ simulation.problem.blade.modes
    return np.eye(len(shape))[0] * deflection / shape[0]


def elastica(slope):
    """Shortening and deflection over the length of a cantilever whose free end a transverse load turns by a `slope`."""

    def turned(s, y, p):
        return np.array([y[1], -p[0] * np.cos(y[0])])

    def ends(start, end, p):
        return np.array([start[0], end[1], end[0] - slope])

    s = np.linspace(0.0, 1.0, 201)
    found = solve_bvp(turned, ends, s, [slope * s, slope * np.ones_like(s)], [2.0 * slope], tol=1e-10)
    assert found.success
    angle = found.sol(s)[0]
    return np.trapezoid(1.0 - np.cos(angle), s), np.trapezoid(np.sin(angle), s)


@pytest.mark.parametrize(("slope", "within"), [(0.1, 1e-4), (0.3, 1e-3), (0.5, 4e-3)])
def test_elastica(slope, within):
    """The path of the tip under a transverse load there, as a share of the length: beyond slopes of 0.35 third order counts."""
    shortening, deflection = elastica(slope)
    simulation = free_blade(beam_model(modes=4), 10.0)
    rows = simulation.problem.model.tip_displacement_operator[1, 0] @ simulation.problem.blade.modes
    forces = np.linspace(0.0, 1.0, 21)[1:] * 3.0 * slope / LENGTH**2 * 200e9 * 0.01 * 0.002**3 / 12.0

    def path(sense):
        return np.array([tip(simulation, held(simulation, sense * force * rows)[1]) for force in forces])

    # of both senses: the node is a corner, which a turned section moves, too
    there, back = path(1), path(-1)
    found = np.interp(deflection * LENGTH, 0.5 * np.abs(there - back)[:, 1], -0.5 * (there + back)[:, 0])
    assert abs(found - shortening * LENGTH) < within * LENGTH


def test_backbone_of_an_inextensible_cantilever(beam):
    """Frequency of the first mode over its amplitude: stiffness by curvature and inertia by shortening nearly cancel.

    V = EI/2 integral of w''^2 (1 + w'^2), T = integral of m/2 (w_t^2 + u_t^2), u = -integral of w'^2/2, in the first mode: the
    frequency at first order in the squared amplitude (Nayfeh and Pai, Linear and Nonlinear Structural Mechanics, section 4.6).
    """
    s = np.linspace(0.0, 1.0, 20001)
    k, sigma = 1.8751040687, 0.7340955138
    shape = (np.cosh(k * s) - np.cos(k * s) - sigma * (np.sinh(k * s) - np.sin(k * s))) / 2.0
    slope, curvature = np.gradient(shape, s, edge_order=2), k**2 / 2.0
    curvature = curvature * (np.cosh(k * s) + np.cos(k * s) - sigma * (np.sinh(k * s) + np.sin(k * s)))
    shortening = np.concatenate([[0.0], np.cumsum(0.5 * (slope[1:] ** 2 + slope[:-1] ** 2) * np.diff(s))])

    def integral(values):
        return np.trapezoid(values, s)

    stiffness = integral(curvature**2 * slope**2) / integral(curvature**2)
    inertia = integral(shortening**2) / integral(shape**2)
    amplitude = 0.2
    # w^2/w0^2 of q'' (1 + inertia q^2) + inertia q q'^2 + w0^2 (q + 2 stiffness q^3)
    wanted = 1.0 + amplitude**2 * (1.5 * stiffness - 0.5 * inertia)
    ratios = [frequency_of(beam, share * LENGTH) for share in (1e-3, amplitude)]
    assert (ratios[1] / ratios[0]) ** 2 == pytest.approx(wanted, abs=1.5e-3)
    # each of the two alone is ten times as much
    assert amplitude**2 * 1.5 * stiffness > 0.02


def frequency_of(model, amplitude):
    """Frequency (rad/s) of the free motion from rest at a deflection of the tip (m) in the first mode, held by a force."""
    simulation = free_blade(model, 10.0, revolutions=2, samples_per_revolution=1240)
    force = first_mode(simulation, amplitude) * simulation.problem.blade.frequencies[0] ** 2
    state = simulation.start()
    start_at_rest(simulation, state, held(simulation, force)[0])
    motion = simulation.advance(state, 1).samples[:, 2]
    rising = np.flatnonzero((motion[:-1] < 0.0) & (motion[1:] >= 0.0))
    times = rising + motion[rising] / (motion[rising] - motion[rising + 1])
    per_sample = 2.0 * np.pi / 10.0 / 1240
    return 2.0 * np.pi * (len(times) - 1) / ((times[-1] - times[0]) * per_sample)


def start_at_rest(simulation, state, displacement):
    """Put a displacement of the stepped modes into a state, without velocity."""
    coordinates = simulation.problem.model.to_reduced @ (simulation.problem.blade.modes @ displacement)
    MotionAtStart(coordinates).put(simulation.problem, state)


def test_the_velocity_of_what_follows_is_the_rate_of_its_displacement(contact):
    blade = Simulation(contact, SPEED, FAR, replace(CHOICE, static_above=0.5)).problem
    quadratic, followers = blade.contact.quadratic, blade.blade.followers.shape[1]
    assert followers
    u, velocity, ahead, behind = np.zeros((4, len(blade.blade.frequencies)))
    u[:-followers], velocity[:-followers] = np.random.default_rng(0).standard_normal((2, len(u) - followers))
    ahead[:], behind[:] = u + velocity, u - velocity
    for displacement in (ahead, behind, u):
        quadratic.follow(displacement, velocity)
    # products are of second order: their central difference is exact
    assert velocity[-followers:] == pytest.approx(0.5 * (ahead - behind)[-followers:], rel=1e-9)


@pytest.fixture(scope="module")
def softening(contact):
    """A blade whose modes soften so far that without a bound a motion beyond 3 mm would grow for ever."""
    terms = contact.quadratic
    modes = len(terms.coordinates)
    simulation = Simulation(contact, SPEED, FAR, CHOICE)
    shapes = np.linalg.norm(simulation.problem.model.tip_displacement_operator[:, 0] @ simulation.problem.blade.modes, axis=0)
    cubic = np.zeros_like(terms.cubic)
    for mode in range(modes):
        cubic[(0, *[mode] * 4)] = -6.0 * (simulation.problem.blade.frequencies[mode] * shapes[mode] / 0.003) ** 2
    return replace(contact, quadratic=replace(terms, cubic=cubic))


def test_an_energy_that_softens_has_a_bound(softening):
    quadratic = Simulation(softening, SPEED, FAR, CHOICE).problem.contact.quadratic
    random = np.random.default_rng(0)
    seen = 0
    for size in np.geomspace(1e-5, 1e-1, 41):
        u = size * random.standard_normal(quadratic.rows.shape[1])
        left = quadratic.energy_left(quadratic.products(u))
        seen += left < -quadratic.bound
        assert np.sum(quadratic.products(u) ** 2) > quadratic.surely_within or left >= -quadratic.bound
        # all of the energy: that of the modes too
        frequencies = quadratic.blade.frequencies
        assert 0.5 * np.sum((frequencies * u) ** 2) + quadratic.energy(u) >= -2.0 * quadratic.bound
        step = 1e-6 * size * random.standard_normal(u.shape)
        change = quadratic.energy(u + step) - quadratic.energy(u - step)
        assert change == pytest.approx(-2.0 * quadratic.force(u) @ step, rel=1e-5)
    assert 5 < seen < 36


def test_the_motion_of_a_blade_that_softens_is_bounded(softening):
    """In both engines, of a flight that begins farther out than the unbounded energy has its maximum."""
    samples = []
    for simulation_class in ENGINES.values():
        simulation = simulation_class(softening, SPEED, FAR, CHOICE)
        state = simulation.start()
        start_at_rest(simulation, state, first_mode(simulation, 0.006))
        samples.append(simulation.advance(state, 4).samples)
    assert np.abs(samples[0]).max() < 0.02
    np.testing.assert_allclose(samples[0], samples[1], rtol=0, atol=1e-6 * np.abs(samples[1]).max())


@pytest.mark.slow
def test_free_flight_is_that_of_its_equations(contact):
    """From 10 mm at the leading edge, by SciPy's integration of the same modes, and without loss of energy."""
    simulation = Simulation(contact, SPEED, FAR, replace(CHOICE, time_step=1.6e-6))
    quadratic, frequencies = simulation.problem.contact.quadratic, simulation.problem.blade.frequencies
    start = held(simulation, first_mode(simulation, 0.010) * frequencies[0] ** 2)[0]

    def rate(_, y):
        u, velocity = np.split(y, 2)
        return np.concatenate([velocity, quadratic.force(u) - frequencies**2 * u])

    state = simulation.start()
    start_at_rest(simulation, state, start)
    begun = simulation.energy(state)
    ours = simulation.advance(state, 3)
    times = 2.0 * np.pi / SPEED * np.arange(1, 3 * CHOICE.samples_per_revolution + 1) / CHOICE.samples_per_revolution
    exact = solve_ivp(rate, (0.0, times[-1]), np.append(start, 0.0 * start), "DOP853", times, rtol=1e-10, atol=1e-14)
    theirs = [tip(simulation, shapes_of(simulation, u))[1] for u in exact.y[: len(start)].T]
    # after twelve periods: 0.03% of the frequency
    assert np.abs(ours.samples[:, 2] - theirs).max() < 0.02 * np.abs(theirs).max()
    energies = []
    for _ in range(800):
        simulation.advance(state, 5)
        energies.append(simulation.energy(state) / begun)
    first, second = np.mean(np.reshape(energies, (2, -1)), axis=1)
    assert abs(second - first) / 2000.0 < 1e-8


def shapes_of(simulation, displacement):
    """Displacement of the modes at rest, products in it."""
    contact = simulation.problem.contact
    products = contact.quadratic.products(displacement)
    return simulation.problem.blade.modes @ displacement + contact.product_shapes @ products


LINED = Scene(Casing(0.356e-3, rise_fraction=0.0), replace(LINING, bar_width=1e-3), Friction(0.15))
BARE = replace(LINED, lining=None)
SCENES = {
    "lined": LINED,
    "bare": BARE,
    "lined_exact": replace(LINED, exact_gap=True),
    "bare_exact": replace(BARE, exact_gap=True),
    "elastic": replace(LINED, casing=replace(LINED.casing, ring=RING.modes())),
    "elastic_bare": replace(BARE, casing=replace(BARE.casing, ring=RING.modes())),
}


@pytest.mark.parametrize("scene", SCENES)
def test_engines_agree(contact, scene):
    runs, choice = [], replace(CHOICE, revolutions=2, snapshots_per_revolution=31, snapshot_revolutions=2)
    for simulation_class in ENGINES.values():
        run = simulation_class(contact, SPEED, SCENES[scene], choice).run()
        named = run.states[0].totals
        totals = [float(named[name]) for name in ("work", "loss", "steps_in_contact", "largest_penetration")]
        runs.append((run.records[0].samples, run.records[0].snapshots, np.array([*totals, run.energy_change])))
    for ours, theirs in zip(*runs, strict=True):
        np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-7 * np.abs(theirs).max())
    assert runs[0][2][2] > 0.0


def test_what_the_contact_works_is_lost_or_kept(contact):
    """But for the order of the step, in modes that are stepped with all of them."""
    left = []
    for step in (4.8e-6, 1.2e-6):
        run = Simulation(contact, SPEED, LINED, replace(CHOICE, time_step=step, revolutions=20)).run()
        loss = float(run.states[0].totals["loss"])
        left.append(abs(run.energy_change - run.contact_work + loss) / loss)
    assert left[0] < 0.02
    assert left[1] < 0.5 * left[0]


def test_a_stopped_run_goes_on_with_the_same_bits(contact):
    simulation = Simulation(contact, SPEED, LINED, replace(CHOICE, revolutions=6))
    whole, parts = simulation.start(), simulation.start()
    samples = simulation.advance(whole, 6).samples
    again = np.concatenate([simulation.advance(parts, count).samples for count in (1, 2, 3)])
    assert np.array_equal(samples, again)


def test_a_rotor_of_one_blade_is_the_blade(contact):
    """Alone and in an elastic casing, where all blades go on together."""
    choice, single = replace(CHOICE, revolutions=3), Rotor((1,), (0.0,), (1.0,), (0.0,))
    for scene in (LINED, SCENES["elastic"]):
        one = Simulation(contact, SPEED, scene, choice).run().records[0].samples
        rotor = RotorSimulation(contact, SPEED, replace(scene, rotor=single), choice).run().records[0].samples
        np.testing.assert_allclose(rotor, one, rtol=0, atol=1e-9 * np.abs(one).max())


def test_a_mistuned_blade_has_the_large_motion_of_a_stiffer_one(contact):
    """All of its stiffness times four moves it twice as fast along the same path, which no linear blade has."""
    paths = {}
    for name, model, revolutions in (
        ("tuned", contact, 2),
        ("mistuned", mistuned(contact, 2.0), 1),
        ("linear", replace(contact, quadratic=None), 2),
    ):
        simulation = Simulation(model, SPEED, FAR, replace(CHOICE, time_step=8e-7))
        state = simulation.start()
        start_at_rest(simulation, state, 5e-4 * np.eye(len(simulation.problem.blade.frequencies))[0])
        paths[name] = simulation.advance(state, revolutions).samples
    assert len(paths["mistuned"]) == CHOICE.samples_per_revolution
    size = np.abs(paths["tuned"]).max()
    twice = paths["tuned"][1::2]
    np.testing.assert_allclose(paths["mistuned"], twice, rtol=0, atol=2e-3 * size)
    assert np.abs(paths["linear"] - paths["tuned"]).max() > 0.05 * size


def test_how_far_a_run_goes_is_told(displaced, contact):
    choice = replace(CHOICE, revolutions=2)
    numbers = run_speed(contact, SPEED, LINED, choice, (), spectrum_highest_order=8, wear_angles=4)
    assert numbers["peak_share_of_height"] == in_all_directions(numbers, "peak").max() / displaced.quadratic.height
    assert displaced.quadratic.height == pytest.approx(0.075, rel=0.05)
    # else the end of a run takes a blade whose runs all diverge for a linear one
    scene = replace(LINED, divergence_limit=0.9 * in_all_directions(numbers, "peak").max())
    cut = run_speed(contact, SPEED, scene, choice, (), spectrum_highest_order=8, wear_angles=4)
    assert cut["status"] == RunStatus.DIVERGED and 0.0 <= cut["peak_share_of_height"] < numbers["peak_share_of_height"]


def test_what_the_path_of_second_order_leaves_out_is_of_third(displaced):
    """At 4 and 8% of the height; where the series of the full model has not converged, the error is the height."""
    terms = displaced.quadratic
    np.testing.assert_allclose(PATH_SHARES[[4, 8]], [0.04, 0.08])
    assert 8.0 < terms.path_errors[8] / terms.path_errors[4] < 16.0
    assert terms.path_errors[16] < 2e-4 and np.all(terms.path_errors[17:] == terms.height)


def test_modes_that_come_near_to_each_other_are_followed():
    """Two modes turned into each other are what they were; a third, outside, takes the place of one it changes with."""
    turn = np.array([[np.cos(0.7), np.sin(0.7)], [-np.sin(0.7), np.cos(0.7)]])
    overlap = np.pad(turn, ((0, 0), (0, 2)))
    np.testing.assert_allclose(followed_modes(overlap), overlap, atol=1e-15)
    crossed = np.array([[1.0, 0.0, 0.0, 0.0], [0.0, 0.1, 0.99, 0.0]])
    np.testing.assert_allclose(followed_modes(crossed), [[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]], atol=1e-15)
