"""The time integration against exact solutions and its plain reference."""

import signal
from dataclasses import replace

import numpy as np
import pytest
from defaults import Casing, Friction, IntegrationChoice, Scene
from integration_cases import ABRADABLE, AT_ONCE, DIRECT, LINING, NARROW, SCENES, oscillator, random_model, with_static_modes
from integration_runs import (
    assert_close,
    assert_same_record,
    assert_same_state,
    both_engines,
    free_motion,
    in_all_directions,
    times,
    whole_run,
)
from motion_at_start import MotionAtStart

from r37core.contact.casing import casing_axes
from r37core.rom.contact_model import read_contact_model, write_contact_model
from r37core.rom.reduced_model import contact_model
from r37core.time_integration import integration_choice
from r37core.time_integration.integrators import (
    CENTRAL_DIFFERENCE,
    EXACT_MODAL,
    INTEGRATORS,
    central_difference,
    exact_modal,
    recursion,
)
from r37core.time_integration.problem import Problem, UnstableStepError
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.speed_file import read_speed, write_speed
from r37core.time_integration.speed_run import run_speed
from r37core.time_integration.status import RunStatus


def kept_of(model, scene, choice, results=(), speed=1000.0):
    return run_speed(model, speed, scene, choice, results, spectrum_highest_order=20, wear_angles=100)


def test_mass_against_a_rigid_stop():
    """An oscillator swings into a stop at half its amplitude: it loses its speed there, then swings with the stop's gap."""
    frequency, start, stop = 5000.0, -1e-3, 0.5e-3
    scene = Scene(Casing(stop, lobes=0), damping_ratio=0.0)
    errors = []
    for step in (4e-7, 1e-7):
        choice, motion = IntegrationChoice(step, 2, 1000), MotionAtStart(np.array([start]))
        simulation, state, record = whole_run(oscillator(frequency), 1000.0, scene, choice, motion)
        time = times(simulation, len(record.samples))
        hit = np.arccos(stop / start) / frequency
        exact = np.where(time < hit, start * np.cos(frequency * time), stop * np.cos(frequency * (time - hit)))
        errors.append(np.abs(record.samples[:, 0] - exact).max())
        assert record.samples[:, 0].max() <= stop * (1 + 1e-12)
        assert state.totals["casing_hits"] >= 1
        lost = 0.5 * frequency**2 * (start**2 - stop**2)
        assert state.totals["work"] == pytest.approx(-lost, rel=0.01)
    assert errors[0] < 0.01 * stop
    assert errors[1] < 0.4 * errors[0]


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize(("integrator", "step", "revolutions"), [(CENTRAL_DIFFERENCE, 1e-7, 1), (EXACT_MODAL, 8e-7, 2)])
def test_compiled_time_integration_is_the_reference(contact, name, integrator, step, revolutions):
    """A turn of 3,500 steps, or two of long ones, of the compiled engine against the one with dense matrices, to 1e-10."""
    choice = IntegrationChoice(step, revolutions, 62, integrator=integrator)
    (simulation, ours, record), (_, theirs, plain) = both_engines(contact, 18_000.0, SCENES[name], choice)
    stepped, of_model = len(simulation.problem.blade.frequencies), len(contact.squared_frequencies)
    assert (stepped < of_model) == (integrator == EXACT_MODAL)
    assert np.abs(plain.samples).max() > 1e-6
    assert_same_record(record, plain)
    assert_close(ours.displacement, theirs.displacement, 1e-10)
    assert_same_state(ours, theirs)
    assert ours.totals["steps_in_contact"] > 100 and ours.totals["worst_complementarity"] == 0.0
    assert name != "thin_lining" or ours.totals["casing_hits"] > 0


MANY = [(nodes, name, CENTRAL_DIFFERENCE) for nodes in (1, 8) for name in ("direct", "thin_lining")]
# the last of ten vectors half full
MANY += [(76, name, CENTRAL_DIFFERENCE) for name in ("direct_exact", "thin_lining")]
# of three vectors, and of one
MANY += [(nodes, name, EXACT_MODAL) for nodes in (1, 20) for name in ("direct", "thin_lining")]


