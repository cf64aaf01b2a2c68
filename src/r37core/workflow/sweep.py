"""The plan of the sweep: which simulations, from which files, with which numbers, and what is made of them."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from typing import Any

from r37core.config import Settings
from r37core.speeds import exact_text

from . import paths

KINDS = ("rms", "spectrum", "stress", "wear")
"""Kinds of datasets over all blades and scenes; the first of every scene, the others of those that want them."""

MAPS = ("spectrum", "wear")
"""Kinds that are drawn as maps over speed."""


@dataclass(frozen=True)
class Sweep:
    """Plan of the sweep that `settings` ask for. Methods with `wildcards` are inputs and parameters of rules."""

    settings: Settings

    def contact_model(self, wildcards: Any) -> str:
        """What the simulations of a blade and scene start from."""
        return paths.fill(paths.CONTACT_MODEL, blade=wildcards.blade, tip_line=self._scene(wildcards).tip_line)

    def speed_files(self, wildcards: Any) -> list[str]:
        """The simulations of one blade and scene, by ascending speed."""
        blade, scene = wildcards.blade, wildcards.scene
        return [paths.fill(paths.SPEED, blade=blade, scene=scene, speed=exact_text(speed)) for speed in self.speeds(wildcards)]

    def recovery(self, wildcards: Any) -> dict[str, str]:
        """The reduced model, for a scene whose stress is wanted."""
        if not self.with_stress(wildcards):
            return {}
        return {"rom": paths.fill(paths.REDUCED_MODEL, blade=wildcards.blade, tip_line=self._scene(wildcards).tip_line)}

    def speeds(self, wildcards: Any) -> tuple[float, ...]:
        """Speeds (rad/s) of one blade and scene, ascending."""
        return self.settings.speeds[wildcards.blade, wildcards.scene]

    def task(self, wildcards: Any) -> str:
        """What one simulation does, as JSON text."""
        chosen = self._scene(wildcards)
        task = {
            "scene": asdict(chosen.scene),
            "choice": asdict(self.settings.integration_choice(wildcards.blade, wildcards.scene, float(wildcards.speed))),
            "results": self.results(wildcards),
            "kept": self.kept,
        }
        return json.dumps(task)

    def choice_of_scene(self, wildcards: Any) -> dict[str, Any]:
        """Numbers of the time integration at the highest speed of the basis."""
        highest = self.settings.structure.maximum_speed_rad_s
        return asdict(self.settings.integration_choice(wildcards.blade, wildcards.scene, highest))

    def scene(self, wildcards: Any) -> Any:
        """The scene itself, which Snakemake does not compare."""
        return self._scene(wildcards).scene

    def described(self, wildcards: Any) -> str:
        """The scene as a text, which re-runs a job when it changes."""
        return repr(self._scene(wildcards).scene)

    def results(self, wildcards: Any) -> tuple[str, ...]:
        """What is wanted of the simulations of a blade and scene."""
        return self.settings.results_of(wildcards.blade, wildcards.scene)

    def with_stress(self, wildcards: Any) -> bool:
        """Whether the stress of a blade and scene is wanted."""
        return "stress" in self.results(wildcards)

    def stress_history_speeds(self, wildcards: Any) -> tuple[float, ...]:
        """Speeds (rad/s) of a blade and scene whose stress is kept for every revolution."""
        return self._scene(wildcards).stress_history_speeds if self.with_stress(wildcards) else ()

    def priority(self, wildcards: Any) -> float:
        """Of a blade's simulations, above 0 and up to 1: results should be complete one blade after another."""
        blades = list(self.settings.blades)
        return 1 - blades.index(wildcards.blade) / len(blades)

    @property
    def kept(self) -> dict[str, int]:
        """How much of a run its file keeps."""
        keys = ("spectrum_highest_order", "signal_revolutions", "wear_angles")
        return {key: getattr(self.settings.fidelity.time_integration, key) for key in keys}

    @property
    def kinds(self) -> list[str]:
        """Kinds of datasets that this run ends in."""
        return [kind for kind in KINDS if self.runs_with(kind)]

    def runs_with(self, kind: str) -> list[tuple[str, str]]:
        """Pairs of blade and scene that have this kind of result."""
        pairs = [(blade, scene) for blade in self.settings.blades for scene in self.settings.scenes]
        return [pair for pair in pairs if kind == KINDS[0] or kind in self.settings.results_of(*pair)]

    def runs(self, wildcards: Any) -> list[tuple[str, str]]:
        """Pairs of blade and scene in one dataset."""
        return self.runs_with(wildcards.kind)

    def responses(self, wildcards: Any) -> list[str]:
        """What one dataset is joined of."""
        return [paths.fill(paths.RESPONSE, blade=blade, scene=scene) for blade, scene in self.runs(wildcards)]

    @property
    def figures(self) -> list[str]:
        """Pictures of the sweep."""
        of_blades = [paths.fill(paths.RESPONSE_FIGURE, blade=blade) for blade in self.settings.blades]
        maps = [
            paths.fill(paths.MAP_FIGURE, kind=kind, blade=blade, scene=scene)
            for kind in MAPS
            for blade, scene in self.runs_with(kind)
        ]
        return ["<results>/figures/response.png", *of_blades, *maps]

    def response_pictured(self, wildcards: Any) -> dict[str, str]:
        """Datasets that a blade's response is drawn from."""
        with_stress = any(blade == wildcards.blade for blade, _ in self.runs_with("stress"))
        return {kind: f"<results>/{kind}.nc" for kind in ("campbell", "rms", *(["stress"] if with_stress else []))}

    def _scene(self, wildcards: Any) -> Any:
        return self.settings.scenes[wildcards.scene]
