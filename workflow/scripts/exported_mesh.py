"""Write a mesh for another program. Input: mesh.vtu. Params: material, orientation. Output: .msh, .vtu, .med, .bdf or .inp."""

from job import run

from r37core.exchange.orientation import Orientation
from r37core.exchange.write_mesh import write_mesh
from r37core.fem.abaqus_deck import write_abaqus
from r37core.fem.material import Material
from r37core.mesh.mesh_files import read_vtu
from r37core.plain import from_plain


def main(snakemake):
    wanted, params = snakemake.wildcards, snakemake.params
    mesh = read_vtu(snakemake.input[0])
    if wanted.format == "inp":
        write_abaqus(mesh, snakemake.output[0], from_plain(Material, params.material), f"blade {wanted.blade}, SI units")
    else:
        write_mesh(from_plain(Orientation, params.orientation).mesh_to_file(mesh), snakemake.output[0])


run(snakemake, main)
