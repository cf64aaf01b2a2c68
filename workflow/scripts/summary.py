"""List the interactions. Inputs: campbell, rms and, if there, stress, wear, tolerances. Param: choice. Output: summary.csv."""

from job import run

from r37core.dataset_file import read_dataset
from r37core.plain import from_plain
from r37core.results.interactions import InteractionChoice, summarise
from r37core.results.table_file import write_table
from r37core.tolerances.table import read_ranges, with_ranges


def main(snakemake):
    given = dict(snakemake.input.items())
    ranges = given.pop("tolerances", None)
    datasets = {kind: read_dataset(file) for kind, file in given.items()}
    table = summarise(datasets, from_plain(InteractionChoice, snakemake.params.choice))
    if ranges:
        table = with_ranges(table, read_ranges(ranges))
    write_table(table, snakemake.output[0])


run(snakemake, main)
