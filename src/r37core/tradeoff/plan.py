"""The plan of the trade-off: one case for each value of each parameter in each scene."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from r37core.base.speeds import exact_text
from r37core.cases.case import Case
from r37core.cases.plan import BaseCase
from r37core.config import Settings
from r37core.plans import paths
from r37core.plans.extension import Extension, Figure
from r37core.plans.sweep_plan import Sweep
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL

from .section import DEFAULTS, SECTION, Parameter, TradeoffSection

DATASET, TABLE = "<results>/tradeoff.nc", "<results>/tradeoff.csv"
LEVELS, GROWTH = "<results>/tradeoff_levels.csv", "<results>/tradeoff_growth.csv"

LEVEL = "level"
"""The parameter that changes everything at once: the fidelity level."""

Changes = Callable[[Any], dict[str, Any]]
"""Fields of a case, by their paths, from a value of a parameter."""


def _step(integrator: str) -> Changes:
    # a step that is unstable is refused
    return lambda step: {"choice.time_step": step, "choice.shorten": False, "choice.integrator": integrator}


CHANGES: Mapping[str, Changes] = {
    LEVEL: lambda level: {},
    "central_difference_step": _step(CENTRAL_DIFFERENCE),
    "exact_modal_step": _step(EXACT_MODAL),
    "static_above": lambda limit: {"choice.static_above": limit},
    "revolutions": lambda number: {"choice.revolutions": number},
    "highest_frequency": lambda frequency: {"choice.highest_frequency": frequency},
    "stress_instants": lambda number: {"choice.snapshots_per_revolution": number},
    "mesh_nodes": lambda number: {"model.nodes": number},
    "boundary_nodes": lambda number: {"model.boundary_nodes": number},
    "fixed_interface_modes": lambda number: {"model.fixed_interface_modes": number},
    "stress_region": lambda region: {"model.stress_region": region},
    "bars": lambda number: {"scene.lining.bars": number},
    "friction_form": lambda form: {"scene.friction.vector": form == "vector"},
}
"""Parameter -> what a value of it changes in the case of the base level."""


def cases(settings: Settings) -> dict[str, Case]:
    """One case for each value of each parameter in each scene."""
    return {
        f"{name}/{_text(value)}__{scene}": _case(settings, name, value, scene)
        for name, entry in varied(settings).items()
        for value in entry.values
        for scene in BaseCase(settings, SECTION).scenes
    }


def _case(settings: Settings, parameter: str, value: Any, scene: str) -> Case:
    base, chosen = BaseCase(settings, SECTION), settings.scenes[scene]
    assert base.blade is not None
    stress = () if settings.blades[base.blade].is_matrices else ("stress", "instants")
    results = (
        *("energy", "spectrum", *stress),
        *(result for result in settings.results_of(base.blade, scene) if result == "static_stress"),
        *(["wear"] if chosen.scene.lining else []),
    )
    shares, level = _every_share(settings.section(SECTION)), value if parameter == LEVEL else None
    return base.case(chosen.scene, shares, results, level).changed(CHANGES[parameter](value))


def shares_of(section: TradeoffSection) -> dict[str, list[float]]:
    """Speeds of each place, as shares of the Campbell speed."""
    return {name: np.linspace(place.first, place.last, place.speeds).tolist() for name, place in section.places}


def _every_share(section: TradeoffSection) -> list[float]:
    """Speeds of all places, which may share some, ascending."""
    return sorted({share for shares in shares_of(section).values() for share in shares})


def varied(settings: Settings) -> dict[str, Parameter[Any]]:
    """The parameters that are varied, with the values that can be run; none without a blade or a scene."""
    entries = {}
    for name, entry in _wanted(settings).items() if BaseCase(settings, SECTION).scenes else ():
        possible = [value for value in entry.values if _is_possible(settings, name, value)]
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


def _is_possible(settings: Settings, parameter: str, value: Any) -> bool:
    """True where this run can have the value, and the stress is wanted at samples of the motion."""
    base = BaseCase(settings, SECTION)
    case = _case(settings, parameter, value, base.scenes[0])
    samples = case.choice.samples_per_revolution
    sampled = samples % (case.choice.snapshots_per_revolution or samples) == 0
    return sampled and not base.refusal(case, CHANGES[parameter](value))


def left_out(settings: Settings) -> str:
    """The parameters that are wanted and not varied, and why; empty where all of them are."""
    base, wanted = BaseCase(settings, SECTION), _wanted(settings)
    missing = wanted.keys() - varied(settings) if base.blade else ()
    reasons = {name: base.lacking(CHANGES[name](entry.reference)) for name, entry in wanted.items() if name in missing}
    lines = []
    # what a blade of another program has as it is comes first
    for reason in sorted(set(reasons.values()), reverse=True):
        names = ", ".join(name for name in reasons if reasons[name] == reason)
        lines.append(f"{names}, because {reason or 'fewer than two of their values can be run'}")
    return "; ".join(lines)


def values(settings: Settings) -> dict[str, Any]:
    """Places of the speeds, reference values, and what the tables and the dataset report of the run."""
    section, base = settings.section(SECTION), BaseCase(settings, SECTION)
    every = _every_share(section)
    return {
        "blade": base.blade,
        "base_level": base.level,
        "places": {name: [every.index(share) for share in shares] for name, shares in shares_of(section).items()},
        "references": {name: _text(entry.reference) for name, entry in varied(settings).items()},
        "tolerance": settings.config.tolerance,
        "left_out": left_out(settings),
    }


def _text(value: float | str) -> str:
    """A parameter's value as it stands in file names."""
    return value if isinstance(value, str) else exact_text(value)


