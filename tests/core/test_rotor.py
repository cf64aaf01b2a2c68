"""A whole rotor on one lining: limits that are single blades, symmetry, order, energy, the step-by-step formulation."""

from dataclasses import replace

import numpy as np
import pytest
from defaults import Casing, Friction, IntegrationChoice, Scene
from integration_cases import ABRADABLE, DIRECT, NARROW, RING, random_model, with_static_modes
from integration_runs import ENGINES, ROTORS, assert_close, assert_same_state, whole_run

from r37core.contact.ring import RingMode
from r37core.contact.scene import Rotor
from r37core.time_integration import integration_choice
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL
from r37core.time_integration.rotor_blades import blade_problems, mistuned
from r37core.time_integration.rotor_simulation import RotorSimulation
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.speed_file import write_speed
from r37core.time_integration.speed_run import run_speed
from r37core.time_integration.step_checks import pressed_ratio, pressed_ratio_of_rotor
from r37core.time_integration.step_limit import UnstableStepError

SPEED = 1000.0
CHOICE = IntegrationChoice(1e-5, 4, 64, integrator=EXACT_MODAL)
KEPT = {"spectrum_highest_order": 5, "wear_angles": 36}
STEEP = replace(ABRADABLE, casing=replace(ABRADABLE.casing, lobes=2, amplitude=2.0, rise_fraction=0.2))
"""Lobes that rise in the first revolutions."""

LINED_RING = replace(STEEP, casing=replace(STEEP.casing, ring=RING.modes()))
DIRECT_RING = replace(LINED_RING, lining=None)
FLANGE = replace(RING, radial_foundation=1e9, tangential_foundation=1e9)
FLANGED = replace(STEEP, casing=replace(STEEP.casing, ring=FLANGE.modes()))
"""The rotor overtakes none of its waves."""


def a_blade():
    """Eight nodes on soft modes, so that what one blade wears away another one feels."""
    model = with_static_modes(random_model(8), 1e-9)
    softer = np.where(model.squared_frequencies < 1e14, model.squared_frequencies * 1e-2, model.squared_frequencies)
    return replace(model, squared_frequencies=softer)


def rotor_of(blades, angles=None, factors=None, longer=None, shared=True):
    angles = 2.0 * np.pi * np.arange(blades) / blades if angles is None else angles
    factors, longer = factors or [1.0] * blades, longer or [0.0] * blades
    return Rotor(tuple(range(1, blades + 1)), tuple(map(float, angles)), tuple(factors), tuple(longer), shared)


def run(rotor, scene=STEEP, choice=CHOICE, engine="compiled"):
    return ROTORS[engine](a_blade(), SPEED, replace(scene, rotor=rotor), choice).run()


def samples(done):
    return np.array([blade.samples for blade in done.records])


def casings(done):
    return np.array([blade.casing for blade in done.records])


SCENES = {"rigid": STEEP, "lined": LINED_RING, "direct": DIRECT_RING}


@pytest.mark.parametrize("name", SCENES)
def test_a_rotor_of_one_blade_is_the_blade(name):
    """The blade passes the casing in parts, each of which has snapshots."""
    choice = replace(CHOICE, snapshots_per_revolution=4, snapshot_revolutions=CHOICE.revolutions - 1)
    _, state, alone = whole_run(a_blade(), SPEED, SCENES[name], choice)
    of_rotor = run(rotor_of(1), SCENES[name], choice)
    assert np.abs(alone.samples).max() > 1e-5 and len(alone.snapshots) > 8
    assert state.totals["steps_in_contact"] > 0.0
    for kind in ("samples", "snapshots", "casing"):
        np.testing.assert_array_equal(getattr(of_rotor.records[0], kind), getattr(alone, kind))
    np.testing.assert_array_equal(of_rotor.states[0].wear, state.wear)
    assert of_rotor.states[0].totals == state.totals


