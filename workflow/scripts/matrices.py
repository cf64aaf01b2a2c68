"""Assemble the matrices of one blade. Input: mesh.vtu. Params: material. Output: matrices.npz."""

from job import run

from r37core.fem.material import Material
from r37core.fem.matrices import assemble, write_matrices
from r37core.mesh.mesh_files import read_vtu
from r37core.plain import from_plain


def main(snakemake):
    matrices = assemble(read_vtu(snakemake.input[0]), from_plain(Material, snakemake.params.material))
    print(f"mass {matrices.total_mass:.6g} kg, {3 * len(matrices.free_nodes)} free degrees of freedom")
    write_matrices(matrices, snakemake.output[0])


run(snakemake, main)
