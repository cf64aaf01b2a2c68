"""The plan of the study `estimate`: which runs are timed."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from r37core.config import Settings
from r37core.plans import paths
from r37core.speeds import SpeedPlan

from .sampling import sample


@dataclass(frozen=True)
class Estimate:
    """Plan of the study. Methods with `wildcards` are parameters of rules."""

    settings: Settings

    @property
    def samples(self) -> list[str]:
        """One file for each blade and scene."""
        return [paths.fill(paths.ESTIMATE_SAMPLE, blade=blade, scene=scene) for blade, scene in self.settings.speed_plans]

    def choices(self, wildcards: Any) -> dict[float, dict[str, Any]]:
        """Numbers of the time integration at some of the speeds of one blade and scene, evenly spread."""
        speeds = sample(self._plan(wildcards).certain, self.settings.studies.estimate.every)
        return {speed: asdict(self.settings.integration_choice(wildcards.blade, wildcards.scene, speed)) for speed in speeds}

    def number(self, wildcards: Any) -> int:
        """How many runs the blade and scene have in all; as a rule at most, where the speeds refine themselves."""
        return self._plan(wildcards).at_most(self.settings.refinement.largest_share)

    def _plan(self, wildcards: Any) -> SpeedPlan:
        return self.settings.speed_plans[wildcards.blade, wildcards.scene]
