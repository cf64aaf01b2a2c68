"""Prepare the stress of one blade for simulations. Input: rom_{tip_line}.nc. Param: material. Output: stress_{tip_line}.npz."""

from job import run

from r37core.fem.material import Material
from r37core.plain import from_plain
from r37core.rom.rom_file import read_reduced_model
from r37core.stress.operator import write_stress_operator
from r37core.stress.recovery import stress_operator


def main(snakemake):
    material = from_plain(Material, snakemake.params.material)
    write_stress_operator(stress_operator(read_reduced_model(snakemake.input[0]), material), snakemake.output[0])


run(snakemake, main)
