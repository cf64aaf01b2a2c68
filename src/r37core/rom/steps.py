"""Steps of the workflow (docs/architecture.md): reduced model, and what a simulation starts from."""

from pathlib import Path
from typing import Any

from r37core.base.io import JOB_LOG
from r37core.base.plain import from_plain
from r37core.fem.material import Material
from r37core.fem.matrices import assemble
from r37core.machine_code.kept import content_digest, kept_for_user, numerics
from r37core.mesh.mesh_files import read_vtu

from .contact_model import write_contact_model
from .reduce import reduce_blade
from .reduced_model import ReducedModel
from .reduced_model import contact_model as contact_model_of
from .reduction_choice import BoundaryChoice, ReductionChoice, boundary_located
from .region_choice import RegionChoice
from .rom_file import read_reduced_model, write_reduced_model


def reduced_model(input: Any, output: Any, params: Any) -> None:
    """Assemble and reduce a blade. Input: mesh (vtu). Output: rom (nc).

    Params: material, boundary, reduction, stress_regions, contact, kept (whether the user's cache has a copy, for all that is
    made of the same), provenance, code.
    """

    def make(file: Path) -> None:
        write_reduced_model(_reduced(input.mesh, params), file)

    kept = None
    if params.kept:
        choices = params.material, params.boundary, params.reduction, params.stress_regions
        kept = kept_for_user("rom.nc", (content_digest(input.mesh), *choices, params.code, numerics("numpy", "scipy")), make)
        JOB_LOG.debug(f"kept as {kept}")
    model = read_reduced_model(kept) if kept else _reduced(input.mesh, params)
    write_reduced_model(model, output.rom, params.provenance)


def _reduced(mesh_file: str, params: Any) -> ReducedModel:
    mesh = read_vtu(mesh_file)
    material = from_plain(Material, params.material)
    matrices = assemble(mesh, material)
    JOB_LOG.debug(f"mass {matrices.total_mass:.6g} kg, {3 * len(matrices.free_nodes)} free degrees of freedom")
    boundary, reduction = from_plain(BoundaryChoice, params.boundary), from_plain(ReductionChoice, params.reduction)
    regions = from_plain(dict[str, RegionChoice], params.stress_regions)
    with boundary_located(params.contact["location"]):
        model = reduce_blade(mesh, matrices, material, boundary, reduction, regions)
    JOB_LOG.debug(f"{len(model.singular_values)} columns, {model.size} independent at {model.tolerance:g}")
    return model


def contact_model(input: Any, output: Any, params: Any) -> None:
    """Prepare a blade for simulations. Input: rom. Params: tip_line. Output: contact (npz)."""
    write_contact_model(contact_model_of(read_reduced_model(input.rom), params.tip_line), output.contact)
