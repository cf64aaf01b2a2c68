"""estimate of config.yaml, and its plan: some of the speeds of each blade and scene, evenly spread."""

from collections.abc import Mapping, Sequence
from typing import Any

from pydantic import Field

from r37core.cases.case import Case
from r37core.config import Settings
from r37core.config.section import ExtensionSection, Section
from r37core.plans.extension import Extension, Figure
from r37core.plans.extent import Pair, extents
from r37core.time_integration.speed_run import OF_RUNS


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

TABLE = "<results>/estimate.csv"


def sample(speeds: Sequence[float], every: int) -> list[float]:
    """Every so many of the speeds, each from the middle of the part it stands for."""
    return list(speeds[min(every // 2, len(speeds) - 1) :: every])


def cases(settings: Settings) -> dict[str, Case]:
    """A case for each blade and scene."""
    return {"__".join(pair): _case(settings, *pair) for pair in settings.speed_plans}


def _case(settings: Settings, blade: str, scene: str) -> Case:
    chosen = settings.scenes[scene]
    speeds = tuple(sample(settings.speed_plans[blade, scene].certain, settings.section(SECTION).every))
    return Case(
        blade,
        chosen.tip_line,
        chosen.scene,
        settings.integration_choice(blade, scene, settings.structure.maximum_speed_rad_s),
        speeds,
        results=tuple(kind for kind in settings.results_of(blade, scene) if kind in OF_RUNS),
        material=settings.blades[blade].material,
        kept=settings.fidelity.time_integration.kept,
        history_speeds=tuple(speed for speed in speeds if speed in chosen.stress_history_speeds),
    )


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
    cases=cases,
    targets=lambda _: {TABLE: [{}]},
    figures=(
        Figure(
            rule="estimate_figure",
            name="estimate",
            draw="estimate.figures.draw_estimate",
            files={"table": TABLE},
            label="cost of the sweep",
            caption="Core hours of the whole sweep, projected from a sample of its runs, by what they are spent on.",
        ),
    ),
    closing="estimate.steps.closing",
    made_on_request=True,
)
