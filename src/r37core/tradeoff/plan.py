"""The plan of the trade-off: one case for each value of each parameter in each scene."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from r37core.base.speeds import exact_text
from r37core.cases.case import Case, Crossing
from r37core.cases.plan import carries_coriolis, integration_of_level, kept_of, model_of_level, names_are_known
from r37core.config import Settings
from r37core.plans import paths
from r37core.plans.sweep_plan import Sweep
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL

from .section import DEFAULTS, SECTION, Parameter, TradeoffSection

LEVEL = "level"
"""The parameter that changes everything at once: the fidelity level."""

_OF_THE_MESH = ("mesh_nodes",)
_OF_THE_MODEL = ("boundary_nodes", "fixed_interface_modes", "stress_instants", "stress_region")

Change = Callable[[Case, str], Case]


def _change(path: str, value_of: Callable[[str], Any], **others: Any) -> Change:
    """Sets the field of a case at a dotted path, and `others` next to it; without that part the case stays as it is."""
    *parts, field = path.split(".")
    return lambda case, value: _changed(case, parts, {field: value_of(value), **others})


def _changed(whole: Any, parts: list[str], fields: Mapping[str, Any]) -> Any:
    if whole is None or not parts:
        return whole and replace(whole, **fields)
    return replace(whole, **{parts[0]: _changed(getattr(whole, parts[0]), parts[1:], fields)})


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
    """One case for each value of each parameter in each scene."""
    return {
        f"{name}/{_text(value)}__{scene}": _case(settings, name, _text(value), scene)
        for name, entry in varied(settings).items()
        for value in entry.values
        for scene in settings.section(SECTION).scenes_of(settings)
    }


def _case(settings: Settings, parameter: str, value: str, scene: str) -> Case:
    section, chosen = settings.section(SECTION), settings.scenes[scene]
    blade, level = section.blade_of(settings), value if parameter == LEVEL else section.base_of(settings)
    assert blade is not None
    stress = () if settings.blades[blade].is_matrices else ("stress", "instants")
    case = Case(
        blade,
        model_of_level(settings, blade, level),
        chosen.scene,
        integration_of_level(settings, level, chosen.scene),
        speeds=tuple(_every_share(section)),
        results=(
            *("energy", "spectrum", *stress),
            *(result for result in settings.results_of(blade, scene) if result == "static_stress"),
            *(["wear"] if chosen.scene.lining else []),
        ),
        material=settings.blades[blade].material,
        kept=kept_of(settings.levels[level]),
        crossing=Crossing("1B", section.engine_order),
    )
    return CHANGES[parameter](case, value)


def shares_of(section: TradeoffSection) -> dict[str, list[float]]:
    """Speeds of each place, as shares of the Campbell speed."""
    return {name: np.linspace(place.first, place.last, place.speeds).tolist() for name, place in section.places}


def _every_share(section: TradeoffSection) -> list[float]:
    """Speeds of all places, which may share some, ascending."""
    return sorted({share for shares in shares_of(section).values() for share in shares})


def varied(settings: Settings) -> dict[str, Parameter[Any]]:
    """The parameters that are varied, with the values that can be run; none without a blade or a scene."""
    section = settings.section(SECTION)
    blade, scenes = section.blade_of(settings), section.scenes_of(settings)
    if blade is None or not scenes:
        return {}
    entries = {}
    for name, entry in _wanted(settings).items():
        values = [] if name in _given(settings, blade) else entry.values
        possible = [value for value in values if _is_possible(settings, _case(settings, name, _text(value), scenes[0]))]
        if len(possible) > 1:
            reference = entry.reference if entry.reference in possible else possible[-1]
            entries[name] = entry.model_copy(update={"values": possible, "reference": reference})
    return entries


def _wanted(settings: Settings) -> dict[str, Parameter[Any]]:
    parameters = settings.section(SECTION).parameters
    if parameters is None:
        levels = list(settings.levels)
        return {LEVEL: Parameter(values=levels, reference=levels[-1]), **DEFAULTS.varied()}
    return parameters.varied()


def _given(settings: Settings, blade: str) -> tuple[str, ...]:
    """Parameters that a blade of another program has as they are."""
    if settings.blades[blade].is_matrices:
        return (*_OF_THE_MESH, *_OF_THE_MODEL)
    return () if settings.blades[blade].has_profiles else _OF_THE_MESH


def _is_possible(settings: Settings, case: Case) -> bool:
    """Whether the integrator carries the Coriolis force, and the stress is wanted at samples of the motion."""
    choice = case.choice
    samples = choice.samples_per_revolution
    return carries_coriolis(settings, choice) and samples % (choice.snapshots_per_revolution or samples) == 0


def left_out(settings: Settings) -> str:
    """Which parameters are wanted and not varied, and why; empty where all of them are."""
    blade = settings.section(SECTION).blade_of(settings)
    missing = [name for name in _wanted(settings) if name not in varied(settings)]
    if blade is None or not missing:
        return ""
    of_program = _given(settings, blade)
    kind = "matrices" if settings.blades[blade].is_matrices else "a mesh"
    lines = [
        (f"because {blade} is given by {kind}", [name for name in missing if name in of_program]),
        ("because fewer than two of their values can be run", [name for name in missing if name not in of_program]),
    ]
    return "; ".join(f"{', '.join(names)}, {reason}" for reason, names in lines if names)


def values(settings: Settings) -> dict[str, Any]:
    """Which speeds lie at each place, reference values, and what the tables and the dataset say of the run."""
    section = settings.section(SECTION)
    every = _every_share(section)
    return {
        "blade": section.blade_of(settings),
        "base_level": section.base_of(settings),
        "places": {name: [every.index(share) for share in shares] for name, shares in shares_of(section).items()},
        "references": {name: _text(entry.reference) for name, entry in varied(settings).items()},
        "tolerance": settings.config.tolerance,
        "left_out": left_out(settings),
    }


def _text(value: float | str) -> str:
    """A parameter's value as it stands in file names."""
    return value if isinstance(value, str) else exact_text(value)


def targets(sweep: Sweep) -> dict[str, paths.Wildcards]:
    """The dataset, the tables and the figures."""
    parameters = varied(sweep.settings)
    made: paths.Wildcards = [{}] if parameters else []
    files = ("tradeoff.nc", "tradeoff.csv", "tradeoff_levels.csv", "tradeoff_growth.csv")
    return {
        **{f"<results>/{name}": made for name in files},
        **paths.pictures("tradeoff", made),
        **paths.pictures("tradeoff_growth", made),
        **paths.pictures("tradeoff_{parameter}", paths.of("parameter", parameters)),
    }


def can_be_run(settings: Settings) -> None:
    """Blade, scenes and levels are there, and stress instants are among the samples of a revolution."""
    section = settings.section(SECTION)
    wanted = section.parameters.varied() if section.parameters else {}
    names_are_known(settings, "tradeoff", section, wanted[LEVEL].values if LEVEL in wanted else [])
    if "stress_instants" not in wanted:
        return
    level = section.base_of(settings)
    samples = settings.levels[level].time_integration.samples_per_revolution
    for number, instants in enumerate(wanted["stress_instants"].values):
        if samples % instants:
            path = ("tradeoff", "parameters", "stress_instants", "values", number)
            allowed = f"divisors of {samples}, the samples in a revolution of level {level}"
            raise settings.documents.config.refusal(path, f"{instants}", allowed)
