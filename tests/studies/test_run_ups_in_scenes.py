"""Run-ups in scenes with a clearance that follows the speed, an elastic casing and fatigue."""

from dataclasses import replace

import netCDF4
import numpy as np
import pytest
from box_operator import box_operator
from defaults import Casing, IntegrationChoice, Scene
from integration_cases import NARROW
from integration_runs import ENGINES, assert_close, whole_run
from reference_run_up import RUN_UPS
from test_clearance import KEPT, SHORT, growing, moved, random_blade, static_displacement
from test_clearance import NARROW as SMALL_BARS
from test_elastic_casing import CHOICE, ELASTIC_SCENES
from test_elastic_casing import random_blade as random_elastic_blade
from test_fatigue import STEEL

from r37core.fem.stress import recovered_stress
from r37core.results.response import write_response
from r37core.rom.reduced_model import contact_model
from r37core.rom.rotation import rotation_amplitudes
from r37core.stress.cycles import rainflow_cycles
from r37core.stress.operator import StressOperator, von_mises
from r37core.time_integration.clearance import NoRoomError, clearances
from r37core.time_integration.integrators import EXACT_MODAL
from r37core.time_integration.speed_file import write_speed
from r37core.time_integration.speed_run import run_speed
from r37studies import run_up_revolutions as revolutions
from r37studies.cycle_damage import largest_damage
from r37studies.run_up_integration import RunUpIntegration
from r37studies.run_up_revolutions import record_run_up
from r37studies.run_up_schedule import RunUp

LONG = IntegrationChoice(3.2e-6, 4, 62, integrator=EXACT_MODAL)
BARE = replace(NARROW, lining=None)
FINE = replace(CHOICE, revolutions=3, time_step=5e-7, samples_per_revolution=31)


def samples_of(integration):
    return np.concatenate([stage.samples for stage in integration.segments()])


@pytest.mark.slow
@pytest.mark.parametrize(
    ("case", "scene", "choice", "speed"),
    [
        (None, NARROW, replace(LONG, revolutions=6), 1600.0),
        (moved(3), growing(SMALL_BARS), replace(SHORT, time_step=2e-6), 1000.0),
        (random_elastic_blade(), ELASTIC_SCENES["abradable"], replace(CHOICE, revolutions=3), 3000.0),
    ],
    ids=["rigid", "growing", "elastic"],
)
@pytest.mark.parametrize("engine", ENGINES)
def test_at_one_speed_a_run_up_is_the_run_at_that_speed(contact, engine, case, scene, choice, speed):
    _, _, record = whole_run(case or contact, speed, scene, choice, engine=engine)
    run_up = RunUp(speed, speed, 1.0, choice.revolutions - 1, 0, worn=False)
    np.testing.assert_array_equal(samples_of(RUN_UPS[engine](case or contact, scene, choice, run_up)), record.samples)


def test_the_clearance_follows_the_speed():
    """A blade that nothing but its growth brings to the round lining begins to press it at the speed that closes the gap."""
    model = replace(random_blade(1), rotation_shapes=np.array([[[1e-10]], [[0.0]], [[0.0]]]), tip_cone_angle=0.0)
    scene = growing(SMALL_BARS, clearance=1.21e-4, lobes=0)
    choice, run_up = replace(SHORT, time_step=2e-6), RunUp(1000.0, 1200.0, 20.0, 1, 1, worn=False)
    integration = RunUpIntegration(model, scene, choice, run_up)
    touching = np.concatenate([stage.speeds[stage.wear > 0.0] for stage in integration.segments()])
    assert touching.min() == pytest.approx(1100.0, abs=2.0)
    with pytest.raises(NoRoomError, match="at 1200 rad/s"):
        RunUpIntegration(model, replace(scene, lining=None), choice, run_up)


