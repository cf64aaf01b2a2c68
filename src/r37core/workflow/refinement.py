"""The plan of the study `refinement`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from r37core.config import Settings


@dataclass(frozen=True)
class Refinement:
    """Plan of the study. Methods with `wildcards` are parameters of rules."""

    settings: Settings

    def every_speed(self, wildcards: Any) -> list[float]:
        """Every speed (rad/s) of the grid."""
        return self.settings.speed_plans[wildcards.blade, wildcards.scene].every_speed()

    def results(self, wildcards: Any) -> list[str]:
        """What the comparison reads of a scene's results."""
        return [kind for kind in self.settings.scenes[wildcards.scene].results if kind in ("spectrum", "stress", "wear")]
