"""The calls of one blade: its Campbell diagram, its reduced model, its response in a scene at one speed and at several."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Unpack

import xarray as xr
from numpy.typing import ArrayLike

from r37core.config import ConfigError
from r37core.config.remarks import remarks_on_materials
from r37core.dataset_file import read_dataset
from r37core.io import FILE_ATTRIBUTES, Named, scratch_folder
from r37core.plans.provenance import Provenance
from r37core.results.closing import remarks_on_contact
from r37core.time_integration.initial_motion import InitialMotion, InitialMotionError

from .arguments import Speeds, speed_key, speed_keys
from .calculation import Calculation
from .call_settings import Call, OneOptions, call_of_one, remarks_of, tell
from .choices import BladeChoice, SceneChoice
from .jobs import check_cores, in_parallel
from .stages import checked_call
from .structure_files import recipe


class SimulateOptions(OneOptions, total=False):
    """What `simulate` takes by name."""

    speed_rpm: float | None
    initial_displacement: ArrayLike | None
    initial_velocity: ArrayLike | None


class SpeedsOptions(OneOptions, total=False):
    """What `sweep` takes by name."""

    speeds_rpm: Speeds | None
    cores: int


@checked_call
def campbell(blade: BladeChoice | str, *, fidelity: str | None = None, config: Path | str | None = None) -> xr.Dataset:
    """The Campbell diagram of a blade, as campbell.nc of a run.

    Parameters
    ----------
    blade
        Its name, or what `r37.blade` gives.
    fidelity
        An accuracy level in place of the configuration's.
    config
        A config.yaml in place of the shipped one, where names are looked up and structure and levels are taken from.

    Returns
    -------
    Dataset
        `frequency` (Hz) over mode and speed, `crossing_speed` (rad/s) over mode and engine order, `dynamic_clearance` (m).

    Raises
    ------
    ConfigError
        For bad input. A shape, mesh or model that is impossible raises a ValueError of its own.

    Examples
    --------
    >>> diagram = r37.campbell("Ref", fidelity="draft")
    >>> crossing = diagram.crossing_speed.sel(mode="1B", engine_order=4).item()  # rad/s
    >>> 1600 < crossing < 1750
    True
    """
    call = call_of_one("r37.campbell", blade, [], {}, {"fidelity": fidelity, "config": config})
    return _of_structure(call, "campbell_of_blade")


@checked_call
def reduced_model(
    blade: BladeChoice | str,
    scene: SceneChoice | str | None = None,
    *,
    fidelity: str | None = None,
    config: Path | str | None = None,
) -> xr.Dataset:
    """The reduced model of a blade, as rom.nc of a run.

    Parameters
    ----------
    blade
        Its name, or what `r37.blade` gives.
    scene
        On whose tip line the contact nodes lie; without it on that of structure.boundary.
    fidelity, config
        As of `r37.campbell`.

    Returns
    -------
    Dataset
        `mass` (kg), `stiffness` (N/m), `geometric_stiffness` and others over the reduced coordinates.

    Raises
    ------
    ConfigError, ValueError
        As of `r37.campbell`.

    Examples
    --------
    >>> model = r37.reduced_model("Ref", fidelity="draft")
    >>> model.mass.shape == model.stiffness.shape
    True
    """
    scenes = [] if scene is None else [scene]
    call = call_of_one("r37.reduced_model", blade, scenes, {}, {"fidelity": fidelity, "config": config})
    tip_line = call.settings.scenes[call.scenes[0].name].tip_line if call.scenes else None
    return _of_structure(call, "reduced_model", tip_line)


@checked_call
def simulate(
    blade: BladeChoice | str, scene: SceneChoice | str, speed: float | None = None, **options: Unpack[SimulateOptions]
) -> xr.Dataset:
    """The response of a blade in a scene at one speed: what `r37.sweep` gives of it, without the dimension speed.

    Parameters
    ----------
    blade, scene
        Names, or what `r37.blade` and `r37.scene` give.
    speed
        Angular speed (rad/s).
    speed_rpm
        The same in revolutions per minute, in place of `speed`.
    fidelity
        An accuracy level in place of the configuration's.
    results
        What is computed, in place of the scene's list: `["stress", "wear"]`.
    config
        A config.yaml in place of the shipped one, where names are looked up and structure and levels are taken from.
    initial_displacement, initial_velocity
        Where the blade starts (velocity per s), in the coordinates of `r37.reduced_model`, shape (coordinates,). It starts
        at rest without them. What of them lies in modes that are not stepped is left out; the dataset has its share of the
        energy, and the attribute `initial_state`.

    Returns
    -------
    Dataset
        As response.nc of a run: `rms_normal` (m), `max_von_mises` (Pa), `status` and others.

    Raises
    ------
    ConfigError
        For bad input, and for a displacement that reaches into casing or lining. A shape, mesh, model or time step that is
        impossible raises a ValueError of its own.

    Examples
    --------
    >>> response = r37.simulate("Ref", "abradable", 1550, fidelity="draft")
    >>> response.rms_normal.sel(tip_point="leading_edge").item() > 0.0  # m
    True
    """
    call = call_of_one("r37.simulate", blade, [scene], speed_key(speed, options.get("speed_rpm")), options)
    try:
        _ = call.settings
    except ConfigError as error:
        # the one speed stands in a list of them
        raise ConfigError(re.sub(r"\bspeeds(_rpm)?\.0\b", r"speed\1", str(error))) from None
    try:
        motion = InitialMotion.from_arrays(options.get("initial_displacement"), options.get("initial_velocity"))
        response = _response(call, 1, motion)
    except InitialMotionError as error:
        raise ConfigError(str(error)) from None
    return response.isel(speed=0).assign_attrs({} if motion is None else motion.attributes)


@checked_call
def sweep(
    blade: BladeChoice | str, scene: SceneChoice | str, speeds: Speeds | None = None, **options: Unpack[SpeedsOptions]
) -> xr.Dataset:
    """The response of a blade in a scene at several speeds, as response.nc of a run.

    Parameters
    ----------
    speeds
        Angular speeds (rad/s), or ranges `{"start": 750, "stop": 2000, "step": 20}`. With `"refine_to": 1` the range is sampled
        adaptively, down to intervals of that.
    speeds_rpm
        The same in revolutions per minute, in place of `speeds`.
    blade, scene, fidelity, results, config
        As of `r37.simulate`.
    cores
        Simulations that run at once, in processes of their own. The numbers do not depend on it.

    Returns
    -------
    Dataset
        The same variables, units, attributes and numbers as of the workflow, by ascending speed.

    Raises
    ------
    ConfigError, ValueError
        As of `r37.simulate`.

    Examples
    --------
    >>> response = r37.sweep("Ref", "abradable", [1550, 1150], fidelity="draft", results=["stress"])
    >>> response.speed.values
    array([1150., 1550.])
    """
    check_cores(cores := options.get("cores", 1))
    keys = speed_keys(speeds, options.get("speeds_rpm"))
    return _response(call_of_one("r37.sweep", blade, [scene], keys, options), cores)


def _of_structure(call: Call, stage: str, tip_line: str | None = None) -> xr.Dataset:
    """A dataset of the structure of the call's one blade."""
    settings, (blade,) = call.settings, call.blades
    tell(remarks_on_materials(settings))
    (file,) = in_parallel([recipe(settings, blade.name, stage, tip_line).file], 1)
    made = Provenance(settings).structure(Named(blade=blade.name))
    return read_dataset(file).assign_attrs(FILE_ATTRIBUTES | dict(made) | blade.told)


def _response(call: Call, cores: int, motion: InitialMotion | None = None) -> xr.Dataset:
    """The response of the call's one blade in its one scene, at the speeds of its settings, from rest or in `motion`."""
    tell(remarks_of(call.settings))
    (blade,), (scene,) = call.blades, call.scenes
    with scratch_folder() as folder:
        response = read_dataset(Calculation(call.settings, folder, cores).response(motion))
    # free flight is what a start in motion may be for
    if motion is None:
        tell(remarks_on_contact([(f"{blade.label} in {scene.label}", response["largest_normal_force"].values)]))
    return response.assign_attrs(blade.told | scene.told)
