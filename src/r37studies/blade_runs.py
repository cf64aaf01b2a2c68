"""Runs of a blade in a scene, from rest or from the motion at the end of another run: of second motions and of verdicts."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Self

import numpy as np

from r37core.base.plain import from_plain
from r37core.contact.scene import Scene
from r37core.rom.contact_model import ContactModel, read_contact_model
from r37core.stress.operator import StressOperators, read_stress_operators
from r37core.time_integration.carrying import CarriedMotion, resolved_problem
from r37core.time_integration.finished_run import FinishedRun
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.speed_run import numbers_of_run


@dataclass(frozen=True, eq=False)
class BladeRuns:
    """A blade's `model` in a `scene`: time integration, `results` and `kept` as run_speed takes them.

    `stress`: operators by region, where stress is among the results.
    """

    model: ContactModel
    scene: Scene
    choice: IntegrationChoice
    results: Sequence[str] = ()
    kept: Mapping[str, Any] = field(default_factory=dict)
    stress: StressOperators | None = None

    @classmethod
    def read(cls, input: Any, params: Any, **more: Any) -> Self:
        """The runs of a step. Inputs: model, and stress where it is wanted. Params: scene, choice; results, kept if needed."""
        stress = read_stress_operators(input.stress) if hasattr(input, "stress") else None
        scene, choice = from_plain(Scene, params.scene), from_plain(IntegrationChoice, params.choice)
        results, kept = getattr(params, "results", ()), getattr(params, "kept", {})
        return cls(read_contact_model(input.model), scene, choice, results, kept, stress, **more)

    def stepped_up_to(self, speed: float, choice: IntegrationChoice) -> IntegrationChoice:
        """A choice with the scene's steps, so short that motions can be carried from speed to speed up to this one (rad/s)."""
        return replace(choice, time_step=resolved_problem(self.model, speed, self.scene, self.choice).choice.time_step)

    def numbers_at(
        self, scene: Scene, choice: IntegrationChoice, speed: float, motion: CarriedMotion | None = None
    ) -> dict[str, np.ndarray]:
        """Numbers of a run at a speed (rad/s) in another scene and with another choice; it may begin in a motion."""
        return self.numbers(Simulation(self.model, speed, scene, choice).run(motion))

    def numbers(self, run: FinishedRun) -> dict[str, np.ndarray]:
        """Numbers of a run, as run_speed has them."""
        return numbers_of_run(run, self.results, stress=self.stress, **self.kept)
