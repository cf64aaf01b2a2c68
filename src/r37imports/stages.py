"""Stages of the structure of blades of other programs, in place of those of blades by profiles."""

from r37core.plans.stages import Stage, reduction_parameters
from r37core.plans.structure_plan import Structure


def import_stages(structure: Structure) -> dict[str, Stage]:
    """Import of a mesh, or of matrices as a reduced model, by the names of their rules."""
    source = {"source": structure.definition, "folder": structure.folder, "locations": structure.locations}
    matrices = {**source, **reduction_parameters(structure)}
    return {
        "imported_mesh": Stage("r37imports.importing.steps.imported_mesh", source, "import of the mesh"),
        "imported_matrices": Stage("r37imports.importing.steps.imported_matrices", matrices, "import of the matrices"),
    }
