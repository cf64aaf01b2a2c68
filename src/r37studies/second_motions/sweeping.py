"""Sweeps through the speeds with the state carried on from each to the next, and the runs from rest beside them."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property, partial
from pathlib import Path
from types import MappingProxyType

import numpy as np

from r37core.sweep.parts import Parts
from r37core.time_integration.carrying import CarriedMotion
from r37core.time_integration.finished_run import FinishedRun
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.simulate import Simulation
from r37studies.blade_runs import BladeRuns

from .choice import DOWN, REST, SweepChoice


@dataclass(frozen=True, eq=False, kw_only=True)
class CarriedSweep(BladeRuns):
    """A sweep of one `motion` (MOTIONS) of a blade in a scene; the `choice` is that of the scene's runs."""

    sweep: SweepChoice
    motion: str

    @property
    def speeds(self) -> list[float]:
        """Speeds (rad/s) in the order of the sweep."""
        return self.sweep.speeds[::-1] if self.motion == DOWN else self.sweep.speeds

    def run(self, folder: Path, made_of: object = None, finished: Mapping[float, Path] = MappingProxyType({})) -> list[Path]:
        """Run all speeds; returns the file of each, in the order of the speeds.

        A sweep that was interrupted goes on from its files in the `folder`. `made_of`: all that they follow from. `finished`:
        files of runs from rest that are there, by speed (rad/s).
        """
        parts = Parts(folder, made_of)
        if self.motion != REST:
            return parts.carried(self.speeds, None, self.run_on)
        as_swept = partial(self.numbers_at, self.scene, self.choice)
        return [finished.get(speed) or parts.file(speed, None, partial(as_swept, speed)) for speed in self.speeds]

    def run_on(self, speed: float, carried: CarriedMotion | None) -> dict[str, np.ndarray]:
        """Numbers of the revolutions at a speed (rad/s) from a motion on, in a casing with full-grown lobes.

        Without a motion the blade starts from rest and does first the run of the pipeline.
        """
        if carried is None:
            whole_run = replace(self.carried_choice, revolutions=self.choice.revolutions)
            before = Simulation(self.model, speed, self.scene, whole_run).run()
            if before.first_diverged is None:
                carried = CarriedMotion.ended(before.problem, before.states[0], keep_wear=self.sweep.worn)
        return self.numbers_at(self.scene.grown, self.carried_choice, speed, carried)

    @cached_property
    def carried_choice(self) -> IntegrationChoice:
        """Time integration of a speed to which the motion is carried: as from rest, or of so many revolutions as are given."""
        choice, revolutions = self.stepped_up_to(self.sweep.speeds[-1], self.choice), self.sweep.revolutions
        return (replace(choice, revolutions=revolutions, until_settled=False) if revolutions else choice).recorded

    def numbers(self, run: FinishedRun) -> dict[str, np.ndarray]:
        """Numbers of a run, with the wear that is carried on."""
        numbers = super().numbers(run)
        return numbers | CarriedMotion.ended(run.problem, run.states[0], keep_wear=True).arrays if self.sweep.worn else numbers
