"""Tables of docs/clearance.md, from finished results of config/clearance.yaml.

Run: make claims ONLY=clearance. With CalculiX (ccx) on the path the growth is compared with its static solution under large
displacements, about a minute for each blade.
"""

import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np
import pandas as pd

from r37core.config.document import read_document
from r37core.contact.casing import approach
from r37core.dataset_file import read_dataset
from r37core.fem.abaqus_deck import write_abaqus
from r37core.io import write_text
from r37core.mesh.mesh_files import read_vtu
from r37core.product.reading import read_settings
from r37core.results import measures
from r37core.results.datasets import response_of
from r37core.rom.contact_model import read_contact_model
from r37core.rom.rom_file import read_reduced_model
from r37core.stress.recovery import stress_operator
from validation.studies.tables import markdown_table
from r37core.time_integration.clearance import growth
from r37core.time_integration.kept_numbers import with_rotation

RESULTS = Path("results")
MODE, ORDER = "1B", 4
FIXED, GROWING, TOTAL = "abradable", "growing_abradable", "total_stress"
BELOW, ABOVE = 0.015, 0.07
"""Speeds about the crossing, as shares of it, in which the interaction lies: at both ends all blades are quiet."""


def crossing_of(blade):
    """Speed (rad/s) at which the blade's 1B crosses engine order 4."""
    return float(read_dataset(RESULTS / "campbell.nc")["crossing_speed"].sel(blade=blade, mode=MODE, engine_order=ORDER))


def ends(nearer):
    """Change of the clearance (um) at the leading edge, mid-chord and the trailing edge, as text."""
    positions = np.linspace(0, len(nearer) - 1, 3)
    return " / ".join(f"{1e6 * value:+.0f}" for value in np.interp(positions, np.arange(len(nearer)), -nearer))


def in_calculix(blade, material, speed):
    """Displacement (m) of all nodes, shape (nodes, 3), by rotation at `speed` (rad/s) with large displacements."""
    mesh = read_vtu(RESULTS / blade / "mesh.vtu")
    with tempfile.TemporaryDirectory() as folder:
        deck = Path(folder) / "mesh.inp"
        write_abaqus(mesh, deck, material, blade)
        model = deck.read_text().split("*STEP\n")[0]
        load = f"BLADE, CENTRIF, {speed**2}, 0, 0, 0, 0, 0, 1"
        step = ["*STEP, NLGEOM, INC=100", "*STATIC", "0.25, 1.0", "*DLOAD", load, "*NODE PRINT, NSET=ALL_NODES", "U"]
        deck.write_text(model + "\n".join([*step, "*END STEP"]) + "\n")
        subprocess.run(["ccx", "mesh"], cwd=folder, check=True, capture_output=True)
        rows = [line.split() for line in deck.with_suffix(".dat").read_text().splitlines()]
    printed = [row[1:] for row in rows if len(row) == 4 and row[0].isdigit()]
    return np.array(printed[-len(mesh.points) :], dtype=float)


def growth_table(settings):
    """What rotation does to each blade's tip at its crossing."""
    rows = []
    for blade in settings.blades:
        speed, material = crossing_of(blade), settings.blades[blade].material
        contact = read_contact_model(RESULTS / blade / "contact_pressure_edge.npz")
        ours = growth(contact, np.array([speed]), contact.tip_cone_angle)[0]
        reduced = read_reduced_model(RESULTS / blade / "rom_pressure_edge.nc")
        still = with_rotation(np.zeros((1, reduced.size)), contact, speed)
        stress = stress_operator(reduced, material).max_von_mises(still)[0]
        row = {
            "blade": blade,
            "crossing (rad/s)": f"{speed:.0f}",
            "change of clearance (µm)": ends(ours),
            "tip turned (mrad)": f"{1e3 * (contact.spun(speed).theta - contact.theta).mean():+.1f}",
            "stress of rotation / yield": f"{stress / material.yield_stress:.2f}",
        }
        if shutil.which("ccx"):
            nodes = reduced.contact_nodes
            displacement = nodes.cylindrical(in_calculix(blade, material, speed)[nodes.nodes]).T
            theirs = approach(contact.radius, displacement, contact.tip_cone_angle)
            row["with large displacements (CalculiX)"] = ends(theirs)
            row["largest difference (µm)"] = f"{1e6 * np.abs(theirs - ours).max():.0f}"
        rows.append(row)
    return markdown_table(list(rows[0]), [list(row.values()) for row in rows])


def first_touch(scene, revolutions, clearance):
    """Revolution in which the growing lobes reach the blade at rest; NaN where they do not."""
    share = clearance / scene.casing.lobe_height
    return -np.log(1.0 - share) / scene.casing.rise_rate(revolutions) if share < 1.0 else np.nan


def effect_table(settings):
    """Peak, width above yield and first touch with a fixed clearance and with one that the blade's growth changes."""
    datasets = {kind: read_dataset(RESULTS / f"{kind}.nc") for kind in ("rms", "stress")}
    rows = []
    for blade in settings.blades:
        crossing, row = crossing_of(blade), {"blade": blade}
        responses = {}
        for scene in (FIXED, GROWING, TOTAL):
            response = response_of(datasets, blade, scene)
            responses[scene] = response.sel(speed=slice((1.0 - BELOW) * crossing, (1.0 + ABOVE) * crossing))
        peaks = {scene: measures.peak_speed(responses[scene]) for scene in (FIXED, GROWING)}
        row["peak (rad/s)"] = " → ".join(f"{peak:.0f}" for peak in peaks.values())
        for name, scale, of in (
            ("largest rms, normal (mm)", 1e3, lambda run: float(measures.leading_edge(run)["rms_normal"].max())),
            ("width above yield (rad/s)", 1.0, measures.width_above_yield),
        ):
            row[name] = " → ".join(f"{scale * of(responses[scene]):.3g}" for scene in (FIXED, GROWING))
        row["the same, with the stress of rotation"] = f"{measures.width_above_yield(responses[TOTAL]):.3g}"
        chosen, rooms = settings.scenes[GROWING], [settings.scenes[FIXED].scene.casing.clearance]
        rooms.append(responses[GROWING]["clearance"].interp(speed=peaks[GROWING]).min().item())
        touches = [first_touch(chosen.scene, chosen.revolutions, room) for room in rooms]
        row["first touch (revolution)"] = " → ".join(f"{touch:.1f}" for touch in touches)
        rows.append(row)
    return pd.DataFrame(rows)


if __name__ == "__main__":
    shipped = read_settings(Path(), read_document(Path(), "config/clearance.yaml"))
    effects = effect_table(shipped)
    write_text(markdown_table(list(effects), effects.values.tolist()), RESULTS / "studies/clearance_effect.md")
    write_text(growth_table(shipped), RESULTS / "studies/clearance_growth.md")
