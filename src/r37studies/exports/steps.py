"""Steps of the workflow (docs/architecture.md): results for other programs."""

from pathlib import Path
from typing import Any

from r37core.base.io import JOB_LOG, as_list
from r37core.base.plain import from_plain
from r37core.blade.geometry_file import read_geometry
from r37core.fem.abaqus_deck import write_abaqus
from r37core.fem.material import Material
from r37core.fem.orientation import Orientation
from r37core.fem.write_mesh import write_mesh
from r37core.mesh.mesh_files import read_vtu
from r37core.rom.rom_file import read_reduced_model
from r37core.stress.recovery import stress_operator
from r37studies.fields import Target, worst_instants, write_modes, write_stress
from r37studies.step_file import write_step

from .matrices_out import write_reduced_matrices


def mesh(input: Any, output: Any, params: Any) -> None:
    """Write a mesh for another program. Input: mesh (vtu). Params: blade, material, orientation.

    Output: mesh, of a format that its suffix names: .msh, .vtu or .inp.
    """
    blade_mesh = read_vtu(input.mesh)
    if Path(output.mesh).suffix == ".inp":
        write_abaqus(blade_mesh, output.mesh, from_plain(Material, params.material), f"blade {params.blade}, SI units")
    else:
        write_mesh(from_plain(Orientation, params.orientation).mesh_to_file(blade_mesh), output.mesh)


def surface(input: Any, output: Any, params: Any) -> None:
    """Write a blade's surface. Input: geometry. Output: surface (STEP)."""
    write_step(read_geometry(input.geometry), output.surface)


def modes(input: Any, output: Any, params: Any) -> None:
    """Write modes on the mesh. Inputs: mesh (vtu), model. Params: choice, orientation. Output: folder."""
    choice, target = params.choice, _target(output, params)
    write_modes(read_vtu(input.mesh), read_reduced_model(input.model), choice["mode_speeds"], choice["modes"], target)


def stress(input: Any, output: Any, params: Any) -> None:
    """Write the worst stress. Inputs: mesh, model, speeds. Output: folder.

    Params: speeds, only_worst, material, orientation.
    """
    model, material = read_reduced_model(input.model), from_plain(Material, params.material)
    operator = stress_operator(model, material)
    instants = worst_instants(as_list(input.speeds), params.speeds, operator, params.only_worst)
    for speed, instant in instants.items():
        JOB_LOG.debug(f"{speed:g} rad/s: largest von Mises stress of the region {instant.largest:.6g} Pa")
    write_stress(read_vtu(input.mesh), model, material, instants, _target(output, params))


def matrices(input: Any, output: Any, params: Any) -> None:
    """Write reduced matrices. Input: rom. Params: choice. Output: folder (of .mtx)."""
    write_reduced_matrices(read_reduced_model(input.rom), params.choice["matrix_speeds"], Path(output.folder))


def _target(output: Any, params: Any) -> Target:
    return Target(Path(output.folder), from_plain(Orientation, params.orientation))
