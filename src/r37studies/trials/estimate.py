"""The preset estimate: some of the speeds of each blade and scene of the sweep, evenly spread."""

from typing import Any

from r37core.config import Settings
from r37core.config.section import ExtensionSection, Section, option
from r37core.plans.extent import JOB_S, Extent, fixed_seconds
from r37core.time_integration.speed_run import OF_RUNS

from .base_case import extension
from .case import Case


class EstimateSection(Section):
    """Cost of a whole sweep (snakemake estimate)."""

    every: int = option("One of this many speeds is run, at least five, of every blade and scene", 50, ge=1, le=1_000_000)


SECTION = ExtensionSection("estimate", EstimateSection, EstimateSection())

TABLE = "r37studies.trials.estimate_tables.table"


_FEWEST = 5
"""Speeds of the fewest that are run of each blade and scene, as far as it has so many."""


def cases(settings: Settings) -> dict[str, Case | str]:
    """A case for each blade and scene."""
    planned = dict[str, Case | str]()
    for (blade, scene), plan in settings.speed_plans.items():
        chosen, every = settings.scenes[scene], min(settings.section(SECTION).every, len(plan.certain) // _FEWEST or 1)
        planned[f"{blade}__{scene}"] = Case(
            blade,
            chosen.tip_line,
            chosen.scene,
            settings.integration_choice(blade, scene),
            # each speed from the middle of the part that it stands for
            plan.certain[every // 2 :: every],
            results=tuple(kind for kind in settings.results_of(blade, scene) if kind in OF_RUNS),
            material=settings.blades[blade].material,
            kept=settings.fidelity.time_integration.kept,
        )
    return planned


def values(settings: Settings, extent: Extent) -> dict[str, Any]:
    """Simulations of each part and case, as a rule, and how many of the case's they are worth; other CPU time (s)."""
    runs = {
        part: {"__".join(pair): (runs.number, runs.length or runs.number) for pair, runs in several.items()}
        for part, several in extent.items()
    }
    return {"runs": runs, "jobs": JOB_S, "fixed": fixed_seconds(settings, extent)}


EXTENSION = extension(SECTION, "r37studies.trials.estimate_tables.closing")
