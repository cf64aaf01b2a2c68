"""Worst instants of interactions as .vtu files, with the titles and magnifications of their pictures."""

from collections.abc import Mapping
from pathlib import Path
from typing import Final

import numpy as np

from r37core.base.io import write_json
from r37core.base.speeds import exact_text
from r37core.base.units import RPM
from r37core.fem.material import Material
from r37core.fem.surface import outer_faces
from r37core.mesh.blade_mesh import BladeMesh
from r37core.rom.reduced_model import ReducedModel
from r37studies.fields import Target, WorstInstant, displacement_of, write_stress

INDEX: Final = "shapes.json"
"""File of a folder that lists its worst instants: name of the .vtu file, title and magnification of the picture."""

LARGEST_SHOWN: Final = 0.1
"""Largest displacement in a picture, as a share of the blade's height."""


def write_worst_shapes(
    mesh: BladeMesh,
    model: ReducedModel,
    material: Material,
    instants: Mapping[float, WorstInstant],
    titles: Mapping[float, str],
    folder: Path,
) -> None:
    """Write the worst instant at each speed (rad/s): stress_<speed>.vtu with stress.pvd, and their INDEX.

    `titles` of the interactions at the speeds. The model must recover the whole blade.
    """
    write_stress(mesh, model, material, instants, Target(folder))
    nodes = np.unique(np.concatenate([part.nodes[:, : part.corners].ravel() for part in outer_faces(mesh.blocks)]))
    entries = []
    for speed, instant in instants.items():
        displacement = np.linalg.norm(displacement_of(model, instant.revolution)[:, nodes], axis=2)
        magnification = LARGEST_SHOWN * blade_height(mesh.points) / displacement.max()
        # with one digit, not larger
        power = 10.0 ** np.floor(np.log10(magnification))
        magnification = float(f"{np.floor(magnification / power) * power:.0e}")
        title = [
            titles[speed],
            f"at {speed:g} rad/s ({RPM * speed:.0f} rpm):",
            f"largest von Mises stress of the region {1e-6 * instant.largest:.0f} MPa",
            *(["above yield, not linear"] if instant.largest > material.yield_stress else []),
            f"shown {magnification:g} times as large",
        ]
        entries.append({"file": f"stress_{exact_text(speed)}.vtu", "title": title, "magnification": magnification})
    write_json(entries, folder / INDEX)


def blade_height(points: np.ndarray) -> float:
    """Height of a blade (m), from the lowest to the highest radius of its `points`, shape (points, 3)."""
    return float(np.ptp(np.hypot(points[:, 0], points[:, 1])))
