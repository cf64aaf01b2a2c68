"""The preset tradeoff: one case for each value of each approximation in each scene, one varied at a time."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, Generic, Literal, TypeVar

import numpy as np
from pydantic import Field

from r37core.base.speeds import exact_text
from r37core.config import Settings
from r37core.config.fidelity import TimeStep
from r37core.config.section import ExtensionSection, LeftOut, Name, Section, Unique, left_out, refused
from r37core.plans import paths
from r37core.plans.extension import Extension, Figure
from r37core.plans.extent import Pair
from r37core.plans.sweep_plan import Sweep
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL

from .base_case import BaseCase, Changes, TrialsSection, put
from .case import LEVEL, Case

Value = TypeVar("Value")


class Parameter(Section, Generic[Value]):
    """Values of one parameter, and the one that the others are compared with."""

    values: Unique[Value] = Field(description="Values that are run")
    reference: Value = Field(description="Value that the others are compared with")

    def _check(self) -> None:
        if self.reference not in self.values:
            raise refused(("reference",), repr(self.reference), f"one of the values, {', '.join(map(str, self.values))}")


class Parameters(Section):
    """The parameters that are varied, one at a time."""

    level: Parameter[Name] | LeftOut = left_out("Fidelity levels")
    central_difference_step: Parameter[TimeStep] | LeftOut = left_out("Step of central differences (s)")
    exact_modal_step: Parameter[TimeStep] | LeftOut = left_out("Step of exact_modal (s)")
    static_above: Parameter[Annotated[float, Field(ge=1e-3, le=1e9)]] | LeftOut = left_out(
        "Limit of omega h above which modes are static, with exact_modal"
    )
    revolutions: Parameter[Annotated[int, Field(ge=2, le=20000)]] | LeftOut = left_out("Length of a run")
    mesh_nodes: Parameter[Annotated[int, Field(ge=500, le=500_000)]] | LeftOut = left_out(
        "Nodes of the mesh, of a blade with profiles"
    )
    boundary_nodes: Parameter[Annotated[int, Field(ge=1, le=200)]] | LeftOut = left_out("Contact nodes")
    fixed_interface_modes: Parameter[Annotated[int, Field(ge=0, le=500)]] | LeftOut = left_out(
        "Fixed-interface modes at each speed of the reduced model"
    )
    highest_frequency: Parameter[Annotated[float, Field(ge=1, le=1e12)]] | LeftOut = left_out(
        "Highest frequency that is kept (Hz)"
    )
    bars: Parameter[Annotated[int, Field(ge=10, le=1_000_000)]] | LeftOut = left_out("Bars of the abradable lining")
    stress_instants: Parameter[Annotated[int, Field(ge=1, le=10000)]] | LeftOut = left_out("Stress evaluations per revolution")
    stress_region: Parameter[Literal["submesh", "whole"]] | LeftOut = left_out("Region of the recovered stress")
    friction_form: Parameter[Literal["constant", "vector"]] | LeftOut = left_out("Form of friction")

    def varied(self) -> dict[str, Parameter[Any]]:
        """The parameters that are varied, by name."""
        return {name: parameter for name, parameter in self if parameter is not None}


def _step(integrator: str) -> Changes:
    # a step that is unstable is refused
    return lambda step: {"choice": {"time_step": step, "shorten": False, "integrator": integrator}}


PARAMETERS: Mapping[str, tuple[Changes, list[Any], Any]] = {
    "central_difference_step": (_step(CENTRAL_DIFFERENCE), [2.5e-8, 5.0e-8, 1.0e-7, 2.0e-7, 4.0e-7], 2.5e-8),
    "exact_modal_step": (_step(EXACT_MODAL), [8.0e-7, 1.6e-6, 2.4e-6, 3.2e-6, 4.8e-6, 6.4e-6, 9.6e-6], 8.0e-7),
    "static_above": (put("choice", "static_above"), [0.25, 0.5, 1.0, 1.5, 2.0], 1.0),
    "revolutions": (put("choice", "revolutions"), [25, 50, 100, 200, 400, 800], 800),
    "mesh_nodes": (put("model", "nodes"), [2500, 5000, 10000, 20000, 40000], 40000),
    "boundary_nodes": (put("model", "boundary_nodes"), [2, 4, 8, 15], 15),
    "fixed_interface_modes": (put("model", "fixed_interface_modes"), [0, 3, 10, 20, 40], 40),
    "highest_frequency": (put("choice", "highest_frequency"), [2.0e4, 5.0e4, 1.0e5, 2.0e5, 1.0e7], 1.0e7),
    "bars": (put("scene", "lining.bars"), [300, 1000, 3000, 10000, 30000, 100000], 100000),
    "stress_instants": (put("choice", "snapshots_per_revolution"), [8, 31, 62, 248], 248),
    "stress_region": (put("model", "stress_region"), ["submesh", "whole"], "whole"),
    "friction_form": (put("scene", "friction.form"), ["constant", "vector"], "constant"),
}
"""Parameter -> what a value of it changes in the base case, and the values and reference of a run without any of its own."""


class PlaceSection(Section):
    """Neighbouring speeds, as shares of the Campbell speed."""

    first: float = Field(ge=0.01, le=100, description="Lowest share")
    last: float = Field(ge=0.01, le=100, description="Highest share")
    speeds: int = Field(ge=1, le=1000, description="Number of speeds, evenly spaced")

    def _check(self) -> None:
        if self.last < self.first or (self.last == self.first and self.speeds > 1):
            raise refused(("last",), f"{self.last:g}", f"more than first ({self.first:g})")


class Places(Section):
    """Where the errors are measured."""

    peak: PlaceSection = PlaceSection(first=1.0, last=1.02, speeds=5)
    jump: PlaceSection = PlaceSection(first=1.024, last=1.044, speeds=5)
    off_resonance: PlaceSection = PlaceSection(first=0.9, last=0.92, speeds=3)

    @property
    def shares(self) -> dict[str, list[float]]:
        """Speeds of each place, as shares of the Campbell speed."""
        return {name: np.linspace(place.first, place.last, place.speeds).tolist() for name, place in self}

    @property
    def every_share(self) -> list[float]:
        """Speeds of all places, which may share some, ascending."""
        return sorted({share for shares in self.shares.values() for share in shares})


class TradeoffSection(TrialsSection):
    """Error and cost of every approximation (snakemake tradeoff)."""

    places: Places = Places()
    parameters: Parameters | LeftOut = left_out("Parameters that are varied; by default all, with values from coarse to fine")


SECTION = ExtensionSection("tradeoff", TradeoffSection, TradeoffSection())


TABLES = {
    "dataset": "<results>/tradeoff.nc",
    "table": "<results>/tradeoff.csv",
    "levels": "<results>/tradeoff_levels.csv",
    "growth": "<results>/tradeoff_growth.csv",
}


def _case(settings: Settings, parameter: str, value: Any, scene: str) -> Case | str:
    base, chosen = BaseCase(settings, SECTION), settings.scenes[scene]
    assert base.blade is not None
    results = (
        *("energy", "spectrum"),
        *(() if settings.blades[base.blade].is_matrices else ("stress", "instants")),
        *(result for result in settings.results_of(base.blade, scene) if result == "static_stress"),
        *(["wear"] if chosen.scene.lined else []),
    )
    changes, level = _changes(parameter, value), value if parameter == LEVEL else None
    shares = settings.section(SECTION).places.every_share
    return base.case(scene, shares, results, changes if base.has(scene, changes) else {}, level)


def _changes(parameter: str, value: Any) -> dict[str, dict[str, Any]]:
    return {} if parameter == LEVEL else PARAMETERS[parameter][0](value)


def varied(settings: Settings) -> dict[str, Parameter[Any]]:
    """The parameters that are varied, with the values that can be run; none without a blade or a scene."""
    entries = {}
    scenes = BaseCase(settings, SECTION).scenes
    for name, entry in _wanted(settings).items() if scenes else ():
        possible = [value for value in entry.values if isinstance(_case(settings, name, value, scenes[0]), Case)]
        if len(possible) > 1:
            reference = entry.reference if entry.reference in possible else possible[-1]
            entries[name] = entry.model_copy(update={"values": possible, "reference": reference})
    return entries


def _wanted(settings: Settings) -> dict[str, Parameter[Any]]:
    levels = list(settings.levels)
    defaults = {LEVEL: (levels, levels[-1])} | {name: parts for name, (_, *parts) in PARAMETERS.items()}
    usual = {name: {"values": values, "reference": reference} for name, (values, reference) in defaults.items()}
    parameters: Parameters = settings.section(SECTION).parameters or Parameters.model_validate(usual)
    return parameters.varied()


def cases(settings: Settings) -> dict[str, Case | str]:
    """One case for each value of each parameter in each scene."""
    return {
        f"{name}/{_text(value)}__{scene}": _case(settings, name, value, scene)
        for name, entry in settings.made(varied).items()
        for value in entry.values
        for scene in BaseCase(settings, SECTION).scenes
    }


def _text(value: float | str) -> str:
    """A parameter's value as it stands in file names."""
    return value if isinstance(value, str) else exact_text(value)


