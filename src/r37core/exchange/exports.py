"""Results for other programs: modes and the worst stress on the mesh, as .vtu with a .pvd list or as .med."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import meshio
import numpy as np

from r37core.fem.material import Material
from r37core.fem.stress import nodal_stress, von_mises
from r37core.io import atomic_write, write_text
from r37core.mesh.blade_mesh import BladeMesh
from r37core.mesh.mesh_files import vtk_grid
from r37core.results.campbell import name_modes
from r37core.results.stress import StressRecovery
from r37core.rom.reduced_model import ReducedModel
from r37core.speeds import exact_text
from r37core.time_integration.speed_file import read_speed

from .meshio_reader import quietly
from .orientation import Orientation

OURS = Orientation("m", (0.0, 0.0, 1.0), (1.0, 0.0, 0.0), "negative")
"""The blade's frame."""

_NAMED_AMONG = 8
_UPPER = ([0, 1, 2, 0, 1, 2], [0, 1, 2, 1, 2, 0])


@dataclass(frozen=True)
class Target:
    """Where results go: a `folder`, the `formats` of the files (vtu, med), and unit and axes of what they hold."""

    folder: Path
    formats: tuple[str, ...] = ("vtu",)
    orientation: Orientation = OURS


@dataclass(frozen=True)
class WorstInstant:
    """Reduced coordinates, shape (coordinates,), at the instant of the largest stress on the submesh (Pa)."""

    coordinates: np.ndarray
    largest: float


def write_modes(mesh: BladeMesh, model: ReducedModel, speeds: Sequence[float], count: int, target: Target) -> None:
    """Write modes_<speed> for each speed (rad/s) and modes.pvd: displacement of `count` modes, mass-normalised (kg^-1/2).

    Fields are named by the mode; .vtu files have the frequency (Hz) of each in the field data. The model must recover the
    whole blade.
    """
    basis, shown = _whole(model), target.orientation.mesh_to_file(mesh)
    files = {}
    for speed in speeds:
        frequencies, shapes = model.modes(speed, max(count, _NAMED_AMONG))
        names, order = name_modes(model, shapes, count)
        pairs = list(zip(names, order, strict=True))
        fields = {f"mode {name}": (basis @ shapes[:, mode]).real @ target.orientation.rows for name, mode in pairs}
        notes = {f"frequency of mode {name} (Hz)": frequencies[mode] / (2.0 * np.pi) for name, mode in pairs}
        files[speed] = f"modes_{exact_text(speed)}"
        _write_fields(shown, fields, notes, files[speed], target)
    _write_collection(files, "modes", target)


def worst_instants(
    files: Iterable[Path | str], speeds: Sequence[float], recovery: StressRecovery, only_worst: bool
) -> dict[float, WorstInstant]:
    """The worst instant kept in the file of each of the `speeds` (rad/s), or the worst of all alone.

    A run that diverged has none. Raises InputFileError for a file that cannot be read.
    """
    found: dict[float, WorstInstant] = {}
    for speed, file in zip(speeds, files, strict=True):
        run = read_speed(file)
        if run["status"] or not len(run["snapshots"]):
            continue
        largest = recovery.max_von_mises(run["snapshots"])
        instant = int(np.argmax(largest))
        found[speed] = WorstInstant(run["snapshots"][instant], float(largest[instant]))
    worst = max(found, key=lambda speed: found[speed].largest, default=None)
    return {worst: found[worst]} if only_worst and worst is not None else found


def write_stress(
    mesh: BladeMesh, model: ReducedModel, material: Material, instants: Mapping[float, WorstInstant], target: Target
) -> None:
    """Write stress_<speed> for the instant at each speed (rad/s), and stress.pvd.

    Displacement (the target's unit), stress components xx yy zz xy yz zx and von Mises stress (Pa) of the vibration on the
    whole blade. The model must recover the whole blade.
    """
    basis, shown = _whole(model), target.orientation.mesh_to_file(mesh)
    files = {}
    for speed, instant in instants.items():
        displacement = basis @ instant.coordinates
        stress = nodal_stress(mesh.blocks, mesh.points, displacement[:, :, None], material)[:, :, 0]
        fields = {
            "displacement": target.orientation.vectors_to_file(displacement),
            "stress": _turned(stress, target.orientation.rows).T,
            "von Mises stress": von_mises(stress),
        }
        files[speed] = f"stress_{exact_text(speed)}"
        _write_fields(shown, fields, {"largest von Mises stress of the submesh (Pa)": instant.largest}, files[speed], target)
    _write_collection(files, "stress", target)


def _turned(stress: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Stress components, shape (6, nodes), in the axes whose parts in the blade's frame are the columns of `rows`."""
    tensors = np.empty((stress.shape[1], 3, 3))
    for component, a, b in zip(stress, *_UPPER, strict=True):
        tensors[:, a, b] = tensors[:, b, a] = component
    return (rows.T @ tensors @ rows)[:, *_UPPER].T


def _whole(model: ReducedModel) -> np.ndarray:
    if model.whole_blade is None:
        raise ValueError("the reduced model does not recover the whole blade")
    return model.whole_blade.basis


def _write_fields(
    mesh: BladeMesh, fields: Mapping[str, np.ndarray], notes: Mapping[str, float], name: str, target: Target
) -> None:
    for suffix in target.formats:
        with atomic_write(target.folder / f"{name}.{suffix}") as partial:
            if suffix == "vtu":
                grid = vtk_grid(mesh)
                grid.point_data.update(dict(fields))
                for about, value in notes.items():
                    grid.field_data[about] = [value]
                grid.save(partial)
            else:
                content = meshio.Mesh(mesh.points, dict(mesh.blocks), point_data=dict(fields))
                quietly(content.write, partial)


def _write_collection(files: Mapping[float, str], name: str, target: Target) -> None:
    """A ParaView list of the .vtu files over speed."""
    if "vtu" not in target.formats:
        return
    rows = "".join(f'    <DataSet timestep="{speed!r}" file="{file}.vtu"/>\n' for speed, file in files.items())
    text = f'<VTKFile type="Collection" version="0.1">\n  <Collection>\n{rows}  </Collection>\n</VTKFile>\n'
    write_text(text, target.folder / f"{name}.pvd")
