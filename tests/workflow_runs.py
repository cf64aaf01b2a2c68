"""Copies of the project with a small sweep, changes of their configuration, Snakemake run on them, and what it would run."""

import hashlib
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import venv
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import netCDF4
import numpy as np
import warm_snakemake
import yaml

from r37core.base.yaml_file import load_yaml

SNAKEMAKE = str(Path(sys.executable).with_name("snakemake"))
LONGEST = 1800
"""Of one command (s): ten times what a sweep takes, for the machine may be busy."""


def copy_project(root, to):
    """A copy with a small sweep. Its package is that of the checkout: see `own_package`."""
    for folder in ("config", "workflow", "profiles", "envs"):
        shutil.copytree(root / folder, to / folder, symlinks=True, ignore=shutil.ignore_patterns("__pycache__"))
    (to / "src").symlink_to((root / "src").resolve())
    shutil.copy(root / "Snakefile", to / "Snakefile")
    overlay(to, "config.yaml", "{ blades: [Ref, CS100], fidelity: tiny, speeds: [{ start: 750, stop: 1600 }] }")
    scenes = load_yaml(to / "config/scenes.yaml")
    (to / "config/scenes.yaml").write_text(yaml.safe_dump({name: scenes[name] for name in ("abradable", "direct")}))
    # few enough modes that both blades have programs of one layout
    overlay(
        to,
        "fidelity.yaml",
        "tiny:\n  mesh: { nodes: 1500, layers: 1, tip_elements: 14 }\n  reduction: { fixed_interface_modes: 8 }\n"
        "  time_integration: { integrator: exact_modal, largest_time_step_s: { lined: 6.4e-6, direct: 6.4e-6 },\n"
        "    revolutions: 8, speed_step_rad_s: 400 }\n",
    )


def overlay(project, name, text):
    """Lay the YAML `text` on config/`name`: mappings are joined, what else it names is replaced; comments are gone then."""
    file = project / "config" / name
    file.write_text(yaml.safe_dump(_joined(load_yaml(file), yaml.safe_load(text)), sort_keys=False, allow_unicode=True))


def _joined(below, above):
    if not (isinstance(below, dict) and isinstance(above, dict)):
        return above
    return below | {key: _joined(below.get(key), value) for key, value in above.items()}


def copy_finished(finished, to):
    """A copy of a project and of all that was made in it, with the times of its files: nothing has to be made again."""
    shutil.copytree(finished, to, symlinks=True, copy_function=shutil.copy2)
    return to


def digests(project):
    """SHA-256 of all files in `results`, by their paths in the project."""
    files = [file for file in sorted((project / "results").rglob("*")) if file.is_file()]
    return {str(file.relative_to(project)): hashlib.sha256(file.read_bytes()).hexdigest() for file in files}


def dataset_values(folder):
    """Every array of every dataset, numbers as bytes."""
    found = {}
    for file in sorted((folder / "results").rglob("*.nc")):
        with netCDF4.Dataset(file) as dataset:
            dataset.set_auto_maskandscale(False)
            for name, variable in dataset.variables.items():
                stored = np.asarray(variable[:])
                found[str(file.relative_to(folder)), name] = stored.tolist() if stored.dtype == object else stored.tobytes()
    return found


def lose_speed(file):
    """Remove the file and what was made of it: Snakemake makes nothing again that only finished files would need."""
    results = file.parents[2]
    for lost in (file, file.parent / "response.nc", *results.glob("*.nc"), *results.glob("figures/*")):
        lost.unlink()


def own_package(project):
    """Let a copy have a package of its own, to be edited; `src/r37/config` is a link to the copy's configuration there."""
    source = project / "src"
    shared = source.resolve()
    source.unlink()
    shutil.copytree(shared, source, symlinks=True, ignore=shutil.ignore_patterns("*.egg-info", "*.pyc.*", "*.o", "*.partial"))
    # what was compiled for one copy is good for all
    shutil.rmtree(source / "r37core/__pycache__", ignore_errors=True)
    (source / "r37core/__pycache__").symlink_to(shared / "r37core/__pycache__")


