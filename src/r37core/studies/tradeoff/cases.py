"""The study `tradeoff`: one parameter at a time, what accuracy costs and how cost grows. `snakemake tradeoff`

The parameters' types and bounds are those of r37core.config.study_sections; a test holds the names together.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from r37core.config import ConfigError, Settings
from r37core.config.study_sections import TradeoffSection
from r37core.contact.scene import Scene
from r37core.speeds import exact_text
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL

from ..case import Case
from ..plan import blade_name_of, integration_of_level, kept_of, level_of, material_of, model_of_level, scene_entry_of

LEVEL = "level"
"""The parameter that changes everything at once: the fidelity level."""

OF_THE_MODEL: Mapping[str, Callable[[str], dict[str, Any]]] = {
    "mesh_nodes": lambda value: {"nodes": int(value)},
    "boundary_nodes": lambda value: {"boundary_nodes": int(value)},
    "fixed_interface_modes": lambda value: {"fixed_interface_modes": int(value)},
    "stress_region": lambda value: {"whole_blade_stress": value == "whole"},
}
"""Parameter -> fields of ModelChoice, from a value's text."""


def _step(integrator: str, value: str) -> dict[str, Any]:
    """Numbers of a given step, which is refused where it is unstable."""
    return {"time_step": float(value), "shorten": False, "integrator": integrator}


OF_THE_INTEGRATION: Mapping[str, Callable[[str], dict[str, Any]]] = {
    "central_difference_step": lambda value: _step(CENTRAL_DIFFERENCE, value),
    "exact_modal_step": lambda value: _step(EXACT_MODAL, value),
    "static_above": lambda value: {"static_above": float(value)},
    "revolutions": lambda value: {"revolutions": int(value)},
    "highest_frequency": lambda value: {"highest_frequency": float(value)},
    "stress_instants": lambda value: {"snapshots_per_revolution": int(value)},
}
"""Parameter -> fields of IntegrationChoice, from a value's text."""


def _with_bars(scene: Scene, value: str) -> Scene:
    return replace(scene, lining=scene.lining and replace(scene.lining, bars=int(value)))


def _with_friction(scene: Scene, value: str) -> Scene:
    return replace(scene, friction=scene.friction and replace(scene.friction, vector=value == "vector"))


OF_THE_SCENE: Mapping[str, Callable[[Scene, str], Scene]] = {"bars": _with_bars, "friction_form": _with_friction}
"""Parameter -> the scene with a value, from its text."""

PARAMETERS = (LEVEL, *OF_THE_INTEGRATION, *OF_THE_MODEL, *OF_THE_SCENE)


def vary(parameter: str, value: str, scene: Scene, choice: IntegrationChoice) -> tuple[Scene, IntegrationChoice]:
    """Scene and time integration with one parameter set; the level and parameters of the model change neither.

    Raises ValueError for an unknown parameter.
    """
    if parameter not in PARAMETERS:
        raise ValueError(f"unknown parameter {parameter}")
    if parameter in OF_THE_SCENE:
        return OF_THE_SCENE[parameter](scene, value), choice
    if parameter in OF_THE_INTEGRATION:
        return scene, replace(choice, **OF_THE_INTEGRATION[parameter](value))
    return scene, choice


def cases(settings: Settings) -> dict[str, Case]:
    """One case for each value of each parameter in each scene; ConfigError without the section."""
    section = settings.studies.tradeoff
    if section is None:
        raise ConfigError("config.yaml: studies.tradeoff: missing; the study needs its parameters, as in the shipped file")
    scenes = list(settings.scenes) if section.scenes == "all" else list(section.scenes)
    return {
        f"{parameter}/{value}__{scene}": _case(settings, section, parameter, value, scene)
        for parameter, values in values_of(settings).items()
        for value in values
        for scene in scenes
    }


def _case(settings: Settings, section: TradeoffSection, parameter: str, value: str, scene: str) -> Case:
    level = value if parameter == LEVEL else section.base
    model = model_of_level(settings, level)
    if parameter in OF_THE_MODEL:
        model = replace(model, **OF_THE_MODEL[parameter](value))
    blade, entry = blade_name_of(settings, section), scene_entry_of(settings, scene)
    varied, choice = vary(parameter, value, entry.scene(), integration_of_level(settings, level, entry.scene()))
    as_the_scene = [result for result in entry.results if result == "static_stress"]
    return Case(
        blade,
        model,
        varied,
        choice,
        speeds=tuple(sorted({share for shares in shares_of(section).values() for share in shares})),
        results=("energy", "spectrum", "stress", *as_the_scene, "instants", *(["wear"] if varied.lining else [])),
        material=material_of(settings, blade),
        kept=kept_of(level_of(settings, level)),
        crossing=("1B", section.engine_order),
    )


def shares_of(section: TradeoffSection) -> dict[str, list[float]]:
    """Speeds of each place, as shares of the Campbell speed."""
    return {name: np.linspace(place.first, place.last, place.speeds).tolist() for name, place in section.places}


def _rows_of(section: TradeoffSection) -> dict[str, list[int]]:
    """Where the speeds of each place stand among all of a case, which are ascending; places may share speeds."""
    shares = shares_of(section)
    every = sorted({share for of_place in shares.values() for share in of_place})
    return {name: [every.index(share) for share in of_place] for name, of_place in shares.items()}


def values_of(settings: Settings) -> dict[str, list[str]]:
    """Values of each parameter, as texts; none without the section."""
    section = settings.studies.tradeoff
    return {name: [_text(value) for value in of.values] for name, of in section.parameters.varied().items()} if section else {}


def outputs(settings: Settings) -> dict[str, str]:
    """All numbers, tables, and figures."""
    files = {"dataset": "tradeoff.nc", "levels": "levels.md", "table": "tradeoff.md", "growth": "growth.md"}
    files |= {"growth_figure": "figures/growth.png", "pareto": "figures/tradeoff_pareto.png"}
    files |= {f"of_{parameter}": f"figures/tradeoff_{parameter}.png" for parameter in values_of(settings)}
    return {name: f"<results>/studies/{file}" for name, file in files.items()}


def values(settings: Settings) -> dict[str, Any]:
    """Which speeds lie at each place, reference values, and what the levels are held against."""
    section = settings.studies.tradeoff
    assert section is not None
    return {
        "blade": blade_name_of(settings, section),
        "base_level": section.base,
        "places": _rows_of(section),
        "references": {name: _text(entry.reference) for name, entry in section.parameters.varied().items()},
        "tolerance": settings.config.tolerance,
    }


def _text(value: float | str) -> str:
    """A parameter's value as it stands in file names."""
    return value if isinstance(value, str) else exact_text(value)
