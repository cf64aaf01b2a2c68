"""The study `estimate`: a sample of a sweep's runs, timed. `snakemake estimate`"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from r37core.config import Settings
from r37core.plans.extent import extents
from r37core.product.sampling import beside
from r37core.time_integration.speed_run import OF_RUNS

from ..case import Case
from ..plan import case_of_sweep


def sample(speeds: Sequence[float], every: int) -> list[float]:
    """Every so many of the speeds, each from the middle of the part it stands for."""
    return list(speeds[min(every // 2, len(speeds) - 1) :: every])


def cases(settings: Settings) -> dict[str, Case]:
    """Some of the speeds of each blade and scene, evenly spread."""
    cases_of_runs = {}
    for (blade, scene), plan in settings.speed_plans.items():
        speeds = tuple(sample(plan.certain, settings.studies.estimate.every))
        cases_of_runs[f"{blade}__{scene}"] = case_of_sweep(
            settings,
            blade,
            scene,
            speeds=speeds,
            results=tuple(kind for kind in settings.results_of(blade, scene) if kind in OF_RUNS),
            history_speeds=tuple(speed for speed in speeds if speed in settings.scenes[scene].stress_history_speeds),
        )
    return cases_of_runs


def outputs(settings: Settings) -> dict[str, str]:
    """The projection."""
    return {"json": "<results>/studies/estimate.json", "table": "<results>/studies/estimate.md"}


def values(settings: Settings) -> dict[str, Any]:
    """How many runs each blade and scene has, members included, at most with adaptive speeds; and where they are run."""
    section = settings.studies.estimate
    return {
        "runs": {"__".join(pair): extent.at_most for pair, extent in extents(settings, beside(settings)).items()},
        "workflow_s_per_job": section.workflow_s_per_job,
        "cores": section.cores,
        "fidelity": settings.fidelity_name,
    }
