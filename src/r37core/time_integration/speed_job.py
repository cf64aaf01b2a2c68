"""One simulation of a sweep as a job: from a contact model and a task, as JSON, to its file."""

from __future__ import annotations

import json
from typing import Any

from r37core.contact.scene import Scene
from r37core.plain import from_plain
from r37core.rom.contact_model import read_contact_model

from .integration_choice import IntegrationChoice
from .simulate import Simulation
from .speed_file import write_speed
from .speed_run import run_speed

_READY = set[tuple[str, str]]()


def run_job(model: str, speed: str, output: str, task: str, about: str) -> None:
    """Simulate at a speed (rad/s) and write the file, with the attributes `about`; `task` is that of a sweep's plan.

    With `only_prepare` in the task it compiles what the run needs, refuses what cannot be run, and writes nothing.
    Raises InputFileError, and what Problem raises.
    """
    wanted = json.loads(task)
    scene, choice = _scene_and_choice(wanted)
    contact_model = read_contact_model(model)
    if wanted.get("only_prepare"):
        Simulation(contact_model, float(speed), scene, choice)
        return
    result = run_speed(contact_model, float(speed), scene, choice, wanted["results"], **wanted["kept"])
    write_speed(result, output, json.loads(about))


def make_ready(model: str, speed: str, output: str, log: str, task: str, about: str) -> None:
    """Load what all jobs of a model and task have in common, once, for a server that forks them. Raises what the job would."""
    wanted = json.loads(task)
    if (model, task) not in _READY and not wanted.get("only_prepare"):
        _READY.add((model, task))
        Simulation(read_contact_model(model), float(speed), *_scene_and_choice(wanted))


def _scene_and_choice(wanted: dict[str, Any]) -> tuple[Scene, IntegrationChoice]:
    return from_plain(Scene, wanted["scene"]), from_plain(IntegrationChoice, wanted["choice"])
