"""The plan of the sweep: simulations, rounds of refinement, and the datasets that are joined of them."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, cached_property, partial
from itertools import chain, count, takewhile
from pathlib import Path
from typing import Any

from r37core.adaptive.refinement_choice import RefinementChoice
from r37core.base.io import as_list, read_json, readable
from r37core.base.plain import to_json, to_plain
from r37core.base.speeds import SpeedPlan
from r37core.config import si_form
from r37core.contact.scene import Scene
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.speed_job import Task
from r37core.time_integration.speed_run import OF_RUNS

from . import paths
from .provenance import Attributes, sweep_provenance
from .structure_plan import Structure

KINDS = ("rms", "spectrum", "stress", "fatigue", "wear", "casing")
"""Kinds of datasets over all blades and scenes; the first of every scene, the others of those that want them."""

MOST_DRAWN = 6
"""Designs of families with figures of their own, where not all have them."""

MOST_BLADES_DRAWN = 24
"""Blades of a run that all have figures of their own."""


@dataclass(frozen=True)
class Sweep(Structure):
    """Plan of the sweep that `settings` ask for, and of the structures that it starts from.

    `round_file(blade=..., scene=..., round=...)`: file of a
    finished round of refinement; Snakemake's own exception for one that is still to be made. Without it adaptive speeds have
    no plan.
    """

    round_file: Callable[..., str] | None = None

    def provenance(self, wildcards: Any) -> Attributes:
        """Attributes of the simulations of one blade and scene, made once and not for each of thousands of jobs."""
        return self.settings.made(sweep_provenance, wildcards.blade, wildcards.scene)

    def contact_model(self, wildcards: Any) -> str:
        """Contact model that the simulations of a blade and scene start from."""
        return self._model_file(wildcards, paths.CONTACT_MODEL)

    def models(self, wildcards: Any) -> list[str]:
        """Contact model of the simulations of a blade and scene, and the operator of the stress, where that is wanted."""
        patterns = [paths.CONTACT_MODEL, *([paths.STRESS_OPERATOR] if "stress" in self.results(wildcards) else [])]
        return [self._model_file(wildcards, pattern) for pattern in patterns]

    def run_inputs(self, wildcards: Any) -> dict[str, str]:
        """Files that further runs of a blade and scene start from: prepared, model, and stress where it is wanted."""
        stamp = paths.INTEGRATION_STAMP.format(blade=wildcards.blade, scene=wildcards.scene)
        return {"prepared": stamp, **dict(zip(("model", "stress"), self.models(wildcards), strict=False))}

    def reduced_model(self, wildcards: Any) -> str:
        """The reduced model of a blade, with the contact nodes of a scene."""
        return self._model_file(wildcards, paths.REDUCED_MODEL)

    def _model_file(self, wildcards: Any, pattern: str) -> str:
        tip_line = self.settings.scenes[wildcards.scene].tip_line
        return pattern.format(blade=wildcards.blade, tip_line=tip_line)

    def speed_files(self, wildcards: Any) -> list[str]:
        """The simulations of one blade and scene, by ascending speed: of all rounds, where its speeds are adaptive."""
        plan, rounds = self.speed_plan(wildcards), map(partial(self.new_speeds, wildcards), count())
        speeds = sorted(chain.from_iterable(takewhile(bool, rounds)) if plan.refined else plan.certain)
        return paths.speed_files(wildcards, speeds)

    def new_speeds(self, wildcards: Any, number: int) -> list[float]:
        """Speeds (rad/s) that a round asked for."""
        assert self.round_file is not None
        file = self.round_file(blade=wildcards.blade, scene=wildcards.scene, round=number)
        return speeds_of_round(file, self.speed_plan(wildcards))

    def yield_stress(self, wildcards: Any) -> float:
        """Yield stress of a blade (Pa)."""
        return self.settings.blades[wildcards.blade].yield_stress

    def strengths(self, wildcards: Any) -> dict[str, float]:
        """Strengths of a blade's Goodman line (Pa), as plain values."""
        return to_plain(self.settings.blades[wildcards.blade].strengths)

    def speed_plan(self, wildcards: Any) -> SpeedPlan:
        """Speeds of one blade and scene."""
        return self.settings.speed_plans[wildcards.blade, wildcards.scene]

    def speeds(self, wildcards: Any, input: Any) -> list[float]:
        """Speeds (rad/s), ascending, of the files that are an input; a round stands there until the rounds are done."""
        files = [file for file in as_list(input.speeds) if Path(file).name.startswith("speed_")]
        return list(map(paths.speed_of, files))

    def results(self, wildcards: Any) -> tuple[str, ...]:
        """Results requested for a blade and scene."""
        return self.settings.results_of(wildcards.blade, wildcards.scene)

    def stress_history_speeds(self, wildcards: Any) -> tuple[float, ...]:
        """Speeds (rad/s) of a blade and scene whose stress is kept for every revolution."""
        return self.settings.scenes[wildcards.scene].stress_history_speeds if "stress" in self.results(wildcards) else ()

    @property
    def kinds(self) -> list[str]:
        """Kinds of datasets that this run ends in."""
        return [kind for kind in KINDS if self.runs_with(kind)]

    @cached_property
    def drawn(self) -> dict[str, list[str]]:
        """Blades and scenes with figures of their own and in figures of all, by `blade` and `scene`.

        Blades: all of them; of many those of no family and some designs. Scenes: those of no family, and some designs.
        """
        blades, scenes = list(self.settings.blades), list(self.settings.scenes)
        families, scene_families = self.settings.designs.family_of, self.settings.scene_designs.family_of
        if len(blades) > MOST_BLADES_DRAWN:
            designs = [blade for blade in blades if blade in families]
            blades = _evenly([blade for blade in blades if blade not in families], MOST_BLADES_DRAWN)
            blades += _evenly(designs, MOST_DRAWN)
        shown = _evenly([scene for scene in scenes if scene in scene_families], MOST_DRAWN)
        return {"blade": blades, "scene": [scene for scene in scenes if scene in shown or scene not in scene_families]}

    def drawn_runs(self, kind: str) -> list[tuple[str, str]]:
        """Pairs of blade and scene that have this kind of result and figures of their own."""
        drawn = self.drawn
        return [(blade, scene) for blade, scene in self.runs_with(kind) if blade in drawn["blade"] and scene in drawn["scene"]]

    def runs_with(self, kind: str) -> list[tuple[str, str]]:
        """Pairs of blade and scene that have this kind of result."""
        pairs = [(blade, scene) for blade in self.settings.blades for scene in self.settings.scenes]
        return [pair for pair in pairs if kind == KINDS[0] or kind in self.settings.results_of(*pair)]

    def task(self, wildcards: Any) -> str:
        """Parameters of one simulation, as JSON text."""
        results = tuple(result for result in self.results(wildcards) if result in OF_RUNS)
        choice = self.settings.integration_choice(wildcards.blade, wildcards.scene)
        kept = tuple(self.settings.fidelity.time_integration.kept.items())
        return _task(self.settings.scenes[wildcards.scene].scene, choice, results, kept)

    def choice_of_scene(self, wildcards: Any) -> dict[str, Any]:
        """Numbers of the time integration."""
        return to_plain(self.settings.integration_choice(wildcards.blade, wildcards.scene))

    def plain_scene(self, wildcards: Any) -> dict[str, Any]:
        """The scene: what the blade meets."""
        return to_plain(self.settings.scenes[wildcards.scene].scene)

    def first_rounds(self, wildcards: Any) -> list[str]:
        """First rounds of the runs in one dataset, of all without a kind.

        They are asked for beside the responses: a response that is there is not planned anew for a round that is not.
        """
        pairs = self.runs_with(getattr(wildcards, "kind", KINDS[0]))
        adaptive = [(blade, scene) for blade, scene in pairs if self.settings.speed_plans[blade, scene].refined]
        return [paths.ROUND.format(blade=blade, scene=scene, round=0) for blade, scene in adaptive]

    def round_inputs(self, wildcards: Any) -> dict[str, Any]:
        """Input files of a round: the Campbell diagram, or the runs that the round before it asked for."""
        number, where = int(wildcards.round), {"blade": wildcards.blade, "scene": wildcards.scene}
        if number == 0:
            return {"campbell": paths.CAMPBELL.format(**where)}
        files = paths.speed_files(wildcards, self.new_speeds(wildcards, number - 1))
        return {"before": paths.ROUND.format(**where, round=number - 1), "speeds": files}

    def refinement_choice(self, wildcards: Any) -> dict[str, Any]:
        """Criterion for halving intervals of speeds of a scene, as fields of RefinementChoice."""
        settings = self.settings
        refinement = settings.config.refinement.scene_refinement(settings.scenes[wildcards.scene].scene)
        prominence = settings.config.interactions.prominence
        return to_plain(si_form(RefinementChoice, refinement, prominence=prominence))


