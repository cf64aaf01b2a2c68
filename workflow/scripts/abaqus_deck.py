"""Write the Abaqus/CalculiX deck of one blade. Input: mesh.vtu. Params: material. Output: mesh.inp."""

from job import run

from r37core.fem.abaqus_deck import write_abaqus
from r37core.fem.material import Material
from r37core.mesh.mesh_files import read_vtu
from r37core.plain import from_plain


def main(snakemake):
    material = from_plain(Material, snakemake.params.material)
    title = f"blade {snakemake.wildcards.blade}, SI units"
    write_abaqus(read_vtu(snakemake.input[0]), snakemake.output[0], material, title)


run(snakemake, main)