def test_responses_have_the_clearance_and_the_stress_of_rotation(whole, steel, tmp_path):
    """A blade that touches nothing has the stress of rotation, in its response and in every revolution of a run-up."""
    contact, scene = contact_model(whole, "pressure_edge"), growing(Scene(Casing(1e-3, lobes=0)))
    choice = replace(SHORT, time_step=1e-6, snapshots_per_revolution=31, snapshot_revolutions=1)
    results, speeds, recovery = ["stress", "static_stress"], (1000.0, 1500.0), box_operator(whole, steel)
    files = [tmp_path / f"{speed:g}.npz" for speed in speeds]
    for speed, file in zip(speeds, files, strict=True):
        write_speed(run_speed(contact, speed, scene, choice, results, **KEPT, stress={"box": recovery}), file, {})
    write_response(files, speeds, tmp_path / "response.nc", stress_history_speeds=(), yield_stress=1e9, provenance={})
    with netCDF4.Dataset(tmp_path / "response.nc") as response:
        assert response["static_stress"][...] == 1.0
        assert response["clearance"].dimensions == ("speed", "contact_node")
        np.testing.assert_allclose(response["clearance"][:], clearances(contact, scene, np.array(speeds)))
        largest = response["max_von_mises_last_revolution"][:, 0]
    box, still = whole.stress_regions["box"], [static_displacement(whole, speed) for speed in speeds]
    tensors = [recovered_stress(box.elements, box.nodes.points, each, steel, False) for each in still]
    np.testing.assert_allclose(largest, [von_mises(each).max() for each in tensors], rtol=1e-6)
    run_up, choice = RunUp(1000.0, 1500.0, 5.0, 1, 1, worn=False), replace(choice, revolutions=1)
    integration = RunUpIntegration(contact, scene, choice, run_up)
    kept = record_run_up(integration, results, highest_order=5, stress=recovery, yield_stress=1e9)
    np.testing.assert_allclose(kept["max_von_mises"][[0, -1]], largest, rtol=1e-6)
    assert np.all(np.diff(kept["max_von_mises"]) >= 0.0)


def test_a_run_up_leaves_no_instant_out_that_has_the_largest_stress(whole, steel, monkeypatch):
    """Of rotation and vibration together: what bounds the stress of an instant must hold both. In lots, several here."""
    monkeypatch.setattr(revolutions, "_INSTANTS_AT_ONCE", 3)
    contact, run_up = contact_model(whole, "pressure_edge"), RunUp(1490.0, 1500.0, 1.0, 2, 0, worn=False)
    choice = replace(SHORT, time_step=3.2e-6, revolutions=2, snapshots_per_revolution=31, snapshot_revolutions=2)
    found = []
    recovery, shipped = box_operator(whole, steel), revolutions.largest_stress

    def of_all(_recovery, coordinates, _bound):
        return np.array([recovery.max_von_mises(one).max() for one in coordinates])

    for largest in (shipped, of_all):
        monkeypatch.setattr(revolutions, "largest_stress", largest)
        integration = RunUpIntegration(contact, growing(SMALL_BARS), choice, run_up)
        kept = record_run_up(integration, ["stress", "static_stress"], highest_order=5, stress=recovery, yield_stress=1e9)
        found.append(kept["max_von_mises"])
    np.testing.assert_allclose(*found, rtol=1e-10)


@pytest.mark.parametrize(
    ("case", "scene", "choice", "ends", "intervals", "segments"),
    [
        (None, NARROW, LONG, (1600.0, 1650.0), 2, 10),
        (None, BARE, replace(LONG, time_step=8e-7), (1600.0, 1650.0), 2, 10),
        (None, NARROW, LONG, (5000.0, 6000.0), 6, 1),
        *((random_elastic_blade(), ELASTIC_SCENES[name], FINE, (3000.0, 3300.0), 1, 10) for name in ("abradable", "direct")),
    ],
    ids=["abradable", "direct", "many modes", "elastic abradable", "elastic direct"],
)
def test_a_run_up_is_that_of_the_reference_and_keeps_its_balance(contact, case, scene, choice, ends, intervals, segments):
    """Energy closes with the work of the changing stiffness."""
    run_up, found = RunUp(*ends, 1.3, before=1, after=0, worn=False), []
    for run_up_class in RUN_UPS.values():
        integration = run_up_class(case or contact, scene, choice, run_up)
        found.append(samples_of(integration))
        work, loss = integration.balance["contact_work"], integration.balance["damping_loss"]
        missing = integration.balance["energy_change"] - integration.stiffness_work - work + loss
        assert loss > 0.0 and work != 0.0 and (case or abs(integration.stiffness_work) > 1e-6 * abs(work))
        assert abs(missing) < 1e-9 * (abs(work) + loss)
    assert len(integration.intervals) >= intervals
    assert max(len(interval.samples) for interval in integration.intervals) >= segments
    assert_close(*found, 1e-10)


