"""Write a mesh for another program. Input: mesh.vtu. Params: material, orientation. Output: .msh, .vtu, .med, .bdf or .inp."""

from job import run

from r37core.exchange.exporting.fields import OURS
from r37core.exchange.exporting.write_mesh import write_mesh
from r37core.fem.abaqus_deck import write_abaqus
from r37core.fem.material import Material
from r37core.mesh.mesh_files import read_vtu


def main(snakemake):
    wanted, params = snakemake.wildcards, snakemake.params
    mesh = read_vtu(snakemake.input[0])
    if wanted.format == "inp":
        write_abaqus(mesh, snakemake.output[0], Material(**params.material), f"blade {wanted.blade}, SI units")
    else:
        write_mesh((params.orientation or OURS).mesh_to_file(mesh), snakemake.output[0])


run(snakemake, main)
