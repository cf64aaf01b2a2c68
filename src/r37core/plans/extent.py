"""How large a run is: its simulations and their CPU time. Each run begins with it; `r37 check` and `snakemake estimate` say it.

A simulation takes so long for each step, by what the contact acts on, and so long beside its steps.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from statistics import harmonic_mean

from r37core.config import Settings
from r37core.config.settings import length_of_run, most_runs
from r37core.rom.reduction_choice import PATCHES, POINTS

Pair = tuple[str, str]
"""Blade and scene."""

SWEEP = "sweep"
"""The simulations that the pipeline makes itself; those of an extension have its name."""

_OF_COARSE = 1.5
"""Adaptive speeds that are run as a rule, in coarse ones, where windows ask for more than the largest share of the grid."""

_STEP_S = {POINTS: 1.8e-7, PATCHES: 7e-7}
"""CPU time (s) of a step, by what the contact acts on."""

_REVOLUTION_S = 5e-5
"""CPU time (s) of the stress and statistic of a revolution."""

_SIMULATION_S, JOB_S = 0.02, 0.05
"""CPU time (s) of a simulation beside its revolutions, and of its job where it has one of its own."""

_MODEL_S, _NODE_S = 4.0, 2.1e-3
"""CPU time (s) of a blade's model, and more of it for each node of its mesh."""

_PAIR_S, _RUN_S = 4.0, 20.0
"""CPU time (s) of the datasets and pictures of a blade and scene, and of what a run has once."""

_SETTLED = 0.7
"""Share of the longest run that is run as a rule where a run ends as soon as it has settled."""


@dataclass(frozen=True)
class Runs:
    """Simulations of a blade and scene: their `number` as a rule, and the `fewest` where results ask for more.

    `length`: that of all together, in simulations of the sweep, where it is not their number. `models`: number of blade models
    that are made for them.
    """

    number: float
    fewest: float | None = None
    length: float = 0.0
    models: float = 0.0


Extent = Mapping[str, Mapping[Pair, Runs]]
"""Simulations of each part of a run: SWEEP, and extensions that have some."""


def extent_of(settings: Settings, further: Extent) -> Extent:
    """The extent of a run: that of its sweep, and `further` simulations of extensions."""
    sweep = {}
    for pair, plan in settings.speed_plans.items():
        certain = len(plan.certain)
        sweep[pair] = Runs(max(most_runs(settings, *pair), _OF_COARSE * certain), certain) if plan.refined else Runs(certain)
    return {SWEEP: sweep, **{name: runs for name, runs in further.items() if runs}}


def number_of(extent: Extent) -> int:
    """Number of simulations, as a rule."""
    return round(sum(runs.number for several in extent.values() for runs in several.values()))


def sizes(settings: Settings, extent: Extent) -> list[str]:
    """Number of simulations of each part, and the CPU time of all with models and pictures, as lines."""
    parts, seconds = [], fixed_seconds(settings, extent)
    for name, several in extent.items():
        number = sum(runs.number for runs in several.values())
        fewest = sum(runs.number if runs.fewest is None else runs.fewest for runs in several.values())
        as_asked = f"{name} about {number:.0f}, as results ask ({fewest} at least)"
        parts.append(f"{name} {number}" if fewest == number else as_asked)
        seconds += sum((runs.length or runs.number) * simulation_seconds(settings, pair) for pair, runs in several.items())
        seconds += JOB_S * number if name == SWEEP else 0.0
    time = f"CPU time: about {seconds / 60.0:.1f} minutes; as measured on blades of yours: snakemake estimate"
    return [f"simulations: {', '.join(parts)}", time]


def fixed_seconds(settings: Settings, extent: Extent) -> float:
    """CPU time (s) beside the simulations: models, datasets, pictures, and what a run has once."""
    made = sum(runs.models for several in extent.values() for runs in several.values())
    models = (len(settings.blades) + made) * (_MODEL_S + settings.fidelity.mesh.nodes * _NODE_S)
    return _RUN_S + _PAIR_S * len(settings.speed_plans) + models


def simulation_seconds(settings: Settings, pair: Pair) -> float:
    """CPU time (s) of a simulation of the sweep of a blade and scene, mean over its speeds."""
    blade, scene = pair
    speeds, choice = settings.speed_plans[pair].certain, settings.integration_choice(blade, scene)
    revolutions = choice.revolutions * (_SETTLED if choice.until_settled else 1.0)
    run = length_of_run(settings, scene, harmonic_mean(speeds), revolutions)
    return _SIMULATION_S + run.steps * _STEP_S[settings.contact_of(blade)] + revolutions * run.blades * _REVOLUTION_S
