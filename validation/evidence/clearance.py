"""Clearance that changes with the speed: what rotation does to each tip, and to the interaction of 1B with engine order 4."""

from pathlib import Path
from typing import Any

import numpy as np

from r37core.base.dataset_file import read_dataset
from r37core.contact.casing import approach
from r37core.fem.material import Material
from r37core.mesh.mesh_files import read_vtu
from r37core.results.danger import ratio_inside
from r37core.results.measures import peak_of
from r37core.results.regions import read_judged
from r37core.rom.contact_model import read_contact_model
from r37core.rom.rom_file import read_reduced_model
from r37core.time_integration.clearance import growth

from .calculix import displacements
from .configuration import settings_of
from .tables import danger_cell, write_table


def tip(input: Any, output: Any, params: Any) -> None:
    """Change of each blade's clearance by rotation at its crossing of 1B/4, with CalculiX's answer for large displacements.

    Inputs: campbell, and of each blade contact, model, mesh. Params: blades. Raises InputFileError without CalculiX (ccx).
    """
    settings, crossings, rows = settings_of(Path.cwd()), read_dataset(input.campbell)["crossing_speed"], []
    for blade, contact_file, model_file, mesh in zip(params.blades, input.contacts, input.models, input.meshes, strict=True):
        speed = float(crossings.sel(blade=blade, mode="1B", engine_order=4))
        contact, nodes = read_contact_model(contact_file), read_reduced_model(model_file).contact_nodes
        displacement = nodes.cylindrical(_in_calculix(mesh, settings.blades[blade].material, speed)[nodes.nodes]).T
        own = growth(contact, np.array([speed]), contact.tip_cone_angle)[0]
        other = approach(contact.radius, displacement, contact.tip_cone_angle)
        rows.append([blade, f"{speed:.0f}", _ends(own), _ends(other), f"{1e6 * np.abs(own - other).max():.0f}"])
    head = ["blade", "crossing (rad/s)", "change of clearance (µm)", "by CalculiX (µm)", "largest difference (µm)"]
    write_table(head, rows, output.table)


def effect(input: Any, output: Any, params: Any) -> None:
    """Largest motion, stress inside the model, and lengths, with the clearance at speed and at rest. Inputs: fixed, growing."""
    rows = []
    for blade, *files in zip(params.blades, input.fixed, input.growing, strict=True):
        pair = [read_judged(file) for file in files]
        rows.append(
            [
                blade,
                " → ".join(f"{float(peak_of(run)['speed']):.0f}" for run in pair),
                " → ".join(f"{float(ratio_inside(run).max()):.2f}" for run in pair),
                " → ".join(map(danger_cell, pair)),
            ]
        )
    write_table(
        ["blade", "largest motion at (rad/s)", "largest stress / yield", "dangerous / unknown / sustained (rad/s)"],
        rows,
        output.table,
    )


def _ends(nearer: np.ndarray) -> str:
    """Change of the clearance (um) at leading edge, mid-chord and trailing edge."""
    positions = np.linspace(0, len(nearer) - 1, 3)
    return " / ".join(f"{1e6 * value:+.0f}" for value in np.interp(positions, np.arange(len(nearer)), -nearer))


def _in_calculix(mesh: str, material: Material, speed: float) -> np.ndarray:
    """Displacement (m) of all nodes, shape (nodes, 3), by rotation at `speed` (rad/s) with large displacements."""
    blade, load = read_vtu(mesh), f"BLADE, CENTRIF, {speed**2}, 0, 0, 0, 0, 0, 1"
    step = ["*STEP, NLGEOM, INC=100", "*STATIC", "0.25, 1.0", "*DLOAD", load, "*NODE PRINT, NSET=ALL_NODES", "U", "*END STEP"]
    return displacements(blade, material, step)[-len(blade.points) :]
