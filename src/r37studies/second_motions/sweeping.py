"""Sweeps through the speeds with the state carried on from each to the next, and the runs from rest beside them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from r37core.contact.scene import Scene
from r37core.rom.contact_model import ContactModel
from r37core.stress.operator import StressOperators
from r37core.sweep.parts import Parts
from r37core.time_integration.carrying import CarriedMotion, resolved_problem
from r37core.time_integration.finished_run import FinishedRun
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.speed_run import numbers_of_run

from .choice import DOWN, REST, UP, SweepChoice


@dataclass(frozen=True, eq=False)
class CarriedSweep:
    """A sweep of one `motion` (MOTIONS) of a blade's `model` in a `scene`.

    `choice`: the time integration of the scene's runs; `results` and `kept`: as run_speed takes them; `stress`: operators,
    where stress is among the results.
    """

    model: ContactModel
    scene: Scene
    choice: IntegrationChoice
    sweep: SweepChoice
    motion: str = UP
    results: Sequence[str] = ()
    kept: Mapping[str, Any] = field(default_factory=dict)
    stress: StressOperators | None = None

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
        return [finished.get(speed) or parts.file(speed, None, partial(self._rest_numbers, speed)) for speed in self.speeds]

    def _rest_numbers(self, speed: float) -> dict[str, np.ndarray]:
        """Numbers of a run as the sweep of the pipeline has it, with lobes that grow."""
        return self._numbers(Simulation(self.model, speed, self.scene, self.choice).run())

    def run_on(self, speed: float, carried: CarriedMotion | None) -> dict[str, np.ndarray]:
        """Numbers of the revolutions at a speed (rad/s) from a motion on, in a casing with full-grown lobes.

        Without a motion the blade starts from rest and does first the run of the pipeline.
        """
        if carried is None:
            whole_run = replace(self.carried_choice, revolutions=self.choice.revolutions)
            before = Simulation(self.model, speed, self.scene, whole_run).run()
            if before.first_diverged is None:
                carried = CarriedMotion.ended(before.problem, before.states[0], keep_wear=self.sweep.worn)
        return self._numbers(Simulation(self.model, speed, self.scene.grown, self.carried_choice).run(carried))

    @cached_property
    def carried_choice(self) -> IntegrationChoice:
        """Time integration of a speed to which the motion is carried: as from rest, or of so many revolutions as are given."""
        highest, revolutions = self.sweep.speeds[-1], self.sweep.revolutions
        step = resolved_problem(self.model, highest, self.scene, self.choice).choice.time_step
        choice = replace(self.choice, time_step=step)
        return (replace(choice, revolutions=revolutions, until_settled=False) if revolutions else choice).recorded

    @property
    def unrecorded_choice(self) -> IntegrationChoice:
        """The same, with nothing recorded but the motion."""
        return replace(self.carried_choice, snapshot_revolutions=0, snapshots_per_revolution=0)

    def _numbers(self, run: FinishedRun) -> dict[str, np.ndarray]:
        numbers = numbers_of_run(run, self.results, stress=self.stress, **self.kept)
        return numbers | CarriedMotion.ended(run.problem, run.states[0], keep_wear=True).arrays if self.sweep.worn else numbers
