"""Figures of programs: those of examples/figures (docs/gallery.md), and the worked example of docs/your_blade.md."""

import contextlib
import re
import runpy
import shutil
import tempfile
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt

import r37


def picture(input: Any, output: Any, params: Any) -> None:
    """Figure of a program, with matplotlib's own style. Params: program."""
    with plt.rc_context():
        runpy.run_path(params.program)["figure"].savefig(output.picture, dpi=110)
        plt.close("all")


def worked_example(input: Any, output: Any, params: Any) -> None:
    """Figures of the example of docs/your_blade.md, drawn, meshed and run as that page says. Params: page."""
    text = Path(params.page).read_text(encoding="utf-8")
    program, entry = (re.findall(rf"```{language}\n(.*?)```", text, re.DOTALL)[0] for language in ("python", "yaml"))
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "draw.py").write_text(program, encoding="utf-8")
        (folder / "blades.yaml").write_text(entry, encoding="utf-8")
        with contextlib.chdir(folder):
            runpy.run_path("draw.py")
        blade = r37.blade("Fan", file=folder / "blades.yaml")
        r37.run(blade, "material_abradable", cores=2, folder=folder / "run", targets="all_blades")
        for figure, file in output.items():
            shutil.copy(folder / f"run/results/figures/{figure}_Fan.png", file)
