"""Reduce one blade. Inputs: mesh (vtu), matrices. Params: reduction, provenance. Output: rom.nc."""

from job import run

from r37core.fem.matrices import read_matrices
from r37core.mesh.mesh_files import read_vtu
from r37core.plain import from_plain
from r37core.rom.reduce import reduce_blade
from r37core.rom.reduction_choice import ReductionChoice
from r37core.rom.rom_file import write_reduced_model


def main(snakemake):
    choice = from_plain(ReductionChoice, snakemake.params.reduction)
    model = reduce_blade(read_vtu(snakemake.input.mesh), read_matrices(snakemake.input.matrices), choice)
    print(f"{model.columns} columns, {model.size} independent at {model.tolerance:g}")
    write_reduced_model(model, snakemake.output[0], snakemake.params.provenance)


run(snakemake, main)
