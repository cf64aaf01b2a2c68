"""The plan of the estimate: some of the speeds of each blade and scene, evenly spread."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from r37core.cases.case import Case
from r37core.cases.plan import case_of_sweep
from r37core.config import Settings
from r37core.plans import paths
from r37core.plans.extent import extents
from r37core.plans.samples import Pair, Sample
from r37core.plans.sweep_plan import Sweep
from r37core.time_integration.speed_run import OF_RUNS

from .section import SECTION


def sample(speeds: Sequence[float], every: int) -> list[float]:
    """Every so many of the speeds, each from the middle of the part it stands for."""
    return list(speeds[min(every // 2, len(speeds) - 1) :: every])


def cases(settings: Settings) -> dict[str, Case]:
    """A case for each blade and scene."""
    every = settings.section(SECTION).every
    return {
        "__".join(pair): _case(settings, *pair, tuple(sample(plan.certain, every)))
        for pair, plan in settings.speed_plans.items()
    }


def _case(settings: Settings, blade: str, scene: str, speeds: tuple[float, ...]) -> Case:
    return case_of_sweep(
        settings,
        blade,
        scene,
        speeds=speeds,
        results=tuple(kind for kind in settings.results_of(blade, scene) if kind in OF_RUNS),
        history_speeds=tuple(speed for speed in speeds if speed in settings.scenes[scene].stress_history_speeds),
    )


def values(settings: Settings, beside: Mapping[str, Mapping[Pair, Sample]]) -> dict[str, Any]:
    """How many runs each blade and scene has at most, those of samples `beside` the sweep included; and where they are run."""
    section = settings.section(SECTION)
    return {
        "runs": {"__".join(pair): extent.at_most for pair, extent in extents(settings, beside).items()},
        "workflow_s_per_job": section.workflow_s_per_job,
        "cores": section.cores,
    }


def targets(sweep: Sweep) -> dict[str, paths.Wildcards]:
    """The table and the figure."""
    return {"<results>/estimate.csv": [{}], **paths.pictures("estimate", [{}])}
