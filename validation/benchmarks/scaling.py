"""How a sweep scales: one core and two, what one Snakemake can feed, what 1,000 blades at 1,251 speeds would ask for.

Measures in temporary copies of the project; keeps results/studies/scaling.json and puts the table into docs/cluster.md.
Run: python validation/benchmarks/scaling.py [runs] [feeding] [planning]   (about ten minutes for all; ratios inside one run count)
"""

import os
import sys
import tempfile
import time
from pathlib import Path

import psutil

from r37core.io import read_json, write_json, write_text

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "tests"))

from stubbed_runs import copy_stubbed, edit  # noqa: E402
from workflow_runs import SNAKEMAKE, copy_project  # noqa: E402

KEPT = ROOT / "results" / "studies" / "scaling.json"
BLADES, SPEEDS, SCENES = 1000, 1251, 2
"""The campaign that is projected."""


def run(folder, *arguments):
    """Wall time (s), CPU time of Snakemake's own process (s) and its largest memory (MB)."""
    environment = {key: value for key, value in os.environ.items() if not key.startswith("SNAKEMAKE")}
    began, cpu, memory = time.monotonic(), 0.0, 0.0
    with open(folder / "said.txt", "w") as out:
        process = psutil.Popen(
            [SNAKEMAKE, *arguments], cwd=folder, env=environment | {"PYTHONPATH": str(folder / "src")}, stdout=out, stderr=out
        )
        while process.poll() is None:
            try:
                times = process.cpu_times()
                cpu, memory = times.user + times.system, max(memory, process.memory_info().rss / 2**20)
            except psutil.NoSuchProcess:
                break
            time.sleep(0.05)
    if process.wait():
        raise SystemExit((folder / "said.txt").read_text())
    return {"wall_s": time.monotonic() - began, "cpu_s": cpu, "memory_mb": memory}


def speeds(folder, number):
    """Ask for so many speeds on a plain grid."""
    edit(folder, "config.yaml", "- { start: 750, stop: 1600 }", f"- {{ start: 750, stop: 2000, step: {1250 / (number - 1)} }}")


def of_runs(repetitions=2, number=63):
    """Real simulations of one blade at `standard`, on one core and on two by turns."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        copy_project(ROOT, folder)
        edit(folder, "config.yaml", "blades: [Ref, CS100]", "blades: [Ref]")
        edit(folder, "config.yaml", "fidelity: tiny", "fidelity: standard")
        speeds(folder, number)
        run(folder, "responses", "--cores", "2")
        wall = {1: [], 2: []}
        for cores in (1, 2) * repetitions:
            done = [*folder.glob("results/Ref/*/speed_*.npz"), *folder.glob("results/Ref/*/response.nc")]
            for file in done:
                file.unlink()
            wall[cores].append(run(folder, "responses", "--cores", str(cores))["wall_s"])
        size = {
            "simulation_bytes": sum(file.stat().st_size for file in done if file.suffix == ".npz") / (2 * number),
            "response_bytes": sum(file.stat().st_size for file in folder.glob("results/Ref/*/response.nc")) / (2 * number),
            "metadata_bytes": 4096 * len(list((folder / ".snakemake/metadata").rglob("*"))) / (2 * number),
        }
        return {"simulations": 2 * number, "wall_s": {cores: min(times) for cores, times in wall.items()}, **size}


def of_feeding():
    """CPU time (s) of Snakemake's own process for each of many jobs that do next to nothing."""
    feeding = {}
    for cores, subsample, number in ((2, 100, 500), (64, 1000, 500), (64, 100, 500), (64, 100, SPEEDS)):
        with tempfile.TemporaryDirectory() as name:
            folder = idle_project(Path(name), number)
            options = ("--cores", str(cores), "--scheduler-subsample", str(subsample))
            before = run(folder, "results/Ref/contact_pressure_edge.npz", *options)["cpu_s"]
            feeding[f"{2 * number:,} jobs, {cores} cores, subsample {subsample}"] = (
                run(folder, "responses", *options)["cpu_s"] - before
            ) / (2 * number)
    return feeding


