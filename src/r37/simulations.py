"""The calls that compute: Campbell diagram, response at one speed, response at several."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from r37core.config import ConfigError, Settings, casing_remarks
from r37core.config.remarks import remarks_on_points
from r37core.dataset_file import read_dataset
from r37core.io import FILE_ATTRIBUTES, scratch_folder
from r37core.plans.provenance import Provenance
from r37core.plans.simulation_plan import Simulations
from r37core.plans.sweep_plan import Sweep
from r37core.results.response import write_response
from r37core.rom.contact_model import read_contact_model
from r37core.stress.operator import read_stress_operator
from r37core.time_integration.initial_motion import InitialMotion, InitialMotionError
from r37core.time_integration.speed_file import write_speed
from r37core.time_integration.speed_run import OF_RUNS, run_speed

from .call_configuration import Configuration, read_configuration
from .choices import BladeChoice, SceneChoice
from .structure_files import StructureFiles


def campbell(blade: BladeChoice | str, *, fidelity: str | None = None, config: Path | str | None = None) -> xr.Dataset:
    """The Campbell diagram of a blade: frequencies (Hz), crossings with engine orders (rad/s), dynamic clearance (m).

    As campbell.nc of a run: dimensions mode, speed, engine_order, tangential_displacement. `fidelity`: an accuracy level in
    place of the configuration's. `config`: a config.yaml in place of the shipped one. Raises ConfigError for bad input, and
    what a shape, mesh or model raises that is impossible.
    """
    settings = _settings("r37.campbell", blade, None, config, _level(fidelity))
    (name,) = settings.blade_names
    made = Provenance(settings).structure(SimpleNamespace(blade=name))
    return read_dataset(StructureFiles(settings, name).campbell()).assign_attrs(FILE_ATTRIBUTES | dict(made))


def simulate(
    blade: BladeChoice | str,
    scene: SceneChoice | str,
    speed: float,
    *,
    fidelity: str | None = None,
    results: Sequence[str] | None = None,
    config: Path | str | None = None,
    initial_displacement: ArrayLike | None = None,
    initial_velocity: ArrayLike | None = None,
) -> xr.Dataset:
    """The response of a blade in a scene at one speed (rad/s): what `sweep` gives of it, without the dimension speed.

    The blade starts at rest, or with a displacement and a velocity (per s) in the coordinates of the reduced model, shape
    (coordinates,): those of `reduced_model`. What of them lies in modes that are not stepped is left out; the dataset has its
    share of the energy, and the attribute initial_state. Other arguments and errors as of `sweep`; ConfigError also for a
    displacement that reaches into casing or lining.
    """
    changes = {"speeds": _numbers([speed]), **_level(fidelity)}
    settings = _settings("r37.simulate", blade, scene, config, changes, results)
    try:
        motion = InitialMotion.from_arrays(initial_displacement, initial_velocity)
        response = _response(settings, motion)
    except InitialMotionError as error:
        raise ConfigError(str(error)) from None
    return response.isel(speed=0).assign_attrs({} if motion is None else motion.attributes)


def reduced_model(
    blade: BladeChoice | str,
    scene: SceneChoice | str | None = None,
    *,
    fidelity: str | None = None,
    config: Path | str | None = None,
) -> xr.Dataset:
    """The reduced model of a blade with the contact nodes of a scene, as rom.nc of a run: `mass`, `stiffness` and others.

    Without a scene the contact nodes are those of structure.boundary. Other arguments and errors as of `sweep`.
    """
    settings = _settings("r37.reduced_model", blade, scene, config, _level(fidelity))
    (name,) = settings.blade_names
    chosen = [settings.structure.boundary] if scene is None else settings.scenes.values()
    (tip_line,) = {choice.tip_line for choice in chosen}
    made = Provenance(settings).structure(SimpleNamespace(blade=name))
    model = read_dataset(StructureFiles(settings, name).reduced_model(tip_line))
    return model.assign_attrs(FILE_ATTRIBUTES | dict(made))


def sweep(
    blade: BladeChoice | str,
    scene: SceneChoice | str,
    speeds: Iterable[float],
    *,
    fidelity: str | None = None,
    results: Sequence[str] | None = None,
    config: Path | str | None = None,
) -> xr.Dataset:
    """The response of a blade in a scene at several speeds (rad/s), by ascending speed, one after another in this process.

    As response.nc of a run: the same variables, units, attributes and numbers. With several threads of the linear algebra
    library numbers may differ by round-off; OPENBLAS_NUM_THREADS=1, set before Python starts, gives the very bits.
    `fidelity`: an accuracy level in place of the configuration's. `results`: in place of the scene's. `config`: a config.yaml
    in place of the shipped one, where names are looked up and from which structure and levels are taken. Raises ConfigError
    for bad input, and what a shape, mesh, model or time step raises that is impossible.
    """
    changes = {"speeds": _numbers(speeds), **_level(fidelity)}
    return _response(_settings("r37.sweep", blade, scene, config, changes, results))


def _numbers(speeds: Iterable[float]) -> list[float]:
    """Speeds as plain numbers; ConfigError for others. Their bounds are the configuration's."""
    numbers = [speed.item() if isinstance(speed, np.generic | np.ndarray) and speed.size == 1 else speed for speed in speeds]
    for speed in numbers:
        if isinstance(speed, bool) or not isinstance(speed, int | float):
            raise ConfigError(f"speeds: found {speed!r}; allowed: numbers, in rad/s")
    return numbers


