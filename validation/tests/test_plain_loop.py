"""The plain loop is a third witness of the time integration, next to the compiled engine and the reference."""

from dataclasses import replace

import numpy as np
import pytest
from defaults import IntegrationChoice, Lining
from evidence.plain_loop import loop_of, march, room_of
from integration_cases import DIRECT

from r37core.time_integration.integrators import EXACT_MODAL
from r37core.time_integration.simulate import Simulation

LINING = Lining(5e-3, 20e9, 5e9, 1.5, bar_width=1e-3)


@pytest.mark.parametrize("lining", [None, LINING], ids=["bare", "lined"])
def test_a_plain_loop_does_the_same_steps(contact, lining):
    """As Python: samples but for rounding, wear, and to the step the time in contact and the jumps."""
    scene = replace(DIRECT, lining=lining, casing=replace(DIRECT.casing, rise_fraction=0.3))
    simulation = Simulation(contact, 1340.0, scene, IntegrationChoice(6.4e-6, 4, 62, integrator=EXACT_MODAL))
    state = simulation.start()
    expected = simulation.advance(state, 4).samples
    samples, wear = room_of(simulation.problem, 4)
    counts = march(loop_of(simulation.problem), samples, wear)
    np.testing.assert_allclose(samples, expected, rtol=0.0, atol=1e-12 * np.abs(expected).max())
    assert counts == (state.totals["steps_in_contact"], state.totals["steps_jumped"]) and min(counts) > 200
    if state.wear is not None:
        np.testing.assert_allclose(wear, state.wear, rtol=0.0, atol=1e-11 * state.wear.max())
        assert state.wear.max() > 1e-5
