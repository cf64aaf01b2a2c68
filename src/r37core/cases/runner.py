"""The runner of cases: a case in, an ordinary response.nc out, with what it cost."""

import math
import resource
import tempfile
import time
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
import xarray as xr

from r37core.base.dataset_file import SPEED, about, read_dataset, write_dataset
from r37core.base.io import read_json
from r37core.results.regions import read_judged
from r37core.results.response import write_response
from r37core.rom.contact_model import ContactModel, read_contact_model
from r37core.rom.rom_file import read_reduced_model
from r37core.stress.operator import StressOperators, judged_operator
from r37core.stress.recovery import stress_operators
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.problem import stable_problem
from r37core.time_integration.speed_file import read_speed, write_speed
from r37core.time_integration.speed_run import run_speed, simulation_of

from .case import Case

T = TypeVar("T")

COSTS = {
    "cpu_s": about("s", "CPU time of the time integration"),
    "wall_s": about("s", "wall time of the time integration"),
    "file_cpu_s": about("s", "CPU time of writing the run's file"),
    "bytes_written": about("1", "bytes of the run's file"),
}
"""Costs of every speed, which the response of a case has next to the results, and their attributes."""


def timed(call: Callable[[], T]) -> tuple[T, float, float]:
    """The result of a call, and the CPU and wall time (s) that it took in this process."""
    cpu, wall = time.process_time(), time.perf_counter()
    result = call()
    return result, time.process_time() - cpu, time.perf_counter() - wall


def peak_memory() -> float:
    """Largest memory (bytes) of this process so far."""
    return float(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024)


def run_case_of_files(case: Case, files: Mapping[str, str], output: Path | str) -> None:
    """Run a case from its files: `contact`; `rom` for the stress, `cost` of the model, `campbell` for the speeds.

    Raises ValueError for a crossing that the Campbell diagram does not have.
    """
    costs = {f"model_{name}": value for name, value in (read_json(files["cost"]) if "cost" in files else {}).items()}
    if refused := case.refused or costs.get("model_refused", ""):
        write_refusal(refused, output)
        return
    if case.crossing:
        case = _about_the_crossing(case, *case.crossing, read_dataset(files["campbell"]))

    def recovery() -> StressOperators | None:
        wanted = "stress" in case.results and case.material
        return stress_operators(read_reduced_model(files["rom"]), wanted) if wanted else None

    model, costs["reading_cpu_s"], _ = timed(lambda: read_contact_model(files["contact"]))
    operator, costs["recovery_cpu_s"], _ = timed(recovery)
    run_case(case, model, operator, output, costs)


def _about_the_crossing(case: Case, mode: str, engine_order: int | None, campbell: xr.Dataset) -> Case:
    """The case with its speeds in rad/s."""
    speed = crossing_speed(campbell, mode, engine_order, case.speeds[-1])
    if not np.isfinite(speed):
        order = f"engine order {engine_order}" if engine_order else "any engine order"
        raise ValueError(
            f"config.yaml: {mode} of {case.blade} does not cross {order} below structure.maximum_speed_rad_s; choose another "
            "engine_order, or a higher structure.maximum_speed_rad_s"
        )
    return replace(case, speeds=tuple(float(share * speed) for share in case.speeds))


def crossing_speed(campbell: xr.Dataset, mode: str, engine_order: int | None, highest_share: float) -> float:
    """Speed (rad/s) of a crossing, NaN where there is none; without an engine order the highest one in the diagram.

    As far as there are some, only crossings count whose `highest_share` lies in the diagram, too.
    """
    speeds = campbell["crossing_speed"].sel(mode=mode)
    if engine_order:
        return float(speeds.sel(engine_order=engine_order))
    inside = speeds.where(highest_share * speeds <= campbell["speed"].max())
    return float(inside.max() if inside.notnull().any() else speeds.max())


