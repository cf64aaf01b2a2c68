"""List the interactions. Inputs: campbell, rms and, where computed, stress and wear. Params: choice. Output: summary.csv."""

from job import run

from r37core.dataset_file import read_dataset
from r37core.io import atomic_write
from r37core.plain import from_plain
from r37core.results.interactions import InteractionChoice, summarise


def main(snakemake):
    datasets = {kind: read_dataset(file) for kind, file in snakemake.input.items()}
    table = summarise(datasets, from_plain(InteractionChoice, snakemake.params.choice))
    with atomic_write(snakemake.output[0]) as partial:
        table.to_csv(partial, index=False)


run(snakemake, main)
