"""The plan of the rounds of refinement: what each looks at, and what it decides by."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from r37core.adaptive.refinement_choice import RefinementChoice, Window
from r37core.config import in_si
from r37core.plain import to_plain

from . import paths
from .samples import folder_and_name, path_part
from .sweep_plan import KINDS, Sweep


@dataclass(frozen=True)
class Rounds:
    """Plan of the rounds that the adaptive speeds of a sweep ask for; methods with `wildcards` as of Sweep."""

    sweep: Sweep

    def first_rounds(self, wildcards: Any) -> list[str]:
        """First rounds of the runs in one dataset, of all without a kind.

        They are asked for beside the responses: a response that is there is not planned anew for a round that is not.
        """
        pairs = self.sweep.runs_with(getattr(wildcards, "kind", KINDS[0]))
        adaptive = [(blade, scene) for blade, scene in pairs if self.sweep.settings.speed_plans[blade, scene].refined]
        return [paths.fill(paths.ROUND, blade=blade, scene=scene, round=0) for blade, scene in adaptive]

    def round_inputs(self, wildcards: Any) -> dict[str, Any]:
        """What a round looks at: the Campbell diagram, or the runs that the round before it asked for, member by member."""
        number, (folder, _) = int(wildcards.round), folder_and_name(wildcards)
        if number == 0:
            diagram = self.sweep.samples.sample(wildcards).campbell
            return {"campbell": paths.fill(paths.CAMPBELL, member=diagram, blade=wildcards.blade)}
        of = {"member": path_part(folder), "blade": wildcards.blade, "scene": wildcards.scene}
        new, names = self.sweep.new_speeds(wildcards, number - 1), self.sweep.samples.sample(wildcards).deciding
        files = [file for name in names for file in paths.speed_files(path_part(folder, name), wildcards, new)]
        return {"before": paths.fill(paths.ROUND, **of, round=number - 1), "speeds": files}

    def yields_of_round(self, wildcards: Any) -> list[float]:
        """Yield stress (Pa) of the blade of each member whose runs a round looks at."""
        sample = self.sweep.samples.sample(wildcards)
        return [sample.members[name].blade.yield_stress for name in sample.deciding]

    def refined_plan(self, wildcards: Any) -> dict[str, Any]:
        """Speeds of one blade and scene, as plain values."""
        return to_plain(self.sweep.speed_plan(wildcards))

    def refinement_choice(self, wildcards: Any) -> dict[str, Any]:
        """What makes an interval of speeds of a scene worth halving, as fields of RefinementChoice."""
        settings = self.sweep.settings
        refinement = settings.config.refinement.in_scene(settings.scenes[wildcards.scene].scene)
        windows = tuple(in_si(Window, window) for window in refinement.windows)
        share, prominence = self.sweep.samples.sample(wildcards).largest_share, settings.config.interactions.prominence
        return to_plain(in_si(RefinementChoice, refinement, windows=windows, largest_share=share, prominence=prominence))