@pytest.mark.slow
@pytest.mark.parametrize(("nodes", "name", "integrator"), MANY)
def test_any_number_of_nodes(nodes, name, integrator):
    """Vectors half full and many of them, against the reference."""
    choice, model = IntegrationChoice(2e-7, 1, 31, integrator=integrator), random_model(nodes)
    # many are in contact sooner, and cost the reference more
    speed = 120_000.0 if nodes > 8 else 12_000.0
    if integrator == EXACT_MODAL:
        model = with_static_modes(model, 1e-9)
    (_, ours, _), (_, theirs, _) = both_engines(model, speed, SCENES[name], choice)
    assert ours.totals["steps_in_contact"] > 100
    assert ours.totals["worst_complementarity"] == 0.0
    assert_close(ours.displacement, theirs.displacement, 1e-10)
    if theirs.wear.size:
        assert_close(ours.wear, theirs.wear, 1e-10)


@pytest.mark.parametrize(
    "scene", [ABRADABLE, DIRECT, replace(DIRECT, divergence_limit=2.05e-3)], ids=["lined", "direct", "diverged"]
)
def test_a_run_in_many_calls_is_the_run_in_one(contact, scene, monkeypatch):
    choice = IntegrationChoice(2e-7, 4, 62, snapshots_per_revolution=31, snapshot_revolutions=3)
    simulation, whole, record = whole_run(contact, 1000.0, scene, choice)
    calls, call, state = [], simulation.engine.program, simulation.start()
    monkeypatch.setattr(simulation.engine, "program", lambda *arguments: calls.append(1) or call(*arguments))
    monkeypatch.setattr(integration_choice, "STEPS_AT_ONCE", 1)
    # also from a sample inside of a revolution
    parts = [simulation.advance_samples(state, count) for count in (20, 4 * 62 - 20)]
    assert len(calls) > 4 or record.diverged
    assert record.diverged == parts[1].diverged == (scene.divergence_limit < 0.1) and not parts[0].diverged
    for name in ("samples", "snapshots"):
        np.testing.assert_array_equal(np.concatenate([getattr(part, name) for part in parts]), getattr(record, name))
    for name in ("displacement", "totals", "wear", "samples"):
        np.testing.assert_array_equal(getattr(state, name), getattr(whole, name))


def test_a_slow_run_can_be_interrupted(contact, monkeypatch):
    """After about a second of compiled code, where the whole run takes a minute."""
    simulation = Simulation(contact, 1.0, DIRECT, IntegrationChoice(3.2e-6, 300, 62, integrator=EXACT_MODAL))
    state = simulation.start()
    # a test before this one may have run what takes interrupts
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    steps, call = [], simulation.engine.program

    def interrupted(*arguments):
        steps.append(call(*arguments) * simulation.engine.problem.grid.steps_per_sample)
        signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr(simulation.engine, "program", interrupted)
    try:
        with pytest.raises(KeyboardInterrupt):
            simulation.advance(state, 300)
    finally:
        signal.signal(signal.SIGINT, before)
    # one of 300 revolutions, which has more steps than are done at once
    assert steps == [simulation.engine.problem.grid.steps_per_revolution]


@pytest.mark.parametrize("scene", [ABRADABLE, DIRECT], ids=["abradable", "direct"])
def test_order_of_the_contact_nodes_does_not_matter(contact, scene):
    order = np.random.default_rng(3).permutation(8)
    shuffled = replace(
        contact,
        displacement_operator=contact.displacement_operator[:, order],
        radius=contact.radius[order],
        theta=contact.theta[order],
    )
    choice = IntegrationChoice(2e-7, 1, 62)
    _, _, first = whole_run(contact, 1000.0, scene, choice)
    _, _, second = whole_run(shuffled, 1000.0, scene, choice)
    np.testing.assert_allclose(second.samples, first.samples, rtol=0, atol=1e-9 * np.abs(first.samples).max())


