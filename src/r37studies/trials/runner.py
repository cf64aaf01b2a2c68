"""The runner of cases: a case in, an ordinary response.nc out, with what it cost."""

import math
import time
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TypeVar

import numpy as np
import xarray as xr

from r37core.results.regions import read_judged
from r37core.results.response import write_response
from r37core.rom.contact_model import ContactModel
from r37core.stress.operator import StressOperators
from r37core.sweep.counts import count_simulation
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.problem import stable_problem
from r37core.time_integration.speed_file import write_speed
from r37core.time_integration.speed_run import run_speed, simulation_of

from .case import Case
from .case_table import refusal

T = TypeVar("T")

COSTS = ("cpu_s", "file_cpu_s")
"""Costs of a run: CPU time of the time integration, and of its file, written and read into the response."""


def timed(call: Callable[[], T]) -> tuple[T, float]:
    """The result of a call, and the CPU time (s) that it took in this process."""
    before = time.process_time()
    return call(), time.process_time() - before


def run_case(case: Case, model: ContactModel, recovery: StressOperators | None) -> xr.Dataset:
    """The response of a case with speeds in rad/s, with its costs as attributes, or the refusal of one.

    Costs: means of COSTS over the speeds. A time step or a model may refuse the case.
    """
    with TemporaryDirectory() as folder:
        files = [Path(folder) / f"{number}.npz" for number in range(len(case.speeds))]
        try:
            costs = [_run(case, model, recovery, *run) for run in zip(case.speeds, files, strict=True)]
        except ValueError as error:
            return refusal(str(error))
        reduce = partial(
            write_response,
            files,
            case.speeds,
            response := Path(folder) / "response.nc",
            stress_history_speeds=(),
            yield_stress=case.material.yield_stress if case.material else math.inf,
            provenance={},
        )
        cpu, file_cpu = np.mean(costs, axis=0)
        means = cpu, file_cpu + timed(reduce)[1] / len(files)
        return read_judged(response).assign_attrs(zip(COSTS, means, strict=True))


def _run(case: Case, model: ContactModel, recovery: StressOperators | None, speed: float, file: Path) -> tuple[float, float]:
    """Write the run at a speed (rad/s); gives its COSTS."""
    choice = _choice(case, model, speed)
    # compiled before it is timed
    simulation_of(model, speed, case.scene, choice)
    simulate = partial(run_speed, model, speed, case.scene, choice, case.results, stress=recovery, **case.kept)
    run, cpu = timed(simulate)
    count_simulation(int(run["status"]))
    _, file_cpu = timed(partial(write_speed, run, file, {}))
    return cpu, file_cpu


def _choice(case: Case, model: ContactModel, speed: float) -> IntegrationChoice:
    """Numbers of the time integration at one speed (rad/s)."""
    choice = case.choice
    if case.share_of_limit is not None:
        middle = case.speeds[len(case.speeds) // 2]
        step = case.share_of_limit * 2.0 / model.modes_at(1.01 * middle)[0][-1]
        choice = replace(choice, time_step=step, shorten=False)
    if case.half_step:
        # of the step taken, which divides the sampling instants: half of the one asked for may give the same
        choice = replace(choice, time_step=0.5 * stable_problem(model, speed, case.scene, choice).grid.time_step)
    return choice
