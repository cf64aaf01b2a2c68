"""Sweep of one blade in one scene as plain data: what its simulations start from, and at which speeds they are."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from r37core.adaptive.refinement_choice import RefinementChoice
from r37core.base.io import Named
from r37core.base.plain import from_plain
from r37core.base.speeds import SpeedPlan
from r37core.config import Settings
from r37core.plans.sweep_plan import Sweep
from r37core.stress.statistic import Strengths

from .recipe import Recipe, recipes

CAMPBELL = "campbell_of_blade"
"""Stage of the Campbell diagram, that adaptive speeds begin with."""


@dataclass(frozen=True)
class BladeSweep:
    """Sweep of a blade in a scene.

    `existing`: stage of the structure -> its file that is there; `recipes`: of the others. `models`: stages that simulations
    start from, that of contact first. `task`, as JSON, of a simulation; `history_speeds` (rad/s): of those whose stresses of
    every revolution are kept. `yield_stress` (Pa), `strengths`: of the blade.
    """

    existing: Mapping[str, str]
    recipes: Mapping[str, Recipe]
    models: tuple[str, ...]
    task: str
    history_speeds: tuple[float, ...]
    yield_stress: float
    strengths: Strengths

    def file(self, stage: str, folder: Path, attributes: Mapping[str, Any]) -> Path:
        """File of a stage of the structure, made in the folder where it is not there. Raises what making it raises."""
        existing = self.existing.get(stage)
        return Path(existing) if existing else self.recipes[stage].file(folder, attributes)


@dataclass(frozen=True)
class SharedSpeeds:
    """Speeds that several sweeps have in common: the `plan`, and by which `choice` adaptive ones are refined."""

    plan: SpeedPlan
    choice: RefinementChoice


def blade_sweep(
    settings: Settings, blade: str, scene: str, existing: Mapping[str, str] | None = None, *, kept: bool = True
) -> BladeSweep:
    """The sweep of a blade in a scene of these settings; `existing` and `kept` as of BladeSweep and `recipes`."""
    run, sweep, there = Named(blade=blade, scene=scene), Sweep(settings), existing or {}
    tip_line = settings.scenes[scene].tip_line
    models = ("contact_model", *(["stress_operator"] if "stress" in sweep.results(run) else []))
    lines = {**dict.fromkeys(models, tip_line), CAMPBELL: None}
    return BladeSweep(
        existing=there,
        recipes=recipes(settings, blade, {stage: line for stage, line in lines.items() if stage not in there}, kept=kept),
        models=models,
        task=sweep.task(run),
        history_speeds=sweep.stress_history_speeds(run),
        yield_stress=sweep.yield_stress(run),
        strengths=from_plain(Strengths, sweep.strengths(run)),
    )


def shared_speeds(settings: Settings, blade: str, scene: str, largest_share: float | None = None) -> SharedSpeeds:
    """Speeds of a blade in a scene, adaptive ones at most at `largest_share` of the finest grid, else as config.yaml says."""
    run, sweep = Named(blade=blade, scene=scene), Sweep(settings)
    choice = from_plain(RefinementChoice, sweep.refinement_choice(run))
    return SharedSpeeds(sweep.speed_plan(run), replace(choice, largest_share=largest_share or choice.largest_share))
