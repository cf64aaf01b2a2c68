"""What the density of the mesh, its layers and the form of the edges do to frequencies."""

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
from r37core.rom.reduced_model import ReducedModel

from .configuration import settings_of
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


def _reduced(settings: Settings, blade: str, mesh: BladeMesh, matrices: StructuralMatrices) -> ReducedModel:
    choices = settings.boundary_choice(blade), settings.reduction_choice(blade), settings.stress_regions(blade)
    return reduce_blade(mesh, matrices, settings.blades[blade].material, *choices)
