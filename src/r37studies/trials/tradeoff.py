"""The preset tradeoff: one case for each value of each approximation in each scene, one varied at a time."""

import re
from typing import Any

import numpy as np

from r37core.config import Settings
from r37core.config.section import ExtensionSection, Section, option
from r37core.plans.extent import Extent
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL
from r37core.time_integration.speed_run import OF_RUNS

from .base_case import LEVEL, SPEEDS, BaseCase, Varied, extension, some_of
from .case import Case

# a step that is unstable is refused
_CENTRAL_DIFFERENCE = {"choice.shorten": False, "choice.integrator": CENTRAL_DIFFERENCE}
_EXACT_MODAL = {"choice.shorten": False, "choice.integrator": EXACT_MODAL}

PARAMETERS: Varied = {
    "level": {LEVEL: ()},
    "central_difference_step": {"choice.time_step": (4.0e-7, 2.0e-7, 1.0e-7, 5.0e-8, 2.5e-8), **_CENTRAL_DIFFERENCE},
    "exact_modal_step": {"choice.time_step": (9.6e-6, 6.4e-6, 4.8e-6, 3.2e-6, 2.4e-6, 1.6e-6, 8.0e-7), **_EXACT_MODAL},
    "static_above": {"choice.static_above": (0.25, 0.5, 1.5, 2.0, 1.0)},
    "revolutions": {"choice.revolutions": (25, 50, 100, 200, 400, 800)},
    "mesh_nodes": {"model.nodes": (2500, 5000, 10000, 20000, 40000)},
    "boundary_nodes": {"model.boundary_nodes": (2, 4, 8, 15)},
    "fixed_interface_modes": {"model.fixed_interface_modes": (0, 3, 10, 20, 40)},
    "highest_frequency": {"choice.highest_frequency": (2.0e4, 5.0e4, 1.0e5, 2.0e5, 1.0e7)},
    "bars": {"scene.lining.bars": (300, 1000, 3000, 10000, 30000, 100000)},
    "stress_instants": {"choice.snapshots_per_revolution": (8, 31, 62, 248)},
    "friction_form": {"scene.friction.form": ("vector", "constant")},
}
"""Parameter -> its values, the last of which the others are compared with; of the level all that there are."""


class TradeoffSection(Section):
    """Effect and cost of every approximation (snakemake tradeoff)."""

    parameters: some_of(PARAMETERS) = option(  # type: ignore[valid-type]
        "Parameters that are varied, one at a time", "all"
    )


SECTION = ExtensionSection("tradeoff", TradeoffSection, TradeoffSection())

TABLE = "r37studies.trials.case_table.table"


def cases(settings: Settings) -> dict[str, Case | str]:
    """One case for each value of each parameter in each scene that has it, at five speeds about the peak."""
    varied, chosen = {**PARAMETERS, "level": {LEVEL: list(settings.levels)}}, settings.section(SECTION).parameters
    return BaseCase(settings).cases(varied, chosen, OF_RUNS, {SPEEDS: tuple(np.linspace(1.0, 1.02, 5).tolist())})


def values(settings: Settings, extent: Extent) -> dict[str, Any]:
    """The cases of the same parameter and scene, from the last on: each is compared with the first of them that was run."""
    same: dict[str, list[str]] = {}
    for name in settings.made(cases):
        same.setdefault(re.sub("/.*__", "/", name), []).insert(0, name)
    return {"compared": {name: names for names in same.values() for name in reversed(names)}}


EXTENSION = extension(SECTION, "r37studies.trials.case_table.closing_of_tradeoff")