def idle_project(folder, number):
    """A copy of one blade whose simulations only touch their file."""
    copy_stubbed(ROOT, folder)
    edit(folder, "config.yaml", "blades: [Ref, CS100]", "blades: [Ref]")
    speeds(folder, number)
    touch = folder / "touch.sh"
    touch.write_text('#!/bin/sh\nsleep 0.1\necho made > "$4"\n')
    touch.chmod(0o755)
    rules = folder / "workflow/rules/common.smk"
    text = rules.read_text()
    line = next(line for line in text.splitlines() if line.startswith("PYTHON = "))
    rules.write_text(text.replace(line, f'PYTHON = Path("{touch}")'))
    return folder


def of_planning():
    """Planning a part of one blade of a thousand, and reading a configuration of a thousand blades."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        copy_stubbed(ROOT, folder)
        speeds(folder, SPEEDS)
        with open(folder / "config/blades.yaml", "a") as stream:
            step = 100.0 / (BLADES - 1)
            values = ", ".join(f"{-50 + step * number:.6g}" for number in range(BLADES))
            stream.write(f"\nMany: {{ base: Ref, vary: {{ chordwise_sweep_deg: [{values}] }} }}\n")
        edit(folder, "config.yaml", "blades: [Ref, CS100]", "blades: [Many]")
        part = run(folder, "responses", "--cores", "1", "--dry-run", "--quiet", "--config", f"run={{part: 7/{BLADES}}}")
        few = run(folder, "results/Ref/geometry.nc", "--cores", "1", "--dry-run", "--quiet", "--config", "blades=[Ref]")
        return {"part": part, "start": few}


def table(measured):
    """What was measured, and what follows for the campaign, in Markdown."""
    lines = ["| measured | |", "|---|---|"]
    runs, feeding, planning = measured["runs"], measured["feeding"], measured["planning"]
    alone, both = runs["wall_s"]["1"], runs["wall_s"]["2"]
    per_run = alone / runs["simulations"]
    campaign = BLADES * SPEEDS * SCENES
    own = feeding[f"{2 * SPEEDS:,} jobs, 64 cores, subsample 100"]
    gb = 2**30
    rows = [
        (
            f"{runs['simulations']} simulations of Ref at `standard` on one core, on two",
            f"{alone:.0f} s, {both:.0f} s: {alone / both:.2f} times as fast",
        ),
        *((f"Snakemake's own time per job, {how}", f"{1e3 * cost:.0f} ms") for how, cost in feeding.items()),
        ("cores that one Snakemake feeds at `standard`", f"{per_run / own:.0f}"),
        (f"configuration of {BLADES:,} blades and plan of one part of it, {SPEEDS * SCENES:,} simulations",
         f"{planning['part']['wall_s']:.0f} s, {planning['part']['memory_mb']:.0f} MB"),
        ("a plan of nearly nothing", f"{planning['start']['wall_s']:.0f} s, {planning['start']['memory_mb']:.0f} MB"),
    ]  # fmt: skip
    lines += [f"| {what} | {value} |" for what, value in rows]
    lines += ["", f"| {BLADES:,} blades, {SPEEDS:,} speeds, {SCENES} scenes: projected | |", "|---|---|"]
    hours = campaign * per_run / 3600.0
    rows = [
        ("simulations", f"{campaign / 1e6:.1f} million"),
        ("time on one core", f"{hours:,.0f} hours; on 1,000 cores {hours / 1000.0:.1f}"),
        ("Snakemake's own work, if one had all", f"{campaign * own / 3600.0:.0f} hours: the bottleneck of one run"),
        ("the same in 1,000 parts, each on its own", f"{SPEEDS * SCENES * own / 60.0:.1f} minutes, beside its simulations"),
        ("files, a simulation, its log and Snakemake's record of it", f"{3 * campaign / 1e6:.1f} million, most of them small"),
        ("simulations' files", f"{campaign * runs['simulation_bytes'] / gb:,.0f} GB"),
        ("responses", f"{campaign * runs['response_bytes'] / gb:,.0f} GB"),
    ]
    lines += [f"| {what} | {value} |" for what, value in rows]
    return "\n".join(lines)


if __name__ == "__main__":
    measures = {"runs": of_runs, "feeding": of_feeding, "planning": of_planning}
    measured = read_json(KEPT) if KEPT.exists() else {}
    for name in sys.argv[1:] or measures:
        measured[name] = measures[name]()
        print(name, measured[name], flush=True)
    KEPT.parent.mkdir(parents=True, exist_ok=True)
    write_json(measured, KEPT)
    if measured.keys() >= measures.keys():
        write_text(table(read_json(KEPT)) + "\n", KEPT.with_suffix(".md"))