@pytest.mark.parametrize("scene", [NARROW, DIRECT], ids=["abradable", "direct"])
@pytest.mark.parametrize(("integrator", "step"), [(CENTRAL_DIFFERENCE, 2e-7), (EXACT_MODAL, 2e-7), (EXACT_MODAL, 8e-7)])
def test_energy_balance_closes(contact, scene, integrator, step):
    simulation, state, _ = whole_run(contact, 1600.0, scene, IntegrationChoice(step, 3, 62, integrator=integrator))
    work, loss = simulation.work(state), state.totals["loss"]
    assert loss > 0.0
    assert abs(simulation.energy(state) - work + loss) < 1e-9 * (abs(work) + loss)


def test_a_step_that_is_unstable_or_too_long_for_the_lining_is_refused_with_the_limit(contact):
    highest = np.sqrt(contact.modes_at(1000.0)[0][-1] ** 2)
    limit = 2.0 / highest
    with pytest.raises(UnstableStepError, match=rf"time_step_s: .* stability limit .* {limit:.6g} s"):
        Problem(contact, 1000.0, DIRECT, IntegrationChoice(1.02 * limit, 1, 62))
    Problem(contact, 1000.0, DIRECT, IntegrationChoice(0.98 * limit, 1, 62))
    stiff = replace(ABRADABLE, lining=replace(LINING, elastic_modulus=20e12))
    with pytest.raises(UnstableStepError, match=r"limit for this lining, about .* N/m"):
        Problem(contact, 1000.0, stiff, IntegrationChoice(2e-7, 1, 62))


def test_divergence_is_a_result(contact, tmp_path):
    scene = replace(DIRECT, divergence_limit=2e-5)
    choice = IntegrationChoice(2e-7, 6, 62, snapshots_per_revolution=62, snapshot_revolutions=1)
    kept = kept_of(contact, scene, choice, ("spectrum", "stress", "energy"))
    assert kept["status"] == RunStatus.DIVERGED
    assert 0.0 < kept["diverged_revolution"] < 6.0
    assert kept["diverged_time"] == pytest.approx(kept["diverged_revolution"] * 2 * np.pi / 1000.0)
    assert np.isnan(in_all_directions(kept, "rms")).all()
    assert len(kept["snapshots"]) == 0
    write_speed(kept, tmp_path / "speed_1000.npz", {"blade": "Ref"})
    assert read_speed(tmp_path / "speed_1000.npz")["status"] == RunStatus.DIVERGED


def test_a_run_that_blows_up_is_flagged_without_infinities(contact):
    """Friction feeding the blade through an absurd coefficient: numbers overflow, the file does not."""
    scene = Scene(AT_ONCE, None, Friction(8.0, vector=False), damping_ratio=0.0, divergence_limit=1e300)
    with np.errstate(all="ignore"):
        kept = kept_of(contact, scene, IntegrationChoice(2e-7, 6, 62), speed=1500.0)
    for name, values in kept.items():
        assert kept["status"] == RunStatus.DIVERGED or np.all(np.isfinite(values) | np.isnan(values)), name
        assert not np.any(np.isinf(values[~np.isnan(values)])) or name in {"largest_normal_force"}, name


def test_only_what_is_asked_for_is_kept(contact):
    choice = IntegrationChoice(2e-7, 2, 62)
    kept = kept_of(contact, DIRECT, choice)
    asked = {"amplitude", "snapshots", "wear", "contact_work", "damping_loss"}
    assert not asked & set(kept)
    rich = replace(choice, snapshots_per_revolution=62, snapshot_revolutions=1)
    everything = kept_of(contact, ABRADABLE, rich, ("spectrum", "stress", "wear", "energy"))
    assert asked <= set(everything)
    np.testing.assert_array_equal(everything["snapshots"].shape, (62, len(contact.squared_frequencies)))


