"""The time signals of one run: both ends of the tip, its contact force and strain gauges, at every sample."""

from dataclasses import replace
from typing import Any

import numpy as np

from r37core.time_integration.simulate import DIRECTIONS, TIP_POINTS, Simulation
from r37core.time_integration.status import RunStatus
from r37studies.blade_runs import BladeRuns


def record_signals(blade: BladeRuns, speed: float, gauge_rows: np.ndarray, last: int) -> dict[str, Any]:
    """Simulate `speed` (rad/s) as the sweep does, and keep the signals of the `last` revolutions, NaN from a divergence on.

    `gauge_rows`, shape (gauges, coordinates): strain per unit of each reduced coordinate. Raises UnstableStepError for a step
    beyond the stability limit. Returned are, by name:

    - `turn`, shape (samples,): time in revolutions since the start
    - `normal`, `tangential`: displacement (m) of TIP_POINTS, shape (2, samples)
    - `strain`, shape (gauges, samples)
    - `contact_force` (N), shape (samples,): normal force on all contact nodes together, NaN without forces at t_n
      (IntegrationChoice.second_order)
    - `clearance` (m), shape (samples,): from the undeformed leading edge to casing or unworn lining, without a flexible
      casing's motion
    - `status`: a RunStatus
    """
    model, choice = blade.model, blade.choice
    per_revolution = choice.samples_per_revolution
    choice = replace(choice, snapshots_per_revolution=per_revolution, snapshot_revolutions=choice.revolutions)
    simulation = Simulation(model, speed, blade.scene, choice)
    # rows of what the states are kept in
    shapes = simulation.problem.contact.state_shapes
    rows = gauge_rows @ model.to_reduced @ shapes if len(gauge_rows) else np.empty((0, shapes.shape[1]))
    state, status = simulation.start(), RunStatus.COMPLETED
    tip = np.full((choice.revolutions * per_revolution, len(TIP_POINTS), len(DIRECTIONS)), np.nan)
    strain, contact_force = np.full((len(tip), len(rows)), np.nan), np.full(len(tip), np.nan)
    # one revolution after another: the states of all would be a hundred times as many numbers as the signals
    for revolution, record in enumerate(simulation.parts(state, choice.revolutions * [per_revolution])):
        good = len(record.samples) - (1 if record.diverged else 0)
        reached = slice(revolution * per_revolution, revolution * per_revolution + good)
        tip[reached] = record.samples[:good].reshape(-1, *tip.shape[1:])
        strain[reached] = record.snapshots[:good] @ rows.T
        if choice.second_order:
            # the last numbers of a snapshot are forces
            nodes = len(simulation.problem.casing.tip.theta)
            forces = record.snapshots[:good, -3 * nodes :].reshape(good, 3, nodes)
            contact_force[reached] = -forces[:, 0].sum(axis=1)
        if record.diverged:
            status = RunStatus.DIVERGED
    recorded = slice(-min(last, choice.revolutions) * per_revolution, None)
    turn = (np.arange(1, len(tip) + 1) / per_revolution)[recorded]
    return {
        "turn": turn,
        **{name: tip[recorded, :, DIRECTIONS.index(name)].T for name in ("normal", "tangential")},
        "strain": strain[recorded].T,
        "contact_force": contact_force[recorded],
        "clearance": _clearance(simulation, turn),
        "status": int(status),
    }


def _clearance(simulation: Simulation, turn: np.ndarray) -> np.ndarray:
    """Distance (m) of the undeformed leading edge from the casing at times in revolutions, shape (samples,)."""
    casing = simulation.problem.casing
    angles = casing.tip.theta[0] - 2.0 * np.pi * turn
    times = turn * 2.0 * np.pi / casing.grid.speed
    return casing.clearance[0] - casing.scene.casing.lobe(angles, times, casing.rise_time)
