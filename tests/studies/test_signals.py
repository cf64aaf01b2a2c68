"""Time signals against closed forms: strain gauges, tip timing, and records against the runs of the sweep."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from box_mesh import box_mesh
from defaults import IntegrationChoice
from scipy.optimize import brentq
from test_run_statistics import SPEED

from r37core.rom.recovery_nodes import RecoveryNodes
from r37core.stress.gauge import Gauge
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.speed_run import run_speed
from r37core.time_integration.status import RunStatus
from r37studies.blade_runs import BladeRuns
from r37studies.gauges import gauge_rows
from r37studies.signals.dataset import signals_dataset
from r37studies.signals.record import record_signals
from r37studies.tip_timing import arrival_times


@pytest.mark.parametrize("element", ("wedge15", "hexahedron20", "tetra10", "wedge", "hexahedron", "tetra"))
@pytest.mark.parametrize("side", ["pressure", "suction"])
def test_a_gauge_in_uniaxial_tension(element, side):
    """Strain 1e-3 along the span, Poisson's ratio 0.3: e cos^2 - 0.3 e sin^2 at every place and angle."""
    box = box_mesh(0.3, 0.2, 0.05, (3, 2, 1), warp=0.0, element=element)
    basis = (box.points * [1e-3, -0.3e-3, -0.3e-3])[:, :, None]
    angles = np.radians([0.0, 30.0, 45.0, 90.0, -60.0, 180.0])
    gauges = [Gauge(chord, span, side, angle) for angle in angles for chord, span in ((0.31, 0.4), (0.9, 0.05), (0.5, 0.99))]
    expected = 1e-3 * (np.cos(angles) ** 2 - 0.3 * np.sin(angles) ** 2)
    np.testing.assert_allclose(gauge_rows(box, basis, gauges)[0][:, 0], np.repeat(expected, 3), atol=1e-14)


def test_the_sign_of_an_angle_and_a_place_that_is_not_on_the_mesh():
    """Shear u_x = g y, with chord along y: g sin a cos a, positive between span and trailing edge."""
    box = box_mesh(0.3, 0.2, 0.05, (3, 2, 1))
    basis = np.zeros((len(box.points), 3, 1))
    basis[:, 0, 0] = 2e-3 * box.points[:, 1]
    gauges = [Gauge(0.4, 0.4, "suction", np.radians(angle)) for angle in (45.0, -45.0, 0.0)]
    np.testing.assert_allclose(gauge_rows(box, basis, gauges)[0][:, 0], [1e-3, -1e-3, 0.0], atol=1e-15)
    with pytest.raises(ValueError, match=r"chord 1\.2 and span 0\.5 is not on the suction side of the mesh; .*signals\.gauges"):
        gauge_rows(box, basis, [Gauge(1.2, 0.5, "suction", 0.0)])


def test_gauges_lie_where_they_are_asked_for(blade, mesh):
    """On the blade's own surface, to what the elements' sides differ from it; a rigid motion strains none."""
    gauges = [Gauge(*place, 0.7) for place in product((0.1, 0.5, 0.93), (0.1, 0.8), ("pressure", "suction"))]
    thickness = np.array([{"pressure": -1.0, "suction": 1.0}[gauge.side] for gauge in gauges])
    chord, span = np.array([[gauge.chord, gauge.span] for gauge in gauges]).T
    there = blade.position(chord, span, thickness)
    turn = np.cross([0.3, -0.5, 0.8], mesh.points)
    basis = np.stack([turn, np.tile([1.0, 2.0, 3.0], (len(turn), 1))], axis=2)
    rows, places = gauge_rows(mesh, basis, gauges)
    np.testing.assert_allclose(places, there, atol=2e-5)
    np.testing.assert_allclose(rows, 0.0, atol=1e-10)


def test_a_gauge_along_the_span_of_a_curved_blade(mesh):
    """Stretched everywhere by 1e-3 along x: e (n . x)^2, and almost e where the span is almost radial."""
    basis = np.zeros((len(mesh.points), 3, 1))
    basis[:, 0, 0] = 1e-3 * mesh.points[:, 0]
    along, across = gauge_rows(mesh, basis, [Gauge(0.5, 0.5, "suction", angle) for angle in (0.0, np.pi / 2)])[0][:, 0]
    assert along == pytest.approx(1e-3, rel=0.05)
    assert along + across < 1e-3
    assert across < 0.05e-3