@pytest.mark.parametrize(("name", "result"), [("rigid", "spectrum"), ("lined", "casing")])
def test_its_file_is_that_of_the_blade(name, result):
    scene, results = SCENES[name], (result, "wear", "energy")
    alone = run_speed(a_blade(), SPEED, scene, CHOICE, results, **KEPT)
    rotor = run_speed(a_blade(), SPEED, replace(scene, rotor=rotor_of(1)), CHOICE, results, **KEPT)
    assert set(alone) <= set(rotor)
    # of a rotor it is not known how much the lining wears at the end, and the power is that of the whole run
    assert np.isnan(rotor["wear_growth"])
    for kept in alone.keys() - {"wear_growth", "motion_at_end", "force_so_far", "heat_so_far"}:
        np.testing.assert_array_equal(rotor[kept], alone[kept], err_msg=kept)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "shared"), [("rigid", True), ("rigid", False), ("lined", True), ("lined", False), ("direct", True)]
)
def test_pass_by_pass_is_step_by_step(name, shared):
    """The compiled engine lets a blade pass a rigid casing before the next one; the reference does all in each step."""
    scene, choice = SCENES[name], replace(CHOICE, revolutions=1, shorten=True)
    angles = 2.0 * np.pi * np.array([0, 21, 40, 22]) / CHOICE.samples_per_revolution
    rotor = rotor_of(4, angles, [1.0, 1.03, 0.97, 1.01], [0.0, 2e-5, 0.0, -1e-5], shared)
    compiled = run(rotor, scene, choice)
    reference = run(rotor, scene, choice, "reference")
    parts = [samples] if name == "rigid" else [samples, casings]
    for of in parts:
        assert_close(of(compiled), of(reference), 1e-8)
    for one, other in zip(compiled.states, reference.states, strict=True):
        assert_same_state(one, other, within=1e-8)
    np.testing.assert_allclose(compiled.worn, reference.worn, rtol=1e-6)
    # each blade has the motion of the one casing
    for blade in casings(compiled)[1:]:
        np.testing.assert_array_equal(blade, casings(compiled)[0])
    alone = parts[-1](run(rotor_of(1), scene, choice))[0]
    coupled = np.abs(parts[-1](compiled)[0] - alone).max() > 1e-3 * np.abs(alone).max()
    assert coupled == (shared or name != "rigid")


def test_at_any_angle_a_blade_of_its_own_lining_is_one_that_is_turned():
    for share, within in ((0.0, 1e-9), (0.4, 0.1)):
        angle = 2.0 * np.pi * (17.0 + share) / CHOICE.samples_per_revolution
        both = run(rotor_of(2, [0.0, angle], shared=False))
        _, _, alone = whole_run(replace(a_blade(), theta=a_blade().theta + angle), SPEED, STEEP, CHOICE)
        # the single blade starts at time 0, that of the rotor with its next whole sample
        assert both.late[1] == pytest.approx(share)
        maxima = [np.abs(part.samples[:, 0]).reshape(CHOICE.revolutions, -1).max(axis=1) for part in (both.records[1], alone)]
        np.testing.assert_allclose(*maxima, rtol=within)


@pytest.mark.parametrize(("name", "other"), [("rigid", [2, 0, 3, 1]), ("direct", [2, 0, 1])])
def test_blades_in_another_order_are_the_same_rotor(name, other):
    blades = np.array([[0.3, 4.0, 2.0, 5.5], [1.0, 1.02, 0.97, 1.01], [0.0, 1e-5, 0.0, 2e-5]])
    rotors = (rotor_of(len(order), *map(list, blades[:, order])) for order in (sorted(other), other))
    first, second = (samples(run(rotor, SCENES[name], replace(CHOICE, revolutions=2))) for rotor in rotors)
    np.testing.assert_array_equal(first[other], second)


def test_angles_beyond_a_turn_are_those_within_it():
    angles = np.array([0.3, 4.0, 2.0])
    first, second = (samples(run(rotor_of(3, beyond))) for beyond in (angles, angles - 2.0 * np.pi))
    np.testing.assert_array_equal(first, second)


@pytest.mark.parametrize("name", SCENES)
def test_energy_of_blades_and_casing_closes(name):
    scene = SCENES[name]
    results, rotor = ("energy", "casing") if scene.casing.ring else ("energy",), rotor_of(3, factors=[1.0, 1.01, 0.99])
    numbers = run_speed(a_blade(), SPEED, replace(scene, rotor=rotor), CHOICE, results, **KEPT)
    assert abs(numbers["contact_work"]) > 0.0
    assert abs(numbers["energy_residual"]) < 1e-9 * abs(numbers["damping_loss"])
    assert numbers["lined"] == (scene.lining is not None)
    assert not scene.casing.ring or 0.0 < numbers["casing_energy"].max() < np.inf


