"""The calls of runs whose speed changes while the blade rubs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import Any, Unpack

import xarray as xr

from r37core.base.dataset_file import read_dataset
from r37core.base.io import Named, scratch_folder
from r37core.config import ConfigError
from r37core.plans.provenance import Provenance
from r37core.plans.sweep_plan import Sweep
from r37core.sweep.blade_sweep import CAMPBELL
from r37core.sweep.recipe import run_step
from r37studies.run_ups.dataset import write_run_ups
from r37studies.run_ups.plan import RunUps
from r37studies.run_ups.section import RunUpEntry

from .arguments import keys_of_its_own, plain_value
from .calculation import Calculation
from .call_settings import Call, OneOptions, call_of
from .choices import BladeChoice, SceneChoice
from .jobs import parallel_results
from .runs import RunOptions, run_of
from .stages import checked_call, checked_call_of

_STAGES = {"model": "contact_model", "stress": "stress_operator", "campbell": CAMPBELL}
"""Input of a run-up -> stage of the structure."""


class RunUpOptions(OneOptions, total=False):
    """Options of `run_up`: keys of a run-up, and those of other calls of one blade."""

    from_rad_s: float
    to_rad_s: float
    from_rpm: float
    to_rpm: float
    crossing: Mapping[str, Any]
    rate_rad_s2: float
    rate_rpm_s: float
    revolutions: float
    revolutions_before: int
    revolutions_after: int
    lining: str


@checked_call_of(RunUpEntry)
def run_up(blade: BladeChoice | str, scene: SceneChoice | str, **options: Unpack[RunUpOptions]) -> xr.Dataset:
    """Run-up, or run-down, of a blade in a scene, as one run of run_ups.nc.

    Returns:
        Over `revolution`: `speed` (rad/s), `maximum_normal` (m), `max_von_mises` (Pa) and others.

    Raises:
        ConfigError: For bad input.
        ValueError: For a crossing that is not there, and as of `r37.simulate`.

    Examples:
        >>> run = r37.run_up("Ref", "abradable", from_rad_s=1540, to_rad_s=1560, revolutions=4, fidelity="draft")
        >>> bool(run.speed[-1] > run.speed[0])
        True
    """
    call = _call("r37.run_up", blade, scene, {"run_up": keys_of_its_own(options, OneOptions)}, options)
    call.tell_remarks()
    with scratch_folder() as folder:
        calculation, planned = Calculation(call.settings, folder, 1), RunUps(Sweep(call.settings))
        run = Named(**vars(calculation.run), run_up="run_up")
        inputs = {key: calculation.structure_file(_STAGES[key]) for key in planned.inputs(run) if key in _STAGES}
        stage, file, joined = planned.stage(Provenance(call.settings)), folder / "run_up.npz", folder / "run_ups.nc"
        parallel_results([partial(run_step, stage.step, inputs, {"run_up": file}, stage.values(run))], 1)
        write_run_ups({planned.runs[0]: file}, joined, {"fidelity": call.settings.fidelity_name})
        dataset = read_dataset(joined)
    return _labelled(dataset, call).isel(run=0)


@checked_call
def run_ups(
    blade: BladeChoice | str, scene: SceneChoice | str, several: Mapping[str, Mapping[str, Any]], **options: Unpack[RunOptions]
) -> xr.Dataset:
    """Several run-ups of a blade in a scene, as in run_ups.nc of a run.

    Args:
        several: Name -> arguments of `r37.run_up`, as under run_ups of config.yaml.

    Returns:
        The variables of `r37.run_up`, over `run` and `revolution`, with the coordinates `run_up` (name), `blade` and
        `scene`.

    Raises:
        ConfigError, ValueError: As of `r37.run_up`.

    Examples:
        >>> speeds = {"from_rad_s": 1540, "to_rad_s": 1560}
        >>> both = {"slow": {**speeds, "revolutions": 4}, "fast": {**speeds, "revolutions": 2}}
        >>> r37.run_ups("Ref", "abradable", both, fidelity="draft").run_up.values.tolist()
        ['slow', 'fast']
    """
    if not isinstance(several, Mapping) or not several:
        raise ConfigError(f"run_ups: found {several!r}; allowed: names and what each run-up is")
    call = _call("r37.run_ups", blade, scene, several, options)
    results = run_of(call, options, "<results>/run_ups.nc")
    return _labelled(results["run_ups"], call)


def _call(
    caller: str, blade: BladeChoice | str, scene: SceneChoice | str, several: Mapping[str, Any], options: Mapping[str, Any]
) -> Call:
    """The call of these run-ups of a blade in a scene."""
    call = call_of(caller, [blade], [scene], {"run_ups": plain_value(several)}, options)
    # a run-up's own speeds are checked by its section
    return replace(call, keys={**call.keys, "speeds": [call.base.checked.structure.maximum_speed_rad_s]})


def _labelled(dataset: xr.Dataset, call: Call) -> xr.Dataset:
    """The dataset with what was changed of blade and scene in the place of their names."""
    (blade,), (scene,) = call.blades, call.scenes
    count, choices = dataset.sizes["run"], {"blade": blade, "scene": scene}
    labels = {name: ("run", [choice.label] * count, dataset[name].attrs) for name, choice in choices.items()}
    return dataset.assign_coords(labels).assign_attrs(call.told)
