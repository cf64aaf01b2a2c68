"""Models of a blade that differ from its level's in one thing, and what making them costs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from r37core.blade.blade_surface import Blade
from r37core.fem.material import Material
from r37core.fem.matrices import assemble
from r37core.mesh.generate import generate_mesh
from r37core.rom.reduce import reduce_blade
from r37core.rom.reduced_model import ReducedModel
from r37core.rom.reduction_choice import EVERYWHERE, BoundaryChoice, ReductionChoice

from .case import ModelChoice
from .costs import Stopwatch, peak_memory


def tip_elements(nodes: int) -> int:
    """Elements along the tip that suit a mesh, as in fidelity.yaml: a multiple of 7, for 8 evenly spaced boundary nodes."""
    return 7 * max(1, round(0.04 * np.sqrt(nodes)))


def build_model(
    blade: Blade, material: Material, choice: ModelChoice, base: ReductionChoice
) -> tuple[ReducedModel, Mapping[str, float]]:
    """Mesh, assemble and reduce; `base` gives what `choice` leaves open. Also the cost: CPU and wall s, memory (bytes)."""
    clock = Stopwatch()
    reduction = replace(
        base,
        boundary=BoundaryChoice(choice.tip_line, choice.boundary_nodes, choice.corners, contact=base.boundary.contact),
        fixed_interface_modes=choice.fixed_interface_modes,
        stress_submesh=EVERYWHERE if choice.whole_blade_stress else base.stress_submesh,
    )
    with clock:
        mesh = generate_mesh(blade, choice.nodes, layers=1, tip_elements=tip_elements(choice.nodes))
        model = reduce_blade(mesh, assemble(mesh, material), reduction)
    return model, {"cpu_s": clock.cpu, "wall_s": clock.wall, "peak_memory_bytes": peak_memory()}
