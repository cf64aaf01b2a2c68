"""Write modes that move. Inputs: mesh (vtu), model. Params: modes. Output: folder."""

from pathlib import Path

from job import run

from r37core.mesh.mesh_files import read_vtu
from r37core.rom.rom_file import read_reduced_model
from r37core.shapes.moving import write_mode_shapes


def main(snakemake):
    given = snakemake.input
    write_mode_shapes(read_vtu(given.mesh), read_reduced_model(given.model), snakemake.params.modes, Path(snakemake.output[0]))


run(snakemake, main)
