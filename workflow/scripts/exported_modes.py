"""Write modes on the mesh. Inputs: mesh (vtu), model. Params: choice, orientation. Output: folder."""

from pathlib import Path

from job import run

from r37core.exchange.fields import Target, write_modes
from r37core.exchange.orientation import Orientation
from r37core.mesh.mesh_files import read_vtu
from r37core.plain import from_plain
from r37core.rom.rom_file import read_reduced_model


def main(snakemake):
    given, params = snakemake.input, snakemake.params
    choice = params.choice
    target = Target(Path(snakemake.output[0]), choice["formats"], from_plain(Orientation, params.orientation))
    write_modes(read_vtu(given.mesh), read_reduced_model(given.model), choice["mode_speeds"], choice["modes"], target)


run(snakemake, main)
