"""Named calls of many runs: blades compared, designs of a family, uncertain numbers, a search for designs, whole rotors."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, Unpack

import pandas as pd
import xarray as xr

from r37core.base.varied_number import KINDS, values_of
from r37core.config import ConfigError
from r37core.config.scenes import OF_ONE_BLADE
from r37core.plans.paths import fill
from r37studies.rotors.plan import ROTOR_OF_RUN
from r37studies.search.designs import FOLDER
from r37studies.search.plan import DATASET, TABLE
from r37studies.search.section import SearchSection
from r37studies.tolerances.members import ToleranceSection

from .arguments import Speeds, keys_of_its_own, mapping, plain_value, speed_keys
from .call_settings import base_of, call_of, chosen_blade, chosen_scene, names_of_their_own, several
from .choices import BladeChoice, SceneChoice
from .run_results import RunResults
from .runs import Blades, RunOptions, Scenes, SweepOptions, named_call, run, run_of
from .stages import checked_call, checked_call_of


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
    largest_share: float


class SearchOptions(SweepOptions, total=False):
    """Options of `search`."""

    constraints: Mapping[str, Any] | None
    designs: int
    first: int
    batch: int
    method: str
    seed: int
    tolerances: Mapping[str, Any] | None


@checked_call
def compare(blades: Blades, scenes: Scenes, speeds: Speeds | None = None, **options: Unpack[SweepOptions]) -> RunResults:
    """Several blades in several scenes: their responses, and a ranking by robustness.

    Returns:
        As of `r37.open_results`: the datasets campbell, rms, stress and others, `ranking`, `summary` and each `response`.

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
def compare_measured(
    blade: BladeChoice | str,
    scene: SceneChoice | str,
    measured: Mapping[str, Any] | Sequence[Mapping[str, Any]],
    **options: Unpack[RunOptions],
) -> pd.DataFrame:
    """Measured points beside what simulations of the same speeds give, as in measured.csv of a run.

    Args:
        measured: Entries of the section `measured`, without blade and scene: `{"file": "tip.csv", "quantity":
            "displacement_tangential"}`. The file may be a DataFrame.

    Returns:
        A row for each point, with the uncertainty of both values, and their difference over it.

    Raises:
        ConfigError: For bad input, and a file that fits no quantity.

    Examples:
        >>> import pandas as pd
        >>> table = pd.DataFrame({"speed_rad_s": [1150.0], "amplitude (mm)": [1.0]})
        >>> rubbed = {"file": table, "quantity": "displacement_tangential", "uncertainty_percent": 10}
        >>> r37.compare_measured("Ref", "abradable", rubbed, fidelity="draft")["unit"].tolist()
        ['m']
    """
    config = options.get("config")
    chosen = chosen_blade(blade, config)
    named = {"blade": chosen.name, "scene": chosen_scene(scene, base_of([chosen], config)).name}
    entries = [measured] if isinstance(measured, Mapping) else measured
    keys = [{**named, **mapping(entry, "measured", "an entry of the section measured")} for entry in entries]
    return run(blade, scene, measured=keys, targets="measured_table", **options).tables["measured"]


@checked_call_of(ToleranceSection)
def tolerances(blades: Blades, scenes: Scenes, speeds: Speeds | None = None, **options: Unpack[ToleranceOptions]) -> RunResults:
    """Effect of uncertain numbers: the results of a sample of members that is drawn from their distributions.

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
    section = keys_of_its_own(options, SweepOptions)
    return run_of(named_call("r37.tolerances", blades, scenes, speeds, options, {"tolerances": section}), options)


@checked_call_of(SearchSection)
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

    Returns:
        The dataset and the table search: every design and the start. Its method `best_values` has the values of the best
        design, for `r37.blade`, and `best_scene_values` those for `r37.scene`.

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
    call = named_call("r37.search", blade, scenes, speeds, options)
    (chosen,) = call.blades
    section = {"blade": chosen.name, "variables": plain_value(variables), "objectives": plain_value(objectives)}
    section |= keys_of_its_own(options, SweepOptions)
    return run_of(replace(call, keys={FOLDER: section, **call.keys}), options, (DATASET, TABLE))


@checked_call
def rotor(
    blade: BladeChoice | str,
    scene: SceneChoice | str,
    speeds: Speeds | None = None,
    *,
    rotor: Mapping[str, Any] | None = None,
    **options: Unpack[SweepOptions],
) -> xr.Dataset:
    """Response of all blades of a rotor in a scene at several speeds, as in rotor.nc of a run.

    All blades wear one lining.

    Args:
        rotor: The section `rotor` of the scene, in the units of its keys:
            `{"blades": 36, "mistuning_spread_percent": {"normal": 1}}`. It may be left out for a scene that has a rotor.
            Otherwise the scene's keys stay where this has none of them.
        results: Results to compute, in place of the scene's list. By default, where `rotor` is given, it is that list
            without `signal` and `shapes`, which are of a single blade.

    Returns:
        By ascending speed. `blade_rms` (m) of the leading edge's displacement, normal and tangential together,
        `blade_max_von_mises_ever` (Pa) and `blade_share_of_revolutions_above_yield`, shape (speed, blade_number).
        `blade_maximum` (m), shape (speed, blade_number, span), largest over spans of revolutions. `leader`, shape (speed,),
        number of the blade with the largest `blade_rms`. `nodal_diameter_share`, shape (speed, nodal_diameter), and others.

    Raises:
        ConfigError: For bad input, and for a scene without a rotor.
        ValueError: For an impossible shape, mesh, model or time step.

    Examples:
        >>> mistuned = {"blades": 3, "mistuning_percent": {2: 1.0}}
        >>> all_blades = r37.rotor("Ref", "abradable", [1150, 1550], rotor=mistuned, fidelity="draft")
        >>> all_blades.blade_rms.sizes["blade_number"]
        3
        >>> all_blades.leader.sel(speed=1550).item() in (1, 2, 3)
        True
    """
    call = call_of("r37.rotor", [blade], [scene], speed_keys(speeds, options.get("speeds_rpm")), options)
    (single,), results = call.scenes, options.get("results")
    if rotor is not None:
        if results is None:
            results = [result for result in single.entry.results if result not in OF_ONE_BLADE]
        all_blades = replace(single, changes={**single.changes, "rotor": rotor})
        call = replace(call, scenes=[chosen_scene(all_blades, call.base, results)])
    elif single.entry.rotor is None:
        raise ConfigError(f'scene: found {single.label}, without a rotor; allowed: one with it, or rotor={{"blades": 36}}')
    names = {"blade": call.blades[0].name, "scene": single.name}
    return run_of(call, options, fill(ROTOR_OF_RUN, **names)).rotor(**names).assign_attrs(call.told)
