"""Gather the Campbell diagrams. Inputs: campbell.nc of each blade. Params: blades, fidelity. Output: campbell.nc."""

from job import run

from r37core.dataset_file import write_dataset
from r37core.results.gather import gather_blades


def main(snakemake):
    dataset = gather_blades(snakemake.params.blades, snakemake.input)
    write_dataset(dataset, snakemake.output[0], {"fidelity": snakemake.params.fidelity})


run(snakemake, main)