def test_snapshots_are_evenly_spread_over_the_last_revolutions(contact):
    """A quarter of the samples of the last two of three revolutions, each the state at its sample."""
    choice = IntegrationChoice(2e-7, 3, 64, snapshots_per_revolution=16, snapshot_revolutions=2)
    simulation, _, record = whole_run(contact, 1000.0, ABRADABLE, choice)
    assert len(record.snapshots) == 32
    along = casing_axes(contact.tip_displacement_operator, simulation.problem.casing.cone_angle)[0, 0]
    normal = record.snapshots @ (along @ simulation.problem.blade.modes)
    np.testing.assert_allclose(normal, record.samples[64 + 3 :: 4, 0], rtol=1e-9, atol=1e-15)


def test_speed_run_numbers(contact):
    """rms, peak and spectrum of a run against direct sums over its samples."""
    choice = IntegrationChoice(2e-7, 8, 62)
    _, _, record = whole_run(contact, 1000.0, ABRADABLE, choice)
    kept = kept_of(contact, ABRADABLE, choice, ("spectrum", "wear"))
    half = record.samples[4 * 62 :]
    np.testing.assert_allclose(in_all_directions(kept, "rms").ravel(), np.sqrt(np.mean(half**2, axis=0)), rtol=1e-12)
    np.testing.assert_allclose(in_all_directions(kept, "peak").ravel(), np.abs(half).max(axis=0), rtol=1e-12)
    np.testing.assert_allclose(kept["revolution_maximum"][3, 0], np.abs(record.samples[3 * 62 : 4 * 62, 0]).max())
    turn = 2 * np.pi * np.arange(len(half)) / 62
    by_hand = 2 * abs(np.mean(half[:, 0] * np.exp(-2j * turn)))
    where = np.flatnonzero(kept["engine_order"] == 2.0)[0]
    assert kept["amplitude"][where] == pytest.approx(by_hand, rel=1e-5)
    assert kept["engine_order"][1] == 0.25
    assert kept["max_wear"] == pytest.approx(kept["wear"].max(), rel=1e-6)
    assert kept["wear"].shape == (100,)


def test_contact_model(model, contact, tmp_path):
    frequencies, modes = contact.modes_at(1500.0)
    np.testing.assert_allclose(frequencies[:10], model.modes(1500.0, 10)[0], rtol=1e-9)
    np.testing.assert_allclose(modes.T @ modes, np.eye(len(modes)), atol=1e-12)
    line = model.tip_lines["pressure_edge"]
    assert np.degrees(contact.tip_cone_angle) == pytest.approx(-15.24, abs=0.01)
    np.testing.assert_allclose(line.cone_angle, contact.tip_cone_angle)
    # leading edge upstream, trailing edge downstream, at the ends of the tip: rotor 37 is 2.8 cm long there
    assert line.points[-1, 2] - line.points[0, 2] > 0.02
    for edge, end in enumerate((0, -1)):
        x, y, z = line.basis[end] @ contact.to_reduced
        angle = np.arctan2(line.points[end, 1], line.points[end, 0])
        expected = [np.cos(angle) * x + np.sin(angle) * y, np.cos(angle) * y - np.sin(angle) * x, z]
        np.testing.assert_allclose(contact.tip_displacement_operator[:, edge], expected, rtol=1e-9, atol=1e-12)
    # the boundary coordinates are the displacements themselves
    coordinates = np.zeros(model.size)
    coordinates[:3] = [1e-3, 2e-3, 3e-3]
    rest_state = np.linalg.solve(contact.to_reduced, coordinates)
    radial, tangential, axial = contact.displacement_operator[:, 0] @ rest_state
    theta = contact.theta[0]
    assert radial == pytest.approx(np.cos(theta) * 1e-3 + np.sin(theta) * 2e-3, rel=1e-6)
    assert tangential == pytest.approx(np.cos(theta) * 2e-3 - np.sin(theta) * 1e-3, rel=1e-6)
    assert axial == pytest.approx(3e-3, rel=1e-6)
    write_contact_model(contact, tmp_path / "contact.npz")
    again = read_contact_model(tmp_path / "contact.npz")
    np.testing.assert_array_equal(again.displacement_operator, contact.displacement_operator)
    assert again.tip_cone_angle == contact.tip_cone_angle


