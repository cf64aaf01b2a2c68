"""Simulation of a sweep as a job: from a contact model and a task, as JSON, to its file."""

import json
import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from r37core.base.io import JOB_LOG, as_list, readable
from r37core.base.plain import from_json, from_plain
from r37core.contact.scene import Scene
from r37core.rom.contact_model import read_contact_model
from r37core.stress.operator import read_stress_operators

from .integration_choice import IntegrationChoice
from .speed_file import write_speed
from .speed_run import run_speed, simulation_of


@dataclass(frozen=True)
class Task:
    """Choices of a simulation at any speed; as JSON text a parameter of its job. `kept`: see run_speed."""

    scene: Scene
    choice: IntegrationChoice
    results: tuple[str, ...]
    kept: Mapping[str, int]


_READY = set[tuple[str, str]]()


def simulate(input: Any, output: Any, params: Any) -> None:
    """A step of the workflow: one simulation. Inputs: models, that of contact first. Output: speed_*.npz.

    Params: job, with speed (rad/s) and task, and about: see `run_job`. Raises what that raises.
    """
    run_job(params.job["speed"], output[0], params.job["task"], str(params.about), *as_list(input.models))


def run_job(speed: str, output: str, task: str, about: str, *models: str) -> None:
    """Simulate at a speed (rad/s) and write the file, with the attributes `about`; `task` is that of a sweep's plan.

    `models`: files of the contact model and, where stress is wanted, of its operator.

    Raises InputFileError, and what Problem and `run_speed` raise.
    """
    wanted, (model, *stress) = from_json(Task, task), models
    operators = _kept(read_stress_operators, *stress) if stress else None
    run = run_speed(
        _kept(read_contact_model, model),
        float(speed),
        wanted.scene,
        wanted.choice,
        wanted.results,
        **wanted.kept,
        stress=operators,
    )
    write_speed(run, output, json.loads(about))


def prepare(input: Any, output: Any, params: Any) -> None:
    """A step of the workflow: compile the time integration; refuse a step too long. Inputs: models, that of contact first.

    Params: scene, choice, speed. Raises InputFileError, and what Problem raises.
    """
    scene, choice = from_plain(Scene, params.scene), from_plain(IntegrationChoice, params.choice)
    problem = simulation_of(read_contact_model(as_list(input.models)[0]), params.speed, scene, choice).problem
    highest, step = problem.blade.frequencies[-1], problem.grid.time_step
    JOB_LOG.debug(f"{params.speed:g} rad/s: highest mode {highest:.6g} rad/s, steps of {step:.6g} s")


def make_ready(input: Any, params: Any) -> tuple[str, str]:
    """Load what all jobs of a model and task have in common, once, for a server that forks them; gives model and task.

    Raises what the job would.
    """
    (model, *stress), task = as_list(input.models), params.job["task"]
    if (model, task) not in _READY:
        _READY.add((model, task))
        wanted = from_json(Task, task)
        simulation_of(_kept(read_contact_model, model), float(params.job["speed"]), wanted.scene, wanted.choice)
        if stress:
            for operator in _kept(read_stress_operators, *stress).values():
                _ = operator.deviatoric
    return model, task


def _kept(read: Callable[[str], Any], file: str) -> Any:
    """The model of a file, read once for all runs of this process and of those forked from it. Raises InputFileError."""
    with readable(file):
        status = os.stat(file)
    return _read_as_of(read, os.path.abspath(file), status.st_mtime_ns, status.st_size)


@lru_cache(maxsize=32)
def _read_as_of(read: Callable[[str], Any], file: str, changed: int, size: int) -> Any:
    """`changed` and `size` tell a file from one that is written in its place."""
    return read(file)
