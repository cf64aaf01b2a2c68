"""The commands of docs/assess.md and docs/measurement.md on the fan blade: verdicts, pictures and fitted numbers."""

import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from r37core.measured.panel import closing_of_calibration
from r37core.requirements.table import closing

from .tables import write_table

COPIED = ("Snakefile", "config", "envs", "examples", "profiles", "workflow")
STRESS = "fatigue_Fan__Room_0p00034_0p004"


def commands(page: str) -> dict[str, list[str]]:
    """Words of the commands of the page that run, by the name of their run; the first one is that of the file."""
    several = [shlex.split(block) for block in re.findall(r"```sh\n(snakemake .*?)```", page, re.DOTALL)]
    names = [
        next((re.findall(r"name: (\w+)", word)[0] for word in words if word.startswith("run=")), "fan") for words in several
    ]
    return dict(zip(names, several, strict=True))


def measurement(input: Any, output: Any, params: Any) -> None:
    """The lines that runs of docs/measurement.md end with. Inputs: fan, its files. Params: page. Outputs: table, picture."""
    rows = []
    with tempfile.TemporaryDirectory() as name:
        folder = copied(Path(name))
        for words in re.findall(r"```sh\n(snakemake .*?)```", Path(params.page).read_text(encoding="utf-8"), re.DOTALL):
            subprocess.run([sys.executable, "-m", *shlex.split(words)], cwd=folder, check=True)
        for run in ("fan_test", "fan_wrong_model"):
            results = folder / "results/runs" / run
            rows.append([run, "calibrate", closing_of_calibration(results)])
        rows.append(["fan_calibrated", "verdict", closing(folder / "results/runs/fan_calibrated").splitlines()[1].strip()])
        shutil.copy(folder / "results/runs/fan_test/figures/calibration.png", output.picture)
    write_table(["run", "what", "line"], rows, output.table)


def copied(folder: Path) -> Path:
    """The folder with a copy of what a run needs."""
    for part in COPIED:
        (shutil.copytree if Path(part).is_dir() else shutil.copy)(part, folder / part)
    (folder / "src").symlink_to(Path("src").resolve())
    return folder


def verdicts(input: Any, output: Any, params: Any) -> None:
    """The lines that each run ends with. Inputs: fan, its files. Params: page. Outputs: table, map, stress."""
    with tempfile.TemporaryDirectory() as name:
        folder, rows = copied(Path(name)), []
        for run, words in commands(Path(params.page).read_text(encoding="utf-8")).items():
            subprocess.run([sys.executable, "-m", *words], cwd=folder, check=True)
            lines = closing(folder / "results/runs" / run).splitlines()[1:]
            rows += [[run, line.split()[2], line.strip()] for line in lines]
        write_table(["run", "scene", "line"], rows, output.table)
        for picture, figure in (("map", "map_Room"), ("stress", STRESS)):
            shutil.copy(folder / f"results/runs/fan/figures/{figure}.png", output[picture])
