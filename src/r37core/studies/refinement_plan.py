"""The plan of the study `refinement`: every speed of the grids that the sweep refines itself on."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from r37core.config import ConfigError, Settings
from r37core.plans import paths

_STEPS = (5.0, 8.0, 20.0)
"""Plain grids (rad/s) beside: as many runs as a fifth of every 1 rad/s, and those of two fidelity levels."""

_COMPARED = ("spectrum", "stress", "wear")
"""Results of a scene by which interactions are told."""


@dataclass(frozen=True)
class Refinement:
    """Plan of the study. Methods with `wildcards` are inputs and parameters of rules."""

    settings: Settings

    @property
    def runs(self) -> list[tuple[str, str]]:
        """Pairs of blade and scene whose speeds refine themselves."""
        return [place for place, plan in self.settings.speed_plans.items() if plan.refined]

    def campaigns(self, wildcards: Any) -> list[str]:
        """Every speed of each of them; ConfigError if there are none."""
        if not self.runs:
            raise ConfigError("config.yaml: speeds: found no range with refine_to; allowed: at least one, for this study")
        return [paths.fill(paths.CAMPAIGN, blade=blade, scene=scene) for blade, scene in self.runs]

    @property
    def plans(self) -> list[dict[str, Any]]:
        """Speeds of each run, as plain values."""
        return [asdict(self.settings.speed_plans[place]) for place in self.runs]

    @property
    def steps(self) -> list[float]:
        """Steps (rad/s) of the plain grids that are part of the whole ones."""
        finest = [grid.interval for place in self.runs for grid in self.settings.speed_plans[place].refined]
        return [step for step in _STEPS if all(abs(step / one - round(step / one)) < 1e-9 and step >= one for one in finest)]

    def every_speed(self, wildcards: Any) -> list[float]:
        """Every speed (rad/s) of the grids of one blade and scene."""
        return self.settings.speed_plans[wildcards.blade, wildcards.scene].every_speed()

    def results(self, wildcards: Any) -> list[str]:
        """What the comparison reads of the results of a blade and scene."""
        return [kind for kind in self.settings.results_of(wildcards.blade, wildcards.scene) if kind in _COMPARED]
