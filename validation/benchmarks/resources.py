"""Memory and time of the jobs of each rule, by the size of the mesh or the number of simulations.

Runs one blade at several levels, and samples what its jobs take with their children. What was measured is kept in
src/r37core/plans/resources.csv, from which the rules say what their jobs need; the table goes into docs/cluster.md.

Run: python validation/benchmarks/resources.py   (about ten minutes; results go to results/runs/resources-<level>)
"""

import ast
import pickle
import re
import subprocess
import sys
import time
from collections import defaultdict
from pathlib import Path

import psutil

from r37core.config.document import command_line_document
from r37core.io import write_text
from r37core.plans.resources import MEASURED, PER_RESPONSE, PER_SWEEP, read_measured
from r37core.product.reading import read_settings

ROOT = Path(__file__).parents[2]
SNAKEMAKE = str(Path(sys.executable).with_name("snakemake"))
LEVELS = ("draft", "standard", "fine")
MANY = 157
"""Speeds of the standard level's sweep, in each scene; the others run a tenth."""

INTERVAL_S = 0.05


def rule_of(job):
    """Rule of a job that Snakemake has started, by the script that it or a child of it runs, and its processes."""
    processes = [job, *job.children(recursive=True)]
    for process in processes:
        found = re.search(r"(\S*scripts/tmp\w+\.step\.py)|scripts/(simulate)\.py", " ".join(process.cmdline()))
        if found:
            return found[2] or rule_in(Path(found[1]).read_text()), processes
    return None, processes


def rule_in(script):
    """Rule of the job that Snakemake wrote this copy of step.py for, from the line that it puts before it."""
    job = re.search(r"pickle\.loads\((b.+?)\);\s*from snakemake", script)[1]
    return pickle.loads(ast.literal_eval(job)).rule


def watch(command):
    """Largest memory (MB) and longest time (s) of the jobs of each rule while `command` runs."""
    memory, began, seconds = defaultdict(float), {}, defaultdict(float)
    main = subprocess.Popen(command, cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    snakemake = psutil.Process(main.pid)
    while main.poll() is None:
        for job in snakemake.children():
            try:
                rule, processes = rule_of(job)
                if rule is None:
                    continue
                resident = sum(process.memory_info().rss for process in processes)
                memory[rule] = max(memory[rule], resident / 2**20)
                start = began.setdefault(job.pid, job.create_time())
                seconds[rule] = max(seconds[rule], time.time() - start)
            except (psutil.NoSuchProcess, FileNotFoundError):
                continue
        time.sleep(INTERVAL_S)
    if main.returncode:
        raise SystemExit(f"failed: {' '.join(command)}")
    return {rule: (memory[rule], seconds[rule]) for rule in memory}


def measure():
    """Rule -> size -> MB and s; the size is the number of mesh nodes, or of simulations."""
    found = defaultdict(dict)
    for level in LEVELS:
        speeds = MANY if level == "standard" else MANY // 10
        changes = {"fidelity": level, "blades": ["Ref"], "run": {"name": f"resources-{level}"}}
        changes["speeds"] = [{"start": 750, "stop": 2000, "step": 1250 / (speeds - 1)}]
        options = [f"{key}={str(value).replace(chr(39), chr(34))}" for key, value in changes.items()]
        measured = watch([SNAKEMAKE, "all_blades", "--forceall", "--cores", "1", "--config", *options])
        nodes = read_settings(ROOT, command_line_document(changes)).fidelity.mesh.nodes
        for rule, (memory, seconds) in measured.items():
            size = speeds if rule in PER_RESPONSE else 2 * speeds if rule in PER_SWEEP else nodes
            before = found[rule].get(size, (0, 0.0))
            found[rule][size] = (max(before[0], round(memory)), max(before[1], round(seconds, 1)))
    return found


def table(measured):
    """The same as a table in Markdown, a row for each rule."""
    lines = ["| rule | with | memory (MB) | time (s) |", "|---|---|---|---|"]
    for rule, rows in measured.items():
        unit = "simulations" if rule in PER_RESPONSE | PER_SWEEP else "nodes"
        sizes, memory, seconds = (", ".join(f"{number:g}" for number in column) for column in zip(*rows, strict=True))
        lines.append(f"| `{rule}` | {sizes} {unit} | {memory} | {seconds} |")
    return "\n".join(lines)


if __name__ == "__main__":
    found = measure()
    lines = [f"{rule},{size},{memory},{time}" for rule in sorted(found) for size, (memory, time) in sorted(found[rule].items())]
    write_text("\n".join(["rule,size,memory_mb,time_s", *lines, ""]), MEASURED)
    write_text(table(read_measured()) + "\n", ROOT / "results/studies/resources.md")
