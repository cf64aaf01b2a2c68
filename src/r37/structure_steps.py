"""The steps from a blade's shape to its Campbell diagram, each from file to file, as the scripts of the workflow take them."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from r37core.blade.definition import BladeDefinition
from r37core.blade.geometry_file import read_geometry, write_geometry
from r37core.dataset_file import write_dataset
from r37core.exchange.importing.import_mesh import import_mesh
from r37core.exchange.importing.matrices_in import import_matrices
from r37core.exchange.importing.source import MatricesSource, MeshSource
from r37core.exchange.refusal import placed
from r37core.fem.material import Material
from r37core.fem.matrices import assemble
from r37core.fem.mesh_quality import mesh_quality
from r37core.mesh.generate import generate_mesh
from r37core.mesh.mesh_files import read_vtu, write_vtu
from r37core.results.campbell_dataset import campbell_dataset
from r37core.rom.contact_model import write_contact_model
from r37core.rom.reduce import reduce_blade
from r37core.rom.reduced_model import contact_model
from r37core.rom.reduction_choice import ReductionChoice
from r37core.rom.rom_file import read_reduced_model, write_reduced_model
from r37core.stress.operator import write_stress_operator
from r37core.stress.recovery import stress_operator


def geometry(file: Path, definition: BladeDefinition, edges: str) -> None:
    """Build a blade given by profiles. Raises BladeShapeError for an impossible shape."""
    write_geometry(definition.build(round_edges=edges == "round"), file, {})


def mesh(file: Path, geometry_file: Path, level: Mapping[str, Any]) -> None:
    """Mesh a built blade; `level`: the section `mesh` of an accuracy level. Raises ValueError for a mesh of poor quality."""
    with tempfile.TemporaryDirectory() as folder:
        made = generate_mesh(
            read_geometry(geometry_file), level["nodes"], level["layers"], level["tip_elements"], Path(folder, "mesh.msh")
        )
    quality = mesh_quality(made)
    quality.check(level["minimum_scaled_jacobian"])
    write_vtu(made, file, quality.per_element)


def imported_mesh(file: Path, source: MeshSource, root: Path, places: Mapping[str, str]) -> None:
    """Read the mesh of another program; `places`: of its keys, as `placed` takes them. Raises ImportRefused."""
    with placed(places):
        made, quality = import_mesh(source, str(root))
    write_vtu(made, file, quality)


def reduced_model(file: Path, mesh_file: Path, elastic: Material, choice: ReductionChoice) -> None:
    """Assemble and reduce a meshed blade."""
    made = read_vtu(mesh_file)
    write_reduced_model(reduce_blade(made, assemble(made, elastic), choice), file, {})


def imported_matrices(
    file: Path, source: MatricesSource, choice: ReductionChoice, root: Path, places: Mapping[str, str]
) -> None:
    """Read the matrices of another program; `places` as of `imported_mesh`. Raises ImportRefused."""
    with placed(places):
        model = import_matrices(source, choice, str(root))
    write_reduced_model(model, file, {})


def contact(file: Path, rom_file: Path, tip_line: str) -> None:
    """Prepare a reduced blade for simulations with contact on this line."""
    write_contact_model(contact_model(read_reduced_model(rom_file), tip_line), file)


def stress(file: Path, rom_file: Path, elastic: Material) -> None:
    """Prepare the stress of a reduced blade. Raises ValueError where its region has no elements."""
    write_stress_operator(stress_operator(read_reduced_model(rom_file), elastic), file)


def campbell(file: Path, rom_file: Path, maximum_speed: float, tip_line: str, numbers: Mapping[str, Any]) -> None:
    """Campbell diagram of a reduced blade up to `maximum_speed` (rad/s); `numbers`: others that `campbell_dataset` takes."""
    diagram = campbell_dataset(read_reduced_model(rom_file), maximum_speed=maximum_speed, tip_line=tip_line, **numbers)
    write_dataset(diagram, file)