def test_the_tip_is_the_line_wherever_its_contact_nodes_lie(model, contact):
    """Without corners among them, the tip's ends and cone stay those of the line."""
    line = model.tip_lines["pressure_edge"]
    inner = contact_model(replace(model, contact_nodes=line.select(list(range(2, len(line.nodes) - 2, 3)))), "pressure_edge")
    assert inner.displacement_operator.shape[1] == len(line.nodes[2:-2:3])
    np.testing.assert_array_equal(inner.tip_displacement_operator, contact.tip_displacement_operator)
    assert inner.tip_cone_angle == contact.tip_cone_angle


def test_discrete_energy_tends_to_the_exact_one_with_the_step():
    """A damped oscillator keeps exp(-2 xi omega t) of its energy; what is off shrinks with the step."""
    frequency, ratio = 50_000.0, 0.01
    errors = []
    for step in (4e-6, 2e-6, 1e-6):
        scene = Scene(Casing(1.0, lobes=0), damping_ratio=ratio)
        choice = IntegrationChoice(step, 2, 100)
        simulation = Simulation(oscillator(frequency), 1000.0, scene, choice)
        state = simulation.start()
        state.displacement[:] = 1e-3
        simulation.advance(state, choice.revolutions)
        exact = 0.5 * (frequency * 1e-3) ** 2
        lost = exact * (1.0 - np.exp(-2.0 * ratio * frequency * simulation.problem.grid.duration))
        errors.append(abs(state.totals["loss"] / lost - 1.0))
        assert simulation.energy(state) + state.totals["loss"] == pytest.approx(exact, rel=1e-10)
    assert errors[0] < 0.01
    assert errors[2] < errors[1] < errors[0]


@pytest.mark.parametrize("ratio", [0.0, 5e-4, 0.3, 0.99])
@pytest.mark.parametrize("frequency", [6e3, 1e5, 3e6, 3e7])
def test_exact_modal_is_the_free_motion_at_any_step(frequency, ratio):
    """Also at steps of many periods, where central differences would have left for infinity."""
    step = 1e-6
    stepping = exact_modal(np.array([frequency]), ratio, step)
    time = step * np.arange(200)
    exact = free_motion(frequency, ratio, time, 1.0, 0.2 * frequency)
    u, d = exact[1], exact[1] - exact[0]
    for n in range(2, len(time)):
        d = stepping.keep[0] * d - stepping.pull[0] * u
        u += d
        assert u == pytest.approx(exact[n], abs=1e-9)


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_a_constant_force_holds_the_static_deflection(integrator):
    """The fixed point of the recursion is F/omega^2, whatever the step."""
    frequencies = np.array([4e3, 7e4, 1.2e6])
    stepping = recursion(integrator, frequencies, 0.05, 1e-6)
    np.testing.assert_allclose(stepping.inverse / stepping.pull, 1.0 / frequencies**2, rtol=1e-12)


def test_both_tend_to_each_other_with_the_step():
    frequencies, ratio = np.array([5e3, 5e4]), 1e-3
    differences = []
    for step in (1e-6, 1e-7):
        central, exact = central_difference(frequencies, ratio, step), exact_modal(frequencies, ratio, step)
        differences.append(np.abs(central.pull / exact.pull - 1.0))
        np.testing.assert_allclose(central.lost, exact.lost, rtol=5.0 * frequencies.max() * step)
    np.testing.assert_allclose(differences[0] / differences[1], 100.0, rtol=0.05)
