"""Cycles of the stress in a run-up: counted by hand, and summed by Miner's rule."""

from dataclasses import replace

import numpy as np
import pytest
from box_operator import box_operator
from defaults import IntegrationChoice
from integration_cases import NARROW

from r37core.rom.reduced_model import contact_model
from r37core.rom.rotation import rotation_amplitudes
from r37core.run_ups.choice import RunUp
from r37core.run_ups.integration import RunUpIntegration
from r37core.run_ups.revolutions import record_run_up
from r37core.stress.cycles import StressCycles, rainflow_cycles
from r37core.stress.damage import largest_damage
from r37core.stress.operator import StressOperator
from r37core.stress.statistic import Strengths
from r37core.time_integration.integrators import EXACT_MODAL

STEEL = Strengths(4e8, 1e9, cycles=1e6, exponent=5.0)


def test_the_example_of_the_standard():
    """ASTM E1049-85, figure 6: ranges 3, 4, 6, 8, 9, with points between the turning points that count for nothing."""
    series = np.array([-2.0, 1.0, -1.0, -3.0, 0.0, 5.0, -1.0, 3.0, 3.0, -4.0, 4.0, 1.0, -2.0])
    found = rainflow_cycles(series)
    counted = {}
    for amplitude, count in zip(found.amplitude, found.count, strict=True):
        counted[2.0 * amplitude] = counted.get(2.0 * amplitude, 0.0) + count
    assert counted == {3.0: 0.5, 4.0: 1.5, 6.0: 0.5, 8.0: 1.0, 9.0: 0.5}


def test_a_harmonic_stress_about_a_mean():
    """A hundred cycles of 300 MPa about 250 MPa: an amplitude of 300/(1 - 250/1000) = 400 MPa, which is endured 1e6 times."""
    time = np.linspace(0.0, 100.0, 6401)
    cycles = rainflow_cycles(250e6 + 300e6 * np.cos(2.0 * np.pi * time))
    assert cycles.count.sum() == pytest.approx(100.0)
    assert STEEL.miner_sum(cycles) == pytest.approx(1e-4, rel=1e-3)
    doubled = StressCycles(2.0 * cycles.amplitude, cycles.mean, cycles.count)
    assert STEEL.miner_sum(doubled) == pytest.approx(32e-4, rel=1e-3)
    # compression does not help
    below = StressCycles(cycles.amplitude, -cycles.mean, cycles.count)
    assert STEEL.miner_sum(below) == pytest.approx(1e-4 * 0.75**5, rel=1e-3)


def test_damage_without_a_line_and_beyond_the_strength():
    cycles = StressCycles(np.array([1e8]), np.array([1e9]), np.array([1.0]))
    assert np.isnan(Strengths(4e8, 1e9).miner_sum(cycles))
    assert STEEL.miner_sum(cycles) == np.inf
    assert STEEL.miner_sum(rainflow_cycles(np.full(9, 1e8))) == 0.0


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
