"""The calls of many runs: blades compared, designs of a family, and numbers that are not known exactly."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from r37core.io import temporary_folder

from .arguments import Speeds, mapping, plain_value, sequence_of, speed_keys
from .calculation import Calculation
from .call_configuration import read_configuration
from .call_settings import chosen_blade, chosen_scene, level, names_of_their_own, settings_of
from .checked import checked_call
from .choices import BladeChoice, SceneChoice
from .jobs import check_cores
from .run_results import RunResults
from .run_tables import make_tables
from .simulations import remarks_of, tell

Blades = BladeChoice | str | Sequence[BladeChoice | str]
Scenes = SceneChoice | str | Sequence[SceneChoice | str]

_SPREAD = 'dotted keys and how each spreads, as in {"friction.coefficient": {"uniform_percent": 5}}'


@checked_call
def compare(
    blades: Blades,
    scenes: Scenes,
    speeds: Speeds | None = None,
    *,
    speeds_rpm: Speeds | None = None,
    fidelity: str | None = None,
    results: Sequence[str] | None = None,
    config: Path | str | None = None,
    cores: int = 1,
) -> RunResults:
    """Several blades in several scenes: which is the most robust, and what the workflow makes of their responses.

    Parameters
    ----------
    blades, scenes
        Names, or what `r37.blade` and `r37.scene` give; changed ones with a `name`.
    speeds, speeds_rpm, fidelity, results, config, cores
        As of `r37.sweep`.

    Returns
    -------
    RunResults
        As of `r37.open_results`: the datasets campbell, rms, stress and others, `ranking`, `summary` and each `response`.

    Raises
    ------
    ConfigError
        For bad input. A shape, mesh, model or time step that is impossible raises a ValueError of its own.

    Examples
    --------
    >>> results = r37.compare(["Ref", "CS100"], "abradable", [1150, 1550], fidelity="draft")
    >>> sorted(results.ranking.blade)
    ['CS100', 'Ref']
    """
    keys = {**speed_keys(speeds, speeds_rpm), **level(fidelity)}
    return results_of("r37.compare", _chosen(blades, config), scenes, keys, results, config, cores)


@checked_call
def designs(
    blade: BladeChoice | str,
    scenes: Scenes,
    speeds: Speeds | None = None,
    *,
    vary: Mapping[str, Any],
    combine: str = "grid",
    name: str = "Design",
    speeds_rpm: Speeds | None = None,
    fidelity: str | None = None,
    results: Sequence[str] | None = None,
    config: Path | str | None = None,
    cores: int = 1,
) -> RunResults:
    """A family of designs: one blade with values that vary, and how robust each design is.

    Parameters
    ----------
    blade
        What the designs start from: a name, or what `r37.blade` gives.
    scenes
        Names, or what `r37.scene` gives; changed ones with a `name`.
    vary
        Key of blades.yaml -> values, or `{"start": 0, "stop": 100, "step": 25}`, as under vary of a family.
    combine
        "grid" for all combinations of several keys, "pairs" for one value of each after the other.
    name
        Of the family; a design is called `Design_50` after its values.
    speeds, speeds_rpm, fidelity, results, config, cores
        As of `r37.sweep`.

    Returns
    -------
    RunResults
        As of `r37.compare`, and `tables["designs"]`: a row for each design and scene.

    Raises
    ------
    ConfigError
        For bad input, and a blade without profiles. A shape that is impossible raises a ValueError of its own.

    Examples
    --------
    >>> results = r37.designs("S100", "abradable", [1150], vary={"sweep_percent": [50, 100]}, fidelity="draft")
    >>> results.tables["designs"].blade.tolist()
    ['Design_50', 'Design_100']
    """
    varied = mapping(vary, "vary", 'keys of blades.yaml and their values, as in {"sweep_percent": [50, 100]}')
    family = chosen_blade(blade, config).family(name, varied, combine)
    keys = {**speed_keys(speeds, speeds_rpm), **level(fidelity)}
    return results_of("r37.designs", [family], scenes, keys, results, config, cores)


@checked_call
def tolerances(
    blades: Blades,
    scenes: Scenes,
    speeds: Speeds | None = None,
    *,
    of_scenes: Mapping[str, Any] | None = None,
    of_blades: Mapping[str, Any] | None = None,
    members: int = 32,
    seed: int = 0,
    sensitivity: bool = False,
    largest_share: float = 0.2,
    speeds_rpm: Speeds | None = None,
    fidelity: str | None = None,
    results: Sequence[str] | None = None,
    config: Path | str | None = None,
    cores: int = 1,
) -> RunResults:
    """Numbers that are not known exactly: what members of a sample give that is drawn of them.

    Parameters
    ----------
    blades, scenes
        Names, or what `r37.blade` and `r37.scene` give; changed ones with a `name`.
    of_scenes, of_blades
        Dotted key -> how the number spreads, as in `{"friction.coefficient": {"uniform_percent": 5}}`.
    members
        How many are drawn, a power of two.
    seed
        Another one gives another sample.
    sensitivity
        Sobol indices, which take as many members again for each number, and once more.
    largest_share
        Of the finest grid of adaptive speeds that is run at most, by every member.
    speeds, speeds_rpm, fidelity, results, config, cores
        As of `r37.sweep`.

    Returns
    -------
    RunResults
        As of `r37.compare`, with the dataset and the table tolerances, and with ranges in `summary`.

    Raises
    ------
    ConfigError
        For bad input, and a member that is impossible.

    Examples
    --------
    >>> spread = {"casing.clearance_m": {"uniform_percent": 2}}
    >>> results = r37.tolerances("Ref", "abradable", [1150], of_scenes=spread, members=2, fidelity="draft")
    >>> results["tolerances"].sizes["member"]
    2
    """
    section = {
        "of_scenes": {} if of_scenes is None else mapping(of_scenes, "of_scenes", _SPREAD),
        "of_blades": {} if of_blades is None else mapping(of_blades, "of_blades", _SPREAD),
        "members": plain_value(members),
        "seed": plain_value(seed),
        "sensitivity": sensitivity,
        "largest_share": largest_share,
    }
    keys = {"tolerances": section, **speed_keys(speeds, speeds_rpm), **level(fidelity)}
    return results_of("r37.tolerances", _chosen(blades, config), scenes, keys, results, config, cores)


def _chosen(blades: Blades, config: Path | str | None) -> list[BladeChoice]:
    several = sequence_of(blades, BladeChoice | str, "blades", "the name of a blade, or what r37.blade gives")
    return [chosen_blade(blade, config) for blade in several]


def _all_results(calculation: Calculation) -> None:
    """All that a run ends in, but its pictures."""
    calculation.responses()
    make_tables(calculation)


def results_of(
    caller: str,
    blades: Sequence[BladeChoice],
    scenes: Scenes,
    keys: Mapping[str, Any],
    results: Sequence[str] | None,
    config: Path | str | None,
    cores: int,
    make: Callable[[Calculation], None] = _all_results,
) -> RunResults:
    """What `make` makes of a run of these blades and scenes. Remarks point at the line that called the caller of this."""
    check_cores(cores)
    base = blades[0].configuration if config is None else read_configuration(config)
    several = sequence_of(scenes, SceneChoice | str, "scenes", "the name of a scene, or what r37.scene gives")
    rubs_on = [chosen_scene(scene, base, results) for scene in several]
    names_of_their_own(blades)
    names_of_their_own(rubs_on)
    settings = settings_of(caller, base, blades, rubs_on, keys)
    tell(remarks_of(settings))
    folder = temporary_folder()
    make(Calculation(settings, Path(folder.name), cores))
    return RunResults(Path(folder.name), folder)
