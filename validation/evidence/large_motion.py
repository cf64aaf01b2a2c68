"""What large displacements change: largest motion, its speed and the length above yield of the seven blades."""

from typing import Any

import numpy as np
import xarray as xr

from r37core.figures.style import PAGE, plt, save
from r37core.results.columns import MOST_REVOLUTIONS
from r37core.results.exceedance import exceedance_of
from r37core.results.measures import motion
from r37core.results.regions import read_judged

from .pages import write_table
from .which_blade import ON_PATCHES, SCENES, blade_of

KINEMATICS = ("linear", "rotating", "quadratic")
DRAWN = ("Ref", "S100")
"""Blades of the picture: without sweep, and with most of it."""


def changes(input: Any, output: Any, params: Any) -> None:
    """Numbers of each kinematics beside each other, and the motion of two blades. Inputs: responses, by kinematics."""
    runs: dict[tuple[str, str], dict[str, xr.Dataset]] = {}
    for kinematics in KINEMATICS:
        for file in getattr(input, kinematics):
            scene = next(scene for scene, on_patches in ON_PATCHES.items() if f"/{on_patches}/" in file)
            runs.setdefault((blade_of(file), scene), {})[kinematics] = read_judged(file)
    head = [f"{SCENES[scene]}: {what}" for scene in ON_PATCHES for what in ("largest motion, mm", "at", "above yield, rad/s")]
    blades = dict.fromkeys(blade for blade, _ in runs)
    rows = []
    for blade in blades:
        cells = [
            " / ".join(texts) for scene in ON_PATCHES for texts in zip(*map(_texts, runs[blade, scene].values()), strict=True)
        ]
        rows.append([blade, *cells])
    write_table(["blade", *head], rows, output.table)
    _draw(runs, output.picture)


def _texts(response: xr.Dataset) -> tuple[str, str, str]:
    """Largest motion (mm), its speed (rad/s), and the length above yield (rad/s); a run that diverged counts as above."""
    moved = motion(response)
    largest = int(np.nanargmax(moved))
    length = exceedance_of(response).length(MOST_REVOLUTIONS)
    return f"{1e3 * float(moved[largest]):.1f}", f"{float(response['speed'][largest]):.0f}", f"{length:.0f}"


def _draw(runs: dict[tuple[str, str], dict[str, xr.Dataset]], file: str) -> None:
    """Motion over speed of two blades, lined and bare, with each kinematics."""
    figure, axes = plt.subplots(
        len(DRAWN), len(ON_PATCHES), figsize=(PAGE, 0.6 * PAGE), sharex=True, sharey="row", layout="constrained"
    )
    for row, blade in zip(axes, DRAWN, strict=True):
        for panel, scene in zip(row, ON_PATCHES, strict=True):
            for kinematics, response in runs[blade, scene].items():
                panel.plot(response["speed"], 1e3 * np.asarray(motion(response)), label=kinematics, linewidth=1.2)
            panel.set_title(f"{blade}, {SCENES[scene]}")
            panel.grid(alpha=0.3)
        row[0].set_ylabel("motion, rms (mm)")
    for panel in axes[-1]:
        panel.set_xlabel("speed (rad/s)")
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside upper center", ncols=len(KINEMATICS), frameon=False)
    save(figure, file)
