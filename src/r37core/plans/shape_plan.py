"""The plan of the shapes: of which blades and scenes, from what."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from . import paths
from .sweep_plan import Sweep


@dataclass(frozen=True)
class Shapes:
    """Plan of the shapes that scenes ask for. Methods with `wildcards` are inputs and parameters of rules."""

    sweep: Sweep

    @property
    def runs(self) -> list[tuple[str, str]]:
        """Pairs of blade and scene whose interactions are shown."""
        return self.sweep.runs_with("shapes")

    @property
    def outputs(self) -> list[str]:
        """A page and a picture of the modes for each blade, a picture for each of its scenes; nothing where none asks."""
        blades = dict.fromkeys(blade for blade, _ in self.runs)
        of_blades = [paths.fill(name, blade=blade) for blade in blades for name in (paths.SHAPES_PAGE, paths.MODES_FIGURE)]
        return of_blades + [paths.fill(paths.WORST_FIGURE, blade=blade, scene=scene) for blade, scene in self.runs]

    def scenes(self, wildcards: Any) -> list[str]:
        """Scenes of a blade that are shown."""
        return [scene for blade, scene in self.runs if blade == wildcards.blade]

    def folders(self, wildcards: Any) -> list[str]:
        """Modes of a blade, then the interactions in each of its scenes."""
        of_scenes = [paths.fill(paths.WORST_SHAPES, blade=wildcards.blade, scene=scene) for scene in self.scenes(wildcards)]
        return [paths.fill(paths.MODE_SHAPES, blade=wildcards.blade), *of_scenes]