def test_mistuning_is_a_factor_of_all_frequencies_at_any_speed():
    model = replace(a_blade(), stiffness_per_square=np.eye(len(a_blade().squared_frequencies)))
    for speed in (0.0, 800.0):
        tuned, modes = model.modes_at(speed)
        others, same = mistuned(model, 1.05).modes_at(speed)
        np.testing.assert_allclose(others, 1.05 * tuned, rtol=1e-12)
        np.testing.assert_allclose(np.abs(same), np.abs(modes), atol=1e-9)


def test_a_longer_blade_meets_the_lining_before_the_others():
    done = run(rotor_of(3, longer=[0.0, 5e-5, 0.0]))
    assert done.worn[1] > 1.3 * max(done.worn[0], done.worn[2])
    surfaces = done.problem.casing.bar_surfaces
    assert done.worn.sum() == pytest.approx(surfaces @ done.states[0].wear.sum(axis=1), rel=1e-9)


@pytest.mark.parametrize(
    ("rotor", "scene"),
    [
        pytest.param(rotor_of(5, angles=[0.5] * 5), STEEP, id="one angle"),
        pytest.param(rotor_of(200), STEEP, id="200 blades"),
        pytest.param(rotor_of(3, longer=[0.0, 0.0, -0.05]), STEEP, id="never touches"),
        pytest.param(rotor_of(4, factors=[0.5, 1.5, 0.7, 1.3]), STEEP, id="half as fast"),
        pytest.param(rotor_of(2), replace(STEEP, lining=replace(STEEP.lining, thickness=1e-4)), id="worn through"),
        pytest.param(rotor_of(2, longer=[0.0, 5e-4]), STEEP, id="in the lining"),
        pytest.param(rotor_of(3, angles=[0.5] * 3), LINED_RING, id="elastic, one angle"),
        pytest.param(rotor_of(4, factors=[0.5, 1.5, 0.7, 1.3]), FLANGED, id="elastic, half as fast"),
    ],
)
def test_extremes_are_numbers(rotor, scene, tmp_path):
    choice = replace(CHOICE, revolutions=2, shorten=True)
    numbers = run_speed(a_blade(), SPEED, replace(scene, rotor=rotor), choice, ("spectrum", "wear", "energy"), **KEPT)
    assert numbers["status"] == 0
    assert np.isfinite(numbers["blade_rms"]).all() and np.isfinite(numbers["wear"]).all()
    write_speed(numbers, tmp_path / "speed.npz", {})
    assert (tmp_path / "speed.npz").stat().st_size < 1_000_000


@pytest.mark.parametrize("scene", [LINED_RING, DIRECT_RING], ids=["lined", "direct"])
def test_a_rotor_in_an_elastic_casing_is_the_same_in_many_calls(scene, monkeypatch):
    rotor = rotor_of(3, [0.0, 4.1, 2.0], [1.0, 1.03, 0.97])
    whole = run(rotor, scene)
    monkeypatch.setattr(integration_choice, "STEPS_AT_ONCE", 1)
    other = run(rotor, scene)
    np.testing.assert_array_equal(samples(other), samples(whole))
    np.testing.assert_array_equal(other.worn, whole.worn)
    assert [state.totals for state in other.states] == [state.totals for state in whole.states]


@pytest.mark.parametrize("scene", [LINED_RING, DIRECT_RING], ids=["lined", "direct"])
def test_a_blade_too_short_to_touch_changes_nothing_for_the_other(scene):
    """Whichever of the two counts the work of the casing."""
    choice = replace(CHOICE, revolutions=2)
    for first in (0.0, 6.0):
        together = run(rotor_of(2, [first, 3.0], longer=[0.0, -0.05]), scene, choice)
        _, state, alone = whole_run(together.problems[0].model, SPEED, scene, choice)
        assert_close(together.records[0].samples, alone.samples, 1e-9)
        np.testing.assert_array_equal(together.records[1].samples, 0.0)
        for total in ("work", "loss"):
            both = sum(of.totals[total] for of in together.states)
            assert both == pytest.approx(state.totals[total], rel=1e-9)


@pytest.mark.parametrize("engine", ENGINES)
def test_opposite_blades_leave_odd_waves_at_rest(engine):
    """Two forces half a turn apart push waves of an even number of nodal diameters twice, and odd ones not at all."""
    choice = replace(CHOICE, revolutions=1)
    opposite = run(rotor_of(2), DIRECT_RING, choice, engine)
    odd = np.tile([mode.nodal_diameter % 2 == 1 for mode in RING.modes()], 2)
    moved = np.abs(casings(opposite)[0]).max(axis=0)
    assert moved[odd].max() < 1e-9 * moved[~odd].max()
    alone = np.abs(casings(run(rotor_of(1), DIRECT_RING, choice, engine))[0]).max(axis=0)
    assert alone[odd].max() > 0.1 * alone[~odd].max()