def test_arrivals_of_a_harmonic_motion():
    """Against the root of Omega t - u(t)/R = theta - p + 2 pi k, with u in closed form; and what the arrival tells is u."""
    radius, theta, amplitude, pulsation, lag = 0.25, -0.2, 4e-3, 3.37 * SPEED, 0.4
    times = np.arange(1, 10 * 496 + 1) * 2.0 * np.pi / SPEED / 496

    def u(t):
        return amplitude * np.sin(pulsation * t + lag)

    probes, turns = np.radians([0.0, 77.0, 200.0, 359.0]), np.arange(1, 11)
    point = radius * np.array([np.cos(theta), np.sin(theta), 0.0])
    arrived, told = arrival_times(times, u(times), point, SPEED, probes, turns)
    for i, probe in enumerate(probes):
        for j, turn in enumerate(turns):
            angle = (theta - probe) % (2.0 * np.pi) + 2.0 * np.pi * (turn - 1)
            exact = brentq(lambda t, angle=angle: SPEED * t - u(t) / radius - angle, angle / SPEED - 1e-4, angle / SPEED + 1e-4)
            if times[1] < exact < times[-1]:
                assert arrived[i, j] == pytest.approx(exact, abs=1e-10)
                assert told[i, j] == pytest.approx(u(exact), abs=1e-7)
    assert np.isfinite(arrived).sum() >= 38


def test_a_tip_that_comes_back_counts_when_it_first_comes():
    """So large a swing that the tip passes the probe three times; and NaN after the end of the signal."""
    times = np.linspace(0.0, 2.0 * np.pi / SPEED, 2000)
    motion = 0.05 * np.sin(12.0 * SPEED * times)
    wanted = 10.0 * np.pi / 12.0
    arrived, _ = arrival_times(times, motion, np.array([0.25, 0.0, 0.0]), SPEED, np.array([-wanted]), np.array([1, 2]))
    turned = SPEED * times - motion / 0.25
    assert np.sum(np.diff(np.sign(turned - wanted)) != 0) == 3
    assert arrived[0, 0] == pytest.approx(times[np.argmax(turned >= wanted)], abs=times[1])
    assert np.isnan(arrived[0, 1])


@pytest.fixture(scope="module")
def scene(settings):
    return settings.scenes["abradable"].scene


def test_a_record_is_the_run_of_the_sweep(contact, scene, model):
    """The same numbers to the last digit; with gauges as without."""
    choice = IntegrationChoice(4e-7, 4, 62, "exact_modal", snapshots_per_revolution=31, snapshot_revolutions=1)
    run = run_speed(contact, 1200.0, scene, choice, ("stress",), spectrum_highest_order=10, wear_angles=60)
    rows = np.eye(model.size)[:2]
    record = record_signals(BladeRuns(contact, scene, choice), 1200.0, rows, 4)
    for name in ("normal", "tangential"):
        rms = np.sqrt(np.mean(record[name].T[2 * 62 :] ** 2, axis=0))
        np.testing.assert_array_equal(rms, run[f"rms_{name}"])
    np.testing.assert_array_equal(np.abs(record["normal"][:, -62:]).max(axis=1), run["revolution_maximum"][-1])
    # a row of one reduced coordinate is that coordinate of the snapshots
    np.testing.assert_allclose(record["strain"].T[-62:][1::2], run["snapshots"][:, :2], rtol=1e-6, atol=1e-18)
    # of the last three revolutions
    bare = record_signals(BladeRuns(contact, scene, choice), 1200.0, np.empty((0, model.size)), 3)
    np.testing.assert_array_equal(bare["normal"], record["normal"][:, 62:])
    assert bare["strain"].shape == (0, 3 * 62) and record["status"] == RunStatus.COMPLETED
    np.testing.assert_allclose(bare["turn"], 1.0 + np.arange(1, 3 * 62 + 1) / 62)


