"""Copies of the project with a small sweep, and Snakemake run on them."""

import os
import re
import shutil
import subprocess
import sys
import venv
from pathlib import Path

import warm_snakemake

SNAKEMAKE = str(Path(sys.executable).with_name("snakemake"))
LONGEST = 1800
"""Of one command (s): ten times what a sweep takes, for the machine may be busy."""


def copy_project(root, to):
    for folder in ("config", "workflow", "profiles", "envs", "src"):
        # src/r37/config stays a link: to the copy's config/
        shutil.copytree(root / folder, to / folder, symlinks=True, ignore=shutil.ignore_patterns("__pycache__", "*.egg-info"))
    # what was compiled for one copy is good for all
    compiled = Path("src/r37core/__pycache__")
    (root / compiled).mkdir(exist_ok=True)
    (to / compiled).symlink_to(root / compiled)
    shutil.copy(root / "Snakefile", to / "Snakefile")
    config = (to / "config/config.yaml").read_text()
    config = config.replace("blades: all ", "blades: [Ref, CS100] ").replace("fidelity: standard ", "fidelity: tiny ")
    config = re.sub(r"- \{ start: 750, stop: 2000.*\}", "- { start: 750, stop: 1600 }", config)
    (to / "config/config.yaml").write_text(config)
    scenes = (to / "config/scenes.yaml").read_text()
    (to / "config/scenes.yaml").write_text(re.split(r"\n\n(?:#.*\n)*physical_", scenes, maxsplit=1)[0] + "\n")
    with open(to / "config/fidelity.yaml", "a") as stream:
        stream.write(
            # few enough modes that both blades have programs of one layout
            "\ntiny:\n  mesh: { nodes: 1500, layers: 1, tip_elements: 14 }\n  reduction: { fixed_interface_modes: 8 }\n"
            "  time_integration: { time_step_s: 2.0e-7, revolutions: 8, speed_step_rad_s: 400 }\n"
        )


NAME = 'it\'s "my" $(touch EXECUTED) `touch EXECUTED`; touch EXECUTED & rotor'


def copy_odd_project(root, to):
    """A copy in a folder whose name a shell would take apart, with a virtual environment as `make setup` has it.

    The environment borrows the packages of this one.
    """
    project = to / NAME
    project.mkdir()
    copy_project(root, project)
    for name in ("Makefile", "pyproject.toml", "cluster/sweep.sbatch"):
        (project / name).parent.mkdir(exist_ok=True)
        (project / name).write_text((root / name).read_text())
    venv.create(project / ".venv", symlinks=True)
    packages = next((project / ".venv").glob("lib/python*/site-packages"))
    (packages / "borrowed.pth").write_text("\n".join(path for path in sys.path if path.endswith("site-packages")))
    (project / ".venv/.ready").touch()
    return project


def run_in_odd_project(folder, *command, **environment):
    """What the command prints. It may run nothing that stands in the folder's name."""
    kept = {key: value for key, value in os.environ.items() if not key.startswith("SNAKEMAKE")}
    environment = kept | {"PYTHONPATH": str(folder / "src")} | environment
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, timeout=LONGEST, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert not list(folder.parent.rglob("EXECUTED"))
    return done.stdout + done.stderr


def source(folder):
    """Where a project's package lies."""
    return folder / "src"


def snakemake(folder, *arguments, check=True):
    environment = {key: value for key, value in os.environ.items() if not key.startswith("SNAKEMAKE")}
    environment |= {"PYTHONPATH": str(source(folder)), "R37_FULL_LOG": "1"}
    status, text = warm_snakemake.run(folder, arguments, environment, LONGEST)
    assert not check or status == 0, text
    return text


def planned(folder, *arguments):
    """Jobs of a dry run: rule -> blades (None for a rule without the wildcard)."""
    jobs = {}
    text = snakemake(folder, *(arguments or ("all_blades",)), "--cores", "2", "--dry-run")
    for block in re.split(r"\n\[", text.split("Job stats:")[1] if text.startswith("Job stats") else text):
        rule = re.search(r"^(?:local)?rule (\w+):", block, re.MULTILINE)
        if rule:
            blade = re.search(r"wildcards: blade=(\w+)", block)
            jobs.setdefault(rule[1], set()).add(blade[1] if blade else None)
    return jobs