def not_varied(settings: Settings) -> str:
    """The parameters that are wanted and not varied, and why; empty where all of them are."""
    base, wanted, too_few = BaseCase(settings, SECTION), _wanted(settings), "fewer than two of their values can be run"
    missing = [name for name in wanted if name not in settings.made(varied)] if base.blade else []
    reasons = {name: base.lacking(_changes(name, wanted[name].reference)) or too_few for name in missing}
    # what a blade of another program has as it is comes first
    several = sorted(set(reasons.values()), key=lambda why: why == too_few)
    return "; ".join(f"{', '.join(name for name in missing if reasons[name] == why)}, because {why}" for why in several)


def values(settings: Settings, members: Mapping[Pair, int]) -> dict[str, Any]:
    """Places of the speeds, reference values, and what the tables and the dataset report of the run."""
    places, base = settings.section(SECTION).places, BaseCase(settings, SECTION)
    rows = {name: [places.every_share.index(share) for share in shares] for name, shares in places.shares.items()}
    return {
        "places": rows,
        "references": {name: _text(entry.reference) for name, entry in settings.made(varied).items()},
        "tolerance": settings.config.tolerance,
        "about_run": {"blade": base.blade, "base_level": base.level, "left_out": not_varied(settings)},
    }


def can_be_run(settings: Settings) -> None:
    """Blade, scenes and levels are there, and stress instants are among the samples of a revolution."""
    base, parameters = BaseCase(settings, SECTION), settings.section(SECTION).parameters
    wanted = parameters.varied() if parameters else {}
    base.check_names(wanted[LEVEL].values if LEVEL in wanted else [])
    samples, instants = settings.levels[base.level].time_integration.samples_per_revolution, wanted.get("stress_instants")
    for number, several in enumerate(instants.values if instants else ()):
        if samples % several:
            path = (SECTION.name, "parameters", "stress_instants", "values", number)
            allowed = f"divisors of {samples}, the samples in a revolution of level {base.level}"
            raise settings.documents.config.refusal(path, f"{several}", allowed)


