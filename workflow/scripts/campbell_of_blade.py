"""Campbell diagram of one blade. Input: rom.nc. Params: campbell, maximum_speed, tip_line. Output: campbell.nc."""

from job import run

from r37core.dataset_file import write_dataset
from r37core.results.campbell_dataset import campbell_dataset
from r37core.rom.rom_file import read_reduced_model


def main(snakemake):
    params = snakemake.params
    dataset = campbell_dataset(
        read_reduced_model(snakemake.input[0]),
        maximum_speed=params.maximum_speed,
        tip_line=params.tip_line,
        **params.campbell,
    )
    write_dataset(dataset, snakemake.output[0], params.provenance)


run(snakemake, main)
