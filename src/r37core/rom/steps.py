"""Steps of the workflow (docs/architecture.md): reduced model, and what a simulation starts from."""

from __future__ import annotations

from typing import Any

from r37core.dataset_file import recipe_of, taken_over
from r37core.fem.material import Material
from r37core.fem.matrices import assemble
from r37core.io import JOB_LOG
from r37core.mesh.mesh_files import read_vtu
from r37core.plain import from_plain

from .contact_model import write_contact_model
from .reduce import reduce_blade
from .reduced_model import contact_model as contact_model_of
from .reduction_choice import ReductionChoice, boundary_located
from .rom_file import read_reduced_model, write_reduced_model


def reduced_model(input: Any, output: Any, params: Any) -> None:
    """Assemble and reduce a blade. Input: mesh (vtu). Output: rom (nc).

    Params: material, reduction, contact, made_before (a model that is copied if it was made of the same), provenance, code.
    """
    recipe = recipe_of([input.mesh], params.material, params.reduction, params.code, dict(params.provenance))
    before = params.made_before["file"]
    if taken_over(recipe, before, output.rom):
        JOB_LOG.debug(f"copy of {before}, which was made of the same")
        return
    mesh = read_vtu(input.mesh)
    matrices = assemble(mesh, from_plain(Material, params.material))
    JOB_LOG.debug(f"mass {matrices.total_mass:.6g} kg, {3 * len(matrices.free_nodes)} free degrees of freedom")
    with boundary_located(params.contact["location"]):
        model = reduce_blade(mesh, matrices, from_plain(ReductionChoice, params.reduction))
    JOB_LOG.debug(f"{model.columns} columns, {model.size} independent at {model.tolerance:g}")
    write_reduced_model(model, output.rom, params.provenance | {"recipe": recipe})


def contact_model(input: Any, output: Any, params: Any) -> None:
    """Prepare a blade for simulations. Input: rom. Params: tip_line. Output: contact (npz)."""
    write_contact_model(contact_model_of(read_reduced_model(input.rom), params.tip_line), output.contact)
