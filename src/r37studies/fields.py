"""Results for other programs: modes and the worst stress on the mesh, as .vtu with a .pvd list."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from r37core.base.io import atomic_write, write_text
from r37core.base.speeds import exact_text
from r37core.fem.material import Material
from r37core.fem.orientation import OURS, Orientation
from r37core.fem.stress import recovered_stress, second_order_stress
from r37core.mesh.blade_mesh import BladeMesh
from r37core.mesh.mesh_files import save_grid, vtk_grid
from r37core.results.campbell import name_modes
from r37core.rom.recovery_nodes import RecoveryNodes
from r37core.rom.reduced_model import ReducedModel
from r37core.rom.rotation import rotation_amplitudes
from r37core.stress.operator import StressOperator, von_mises
from r37core.time_integration.speed_file import read_speed

_NAMED_AMONG = 8
REGION_STRESS = "largest von Mises stress of the region (Pa)"
"""Field data of a .vtu file with the stress at a worst instant."""
_UPPER = ([0, 1, 2, 0, 1, 2], [0, 1, 2, 1, 2, 0])


@dataclass(frozen=True)
class Target:
    """Where results go: a `folder`, and unit and axes of what its files hold."""

    folder: Path
    orientation: Orientation = OURS


@dataclass(frozen=True)
class WorstInstant:
    """The instant `number` of the last revolution: that with the largest von Mises stress in the region, `largest` (Pa).

    `revolution`: the reduced coordinates at all its instants, shape (instants, coordinates).
    """

    largest: float
    revolution: np.ndarray
    number: int


def mode_shapes(model: ReducedModel, speed: float, count: int) -> tuple[tuple[str, ...], np.ndarray, np.ndarray]:
    """Names, frequencies (Hz) and mass-normalised displacement (kg^-1/2), shape (modes, nodes, 3), of the lowest modes.

    `speed` in rad/s. Raises ValueError for a model that does not recover the whole blade.
    """
    basis = _whole(model).basis
    frequencies, shapes = model.modes(speed, max(count, _NAMED_AMONG))
    names, order = name_modes(model, shapes, count)
    displacement = np.array([basis @ shapes[:, mode] for mode in order])
    return names, frequencies[order] / (2.0 * np.pi), displacement


def write_modes(
    mesh: BladeMesh, model: ReducedModel, speeds: Sequence[float], count: int, target: Target, material: Material | None = None
) -> None:
    """Write modes_<speed> for each speed (rad/s) and modes.pvd: displacement of `count` modes, mass-normalised (kg^-1/2).

    With a `material` the von Mises stress of each (Pa kg^-1/2), too. Fields are named by the mode; .vtu files have the
    frequency (Hz) of each in the field data. The model must recover the whole blade.
    """

    def content(speed: float) -> tuple[dict[str, np.ndarray], dict[str, float]]:
        names, frequencies, displacement = mode_shapes(model, speed, count)
        fields = {f"mode {name}": u @ target.orientation.rows for name, u in zip(names, displacement, strict=True)}
        if material is not None:
            stress = recovered_stress(mesh.blocks, mesh.points, np.moveaxis(displacement, 0, 2), material, False)
            fields |= dict(zip(map(modal_stress, names), von_mises(stress).T, strict=True))
        return fields, dict(zip(map(modal_frequency, names), frequencies, strict=True))

    _write(mesh, "modes", speeds, content, target)


def modal_frequency(mode: str) -> str:
    """Name of the field data with a mode's frequency."""
    return f"frequency of mode {mode} (Hz)"


def modal_stress(mode: str) -> str:
    """Name of the field of a mode's von Mises stress."""
    return f"von Mises stress of mode {mode}"


def worst_instants(
    files: Iterable[Path | str], speeds: Sequence[float], stress: StressOperator, only_worst: bool
) -> dict[float, WorstInstant]:
    """The worst instant of the last revolution at each of the `speeds` (rad/s), or the worst of all alone.

    A run that diverged has none. Raises InputFileError for a file that cannot be read.
    """
    instants: dict[float, WorstInstant] = {}
    for speed, file in zip(speeds, files, strict=True):
        run = read_speed(file)
        if run["status"] or not len(run["snapshots"]):
            continue
        revolution = run["snapshots"]
        largest = stress.displaced(speed).max_von_mises(revolution)
        instant = int(np.argmax(largest))
        instants[speed] = WorstInstant(float(largest[instant]), revolution, instant)
    worst = max(instants, key=lambda speed: instants[speed].largest, default=None)
    return {worst: instants[worst]} if only_worst and worst is not None else instants


