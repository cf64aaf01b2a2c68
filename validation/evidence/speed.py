"""What runs and studies cost, and how that grows (docs/speed.md): CPU time of the product's command with all its processes."""

import json
import re
import shutil
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from resource import RUSAGE_CHILDREN, getrusage
from tempfile import TemporaryDirectory
from typing import Any

import pandas as pd

from r37core.base.yaml_file import load_yaml
from r37studies.other_models import tip_elements

from .tables import write_table

NAME = "cost"
RESULTS = Path("results/runs") / NAME

STAGES = {"models": "campbell", "sweep": f"{RESULTS}/rms.nc", "further runs": "tables", "pictures": "all_blades"}
"""Part of a study -> the target that is asked for after those before it."""

PARTS = ["time integration", "files", "jobs"]
"""Parts of a run in the table of the extension `estimate`."""


def runs(input: Any, output: Any, params: Any) -> None:
    """CPU time of a run and of its parts. Output: table. Inputs: by the name of a row, a table of the extension `estimate`."""
    costs = {name: _of_a_run(file) for name, file in input.items()}
    rows = [[name, *(f"{cost:.0f}" for cost in (*parts, sum(parts)))] for name, parts in costs.items()]
    write_table(["run", *(f"{part} (ms)" for part in (*PARTS, "total"))], rows, output.table)


def _of_a_run(file: str | Path) -> list[float]:
    """CPU time (ms) of the PARTS."""
    rows = pd.read_csv(file).set_index("part").loc[PARTS]
    return (6e4 * rows["core_min"] / rows["simulations"]).tolist()


def studies(input: Any, output: Any, params: Any) -> None:
    """CPU time of studies by part, and number of simulations, beside what a run says of them when it begins. Output: table.

    Params: studies, name -> files and keys of the configuration.
    """
    rows = []
    for name, (files, keys) in params.studies.items():
        shutil.rmtree(RESULTS, ignore_errors=True)
        told, spent = zip(*(_snakemake(target, keys, files) for target in STAGES.values()), strict=True)
        number = sum(int((re.findall(r"simulations (\d+)", text) or [0])[-1]) for text in told)
        said, time = said_before(told[0])
        parts = [f"{part / 60.0:.1f}" for part in (*spent, sum(spent))]
        rows.append([name, f"{number:,} ({said:,})", *parts[:-1], f"{parts[-1]} ({time:.1f})"])
    write_table(["core minutes", "simulations (said)", *STAGES, "total (said)"], rows, output.table)


def said_before(text: str) -> tuple[int, float]:
    """Number of simulations and CPU time (min) that a run says when it begins."""
    parts = re.findall(r"[a-z_]+ (?:about )?(\d+)", re.findall(r"simulations: (.*)", text)[0])
    return sum(map(int, parts)), float(re.findall(r"CPU time: about (\S+)", text)[0])


def growth(input: Any, output: Any, params: Any) -> None:
    """CPU time at several sizes of what grows, and memory of the mesh. Output: table.

    Params: nodes, modes, speeds, blades: their sizes; configuration, its keys.
    """
    level, blade = load_yaml(Path("config/fidelity.yaml"))["draft"], load_yaml(Path("config/blades.yaml"))["Ref"]

    def changed(target: str, part: str, **values: Any) -> float:
        """CPU time (s) of a command at a level with other values."""
        return _snakemake(target, params.configuration | {"fidelity_file": {"draft": level | {part: level[part] | values}}})[1]

    def planned(**keys: Any) -> float:
        """CPU time (s) of a dry run."""
        return _snakemake("all_blades", {"scenes": ["abradable"], **keys}, [], "--dry-run", "--quiet", "all")[1]

    def family(number: int) -> dict[str, Any]:
        """So many blades, by their thickness."""
        varied = {"thickness_percent": [98.0 + 4.0 * place / number for place in range(number)]}
        return {"blades": ["Family"], "blades_file": {"Ref": blade, "Family": {"base": "Ref", "vary": varied}}, "speeds": [1e3]}

    models, memory, runs = dict[int, float](), dict[int, float](), dict[int, float]()
    # first, as memory is the largest of all commands so far
    for nodes in params.nodes:
        models[nodes] = changed("campbell", "mesh", nodes=nodes, tip_elements=tip_elements(nodes))
        memory[nodes] = getrusage(RUSAGE_CHILDREN).ru_maxrss / 1e6
    for modes in params.modes:
        changed("estimate", "reduction", fixed_interface_modes=modes)
        runs[modes] = _of_a_run(RESULTS / "estimate.csv")[0]
    rows = {
        "speeds of 7 blades: planning (s)": {
            of: planned(speeds=[{"start": 750, "stop": 2000, "step": 1250 / of}]) for of in params.speeds
        },
        "blades: planning (s)": {of: planned(**family(of)) for of in params.blades},
        "nodes: model (s)": models,
        "nodes: memory (GB)": memory,
        "modes: run (ms)": runs,
    }
    listed = (
        [name, "/".join(map("{:,}".format, of)), "/".join(map("{:.3g}".format, of.values()))] for name, of in rows.items()
    )
    write_table(["what grows: cost", "sizes", "at each size"], listed, output.table)


def _snakemake(target: str, keys: Mapping[str, Any], files: Sequence[str] = (), *options: str) -> tuple[str, float]:
    """What the product's command says, and its CPU time (s), with files and keys on top of the shipped configuration.

    Keys that name a file have its content.
    """
    with TemporaryDirectory() as folder:

        def written(name: str, content: Any) -> str:
            # a file of JSON is one of YAML
            (file := Path(folder) / f"{name}.yaml").write_text(json.dumps(content))
            return str(file)

        named = {key: written(key, value) if key in ("blades_file", "fidelity_file") else value for key, value in keys.items()}
        words = ["snakemake", target, "--cores", "1", "--nolock", *options, "--configfile", "config/config.yaml"]
        words += [*files, written("keys", named | {"run": {"name": NAME}})]
        before = getrusage(RUSAGE_CHILDREN)
        text = subprocess.run([sys.executable, "-m", *words], check=True, stderr=subprocess.PIPE, text=True).stderr
        after = getrusage(RUSAGE_CHILDREN)
    return text, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
