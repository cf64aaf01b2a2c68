"""A run that is done: what its numbers are made from."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from numpy import ndarray

from .problem import Problem
from .settling import Ending
from .state import SimulationRecord, SimulationState


@dataclass(frozen=True, eq=False, kw_only=True)
class FinishedRun:
    """A run that is done: the problem of each blade, its state at the end and its record, and how the run ended.

    `energy_change`, `contact_work` (J): of all blades together, see Simulation. `frequency_factors`: of the
    blades' frequencies. This is the run of a single blade; that of a rotor is a RotorRun.
    """

    problems: Sequence[Problem]
    states: Sequence[SimulationState]
    records: Sequence[SimulationRecord]
    ending: Ending
    energy_change: float
    contact_work: float
    frequency_factors: Sequence[float] = (1.0,)

    @property
    def problem(self) -> Problem:
        """Problem of the first blade: grid and casing are those of all."""
        return self.problems[0]

    @property
    def first_diverged(self) -> int | None:
        """Place of the blade that diverged first, None where none did; the others end within a revolution after it."""
        samples = {place: len(part.samples) for place, part in enumerate(self.records) if part.diverged}
        return min(samples, key=samples.__getitem__, default=None)

    @property
    def kept_revolutions(self) -> int:
        """Revolutions of what is kept: those done, and after an early divergence as many as the statistic has."""
        return max(self.ending.revolutions, self.problem.choice.revolutions_in_statistic)

    def leader(self, statistic: Sequence[ndarray]) -> int:
        """Place of the blade whose spectrum is kept, by the displacement (m) of each in the statistic, see numbers_of_run."""
        return 0

    def numbers_of_each(self, samples: Sequence[ndarray], history: ndarray | None) -> dict[str, Any]:
        """Numbers of each blade, none of a single one."""
        return {}