def write_stress(
    mesh: BladeMesh, model: ReducedModel, material: Material, instants: Mapping[float, WorstInstant], target: Target
) -> None:
    """Write stress_<speed> for the instant at each speed (rad/s), and stress.pvd.

    Displacement (the target's unit), stress components xx yy zz xy yz zx and von Mises stress (Pa) on the whole blade: of
    the vibration, and of rotation in a scene whose stress has it. The model must recover the whole blade.
    """

    def content(speed: float) -> tuple[dict[str, np.ndarray], dict[str, float]]:
        displacement, stress = stress_of(mesh, model, material, instants[speed], speed)
        tensors, rows = np.empty((stress.shape[1], 3, 3)), target.orientation.rows
        for component, a, b in zip(stress, *_UPPER, strict=True):
            tensors[:, a, b] = tensors[:, b, a] = component
        fields = {
            "displacement": target.orientation.vectors_to_file(displacement),
            # in the target's axes, whose parts in the blade's frame are the columns of the rows
            "stress": (rows.T @ tensors @ rows)[:, *_UPPER],
            "von Mises stress": von_mises(stress),
        }
        return fields, {REGION_STRESS: instants[speed].largest}

    _write(mesh, "stress", instants, content, target)


def stress_of(
    mesh: BladeMesh, model: ReducedModel, material: Material, instant: WorstInstant, speed: float
) -> tuple[np.ndarray, np.ndarray]:
    """Displacement (m), shape (nodes, 3), and stress (Pa), shape (6, nodes), on the whole blade at a `speed` (rad/s).

    Of large displacements by the strain of the whole displacement, less that of rotation where the coordinates are those of the
    vibration alone.
    """
    coordinates = instant.revolution[[instant.number]]
    displacement = displacement_of(model, coordinates)[0]

    def stress(field: np.ndarray) -> np.ndarray:
        fields = field[:, :, None]
        first = recovered_stress(mesh.blocks, mesh.points, fields, material, False)[:, :, 0]
        if model.logarithmic_stiffness is None:
            return first
        return first + 0.5 * second_order_stress(mesh.blocks, mesh.points, fields, fields, material, False)[:, :, 0]

    if model.logarithmic_stiffness is None or coordinates.shape[1] > model.size:
        return displacement, stress(displacement)
    rotated = _whole(model).rotation_shapes @ rotation_amplitudes(model.rotation_stiffening, speed)
    return displacement, stress(rotated + displacement) - stress(rotated)


def displacement_of(model: ReducedModel, coordinates: np.ndarray) -> np.ndarray:
    """Displacement of all nodes (m), shape (instants, nodes, 3), for coordinates as StressOperator takes them."""
    return np.moveaxis(_whole(model).fields[:, :, : coordinates.shape[1]] @ coordinates.T, 2, 0)


def _whole(model: ReducedModel) -> RecoveryNodes:
    if model.whole_blade is None:
        raise ValueError("the reduced model does not recover the whole blade")
    return model.whole_blade


def _write(
    mesh: BladeMesh,
    name: str,
    speeds: Iterable[float],
    content: Callable[[float], tuple[dict[str, np.ndarray], dict[str, float]]],
    target: Target,
) -> None:
    """Write the fields and field data that `content` gives at each speed (rad/s), and a ParaView list of the files."""
    shown, rows = target.orientation.mesh_to_file(mesh), ""
    for speed in speeds:
        grid, file = vtk_grid(shown), f"{name}_{exact_text(speed)}.vtu"
        fields, notes = content(speed)
        grid.point_data.update(fields)
        for about, value in notes.items():
            grid.field_data[about] = [value]
        with atomic_write(target.folder / file) as partial:
            save_grid(grid, partial)
        rows += f'    <DataSet timestep="{speed!r}" file="{file}"/>\n'
    text = f'<VTKFile type="Collection" version="0.1">\n  <Collection>\n{rows}  </Collection>\n</VTKFile>\n'
    write_text(text, target.folder / f"{name}.pvd")
