"""Named calls of many runs: blades compared, designs of a family, and numbers that are not known exactly."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, Unpack

import pandas as pd

from r37core.base.varied_number import KINDS, values_of
from r37core.config import ConfigError

from .arguments import Speeds, mapping, plain_value, speed_keys
from .call_settings import call_of, names_of_their_own, several
from .choices import BladeChoice, SceneChoice
from .run_results import RunResults
from .runs import Blades, Scenes, SweepOptions, named_call, run_of
from .stages import checked_call

_SPREAD = 'dotted keys and how each spreads, as in {"friction.coefficient": {"uniform_percent": 5}}'


class DesignOptions(SweepOptions, total=False):
    """Options of `designs`."""

    combine: str
    name: str
    operating: Mapping[str, Any]
    requirements: Mapping[str, Any]


class ToleranceOptions(SweepOptions, total=False):
    """Options of `tolerances`."""

    of_scenes: Mapping[str, Any]
    of_blades: Mapping[str, Any]
    members: int
    seed: int
    sensitivity: bool
    largest_share: float


@checked_call
def compare(blades: Blades, scenes: Scenes, speeds: Speeds | None = None, **options: Unpack[SweepOptions]) -> RunResults:
    """Several blades in several scenes: their responses, and a ranking by robustness.

    Returns:
        As of `r37.open_results`: the datasets campbell, rms, stress and others, `ranking`, `summary` and each `response`.

    Raises:
        ConfigError, ValueError: As of `r37.run`.

    Examples:
        >>> results = r37.compare(["Ref", "CS100"], "abradable", [1150, 1550], fidelity="draft")
        >>> sorted(results.ranking.blade)
        ['CS100', 'Ref']
    """
    return run_of(named_call("r37.compare", blades, scenes, speeds, options), options)


@checked_call
def designs(
    blade: BladeChoice | str,
    scenes: Scenes,
    speeds: Speeds | None = None,
    *,
    vary: Mapping[str, Any] | pd.DataFrame,
    **options: Unpack[DesignOptions],
) -> RunResults:
    """Families of designs: one blade, or scenes, or both, with values that vary, and how robust each design is.

    Args:
        vary: Key of blades.yaml -> values, or `{"start": 0, "stop": 100, "step": 25}`, as under vary of a family. Keys that
            begin with `scene.` are of scenes.yaml, such as `scene.casing.clearance_m`: each scene becomes a family. Or a
            DataFrame: a design of the blade in each row, its name in the column `blade`, its values under their keys.
        combine: "grid" for all combinations of several keys (the default), or "pairs" for the first values together, then
            the second; of blade and of scene each. Every design of the blade meets every scene.
        name: Name of the family, by default `Design`. A design is called after its values: `Design_50`. A scene's family is
            called after the scene: `direct-varied_0p0003`.
        operating, requirements: Sections of config.yaml, as of `r37.run`: with both there is `tables["verdict"]`.

    Returns:
        As of `r37.compare`, and `tables["designs"]`: a row for each design and scene.

    Raises:
        ConfigError: For bad input, and a blade without profiles.
        ValueError: For an impossible shape, and as of `r37.run`.

    Examples:
        >>> results = r37.designs("S100", "abradable", [1150], vary={"sweep_percent": [50, 100]}, fidelity="draft")
        >>> results.tables["designs"].blade.tolist()
        ['Design_50', 'Design_100']
    """
    if isinstance(vary, pd.DataFrame):
        entry: dict[str, Any] = {"designs": vary}
        scene_entry: dict[str, Any] = {}
    else:
        example = 'keys of blades.yaml and their values, as in {"sweep_percent": [50, 100]}'
        varied, combine = mapping(vary, "vary", example), options.get("combine", "grid")
        if not varied:
            raise ConfigError(f"vary: found nothing that varies; allowed: {example}")
        families = (values_of(kind, varied) for kind in KINDS)
        entry, scene_entry = ({"vary": values, "combine": combine} if values else {} for values in families)
    sections = {key: plain_value(section) for key, section in options.items() if key in ("operating", "requirements")}
    keys = {**speed_keys(speeds, options.get("speeds_rpm")), **sections}
    call = call_of("r37.designs", [blade], several(scenes, SceneChoice), keys, options)
    names_of_their_own(call.scenes)
    if entry:
        call = replace(call, blades=[chosen.family(options.get("name", "Design"), entry) for chosen in call.blades])
    if scene_entry:
        call = replace(call, scenes=[scene.family(f"{scene.name}-varied", scene_entry) for scene in call.scenes])
    return run_of(call, options)


@checked_call
def tolerances(blades: Blades, scenes: Scenes, speeds: Speeds | None = None, **options: Unpack[ToleranceOptions]) -> RunResults:
    """Effect of uncertain numbers: the results of a sample of members that is drawn from their distributions.

    Args:
        of_scenes, of_blades: Dotted key -> distribution of the number, as in `{"friction.coefficient": {"uniform_percent":
            5}}`.
        members: Number of members, a power of two.
        seed: Seed of the sample.
        sensitivity: Whether Sobol indices are computed. For n numbers this runs n + 2 times the members.
        largest_share: Largest share of the finest grid of adaptive speeds that a member runs.

    Returns:
        As of `r37.compare`, with the dataset and the table tolerances, and with ranges in `summary`.

    Raises:
        ConfigError: For bad input, and for an impossible member.

    Examples:
        >>> spread = {"casing.clearance_m": {"uniform_percent": 2}}
        >>> results = r37.tolerances("Ref", "abradable", [1150], of_scenes=spread, members=2, fidelity="draft")
        >>> results["tolerances"].sizes["member"]
        2
    """
    section = {name: plain_value(value) for name, value in options.items() if name not in SweepOptions.__annotations__}
    for name in ("of_scenes", "of_blades"):
        section[name] = mapping(section.get(name, {}), name, _SPREAD)
    return run_of(named_call("r37.tolerances", blades, scenes, speeds, options, {"tolerances": section}), options)