def _evenly(names: list[str], most: int) -> list[str]:
    """Names evenly spread from the first to the last, at most so many."""
    count = min(most, len(names))
    return [names[round(place * (len(names) - 1) / max(count - 1, 1))] for place in range(count)]


def speeds_of_round(file: str, plan: SpeedPlan | None = None) -> list[float]:
    """Speeds (rad/s) that a round asked for, of those that its `plan` may ask for.

    The file is read once as long as it is the same. Raises InputFileError for a damaged one.
    """
    return _speeds_of_round(file, Path(file).stat().st_mtime_ns, plan)


@cache
def _speeds_of_round(file: str, _time: int, plan: SpeedPlan | None) -> list[float]:
    content = read_json(file)
    with readable(file):
        speeds = [float(speed) for speed in content["new"]]
        if strange := set() if plan is None else set(speeds).difference(_all_of(plan)):
            raise ValueError(f"it asks for {min(strange):.9g} rad/s, which is no speed of the configuration")
        return speeds


@cache
def _all_of(plan: SpeedPlan) -> frozenset[float]:
    """All speeds (rad/s) of a plan: each of its rounds is checked against them."""
    return frozenset(plan.every_speed())


@cache
def _task(scene: Scene, choice: IntegrationChoice, results: tuple[str, ...], kept: tuple[tuple[str, int], ...]) -> str:
    """Text of a task, made and kept once for the speeds that have the same."""
    return to_json(Task(scene, choice, results, dict(kept)))
