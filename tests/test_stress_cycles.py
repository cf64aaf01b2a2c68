"""Cycles of the stress in a run-up: counted by hand, and summed by Miner's rule."""

from dataclasses import replace

import numpy as np
import pytest
from box_operator import box_operator
from defaults import IntegrationChoice
from integration_cases import NARROW

from r37core.rom.reduced_model import contact_model
from r37core.rom.rotation import rotation_amplitudes
from r37core.run_ups.integration import RunUpIntegration
from r37core.run_ups.revolutions import record_run_up
from r37core.run_ups.schedule import RunUp
from r37core.stress.cycles import StressCycles, rainflow_cycles
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


def test_signs_are_those_of_the_normal_stresses():
    operator = np.zeros((6, 1, 1))
    operator[0] = 1.0
    np.testing.assert_allclose(StressOperator(operator, 1, "").signed_von_mises(np.array([[2.0], [-3.0]]))[:, 0], [2.0, -3.0])


@pytest.fixture(scope="module")
def run_up(model):
    more = {"integrator": EXACT_MODAL, "snapshots_per_revolution": 31, "snapshot_revolutions": 2}
    choice, rising = IntegrationChoice(3.2e-6, 2, 62, **more), RunUp(1490.0, 1500.0, 6.0, 2, 0, worn=False)
    return lambda scene=NARROW: RunUpIntegration(contact_model(model, "pressure_edge"), scene, choice, rising)


def test_a_run_up_of_a_blade(run_up, model, steel):
    """The node that is followed has nearly the largest range of all, of which a second way finds the same damage."""
    stress = box_operator(model, steel)
    integration = run_up()
    found = record_run_up(integration, ["stress", "fatigue"], highest_order=5, stress=stress, yield_stress=1e9, strengths=STEEL)
    again, histories = run_up(), []
    for part in again.segments():
        still = np.array([rotation_amplitudes(again.model.rotation_stiffening, speed) for speed in part.snapshot_speeds])
        states = np.hstack([part.snapshots @ (again.model.to_reduced @ part.shapes).T, still])
        histories.append(stress.signed_von_mises(states))
    history = np.concatenate(histories)[2 * 31 :]
    ranges = np.ptp(history, axis=0)
    assert 0.9 * ranges.max() <= found["largest_stress_range"] <= ranges.max() * (1.0 + 1e-6)
    node = int(np.abs(ranges - found["largest_stress_range"]).argmin())
    assert found["miner_sum"] == pytest.approx(STEEL.miner_sum(rainflow_cycles(history[:, node])), rel=1e-4)
    assert found["miner_sum"] > 0.0


def test_a_run_up_that_diverges_has_used_up_the_life(run_up, model, steel):
    integration = run_up(replace(NARROW, divergence_limit=1e-4))
    named = {"highest_order": 5, "stress": box_operator(model, steel), "yield_stress": 1e9}
    assert record_run_up(integration, ["stress", "fatigue"], **named, strengths=STEEL)["miner_sum"] == np.inf
