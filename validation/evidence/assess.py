"""The commands of docs/assess.md on the fan blade: verdicts and pictures."""

import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from r37studies.requirements.table import closing

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
