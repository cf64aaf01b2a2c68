"""Simulate one blade at one speed in one scene. Arguments: contact model, speed, output, log, task, about. Output: speed_*.npz.

With `only_prepare` in the task it compiles what the run needs, refuses what cannot be run, and writes nothing.
Started by start.py, without Snakemake's own preamble; task and attributes of the file, in JSON, are made in r37core.plans.
"""

import json
import sys

from r37core.console.failures import reported
from r37core.contact.scene import Scene
from r37core.native import this_processor
from r37core.plain import from_plain
from r37core.rom.contact_model import read_contact_model
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.speed_file import write_speed
from r37core.time_integration.speed_run import run_speed

# for the jobs that a server forks from here
this_processor()
MADE_READY = set()


def make_ready(model, speed, output, log, task, about):
    """Load what all jobs of a model and task have in common, once, for the server that forks them."""
    if (model, task) not in MADE_READY and "only_prepare" not in task:
        MADE_READY.add((model, task))
        Simulation(read_contact_model(model), float(speed), *scene_and_choice(json.loads(task)))


def scene_and_choice(task):
    return from_plain(Scene, task["scene"]), from_plain(IntegrationChoice, task["choice"])


def main(model, speed, output, task, about):
    task = json.loads(task)
    scene, choice = scene_and_choice(task)
    contact_model = read_contact_model(model)
    if task.get("only_prepare"):
        Simulation(contact_model, float(speed), scene, choice)
        return
    result = run_speed(contact_model, float(speed), scene, choice, task["results"], **task["kept"])
    write_speed(result, output, json.loads(about))


if __name__ == "__main__":
    model, speed, output, log, task, about = sys.argv[1:]
    with reported("simulate", log, f"speed {speed}, "):
        main(model, speed, output, task, about)
