"""The time signals of one run: both ends of the tip and strain gauges, at every sample."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from r37core.contact.scene import Scene
from r37core.rom.contact_model import ContactModel
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.simulate import DIRECTIONS, TIP_POINTS, Simulation
from r37core.time_integration.status import RunStatus


@dataclass(frozen=True)
class Record:
    """Signals of one run at one speed, NaN from a divergence on.

    `turn`, shape (samples,): time in revolutions since the start; `normal` and `tangential` displacement (m), shape (samples,
    2), of TIP_POINTS; `strain`, shape (samples, gauges); `status`.
    """

    turn: np.ndarray
    normal: np.ndarray
    tangential: np.ndarray
    strain: np.ndarray
    status: RunStatus


def record_signals(
    model: ContactModel, speed: float, scene: Scene, choice: IntegrationChoice, gauge_rows: np.ndarray, last: int
) -> Record:
    """Simulate `speed` (rad/s) as the sweep does, and keep the signals of the `last` revolutions.

    `gauge_rows`, shape (gauges, coordinates): strain per unit of each reduced coordinate. Raises UnstableStepError for a step
    beyond the stability limit.
    """
    per_revolution = choice.samples_per_revolution
    snapshots = per_revolution if len(gauge_rows) else 0
    choice = replace(choice, snapshots_per_revolution=snapshots, snapshot_revolutions=choice.revolutions)
    simulation = Simulation(model, speed, scene, choice)
    # rows of what the states are kept in
    shapes = simulation.problem.contact.state_shapes
    rows = gauge_rows @ model.to_reduced @ shapes if len(gauge_rows) else np.empty((0, shapes.shape[1]))
    state, status = simulation.start(), RunStatus.COMPLETED
    tip = np.full((choice.revolutions * per_revolution, len(TIP_POINTS), len(DIRECTIONS)), np.nan)
    strain = np.full((len(tip), len(rows)), np.nan)
    # one revolution after another: the states of all would be a hundred times as many numbers as the signals
    for revolution in range(choice.revolutions):
        record = simulation.advance(state, 1)
        good = len(record.samples) - (1 if record.diverged else 0)
        reached = slice(revolution * per_revolution, revolution * per_revolution + good)
        tip[reached] = record.samples[:good].reshape(-1, *tip.shape[1:])
        if len(rows):
            strain[reached] = record.snapshots[:good] @ rows.T
        if record.diverged:
            status = RunStatus.DIVERGED
            break
    recorded = slice(-min(last, choice.revolutions) * per_revolution, None)
    turn = np.arange(1, len(tip) + 1) / per_revolution
    normal, tangential = (tip[recorded, :, DIRECTIONS.index(name)] for name in ("normal", "tangential"))
    return Record(turn[recorded], normal, tangential, strain[recorded], status)


def revolutions_of(record: Record) -> Sequence[int]:
    """Numbers, from 1, of the revolutions that a record has."""
    return range(int(np.ceil(record.turn[0])), int(np.ceil(record.turn[-1])) + 1)