def _once(sweep: Sweep) -> paths.Wildcards:
    return [{}] if sweep.settings.made(varied) else []


EXTENSION = Extension(
    name="tradeoff",
    section=SECTION,
    checks=(can_be_run,),
    targets=lambda sweep: dict.fromkeys(TABLES.values(), _once(sweep)),
    figures=(
        Figure(
            rule="tradeoff_figure",
            name="tradeoff",
            runs=_once,
            draw="r37studies.trials.figures.draw_tradeoff",
            files={"table": TABLES["table"]},
            label="accuracy and cost",
            caption="Error of the normal rms at the peak over the CPU time of a run, for every value of every parameter. Each "
            "is compared with the reference value of its parameter. Stars: fidelity levels.",
        ),
        Figure(
            rule="tradeoff_growth_figure",
            name="tradeoff_growth",
            runs=_once,
            draw="r37studies.trials.figures.draw_growth",
            files={name: TABLES[name] for name in ("table", "growth")},
            label="growth of costs",
            caption="Growth of a cost with a parameter. Dashed: power law, fitted to the more expensive half of the values.",
        ),
        Figure(
            rule="tradeoff_parameter_figure",
            name="tradeoff_{parameter}",
            runs=lambda sweep: paths.of("parameter", sweep.settings.made(varied)),
            draw="r37studies.trials.figures.draw_parameter",
            files={"table": TABLES["table"]},
            label="{parameter}",
            caption="One parameter varied. Above: relative errors of the means over the speeds at the peak, against the "
            "reference value. Below: CPU time of a run.",
            arguments=lambda _: {"parameter": "{parameter}"},
        ),
    ),
    closing="r37studies.trials.tradeoff_tables.closing",
    look_at="<results>/figures/tradeoff.png",
    made_on_request=True,
)
