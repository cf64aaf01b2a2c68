"""What Snakemake would run, as objects: the jobs of its graph after a dry run, through its own interface."""

import json
import tempfile
from dataclasses import dataclass
from pathlib import Path

from workflow_runs import snakemake


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