NAME = 'it\'s "my" $(touch EXECUTED) `touch EXECUTED`; touch EXECUTED & rotor'


def copy_odd_project(root, to):
    """A copy in a folder whose name a shell would take apart, with a virtual environment as `make setup` has it.

    The environment borrows the packages of this one.
    """
    project = to / NAME
    project.mkdir()
    copy_project(root, project)
    for name in ("Makefile", "pyproject.toml"):
        (project / name).write_text((root / name).read_text())
    venv.create(project / ".venv", symlinks=True)
    packages = next((project / ".venv").glob("lib/python*/site-packages"))
    (packages / "borrowed.pth").write_text("\n".join(path for path in sys.path if path.endswith("site-packages")))
    (project / ".venv/.ready").touch()
    return project


def run_in_odd_project(folder, *command):
    """What the command prints. It may run nothing that stands in the folder's name."""
    variables = environment(folder) | {"R37_FULL_LOG": ""}
    done = subprocess.run(command, cwd=folder, env=variables, capture_output=True, text=True, timeout=LONGEST, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert not list(folder.parent.rglob("EXECUTED"))
    return done.stdout + done.stderr


def source(folder):
    """Where a project's package lies."""
    return folder / "src"


def snakemake(folder, *arguments, check=True, jobs=None, full_log="1"):
    """What the command prints. `jobs`: a file for the jobs that it plans: see `plan`."""
    variables = environment(folder) | {"R37_FULL_LOG": full_log}
    status, text = warm_snakemake.run(folder, arguments, variables, LONGEST, jobs)
    assert not check or status == 0, text
    return text


def kill_snakemake(folder, *arguments, when):
    """Start the command and kill it with its jobs as soon as `when()` holds, if it has not ended before."""
    command = warm_snakemake.started(folder, arguments, environment(folder), LONGEST)
    with command as (process, _):
        while process.poll() is None and not when():
            time.sleep(0.01)
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()


def wait_until(happened, seconds, what):
    end = time.monotonic() + seconds
    while not happened():
        assert time.monotonic() < end, f"waited {seconds} s for {what}"
        time.sleep(0.02)


def environment(folder):
    """Variables of a command in a project, whose package is its own."""
    kept = {key: value for key, value in os.environ.items() if not key.startswith("SNAKEMAKE")}
    return kept | {"PYTHONPATH": str(source(folder)), "R37_FULL_LOG": "1"}


@dataclass(frozen=True)
class Job:
    """One job that would run; its files are relative to the folder of the run."""

    rule: str
    wildcards: dict[str, str]
    inputs: list[str]
    outputs: list[str]
    priority: float
    because_of_params: bool
    """Whether one of its parameters differs from those that its files were made with."""


def plan(folder, *arguments):
    """Jobs of a dry run, `all_blades` unless arguments of Snakemake say something else."""
    with tempfile.TemporaryDirectory() as place:
        file = Path(place) / "jobs.json"
        snakemake(folder, *(arguments or ("all_blades",)), "--cores", "1", "--dry-run", jobs=file)
        return [Job(**values) for values in json.loads(file.read_text())]


def planned(folder, *arguments):
    """Rule -> blades of its jobs, with None for a job of no blade."""
    return _by_rule((job.rule, job.wildcards.get("blade")) for job in plan(folder, *arguments))


def planned_outputs(folder, *arguments):
    """Rule -> first output of each of its jobs, in `results`."""
    jobs = plan(folder, *arguments)
    return _by_rule((job.rule, job.outputs[0].removeprefix("results/")) for job in jobs if job.outputs)


def _by_rule(pairs):
    found = {}
    for rule, value in pairs:
        found.setdefault(rule, set()).add(value)
    return found
