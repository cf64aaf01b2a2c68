"""The runner of cases: a case in, an ordinary response.nc out, with what it cost."""

import math
import resource
import time
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TypeVar

import numpy as np
import xarray as xr

from r37core.base.dataset_file import about
from r37core.results.regions import read_judged
from r37core.results.response import write_response
from r37core.rom.contact_model import ContactModel
from r37core.stress.operator import StressOperators, judged_operator
from r37core.sweep.parts import Parts
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.problem import stable_problem
from r37core.time_integration.speed_file import read_speed, write_speed
from r37core.time_integration.speed_run import run_speed, simulation_of

from .case import Case
from .case_table import refusal

T = TypeVar("T")

COSTS = {
    "cpu_s": about("s", "CPU time of the time integration"),
    "wall_s": about("s", "wall time of the time integration"),
    "file_cpu_s": about("s", "CPU time of writing the run's file"),
    "bytes_written": about("1", "bytes of the run's file"),
}
"""Costs of every speed, which the response of a case has next to the results, and their attributes."""

_COSTS_OF_RUN = "costs"
"""Array of the COSTS in the file of a run."""


def timed(call: Callable[[], T]) -> tuple[T, float, float]:
    """The result of a call, and the CPU and wall time (s) that it took in this process."""
    cpu, wall = time.process_time(), time.perf_counter()
    result = call()
    return result, time.process_time() - cpu, time.perf_counter() - wall


def peak_memory() -> float:
    """Largest memory (bytes) of this process so far."""
    return float(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024)


def run_case(case: Case, model: ContactModel, recovery: StressOperators | None, parts: Parts) -> xr.Dataset:
    """The response of a case with speeds in rad/s, with COSTS and the stress at instants, or the refusal of one.

    A time step or a model may refuse it. A case that was interrupted goes on from its `parts`.
    """
    try:
        files = [parts.file(speed, case, partial(_run, case, model, recovery, speed)) for speed in case.speeds]
    except ValueError as error:
        return refusal(str(error))
    costs = np.transpose([read_speed(file)[_COSTS_OF_RUN] for file in files])
    file = parts.folder / "response.nc"
    reduce = partial(
        write_response,
        files,
        case.speeds,
        file,
        stress_history_speeds=case.history_speeds if recovery else (),
        yield_stress=case.material.yield_stress if case.material else math.inf,
        provenance={},
    )
    _, reduction_cpu, _ = timed(reduce)
    response = read_judged(file)
    for (name, attributes), values in zip(COSTS.items(), costs, strict=True):
        response[name] = "speed", values, attributes
    if "instants" in case.results and recovery:
        stress = np.full((len(files), case.choice.snapshots_per_revolution), np.nan)
        for speed, row, file in zip(case.speeds, stress, files, strict=True):
            # a run that diverged has none
            if len(snapshots := read_speed(file)["snapshots"]):
                row[:] = judged_operator(recovery).displaced(speed).max_von_mises(snapshots)
        meaning = "largest von Mises stress at each instant of the last revolution"
        response["max_von_mises_of_instant"] = ("speed", "instant"), stress, about("Pa", meaning)
    return response.assign_attrs({"reduction_cpu_s": reduction_cpu, "peak_memory_bytes": peak_memory()})


def _run(case: Case, model: ContactModel, recovery: StressOperators | None, speed: float) -> dict[str, np.ndarray]:
    """Numbers of the run at a speed (rad/s), with its COSTS."""
    choice = _choice(case, model, speed)
    # compiled before it is timed
    simulation_of(model, speed, case.scene, choice)
    simulate = partial(run_speed, model, speed, case.scene, choice, case.results, motion=None, stress=recovery, **case.kept)
    run, cpu, wall = timed(simulate)
    with TemporaryDirectory() as folder:
        file = Path(folder) / "run.npz"
        _, file_cpu, _ = timed(partial(write_speed, run, file, {}))
        return run | {_COSTS_OF_RUN: np.array([cpu, wall, file_cpu, float(file.stat().st_size)])}


def _choice(case: Case, model: ContactModel, speed: float) -> IntegrationChoice:
    """Numbers of the time integration at one speed (rad/s)."""
    choice = case.choice
    if speed in case.history_speeds:
        choice = replace(choice, snapshot_revolutions=choice.revolutions)
    if case.share_of_limit is not None:
        middle = case.speeds[len(case.speeds) // 2]
        step = case.share_of_limit * 2.0 / model.modes_at(1.01 * middle)[0][-1]
        choice = replace(choice, time_step=step, shorten=False)
    if case.half_step:
        # of the step taken, which divides the sampling instants: half of the one asked for may give the same
        choice = replace(choice, time_step=0.5 * stable_problem(model, speed, case.scene, choice).grid.time_step)
    return choice
