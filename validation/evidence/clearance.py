"""Clearance that changes with the speed: what rotation does to each tip, and to the interaction of 1B with engine order 4."""

import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from r37core.base.dataset_file import read_dataset
from r37core.base.io import InputFileError
from r37core.contact.casing import approach, rise_rate
from r37core.contact.scene import Scene
from r37core.fem.abaqus_deck import write_abaqus
from r37core.fem.material import Material
from r37core.mesh.mesh_files import read_vtu
from r37core.results import measures
from r37core.results.datasets import response_of
from r37core.rom.contact_model import read_contact_model
from r37core.rom.rom_file import read_reduced_model
from r37core.stress.recovery import stress_operator
from r37core.time_integration.clearance import growth
from r37core.time_integration.kept_numbers import append_rotation

from .configuration import settings_of
from .last_revolution import width_above_yield
from .pages import write_table

MODE, ORDER = "1B", 4
FIXED, GROWING, TOTAL = "abradable", "growing_abradable", "total_stress"
BELOW, ABOVE = 0.015, 0.07
"""Speeds about the crossing, as shares of it, in which the interaction lies: at both ends all blades are quiet."""


def tip(input: Any, output: Any, params: Any) -> None:
    """Table of what rotation does to each blade's tip at its crossing, with CalculiX's answer for large displacements.

    Inputs: campbell, and of each blade contact, model, mesh. Raises InputFileError without CalculiX (ccx).
    """
    if not shutil.which("ccx"):
        raise InputFileError("ccx: not found; this table needs CalculiX (on Debian: apt-get install calculix-ccx)")
    settings, campbell, rows = settings_of(Path.cwd()), read_dataset(input.campbell), []
    for blade, contact_file, model_file, mesh in zip(settings.blades, input.contacts, input.models, input.meshes, strict=True):
        speed, material = _crossing(campbell, blade), settings.blades[blade].material
        contact, reduced = read_contact_model(contact_file), read_reduced_model(model_file)
        linear = growth(contact, np.array([speed]), contact.tip_cone_angle)[0]
        still = append_rotation(np.zeros((1, reduced.size)), contact, speed)
        stress = stress_operator(reduced, material).max_von_mises(still)[0]
        nodes = reduced.contact_nodes
        displacement = nodes.cylindrical(_in_calculix(mesh, material, speed)[nodes.nodes]).T
        large = approach(contact.radius, displacement, contact.tip_cone_angle)
        rows.append(
            [
                blade,
                f"{speed:.0f}",
                _ends(linear),
                f"{1e3 * (contact.spun(speed).theta - contact.theta).mean():+.1f}",
                f"{stress / material.yield_stress:.2f}",
                _ends(large),
                f"{1e6 * np.abs(large - linear).max():.0f}",
            ]
        )
    head = ["blade", "crossing (rad/s)", "change of clearance (µm)", "tip turned (mrad)", "stress of rotation / yield"]
    write_table([*head, "large displacements (CalculiX)", "largest difference (µm)"], rows, output.table)


def effect(input: Any, output: Any, params: Any) -> None:
    """Table of peak, width above yield and first touch with a fixed clearance and with a growing blade. Inputs: datasets."""
    settings = settings_of(Path.cwd(), scenes=[FIXED, GROWING, TOTAL])
    campbell = read_dataset(input.campbell)
    datasets = {"rms": read_dataset(input.rms), "stress": read_dataset(input.stress)}
    chosen, rows = settings.scenes[GROWING], []
    for blade in settings.blades:
        around = slice(*(share * _crossing(campbell, blade) for share in (1.0 - BELOW, 1.0 + ABOVE)))
        runs = {scene: response_of(datasets, blade, scene).sel(speed=around) for scene in (FIXED, GROWING, TOTAL)}
        pair = [runs[FIXED], runs[GROWING]]
        tip_gaps = [settings.scenes[FIXED].scene.casing.clearance]
        tip_gaps.append(runs[GROWING]["clearance"].interp(speed=measures.peak_speed(runs[GROWING])).min().item())
        touches = [_first_touch(chosen.scene, chosen.revolutions, gap) for gap in tip_gaps]
        rows.append(
            [
                blade,
                " → ".join(f"{measures.peak_speed(run):.0f}" for run in pair),
                " → ".join(f"{1e3 * float(measures.leading_edge(run)['rms_normal'].max()):.3g}" for run in pair),
                " → ".join(f"{width_above_yield(run):.3g}" for run in pair),
                f"{width_above_yield(runs[TOTAL]):.3g}",
                " → ".join(f"{touch:.1f}" for touch in touches),
            ]
        )
    head = ["blade", "peak (rad/s)", "largest rms, normal (mm)", "width above yield (rad/s)"]
    write_table([*head, "width with the stress of rotation", "first touch (revolution)"], rows, output.table)


def _crossing(campbell: xr.Dataset, blade: str) -> float:
    """Speed (rad/s) at which the blade's 1B crosses engine order 4."""
    return float(campbell["crossing_speed"].sel(blade=blade, mode=MODE, engine_order=ORDER))


def _ends(nearer: np.ndarray) -> str:
    """Change of the clearance (um) at leading edge, mid-chord and trailing edge."""
    positions = np.linspace(0, len(nearer) - 1, 3)
    return " / ".join(f"{1e6 * value:+.0f}" for value in np.interp(positions, np.arange(len(nearer)), -nearer))


def _in_calculix(mesh: str, material: Material, speed: float) -> np.ndarray:
    """Displacement (m) of all nodes, shape (nodes, 3), by rotation at `speed` (rad/s) with large displacements."""
    points = read_vtu(mesh)
    with tempfile.TemporaryDirectory() as folder:
        deck = Path(folder) / "mesh.inp"
        write_abaqus(points, deck, material, "blade")
        model = deck.read_text().split("*STEP\n")[0]
        load = f"BLADE, CENTRIF, {speed**2}, 0, 0, 0, 0, 0, 1"
        step = ["*STEP, NLGEOM, INC=100", "*STATIC", "0.25, 1.0", "*DLOAD", load, "*NODE PRINT, NSET=ALL_NODES", "U"]
        deck.write_text(model + "\n".join([*step, "*END STEP"]) + "\n")
        subprocess.run(["ccx", "mesh"], cwd=folder, check=True, capture_output=True)
        rows = [line.split() for line in deck.with_suffix(".dat").read_text().splitlines()]
    printed = [row[1:] for row in rows if len(row) == 4 and row[0].isdigit()]
    return np.array(printed[-len(points.points) :], dtype=float)


def _first_touch(scene: Scene, revolutions: int, clearance: float) -> float:
    """Revolution in which the growing lobes reach the blade at rest; NaN where they do not."""
    share = clearance / scene.casing.lobe_height
    return -np.log(1.0 - share) / rise_rate(scene.casing.rise_time(revolutions, revolutions)) if share < 1.0 else np.nan