def _level(fidelity: str | None) -> dict[str, Any]:
    return {} if fidelity is None else {"fidelity": fidelity}


def _settings(
    caller: str,
    blade: BladeChoice | str,
    scene: SceneChoice | str | None,
    config: Path | str | None,
    changes: dict[str, Any],
    results: Sequence[str] | None = None,
) -> Settings:
    """Settings of one blade and, where there is one, one scene; structure and levels are of `config`, else of the blade's."""
    base = blade.configuration if isinstance(blade, BladeChoice) and config is None else read_configuration(config)
    blade = blade if isinstance(blade, BladeChoice) else BladeChoice(blade, {}, base)
    _ = blade.settings
    changes |= {"blades": [blade.name], "blades_file": blade.configuration.checked.blades_file}
    above = None
    if scene is not None:
        scene = scene if isinstance(scene, SceneChoice) else SceneChoice(scene, {}, base)
        if results is not None:
            scene = SceneChoice(scene.name, {**scene.changes, "results": list(results)}, scene.configuration)
        _ = scene.entry
        changes |= {"scenes": [scene.name], "scenes_file": scene.configuration.checked.scenes_file}
        above = scene.above
    return Configuration(base.document, blade.configuration.root).settings(changes, caller, blade.above, above)


def _response(settings: Settings, motion: InitialMotion | None = None) -> xr.Dataset:
    """The response of the one blade in the one scene of the settings, at their speeds, from rest or in `motion`."""
    ((blade, scene), plan), *_ = settings.speed_plans.items()
    at, sweep = SimpleNamespace(blade=blade, scene=scene), Sweep(settings)
    for remark in [*casing_remarks.of_sweep(settings), *remarks_on_points(settings)]:
        warnings.warn(remark, stacklevel=3)
    chosen, structure = settings.scenes[scene], StructureFiles(settings, blade)
    model = read_contact_model(structure.contact_model(chosen.tip_line))
    stress = read_stress_operator(structure.stress_operator(chosen.tip_line)) if sweep.with_stress(at) else None
    results = [result for result in sweep.results(at) if result in OF_RUNS]
    kept = Simulations(sweep).kept
    with scratch_folder() as folder:
        files = [Path(folder, f"{number}.npz") for number in range(len(plan.certain))]
        for speed, file in zip(plan.certain, files, strict=True):
            choice = settings.integration_choice(blade, scene, speed)
            run = run_speed(model, speed, chosen.scene, choice, results, **kept, stress=stress, motion=motion)
            write_speed(run, file, {})
        response = Path(folder, "response.nc")
        write_response(
            files,
            plan.certain,
            response,
            stress_history_speeds=sweep.stress_history_speeds(at),
            yield_stress=sweep.yield_stress(at),
            provenance=Provenance(settings).sweep(at),
        )
        return read_dataset(response)