def _once(sweep: Sweep) -> paths.Wildcards:
    return [{}] if varied(sweep.settings) else []


def can_be_run(settings: Settings) -> None:
    """Blade, scenes and levels are there, and stress instants are among the samples of a revolution."""
    section, base = settings.section(SECTION), BaseCase(settings, SECTION)
    wanted = section.parameters.varied() if section.parameters else {}
    base.check_names(wanted[LEVEL].values if LEVEL in wanted else [])
    if "stress_instants" not in wanted:
        return
    samples = settings.levels[base.level].time_integration.samples_per_revolution
    for number, instants in enumerate(wanted["stress_instants"].values):
        if samples % instants:
            path = ("tradeoff", "parameters", "stress_instants", "values", number)
            allowed = f"divisors of {samples}, the samples in a revolution of level {base.level}"
            raise settings.documents.config.refusal(path, f"{instants}", allowed)


EXTENSION = Extension(
    name="tradeoff",
    section=SECTION,
    checks=(can_be_run,),
    cases=cases,
    targets=lambda sweep: dict.fromkeys((DATASET, TABLE, LEVELS, GROWTH), _once(sweep)),
    figures=(
        Figure(
            rule="tradeoff_figure",
            name="tradeoff",
            runs=_once,
            draw="tradeoff.figures.draw_tradeoff",
            files={"table": TABLE},
            label="accuracy and cost",
            caption="Error of the normal rms at the peak over the CPU time of a run, for every value of every parameter. Each "
            "is compared with the reference value of its parameter. Stars: fidelity levels.",
        ),
        Figure(
            rule="tradeoff_growth_figure",
            name="tradeoff_growth",
            runs=_once,
            draw="tradeoff.figures.draw_growth",
            files={"table": TABLE, "growth": GROWTH},
            label="growth of costs",
            caption="Growth of a cost with a parameter. Dashed: power law, fitted to the more expensive half of the values.",
        ),
        Figure(
            rule="tradeoff_parameter_figure",
            name="tradeoff_{parameter}",
            runs=lambda sweep: paths.of("parameter", varied(sweep.settings)),
            draw="tradeoff.figures.draw_parameter",
            files={"table": TABLE},
            label="{parameter}",
            caption="One parameter varied. Above: relative errors of the means over the speeds at the peak, against the "
            "reference value. Below: CPU time of a run.",
            arguments=lambda _: {"parameter": "{parameter}"},
        ),
    ),
    closing="tradeoff.tables.closing",
    look_at="<results>/figures/tradeoff.png",
    made_on_request=True,
)
