"""Steps of the workflow (docs/architecture.md): blades of other programs."""

from typing import Any

from r37core.base.io import JOB_LOG
from r37core.base.plain import from_plain
from r37core.fem.write_mesh import write_mesh
from r37core.mesh.mesh_files import write_vtu
from r37core.rom.reduction_choice import BoundaryChoice, ReductionChoice, boundary_located
from r37core.rom.rom_file import write_reduced_model
from r37imports.refusal import located

from .import_mesh import import_mesh, size_in_words
from .matrices_in import import_matrices, wording
from .source import MatricesSource, MeshSource


def imported_mesh(input: Any, output: Any, params: Any) -> str:
    """Import the mesh of another program; returns its size, which shows a wrong unit. Outputs: msh, vtu.

    Params: source, folder, locations (of the keys, as `located` takes them). Raises ImportRefused.
    """
    with located(params.locations):
        source = from_plain(MeshSource, params.source)
        mesh, quality = import_mesh(source, params.folder["folder"])
    JOB_LOG.debug(f"{len(mesh.points)} nodes, " + ", ".join(f"{len(nodes)} {name}" for name, nodes in mesh.blocks.items()))
    JOB_LOG.debug(f"root: {len(mesh.node_set('root'))} nodes, tip: {len(mesh.node_set('tip'))} nodes")
    JOB_LOG.debug(f"scaled Jacobian: minimum {quality.min():.3f}")
    write_mesh(mesh, output.msh)
    write_vtu(mesh, output.vtu, quality)
    return f"{params.locations['mesh']}: {size_in_words(mesh, source)}"


def imported_matrices(input: Any, output: Any, params: Any) -> str:
    """Reduced model from matrices of another program; returns a frequency, which shows a wrong unit. Output: rom (nc).

    Params: source, folder, locations, boundary, reduction, contact, provenance. Raises ImportRefused.
    """
    boundary, reduction = from_plain(BoundaryChoice, params.boundary), from_plain(ReductionChoice, params.reduction)
    with boundary_located(params.contact["location"]), located(params.locations):
        model = import_matrices(from_plain(MatricesSource, params.source), boundary, reduction, params.folder["folder"])
    JOB_LOG.debug(f"{len(model.singular_values)} columns, {model.size} independent at {model.tolerance:g}")
    write_reduced_model(model, output.rom, params.provenance)
    return f"{params.locations['matrices']}: {wording(model)}"
