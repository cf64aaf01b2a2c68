"""The preset estimate: some of the speeds of each blade and scene of the sweep, evenly spread."""

from collections.abc import Mapping
from typing import Any

from pydantic import Field

from r37core.config import Settings
from r37core.config.section import ExtensionSection, Section
from r37core.plans.extension import Extension
from r37core.plans.extent import Pair, extents
from r37core.time_integration.speed_run import OF_RUNS

from .case import Case


class EstimateSection(Section):
    """Cost of a whole sweep (snakemake estimate)."""

    every: int = Field(
        default=50, ge=1, le=1_000_000, description="One of this many speeds is run, in all scenes, for every blade"
    )
    cores: int = Field(default=2, ge=1, le=1_000_000, description="Cores of the projected wall time")
    workflow_s_per_job: float = Field(
        default=0.045, ge=0, le=1000, description="CPU seconds of Snakemake itself per job, measured in a sweep of 17,514"
    )


SECTION = ExtensionSection("estimate", EstimateSection, EstimateSection())

TABLE = "r37studies.trials.estimate_tables.table"


def cases(settings: Settings) -> dict[str, Case | str]:
    """A case for each blade and scene."""
    every, planned = settings.section(SECTION).every, dict[str, Case | str]()
    for (blade, scene), plan in settings.speed_plans.items():
        chosen = settings.scenes[scene]
        planned[f"{blade}__{scene}"] = Case(
            blade,
            chosen.tip_line,
            chosen.scene,
            settings.integration_choice(blade, scene, 0.0),
            # each speed from the middle of the part that it stands for
            plan.certain[min(every // 2, len(plan.certain) - 1) :: every],
            results=tuple(kind for kind in settings.results_of(blade, scene) if kind in OF_RUNS),
            material=settings.blades[blade].material,
            kept=settings.fidelity.time_integration.kept,
        )
    return planned


def values(settings: Settings, members: Mapping[Pair, int]) -> dict[str, Any]:
    """How many runs each blade and scene has at most, with so many simulations of its `members`; and where they are run."""
    section = settings.section(SECTION)
    return {
        "runs": {"__".join(pair): extent.at_most for pair, extent in extents(settings, members).items()},
        "workflow_per_job": section.workflow_s_per_job,
        "cores": section.cores,
    }


EXTENSION = Extension(
    name="estimate",
    section=SECTION,
    targets=lambda _: {"<results>/estimate.csv": [{}]},
    closing="r37studies.trials.estimate_tables.closing",
    made_on_request=True,
)
