"""The call of a search: designs of one blade that are better than it is, proposed round by round."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from r37core.config import plain
from r37core.io import Named, read_json
from r37core.plans import paths
from r37core.search.choice import START
from r37core.search.designs import FOLDER, section
from r37core.search.pareto import best_first, not_dominated
from r37core.search.plan import BEST, BUILT, DATASET, MEASURES, ROUND, SHAPE, TABLE, Search, choice_of
from r37core.search.rounds import SearchRound, read_round

from .arguments import Speeds, mapping, plain_value, speed_keys
from .calculation import Calculation
from .call_settings import chosen_blade, level
from .checked import checked_call
from .choices import BladeChoice
from .jobs import in_parallel
from .run_results import RunResults
from .stages import LOGGER
from .structure_files import Recipe, StructureFiles
from .studies import Scenes, results_of

_BOUNDS = 'dotted keys of blades.yaml and their bounds, as in {"stagger_deg.tip": [-3, 3]}'
_OBJECTIVES = 'names and what is read off, as in {"lined": {"scenes": ["abradable"]}}'
_CONSTRAINTS = 'names and what is kept, as in {"mass": {"measure": "mass_kg", "at_most_percent": 100}}'
_SPREAD = 'of_scenes, of_blades and members, as in {"of_scenes": {"friction.coefficient": {"uniform_percent": 5}}}'


@checked_call
def search(
    blade: BladeChoice | str,
    scenes: Scenes,
    speeds: Speeds | None = None,
    *,
    variables: Mapping[str, Sequence[float]],
    objectives: Mapping[str, Any],
    constraints: Mapping[str, Any] | None = None,
    designs: int = 60,
    first: int = 16,
    batch: int = 4,
    method: str = "surrogate",
    seed: int = 0,
    tolerances: Mapping[str, Any] | None = None,
    best: int = 3,
    speeds_rpm: Speeds | None = None,
    fidelity: str | None = None,
    results: Sequence[str] | None = None,
    config: Path | str | None = None,
    cores: int = 1,
) -> RunResults:
    """Designs of a blade that are better than it is, proposed in rounds by what all designs before them gave.

    Parameters
    ----------
    blade
        What the search starts at: the name of a blade with profiles, or what `r37.blade` gives; a changed one with a `name`.
    scenes
        Names, or what `r37.scene` gives; changed ones with a `name`. Objectives and constraints name those that count.
    variables
        Dotted key of blades.yaml -> lowest and highest value, as in `{"stagger_deg.tip": [-3, 3], "sweep_percent": [0, 100]}`.
    objectives
        Name -> what should be small: `{"lined": {"scenes": ["abradable"]}}` for the length of speed above yield, or another
        `measure`; with a `quantile` under tolerances.
    constraints
        Name -> what is kept: `{"first": {"measure": "frequency_hz", "mode": "1B", "at_least_percent": 98}}`.
    designs
        How many are tried.
    first
        Of these, how many come from a quasi-random sequence, before there is anything to go by.
    batch
        Designs of a round, which are run side by side.
    method
        "surrogate", or "quasi_random" for a yardstick.
    seed
        Another one gives another search.
    tolerances
        `{"of_scenes": ..., "of_blades": ..., "members": 16}` about every design, for objectives with a quantile.
    best
        Designs that are written as entries and as STEP.
    speeds, speeds_rpm, fidelity, results, config, cores
        As of `r37.sweep`.

    Returns
    -------
    RunResults
        The dataset and the table search: every design and the start. Its method `best_values` has the values of the best
        design, for `r37.blade`; entries and STEP files of the best lie in `folder / "search/best"`.

    Raises
    ------
    ConfigError
        For bad input, and where the extra package of a search is not installed. A design that cannot be built is a result.

    Examples
    --------
    >>> turned = {"stagger_deg.tip": [-2, 2]}
    >>> lined = {"lined": {"measure": "largest_rms_m", "scenes": ["abradable"]}}
    >>> results = r37.search(
    ...     "Ref", "abradable", [1150], variables=turned, objectives=lined, designs=3, first=2, batch=1, fidelity="draft"
    ... )
    >>> results.tables["search"].design.tolist()
    ['start', 'd0000', 'd0001', 'd0002']
    >>> r37.blade("Ref", name="Better", **results.best_values()).label
    'Better'
    """
    entry = {
        "variables": mapping(variables, "variables", _BOUNDS),
        "objectives": mapping(objectives, "objectives", _OBJECTIVES),
        "constraints": {} if constraints is None else mapping(constraints, "constraints", _CONSTRAINTS),
        **{"designs": designs, "first": first, "batch": batch, "method": method, "seed": seed, "best": best},
    }
    if tolerances is not None:
        entry["tolerances"] = mapping(tolerances, "tolerances", _SPREAD)
    chosen = chosen_blade(blade, config)
    keys = {FOLDER: {"blade": chosen.name, **plain_value(entry)}, **speed_keys(speeds, speeds_rpm), **level(fidelity)}
    return results_of("r37.search", [chosen], scenes, keys, results, config, cores, _search)


def _search(calculation: Calculation) -> None:
    """All rounds of a search, and what is made of them. Raises what the steps raise."""

    def round_file(number: int) -> str:
        return calculation.path(paths.fill(ROUND, round=number))

    def built_file(number: int) -> str:
        return calculation.path(paths.fill(BUILT, round=number))

    search = Search(calculation.sweep, round_file, built_file)
    for number in (*search.rounds, len(search.rounds)):
        asked = _round(calculation, search, number)
        if not asked.new:
            break
        LOGGER.info("search: round %d, %d design%s", number, len(asked.new), "s" if len(asked.new) > 1 else "")
        _shapes(calculation, search, number, list(asked.new))
        refused = read_json(built_file(number))
        built = [name for name in asked.new if name not in refused]
        _measures(calculation, search, built if number else [START, *built])
    last = Named()
    calculation.step(
        "search.steps.join",
        {"round": search.last_round(last)},
        {"dataset": DATASET, "table": TABLE},
        choice=search.choice(last),
        start=search.start_values(last),
        fidelity=calculation.settings.fidelity_name,
    )
    calculation.step(
        "search.steps.best",
        {"dataset": DATASET, "shapes": search.shapes_of_all(last)},
        {"folder": BEST},
        entries=search.entries(last),
        number=search.number_of_best(last),
    )


def _round(calculation: Calculation, search: Search, number: int) -> SearchRound:
    """A round, as what all before it gave proposes it."""
    at, file = Named(round=number), paths.fill(ROUND, round=number)
    calculation.step(
        "search.steps.propose_round",
        search.round_inputs(at),
        {"round": file},
        choice=search.choice(at),
        round=number,
        number=search.number_of_designs(at),
    )
    asked = read_round(calculation.path(file))
    if asked.tried:
        _tell(search, asked)
    return asked


def _tell(search: Search, asked: SearchRound) -> None:
    """How far the search is, and what is the best so far."""
    choice, entry = choice_of(search.settings), section(search.settings)
    assert entry is not None
    evaluated = [design.evaluated(name, choice, asked.start) for name, design in asked.tried.items()]
    if len(choice.objectives) > 1:
        told = f"{len(not_dominated(evaluated))} that none is better than in all objectives"
    else:
        ((objective, quantity),) = choice.objectives.items()
        ahead = best_first(evaluated)[:1]
        told = "".join(f"best {each.name}, {objective} {each.objectives[0]:.4g} {quantity.unit}" for each in ahead)
    refused = sum(design.refused is not None for design in asked.tried.values())
    cannot = f", {refused} of them cannot be built" if refused else ""
    told = told or "none can be built and keeps all constraints"
    LOGGER.info("search: %d of %d designs%s; %s", len(evaluated), entry.designs, cannot, told)


def _shapes(calculation: Calculation, search: Search, number: int, designs: Sequence[str]) -> None:
    """Which designs of a round can be built."""
    settings = calculation.settings
    tasks = [
        calculation.task(
            "search.steps.shape",
            {},
            {"shape": paths.fill(SHAPE, design=name)},
            shape=search.shape(Named(design=name)),
            edges=settings.structure.edges,
            mesh=plain(settings.fidelity.mesh),
            stress_submesh=search.stress_submesh(Named(design=name)),
        )
        for name in designs
    ]
    in_parallel(tasks, calculation.cores, "shapes", "design")
    calculation.step(
        "search.steps.built", {"shapes": search.shapes(Named(round=number))}, {"built": paths.fill(BUILT, round=number)}
    )


def _structures(of_designs: Calculation) -> None:
    """What designs are judged by that is no simulation."""
    settings, wanted = of_designs.settings, dict[str, Recipe]()
    tip_line = settings.structure.boundary.tip_line
    for group in of_designs.groups:
        files, of = StructureFiles(settings, group.blade, of_designs.samples, group.member), vars(group)
        wanted[paths.fill(paths.GEOMETRY, **of)] = files.geometry()
        wanted[paths.fill(paths.CONTACT_MODEL, tip_line=tip_line, **of)] = files.contact_model(tip_line)
        wanted[paths.fill(paths.STRESS_OPERATOR, tip_line=tip_line, **of)] = files.stress_operator(tip_line)
    of_designs.linked(wanted)
    of_designs.campbells()


def _measures(calculation: Calculation, search: Search, designs: Sequence[str]) -> None:
    """Models, simulations and measures of designs that can be built."""
    if not designs:
        return
    of_designs = replace(calculation, only=tuple(f"{FOLDER}/{name}" for name in designs))
    _structures(of_designs)
    of_designs.responses()
    tasks = [
        calculation.task(
            "search.steps.measure",
            search.measured(at),
            {"measures": paths.fill(MEASURES, design=at.design)},
            quantities=search.quantities(at),
            scenes=search.responses_of_scenes(at),
            density=search.density(at),
            highest_speed=calculation.settings.structure.maximum_speed_rad_s,
        )
        for at in (Named(design=name) for name in designs)
    ]
    in_parallel(tasks, calculation.cores)
