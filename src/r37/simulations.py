"""The calls of one blade: its Campbell diagram, its reduced model, its response in a scene at one speed and at several."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

import xarray as xr

from r37core.base.dataset_file import read_dataset
from r37core.base.io import FILE_ATTRIBUTES, Named, scratch_folder
from r37core.config import ConfigError
from r37core.config.remarks import remarks_on_blades
from r37core.plans.sweep_plan import Sweep
from r37core.results.closing import remarks_on_contact, remarks_on_limits

from .arguments import Speeds, speed_key, speed_keys
from .calculation import response_file, structure_file
from .call_settings import Call, call_of, tell
from .choices import BladeChoice, SceneChoice
from .jobs import check_cores
from .stages import stages


@stages()
def campbell(blade: BladeChoice | str, *, fidelity: str | None = None, config: Path | str | None = None) -> xr.Dataset:
    """Campbell diagram of a blade, as in campbell.nc of a run.

    Args:
        blade: A name, or the result of `r37.blade`.
        fidelity: An accuracy level in place of the configuration's.
        config: A config.yaml in place of the shipped one. It gives names, structure and levels.

    Returns:
        `frequency` (Hz), shape (mode, speed). `crossing_speed` (rad/s), shape (mode, engine_order), NaN without a crossing.
        `dynamic_clearance` (m), shape (mode, tangential_displacement). `mode`: 1B, 1T, 2B, then 4, 5, ... by frequency.

    Raises:
        ConfigError: For bad input.
        ValueError: For an impossible shape, mesh, model or time step.
        BucklingError: For a blade that its load buckles.

    Examples:
        >>> diagram = r37.campbell("Ref", fidelity="draft")
        >>> crossing = diagram.crossing_speed.sel(mode="1B", engine_order=4).item()  # rad/s
        >>> 1600 < crossing < 1750
        True
    """
    call = call_of("r37.campbell", [blade], [], {}, config=config, fidelity=fidelity)
    return _structure_dataset(call, "campbell_of_blade")


@stages()
def reduced_model(
    blade: BladeChoice | str,
    scene: SceneChoice | str | None = None,
    *,
    fidelity: str | None = None,
    config: Path | str | None = None,
) -> xr.Dataset:
    """Reduced model of a blade, as in rom_*.nc of a run.

    Args:
        blade: A name, or the result of `r37.blade`.
        scene: Scene whose tip line has the contact nodes. By default that of structure.boundary counts.
        fidelity: An accuracy level in place of the configuration's.
        config: A config.yaml in place of the shipped one. It gives names, structure and levels.

    Returns:
        `mass` (kg), `stiffness` (N/m) and `geometric_stiffness` (N s²/(m rad²)), each of shape (row, column). The rows are
        the reduced coordinates: displacements of the contact nodes, then modes. Others map them to the nodes.

    Raises:
        ConfigError: For bad input.
        ValueError: For an impossible shape, mesh, model or time step.
        BucklingError: For a blade that its load buckles.

    Examples:
        >>> model = r37.reduced_model("Ref", fidelity="draft")
        >>> model.mass.shape == model.stiffness.shape
        True
    """
    scenes = [] if scene is None else [scene]
    call = call_of("r37.reduced_model", [blade], scenes, {}, config=config, fidelity=fidelity)
    tip_line = call.settings.scenes[call.scenes[0].name].tip_line if call.scenes else None
    return _structure_dataset(call, "reduced_model", tip_line)


@stages()
def simulate(
    blade: BladeChoice | str,
    scene: SceneChoice | str,
    speed: float | None = None,
    *,
    speed_rpm: float | None = None,
    fidelity: str | None = None,
    results: Sequence[str] | None = None,
    config: Path | str | None = None,
) -> xr.Dataset:
    """Response of a blade in a scene at one speed: that of `r37.sweep` without the dimension speed.

    Args:
        blade: A name, or the result of `r37.blade`.
        scene: A name, or the result of `r37.scene`.
        speed: Angular speed (rad/s).
        speed_rpm: The same in revolutions per minute, in place of `speed`.
        fidelity: An accuracy level in place of the configuration's.
        results: Results to compute, in place of the scene's list: `["stress", "wear"]`.
        config: A config.yaml in place of the shipped one. It gives names, structure and levels.

    Returns:
        Variables of response.nc: `rms_normal` (m), shape (tip_point,); `max_von_mises_ever` (Pa), shape (region,); `status` (0:
        completed, 1: diverged), a scalar; and others, each with its unit.

    Raises:
        ConfigError: For bad input.
        ValueError: For an impossible shape, mesh, model or time step.
        BucklingError: For a blade that its load buckles.

    Examples:
        >>> response = r37.simulate("Ref", "abradable", 1550, fidelity="draft")
        >>> response.rms_normal.sel(tip_point="leading_edge").item() > 0.0  # m
        True
    """
    keys = speed_key(speed, speed_rpm)
    call = call_of("r37.simulate", [blade], [scene], keys, config=config, fidelity=fidelity, results=results)
    try:
        _ = call.settings
    except ConfigError as error:
        # the one speed stands in a list of them
        raise ConfigError(re.sub(r"\bspeeds(_rpm)?\.0\b", r"speed\1", str(error))) from None
    return _response(call, 1).isel(speed=0)


@stages()
def sweep(
    blade: BladeChoice | str,
    scene: SceneChoice | str,
    speeds: Speeds | None = None,
    *,
    speeds_rpm: Speeds | None = None,
    cores: int = 1,
    fidelity: str | None = None,
    results: Sequence[str] | None = None,
    config: Path | str | None = None,
) -> xr.Dataset:
    """Response of a blade in a scene at several speeds, as in response.nc of a run.

    Args:
        blade: A name, or the result of `r37.blade`.
        scene: A name, or the result of `r37.scene`.
        speeds: Angular speeds (rad/s), or ranges `{"start": 750, "stop": 2000, "step": 20}`. With `"refine_to": 1` the range is
            sampled adaptively, down to intervals of that length.
        speeds_rpm: The same in revolutions per minute, in place of `speeds`.
        cores: Number of jobs that run at once. The numbers do not depend on it.
        fidelity: An accuracy level in place of the configuration's.
        results: Results to compute, in place of the scene's list: `["stress", "wear"]`.
        config: A config.yaml in place of the shipped one. It gives names, structure and levels.

    Returns:
        The variables of `r37.simulate` by ascending `speed`, with the numbers of the workflow: `rms_normal` (m), shape (speed,
        tip_point); `max_von_mises_ever` (Pa), shape (speed, region); `status`, shape (speed,); `amplitude` (m), shape (speed,
        engine_order); and others.

    Raises:
        ConfigError: For bad input.
        ValueError: For an impossible shape, mesh, model or time step.
        BucklingError: For a blade that its load buckles.

    Examples:
        >>> response = r37.sweep("Ref", "abradable", [1550, 1150], fidelity="draft", results=["stress"])
        >>> response.speed.values
        array([1150., 1550.])
    """
    check_cores(cores)
    keys = speed_keys(speeds, speeds_rpm)
    return _response(call_of("r37.sweep", [blade], [scene], keys, config=config, fidelity=fidelity, results=results), cores)


def _structure_dataset(call: Call, stage: str, tip_line: str | None = None) -> xr.Dataset:
    """A dataset of the structure of the call's one blade."""
    settings, (blade,) = call.settings, call.blades
    tell(remarks_on_blades(settings))
    file = structure_file(settings, blade.name, stage, tip_line)
    made = Sweep(settings).structure_provenance(Named(blade=blade.name))
    return read_dataset(file).assign_attrs(FILE_ATTRIBUTES | dict(made) | blade.told)


def _response(call: Call, cores: int) -> xr.Dataset:
    """The response of the call's one blade in its one scene, at the speeds of its settings."""
    call.tell_remarks()
    (blade,), (scene,) = call.blades, call.scenes
    with scratch_folder() as folder:
        response = read_dataset(response_file(call.settings, folder, cores))
    name = f"{blade.label} in {scene.label}"
    tell(remarks_on_contact([(name, response["largest_normal_force"].values)]))
    tell(remarks_on_limits(response, f"{name}: "))
    return response.assign_attrs(call.told)
