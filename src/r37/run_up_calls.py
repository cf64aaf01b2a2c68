"""The calls of runs whose speed changes while the blade rubs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import xarray as xr

from r37core.config import ConfigError
from r37core.dataset_file import read_dataset
from r37core.io import Named, scratch_folder
from r37core.run_ups.plan import RUN_UP, RunUps

from .arguments import mapping
from .calculation import Calculation
from .call_settings import base_of, chosen_blade, chosen_scene, level, settings_of
from .checked import checked_call
from .choices import BladeChoice, SceneChoice
from .jobs import check_cores, in_parallel
from .simulations import remarks_of, tell

_DATASET = "<results>/run_ups.nc"


@checked_call
def run_up(
    blade: BladeChoice | str,
    scene: SceneChoice | str,
    *,
    from_rad_s: float | None = None,
    to_rad_s: float | None = None,
    from_rpm: float | None = None,
    to_rpm: float | None = None,
    crossing: Mapping[str, Any] | None = None,
    rate_rad_s2: float | None = None,
    rate_rpm_s: float | None = None,
    revolutions: float | None = None,
    revolutions_before: int | None = None,
    revolutions_after: int | None = None,
    lining: str | None = None,
    fidelity: str | None = None,
    results: Sequence[str] | None = None,
    config: Path | str | None = None,
) -> xr.Dataset:
    """A run-up, or run-down, of a blade in a scene, as a run of run_ups.nc.

    Parameters
    ----------
    blade, scene
        Names, or what `r37.blade` and `r37.scene` give.
    from_rad_s, to_rad_s
        First and last speed (rad/s); a lower last one makes a run-down.
    from_rpm, to_rpm
        The same in revolutions per minute.
    crossing
        In place of speeds: about a crossing of the blade's own Campbell diagram, so far above it as shares of its speed, as in
        `{"mode": "1B", "engine_order": 4, "first": -0.015, "last": 0.07}`.
    rate_rad_s2, rate_rpm_s, revolutions
        How fast the speed changes, or how many revolutions that takes. One of them is given.
    revolutions_before, revolutions_after
        At the first speed, in which the casing becomes lobed, and at the last one.
    lining
        "new", or "worn" by the same run-up, done once before.
    fidelity, results, config
        As of `r37.simulate`.

    Returns
    -------
    Dataset
        Over `revolution`: `speed` (rad/s), `maximum_normal` (m), `max_von_mises` (Pa) and others.

    Raises
    ------
    ConfigError
        For bad input. A crossing that is not there raises a ValueError of its own.

    Examples
    --------
    >>> run = r37.run_up("Ref", "abradable", from_rad_s=1540, to_rad_s=1560, revolutions=4, fidelity="draft")
    >>> bool(run.speed[-1] > run.speed[0])
    True
    """
    asked = {
        "from_rad_s": from_rad_s,
        "to_rad_s": to_rad_s,
        "from_rpm": from_rpm,
        "to_rpm": to_rpm,
        "crossing": crossing,
        "rate_rad_s2": rate_rad_s2,
        "rate_rpm_s": rate_rpm_s,
        "revolutions": revolutions,
        "revolutions_before": revolutions_before,
        "revolutions_after": revolutions_after,
        "lining": lining,
    }
    entry = {key: value for key, value in asked.items() if value is not None}
    return _run_ups("r37.run_up", blade, scene, {"run_up": entry}, fidelity, results, config, 1).isel(run=0)


@checked_call
def run_ups(
    blade: BladeChoice | str,
    scene: SceneChoice | str,
    several: Mapping[str, Mapping[str, Any]],
    *,
    fidelity: str | None = None,
    results: Sequence[str] | None = None,
    config: Path | str | None = None,
    cores: int = 1,
) -> xr.Dataset:
    """Several run-ups of a blade in a scene, as run_ups.nc of a run.

    Parameters
    ----------
    blade, scene
        Names, or what `r37.blade` and `r37.scene` give.
    several
        Name -> what `r37.run_up` takes of it, as under run_ups of config.yaml.
    fidelity, results, config
        As of `r37.simulate`.
    cores
        Run-ups that run at once, in processes of their own. The numbers do not depend on it.

    Returns
    -------
    Dataset
        Over `run` and `revolution`, with the coordinates `run_up` (name), `blade` and `scene`.

    Raises
    ------
    ConfigError
        For bad input. A crossing that is not there raises a ValueError of its own.

    Examples
    --------
    >>> speeds = {"from_rad_s": 1540, "to_rad_s": 1560}
    >>> both = {"slow": {**speeds, "revolutions": 4}, "fast": {**speeds, "revolutions": 2}}
    >>> r37.run_ups("Ref", "abradable", both, fidelity="draft").run_up.values.tolist()
    ['slow', 'fast']
    """
    if not isinstance(several, Mapping) or not several:
        raise ConfigError(f"run_ups: found {several!r}; allowed: names and what each run-up is")
    return _run_ups("r37.run_ups", blade, scene, several, fidelity, results, config, cores)


def _run_ups(
    caller: str,
    blade: BladeChoice | str,
    scene: SceneChoice | str,
    several: Mapping[str, Mapping[str, Any]],
    fidelity: str | None,
    results: Sequence[str] | None,
    config: Path | str | None,
    cores: int,
) -> xr.Dataset:
    chosen, base = chosen_blade(blade, config), base_of(blade, config)
    rubs_on = chosen_scene(scene, base, results)
    check_cores(cores)
    entries = {name: mapping(entry, f"run_ups.{name}", "the keys of a run-up") for name, entry in several.items()}
    # a run-up's own speeds are checked by its section
    first_speed = {"speeds": [base.checked.structure.maximum_speed_rad_s]}
    keys = {"run_ups": entries, **first_speed, **level(fidelity)}
    settings = settings_of(caller, base, [chosen], [rubs_on], keys)
    tell(remarks_of(settings))
    with scratch_folder() as folder:
        dataset = _dataset(Calculation(settings, folder, cores))
    labels = {"blade": chosen.label, "scene": rubs_on.label}
    coordinates = {name: ("run", [label] * dataset.sizes["run"]) for name, label in labels.items()}
    return dataset.assign_coords(coordinates).assign_attrs(chosen.told | rubs_on.told)


def _dataset(calculation: Calculation) -> xr.Dataset:
    """run_ups.nc of the calculation's settings."""
    planned = RunUps(calculation.sweep)
    calculation.models()
    if any(choice.crossing for named in planned.choices.values() for choice in named.values()):
        calculation.campbells()
    runs = [Named(member="", **run) for run in planned.files]
    in_parallel([_run_up(calculation, planned, run) for run in runs], calculation.cores)
    files = [RUN_UP.format(**vars(run)) for run in runs]
    calculation.step(
        "run_ups.steps.join",
        {"run_ups": files},
        {"dataset": _DATASET},
        runs=planned.runs,
        fidelity=calculation.settings.fidelity_name,
    )
    return read_dataset(calculation.path(_DATASET))


def _run_up(calculation: Calculation, planned: RunUps, run: Named) -> Any:
    inputs = {key: file for key, file in planned.inputs(run).items() if key != "prepared"}
    return calculation.task(
        "run_ups.steps.record",
        inputs,
        {"run_up": RUN_UP.format(**vars(run))},
        name=run.run_up,
        scene=calculation.simulations.plain_scene(run),
        choice=planned.choice(run),
        run_up=planned.run_up(run),
        results=planned.results(run),
        highest_order=calculation.settings.fidelity.time_integration.spectrum_highest_order,
        yield_stress=calculation.sweep.yield_stress(run),
        provenance=calculation.made.sweep(run),
    )
