"""Write matrices as Matrix Market. Inputs: rom; for full ones mesh. Params: choice, tip_line, material. Output: folder."""

from pathlib import Path

from job import run

from r37core.exports.matrices_out import table_nodes, write_full_matrices, write_reduced_matrices
from r37core.fem.material import Material
from r37core.fem.matrices import assemble
from r37core.mesh.mesh_files import read_vtu
from r37core.plain import from_plain
from r37core.rom.rom_file import read_reduced_model


def main(snakemake):
    given, folder, params = snakemake.input, Path(snakemake.output[0]), snakemake.params
    model, speeds = read_reduced_model(given.rom), params.choice["matrix_speeds"]
    if hasattr(given, "mesh"):
        mesh = read_vtu(given.mesh)
        matrices = assemble(mesh, from_plain(Material, params.material))
        nodes = table_nodes(model, params.tip_line)
        with_coriolis = model.coriolis is not None
        write_full_matrices(matrices, mesh, nodes, speeds, folder, params.choice["spin_softening"], with_coriolis)
    else:
        write_reduced_matrices(model, speeds, folder)


run(snakemake, main)
