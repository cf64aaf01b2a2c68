"""The call of a search: designs of one blade that are better than it is, proposed round by round."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, Unpack

from r37core.search.designs import FOLDER
from r37core.search.plan import BEST, DATASET, TABLE

from .arguments import Speeds, mapping, plain_value
from .choices import BladeChoice
from .run_results import RunResults
from .runs import Scenes, SweepOptions, named_call, run_of
from .stages import checked_call

_BOUNDS = 'dotted keys of blades.yaml, or scene.KEY of scenes.yaml, and their bounds, as in {"stagger_deg.tip": [-3, 3]}'
_MAPPINGS = {
    "objectives": 'names and what is read off, as in {"lined": {"scenes": ["abradable"]}}',
    "constraints": 'names and what is kept, as in {"mass": {"measure": "mass_kg", "at_most_percent": 100}}',
    "tolerances": 'of_scenes, of_blades and members, as in {"of_scenes": {"friction.coefficient": {"uniform_percent": 5}}}',
}


class SearchOptions(SweepOptions, total=False):
    """Options of `search`."""

    constraints: Mapping[str, Any] | None
    designs: int
    first: int
    batch: int
    method: str
    seed: int
    tolerances: Mapping[str, Any] | None
    best: int


@checked_call
def search(
    blade: BladeChoice | str,
    scenes: Scenes,
    speeds: Speeds | None = None,
    *,
    variables: Mapping[str, Sequence[float]],
    objectives: Mapping[str, Any],
    **options: Unpack[SearchOptions],
) -> RunResults:
    """Search for better designs of a blade, in rounds: each proposes designs from the results of all before.

    Args:
        blade: Start of the search: a blade with profiles by its name, or the result of `r37.blade`; a changed one needs a
            `name`.
        scenes: Names, or the results of `r37.scene`; changed ones need a `name`. Objectives and constraints name those that
            count.
        variables: Dotted key of blades.yaml -> lowest and highest value, as in `{"stagger_deg.tip": [-3, 3],
            "sweep_percent": [0, 100]}`; with `scene.` before it a key of scenes.yaml, as in `{"scene.lining.thickness_m":
            [0.001, 0.005]}`.
        objectives: Name -> a number to minimise: `{"lined": {"scenes": ["abradable"]}}` for the integral over speed of the
            share of revolutions above yield, or another `measure`; with a `quantile` under tolerances.
        constraints: Name -> a limit: `{"first": {"measure": "frequency_hz", "mode": "1B", "at_least_percent": 98}}`.
        designs: Number of designs that are run.
        first: Number of the first designs, which come from a quasi-random sequence.
        batch: Number of designs in a round, which run in parallel.
        method: "surrogate", or "quasi_random" for comparison.
        seed: Seed of the search.
        tolerances: `{"of_scenes": ..., "of_blades": ..., "members": 16}` about every design, for objectives with a
            quantile.
        best: Number of best designs that are written as entries and STEP files.

    Returns:
        The dataset and the table search: every design and the start. Its method `best_values` has the values of the best
        design, for `r37.blade`, and `best_scene_values` those for `r37.scene`; entries of the best are in `folder /
        "search/best"`, with STEP files of blades.

    Raises:
        ConfigError: For bad input, and where the extra package of a search is not installed. A design that cannot be built
            is a result.

    Examples:
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
    own = {name: value for name, value in options.items() if name not in SweepOptions.__annotations__ and value is not None}
    entry = {"objectives": objectives, **own}
    entry |= {name: mapping(entry[name], name, allowed) for name, allowed in _MAPPINGS.items() if name in entry}
    call = named_call("r37.search", blade, scenes, speeds, options)
    (chosen,) = call.blades
    section = {"blade": chosen.name, "variables": mapping(variables, "variables", _BOUNDS), **plain_value(entry)}
    return run_of(replace(call, keys={FOLDER: section, **call.keys}), options, (DATASET, TABLE, BEST))
