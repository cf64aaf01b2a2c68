"""Prepare one blade for simulations. Input: rom_{tip_line}.nc. Output: contact_{tip_line}.npz."""

from job import run

from r37core.rom.contact_model import write_contact_model
from r37core.rom.reduced_model import contact_model
from r37core.rom.rom_file import read_reduced_model


def main(snakemake):
    model = contact_model(read_reduced_model(snakemake.input[0]), snakemake.wildcards.tip_line)
    write_contact_model(model, snakemake.output[0])


run(snakemake, main)
