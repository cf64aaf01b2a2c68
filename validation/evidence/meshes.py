"""What the mesh does to frequencies and peaks: density, layers, form of the edges, and meshes of another program."""

import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from r37core.base.io import as_list, read_json, write_json
from r37core.config import Settings
from r37core.config.imported_entry import MeshEntry
from r37core.exchange.importing.import_mesh import import_mesh
from r37core.exchange.step_file import write_step
from r37core.fem.matrices import StructuralMatrices, assemble
from r37core.fem.solver import lowest_modes
from r37core.mesh.blade_mesh import BladeMesh
from r37core.mesh.generate import generate_mesh
from r37core.results.campbell import campbell_diagram
from r37core.rom.reduce import reduce_blade
from r37core.rom.reduced_model import ReducedModel, contact_model
from r37core.time_integration.speed_run import run_speed

from .configuration import settings_of
from .mesh_step import mesh_step
from .pages import write_table

PUBLISHED = {7: 806.0, 6: 965.0, 5: 1213.0, 4: 1672.0}
"""Crossings of 1B with these orders (rad/s), of the paper."""


@dataclass(frozen=True)
class Density:
    """A mesh of the reference blade: round or blunt edges, nodes, layers, and elements along the tip."""

    edges: str
    nodes: int
    layers: int
    tip_elements: int


DENSITIES = (
    Density("round", 2500, 1, 14),
    Density("round", 5000, 1, 21),
    Density("round", 10000, 1, 28),
    Density("round", 20000, 1, 42),
    Density("blunt", 20000, 1, 42),
    Density("round", 40000, 1, 56),
    Density("round", 20000, 2, 35),
    Density("round", 60000, 2, 56),
)


def density(input: Any, output: Any, params: Any) -> None:
    """Frequencies and crossings of the reference blade on each mesh."""
    settings, rows = settings_of(Path.cwd()), []
    chosen = settings.blades["Ref"]
    for case in DENSITIES:
        shape = chosen.definition.build(round_edges=case.edges == "round")
        mesh = generate_mesh(shape, case.nodes, case.layers, case.tip_elements)
        matrices = assemble(mesh, chosen.material)
        found = crossings(_reduced(settings, "Ref", mesh, matrices), list(PUBLISHED))
        off = 100.0 * (found / np.array(list(PUBLISHED.values())) - 1.0)
        values = [
            ", ".join(f"{value:.{digits}f}" for value in several)
            for several, digits in ((frequencies(matrices), 2), (found, 1))
        ]
        rows.append([case.edges, f"{len(mesh.points)}", f"{case.layers}", *values, f"{off.min():+.2f} to {off.max():+.2f}%"])
    head = ["edges", "nodes", "layers", "first six frequencies at rest (Hz)"]
    write_table([*head, "1B crossings with 7, 6, 5, 4 (rad/s)", "off the published ones by"], rows, output.table)


def frequencies(matrices: StructuralMatrices) -> np.ndarray:
    """First six (Hz) at rest."""
    return np.sqrt(lowest_modes(matrices.stiffness(), matrices.mass(), 6)[0]) / (2.0 * np.pi)


def crossings(model: ReducedModel, orders: list[int]) -> np.ndarray:
    """Speeds (rad/s) at which 1B crosses engine orders."""
    return campbell_diagram(model, np.linspace(0.0, 2000.0, 41), 3).crossing_speeds(np.array(orders))[0]


OURS = "wedge15"
ELEMENTS = {"tetra10": (31, 50), "hexahedron20": (42, 68)}
"""Elements of another program -> how many along chord and span."""

LINED, ORDER, SPEED_STEP = "abradable", 4, 2.0
RANGE = (0.98, 1.06)
"""Where the peak of 1B with ORDER is looked for, as shares of the Campbell speed."""


def of_blade(input: Any, output: Any, params: Any) -> None:
    """Frequencies and peak of a blade on our mesh and on those of another program. Params: blade."""
    settings = settings_of(Path.cwd())
    chosen, level = settings.blades[params.blade], settings.fidelity.mesh
    shape, measured = chosen.definition.build(round_edges=True), {}
    with tempfile.TemporaryDirectory() as folder:
        write_step(shape, Path(folder) / "surface.step")
        for element in (OURS, *ELEMENTS):
            own = element == OURS
            mesh = (
                generate_mesh(shape, level.nodes, level.layers, level.tip_elements) if own else imported(element, Path(folder))
            )
            measured[element] = _measured(settings, params.blade, mesh)
    write_json(measured, Path(output[0]))


def imported(element: str, folder: Path) -> BladeMesh:
    """The blade's surface.step in the folder, meshed by gmsh and read as a mesh of another program, in mm."""
    msh = folder / f"{element}.msh"
    mesh_step(folder / "surface.step", msh, element, *ELEMENTS[element])
    frame = {"length_unit": "mm", "rotor_axis": [0.0, 0.0, 1.0], "radial": [1.0, 0.0, 0.0], "rotation": "negative"}
    entry = MeshEntry(mesh=str(msh), material={}, root="root", tip="tip", **frame)
    return import_mesh(entry.source(folder))[0]


def _reduced(settings: Settings, blade: str, mesh: BladeMesh, matrices: StructuralMatrices) -> ReducedModel:
    choices = settings.boundary_choice(blade), settings.reduction_choice(blade), settings.stress_regions(blade)
    return reduce_blade(mesh, matrices, settings.blades[blade].material, *choices)


def _measured(settings: Settings, blade: str, mesh: BladeMesh) -> dict[str, Any]:
    material = settings.blades[blade].material
    matrices = assemble(mesh, material)
    model = _reduced(settings, blade, mesh, matrices)
    contact = contact_model(model, settings.structure.boundary.tip_line)
    first, last = (share * crossings(model, [ORDER])[0] / SPEED_STEP for share in RANGE)
    speeds = np.arange(np.ceil(first), last) * SPEED_STEP
    rms = []
    for speed in speeds:
        choice = settings.integration_choice(blade, LINED, speed)
        few = {"spectrum_highest_order": 1, "wear_angles": 8}
        rms.append(run_speed(contact, speed, settings.scenes[LINED].scene, choice, (), **few)["rms"][0, 0])
    peak = {"peak": float(speeds[np.argmax(rms)]), "rms": float(np.max(rms))}
    return {"nodes": len(mesh.points), "frequencies": frequencies(matrices).tolist(), **peak}


def remeshed(input: Any, output: Any, params: Any) -> None:
    """Differences of each blade's meshes from ours. Input: files of `of_blade`."""
    rows = []
    for file in as_list(input.files):
        measured = read_json(Path(file))
        ours = measured[OURS]
        for element in ELEMENTS:
            row = measured[element]
            off = np.abs(np.array(row["frequencies"]) / ours["frequencies"] - 1.0).max()
            changes = [f"{100.0 * (row[name] / ours[name] - 1.0):+.{digits}f}%" for name, digits in (("peak", 2), ("rms", 1))]
            rows.append([Path(file).stem, element, f"{row['nodes']:,}", f"{100.0 * off:.3f}%", f"{ours['peak']:g}", *changes])
    head = ["six frequencies off by up to", "peak of 1B/4 on wedges (rad/s)", "peak off by", "its rms off by"]
    write_table(["blade", "elements", "nodes", *head], rows, output.table)
