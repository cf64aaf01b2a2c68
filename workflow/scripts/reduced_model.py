"""Assemble and reduce one blade. Input: mesh.vtu. Params: material, reduction, made_before, ... Output: rom.nc."""

from job import run

from r37core.dataset_file import recipe_of, taken_over
from r37core.fem.material import Material
from r37core.fem.matrices import assemble
from r37core.mesh.mesh_files import read_vtu
from r37core.plain import from_plain
from r37core.rom.reduce import reduce_blade
from r37core.rom.reduction_choice import ReductionChoice, boundary_placed
from r37core.rom.rom_file import write_reduced_model


def main(snakemake):
    params = snakemake.params
    recipe = recipe_of(snakemake.input, params.material, params.reduction, params.code, dict(params.provenance))
    before = params.made_before["file"]
    if taken_over(recipe, before, snakemake.output[0]):
        print(f"copy of {before}, which was made of the same")
        return
    mesh = read_vtu(snakemake.input[0])
    matrices = assemble(mesh, from_plain(Material, params.material))
    print(f"mass {matrices.total_mass:.6g} kg, {3 * len(matrices.free_nodes)} free degrees of freedom")
    with boundary_placed(params.contact["place"]):
        model = reduce_blade(mesh, matrices, from_plain(ReductionChoice, params.reduction))
    print(f"{model.columns} columns, {model.size} independent at {model.tolerance:g}")
    write_reduced_model(model, snakemake.output[0], params.provenance | {"recipe": recipe})


run(snakemake, main)
