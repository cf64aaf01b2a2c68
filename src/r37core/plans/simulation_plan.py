"""The plan of one simulation: its scene, the numbers of its time integration, and what its file keeps."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

from r37core.plain import to_plain
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.speed_run import OF_RUNS

from .sweep_plan import Sweep


@dataclass(frozen=True)
class Simulations:
    """Parameters of each simulation of a sweep; methods with `wildcards` as of Sweep."""

    sweep: Sweep

    def task(self, wildcards: Any) -> str:
        """What one simulation does, as JSON text."""
        integration = self.sweep.settings.fidelity.time_integration
        task = {
            "scene": self.plain_scene(wildcards),
            "choice": to_plain(self._choice(wildcards, float(wildcards.speed))),
            "results": [result for result in self.sweep.results(wildcards) if result in OF_RUNS],
            "kept": {key: getattr(integration, key) for key in ("spectrum_highest_order", "wear_angles")},
        }
        return json.dumps(task)

    def _choice(self, wildcards: Any, speed: float) -> IntegrationChoice:
        """Numbers of the time integration at a speed (rad/s)."""
        history_speeds = self.sweep.samples.sample(wildcards).history_speeds
        return self.sweep.settings.integration_choice(wildcards.blade, wildcards.scene, speed, history_speeds)

    def choice_of_scene(self, wildcards: Any) -> dict[str, Any]:
        """Numbers of the time integration at the highest speed of the basis."""
        return to_plain(self._choice(wildcards, self.sweep.settings.structure.maximum_speed_rad_s))

    def plain_scene(self, wildcards: Any) -> dict[str, Any]:
        """The scene: what the blade meets."""
        return to_plain(self.sweep.samples.member(wildcards).scene)

    def priority(self, wildcards: Any) -> float:
        """Of a blade's simulations, above 0 and up to 1: results should be complete one blade after another."""
        blades = list(self.sweep.settings.blades)
        return 1 - blades.index(wildcards.blade) / len(blades)
