"""The study `refinement`: every speed of the grids of adaptive speed sampling. `snakemake refinement`"""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

from r37core.cases.case import Case
from r37core.config import ConfigError, Settings, plain
from r37core.plans.member_values import is_of_sample
from r37core.plans.sweep_plan import Rounds, Sweep
from r37core.tolerances.members import members_of
from r37core.tolerances.section import SECTION
from validation.studies.plan import case_of_sweep

_STEPS = (5.0, 8.0, 20.0)
"""Plain grids (rad/s) beside: as many runs as a fifth of every 1 rad/s, and those of two fidelity levels."""

_COMPARED = ("spectrum", "stress", "static_stress", "wear")
"""Results of a scene by which interactions are matched."""


def adaptive(settings: Settings) -> dict[str, tuple[str, str]]:
    """Blade and scene of each adaptive sweep, by the name of its case."""
    return {"__".join(pair): pair for pair, plan in settings.speed_plans.items() if plan.refined}


def cases(settings: Settings) -> dict[str, Case]:
    """Every speed of each of them, and of each of its members where the run has tolerances; ConfigError if there are none."""
    if not adaptive(settings):
        raise ConfigError("config.yaml: speeds: found no range with refine_to; allowed: at least one, for this study")
    nominal = {
        name: case_of_sweep(
            settings,
            *pair,
            speeds=tuple(settings.speed_plans[pair].every_speed()),
            results=tuple(kind for kind in settings.results_of(*pair) if kind in _COMPARED),
        )
        for name, pair in adaptive(settings).items()
    }
    members = adaptive_members(settings)
    return nominal | {
        case: replace(nominal[name], scene=members_of(settings).all[pair][member].scene, what=f"member {member}")
        for name, pair in adaptive(settings).items()
        for member, case in members.get(name, {}).items()
    }


def adaptive_members(settings: Settings) -> dict[str, dict[str, str]]:
    """Cases of the members of each adaptive sweep, by its name and the member's; ConfigError where their blades differ."""
    of_blades = settings.section(SECTION).of_blades
    if of_blades:
        raise settings.documents.config.refusal(
            ("tolerances", "of_blades"), ", ".join(of_blades), "of_scenes alone: the study runs the nominal models"
        )
    return {
        name: {member: f"{name}/{member}" for member in members_of(settings).all[pair] if is_of_sample(member)}
        for name, pair in adaptive(settings).items()
        if pair in members_of(settings).pairs
    }


def inputs(settings: Settings) -> dict[str, Any]:
    """The Campbell diagrams of all blades."""
    return {"campbell": "<results>/campbell.nc"}


def values(settings: Settings) -> dict[str, Any]:
    """Plans of the speeds, steps of the plain grids, and what a sweep refines by."""
    rounds, pairs = Rounds(Sweep(settings)), adaptive(settings)
    return {
        "pairs": pairs,
        "members": adaptive_members(settings),
        "plans": {name: settings.speed_plans[pair] for name, pair in pairs.items()},
        "steps": plain_steps(settings),
        "choices": {
            name: rounds.refinement_choice(SimpleNamespace(blade=blade, scene=scene)) for name, (blade, scene) in pairs.items()
        },
        "interactions": plain(settings.config.interactions),
    }


def plain_steps(settings: Settings) -> list[float]:
    """Steps (rad/s) of the plain grids that are part of the whole ones."""
    finest = [grid.interval for pair in adaptive(settings).values() for grid in settings.speed_plans[pair].refined]
    return [step for step in _STEPS if all(abs(step / span - round(step / span)) < 1e-9 and step >= span for span in finest)]
