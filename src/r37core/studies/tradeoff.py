"""What accuracy costs: one parameter at a time against a fine setting of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr

from r37core.contact.scene import Scene
from r37core.dataset_file import about
from r37core.results.stress_recovery import StressRecovery
from r37core.rom.contact_model import ContactModel
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.problem import UnstableStepError

from .case import COSTS, MOTION, QUANTITIES, Case, run_case
from .parameters import vary


@dataclass(frozen=True)
class Place:
    """Neighbouring speeds, as shares of a Campbell speed: single ones close to an interaction are too sensitive to compare."""

    first: float
    last: float
    speeds: int

    def of(self, crossing: float) -> np.ndarray:
        """The speeds (rad/s) about a Campbell speed (rad/s)."""
        return np.linspace(self.first, self.last, self.speeds) * crossing


def run_scenes(
    parameter: str,
    value: str,
    model: ContactModel,
    recovery: StressRecovery,
    scenes: Mapping[str, Scene],
    choices: Mapping[str, IntegrationChoice],
    places: Mapping[str, np.ndarray],
) -> dict[str, Case | str]:
    """Run every scene at all places' speeds with one parameter set; the reason instead of a case where a step is refused."""
    speeds = np.concatenate(list(places.values()))
    runs: dict[str, Case | str] = {}
    for name, scene in scenes.items():
        varied, choice = vary(parameter, value, scene, choices[name])
        try:
            runs[name] = run_case(model, varied, choice, speeds, recovery)
        except UnstableStepError as error:
            runs[name] = str(error).split(";")[0]
    return runs


def case_dataset(
    parameter: str,
    value: str,
    places: Mapping[str, np.ndarray],
    runs: Mapping[str, Case | str],
    model_cost: Mapping[str, float],
) -> xr.Dataset:
    """One case as a dataset: quantities over (scene, speed), costs over scene; a scene that was refused has NaN and its reason.

    `runs`: for each scene the case, or why there is none.
    """
    speeds = np.concatenate(list(places.values()))
    names = np.concatenate([[name] * len(values) for name, values in places.items()])
    done = {scene: case for scene, case in runs.items() if isinstance(case, Case)}
    nothing = np.full(len(speeds), np.nan)
    data: dict[str, Any] = {}
    for name in (*QUANTITIES, "status", "energy_residual"):
        rows = [done[scene].values[name] if scene in done else nothing for scene in runs]
        data[name] = (("scene", "speed_number"), np.array(rows))
    for name in COSTS:
        data[name] = ("scene", np.array([done[scene].costs[name] if scene in done else np.nan for scene in runs]))
    data["refused"] = ("scene", np.array([run if isinstance(run, str) else "" for run in runs.values()], dtype=object))
    for name in ("cpu_s", "peak_memory_bytes"):
        data[f"model_{name}"] = ((), model_cost.get(name, np.nan))
    coordinates = {"scene": list(runs), "speed": ("speed_number", speeds), "place": ("speed_number", names)}
    return xr.Dataset(data, coords=coordinates).assign_coords(parameter=parameter, value=value)


def gather_cases(cases: Sequence[xr.Dataset], references: Mapping[str, str]) -> xr.Dataset:
    """All cases along `case`, with errors against the reference value of each parameter.

    `error(case, scene, at, quantity)`: relative difference of the means over the speeds of a place. `scatter`, same shape: root
    mean square of the relative differences at its single speeds. `peak_speed_error(case, scene)`: of the rms-weighted mean
    speed over `peak` and `jump`.
    """
    parameters, values = (np.array([str(case[name].item()) for case in cases]) for name in ("parameter", "value"))
    together = xr.concat([case.drop_vars(["parameter", "value"]) for case in cases], dim="case")
    together = together.assign_coords(parameter=("case", parameters), value=("case", values))
    places = list(dict.fromkeys(cases[0]["place"].values))
    shape = (len(parameters), together.sizes["scene"], len(places), len(QUANTITIES))
    error, scatter, speed_error = np.full(shape, np.nan), np.full(shape, np.nan), np.full(shape[:2], np.nan)
    for row, parameter in enumerate(parameters):
        reference = int(np.flatnonzero((parameters == parameter) & (values == references[parameter]))[0])
        for column in range(shape[1]):
            ours, theirs = (together.isel(case=number, scene=column) for number in (row, reference))
            speed_error[row, column] = abs(centre_of_peak(ours) / centre_of_peak(theirs) - 1.0)
            for number, place in enumerate(places):
                error[row, column, number], scatter[row, column, number] = compare(ours, theirs, place)
    together = together.assign_coords(quantity=list(QUANTITIES), at=places)
    dims = ("case", "scene", "at", "quantity")
    together["error"] = (
        dims,
        error,
        about("1", "relative difference of means over neighbouring speeds"),
    )
    together["scatter"] = (dims, scatter, about("1", "root mean square of the relative differences at the single speeds"))
    together["peak_speed_error"] = (dims[:2], speed_error, about("1", "relative difference of the rms-weighted mean speed"))
    for name, unit in {**QUANTITIES, "cpu_s": "s", "wall_s": "s"}.items():
        together[name].attrs.update(about(unit, name.replace("_", " ")))
    together["speed"].attrs.update(about("rad s-1", "angular speed of the rotor"))
    return together


def compare(ours: xr.Dataset, theirs: xr.Dataset, place: str) -> tuple[np.ndarray, np.ndarray]:
    """Errors and scatter of one scene at one place, by QUANTITIES; NaN where the reference has nothing."""
    at = ours["place"].values == place
    errors, scatters = [], []
    for name in QUANTITIES:
        x, y = ours[name].values[at], theirs[name].values[at]
        errors.append(abs(x.mean() / y.mean() - 1.0) if y.mean() > 0.0 else np.nan)
        scatters.append(np.sqrt(np.mean((x / y - 1.0) ** 2)) if np.all(y > 0.0) else np.nan)
    return np.array(errors), np.array(scatters)


def centre_of_peak(case: xr.Dataset) -> float:
    """Mean speed (rad/s) over peak and jump, weighted with the squared rms: moves smoothly where the largest one jumps."""
    at = np.isin(case["place"].values, ["peak", "jump"])
    weight = case["rms_normal"].values[at] ** 2 + case["rms_tangential"].values[at] ** 2
    return float((case["speed"].values[at] * weight).sum() / weight.sum())


def level_error(together: xr.Dataset, value: str) -> float:
    """Error of a fidelity level: the largest at the peak, over scenes, of motion and stress."""
    case = together.isel(case=(together["parameter"].values == "level") & (together["value"].values == value))
    return float(case["error"].sel(at="peak", quantity=[*MOTION, "max_von_mises"]).max())