def test_a_step_of_all_blades_is_told_stable_by_a_bound_of_their_largest_eigenvalue():
    rotor = rotor_of(4, [0.0, 1.0, 3.0, 3.1], [1.0, 1.02, 0.97, 1.01])
    light = tuple(replace(mode, modal_mass=0.6 * mode.modal_mass) for mode in RING.modes())
    scene = replace(LINED_RING, casing=replace(LINED_RING.casing, ring=light))
    contacts = [problem.contact for problem in blade_problems(a_blade(), SPEED, scene, rotor, replace(CHOICE, time_step=5e-6))]
    of_ring, blades = len(contacts[0].casing.ring.size), [len(contact.blade.frequencies) for contact in contacts]
    total = sum(blades) + of_ring
    matrix, first = np.zeros((total, total)), 0
    for contact, modes in zip(contacts, blades, strict=True):
        lanes = np.r_[first : first + modes, total - of_ring : total]
        pressed = contact.displacement_operator[0] * np.sqrt(contact.recursion.inverse)
        matrix[np.ix_(lanes, lanes)] += pressed.T @ np.linalg.solve(contact.contact_flexibility[0], pressed)
        matrix[range(first, first + modes), range(first, first + modes)] += contact.recursion.pull[:modes]
        first += modes
    matrix[range(first, total), range(first, total)] += contacts[0].recursion.pull[-of_ring:]
    largest = np.linalg.eigvalsh(matrix)[-1] / (2.0 + 2.0 * min(contact.recursion.keep.min() for contact in contacts))
    assert largest > 1.1 * max(map(pressed_ratio, contacts))
    assert largest <= pressed_ratio_of_rotor(contacts) < 1.2 * largest
    with pytest.raises(UnstableStepError, match="4 blades pressed on one elastic casing"):
        run(rotor, scene, CHOICE)
    shortened = RotorSimulation(a_blade(), SPEED, replace(scene, rotor=rotor), replace(CHOICE, shorten=True))
    assert shortened.problem.grid.time_step < 0.6 * CHOICE.time_step


def test_no_rotor_is_run_as_a_single_blade():
    with pytest.raises(ValueError, match="RotorSimulation"):
        Simulation(a_blade(), SPEED, replace(STEEP, rotor=rotor_of(2)), CHOICE)
    with pytest.raises(ValueError, match="nothing couples the blades"):
        RotorSimulation(a_blade(), SPEED, replace(DIRECT, rotor=rotor_of(2)), CHOICE)
    with pytest.raises(ValueError, match="needs the integrator exact_modal"):
        run(rotor_of(2), LINED_RING, replace(CHOICE, time_step=1e-7, integrator=CENTRAL_DIFFERENCE))


RISING = Scene(Casing(0.356e-3, rise_fraction=0.5), NARROW.lining, Friction(0.15))
STIFF_RING = replace(RISING, casing=replace(RISING.casing, ring=(RingMode(0, 1e5, 1e6, 0.01),)))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("engine", "scene", "revolutions"), [("compiled", STIFF_RING, 6), ("reference", RISING, 2), ("reference", STIFF_RING, 2)]
)
def test_blades_on_one_grid_of_time_wear_the_lining_as_those_that_pass_one_by_one(contact, engine, scene, revolutions):
    """Each meets the lining between the places where the others do; one by one all meet it at the same places."""
    choice = IntegrationChoice(6.4e-6, revolutions, 62, integrator=EXACT_MODAL)
    runs = []
    for one, simulated_by in ((RISING, "compiled"), (scene, engine)):
        runs.append(ROTORS[simulated_by](contact, 1700.0, replace(one, rotor=rotor_of(4)), choice).run())
    np.testing.assert_allclose(runs[1].worn, runs[0].worn, rtol=0.02)
    for parts in zip(*(done.records for done in runs), strict=True):
        maxima = [np.abs(part.samples[:, 2]).reshape(revolutions, -1).max(axis=1) for part in parts]
        np.testing.assert_allclose(*maxima, rtol=0, atol=0.06 * maxima[1].max())
