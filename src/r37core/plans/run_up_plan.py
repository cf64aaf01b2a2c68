"""The plan of the run-ups: of which blades and scenes, from what."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from r37core.plain import to_plain
from r37core.run_ups.choice import RunUpChoice

from . import paths
from .sweep_plan import Sweep


@dataclass(frozen=True)
class RunUps:
    """Plan of the run-ups that the configuration asks for. Methods with `wildcards` are inputs and parameters of rules."""

    sweep: Sweep

    @property
    def files(self) -> paths.Wildcards:
        """Wildcards of the files of all run-ups: blade, scene and name."""
        return [{"blade": blade, "scene": scene, "run_up": name} for blade, scene, name in self.runs]

    @property
    def pairs(self) -> list[tuple[str, str]]:
        """Pairs of blade and scene with run-ups."""
        return [pair for pair, named in self.sweep.settings.run_ups.items() if named]

    @property
    def names(self) -> list[str]:
        """Names of all run-ups."""
        return list(self.sweep.settings.config.run_ups)

    @property
    def runs(self) -> list[tuple[str, str, str]]:
        """Blade, scene and name of each, in the order of the dataset."""
        return [(*pair, name) for pair, named in self.sweep.settings.run_ups.items() for name in named]

    def inputs(self, wildcards: Any) -> dict[str, str]:
        """What a run-up starts from, with the stress operator where its stress is wanted."""
        prepared = paths.fill(paths.INTEGRATION_STAMP, blade=wildcards.blade, scene=wildcards.scene)
        found = {"prepared": prepared, "model": self.sweep.contact_model(wildcards)}
        if self.sweep.with_stress(wildcards):
            (found["stress"],) = self.sweep.stress_operator(wildcards)
        if self._choice(wildcards).crossing:
            found["campbell"] = paths.fill(paths.CAMPBELL, blade=wildcards.blade)
        return found

    def run_up(self, wildcards: Any) -> dict[str, Any]:
        """Speeds and revolutions, as plain values."""
        return to_plain(self._choice(wildcards))

    def _choice(self, wildcards: Any) -> RunUpChoice:
        return self.sweep.settings.run_ups[wildcards.blade, wildcards.scene][wildcards.run_up]

    def choice(self, wildcards: Any) -> dict[str, Any]:
        """Numbers of the time integration."""
        return to_plain(self.sweep.settings.run_up_choice(wildcards.blade, wildcards.scene, wildcards.run_up))

    def results(self, wildcards: Any) -> list[str]:
        """What is wanted of the scene."""
        return list(self.sweep.results(wildcards))
