"""What the mesh does to frequencies and peaks: its density, layers, form of the edges, and elements of another program."""

import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from published import INTERACTIONS, REFERENCE

from r37core.config import Settings
from r37core.fem.matrices import StructuralMatrices, assemble
from r37core.fem.solver import lowest_modes
from r37core.mesh.blade_mesh import BladeMesh
from r37core.mesh.generate import generate_mesh
from r37core.results.campbell import campbell_diagram
from r37core.rom.reduce import reduce_blade
from r37core.rom.reduced_model import ReducedModel, contact_model
from r37core.time_integration.speed_run import run_speed
from r37imports.imported_entry import MeshEntry
from r37imports.importing.import_mesh import import_mesh
from r37studies.step_file import write_step

from .configuration import settings_of
from .mesh_step import mesh_step
from .tables import write_table

PUBLISHED = {row.engine_order: row.campbell for row in INTERACTIONS if row.blade == REFERENCE}
"""Crossings of 1B with these orders (rad/s)."""


@dataclass(frozen=True)
class Density:
    """A mesh of the reference blade: round or blunt edges, nodes, layers, and elements along the tip."""

    edges: str
    nodes: int
    layers: int
    tip_elements: int


DENSITIES = (
    Density("round", 5000, 1, 21),
    Density("round", 10000, 1, 28),
    Density("round", 20000, 1, 42),
    Density("blunt", 20000, 1, 42),
    Density("round", 20000, 2, 35),
    Density("round", 40000, 1, 56),
)


def density(input: Any, output: Any, params: Any) -> None:
    """Table of frequencies and crossings of the reference blade on each mesh."""
    settings, rows = settings_of(Path.cwd()), []
    chosen = settings.blades[REFERENCE]
    for case in DENSITIES:
        shape = chosen.shape.build(round_edges=case.edges == "round")
        mesh = generate_mesh(shape, case.nodes, case.layers, case.tip_elements)
        matrices = assemble(mesh, chosen.material)
        crossings = _crossings(_reduced(settings, REFERENCE, mesh, matrices), list(PUBLISHED))
        off = 100.0 * (crossings / np.array(list(PUBLISHED.values())) - 1.0)
        first_six = ", ".join(f"{value:.1f}" for value in _frequencies(matrices))
        rows.append(
            [case.edges, f"{len(mesh.points):,}", f"{case.layers}", first_six, f"{off.min():+.2f} to {off.max():+.2f}%"]
        )
    head = ["edges", "nodes", "layers", "first six frequencies at rest (Hz)", "crossings of 1B off the published ones by"]
    write_table(head, rows, output.table)


def _frequencies(matrices: StructuralMatrices) -> np.ndarray:
    """First six (Hz) at rest."""
    return np.sqrt(lowest_modes(matrices.stiffness(), matrices.mass(), 6)[0]) / (2.0 * np.pi)


def _crossings(model: ReducedModel, orders: list[int]) -> np.ndarray:
    """Speeds (rad/s) at which 1B crosses engine orders."""
    return campbell_diagram(model, np.linspace(0.0, 2000.0, 41), 3).crossing_speeds(np.array(orders))[0]


ELEMENTS = {"tetra10": (31, 50), "hexahedron20": (42, 68)}
"""Elements of another program -> how many along chord and span."""

LINED, SPEED_STEP = "abradable", 2.0
ABOUT = np.arange(-10.0, 25.0, SPEED_STEP)
"""Speeds (rad/s) about the published peak of 1B with engine order 4."""


def remeshed(input: Any, output: Any, params: Any) -> None:
    """Table of how the blades' frequencies and peaks on meshes of another program differ from ours. Params: blades."""
    settings, rows = settings_of(Path.cwd()), []
    level = settings.fidelity.mesh
    for blade in params.blades:
        shape = settings.blades[blade].shape.build(round_edges=True)
        with tempfile.TemporaryDirectory() as folder:
            write_step(shape, Path(folder) / "surface.step")
            meshes = {element: _imported(element, Path(folder)) for element in ELEMENTS}
        frequencies, speed, rms = _measured(
            settings, blade, generate_mesh(shape, level.nodes, level.layers, level.tip_elements)
        )
        for element, mesh in meshes.items():
            theirs, their_speed, their_rms = _measured(settings, blade, mesh)
            off = f"{100.0 * np.abs(theirs / frequencies - 1.0).max():.3f}%"
            changes = [f"{100.0 * (their_speed / speed - 1.0):+.2f}%", f"{100.0 * (their_rms / rms - 1.0):+.1f}%"]
            rows.append([blade, element, f"{len(mesh.points):,}", off, f"{speed:g}", *changes])
    head = ["six frequencies off by up to", "peak of 1B/4 on wedges (rad/s)", "peak off by", "its rms off by"]
    write_table(["blade", "elements", "nodes", *head], rows, output.table)


def _imported(element: str, folder: Path) -> BladeMesh:
    """The blade's surface.step in the folder, meshed by gmsh and read as a mesh of another program, in mm."""
    msh = folder / f"{element}.msh"
    mesh_step(folder / "surface.step", msh, element, *ELEMENTS[element])
    frame = {"length_unit": "mm", "rotor_axis": [0.0, 0.0, 1.0], "radial": [1.0, 0.0, 0.0], "rotation": "negative"}
    entry = MeshEntry(mesh=str(msh), material={}, root="root", tip="tip", **frame)
    return import_mesh(entry.source(folder))[0]


def _reduced(settings: Settings, blade: str, mesh: BladeMesh, matrices: StructuralMatrices) -> ReducedModel:
    choices = settings.boundary_choice(blade), settings.reduction_choice(blade), settings.stress_regions(blade)
    return reduce_blade(mesh, matrices, settings.blades[blade].material, *choices)


def _measured(settings: Settings, blade: str, mesh: BladeMesh) -> tuple[np.ndarray, float, float]:
    """First six frequencies (Hz), speed (rad/s) of the peak of 1B with engine order 4, and its normal rms (m)."""
    matrices = assemble(mesh, settings.blades[blade].material)
    contact = contact_model(_reduced(settings, blade, mesh, matrices), settings.structure.boundary.tip_line)
    published = next(row.peak for row in INTERACTIONS if row.blade == blade and row.engine_order == 4)
    rms = {}
    for speed in SPEED_STEP * round(published / SPEED_STEP) + ABOUT:
        choice = settings.integration_choice(blade, LINED)
        few = {"spectrum_highest_order": 1, "wear_angles": 8}
        rms[speed] = run_speed(contact, float(speed), settings.scenes[LINED].scene, choice, (), **few)["rms_normal"][0]
    peak = max(rms, key=rms.__getitem__)
    return _frequencies(matrices), float(peak), float(rms[peak])
