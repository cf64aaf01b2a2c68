"""Fatigue of a run at one speed: what its file keeps, so that a share of any strengths is read off without another run."""

import numpy as np

from r37core.rom.rotation import rotation_amplitudes
from r37core.stress.operator import StressOperator
from r37core.stress.revolutions import largest_cycles, stress_cycles

from .finished_run import FinishedRun
from .problem import Problem


def fatigue_numbers(run: FinishedRun, stress: StressOperator, shown: int) -> dict[str, np.ndarray]:
    """Alternating and mean stress (Pa) over the revolutions of the statistic; rotation is always in the mean.

    `alternating_stress` and `mean_stress`, shape (nodes,): of one blade, that at the place `shown`, the former the largest of
    all revolutions. `cycle_alternating`, `cycle_mean`, shape (pairs,), and `cycle_counts`, shape (revolutions,): those of all
    blades, see largest_cycles. A diverged run has NaN and no pairs.
    """
    if run.first_diverged is not None:
        alternating_stress = mean_stress = np.full(stress.operator.shape[1], np.nan, dtype=np.float32)
        alternating, mean = np.empty((0, 0), dtype=np.float32), np.empty(0, dtype=np.float32)
    else:
        blades = [_cycles(problem, part.snapshots, stress) for problem, part in zip(run.problems, run.records, strict=True)]
        alternating_stress, mean_stress = blades[shown][0].max(axis=0), blades[shown][1]
        alternating, mean = (np.concatenate(parts, axis=-1) for parts in zip(*blades, strict=True))
    pairs = zip(("cycle_alternating", "cycle_mean", "cycle_counts"), largest_cycles(alternating, mean), strict=True)
    return {"alternating_stress": alternating_stress, "mean_stress": mean_stress, **dict(pairs)}


def _cycles(problem: Problem, snapshots: np.ndarray, stress: StressOperator) -> tuple[np.ndarray, np.ndarray]:
    """Stress of one blade in the revolutions of the statistic, the last of its snapshots."""
    choice, model = problem.choice, problem.model
    states = snapshots[-choice.revolutions_in_statistic * choice.snapshots_per_revolution :]
    shapes = model.to_reduced @ problem.contact.state_shapes
    rotation = rotation_amplitudes(model.rotation_stiffening, problem.speed)
    return stress_cycles(stress, states, shapes, rotation, choice.snapshots_per_revolution)
