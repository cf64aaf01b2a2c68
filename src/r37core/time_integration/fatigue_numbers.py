"""Fatigue of a run at one speed: what its file keeps, so that a share of any strengths is read off without another run."""

import numpy as np
from numpy import ndarray

from r37core.rom.rotation import rotation_amplitudes
from r37core.stress.operator import StressOperator, StressOperators, judged_operator
from r37core.stress.revolutions import largest_cycles, stress_cycles

from .finished_run import FinishedRun
from .problem import Problem


def fatigue_numbers(run: FinishedRun, stress: StressOperators, shown: int) -> dict[str, ndarray]:
    """Alternating stress (Pa) of all revolutions, about the mean of those in the statistic; rotation is always in the mean.

    `alternating_stress` and `mean_stress`, shape (nodes,): of one blade, that at the place `shown`, in the region that
    decides, the former the largest of all revolutions. `cycle_alternating`, `cycle_mean`, shape (pairs,), region by region, and
    `cycle_counts`, shape (regions, revolutions): those of all blades, see largest_cycles. A diverged run has NaN and no pairs.
    """
    judged = judged_operator(stress)
    if run.first_diverged is not None:
        alternating_stress = mean_stress = np.full(judged.operator.shape[1], np.nan, dtype=np.float32)
        nothing = np.empty(0, dtype=np.float32)
        pairs = len(stress) * [(nothing, nothing, np.empty(0, dtype=np.int32))]
    else:
        pairs = []
        motions = [(problem, part.snapshots) for problem, part in zip(run.problems, run.records, strict=True)]
        for operator in stress.values():
            blades = [_cycles(*motion, operator) for motion in motions]
            if operator is judged:
                alternating_stress, mean_stress = blades[shown][0].max(axis=0), blades[shown][1]
            alternating, mean = (np.concatenate(parts, axis=-1) for parts in zip(*blades, strict=True))
            pairs.append(largest_cycles(alternating, mean))
    every_alternating, every_mean, counts = zip(*pairs, strict=True)
    return {
        "alternating_stress": alternating_stress,
        "mean_stress": mean_stress,
        "cycle_alternating": np.concatenate(every_alternating),
        "cycle_mean": np.concatenate(every_mean),
        "cycle_counts": np.stack(counts),
    }


def _cycles(problem: Problem, snapshots: ndarray, stress: StressOperator) -> tuple[ndarray, ndarray]:
    """Stress of one blade in all revolutions with snapshots, of which the last ones are those of the statistic."""
    choice, model = problem.choice, problem.model
    shapes = model.to_reduced @ problem.contact.state_shapes
    rotation = rotation_amplitudes(model.rotation_stiffening, problem.speed)
    return stress_cycles(stress, snapshots, shapes, rotation, choice.snapshots_per_revolution, choice.revolutions_in_statistic)