def test_the_contact_force_of_a_record_is_that_of_the_run(contact, scene, model):
    """Its last number is that of the state; in each revolution it presses where the motion has closed the gap."""
    choice = IntegrationChoice(4e-7, 4, 62, "exact_modal")
    record = record_signals(BladeRuns(contact, scene, choice), 1200.0, np.empty((0, model.size)), 4)
    simulation = Simulation(contact, 1200.0, scene, choice)
    state, last = simulation.start(), []
    for _ in range(4 * 62):
        simulation.advance_samples(state, 1)
        last.append(-state.contact_force[0].sum())
    np.testing.assert_allclose(record["contact_force"], last, rtol=1e-9, atol=1e-9)
    assert record["contact_force"].min() == 0.0 < record["contact_force"].max()
    # the casing's own gaps, node by node and step by step
    casing = simulation.problem.casing
    steps = simulation.problem.grid.steps_per_sample * np.array([1, 40, 133, 248])
    nowhere = np.zeros((3, len(casing.tip.theta)))
    gaps = [casing.gaps(casing.clearance, nowhere, int(step), 0.0)[0][0] for step in steps]
    np.testing.assert_allclose(record["clearance"][[0, 39, 132, 247]], gaps, rtol=1e-9)
    published = record_signals(BladeRuns(contact, scene, IntegrationChoice(1e-7, 2, 62)), 1200.0, np.empty((0, model.size)), 2)
    assert np.isnan(published["contact_force"]).all() and np.isfinite(published["clearance"]).all()


def test_a_divergence_ends_the_record(contact, scene):
    close = replace(scene, divergence_limit=2e-5)
    record = record_signals(BladeRuns(contact, close, IntegrationChoice(4e-7, 4, 62)), 1200.0, np.empty((0, 0)), 4)
    assert record["status"] == RunStatus.DIVERGED
    known = np.isfinite(record["normal"][0])
    assert 0 < known.sum() < len(known)
    assert not known[known.sum() :].any()
    assert np.abs(record["normal"][:, known]).max() < 2e-5


PLACE = np.array([0.2, 0.01, 0.02])
TIP = RecoveryNodes(np.arange(2), np.array([[0.25, 0.0, 0.0], [0.24, 0.01, 0.03]]), np.zeros((2, 3, 1)), np.zeros((2, 3, 1)))


def record_of(turns, gauges=1):
    turn = np.arange(1, turns * 50 + 1) / 50
    wave = 1e-3 * np.sin(2.0 * np.pi * 4.0 * turn)
    shares = {"normal": [1, 2], "tangential": [0.5, 1], "strain": np.ones(gauges)}
    record = {name: np.outer(each, wave) for name, each in shares.items()}
    return record | {"turn": turn, "contact_force": 100.0 * np.floor(turn), "clearance": 1e-4 + wave, "status": 0}


def test_dataset_of_a_scene():
    records = {1200.0: record_of(12), 900.5: record_of(12)}
    dataset = signals_dataset(records, {1200.0: "1B/5"}, {"root": PLACE}, [90.0, 10.0], TIP)
    assert dict(dataset.sizes) == {"speed": 2, "tip_point": 2, "turn": 600, "gauge": 1, "axis": 3, "probe": 2, "revolution": 12}
    assert list(dataset["interaction"].values) == ["1B/5", ""]
    assert float(dataset["speed_rpm"].sel(speed=1200.0)) == pytest.approx(11459.16, abs=0.01)
    # what the arrival tells is the motion at that time
    run = dataset.sel(speed=900.5, tip_point="trailing_edge", probe=10.0)
    when = 900.5 * run["arrival_time"] / (2.0 * np.pi)
    told = 1e-3 * np.sin(2.0 * np.pi * 4.0 * when)
    np.testing.assert_allclose(run["arrival_displacement"][1:-1], told[1:-1], atol=1e-6)
    assert {variable.attrs["units"] for variable in dataset.data_vars.values()} == {"m", "1", "s", "N", "degree"}
    # the rotor turns towards negative theta; the leading edge begins at 0
    np.testing.assert_allclose(run["casing_angle"][[0, 24, 49]], [352.8, 180.0, 0.0], atol=1e-3)
    # what was not asked for is left out
    bare = signals_dataset({1000.0: record_of(3, gauges=0)}, {}, {}, [], TIP)
    assert set(bare.data_vars) == {"normal", "tangential", "contact_force", "clearance", "casing_angle", "status"}
    assert dict(signals_dataset({}, {}, {"root": PLACE}, [10.0], TIP).sizes) == {"speed": 0}
