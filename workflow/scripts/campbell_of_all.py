"""Gather the Campbell diagrams. Inputs: campbell.nc of each blade. Params: blades, fidelity. Output: campbell.nc."""

from job import run

from r37core.dataset_file import hash_of_parts, write_dataset
from r37core.results.gather import gather_blades


def main(snakemake):
    dataset = gather_blades(snakemake.params.blades, snakemake.input)
    made = {"fidelity": snakemake.params.fidelity, "input_hash": hash_of_parts(snakemake.input)}
    write_dataset(dataset, snakemake.output[0], made)


run(snakemake, main)