def run_case(
    case: Case,
    model: ContactModel,
    recovery: StressOperators | None,
    output: Path | str,
    costs: Mapping[str, float] | None = None,
) -> None:
    """Run a case with speeds in rad/s; `costs` (s, bytes) become attributes of its response.

    A case that a time step or a model refuses has no speeds, and the reason as attribute `refused`.
    """
    attributes = {"blade": case.blade, **(costs or {})}
    try:
        with tempfile.TemporaryDirectory() as folder:
            response = _response(case, model, recovery, Path(folder))
    except ValueError as error:
        write_refusal(str(error), output, attributes)
    else:
        write_dataset(response, output, attributes)


def write_refusal(reason: str, output: Path | str, attributes: Mapping[str, Any] | None = None) -> None:
    """A response without speeds, whose attribute `refused` has the reason."""
    nothing = xr.Dataset(coords={"speed": ("speed", np.empty(0), SPEED.attributes)})
    write_dataset(nothing, output, {**(attributes or {}), "refused": reason.split(";")[0]})


def _response(case: Case, model: ContactModel, recovery: StressOperators | None, folder: Path) -> xr.Dataset:
    """The response of all speeds, with COSTS and the stress at instants; single runs lie in `folder`."""
    files = [folder / f"{speed!r}.npz" for speed in case.speeds]
    costs = []
    for number, (speed, file) in enumerate(zip(case.speeds, files, strict=True), 1):
        costs.append(_run(case, model, recovery, speed, file))
        if number % 100 == 0:
            print(f"{number} of {len(files)} speeds", flush=True)
    reduce = partial(
        write_response,
        files,
        case.speeds,
        folder / "response.nc",
        stress_history_speeds=case.history_speeds if recovery else (),
        yield_stress=case.material.yield_stress if case.material else math.inf,
        provenance={},
    )
    _, reduction_cpu, _ = timed(reduce)
    response = read_judged(folder / "response.nc")
    for (name, attributes), values in zip(COSTS.items(), zip(*costs, strict=True), strict=True):
        response[name] = "speed", list(values), attributes
    if "instants" in case.results and recovery:
        stress = np.full((len(files), case.choice.snapshots_per_revolution), np.nan)
        for speed, row, file in zip(case.speeds, stress, files, strict=True):
            # a run that diverged has none
            if len(snapshots := read_speed(file)["snapshots"]):
                row[:] = judged_operator(recovery).displaced(speed).max_von_mises(snapshots)
        meaning = "largest von Mises stress at each instant of the last revolution"
        response["max_von_mises_of_instant"] = ("speed", "instant"), stress, about("Pa", meaning)
    return response.assign_attrs({"reduction_cpu_s": reduction_cpu, "peak_memory_bytes": peak_memory()})


def _run(case: Case, model: ContactModel, recovery: StressOperators | None, speed: float, file: Path) -> tuple[float, ...]:
    """Simulate one speed (rad/s) into a file; gives its COSTS."""
    assert case.scene is not None
    scene, choice = case.scene, _choice(case, model, speed)
    # compiled before it is timed
    simulation_of(model, speed, scene, choice)
    simulate = partial(run_speed, model, speed, scene, choice, case.results, motion=None, stress=recovery, **case.kept)
    run, cpu, wall = timed(simulate)
    _, file_cpu, _ = timed(lambda: write_speed(run, file, {}))
    return cpu, wall, file_cpu, float(file.stat().st_size)


def _choice(case: Case, model: ContactModel, speed: float) -> IntegrationChoice:
    """Numbers of the time integration at one speed (rad/s)."""
    assert case.scene is not None
    choice = replace(case.choice, snapshots_per_revolution=0, snapshot_revolutions=0)
    if "stress" in case.results:
        kept = choice.revolutions if speed in case.history_speeds else choice.revolutions_in_statistic
        choice = replace(case.choice, snapshot_revolutions=kept)
    if case.share_of_limit is not None:
        middle = case.speeds[len(case.speeds) // 2]
        step = case.share_of_limit * 2.0 / model.modes_at(1.01 * middle)[0][-1]
        choice = replace(choice, time_step=step, shorten=False)
    if case.half_step:
        # of the step taken, which divides the sampling instants: half of the one asked for may give the same
        choice = replace(choice, time_step=0.5 * stable_problem(model, speed, case.scene, choice).grid.time_step)
    return choice
