"""Write the Abaqus/CalculiX deck of one blade. Input: mesh.vtu. Params: material. Output: mesh.inp."""

from job import run

from r37core.mesh.mesh_files import read_vtu, write_abaqus


def main(snakemake):
    material = snakemake.params.material
    write_abaqus(
        read_vtu(snakemake.input[0]),
        snakemake.output[0],
        material["youngs_modulus"],
        material["density"],
        material["poissons_ratio"],
        title=f"blade {snakemake.wildcards.blade}, SI units",
    )


run(snakemake, main)
