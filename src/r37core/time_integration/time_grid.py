"""Steps, samples and snapshots of a run at constant speed."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .integration_choice import LARGEST_TABLE, IntegrationChoice


class LongRevolutionError(ValueError):
    """A revolution of so many steps that the casing's table would not fit in memory."""


@dataclass(frozen=True, eq=False)
class TimeGrid:
    """The steps of a run at `speed` (rad/s): whole ones in a sample, whole samples in a revolution."""

    speed: float
    choice: IntegrationChoice

    @cached_property
    def steps_per_sample(self) -> int:
        """So many that a step is not above the chosen one, and a revolution has whole samples; or as the choice says."""
        if self.choice.steps_per_sample is not None:
            return self.choice.steps_per_sample
        shortest = 2.0 * np.pi / self.speed / (self.choice.samples_per_revolution * self.choice.time_step)
        return int(np.ceil(shortest - 1e-9))

    @property
    def steps_per_revolution(self) -> int:
        """Whole samples of them."""
        return self.steps_per_sample * self.choice.samples_per_revolution

    @property
    def time_step(self) -> float:
        """Time step (s)."""
        return 2.0 * np.pi / self.speed / self.steps_per_revolution

    @property
    def duration(self) -> float:
        """Length (s) of the whole run, or of the published one where a run goes on until it settles."""
        return self.choice.length_of_rise_fraction * self.steps_per_revolution * self.time_step

    @property
    def samples_before_snapshots(self) -> int:
        """Samples up to the revolutions of which snapshots are kept: none where it is not known when a run settles."""
        if self.choice.until_settled:
            return 0
        return (self.choice.revolutions - self.choice.snapshot_revolutions) * self.choice.samples_per_revolution

    @property
    def samples_per_snapshot(self) -> int:
        """Samples from one snapshot to the next; 0: there are none."""
        choice = self.choice
        wanted = choice.snapshots_per_revolution > 0 and choice.snapshot_revolutions > 0
        return choice.samples_per_revolution // choice.snapshots_per_revolution if wanted else 0

    def snapshots_after(self, samples: int) -> int:
        """Number of snapshots in the first `samples` of the run."""
        every = self.samples_per_snapshot
        return max(samples - self.samples_before_snapshots, 0) // every if every else 0

    def snapshots_between(self, first: int, last: int) -> range:
        """The samples from number `first` of the run on, up to `last`, that have a snapshot, counted from the former."""
        every, before = self.samples_per_snapshot, self.samples_before_snapshots - first
        number = self.snapshots_after(first)
        return range(before + (number + 1) * every - 1, last - first, every) if every else range(0)

    def check_table(self, nodes: int) -> None:
        """Raises LongRevolutionError where the casing's shape at `nodes` nodes in every step does not fit in memory."""
        table = 8 * self.steps_per_revolution * nodes
        if table > LARGEST_TABLE:
            steps = f"{self.steps_per_revolution} steps of {self.time_step:.3g} s"
            raise LongRevolutionError(
                f"speeds: at {self.speed:g} rad/s a revolution has {steps}, "
                f"and the casing's shape at each would take {table / 2**30:.1f} GiB; use a higher speed or a longer step; "
                "where a stiff lining shortens it, a softer lining or the integrator exact_modal"
            )
