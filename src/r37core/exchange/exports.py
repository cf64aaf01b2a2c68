"""Results for other programs: modes and the worst stress as .vtu with a .pvd list, matrices as Matrix Market."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
import scipy.io

from r37core.fem.material import Material
from r37core.fem.matrices import StructuralMatrices
from r37core.fem.stress import nodal_stress, von_mises
from r37core.io import atomic_write, write_text
from r37core.mesh.blade_mesh import BladeMesh
from r37core.mesh.mesh_files import vtk_grid
from r37core.results.campbell import name_modes
from r37core.rom.reduced_model import ReducedModel

from .matrices_in import COLUMNS


def write_modes(mesh: BladeMesh, model: ReducedModel, speeds: Sequence[float], count: int, folder: Path) -> None:
    """Write modes_<speed>.vtu for each speed (rad/s) and modes.pvd: displacement of `count` modes, mass-normalised (kg^-1/2).

    Fields are named by the mode, with the frequency (Hz) of each in the field data. The model must recover the whole blade.
    """
    basis = _whole(model)
    files = {}
    for speed in speeds:
        frequencies, shapes = model.modes(speed, max(count, 8))
        names, order = name_modes(model, shapes, count)
        grid = vtk_grid(mesh)
        for name, mode in zip(names, order, strict=True):
            grid.point_data[f"mode {name}"] = (basis @ shapes[:, mode]).real
            grid.field_data[f"frequency of mode {name} (Hz)"] = [frequencies[mode] / (2.0 * np.pi)]
        files[speed] = f"modes_{speed:g}.vtu"
        with atomic_write(folder / files[speed]) as partial:
            grid.save(partial)
    _write_collection(files, folder / "modes.pvd")


@dataclass(frozen=True)
class WorstInstant:
    """Reduced coordinates, shape (coordinates,), at the instant of the largest stress on the submesh (Pa)."""

    coordinates: np.ndarray
    largest: float


def worst_instant(snapshots: np.ndarray, largest_of_each: np.ndarray) -> WorstInstant:
    """Of snapshots, shape (instants, coordinates), the one whose largest stress (Pa), shape (instants,), is largest."""
    instant = int(np.argmax(largest_of_each))
    return WorstInstant(snapshots[instant], float(largest_of_each[instant]))


def write_stress(
    mesh: BladeMesh, model: ReducedModel, material: Material, instants: Mapping[float, WorstInstant], folder: Path, scene: str
) -> None:
    """Write stress_<scene>_<speed>.vtu for the instant at each speed (rad/s), and stress_<scene>.pvd.

    Displacement (m), stress components xx yy zz xy yz zx and von Mises stress (Pa) of the vibration on the whole blade. The
    model must recover the whole blade.
    """
    basis = _whole(model)
    files = {}
    for speed, instant in instants.items():
        displacement = basis @ instant.coordinates
        stress = nodal_stress(mesh.blocks, mesh.points, displacement[:, :, None], material)[:, :, 0]
        grid = vtk_grid(mesh)
        grid.point_data["displacement"] = displacement
        grid.point_data["stress"] = stress.T
        grid.point_data["von Mises stress"] = von_mises(stress)
        grid.field_data["largest von Mises stress of the submesh (Pa)"] = [instant.largest]
        files[speed] = f"stress_{scene}_{speed:g}.vtu"
        with atomic_write(folder / files[speed]) as partial:
            grid.save(partial)
    _write_collection(files, folder / f"stress_{scene}.pvd")


def write_matrices_directory(
    matrices: StructuralMatrices, mesh: BladeMesh, boundary_nodes: np.ndarray, speeds: Sequence[float], folder: Path
) -> None:
    """Write the full matrices as import_matrices reads them: M.mtx, K_<speed>.mtx at `speeds` (rad/s), boundary.csv.

    Rows are x y z of the unclamped nodes, in m and the blade's frame; with geometric stiffness, without spin softening.
    """
    folder.mkdir(parents=True, exist_ok=True)
    stiffness, geometric = matrices.stiffness(), matrices.geometric_stiffness()
    content = {"M": matrices.mass()} | {f"K_{speed:g}": stiffness + speed**2 * geometric for speed in speeds}
    for name, matrix in content.items():
        with atomic_write(folder / f"{name}.mtx") as partial:
            scipy.io.mmwrite(partial, 0.5 * (matrix + matrix.T), precision=17, symmetry="symmetric")
    rows = 3 * np.searchsorted(matrices.free_nodes, boundary_nodes)[:, None] + np.arange(3)
    table = pd.DataFrame(np.hstack([mesh.points[boundary_nodes], rows]), columns=list(COLUMNS))
    table = table.astype(dict.fromkeys(COLUMNS[3:], int))
    with atomic_write(folder / "boundary.csv") as partial:
        table.to_csv(partial, index=False)


def _whole(model: ReducedModel) -> np.ndarray:
    if model.whole_blade is None:
        raise ValueError("the reduced model does not recover the whole blade")
    return model.whole_blade.basis


def _write_collection(files: Mapping[float, str], file: Path) -> None:
    """A ParaView list of files over speed."""
    rows = "".join(f'    <DataSet timestep="{speed:g}" file="{name}"/>\n' for speed, name in files.items())
    write_text(f'<VTKFile type="Collection" version="0.1">\n  <Collection>\n{rows}  </Collection>\n</VTKFile>\n', file)