def test_the_node_with_the_largest_damage_is_found():
    """One of fifty: it neither has the largest range nor the largest mean, but both are large."""
    generator, count = np.random.default_rng(1), 50
    operator = np.zeros((6, count, 3))
    operator[0, :, 0], operator[0, :, 1] = generator.uniform(0.5, 1.0, count), generator.uniform(0.0, 1.0, count)
    time = np.linspace(0.0, 20.0, 2001)
    numbers = np.stack([2e8 * np.sin(2.0 * np.pi * time), np.full_like(time, 5e8), 0.0 * time], axis=1)
    largest, damage = largest_damage(StressOperator(operator, 2, ""), numbers.astype(np.float32), STEEL)
    amplitude = 2e8 * operator[0, :, 0] / (1.0 - 0.5 * operator[0, :, 1])
    assert damage == pytest.approx(20.0 / 1e6 * float(np.max(amplitude / 4e8) ** 5), rel=3e-2)
    assert largest == pytest.approx(4e8 * operator[0, :, 0].max(), rel=1e-3)
    assert np.argmax(amplitude) not in (np.argmax(operator[0, :, 0]), np.argmax(operator[0, :, 1]))


@pytest.fixture(scope="module")
def run_up(model):
    more = {"integrator": EXACT_MODAL, "snapshots_per_revolution": 31, "snapshot_revolutions": 2}
    choice, rising = IntegrationChoice(3.2e-6, 2, 62, **more), RunUp(1490.0, 1500.0, 6.0, 2, 0, worn=False)
    return lambda scene=NARROW: RunUpIntegration(contact_model(model, "pressure_edge"), scene, choice, rising)


def test_a_run_up_of_a_blade(run_up, model, steel):
    """Every node counted by a second way, from components of the stress, has no more damage."""
    stress, integration = box_operator(model, steel), run_up()
    found = record_run_up(integration, ["stress", "fatigue"], highest_order=5, stress=stress, yield_stress=1e9, strengths=STEEL)
    again, parts = run_up(), []
    for part in again.segments():
        still = np.array([rotation_amplitudes(again.model.rotation_stiffening, speed) for speed in part.snapshot_speeds])
        parts.append(np.hstack([part.snapshots @ (again.model.to_reduced @ part.shapes).T, still]))
    components = np.einsum("cnj,tj->tnc", stress.operator, np.concatenate(parts)[2 * 31 :])
    damage, ranges = [], []
    for node in components.transpose(1, 0, 2):
        trace = node[:, :3].sum(axis=1)
        deviator = np.hstack([node[:, :3] - trace[:, None] / 3.0, np.sqrt(2.0) * node[:, 3:]])
        path = np.sqrt(1.5) * (deviator - deviator.mean(axis=0))
        along = path @ np.linalg.svd(path, full_matrices=False)[2][0]
        ranges.append(np.ptp(along))
        damage.append(STEEL.miner_sum(rainflow_cycles(along, trace)))
    assert found["largest_stress_range"] == pytest.approx(max(ranges), rel=1e-4)
    assert found["miner_sum"] == pytest.approx(max(damage), rel=1e-3)
    assert found["miner_sum"] > 0.0


def test_a_run_up_that_diverges_has_used_up_the_life(run_up, model, steel):
    integration = run_up(replace(NARROW, divergence_limit=1e-4))
    named = {"highest_order": 5, "stress": box_operator(model, steel), "yield_stress": 1e9}
    assert record_run_up(integration, ["stress", "fatigue"], **named, strengths=STEEL)["miner_sum"] == np.inf
