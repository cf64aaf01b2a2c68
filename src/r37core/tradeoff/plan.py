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
from r37core.speeds import exact_text
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL

from ..case import Case
from ..plan import blade_name_of, integration_of_level, kept_of, level_of, material_of, model_of_level, scene_entry_of

LEVEL = "level"
"""The parameter that changes everything at once: the fidelity level."""

Change = Callable[[Case, str], Case]


def _change(path: str, value_of: Callable[[str], Any], **others: Any) -> Change:
    """Sets the field of a case at a dotted path, and `others` next to it; without that part the case stays as it is."""
    *parts, field = path.split(".")
    return lambda case, value: _with(case, parts, {field: value_of(value), **others})


def _with(whole: Any, parts: list[str], fields: Mapping[str, Any]) -> Any:
    if whole is None or not parts:
        return whole and replace(whole, **fields)
    return replace(whole, **{parts[0]: _with(getattr(whole, parts[0]), parts[1:], fields)})


CHANGES: Mapping[str, Change] = {
    LEVEL: lambda case, value: case,
    # a step that is unstable is refused
    "central_difference_step": _change("choice.time_step", float, shorten=False, integrator=CENTRAL_DIFFERENCE),
    "exact_modal_step": _change("choice.time_step", float, shorten=False, integrator=EXACT_MODAL),
    "static_above": _change("choice.static_above", float),
    "revolutions": _change("choice.revolutions", int),
    "highest_frequency": _change("choice.highest_frequency", float),
    "stress_instants": _change("choice.snapshots_per_revolution", int),
    "mesh_nodes": _change("model.nodes", int),
    "boundary_nodes": _change("model.boundary_nodes", int),
    "fixed_interface_modes": _change("model.fixed_interface_modes", int),
    "stress_region": _change("model.whole_blade_stress", lambda value: value == "whole"),
    "bars": _change("scene.lining.bars", int),
    "friction_form": _change("scene.friction.vector", lambda value: value == "vector"),
}
"""Parameter -> the case of the base level with a value of it, from the value's text."""


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
    blade, entry = blade_name_of(settings, section), scene_entry_of(settings, scene)
    as_the_scene = [result for result in entry.results if result == "static_stress"]
    case = Case(
        blade,
        model_of_level(settings, level),
        entry.scene(),
        integration_of_level(settings, level, entry.scene()),
        speeds=tuple(_every_share(section)),
        results=("energy", "spectrum", "stress", *as_the_scene, "instants", *(["wear"] if entry.scene().lining else [])),
        material=material_of(settings, blade),
        kept=kept_of(level_of(settings, level)),
        crossing=("1B", section.engine_order),
    )
    return CHANGES[parameter](case, value)


def shares_of(section: TradeoffSection) -> dict[str, list[float]]:
    """Speeds of each place, as shares of the Campbell speed."""
    return {name: np.linspace(place.first, place.last, place.speeds).tolist() for name, place in section.places}


def _every_share(section: TradeoffSection) -> list[float]:
    """Speeds of all places, which may share some, ascending."""
    return sorted({share for shares in shares_of(section).values() for share in shares})


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
    every = _every_share(section)
    return {
        "blade": blade_name_of(settings, section),
        "base_level": section.base,
        "places": {name: [every.index(share) for share in shares] for name, shares in shares_of(section).items()},
        "references": {name: _text(entry.reference) for name, entry in section.parameters.varied().items()},
        "tolerance": settings.config.tolerance,
    }


def _text(value: float | str) -> str:
    """A parameter's value as it stands in file names."""
    return value if isinstance(value, str) else exact_text(value)
