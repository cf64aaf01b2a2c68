"""Write the worst stress. Inputs: mesh, model, speeds. Params: speeds, only_worst, material, ... Output: folder."""

from pathlib import Path

from job import run

from r37core.exchange.fields import Target, worst_instants, write_stress
from r37core.exchange.orientation import Orientation
from r37core.fem.material import Material
from r37core.io import as_list
from r37core.mesh.mesh_files import read_vtu
from r37core.plain import from_plain
from r37core.rom.rom_file import read_reduced_model
from r37core.stress.recovery import stress_operator


def main(snakemake):
    given, params = snakemake.input, snakemake.params
    model, material = read_reduced_model(given.model), from_plain(Material, params.material)
    stress = stress_operator(model, material)
    instants = worst_instants(as_list(given.speeds), params.speeds, stress, params.only_worst)
    for speed, instant in instants.items():
        print(f"{speed:g} rad/s: largest von Mises stress of the submesh {instant.largest:.6g} Pa")
    target = Target(Path(snakemake.output[0]), params.choice["formats"], from_plain(Orientation, params.orientation))
    write_stress(read_vtu(given.mesh), model, material, instants, target)


run(snakemake, main)
